//! A control method's settings as the options that make them again.

use impact_atlas::control::{ControlQuantity, Scheme, Target};
use impact_atlas::dynamics::Stop;
use impact_atlas::model::{Number, joined};
use impact_atlas::system::Family;

/// The options that make a scheme again; those that an axis varies are left out.
///
/// The stop is named as in the family, where it is not the first.
pub fn control_options(scheme: &Scheme, family: &Family, varied: impl Fn(ControlQuantity) -> bool) -> String {
    use ControlQuantity as Q;
    let stop = match scheme.stop() {
        Stop::A => String::new(),
        stop => format!(" --stop {}", family.stops()[stop.index()].name),
    };
    let number = |quantity: Q, value: f64| match varied(quantity) {
        true => String::new(),
        false => format!(" --{}={}", quantity.name().replace('_', "-"), Number(value)),
    };
    let target = |target: &Target, components: &[usize]| {
        let values: Option<Vec<String>> =
            components.iter().map(|&i| target.given[i].map(|value| Number(value).to_string())).collect();
        match values {
            Some(values) => format!(" --target={}", values.join(",")),
            None => format!(" --reference={}", Number(target.reference)),
        }
    };
    match scheme {
        Scheme::Sine(sine) => {
            let convention: &str = sine.convention.into();
            let own = sine.target.own;
            let aimed = Q::of_component(sine.component, family.n(), own);
            let component = match sine.component {
                0 => "v_after",
                _ => aimed.name().trim_start_matches("target_"),
            };
            let coordinate = match sine.coordinate {
                0 => String::new(),
                i => format!(" --coordinate x{}", i + 1),
            };
            [
                stop,
                format!(" --convention {convention} --component {component}{coordinate}"),
                number(Q::Amplitude, sine.amplitude),
                number(Q::Alpha, sine.alpha),
                number(Q::DeadBand, sine.dead_band),
                number(Q::Gamma, sine.gamma),
                number(Q::Phase, sine.phase),
                match varied(aimed) {
                    true => String::new(),
                    false => target(&sine.target, &[sine.component]),
                },
            ]
            .concat()
        }
        Scheme::Pulse(pulse) => [
            stop,
            number(Q::Period, f64::from(pulse.period)),
            number(Q::Noise, pulse.noise),
            format!(" --seed {}", pulse.seed),
            target(&pulse.target, &Vec::from_iter(0..2 * family.n())),
        ]
        .concat(),
        Scheme::Delay(delay) => {
            let gains = match varied(Q::Gain) {
                true => String::new(),
                false => format!(" --gains={}", joined(&delay.gains, ",")),
            };
            let sign: &str = delay.sign.into();
            format!("{stop}{gains}{} --sign {sign}", number(Q::Delay, f64::from(delay.delay)))
        }
    }
}
