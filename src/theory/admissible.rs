//! Whether the system really moves like a solution of the matching equations.

use derive_more::Display;
use thiserror::Error;

use super::face::Face;
use super::flow::Flow;
use super::follower::{Follower, follower};
use super::matching::departure;
use super::newton::ends;
use super::pattern::Pattern;
use super::section_vector::{Node, SectionVector, phase, unit_about, wrapped};
use crate::dynamics::{Event, Impact, Stop};
use crate::model::System;

/// How far an impact may be from where the solution has it, relative to states of order one.
const TOLERANCE: f64 = 1e-8;

/// The least restitution from which on the speed before an impact is read from that after it.
const READ_BACK: f64 = 0.1;

/// A stop with its name in the family.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Display)]
#[display("{name}")]
pub struct NamedStop {
    /// The stop.
    pub stop: Stop,
    /// Its name, as it is easy to type.
    pub name: &'static str,
}

impl NamedStop {
    /// A stop of a system.
    pub fn of(system: &System, stop: Stop) -> Self {
        NamedStop { stop, name: system.stop_name(stop.index()) }
    }
}

/// Why no trajectory follows a solution of the matching equations.
#[derive(Clone, Copy, Debug, PartialEq, Error, strum::IntoStaticStr)]
pub enum Inadmissible {
    /// It would leave its stop outwards.
    #[error("wrong velocity sign: it would leave stop {stop} outwards, with v{} = {velocity}", coordinate + 1)]
    #[strum(serialize = "wrong velocity sign")]
    WrongVelocity {
        /// The stop.
        stop: NamedStop,
        /// The contact's own coordinate, counted from 0.
        coordinate: usize,
        /// Its velocity just after the impact.
        velocity: f64,
    },
    /// It would pass through a stop before its next impact.
    #[error("crosses a stop: it would pass through stop {stop} at phase {phase} on the way")]
    #[strum(serialize = "crosses a stop")]
    CrossesStop {
        /// The stop.
        stop: NamedStop,
        /// Forcing phase at which it gets there, mod 2π.
        phase: f64,
    },
    /// A mass would come to rest on a stop.
    #[error("sticks: a mass would come to rest on stop {0}")]
    #[strum(serialize = "sticks")]
    Sticks(NamedStop),
    /// The next impact is not met where it should be.
    #[error("misses stop {0}: the impact that should follow does not happen")]
    #[strum(serialize = "misses a stop")]
    Misses(NamedStop),
}

impl Inadmissible {
    /// The name of the reason.
    pub fn name(&self) -> &'static str {
        self.into()
    }
}

/// Follows every arc of a motion, a pattern and the section after each of its impacts, with the certified flight of the
/// simulation.
///
/// Each arc begins anew at its impact, so that unstable motions are followed as well as stable ones.
pub(crate) fn fly(
    system: &System,
    pattern: &Pattern,
    sections: &[SectionVector],
) -> Result<(), Inadmissible> {
    let (flow, mut follower) = (Flow::new(system), follower(system));
    for (i, section) in sections.iter().enumerate() {
        leaves_inwards(system, &flow, pattern.stops[i], section)?;
        let ends = ends(&flow, pattern, sections, i);
        fly_along(system, &flow, follower.as_mut(), &ends, pattern.mirrored)?;
    }
    Ok(())
}

/// The same of one arc between two impacts, which leaves its stop inwards; (x, v) at forcing phase 0 if it meets that, or half a
/// forcing period of a motion that is `mirrored`.
pub(super) fn fly_along(
    system: &System,
    flow: &Flow,
    follower: &mut dyn Follower,
    [from, due]: &[Node; 2],
    mirrored: bool,
) -> Result<Option<Vec<f64>>, Inadmissible> {
    Passage::new(system, flow, from, due)?.follow(follower, mirrored)
}

/// Refuses a section that leaves its stop outwards.
pub(super) fn leaves_inwards(
    system: &System,
    flow: &Flow,
    stop: Stop,
    section: &SectionVector,
) -> Result<(), Inadmissible> {
    let face = flow.face(stop);
    if !face.is_left_outwards(section) {
        return Ok(());
    }
    Err(wrong_velocity(system, stop, face, section))
}

