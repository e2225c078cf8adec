//! Observers side by side: each lane follows one to its verdict, then takes the next.

use super::queue::{Queue, Source};
use super::schedule::Schedule;
use super::side::{Side, bits};
use crate::dynamics::Usage;
use crate::model::Lanes;

/// Contacts are looked for when nine of sixteen trajectories wait for one: where half of them were enough, lanes would fall into
/// two halves that wait by turns, in f32 on a map a quarter slower.
const WAITING: u32 = 9;
/// See [`WAITING`].
const OF_ALL: u32 = 16;
/// Steps that are tried on the GPU between two contacts.
pub const CLEAR_STEPS: u32 = 4;
/// Rounds of steps and contacts on the GPU before what is rare is looked at.
pub const ROUNDS: u32 = 16;
/// Turns of such rounds on the GPU, each up to phase 0 at the latest, before lanes with something rare have waited enough.
pub const TURNS: u32 = 8;
/// Whole steps on a stop on the GPU after them, before what is rare about it is looked at.
pub const HELD_STEPS: u32 = 32;

/// Follows everything in a queue, in as many lanes as `zero` has, each trajectory exactly as
/// [`Observer::follow`](super::Observer::follow) does; all cells have `normals` contact normals.
///
/// What is computed for one lane is computed for all of them: those that carry a tangent along are followed side by side, and the
/// others apart from them, by turns. When no more begin, those that are left stay where they are.
#[inline(always)]
pub fn follow_abreast<L: Lanes, const N: usize, Q: Queue<L::Real, N>>(
    zero: L,
    normals: usize,
    schedule: &Schedule,
    queue: &mut Q,
) {
    let mut source = Source::new(queue, L::WIDTH);
    let mut sides = [false, true].map(|observed| Side::<L, N, Q>::new(zero, normals, observed));
    let mut observed = false;
    while !source.is_given_up() {
        let idle = sides[usize::from(!observed)].busy == 0;
        let side = &mut sides[usize::from(observed)];
        side.fill_all(schedule, &mut source);
        if side.busy == 0 && idle && source.is_empty(!observed) && source.is_empty(observed) {
            break;
        }
        while side.busy > 0 && !side.gives_way(&source, idle) {
            let phases = side.abreast.fly((WAITING * side.busy).div_ceil(OF_ALL));
            if phases > 0 {
                side.pass_phases(phases, schedule, &mut source);
                continue;
            }
            let round = side.abreast.cross();
            side.pass_phases(round.phases, schedule, &mut source);
            for lane in bits(round.uncertain) {
                side.go_warily(lane, schedule, &mut source);
            }
        }
        observed = !observed;
    }
    let mut usage = Usage::default();
    for side in &sides {
        usage += side.abreast.usage();
    }
    source.queue.used(usage);
}
