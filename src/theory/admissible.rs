//! Whether the system really moves like a solution of the matching equations.

use std::f64::consts::TAU;

use thiserror::Error;

use super::flow::{PHASE, V1_PLUS, V2, X2};
use super::motion::PeriodicMotion;
use super::newton::next;
use crate::dynamics::{Event, Stop, Trajectory};
use crate::model::{Flight, State};

/// How far an impact may be from where the solution has it, relative to states of order one.
const TOLERANCE: f64 = 1e-8;

/// Why no trajectory follows a solution of the matching equations.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum Inadmissible {
    /// It would leave its stop outwards.
    #[error("wrong velocity sign: it would leave stop {stop} outwards, with v1 = {velocity}")]
    WrongVelocity {
        /// The stop.
        stop: Stop,
        /// v1+.
        velocity: f64,
    },
    /// It would pass through a stop before its next impact.
    #[error("crosses a stop: it would pass through stop {stop} at phase {phase} on the way")]
    CrossesStop {
        /// The stop.
        stop: Stop,
        /// Forcing phase at which it gets there, mod 2π.
        phase: f64,
    },
    /// The first mass would come to rest on a stop.
    #[error("sticks: the first mass would come to rest on stop {0}")]
    Sticks(Stop),
    /// The next impact is not met where it should be.
    #[error("misses stop {0}: the impact that should follow does not happen")]
    Misses(Stop),
}

impl Inadmissible {
    /// The name of the reason.
    pub fn name(&self) -> &'static str {
        match self {
            Inadmissible::WrongVelocity { .. } => "wrong velocity sign",
            Inadmissible::CrossesStop { .. } => "crosses a stop",
            Inadmissible::Sticks(_) => "sticks",
            Inadmissible::Misses(_) => "misses a stop",
        }
    }
}

/// (x1, x2, v1, v2) at forcing phase 0 where a motion meets it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Flown {
    /// None if the motion is not met there.
    pub at_phase_zero: Option<[f64; 4]>,
}

/// Follows every arc of a motion with the certified flight of the simulation.
///
/// Each arc begins anew at its impact, so that unstable motions are followed as well as stable ones.
pub(crate) fn fly(flight: &Flight<f64, 2>, motion: &PeriodicMotion) -> Result<Flown, Inadmissible> {
    let mut flown = Flown { at_phase_zero: None };
    for (i, section) in motion.sections.iter().enumerate() {
        let stop = motion.pattern.stops[i];
        let due = next(&motion.pattern, &motion.sections, i);
        let velocity = section[V1_PLUS];
        if stop.side::<f64>() * velocity > 0.0 {
            return Err(Inadmissible::WrongVelocity { stop, velocity });
        }
        let scale = 1.0 + velocity.abs() + due.section[V1_PLUS].abs();
        let x1 = stop.side::<f64>() * flight.normals[0].gap[0];
        let start = State { x: [x1, section[X2]], v: [velocity, section[V2]] };
        let mut trajectory = Trajectory::at_phase(flight, start, wrapped(section[PHASE]));
        let time = (due.section[PHASE] - section[PHASE]) / flight.omega;
        let mut elapsed = 0.0;
        loop {
            let taken = trajectory.advance(flight, &mut ());
            elapsed += taken.time;
            let speed = (due.section[V1_PLUS] / flight.normals[0].restitution[0].max(0.1)).abs() + TOLERANCE;
            // A time is as uncertain as the place is over the speed.
            let early = (time - elapsed) * speed > TOLERANCE * scale;
            match taken.event {
                Event::Impact(impact) => {
                    let here = wrapped(section[PHASE] + flight.omega * elapsed);
                    if impact.stop != due.stop || early {
                        return Err(Inadmissible::CrossesStop { stop: impact.stop, phase: here });
                    }
                    if (impact.velocity_after - due.section[V1_PLUS]).abs() > TOLERANCE * scale {
                        return Err(Inadmissible::Misses(due.stop));
                    }
                    break;
                }
                Event::Caught { impact, .. } if early => return Err(Inadmissible::Sticks(impact.stop)),
                Event::Caught { impact, .. } => {
                    if impact.stop != due.stop {
                        return Err(Inadmissible::Sticks(impact.stop));
                    }
                    break;
                }
                Event::Strobe => {
                    flown.at_phase_zero.get_or_insert(values(&trajectory.point.state));
                }
                Event::HalfPeriod if motion.pattern.mirrored => {
                    // Its mirror image is met at phase 0.
                    flown.at_phase_zero.get_or_insert(values(&trajectory.point.state).map(|value| -value));
                }
                Event::Flight | Event::StepEnd | Event::HalfPeriod | Event::Released(_) => {}
            }
            if (elapsed - time) * speed > TOLERANCE * scale {
                return Err(Inadmissible::Misses(due.stop));
            }
        }
    }
    Ok(flown)
}

/// A phase in [0, 2π).
pub(crate) fn wrapped(phase: f64) -> f64 {
    let phase = phase.rem_euclid(TAU);
    if phase < TAU { phase } else { 0.0 }
}

/// (x1, x2, v1, v2) of a state.
pub(crate) fn values(state: &State<f64, 2>) -> [f64; 4] {
    std::array::from_fn(|i| state.get(i))
}
