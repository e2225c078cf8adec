//! Lanes one by one, at every width that this processor has.

use super::*;
use crate::model::width::{AtWidth, at_every_width};

/// Sets every second lane of numbers and of a truth value, from the last one down, and takes one back.
fn lanes_are_set_one_by_one<L: Lanes<Real = f64>>(zero: L) {
    let never = zero.below(zero);
    assert_eq!((never.bits(), L::Mask::WIDTH), (0, L::WIDTH));
    let (mut numbers, mut mask, mut expected) = (zero, never, 0);
    for lane in (0..L::WIDTH).rev().step_by(2) {
        for _ in 0..2 {
            numbers.renew_lane(lane, 1.0 + lane as f64);
        }
        mask.set_lane(lane, true);
        expected |= 1 << lane;
        assert_eq!(mask.bits(), expected, "lane {lane} of {}", L::WIDTH);
        assert_eq!(zero.below(numbers).bits(), expected, "lane {lane} of {}", L::WIDTH);
    }
    let kept = L::select(mask, numbers, zero.all(-1.0));
    for lane in 0..L::WIDTH {
        let set = (expected >> lane) & 1 == 1;
        assert_eq!(kept.lane(lane), if set { 1.0 + lane as f64 } else { -1.0 });
    }
    mask.set_lane(L::WIDTH - 1, true);
    assert_eq!(mask.bits(), expected, "set already");
    mask.set_lane(L::WIDTH - 1, false);
    assert_eq!(mask.bits(), expected & !(1 << (L::WIDTH - 1)));
    assert_eq!(mask.not().and(never.not()).bits().count_ones(), L::WIDTH as u32 - mask.bits().count_ones());
}

/// The larger and the smaller number have the bits that a comparison chooses, of zeros and of what is no number too.
fn the_larger_is_what_a_comparison_chooses<L: Lanes<Real = f64>>(zero: L) {
    let numbers = [0.0, -0.0, 1.0, -2.5, f64::INFINITY, f64::NEG_INFINITY, f64::NAN];
    for one in numbers {
        for other in numbers {
            let (a, b) = (zero.all(one), zero.all(other));
            let chosen = [L::select(b.below(a), a, b), L::select(a.below(b), a, b)];
            for (found, chosen) in [a.larger(b), a.smaller(b)].into_iter().zip(chosen) {
                for lane in 0..L::WIDTH {
                    assert_eq!(found.lane(lane).to_bits(), chosen.lane(lane).to_bits(), "{one} and {other}");
                }
            }
        }
    }
}

/// A check that is made in lanes.
#[derive(Clone, Copy)]
enum Check {
    SetOneByOne,
    Larger,
}

impl AtWidth for Check {
    type Output = ();

    fn call<L: Lanes<Real = f64>>(self, zero: L) {
        match self {
            Check::SetOneByOne => lanes_are_set_one_by_one(zero),
            Check::Larger => the_larger_is_what_a_comparison_chooses(zero),
        }
    }
}

#[test]
fn lanes_of_every_width_are_set_one_by_one() {
    assert!(!at_every_width(Check::SetOneByOne).is_empty());
}

#[test]
fn the_larger_and_the_smaller_are_the_same_at_every_width() {
    assert!(!at_every_width(Check::Larger).is_empty());
}

/// A pack fills its register, and nothing lies between one and the next.
#[cfg(target_arch = "x86_64")]
#[test]
fn packs_lie_on_boundaries_of_their_size() {
    fn check<S: Registers>(size: usize) {
        assert_eq!([size_of::<Pack<S>>(), align_of::<Pack<S>>()], [size; 2]);
    }
    check::<pulp::x86::V3>(32);
    check::<pulp::x86::V4>(64);
}
