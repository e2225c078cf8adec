//! Small kicks that put the point on the stable directions of an unstable motion, once it has come near by itself.
//!
//! After E. Ott, C. Grebogi, J. A. Yorke, Phys. Rev. Lett. 64 (1990) 1196–1199, doi:10.1103/PhysRevLett.64.1196. Only the velocity
//! just after the impact is changed, and by no more than the window.

use std::f64::consts::{PI, TAU};

use nalgebra::{ComplexField, DMatrix, DVector};
use serde::{Deserialize, Serialize};

use crate::control::action::{Action, Seen};
use crate::control::components::Components;
use crate::control::error::ControlError;
use crate::control::law::{Aim, CORRECTION, Law, Member, Method, Settings, Shown, bits, check_ranges};
use crate::control::option::OptionKind::Number;
use crate::control::option::{Arguments, GivenOptions, MethodOption};
use crate::control::quantity::ControlQuantity;
use crate::control::section_point::SectionPoint;
use crate::control::site::Site;
use crate::control::target::Target;
use crate::control::values::SectionValues;
use crate::dynamics::Stop;
use crate::model::vector::dot;
use crate::model::{Real, System};
use crate::system::Family;
use crate::theory::{extent, impact_map_at, in_units, unit_about};

/// Settings of the small kicks; non-dimensional.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct OgySetting {
    /// The stop on whose section it acts.
    #[serde(default)]
    pub stop: Stop,
    /// W > 0, the largest kick; where a larger one would be needed, there is none.
    pub window: f64,
    /// What lies near the motion's point on the section.
    pub target: Target,
}

const WINDOW: ControlQuantity = ControlQuantity::new("window", "W", "largest kick");

/// W unless it is given.
const USUAL_WINDOW: f64 = 0.05;

const METHOD: Method = Method {
    name: "ogy",
    about: "Small kicks that keep a motion from leaving an unstable one (Ott, Grebogi, Yorke)",
    options: (
        "Ogy",
        &[MethodOption::new(
            Number,
            ["window", "W"],
            "the largest kick W of the velocity after an impact [default: 0.05]",
        )
        .more(
            "The fixed point of the section that is held is found from the target by Newton's method; it must have one real \
             multiplier outside the unit circle, and no other. Farther away than W can mend there is no kick: wait until the \
             motion comes near, or begin near it (--start).",
        )],
    ),
    aim: Aim::Point,
    varied: &[WINDOW],
    signal: CORRECTION,
    shader: include_str!("../../../shaders/control/methods/ogy.wgsl"),
    constants: &[],
    members: &[("window", Member::Number), ("point", Member::Components), ("gains", Member::Components)],
    adapted: &[],
};

impl Settings for OgySetting {
    type Law = Ogy<f64>;

    const METHOD: &'static Method = &METHOD;

    fn given(options: &GivenOptions, site: &Site) -> Result<Self, ControlError> {
        let target = Target::given(options, site, site.components())?;
        Ok(OgySetting { stop: site.stop, window: options.number("window", USUAL_WINDOW), target })
    }

    fn write(&self, family: &Family, to: &mut Arguments) {
        to.setting(WINDOW, self.window);
        self.target.write(&Vec::from_iter(0..2 * family.n()), to);
    }

    fn vary(&mut self, quantity: ControlQuantity, value: f64) -> Option<()> {
        if quantity == WINDOW {
            self.window = value;
        } else {
            let place = self.target.component(quantity)?;
            self.target.given[place] = Some(value);
        }
        Some(())
    }

    fn check(&self) -> Result<(), ControlError> {
        let admitted = self.window > 0.0 && self.window.is_finite();
        check_ranges(&[(WINDOW, self.window, admitted, "greater than 0")])?;
        self.target.check()
    }

    fn resolve(&self, system: &System) -> Result<Ogy<f64>, ControlError> {
        let OgySetting { stop, window, target } = *self;
        let all = Vec::from_iter(0..2 * system.plant().n);
        let near = target.resolve(system, stop, &all)?;
        let (point, jacobian) = fixed_point(system, stop, &near).ok_or(ControlError::NoFixedPoint)?;
        let values = |values: &DVector<f64>| {
            SectionValues::from_slice(values.as_slice()).expect("a section has 2 to 8 components")
        };
        Ok(Ogy { stop, window, point: values(&point), gains: values(&gains(jacobian, system.unit())?) })
    }

    fn shown(&self) -> (&'static str, Vec<Shown>) {
        ("small kicks (Ott, Grebogi, Yorke)", vec![Shown::Setting(WINDOW, self.window)])
    }
}

/// Rounds of Newton's method, and the distance that ends it, in units of what is of order one on the motion.
const ROUNDS: usize = 30;
const EXACT: f64 = 1e-12;

