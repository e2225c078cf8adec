//! How far a motion goes: the root mean square and the peak of every coordinate.

use crate::dynamics::{Contact, Event, Moves, Point, Trajectory};
use crate::model::vector::MOST;
use crate::model::{Flight, Real, State};

/// The root mean square and the peak of every coordinate x1 … xn, of the continuous motion; non-dimensional, 0 beyond n.
///
/// Every half of a piece of flight, half a step at the longest, is known at its ends and in its middle. The square of a
/// coordinate is integrated from its values and slopes there, exact for polynomials of degree 5; the peak is the largest
/// modulus at these places and at the turning points of the cubics between them. Either is within 1e-4 of the coordinate's size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// √(⟨xᵢ²⟩), the mean over whole forcing periods.
    pub rms: [f32; MOST],
    /// The largest |xᵢ|.
    pub peak: [f32; MOST],
}

impl Extent {
    /// That of a motion that could not be followed: NaN.
    pub const NONE: Extent = Extent { rms: [f32::NAN; MOST], peak: [f32::NAN; MOST] };

    /// From the mean squares and the peaks of the coordinates that there are.
    pub fn of(mean_squares: &[f64], peaks: &[f64]) -> Self {
        let all = |values: &[f64]| std::array::from_fn(|i| values.get(i).map_or(0.0, |&value| value as f32));
        let roots: Vec<f64> = mean_squares.iter().map(|square| square.sqrt()).collect();
        Extent { rms: all(&roots), peak: all(peaks) }
    }
}

/// A trajectory, and how far it went so far.
#[derive(Clone, Copy, Debug)]
pub struct ExtentObserver<T, const N: usize> {
    trajectory: Trajectory<T, N>,
    /// ∫ xᵢ² over the forcing periods that are over.
    squares: [T; N],
    /// The same over the present one.
    turn: [T; N],
    peak: [T; N],
}

impl<T: Real, const N: usize> ExtentObserver<T, N> {
    /// Begins at forcing phase 0 with a state within the stops.
    pub fn new(flight: &Flight<T, N>, start: State<T, N>) -> Self {
        let nothing = [T::zero(); N];
        let trajectory = Trajectory::new(flight, start);
        ExtentObserver { trajectory, squares: nothing, turn: nothing, peak: nothing }
    }

    /// Follows the trajectory for so many forcing periods; [`Extent::NONE`] where it has to be given up.
    pub fn follow(mut self, flight: &Flight<T, N>, periods: u32) -> Extent {
        for _ in 0..periods {
            if !self.follow_to_strobe(flight) {
                return Extent::NONE;
            }
            for (all, turn) in self.squares.iter_mut().zip(&mut self.turn) {
                *all = *all + *turn;
                *turn = T::zero();
            }
        }
        let time = T::of(f64::from(periods)) * (T::of(f64::from(flight.steps)) * flight.h);
        Extent::of(&self.squares.map(|sum| (sum / time).widen()), &self.peak.map(T::widen))
    }

    /// Follows it to the next phase 0; false where it has to be given up.
    fn follow_to_strobe(&mut self, flight: &Flight<T, N>) -> bool {
        let mut moves = Moves::default();
        loop {
            let (before, offset, held) =
                (self.trajectory.point, self.trajectory.offset, self.trajectory.contact);
            let event = self.trajectory.advance(flight, &mut []).event;
            let until = if event.code().ends_step() { flight.h } else { self.trajectory.offset };
            let contact = if matches!(event, Event::Released(_)) { self.trajectory.contact } else { held };
            self.note(flight, &before, until - offset, contact);
            moves.add();
            if matches!(event, Event::Strobe) {
                return self.trajectory.point.state.is_bounded();
            }
            if moves.are_too_many() {
                return false;
            }
        }
    }

    /// Notes a piece of flight from a point on.
    #[inline(always)]
    fn note(&mut self, flight: &Flight<T, N>, before: &Point<T, N>, time: T, contact: Contact) {
        let quarter = T::of(0.25) * time;
        let mut from = before.state;
        for half in [T::zero(), T::of(2.0)] {
            let middle = before.flown(flight, (half + T::one()) * quarter, contact).state;
            let end = before.flown(flight, (half + T::of(2.0)) * quarter, contact).state;
            self.note_half(&from, &middle, &end, quarter);
            from = end;
        }
    }

    /// Notes half a piece of flight, from its states at both ends and in the middle, a quarter of the piece from either.
    #[inline(always)]
    fn note_half(&mut self, from: &State<T, N>, middle: &State<T, N>, end: &State<T, N>, quarter: T) {
        for i in 0..N {
            let [a, m, b] = [from.x[i], middle.x[i], end.x[i]];
            let [va, vm, vb] = [from.v[i], middle.v[i], end.v[i]];
            let values = T::of(7.0) * (a * a + b * b) + T::of(16.0) * (m * m);
            let slopes = T::of(2.0) * quarter * (a * va - b * vb);
            self.turn[i] = self.turn[i] + (quarter / T::of(15.0)) * (values + slopes);
            let mut peak = larger(larger(larger(self.peak[i], a.abs()), m.abs()), b.abs());
            peak = turned(peak, quarter, [a, va], [m, vm]);
            self.peak[i] = turned(peak, quarter, [m, vm], [b, vb]);
        }
    }
}

#[inline(always)]
fn larger<T: Real>(a: T, b: T) -> T {
    if a > b { a } else { b }
}

/// The larger of a peak and of the modulus at a turning point of the cubic over a time, between two values with their slopes.
#[inline(always)]
fn turned<T: Real>(peak: T, time: T, [a, va]: [T; 2], [b, vb]: [T; 2]) -> T {
    if va * vb >= T::zero() {
        return peak;
    }
    let two = T::of(2.0);
    let share = va / (va - vb);
    let rest = T::one() - share;
    let value = a * rest * rest * (T::one() + two * share)
        + b * share * share * (T::of(3.0) - two * share)
        + time * share * rest * (va * rest - vb * share);
    larger(peak, value.abs())
}
