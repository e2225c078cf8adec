//! The parameters of the paper's oscillator by name.

use crate::system::{Family, Setting};

/// The eight non-dimensional parameters of Eq. (1) of Luo, Ma and Lv.
///
/// [`Parameters::default`] holds the values of the paper's numerics at its first worked point,
/// ω = 3.7 and δ = 0.1; f20 = 0 (force on M1 only) is not printed there but reproduces its orbits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters {
    /// Forcing frequency.
    pub omega: f64,
    /// Half clearance.
    pub delta: f64,
    /// Damping ratio.
    pub zeta: f64,
    /// Coefficient of restitution.
    pub r: f64,
    /// Mass ratio.
    pub mu_m: f64,
    /// Stiffness ratio.
    pub mu_k: f64,
    /// Damping distribution.
    pub mu_c: f64,
    /// Forcing share of the second mass.
    pub f20: f64,
}

impl Default for Parameters {
    fn default() -> Self {
        Parameters { omega: 3.7, delta: 0.1, zeta: 0.1, r: 0.8, mu_m: 0.5, mu_k: 0.5, mu_c: 0.5, f20: 0.0 }
    }
}

impl Parameters {
    /// The parameters of a setting of the paper's oscillator; none of any other family's.
    pub fn of(setting: &Setting) -> Option<Self> {
        let value = |name: &str| setting.named(name);
        setting.family().is_paper().then_some(())?;
        Some(Parameters {
            omega: value("omega")?,
            delta: value("delta")?,
            zeta: value("zeta")?,
            r: value("r")?,
            mu_m: value("mu_m")?,
            mu_k: value("mu_k")?,
            mu_c: value("mu_c")?,
            f20: value("f20")?,
        })
    }
}

impl From<Parameters> for Setting {
    fn from(parameters: Parameters) -> Setting {
        let Parameters { omega, delta, zeta, r, mu_m, mu_k, mu_c, f20 } = parameters;
        [
            ("omega", omega),
            ("delta", delta),
            ("zeta", zeta),
            ("r", r),
            ("mu_m", mu_m),
            ("mu_k", mu_k),
            ("mu_c", mu_c),
            ("f20", f20),
        ]
        .into_iter()
        .fold(Setting::defaults(Family::paper()), |setting, (name, value)| setting.with_named(name, value))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_defaults_are_the_familys_and_names_round_trip() {
        assert_eq!(Setting::from(Parameters::default()), Setting::defaults(Family::paper()));
        let parameters = Parameters {
            omega: 1.0,
            delta: 2.0,
            zeta: 3.0,
            r: 0.4,
            mu_m: 0.5,
            mu_k: 0.6,
            mu_c: 0.7,
            f20: 0.8,
        };
        assert_eq!(Parameters::of(&parameters.into()), Some(parameters));
        assert_eq!(Parameters::of(&Setting::defaults(Family::builtin("shaw-holmes"))), None);
    }
}
