//! A motion followed in one parameter, and the bifurcations met on the way.

use nalgebra::DVector;

use super::condition::{Kind, split, test_function};
use super::locus::Branch;
use super::parting::{parting, passed};
use super::path::PathPoint;
use super::seeds::Seed;
use super::touch::{Touch, arrival_speeds, nearest, touches};
use super::unknowns::{Span, Unknowns};
use super::until::Until;
use crate::model::{Setting, System};
use crate::theory::newton::arcs;
use crate::theory::{
    Flow, Pattern, PeriodicMotion, SectionVector, eigenvalues, extent, in_units, phase, turn_along,
};

/// The longest step, in lengths of the parameter's range.
const LONGEST: f64 = 0.02;
/// The shortest step.
const SHORTEST: f64 = 1e-6;
/// The most steps.
const MOST_STEPS: usize = 1500;
/// A step over which the path turns by more than this cosine is halved.
const STRAIGHT: f64 = 0.95;
/// Bisections to place the birth of a motion.
const BISECTIONS: usize = 20;
/// How far apart the places are that are kept of a branch, in lengths of the parameter's range.
const KEPT: f64 = 0.15;
/// A test function that is no larger on either side of a zero is zero all along, but for rounding: as that of a
/// Neimark-Sacker bifurcation is where nothing dissipates.
const ROUNDING: f64 = 1e-9;
/// A motion whose sections are no farther than this from those of a simpler one is beside it.
const NEAR: f64 = 1e-3;
/// Multipliers up to this count as stable.
const STABLE: f64 = 1.0 + 1e-7;

/// A bifurcation met on a branch: a point from which its curve can be followed.
#[derive(Clone, Debug)]
pub(super) struct Event {
    pub kind: Kind,
    pub pattern: Pattern,
    pub sections: Vec<SectionVector>,
    pub parameters: Setting,
    /// For grazing: the arc, the stop and the phase.
    pub touch: Option<Touch>,
}

/// What a branch has shown.
#[derive(Clone, Debug, Default)]
pub(super) struct Followed {
    /// The bifurcations at which the motion gains or loses stability, and the grazings of its stable part.
    pub events: Vec<Event>,
    /// The bifurcations of simpler motions in which the motion was born.
    pub births: Vec<Event>,
    /// The motion here and there on the way, stable or not.
    pub places: Vec<Seed>,
}

impl Followed {
    /// What several have shown.
    pub fn all(parts: impl IntoIterator<Item = Followed>) -> Self {
        parts.into_iter().fold(Followed::default(), |mut all, part| {
            all.events.extend(part.events);
            all.births.extend(part.births);
            all.places.extend(part.places);
            all
        })
    }
}

/// What is watched along a branch.
#[derive(Clone, Debug)]
struct Watched {
    /// The test functions of [`Kind::smooth`].
    tests: [f64; 3],
    stable: bool,
    nearest: Option<Touch>,
    speeds: Vec<f64>,
}

impl Watched {
    /// Whether a stop is crossed in flight, or an impact comes from the wrong side.
    fn is_inadmissible(&self) -> bool {
        self.nearest.is_some_and(|touch| touch.gap < 0.0) || self.speeds.iter().any(|&speed| speed < 0.0)
    }
}

/// Follows a motion both ways to the ends of a parameter's range, or to where it ceases to be one.
pub(super) fn followed(Seed { motion, parameters }: &Seed, span: Span, until: Until<'_>) -> Followed {
    let unknowns = Unknowns::new(motion.pattern.clone(), &motion.sections, *parameters, 0, vec![span]);
    let guess = unknowns.pack(&motion.sections, &[], parameters);
    let fixed = unknowns.parameters_at();
    let branch = Branch(unknowns);
    let Some(start) = PathPoint::near(&branch, guess, fixed) else { return Followed::default() };
    let mut found = Followed::default();
    follow(&branch, start.clone(), &mut found, until);
    follow(&branch, start.reversed(), &mut found, until);
    found
}

