//! A small deviation of the points on σ, carried through flight and control: whether neighbours part.

use super::action::Seen;
use super::components::Components;
use super::memory::LONGEST_DELAY;
use super::methods::Controller;
use super::surface::Surface;
use crate::dynamics::{Tangent, Trajectory};
use crate::model::vector::dot;
use crate::model::{Flight, Real, State};

/// Points that feedback remembers: the present one and those before it, as far as the longest delay.
pub const DELAYS: usize = LONGEST_DELAY + 1;

/// The deviations of the last points on σ, the present one first; non-dimensional.
///
/// Feedback remembers, so that a deviation of the controlled map is one of all the points that it remembers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deviations<T, const N: usize> {
    points: [Components<T, N>; DELAYS],
}

impl<T: Real, const N: usize> Deviations<T, N> {
    /// The deviation every observation begins with: all components of the present point alike.
    pub fn seed() -> Self {
        let mut points = [Components::zero(); DELAYS];
        let each = T::of(1.0 / (2.0 * N as f64).sqrt());
        points[0] = Components::from_fn(|_| each);
        Deviations { points }
    }

    /// The deviation, at fixed time, of the trajectory that leaves the present point, as it is carried along.
    ///
    /// A point met later by δτ/ω was, at the same time, that much of its motion behind; and so was a force that begins
    /// with it.
    pub fn leaving<const M: usize>(
        &self,
        flight: &Flight<T, M>,
        surface: &Surface,
        trajectory: &Trajectory<T, M>,
        controller: &Controller<T>,
    ) -> Tangent<T, M> {
        let tau = self.points[0][Components::<T, N>::TAU];
        let within = surface.deviation(flight, &self.points[0]);
        let mut state = within.plus(-(tau / flight.omega), &rates(flight, trajectory));
        if M > N && !controller.begins_anew() {
            (state.x[N], state.v[N]) = (T::zero(), T::zero());
        }
        let mut tangent = Tangent(state);
        trajectory.carry(flight, std::slice::from_mut(&mut tangent));
        tangent
    }

    /// The deviation of the point at which a trajectory arrives that carries this tangent vector along.
    pub fn arrived<const M: usize>(
        &self,
        flight: &Flight<T, M>,
        surface: &Surface,
        trajectory: &Trajectory<T, M>,
        tangent: &Tangent<T, M>,
    ) -> Components<T, N> {
        let mut tangent = *tangent;
        trajectory.bring_back(flight, std::slice::from_mut(&mut tangent));
        let rate = rates(flight, trajectory);
        let direction = &flight.normals[surface.end.normal].direction;
        let speed = dot(direction, &rate.x);
        let shift = if speed == T::zero() { T::zero() } else { -(dot(direction, &tangent.0.x) / speed) };
        surface.components(&tangent.0.plus(shift, &rate), flight.omega * shift)
    }

    /// What control makes of the deviation of an arriving point.
    pub fn passed(
        &self,
        controller: &Controller<T>,
        seen: &Seen<T, N>,
        arrived: Components<T, N>,
    ) -> Components<T, N> {
        controller.passed(seen, &self.points, arrived)
    }

    /// Takes in the deviation of the present point.
    pub fn push(&mut self, deviation: Components<T, N>) {
        for i in (1..DELAYS).rev() {
            self.points[i] = self.points[i - 1];
        }
        self.points[0] = deviation;
    }

    /// ln of the factor by which the deviation has grown since the last call; it is brought back to unit length.
    ///
    /// `None` where it is lost altogether, as a pulse does; it starts afresh then.
    pub fn growth(&mut self) -> Option<T> {
        let mut squares = T::zero();
        for point in &self.points {
            squares = squares + point.square();
        }
        let length = squares.sqrt();
        if !(length > T::zero() && length.is_finite()) {
            *self = Deviations::seed();
            return None;
        }
        let factor = T::one() / length;
        self.points = self.points.map(|point| point.map(|value| value * factor));
        Some(length.logarithm())
    }
}

/// The rates of displacements and velocities at a trajectory's present point.
#[inline(always)]
fn rates<T: Real, const M: usize>(flight: &Flight<T, M>, trajectory: &Trajectory<T, M>) -> State<T, M> {
    let point = &trajectory.point;
    State { x: point.state.v, v: point.motion(flight, trajectory.contact).acceleration }
}
