//! Motion that can never impact again.

use pulp::NullaryFnOnce;

use crate::dynamics::Point;
use crate::model::vector::{added, applied, dot};
use crate::model::{Flight, Real};

/// Whether free motion from this strobe point on stays between the stops for ever.
///
/// The deviation y from the forced response lets a quadratic form E = yᵀPy decay or at most stay (twice the energy where
/// that is one), and d·x of a deviation is at most √(E dᵀ(P⁻¹)d); so d·x stays within that plus the farthest reach of
/// the forced response.
#[inline(always)]
pub fn is_quiet<T: Real, const N: usize>(flight: &Flight<T, N>, point: &Point<T, N>) -> bool {
    flight.quiet.exists && T::fused(StaysBetween { flight, point })
}

/// See [`is_quiet`]; a type of its own, since what a closure does is not compiled with the instructions that are asked for.
struct StaysBetween<'a, T, const N: usize> {
    flight: &'a Flight<T, N>,
    point: &'a Point<T, N>,
}

impl<T: Real, const N: usize> NullaryFnOnce for StaysBetween<'_, T, N> {
    type Output = bool;

    #[inline(always)]
    fn call(self) -> bool {
        let StaysBetween { flight, point } = self;
        stays_between(flight, point)
    }
}

#[inline(always)]
fn stays_between<T: Real, const N: usize>(flight: &Flight<T, N>, point: &Point<T, N>) -> bool {
    let quiet = &flight.quiet;
    let away = point.state.plus(-T::one(), &quiet.forced);
    let first = added(&applied(&quiet.xx, &away.x), &applied(&quiet.xv, &away.v));
    let second = applied(&quiet.vv, &away.v);
    let size = (dot(&first, &first) + dot(&second, &second)).sqrt();
    let mut stays = true;
    for normal in flight.normals() {
        let stretch = normal.stretch * size;
        stays &= normal.reach[0] + stretch < normal.gap[0] && normal.reach[1] + stretch < normal.gap[1];
    }
    stays
}
