//! What an axis can vary of a control method.

/// A setting of a control method that an axis can vary.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ControlQuantity {
    /// The name used on the command line and in files.
    pub name: &'static str,
    /// What the setting is, for axis titles.
    pub description: &'static str,
    /// The letter of its symbol, the subscript and the superscript.
    pub symbol: [&'static str; 3],
    /// Whether only whole numbers make sense.
    pub is_whole: bool,
}

impl ControlQuantity {
    /// A setting by its name on the command line and in files, with what it is for axis titles and its symbol.
    pub(super) const fn new(name: &'static str, symbol: &'static str, description: &'static str) -> Self {
        ControlQuantity { name, description, symbol: [symbol, "", ""], is_whole: false }
    }

    /// The same of whole numbers.
    pub(super) const fn whole(name: &'static str, symbol: &'static str, description: &'static str) -> Self {
        ControlQuantity { is_whole: true, ..ControlQuantity::new(name, symbol, description) }
    }

    const fn aimed(name: &'static str, symbol: [&'static str; 3], description: &'static str) -> Self {
        ControlQuantity { name, description, symbol, is_whole: false }
    }

    /// The name of the option that sets it.
    pub fn option(self) -> String {
        self.name.replace('_', "-")
    }

    /// The setting that is a component of a target on a section of n coordinates, whose first component is the velocity of
    /// the coordinate `own`.
    ///
    /// # Panics
    /// If the section has no such component.
    pub fn of_component(component: usize, n: usize, own: usize) -> Self {
        let mut all = AIMED.into_iter().filter(|setting| setting.component(n, own) == Some(component));
        all.next().expect("a section has 2n components")
    }

    /// Which component of a target it is on a section of n coordinates, whose first component is the velocity of the
    /// coordinate `own`.
    pub(super) fn component(self, n: usize, own: usize) -> Option<usize> {
        let among_others = |i: usize| if i < own { i } else { i - 1 };
        let place = AIMED.into_iter().position(|setting| setting == self)?;
        match (place / MOST, place % MOST) {
            (2, _) => Some(2 * n - 1),
            (_, i) if i >= n => None,
            (0, i) if i == own => Some(0),
            (_, i) if i == own => None,
            (0, i) => Some(n + among_others(i)),
            (_, i) => Some(1 + among_others(i)),
        }
    }
}

/// The most coordinates.
const MOST: usize = 4;

/// The components of a target: the velocities, the displacements and the phase.
pub(super) const AIMED: [ControlQuantity; 2 * MOST + 1] = [
    ControlQuantity::aimed("target_v1", ["v", "1", "+"], "target velocity after impact"),
    ControlQuantity::aimed("target_v2", ["v", "2", ""], "target velocity of the second mass"),
    ControlQuantity::aimed("target_v3", ["v", "3", ""], "target velocity of the third mass"),
    ControlQuantity::aimed("target_v4", ["v", "4", ""], "target velocity of the fourth mass"),
    ControlQuantity::aimed("target_x1", ["x", "1", ""], "target displacement of the first mass"),
    ControlQuantity::aimed("target_x2", ["x", "2", ""], "target displacement of the second mass"),
    ControlQuantity::aimed("target_x3", ["x", "3", ""], "target displacement of the third mass"),
    ControlQuantity::aimed("target_x4", ["x", "4", ""], "target displacement of the fourth mass"),
    ControlQuantity::aimed("target_tau", ["τ", "0", ""], "target phase"),
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::control::section_names;
    use crate::dynamics::Stop;
    use crate::model::Setting;
    use crate::system::Family;

    /// The names of settings are those of the section's components, whatever coordinate is its own.
    #[test]
    fn components_have_the_settings_of_their_names() {
        for (family, own) in
            [("luo-ma-lv", 0), ("bouncing-ball", 0), ("three-mass-chain", 1), ("impact-damper", 0)]
        {
            let plant = Setting::defaults(Family::builtin(family)).plant().unwrap();
            for (i, name) in section_names(&plant, Stop::A).iter().enumerate() {
                let setting = ControlQuantity::of_component(i, plant.n, own);
                assert_eq!(setting.name, format!("target_{}", name.trim_end_matches('+')), "{family}");
                assert_eq!(setting.component(plant.n, own), Some(i), "{family}");
            }
            let there = AIMED.into_iter().filter(|s| s.component(plant.n, own).is_some());
            assert_eq!(there.count(), 2 * plant.n, "{family}");
        }
    }
}
