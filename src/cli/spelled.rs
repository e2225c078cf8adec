//! A control method's settings as the options that make them again.

use impact_atlas::control::{ControlQuantity, Convention, Scheme, Sign, Target};
use impact_atlas::model::{Number, joined};

/// The options that make a scheme again; those that an axis varies are left out.
pub fn spelled(scheme: &Scheme, varied: impl Fn(ControlQuantity) -> bool) -> String {
    use ControlQuantity as Q;
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
            let convention = match sine.convention {
                Convention::Kick => "kick",
                Convention::Force => "force",
                Convention::ForceLocal => "force-local",
            };
            let component = ["v_after", "x2", "v2", "tau"][sine.component];
            [
                format!(" --convention {convention} --component {component}"),
                number(Q::Amplitude, sine.amplitude),
                number(Q::Alpha, sine.alpha),
                number(Q::DeadBand, sine.dead_band),
                number(Q::Gamma, sine.gamma),
                number(Q::Phase, sine.phase),
                match varied([Q::TargetV1, Q::TargetX2, Q::TargetV2, Q::TargetTau][sine.component]) {
                    true => String::new(),
                    false => target(&sine.target, &[sine.component]),
                },
            ]
            .concat()
        }
        Scheme::Pulse(pulse) => [
            number(Q::Period, f64::from(pulse.period)),
            number(Q::Noise, pulse.noise),
            format!(" --seed {}", pulse.seed),
            target(&pulse.target, &[0, 1, 2, 3]),
        ]
        .concat(),
        Scheme::Delay(delay) => {
            let gains = match varied(Q::Gain) {
                true => String::new(),
                false => format!(" --gains={}", joined(&delay.gains, ",")),
            };
            let sign = match delay.sign {
                Sign::Stabilising => "stabilising",
                Sign::Printed => "printed",
            };
            format!("{gains}{} --sign {sign}", number(Q::Delay, f64::from(delay.delay)))
        }
    }
}
