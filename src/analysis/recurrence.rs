//! Periodicity: whether the strobe state returns, and keeps returning.

use super::regime::INFINITELY_MANY;
use crate::dynamics::{Point, Stop, Unseen};
use crate::model::vector::{MOST, applied};
use crate::model::{Flight, Real, State};

/// How many times farther than its returns the state must be after a divisor of N. An alternation with the multiplier −μ
/// returns within 1 − μᵏ of its size over k periods.
pub const DISTINCT: f64 = 1e3;

/// The share of its largest distance from the anchor by which a return may go farther than those before, for the motion to
/// come closer quickly: the present is then that much closer to where it goes than the anchor was.
pub const QUICKLY: f64 = 0.25;

/// The share of the time since the start, one in so many, for which a state's return is waited for in the transient: what
/// was met early is no part of the motion that is reached.
pub const PATIENCE_SHARE: u32 = 4;
/// The share of the distance of returns that led astray within which the next must be: those as far, but for rounding, are no
/// more to be trusted.
pub const NEARER: f64 = 0.98;
/// How much farther than a return a state may be to be looked at.
const NEARLY_RETURNED: f64 = 1.001;

/// How many times a state must have returned before it counts as periodic.
pub const LEAST_RETURNS: u32 = 3;

/// A distance beyond all distances, in either precision.
pub const FARTHEST: f64 = 3e38;

/// For how many periods a state's return is waited for in a transient that is so many periods old.
#[inline(always)]
pub fn patience(periods: u32, max_period: u32) -> u32 {
    (periods / PATIENCE_SHARE).min(max_period).max(1)
}

/// Looks for a period in O(1) memory: remembers one strobe state, its anchor, and compares every later one.
///
/// The first return gives N; every N periods after it the state must return again, with the same impacts in
/// between. A miss moves the anchor to the present and the search starts over.
///
/// Small alternations return within any tolerance that they are smaller than, and miss later, or not with the same impacts:
/// after a miss only nearer returns count, until they have been waited for in vain.
///
/// A return alone proves no period: a spiral that still shrinks returns, and so does every second turn of an alternation
/// that dies out slowly. Half-way through the observation the anchor therefore moves along with the motion, so that
/// [`Recurrence::is_settled`] can ask whether the returns come closer, and whether the motion has no shorter period.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Recurrence<T, const N: usize> {
    anchor: State<T, N>,
    /// Periods since the anchor.
    pub since: u32,
    /// Periods of returns before it, with an anchor that has moved along since.
    kept: u32,
    /// N, or 0 while there was no return.
    pub n: u32,
    /// Impacts at each stop in the first cycle after the anchor.
    pub impacts: [u32; MOST],
    /// Impacts at each stop in the present cycle.
    running: [u32; MOST],
    /// The largest distance of a return from the anchor, where that is now.
    worst: T,
    /// The same before the anchor moved along with the motion.
    early: T,
    /// Whether the last return went hardly farther than those before; see [`QUICKLY`].
    quickly: bool,
    /// Whether the anchor has moved along with the motion, or began in the later half.
    moved: bool,
    /// The smallest distance from the anchor after a proper divisor of N.
    apart: T,
    /// Within this a first return must be; see [`NEARER`].
    trusted: T,
    /// Whether the state half a cycle after the last full one was its mirror image.
    pub symmetric: bool,
}

impl<T: Real, const N: usize> Recurrence<T, N> {
    /// Begins with the state of a strobe as the anchor.
    pub fn anchored(state: State<T, N>) -> Self {
        Recurrence {
            anchor: state,
            since: 0,
            kept: 0,
            n: 0,
            impacts: [0; MOST],
            running: [0; MOST],
            worst: T::zero(),
            early: T::zero(),
            quickly: false,
            moved: false,
            apart: T::of(FARTHEST),
            trusted: T::of(FARTHEST),
            symmetric: false,
        }
    }

