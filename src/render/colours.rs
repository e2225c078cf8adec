//! Steady colours: a motion looks the same in every map.
//!
//! Common motions have hues of their own, chosen so that all of them, and everything that is not periodic, can
//! be told apart with red-blind and green-blind eyes too. Other motions take a hue that depends on nothing but
//! the label. Each hue has two tones: for symmetric and unsymmetric motions, or for the mirror images N-p-q and
//! N-q-p. Motions with sticking are hatched. Where two motions of one picture would look alike, the rarer one takes a
//! spare colour (see [`Colouring`](super::colouring::Colouring)).

use super::motion::Motion;
use crate::analysis::{INFINITELY_MANY, Regime};
use crate::figure::{Colour, INK, Paint, hex};

/// The points of sections and diagrams.
pub(super) const STEADY_BLUE: Colour = hex(0x1d4f87);
/// What is set against them: the other branch of a diagram.
pub(super) const OTHER_BRANCH: Colour = hex(0xd1600a);
/// Impacts in a time series.
pub(super) const STRIKING: Colour = hex(0xc2410c);
/// The stops.
pub(super) const STOP: Colour = hex(0x8a8f98);
/// Stretches of sticking.
pub(super) const STICKING: Colour = hex(0xf3dfa2);
/// Stretches of chatter without sticking.
pub(super) const CHATTERING: Colour = hex(0xe3ecf5);

const CHAOTIC: Colour = hex(0x17171b);
const QUASI_PERIODIC: Colour = hex(0x5d2a94);
const NO_IMPACT: Colour = hex(0xf6f6f4);
const UNRESOLVED: Colour = hex(0xbac3c6);
const APERIODIC_STICKING: Colour = hex(0x60665d);
const FAILED: Colour = hex(0xff00ff);
const BEYOND_A_STOP: Colour = hex(0xdad6d0);
const WHITE: Colour = hex(0xffffff);

/// The two tones of a hue: symmetric and unsymmetric, or more impacts at Ā and more impacts at A.
type Tones = [Colour; 2];

/// The hues of common motions N-p-q with p ≤ q.
const COMMON: [([u16; 3], Tones); 11] = [
    ([1, 1, 1], tones(0x276dad, 0xb7d9ff)),
    ([1, 2, 2], tones(0xc45500, 0xdeb47b)),
    ([2, 2, 2], tones(0x0d7a63, 0x3dba99)),
    ([1, 1, 2], tones(0x409259, 0xaae8b6)),
    ([2, 4, 4], tones(0xa39413, 0xe2cf37)),
    ([1, 3, 3], tones(0xb11834, 0xe1787e)),
    ([3, 3, 3], tones(0x5e3e00, 0xbe9635)),
    ([1, 0, 1], tones(0x246a78, 0x628f98)),
    ([1, 4, 4], tones(0x78144f, 0xca90c5)),
    ([1, INFINITELY_MANY, INFINITELY_MANY], tones(0xa9bd4a, 0xebf997)),
    ([1, 0, INFINITELY_MANY], tones(0x8f8440, 0xcfc68a)),
];

/// The hues that all other motions share.
const OTHERS: [Tones; 9] = [
    tones(0x9a715e, 0xcbb0a9),
    tones(0x665e7e, 0x908c9e),
    tones(0x506628, 0x91a582),
    tones(0x8c79c7, 0xb0a7f4),
    tones(0x756346, 0xa7947e),
    tones(0xdb7554, 0xfaa894),
    tones(0x875872, 0xab8494),
    tones(0x8c5615, 0xd49059),
    tones(0x739141, 0x95c47d),
];

/// What motions without a colour of their own share.
pub(super) const SHARED: Paint = Paint::plain(hex(0x7e767e));

/// What is not computed yet.
pub(super) const NOT_THERE: Paint = Paint::hatched(hex(0xffffff), hex(0xc9c9c9));

/// Colours for motions whose own would be taken for another one's; distinct from each other, from the common hues and from
/// what is not periodic, to every eye.
pub(super) const SPARE: [u32; 25] = [
    0x8282ca, 0x82a6a6, 0xeeee94, 0xca04a6, 0x284c5e, 0x94b8ee, 0x943a4c, 0x0404ee, 0xeedcee, 0xee164c,
    0x3a5e28, 0x5e8228, 0xb8b804, 0x82043a, 0xdcb8dc, 0xa6cab8, 0x94a65e, 0x5e4c82, 0xdc4c94, 0x040470,
    0x284cee, 0x163a16, 0x282870, 0x0404b8, 0x3a043a,
];

