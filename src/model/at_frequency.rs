//! A system forced at another frequency.

use super::system::System;
use super::system_error::SystemError;
use crate::system::Plant;

impl System {
    /// The same system forced at another frequency ω: by the parameter of its setting that the frequency is, or grows in
    /// proportion with, where it was made from one that has it; otherwise it is the same plant at that frequency.
    ///
    /// # Errors
    /// As [`System::new`] and [`System::of_plant`].
    pub fn at_frequency(&self, omega: f64) -> Result<Self, SystemError> {
        let label_order = self.common().label_order.clone();
        if let Some((setting, parameter)) =
            self.setting().and_then(|setting| Some((setting, setting.family().of_frequency()?)))
        {
            let (value, now) = (setting.get(parameter), self.plant().omega);
            let is_itself = value == now;
            let value = if is_itself { omega } else { value * (omega / now) };
            match System::new(setting.with(parameter, value)) {
                Ok(other) if (other.plant().omega - omega).abs() <= 4.0 * f64::EPSILON * omega.abs() => {
                    return Ok(other.ordered(label_order));
                }
                Err(refused) if is_itself => return Err(refused),
                _ => {}
            }
        }
        let other = System::of_plant(Plant { omega, ..self.free_plant() })?.ordered(label_order);
        if self.mooring().is_some() { other.moored() } else { Ok(other) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Setting;
    use crate::system::Family;

    /// One mass before two stops, labels in the order B, A; forced at a frequency that an expression gives.
    fn forced_at(frequency: &str) -> System {
        let file = format!(
            r#"
name = "two"
label_order = ["B", "A"]
[parameters]
w = 1.5
gap = 0.5
[system]
frequency = "{frequency}"
mass = [["1"]]
damping = [["0.1"]]
stiffness = [["w"]]
force_sin = ["1"]
[[stop]]
name = "A"
direction = ["1"]
gap = "gap"
restitution = "0.8"
[[stop]]
name = "B"
direction = ["-1"]
gap = "2*gap"
restitution = "0.8"
"#
        );
        System::new(Setting::defaults(Family::kept(&file, "two.toml").unwrap())).unwrap()
    }

    #[test]
    fn the_frequency_is_the_one_asked_for_however_it_is_written() {
        // What the frequency is, or is proportional to, is changed, and what else depends on it; otherwise the plant alone.
        for (frequency, w) in
            [("w", Some(2.0)), ("2*w", Some(1.0)), ("w*w", None), ("1 + w", None), ("3", None)]
        {
            let own = forced_at(frequency);
            let other = own.at_frequency(2.0).unwrap();
            assert_eq!(other.plant().omega, 2.0, "{frequency}");
            assert_eq!(other.label_order(), [1, 0], "{frequency}");
            assert_eq!(other.setting().and_then(|setting| setting.named("w")), w, "{frequency}");
            assert_eq!(other.plant().stiffness[(0, 0)], w.unwrap_or(1.5), "{frequency}");
        }
        let of_plant = System::of_plant(forced_at("w").plant().clone()).unwrap().labelled(vec![1, 0]);
        assert_eq!(of_plant.at_frequency(2.0).unwrap().label_order(), [1, 0]);
        assert!(forced_at("w").at_frequency(-1.0).is_err());
    }
}
