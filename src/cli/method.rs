//! The options of the control methods, which `control` and `map` share.

use anyhow::anyhow;
use clap::Args;
use impact_atlas::control::{
    ControlQuantity, Convention, DelaySetting, PulseSetting, Scheme, SectionValues, Sign, SineSetting,
    Target, own_coordinate,
};

use impact_atlas::model::Setting;
use impact_atlas::plane::Quantity;

use super::method_name::MethodName;
use super::site::{Site, words};
use super::values::{Assignment, count};
use super::{CliError, defaults};

/// The settings of the three methods.
#[derive(Debug, Args)]
pub struct MethodArgs {
    /// The stop at whose impacts control acts, by name [default: the first of the system's]
    ///
    /// X, a point on its section, has 2n components: the velocity after the impact of the coordinate that the stop's gap
    /// determines (the one with the largest share of its direction), the other displacements, the other velocities,
    /// the forcing phase: v1+, x2, v2, tau at either stop of the paper's oscillator.
    #[arg(long, value_name = "NAME", help_heading = "Section")]
    stop: Option<String>,

    /// sine: what u = B sin(γωt + φ) is [default: kick]
    #[arg(long, value_enum, help_heading = "Sine")]
    convention: Option<Convention>,

    /// sine: the amplitude B before the first adaptation [default: 0]
    #[arg(long, value_name = "B", help_heading = "Sine", allow_negative_numbers = true)]
    amplitude: Option<f64>,

    /// sine: the weight of the adaptation, 0 to 1; 0 keeps B constant [default: 0.1]
    ///
    /// B(n+1) = B(n) + α |e(n+1)|, and α changes its sign whenever |e(n+1)/e(n)| > 1.
    #[arg(long, value_name = "ALPHA", help_heading = "Sine", allow_negative_numbers = true)]
    alpha: Option<f64>,

    /// sine: the error below which B is left alone [default: 0.0055]
    #[arg(long, value_name = "DELTA", help_heading = "Sine", allow_negative_numbers = true)]
    dead_band: Option<f64>,

    /// sine: frequency of the force in units of the forcing's [default: 1]
    #[arg(long, value_name = "GAMMA", help_heading = "Sine", allow_negative_numbers = true)]
    gamma: Option<f64>,

    /// sine: phase φ of the force in radians [default: 0]
    #[arg(long, value_name = "PHI", help_heading = "Sine", allow_negative_numbers = true)]
    phase: Option<f64>,

    /// sine: the component of the section point that is held to the target [default: tau]
    ///
    /// v_after for the first, or a name: v1+, x2, v2, tau at the paper's stops.
    #[arg(long, value_name = "NAME", help_heading = "Sine")]
    component: Option<String>,

    /// sine: the coordinate that a force acts on [default: x1]
    #[arg(long, value_name = "x1 … xn", help_heading = "Sine")]
    coordinate: Option<String>,

    /// pulse: the period P of the pulses in iterates [default: 1]
    #[arg(long, value_parser = count, value_name = "P", help_heading = "Pulse")]
    period: Option<u32>,

    /// pulse: the largest error E of a measured component [default: 0]
    #[arg(long, value_name = "E", help_heading = "Pulse", allow_negative_numbers = true)]
    noise: Option<f64>,

    /// pulse: what the errors are drawn from [default: 1]
    #[arg(long, value_parser = count, value_name = "SEED", help_heading = "Pulse")]
    seed: Option<u32>,

    /// delay: the gain g of all components, 0 to 1 [default: 0.5]
    #[arg(long, value_name = "G", help_heading = "Delay", allow_negative_numbers = true)]
    gain: Option<f64>,

