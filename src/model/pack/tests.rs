//! Lanes one by one, at every width that this processor has.

use num_traits::{Float, One};

use super::*;
use crate::model::real::Real;
use crate::model::width::{AtWidth, at_every_width};

/// Sets every second lane of numbers and of a truth value, from the last one down, and takes one back.
fn lanes_are_set_one_by_one<L: Lanes>(zero: L) {
    let numbered = |lane: usize| L::Real::of(1.0 + lane as f64);
    let never = zero.below(zero);
    assert_eq!((never.bits(), L::Mask::WIDTH), (0, L::WIDTH));
    let (mut numbers, mut mask, mut expected) = (zero, never, 0);
    for lane in (0..L::WIDTH).rev().step_by(2) {
        for _ in 0..2 {
            numbers.renew_lane(lane, numbered(lane));
        }
        mask.set_lane(lane, true);
        expected |= 1 << lane;
        assert_eq!(mask.bits(), expected, "lane {lane} of {}", L::WIDTH);
        assert_eq!(zero.below(numbers).bits(), expected, "lane {lane} of {}", L::WIDTH);
    }
    let kept = L::select(mask, numbers, zero.all(-1.0));
    for lane in 0..L::WIDTH {
        let set = (expected >> lane) & 1 == 1;
        assert_eq!(kept.lane(lane), if set { numbered(lane) } else { -L::Real::one() });
    }
    mask.set_lane(L::WIDTH - 1, true);
    assert_eq!(mask.bits(), expected, "set already");
    mask.set_lane(L::WIDTH - 1, false);
    assert_eq!(mask.bits(), expected & !(1 << (L::WIDTH - 1)));
    assert_eq!(mask.not().and(never.not()).bits().count_ones(), L::WIDTH as u32 - mask.bits().count_ones());
}

/// The larger and the smaller number have the bits that a comparison chooses, of zeros and of what is no number too.
fn the_larger_is_what_a_comparison_chooses<L: Lanes>(zero: L) {
    let numbers = [0.0, -0.0, 1.0, -2.5, f64::INFINITY, f64::NEG_INFINITY, f64::NAN];
    for one in numbers {
        for other in numbers {
            let (a, b) = (zero.all(one), zero.all(other));
            let chosen = [L::select(b.below(a), a, b), L::select(a.below(b), a, b)];
            for (found, chosen) in [a.larger(b), a.smaller(b)].into_iter().zip(chosen) {
                for lane in 0..L::WIDTH {
                    let [found, chosen] = [found, chosen].map(|lanes| lanes.lane(lane).widen().to_bits());
                    assert_eq!(found, chosen, "{one} and {other}");
                }
            }
        }
    }
}

/// A multiple and a term are rounded as often as one lane rounds them.
fn a_multiple_and_a_term_are_rounded_as_in_one_lane<L: Lanes>(zero: L) {
    // Once, and twice.
    let number = |value: f64| L::Real::of(value);
    let (a, term) = (number(1.0 + 1e-4), number(-1.0 - 2e-4));
    let one = a.times_plus(a, term);
    assert_ne!(a.mul_add(a, term), a * a + term, "the check can fail");
    let all = |value: L::Real| zero.all(value.widen());
    let found = all(a).times_plus(all(a), all(term));
    assert!((0..L::WIDTH).all(|lane| found.lane(lane) == one), "{found:?} for {one:?}");
}

/// Of numbers that differ from lane to lane, each lane gives what one lane gives.
fn lanes_are_computed_one_like_the_other<L: Lanes>(zero: L) {
    let number = |lane: usize, part: usize| L::Real::of(1.5 + (7 * lane + 3 * part) as f64);
    let filled = |part: usize| {
        let mut all = zero;
        (0..L::WIDTH).for_each(|lane| all.set_lane(lane, number(lane, part) - L::Real::of(9.0)));
        all
    };
    let [a, b, c] = [0, 1, 2].map(filled);
    let magnitude = a.magnitude();
    let found = [a + b, a - b, a * b, a / b, -a, magnitude, magnitude.root(), a.times_plus(b, c)];
    let chosen = [a.larger(zero), a.smaller(zero), L::select(a.below(zero), b, c)];
    for lane in 0..L::WIDTH {
        let [a, b, c] = [0, 1, 2].map(|part| number(lane, part) - L::Real::of(9.0));
        let zero = L::Real::of(0.0);
        let expected = [a + b, a - b, a * b, a / b, -a, a.abs(), a.abs().sqrt(), a.times_plus(b, c)];
        assert_eq!(found.map(|lanes| lanes.lane(lane)), expected, "lane {lane} of {}", L::WIDTH);
        let expected = [a.max(zero), a.min(zero), if a < zero { b } else { c }];
        assert_eq!(chosen.map(|lanes| lanes.lane(lane)), expected, "lane {lane} of {}", L::WIDTH);
    }
}

/// A check that is made in lanes.
#[derive(Clone, Copy)]
enum Check {
    SetOneByOne,
    Larger,
    TimesPlus,
    OneLikeTheOther,
}

impl<T: Real> AtWidth<T> for Check {
    type Output = ();

    fn call<L: Lanes<Real = T>>(self, zero: L) {
        match self {
            Check::SetOneByOne => lanes_are_set_one_by_one(zero),
            Check::Larger => the_larger_is_what_a_comparison_chooses(zero),
            Check::TimesPlus => a_multiple_and_a_term_are_rounded_as_in_one_lane(zero),
            Check::OneLikeTheOther => lanes_are_computed_one_like_the_other(zero),
        }
    }
}

/// In either precision.
fn holds_at_every_width(check: Check) {
    assert!(!at_every_width::<f64, _>(check).is_empty());
    assert!(!at_every_width::<f32, _>(check).is_empty());
}

#[test]
fn lanes_of_every_width_are_set_one_by_one() {
    holds_at_every_width(Check::SetOneByOne);
}

#[test]
fn the_larger_and_the_smaller_are_the_same_at_every_width() {
    holds_at_every_width(Check::Larger);
}

#[test]
fn multiples_with_a_term_are_the_same_at_every_width() {
    holds_at_every_width(Check::TimesPlus);
}

#[test]
fn operations_are_those_of_one_lane_in_every_lane() {
    holds_at_every_width(Check::OneLikeTheOther);
}

/// A pack fills its register, and nothing lies between one and the next.
#[test]
fn packs_lie_on_boundaries_of_their_size() {
    fn check<S: Registers>(size: usize) {
        assert_eq!([size_of::<Pack<S, f64>>(), align_of::<Pack<S, f64>>()], [size; 2]);
        assert_eq!([size_of::<Pack<S, f32>>(), align_of::<Pack<S, f32>>()], [size; 2]);
    }
    check::<pulp::x86::V3>(32);
    check::<pulp::x86::V4>(64);
}