/// That a section leaves its stop with the velocity that it has.
pub(super) fn wrong_velocity(
    system: &System,
    stop: Stop,
    face: &Face,
    section: &SectionVector,
) -> Inadmissible {
    let (coordinate, velocity) = (face.coordinate, section[0]);
    Inadmissible::WrongVelocity { stop: NamedStop::of(system, stop), coordinate, velocity }
}

/// An arc that is to be followed.
struct Passage<'a> {
    system: &'a System,
    flow: &'a Flow,
    from: &'a Node,
    due: &'a Node,
    /// The speed after the impact that is due.
    due_speed: f64,
    /// A bound on the speed at which it is reached.
    arrival: f64,
    scale: f64,
}

impl<'a> Passage<'a> {
    fn new(system: &'a System, flow: &'a Flow, from: &'a Node, due: &'a Node) -> Result<Self, Inadmissible> {
        let speed = flow.face(from.stop).speed(&from.section);
        let due_face = flow.face(due.stop);
        let due_speed = due_face.speed(&due.section);
        let unit = unit_about(flow.unit(), [&from.section, &due.section]);
        let scale = unit + speed.abs() + due_speed.abs();
        let arrival = if due_face.restitution >= READ_BACK {
            -due_speed / due_face.restitution
        } else {
            // The speed after the impact says little or nothing of that before it.
            let (start, time) = departure(flow, from, due);
            let z = &*flow.over(time) * start;
            due_face.along(&z)[1] / due_face.direction.norm()
        };
        if arrival < -TOLERANCE * scale {
            return Err(Inadmissible::Misses(NamedStop::of(system, due.stop)));
        }
        let arrival = arrival.max(0.0) + TOLERANCE * unit;
        Ok(Passage { system, flow, from, due, due_speed, arrival, scale })
    }

    /// See [`fly_along`].
    fn follow(&self, follower: &mut dyn Follower, mirrored: bool) -> Result<Option<Vec<f64>>, Inadmissible> {
        let Passage { flow, from, .. } = *self;
        let z = flow.face(from.stop).lifted(&from.section);
        let (n, begins) = (flow.n, phase(&from.section));
        follower.begin_at(z.rows(0, n).as_slice(), z.rows(n, n).as_slice(), wrapped(begins));
        let time = (phase(&self.due.section) - begins) / flow.omega;
        let (mut elapsed, mut at_phase_zero) = (0.0, None);
        loop {
            let taken = follower.advance();
            elapsed += taken.time;
            // The uncertainty of the time is that of the place divided by the speed.
            let early = (time - elapsed) * self.arrival > TOLERANCE * self.scale;
            match taken.event {
                Event::Impact(impact) => {
                    let here = wrapped(begins + flow.omega * elapsed);
                    self.meet(follower, &impact, early, here)?;
                    return Ok(at_phase_zero);
                }
                Event::Caught { impact, .. } if early || impact.stop != self.due.stop => {
                    return Err(Inadmissible::Sticks(self.named(impact.stop)));
                }
                Event::Caught { .. } => return Ok(at_phase_zero),
                Event::Strobe => {
                    at_phase_zero.get_or_insert_with(|| follower.state().as_slice().to_vec());
                }
                Event::HalfPeriod if mirrored => {
                    // Its mirror image is met at phase 0.
                    let [x, v] = [follower.x(), follower.v()].map(|values| flow.reflected(values));
                    let image = x.iter().chain(v.iter()).copied();
                    at_phase_zero.get_or_insert_with(|| image.collect());
                }
                Event::Flight | Event::StepEnd | Event::HalfPeriod | Event::Released(_) => {}
            }
            if (elapsed - time) * self.arrival > TOLERANCE * self.scale {
                return Err(Inadmissible::Misses(self.named(self.due.stop)));
            }
        }
    }

    fn named(&self, stop: Stop) -> NamedStop {
        NamedStop::of(self.system, stop)
    }

    /// Compares an impact with the one that is due.
    fn meet(
        &self,
        follower: &dyn Follower,
        impact: &Impact<f64>,
        early: bool,
        phase: f64,
    ) -> Result<(), Inadmissible> {
        if impact.stop != self.due.stop || early {
            return Err(Inadmissible::CrossesStop { stop: self.named(impact.stop), phase });
        }
        let speed = self.flow.face(impact.stop).speed_of(follower.v());
        if (speed - self.due_speed).abs() > TOLERANCE * self.scale {
            return Err(Inadmissible::Misses(self.named(self.due.stop)));
        }
        Ok(())
    }
}