    /// delay: the diagonal of G, a gain for each component
    #[arg(
        long,
        value_name = "G1,G2,…",
        value_delimiter = ',',
        num_args = 1,
        conflicts_with = "gain",
        help_heading = "Delay",
        allow_hyphen_values = true
    )]
    gains: Option<Vec<f64>>,

    /// delay: the delay p in iterates, 1 to 8 [default: 1]
    #[arg(long, value_parser = count, value_name = "p", help_heading = "Delay")]
    delay: Option<u32>,

    /// delay: the sign of the feedback [default: stabilising]
    #[arg(long, value_enum, help_heading = "Delay")]
    sign: Option<Sign>,

    /// sine, pulse: the forcing frequency at which the symmetric 1-1-1 motion is the target [default: 3.7 for the paper's
    /// oscillator, the system's own frequency for others]
    #[arg(long, value_name = "OMEGA", help_heading = "Target", allow_negative_numbers = true)]
    reference: Option<f64>,

    /// sine, pulse: the target itself: one number (sine) or one for each component of X (pulse)
    #[arg(
        long,
        value_name = "X0",
        value_delimiter = ',',
        num_args = 1,
        conflicts_with = "reference",
        help_heading = "Target",
        allow_hyphen_values = true
    )]
    target: Option<Vec<f64>>,
}

impl MethodArgs {
    /// The checked scheme of a method with what was set of it, on a system; options of another method are refused.
    pub fn scheme(
        &self,
        method: MethodName,
        set: &[Assignment],
        setting: &Setting,
    ) -> Result<Scheme, CliError> {
        let replaced: Vec<_> = set.iter().map(|set| (format!("--set {set} sets"), set.quantity)).collect();
        self.refuse_replaced(method, &replaced)?;
        let mut scheme = self.of_options(method, &Site::new(setting, self.stop.as_deref())?)?;
        for (i, one) in set.iter().enumerate() {
            if let Some(other) = set[..i].iter().find(|other| other.quantity == one.quantity) {
                return Err(CliError::Input(anyhow!(
                    "{} is set twice, by --set {other} and --set {one}: drop one of the two",
                    one.quantity.name()
                )));
            }
            let Quantity::Control(setting) = one.quantity else { continue };
            scheme = scheme.with(setting, one.value).ok_or_else(|| {
                CliError::Input(anyhow!("--set {one} has no effect on {}: drop it", method.name()))
            })?;
        }
        scheme.check().map_err(CliError::input)?;
        Ok(scheme)
    }

    /// The scheme that the options of a method make.
    fn of_options(&self, method: MethodName, site: &Site) -> Result<Scheme, CliError> {
        if let Some((option, _)) = self.given().into_iter().find(|(_, of)| !of.contains(&method)) {
            return Err(CliError::Input(anyhow!("--{option} has no effect on {}: drop it", method.name())));
        }
        Ok(match method {
            MethodName::Sine => Scheme::Sine(self.sine(site)?),
            MethodName::Pulse => Scheme::Pulse(PulseSetting {
                stop: site.stop,
                period: self.period.unwrap_or(1),
                target: self.target(site, site.components())?,
                noise: self.noise.unwrap_or(0.0),
                seed: self.seed.unwrap_or(1),
            }),
            MethodName::Delay => Scheme::Delay(DelaySetting {
                stop: site.stop,
                gains: self.gains(site)?,
                delay: self.delay.unwrap_or(1),
                sign: self.sign.unwrap_or(Sign::Stabilising),
            }),
        })
    }

    /// Refuses options of a method that something else replaces, told in words.
    pub fn refuse_replaced(&self, method: MethodName, by: &[(String, Quantity)]) -> Result<(), CliError> {
        for (words, quantity) in by {
            let Quantity::Control(setting) = quantity else { continue };
            let name = setting.name().replace('_', "-");
            // What else it replaces altogether: of pulses it varies only one component of the target.
            let replaced: &[&str] = match setting {
                ControlQuantity::Gain => &["gains"],
                _ if name.starts_with("target-") && method == MethodName::Sine => &["reference", "target"],
                _ => &[],
            };
            let without_effect = |given: &str| given == name || replaced.contains(&given);
            if let Some((given, _)) = self.given().into_iter().find(|(given, _)| without_effect(given)) {
                return Err(CliError::Input(anyhow!(
                    "--{given} has no effect, since {words} it: drop one of the two"
                )));
            }
        }
        Ok(())
    }