/// What the region of a motion is filled with where nothing else is to be told from it; depends on nothing else.
pub fn paint_of(motion: Motion) -> Paint {
    match motion.regime {
        Regime::Unresolved => Paint::plain(UNRESOLVED),
        Regime::NoImpact => Paint::plain(NO_IMPACT),
        Regime::Periodic => Paint::plain(tone_of(motion)),
        Regime::PeriodicSticking => Paint::hatched(tone_of(motion), INK),
        Regime::QuasiPeriodic => Paint::plain(QUASI_PERIODIC),
        Regime::Chaotic => Paint::plain(CHAOTIC),
        Regime::AperiodicSticking => Paint::hatched(APERIODIC_STICKING, WHITE),
        Regime::Failed => Paint::plain(FAILED),
        // As drawings hatch what is solid.
        Regime::Inadmissible => Paint::hatched(BEYOND_A_STOP, STOP),
    }
}

fn tone_of(motion: Motion) -> Colour {
    let [n, p, q, further @ ..] = motion.counts;
    // The impacts at further stops count with those at the second.
    let q = further.into_iter().fold(q, u16::saturating_add);
    let label = [n, p.min(q), p.max(q)];
    let common = COMMON.iter().find(|(common, _)| *common == label);
    let [first, second] = common.map_or_else(|| OTHERS[scattered(label) % OTHERS.len()], |(_, tones)| *tones);
    if motion.symmetric || p > q { first } else { second }
}

/// A number that depends on nothing but the label, and differently for labels that are alike: FNV-1a, stirred once more.
fn scattered(label: [u16; 3]) -> usize {
    let bytes = label.into_iter().flat_map(u16::to_le_bytes);
    let hash = bytes.fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    });
    ((hash ^ (hash >> 32)).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 40) as usize
}