fn follow(branch: &Branch, start: PathPoint, found: &mut Followed, until: Until<'_>) {
    let share = |at: &PathPoint| at.y[at.y.len() - 1];
    let mut here = start;
    let mut kept = share(&here);
    let Some(mut seen) = watch(branch, &here.y) else { return };
    let mut ds = LONGEST;
    for _ in (0..MOST_STEPS).take_while(|_| !until.is_over()) {
        let ahead = here.advanced(branch, ds).filter(|next| here.straightness(next) > STRAIGHT);
        let Some((next, watched)) = ahead.and_then(|next| watch(branch, &next.y).map(|w| (next, w))) else {
            ds *= 0.5;
            if ds < SHORTEST {
                break;
            }
            continue;
        };
        if seen.stable || watched.stable {
            for (index, kind) in Kind::smooth(&branch.0.pattern).into_iter().enumerate() {
                let [a, b] = [seen.tests[index], watched.tests[index]];
                if a * b < 0.0 && a.abs().max(b.abs()) > ROUNDING {
                    let located = locate(branch, &here, ds, |w| w.tests[index]);
                    found.events.extend(located.and_then(|y| smooth_event(branch, &y, kind)));
                }
            }
        }
        if seen.stable || watched.stable {
            found.births.extend(birth(branch, &here, &next, ds));
        }
        if watched.is_inadmissible() {
            found.events.extend(grazing_event(branch, &next.y, &watched).filter(|_| seen.stable));
            break;
        }
        if !(0.0..=1.0).contains(&share(&next)) {
            break;
        }
        if (share(&next) - kept).abs() > KEPT {
            kept = share(&next);
            found.places.push(branch.seed(&next.y));
        }
        (here, seen) = (next, watched);
        ds = (ds * 1.4).min(LONGEST);
    }
}

fn watch(branch: &Branch, y: &DVector<f64>) -> Option<Watched> {
    let unknowns = &branch.0;
    let system = unknowns.system(y)?;
    let sections = unknowns.sections(y);
    let (flow, pattern) = (Flow::new(&system), &unknowns.pattern);
    let arcs = arcs(&flow, pattern, &sections);
    let map = in_units(turn_along(&flow, pattern, &arcs)?, unknowns.unit);
    let multipliers = eigenvalues(&map)?;
    Some(Watched {
        tests: Kind::smooth(pattern).map(|kind| test_function(kind, &map)),
        stable: multipliers[0].norm() <= STABLE,
        nearest: nearest(&touches(&system, &flow, pattern, &sections)),
        speeds: arrival_speeds(&flow, &arcs),
    })
}

/// The point within `ds` ahead where a watched function vanishes, by the Illinois rule.
fn locate(branch: &Branch, from: &PathPoint, ds: f64, f: impl Fn(&Watched) -> f64) -> Option<DVector<f64>> {
    let at = |s: f64| -> Option<(DVector<f64>, f64)> {
        let y = if s == 0.0 { from.y.clone() } else { from.ahead(branch, s)? };
        let value = f(&watch(branch, &y)?);
        Some((y, value))
    };
    let (mut a, mut b) = (0.0, ds);
    let (mut fa, mut fb) = (at(a)?.1, at(b)?.1);
    let scale = fa.abs().max(fb.abs());
    for _ in 0..40 {
        let s = (a * fb - b * fa) / (fb - fa);
        let (y, value) = at(s)?;
        if value.abs() <= 1e-9 * scale || (b - a).abs() < 1e-10 {
            return Some(y);
        }
        if value * fb < 0.0 {
            (a, fa) = (b, fb);
        } else {
            fa *= 0.5;
        }
        (b, fb) = (s, value);
    }
    None
}

/// The bifurcation of a simpler motion in which a path's motion was born, where the path goes over into its twin's.
fn birth(branch: &Branch, here: &PathPoint, next: &PathPoint, ds: f64) -> Option<Event> {
    let unknowns = &branch.0;
    let first = branch.seed(&here.y).motion;
    first.part(2)?;
    let is_beyond = |y: &DVector<f64>| {
        let system = unknowns.system(y)?;
        Some(passed(&system, &first, &branch.seed(y).motion))
    };
    if !is_beyond(&next.y)? {
        return None;
    }
    let (mut before, mut beyond, mut last) = (0.0, ds, here.y.clone());
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (before + beyond);
        let y = here.ahead(branch, middle)?;
        if is_beyond(&y)? {
            beyond = middle;
        } else {
            (before, last) = (middle, y);
        }
    }
    let system = unknowns.system(&last)?;
    let event = Event::smooth(Kind::Fold, branch.seed(&last));
    Some(event.of_simpler_motion(&system, unknowns.unit)).filter(|event| event.kind != Kind::Fold)
}