    /// The state that every later one is compared with.
    pub fn anchor(&self) -> State<T, N> {
        self.anchor
    }

    /// Counts an impact; infinitely many if it ends a complete chatter sequence.
    #[inline(always)]
    pub fn count(&mut self, stop: Stop, complete_chatter: bool) {
        if complete_chatter {
            self.running[stop.index()] = u32::from(INFINITELY_MANY);
        } else {
            self.count_finite(stop, 1);
        }
    }

    /// Counts impacts none of which ends a complete chatter sequence.
    #[inline(always)]
    pub fn count_finite(&mut self, stop: Stop, impacts: u32) {
        let running = &mut self.running[stop.index()];
        let most = u32::from(INFINITELY_MANY) - 1;
        *running = if *running < most { (*running + impacts).min(most) } else { *running };
    }

    /// Whether the phase π after the last strobe is half a cycle after a return: an odd cycle may show its mirror image there.
    #[inline(always)]
    pub fn awaits_mirror(&self, flight: &Flight<T, N>) -> bool {
        flight.mirror.is_some() && self.n % 2 == 1 && self.since % self.n == self.n / 2
    }

    /// Sees the state at phase π.
    #[inline(always)]
    pub fn at_half_period(&mut self, flight: &Flight<T, N>, point: &Point<T, N>, tolerance: T) {
        let Some(mirror) = &flight.mirror else { return };
        if self.awaits_mirror(flight) {
            let mirrored = State { x: applied(mirror, &point.state.x), v: applied(mirror, &point.state.v) };
            self.symmetric = distance(flight, &mirrored, &self.anchor) <= tolerance;
        }
    }

    /// Sees the state at phase 0; `late` is the later half of the time in which the motion is to be compared with itself.
    #[inline(always)]
    pub fn at_strobe(
        &mut self,
        flight: &Flight<T, N>,
        point: &Point<T, N>,
        tolerance: T,
        max_period: u32,
        late: bool,
    ) {
        self.since += 1;
        let away = distance(flight, &point.state, &self.anchor);
        if self.n == 0 {
            if away <= tolerance && away <= self.trusted {
                self.n = self.since;
                self.impacts = self.running;
                self.returned(away);
            } else if self.since >= max_period {
                self.start_over(point, late, T::of(FARTHEST));
            }
        } else if self.since.is_multiple_of(self.n) {
            if self.running == self.impacts && away <= tolerance {
                self.returned(away);
                if late && !self.moved {
                    self.move_along(point);
                }
            } else {
                self.start_over(point, late, T::of(NEARER) * self.farthest());
            }
        } else if self.n.is_multiple_of(self.since % self.n) {
            self.apart = if away < self.apart { away } else { self.apart };
        }
    }

    /// In the transient: after `periods` of returns, or a few where it comes closer quickly, the motion is compared with its
    /// present self, so that one that comes closer is seen to come to rest. Returns that go farther than before do not count.
    #[inline(always)]
    pub fn follow_along(&mut self, point: &Point<T, N>, periods: u32) {
        let due = self.holds_for(periods) || self.holds_for(0) && self.quickly;
        if due && !self.is_within(T::of(T::AT_REST)) && self.since.is_multiple_of(self.n) {
            let nearer = self.early == T::zero() || self.worst <= self.early;
            self.kept = if nearer { self.kept + self.since } else { 0 };
            self.since = 0;
            self.move_along(point);
        }
    }

    /// Whether the state has kept returning for at least `periods`, whatever it was compared with, and often enough since the
    /// anchor.
    #[inline(always)]
    pub fn kept_for(&self, periods: u32) -> bool {
        self.holds_for(0) && self.kept + self.since >= periods
    }