    /// The first option that was given.
    pub fn any(&self) -> Option<&'static str> {
        self.given().first().map(|(option, _)| *option)
    }

    /// The options that were given, with the methods that have them.
    fn given(&self) -> Vec<(&'static str, &'static [MethodName])> {
        use MethodName::{Delay, Pulse, Sine};
        let options: [(&'static str, bool, &'static [MethodName]); 18] = [
            ("stop", self.stop.is_some(), &[Sine, Pulse, Delay]),
            ("convention", self.convention.is_some(), &[Sine]),
            ("amplitude", self.amplitude.is_some(), &[Sine]),
            ("alpha", self.alpha.is_some(), &[Sine]),
            ("dead-band", self.dead_band.is_some(), &[Sine]),
            ("gamma", self.gamma.is_some(), &[Sine]),
            ("phase", self.phase.is_some(), &[Sine]),
            ("component", self.component.is_some(), &[Sine]),
            ("coordinate", self.coordinate.is_some(), &[Sine]),
            ("period", self.period.is_some(), &[Pulse]),
            ("noise", self.noise.is_some(), &[Pulse]),
            ("seed", self.seed.is_some(), &[Pulse]),
            ("gain", self.gain.is_some(), &[Delay]),
            ("gains", self.gains.is_some(), &[Delay]),
            ("delay", self.delay.is_some(), &[Delay]),
            ("sign", self.sign.is_some(), &[Delay]),
            ("reference", self.reference.is_some(), &[Sine, Pulse]),
            ("target", self.target.is_some(), &[Sine, Pulse]),
        ];
        options.into_iter().filter(|(_, given, _)| *given).map(|(option, _, of)| (option, of)).collect()
    }

    fn sine(&self, site: &Site) -> Result<SineSetting, CliError> {
        let component = site.component(self.component.as_deref())?;
        let convention = self.convention.unwrap_or(Convention::Kick);
        if let (Some(coordinate), Convention::Kick) = (&self.coordinate, convention) {
            return Err(CliError::Input(anyhow!(
                "--coordinate {coordinate} has no effect on a kick, which changes {}: drop it, or give --convention force",
                site.names[0]
            )));
        }
        let mut target = self.target(site, 1)?;
        target.given.swap(0, component);
        Ok(SineSetting {
            stop: site.stop,
            coordinate: site.coordinate(self.coordinate.as_deref())?,
            convention,
            amplitude: self.amplitude.unwrap_or(0.0),
            alpha: self.alpha.unwrap_or(defaults::ALPHA),
            dead_band: self.dead_band.unwrap_or(defaults::DEAD_BAND),
            gamma: self.gamma.unwrap_or(1.0),
            phase: self.phase.unwrap_or(0.0),
            component,
            target,
        })
    }

    fn gains(&self, site: &Site) -> Result<SectionValues<f64>, CliError> {
        let alike = vec![self.gain.unwrap_or(defaults::GAIN); site.components()];
        let gains = self.gains.as_ref().unwrap_or(&alike);
        SectionValues::from_slice(gains).filter(|gains| gains.len() == site.components()).ok_or_else(|| {
            CliError::Input(anyhow!(
                "--gains has {} numbers: give {}, for {}",
                gains.len(),
                words(site.components()),
                site.listed()
            ))
        })
    }

    /// The target, from so many numbers or from a reference motion; a single number comes first.
    fn target(&self, site: &Site, count: usize) -> Result<Target, CliError> {
        let own = if site.family.is_paper() { defaults::REFERENCE } else { site.plant.omega };
        let reference = self.reference.unwrap_or(own);
        let none = vec![None; site.components()];
        let mut given = SectionValues::from_slice(&none).expect("a section has 2 to 8 components");
        if let Some(values) = &self.target {
            if values.len() != count {
                let wanted = match count {
                    1 => "one, for --component".to_owned(),
                    count => format!("{}, for {}", words(count), site.listed()),
                };
                return Err(CliError::Input(anyhow!("--target has {} numbers: give {wanted}", values.len())));
            }
            given.iter_mut().zip(values).for_each(|(given, value)| *given = Some(*value));
        }
        Ok(Target { reference, given, own: own_coordinate(&site.plant, site.stop) })
    }
}