/// The fixed point of the section's map that Newton's method finds, and the map's Jacobian there.
fn fixed_point(system: &System, stop: Stop, near: &[f64]) -> Option<(DVector<f64>, DMatrix<f64>)> {
    let tau = near.len() - 1;
    let mut point = DVector::from_row_slice(near);
    for _ in 0..ROUNDS {
        let next = impact_map_at(system, stop, point.as_slice()).ok()?;
        let jacobian = next.jacobian?;
        let mut away = DVector::from_row_slice(&next.section) - &point;
        away[tau] = (away[tau] + PI).rem_euclid(TAU) - PI;
        if extent(&away, unit_about(system.unit(), [&point])) < EXACT {
            point[tau] = point[tau].rem_euclid(TAU);
            return Some((point, jacobian));
        }
        let step = (DMatrix::identity(tau + 1, tau + 1) - jacobian).lu().solve(&away)?;
        point += step;
    }
    None
}

/// The gains of a kick that leaves nothing of a deviation along the one unstable direction: the left eigenvector, its first
/// component 1; zeros where the fixed point is stable.
fn gains(jacobian: DMatrix<f64>, unit: f64) -> Result<DVector<f64>, ControlError> {
    let jacobian = in_units(jacobian, unit);
    let multipliers = jacobian.complex_eigenvalues();
    let unstable: Vec<_> = multipliers.iter().filter(|multiplier| multiplier.modulus() >= 1.0).collect();
    let size = jacobian.nrows();
    let multiplier = match unstable[..] {
        [] => return Ok(DVector::zeros(size)),
        [one] if one.im == 0.0 => one.re,
        _ => return Err(ControlError::TooUnstable(unstable.len())),
    };
    let singular = jacobian.transpose() - DMatrix::identity(size, size) * multiplier;
    let rows = singular.svd(false, true).v_t.expect("it was asked for");
    let left = rows.row(size - 1).transpose();
    if left[0].abs() < 1e-6 * left.amax() {
        return Err(ControlError::NotReached);
    }
    let mut gains = &left / left[0];
    // A phase is the same in any unit of length, a kick is not.
    gains[size - 1] *= unit;
    Ok(gains)
}

/// The small kicks at work.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ogy<T> {
    /// The stop on whose section it acts.
    pub stop: Stop,
    /// W.
    pub window: T,
    /// The fixed point that is held.
    pub point: SectionValues<T>,
    /// What a deviation of each component adds to the kick, the first of them 1.
    pub gains: SectionValues<T>,
}

impl<T: Real> Law<T> for Ogy<T> {
    type Exact = Ogy<f64>;

    fn rounded(&Ogy { stop, window, point, gains }: &Ogy<f64>) -> Self {
        Ogy { stop, window: T::of(window), point: point.map(T::of), gains: gains.map(T::of) }
    }

    #[inline(always)]
    fn act<const N: usize>(&mut self, seen: &Seen<T, N>) -> Action<T, N> {
        self.kick(seen).map_or_else(Action::none, |kick| {
            let mut correction = Components::zero();
            correction[0] = kick;
            Action::correcting(correction)
        })
    }

    /// What deviates along the unstable direction is taken away.
    #[inline(always)]
    fn passed<const N: usize>(
        &self,
        seen: &Seen<T, N>,
        _: &[Components<T, N>],
        arrived: Components<T, N>,
    ) -> Components<T, N> {
        let mut passed = arrived;
        if self.kick(seen).is_some() {
            passed[0] = arrived[0] - self.along(&arrived);
        }
        passed
    }

    fn target(&self) -> Option<Vec<T>> {
        Some(self.point.to_vec())
    }

    fn written(&self) -> Vec<u32> {
        [bits([self.window]), bits(self.point.to_vec()), bits(self.gains.to_vec())].concat()
    }
}

impl<T: Real> Ogy<T> {
    /// The kick that puts a point on the stable directions, where it is within the window.
    #[inline(always)]
    fn kick<const N: usize>(&self, seen: &Seen<T, N>) -> Option<T> {
        let kick = -self.along(&seen.section.minus(&SectionPoint::new(&self.point)));
        (kick.abs() <= self.window).then_some(kick)
    }

    /// How far a deviation reaches along the unstable direction.
    #[inline(always)]
    fn along<const N: usize>(&self, deviation: &Components<T, N>) -> T {
        let half = |from: usize| -> T {
            let [gains, values]: [[T; N]; 2] =
                [std::array::from_fn(|i| self.gains[from + i]), std::array::from_fn(|i| deviation[from + i])];
            dot(&gains, &values)
        };
        half(0) + half(N)
    }
}
