//! Multipliers of a controlled fixed point.

use nalgebra::{Complex, ComplexField, DMatrix};

use super::components::Components;
use super::controlled::Controlled;
use super::deviation::DELAYS;
use super::force::InFlight;
use super::memory::LONGEST_DELAY;
use super::methods::Controller;
use super::schedule::ControlSchedule;
use super::section_point::SectionPoint;
use super::surface::Surface;
use super::witness::{Return, Witness};
use crate::dynamics::{Contact, Point, Trajectory};
use crate::model::vector::MOST;
use crate::model::{Flight, System, SystemError};

/// How far the points are moved for the differences, in units of what is of order one; in τ, so far.
const STEP: f64 = 1e-6;

/// The multipliers of one controlled iterate at a fixed point of it on the section of the controller's stop, the adaptation
/// of a sine force held: 2n, those of F without control, and with feedback those of all the points that it remembers.
/// The largest modulus first.
///
/// From central differences: good to about 1e-8 of the largest entry of their matrix, which is some digits fewer where a motion is very
/// unstable; `None` where σ is not met again.
///
/// # Errors
/// [`SystemError::TooStiff`] where the steps of a forced flight would be too many.
///
/// # Panics
/// If the fixed point does not have 2n components.
pub fn multipliers(
    system: &System,
    controller: &Controller<f64>,
    fixed_point: &[f64],
) -> Result<Option<Vec<Complex<f64>>>, SystemError> {
    let held = controller.held(None);
    held.fly(system, Held { system, held, remembered: controller.remembered().min(DELAYS), fixed_point })
}

/// What is iterated.
struct Held<'a> {
    system: &'a System,
    /// The controller without adaptation.
    held: Controller<f64>,
    /// The points that it remembers.
    remembered: usize,
    fixed_point: &'a [f64],
}

impl InFlight for Held<'_> {
    type Output = Option<Vec<Complex<f64>>>;

    fn fly<const N: usize, const M: usize>(self, flown: &System) -> Self::Output {
        let flight = Flight::<f64, M>::new(flown);
        let surface = Surface::new(self.system, &flight, self.held.stop());
        let at = vec![SectionPoint::<f64, N>::new(self.fixed_point); self.remembered];
        let jacobian = differences(|points| iterate(&flight, surface, self.held, points), &at, flight.unit)?;
        let mut found: Vec<Complex<f64>> = jacobian.complex_eigenvalues().iter().copied().collect();
        found.sort_by(|a, b| b.modulus().total_cmp(&a.modulus()));
        Some(found)
    }
}

/// The Jacobian of a map that makes the next point of those remembered, the present one first, and moves them on.
fn differences<const N: usize>(
    map: impl Fn(&[SectionPoint<f64, N>]) -> Option<SectionPoint<f64, N>>,
    at: &[SectionPoint<f64, N>],
    unit: f64,
) -> Option<DMatrix<f64>> {
    let components = 2 * N;
    let size = components * at.len();
    let mut jacobian = DMatrix::zeros(size, size);
    for j in 0..size {
        let moved = |by: f64| {
            let mut moved = at.to_vec();
            moved[j / components].components[j % components] += by;
            map(&moved)
        };
        // Of a map in units of what is of order one: its entries are of one size.
        let one = |component: usize| if component == Components::<f64, N>::TAU { 1.0 } else { unit };
        let step = STEP * one(j % components);
        let difference = moved(step)?.minus(&moved(-step)?);
        for (i, value) in difference.values().enumerate() {
            jacobian[(i, j)] = value / one(i) / (2.0 * STEP);
        }
        if j + components < size {
            jacobian[(j + components, j)] = 1.0;
        }
    }
    Some(jacobian)
}

/// One controlled iterate from remembered points, the present one first.
fn iterate<const N: usize, const M: usize>(
    flight: &Flight<f64, M>,
    surface: Surface,
    controller: Controller<f64>,
    points: &[SectionPoint<f64, N>],
) -> Option<SectionPoint<f64, N>> {
    let schedule = ControlSchedule {
        from: 0,
        iterates: LONGEST_DELAY as u32 + ControlSchedule::SHORTEST,
        fixed: true,
        max_period: ControlSchedule::MAX_PERIOD,
    };
    let (sin, cos) = libm::sincos(points[0].tau());
    let placed = points[0].trajectory(flight, &surface, Contact::FREE);
    let point = Point { sin, cos, ..placed.point };
    let begun = Trajectory::from_point(flight, point, Contact::FREE, placed.step, placed.offset);
    let mut controlled = Controlled::<_, N, M>::new(begun, surface, controller, &schedule);
    for past in points.iter().rev() {
        controlled.memory.push(flight.unit, *past, 1.0, [0; MOST]);
    }
    controlled.force(flight);
    let mut last = Last(None);
    let returned = controlled.iterate(flight, &schedule, 1, &mut last);
    returned.then_some(SectionPoint::new(&last.0?.section))
}

/// Keeps the last return.
struct Last(Option<Return<f64>>);

impl Witness<f64> for Last {
    fn returned(&mut self, met: &Return<f64>) {
        self.0 = Some(*met);
    }
}
