//! A small deviation of the points on σ, carried through flight and control: whether neighbours part.

use super::actuated::Actuated;
use super::memory::LONGEST_DELAY;
use super::method::{Controller, Seen};
use crate::dynamics::{Drive, Tangent, Trajectory};
use crate::model::{Flight, Real, State};

/// Points that feedback remembers: the present one and those before it, as far as the longest delay.
pub const DELAYS: usize = LONGEST_DELAY + 1;

/// The deviations of the last points (v1+, x2, v2, τ), the present one first; non-dimensional.
///
/// Feedback remembers, so that a deviation of the controlled map is one of all the points that it remembers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deviations<T> {
    points: [[T; 4]; DELAYS],
}

impl<T: Real> Deviations<T> {
    /// The deviation every observation begins with: all components of the present point alike.
    pub fn seed() -> Self {
        let mut points = [[T::zero(); 4]; DELAYS];
        points[0] = [T::of(0.5); 4];
        Deviations { points }
    }

    /// The deviation, at fixed time, of the trajectory that leaves the present point.
    ///
    /// A point met later by δτ/ω was, at the same time, that much of its motion behind; and so was a force that begins
    /// with it.
    pub fn leaving<D: Actuated<T>>(
        &self,
        flight: &Flight<T, 2>,
        trajectory: &Trajectory<T, 2, D>,
        controller: &Controller<T>,
    ) -> D::Deviation {
        let [v1, x2, v2, tau] = self.points[0];
        let shift = tau / flight.omega;
        let rate = rates(flight, trajectory);
        let tangent = Tangent(State {
            x: [-(rate[0] * shift), x2 - rate[1] * shift],
            v: [v1 - rate[2] * shift, v2 - rate[3] * shift],
        });
        let lag = match controller {
            Controller::Sine(sine) => sine.lag(tau),
            Controller::None | Controller::Pulse(_) | Controller::Delay(_) => T::zero(),
        };
        trajectory.point.drive.deviating(tangent, lag)
    }

    /// The deviation of the point at which a trajectory with this tangent vector arrives.
    pub fn arrived<D: Drive<T, 2>>(
        &self,
        flight: &Flight<T, 2>,
        trajectory: &Trajectory<T, 2, D>,
        tangent: &Tangent<T, 2>,
    ) -> [T; 4] {
        let rate = rates(flight, trajectory);
        let State { x, v } = tangent.0;
        let shift = if rate[0] == T::zero() { T::zero() } else { -(x[0] / rate[0]) };
        [v[0] + rate[2] * shift, x[1] + rate[1] * shift, v[1] + rate[3] * shift, flight.omega * shift]
    }

    /// What control makes of the deviation of an arriving point.
    pub fn passed(&self, controller: &Controller<T>, seen: &Seen<T>, arrived: [T; 4]) -> [T; 4] {
        match controller {
            Controller::None => arrived,
            Controller::Sine(sine) => sine.deviated(seen, &self.points[0], arrived),
            Controller::Pulse(pulse) if pulse.is_due(seen) => [T::zero(); 4],
            Controller::Pulse(_) => arrived,
            Controller::Delay(delay) => {
                let past = &self.points[delay.delay as usize];
                let feedback = delay.feedback(&added(&self.points[0], &past.map(|value| -value)));
                added(&arrived, &feedback)
            }
        }
    }

    /// Takes in the deviation of the present point.
    pub fn push(&mut self, deviation: [T; 4]) {
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
        for [a, b, c, d] in self.points {
            squares = squares + ((a * a + b * b) + (c * c + d * d));
        }
        let length = squares.sqrt();
        if !(length > T::zero() && length.is_finite()) {
            *self = Deviations::seed();
            return None;
        }
        let factor = T::one() / length;
        self.points = self.points.map(|point| point.map(|value| value * factor));
        Some(length.ln())
    }
}

/// The rates of (x1, x2, v1, v2) at a trajectory's present point.
fn rates<T: Real, D: Drive<T, 2>>(flight: &Flight<T, 2>, trajectory: &Trajectory<T, 2, D>) -> [T; 4] {
    let point = &trajectory.point;
    let [a1, a2] = point.motion(flight, trajectory.contact).acceleration;
    [point.state.v[0], point.state.v[1], a1, a2]
}

fn added<T: Real>(a: &[T; 4], b: &[T; 4]) -> [T; 4] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]]
}