const fn tones(first: u32, second: u32) -> Tones {
    [hex(first), hex(second)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::{DISTINCT, Seen};

    /// The differences that eyes see (CIEDE2000): that of most people, the red-, the green- and the blue-blind one.
    fn differences(a: Colour, b: Colour) -> [f64; 4] {
        Seen::of(a).differences(&Seen::of(b))
    }

    /// The smallest of them but the blue-blind one's, which is the rarest by far.
    fn difference(a: Colour, b: Colour) -> f64 {
        differences(a, b)[..3].iter().copied().fold(f64::INFINITY, f64::min)
    }

    fn motion(regime: Regime, [n, p, q]: [u16; 3], symmetric: bool) -> Colour {
        paint_of(Motion { regime, counts: [n, p, q, 0, 0], symmetric }).fill
    }

    fn not_periodic() -> Vec<(String, Colour)> {
        // What is inadmissible is told apart by its hatch.
        let regimes =
            Regime::ALL.into_iter().filter(|regime| !regime.is_periodic() && *regime != Regime::Inadmissible);
        regimes.map(|regime| (regime.name().to_owned(), motion(regime, [0; 3], false))).collect()
    }

    fn assert_distinct(colours: &[(String, Colour)], least: f64) {
        for (i, (a, first)) in colours.iter().enumerate() {
            for (b, second) in &colours[..i] {
                let found = difference(*first, *second);
                assert!(found >= least, "{a} and {b} differ by {found}");
            }
        }
    }

    #[test]
    fn regimes_and_common_motions_are_told_apart_by_every_eye() {
        let mut colours = not_periodic();
        for counts in [[1, 1, 1], [1, 2, 2], [1, 3, 3], [3, 3, 3], [1, 4, 4]] {
            for symmetric in [true, false] {
                colours
                    .push((format!("{counts:?} {symmetric}"), motion(Regime::Periodic, counts, symmetric)));
            }
        }
        for counts in [[2, 2, 2], [2, 4, 4], [1, 1, 2], [1, 2, 1], [1, 0, 1], [1, 1, 0]] {
            colours.push((format!("{counts:?}"), motion(Regime::Periodic, counts, false)));
        }
        assert_eq!(colours.len(), 22);
        assert_distinct(&colours, 10.0);
    }

    #[test]
    fn other_motions_are_not_taken_for_chaos_or_for_1_1_1() {
        let mut reserved = not_periodic();
        reserved.extend(COMMON[0].1.map(|tone| ("1-1-1".to_owned(), tone)));
        for tones in OTHERS {
            for (name, colour) in &reserved {
                let found = tones.map(|tone| difference(tone, *colour));
                assert!(
                    found.into_iter().all(|each| each >= 7.0),
                    "{tones:?} and {name} differ by {found:?}"
                );
            }
            let found = difference(tones[0], tones[1]);
            assert!(found >= 12.0, "{tones:?} differ by {found}");
        }
    }

    #[test]
    fn other_motions_are_not_taken_for_common_ones() {
        let common = COMMON.iter().flat_map(|(label, tones)| tones.map(|tone| (label, tone)));
        for (label, colour) in common {
            for tone in OTHERS.into_iter().flatten() {
                let [found, ..] = differences(tone, colour);
                assert!(found >= 10.0, "{tone:?} and {label:?} differ by {found}");
            }
        }
    }

    #[test]
    fn spare_colours_are_distinct_from_all_that_is_common_to_every_eye() {
        let mut taken = not_periodic();
        taken.retain(|(name, _)| name != Regime::AperiodicSticking.name()); // hatched in white: told apart by that
        taken.push(("shared".to_owned(), SHARED.fill));
        taken.extend(
            COMMON
                .iter()
                .filter(|(label, _)| label[2] != INFINITELY_MANY)
                .flat_map(|(label, tones)| tones.map(|tone| (format!("{label:?}"), tone))),
        );
        for spare in SPARE.map(hex) {
            for (name, colour) in &taken {
                let found = Seen::of(spare).difference(&Seen::of(*colour));
                assert!(found >= DISTINCT, "{spare:?} and {name} differ by {found}");
            }
            taken.push(("another spare".to_owned(), spare));
        }
    }

    #[test]
    fn mirror_images_and_broken_symmetry_keep_the_hue() {
        let tones: Vec<Tones> = COMMON.iter().map(|(_, tones)| *tones).chain(OTHERS).collect();
        let pair = |a, b| [motion(Regime::Periodic, a, true), motion(Regime::Periodic, b, false)];
        for [n, p, q] in [[1, 2, 1], [5, 7, 3], [1, 1, 0], [2, 9, 4], [1, 1, 1], [3, 8, 8], [6, 6, 6]] {
            assert!(tones.contains(&pair([n, p, q], [n, q, p])), "{n}-{p}-{q}");
        }
    }

    #[test]
    fn a_motion_with_sticking_is_the_motion_hatched() {
        let of = |regime| paint_of(Motion { regime, counts: [1, 2, 2, 0, 0], symmetric: true });
        let (free, sticking) = (of(Regime::Periodic), of(Regime::PeriodicSticking));
        assert_eq!(free.fill, sticking.fill);
        assert!(free.hatch.is_none() && sticking.hatch.is_some());
    }

    #[test]
    fn what_is_inadmissible_is_hatched_as_nothing_else() {
        let paint = |regime| paint_of(Motion { regime, counts: [1, 1, 1, 0, 0], symmetric: false });
        let inadmissible = paint(Regime::Inadmissible);
        let hatch = inadmissible.hatch.unwrap();
        assert!(difference(inadmissible.fill, hatch) >= 20.0);
        for regime in Regime::ALL.into_iter().filter(|regime| *regime != Regime::Inadmissible) {
            let other = paint(regime);
            let differ = |own: Colour| difference(own, other.hatch.unwrap_or(other.fill));
            assert!(differ(hatch).max(differ(inadmissible.fill)) >= 15.0, "{}", regime.name());
            assert!(other.hatch.is_none_or(|other| differ(hatch) >= 10.0 && other != hatch));
        }
        assert!(difference(NOT_THERE.hatch.unwrap(), hatch) >= 10.0);
    }

    #[test]
    fn colours_do_not_change_between_versions() {
        assert_eq!(motion(Regime::Periodic, [1, 1, 1], true), hex(0x276dad));
        assert_eq!(motion(Regime::Periodic, [3, 4, 5], false), OTHERS[2][1]);
    }

    #[test]
    fn labels_are_spread_over_the_hues() {
        let mut uses = [0; OTHERS.len()];
        for n in 3..12 {
            for p in 1..8 {
                uses[scattered([n, p, p]) % OTHERS.len()] += 1;
            }
        }
        assert!(uses.into_iter().all(|count| count >= 2), "{uses:?}");
    }
}