/// A smooth bifurcation, if it is one of stability.
fn smooth_event(branch: &Branch, y: &DVector<f64>, kind: Kind) -> Option<Event> {
    let system = branch.0.system(y)?;
    let seed = branch.seed(y);
    let multipliers = eigenvalues(&in_units(seed.motion.jacobian(&system)?, branch.0.unit))?;
    let (critical, others) = split(kind, &multipliers);
    let neutral_saddle = kind == Kind::NeimarkSacker && critical[0].im.abs() < 1e-9;
    if neutral_saddle || others.iter().any(|value| value.norm() > STABLE) {
        return None;
    }
    let event = Event::smooth(kind, seed);
    Some(if kind == Kind::Fold { event.of_simpler_motion(&system, branch.0.unit) } else { event })
}

impl Event {
    fn smooth(kind: Kind, Seed { motion, parameters }: Seed) -> Self {
        let PeriodicMotion { pattern, sections, .. } = motion;
        Event { kind, pattern, sections, parameters, touch: None }
    }

    /// The motion at its bifurcation.
    pub fn seed(&self) -> Seed {
        let (pattern, sections) = (self.pattern.clone(), self.sections.clone());
        Seed { parameters: self.parameters, motion: PeriodicMotion { pattern, sections, residual: 0.0 } }
    }

    /// A branch that is born in a pitchfork or a period doubling turns around there, as if at a fold: the motion is the
    /// simpler one then, and the bifurcation is that one's; `unit` is of order one.
    fn of_simpler_motion(self, system: &System, unit: f64) -> Self {
        let Some((pattern, differences)) = parting(system, &self.seed().motion) else { return self };
        let count = pattern.stops.len();
        let near = |(a, difference): (&SectionVector, &SectionVector)| {
            extent(difference, unit) < NEAR * (1.0 + extent(a, unit))
        };
        if !self.sections.iter().zip(&differences).all(near) {
            return self;
        }
        let kind = if pattern.mirrored { Kind::Pitchfork } else { Kind::PeriodDoubling };
        Event { kind, pattern, sections: self.sections[..count].to_vec(), ..self }
    }
}

/// The grazing that a branch has just passed: a stop crossed in flight, or an impact that came to nothing.
///
/// None where the only impact came to nothing: what grazes there is the motion without impact.
fn grazing_event(branch: &Branch, y: &DVector<f64>, watched: &Watched) -> Option<Event> {
    let unknowns = &branch.0;
    let parameters = unknowns.parameters(y);
    let sections = unknowns.sections(y);
    let pattern = &unknowns.pattern;
    let event = |pattern: Pattern, sections: Vec<SectionVector>, touch: Touch| Event {
        kind: Kind::Grazing,
        pattern,
        sections,
        parameters,
        touch: Some(touch),
    };
    if let Some(touch) = watched.nearest.filter(|touch| touch.gap < 0.0) {
        return Some(event(pattern.clone(), sections, touch));
    }
    let vanishing = watched.speeds.iter().position(|&speed| speed < 0.0)?;
    // The speed of arrival at the end of an arc is that of the next impact; without it the motion grazes there.
    let count = sections.len();
    let impact = (vanishing + 1) % count;
    if count == 1 {
        return None;
    }
    let mut fewer = PeriodicMotion { pattern: pattern.clone(), sections, residual: 0.0 };
    if impact == 0 {
        fewer.rotate(&unknowns.flow(y)?, 1);
    }
    let impact = if impact == 0 { count - 1 } else { impact };
    let stop = fewer.pattern.stops.remove(impact);
    let phase = phase(&fewer.sections.remove(impact));
    Some(event(fewer.pattern, fewer.sections, Touch { arc: impact - 1, stop, phase, gap: 0.0 }))
}