    /// How many strobes of the transient it need not see, the trajectory being so many periods old, while the state stays off the
    /// anchor: those at which its return is still waited for, so that the anchor stays; see [`patience`]. None after a return.
    pub fn unseen(&self, flight: &Flight<T, N>, periods: u32, max_period: u32) -> Unseen<T, N> {
        // As many k as have since + k < (periods + k) / PATIENCE_SHARE and since + k < max_period.
        let first = self.since + 1;
        let by_age = periods.saturating_sub(PATIENCE_SHARE * first) / (PATIENCE_SHARE - 1);
        self.unseen_within(flight, T::RETURNING, by_age, max_period)
    }

    /// The same where a return within a tolerance is waited for, for `max_period` from the anchor on: `most` of them.
    #[inline(always)]
    pub fn unseen_within(
        &self,
        flight: &Flight<T, N>,
        tolerance: f64,
        most: u32,
        max_period: u32,
    ) -> Unseen<T, N> {
        let strobes = max_period.saturating_sub(self.since + 1).min(most);
        if self.n != 0 || strobes == 0 {
            return Unseen::none();
        }
        let mut size = flight.unit;
        for i in 0..2 * N {
            size = self.anchor.get(i).abs().max(size);
        }
        let nearest = T::of(NEARLY_RETURNED * tolerance) * size;
        Unseen { strobes, anchor: self.anchor, nearest, scattering: None }
    }

    /// Counts strobes that it did not see.
    pub fn pass(&mut self, strobes: u32) {
        self.since += strobes;
    }

    #[inline(always)]
    fn start_over(&mut self, point: &Point<T, N>, late: bool, trusted: T) {
        *self = Recurrence { moved: late, trusted, ..Self::anchored(point.state) };
    }

    /// The largest distance of a return from its anchor, before that moved along with the motion or since.
    #[inline(always)]
    fn farthest(&self) -> T {
        if self.early > self.worst { self.early } else { self.worst }
    }

    /// The motion is compared with its present self from now on.
    #[inline(always)]
    fn move_along(&mut self, point: &Point<T, N>) {
        self.anchor = point.state;
        self.moved = true;
        self.early = self.worst;
        self.worst = T::zero();
    }

    #[inline(always)]
    fn returned(&mut self, away: T) {
        self.running = [0; MOST];
        let worst = if away > self.worst { away } else { self.worst };
        self.quickly = worst - self.worst <= T::of(QUICKLY) * worst;
        self.worst = worst;
    }

    /// Whether the state has kept returning for at least `periods`, and at least [`LEAST_RETURNS`] times.
    #[inline(always)]
    pub fn holds_for(&self, periods: u32) -> bool {
        self.n > 0 && self.since >= periods && self.since >= LEAST_RETURNS * self.n
    }

    /// Whether no return was farther from the anchor than this.
    #[inline(always)]
    pub fn is_within(&self, tolerance: T) -> bool {
        self.worst <= tolerance
    }

    /// Whether N is the period of a motion that was reached: the returns are as close as rounding lets them be, or come
    /// closer by the half, and a turn by a divisor of N ends clearly elsewhere.
    pub fn is_settled(&self) -> bool {
        let comes_closer = self.worst <= T::of(T::SETTLED) && self.worst + self.worst <= self.early;
        (self.worst <= T::of(T::ROUNDING) || comes_closer) && self.apart >= T::of(DISTINCT) * self.farthest()
    }
}

/// The largest difference of two states' components: in units of [`Flight::unit`] for states of order one and less, relative above.
#[inline(always)]
pub(super) fn distance<T: Real, const N: usize>(
    flight: &Flight<T, N>,
    state: &State<T, N>,
    anchor: &State<T, N>,
) -> T {
    let mut distance = T::zero();
    let mut size = flight.unit;
    for i in 0..2 * N {
        let difference = (state.get(i) - anchor.get(i)).abs();
        distance = if difference > distance { difference } else { distance };
        let extent = anchor.get(i).abs();
        size = if extent > size { extent } else { size };
    }
    distance / size
}

#[cfg(test)]
mod tests;
