//! What the kernel `control_trajectories` reads and writes.

use super::flight::BACK_TERMS;
use super::follow::Verdict;
use crate::analysis;
use crate::control::{
    self, Beginning, Controller, METHODS, MOST_COMPONENTS, Member, Method, SectionValues, Surface,
};
use crate::dynamics::Stop;
use crate::model::vector::MOST;
use crate::model::{self, State, Step, System};

shared_struct! {
    /// When control is switched on, and how long a trajectory is followed; lengths in iterates.
    pub struct ControlSchedule {
        pub start: u32,
        pub iterates: u32,
        pub observed: u32,
        pub fixed_iterates: u32,
    }
}

impl ControlSchedule {
    /// A schedule as the shader reads it.
    pub fn new(schedule: &control::ControlSchedule) -> Self {
        ControlSchedule {
            start: schedule.from,
            iterates: schedule.iterates,
            observed: schedule.observed(),
            fixed_iterates: u32::from(schedule.fixed),
        }
    }
}

shared_struct! {
    /// What the kernel `control_trajectories` is told.
    pub struct ControlDispatch {
        pub schedule: ControlSchedule,
        /// Trajectories in this dispatch.
        pub count: u32,
        /// Moves that each of them may make.
        pub budget: u32,
        /// 1 in the first dispatch of a tile, which begins the trajectories; 0 in those that resume them.
        pub begin: u32,
        /// Invocations in one row of workgroups.
        pub row: u32,
        /// The largest number of iterates in one period that is looked for.
        pub max_period: u32,
    }
}

/// The code of a method; that of none is 0.
pub fn code(method: &Method) -> u32 {
    (1..).zip(METHODS).find(|(_, own)| own.name == method.name).map_or(0, |(code, _)| code)
}

/// The struct `Control` as a shader declares it: the method, the section's stop, its end of a contact normal, the coordinate
/// whose velocity comes first, and the mirror image of each stop (MOST where the system has no mirror); what a force of 1 in
/// phase with the forcing changes of the constants of flight; then what each method reads of it.
pub fn declaration_of_control() -> String {
    let shared = ["method", "stop", "normal", "side", "own"].map(|name| (name.to_owned(), "u32"));
    let mirror = ("mirror".to_owned(), "array<u32, MOST>");
    let driven = [
        ("push", "array<f32, COORDINATES>"),
        ("drive_sin", "array<f32, COMPONENTS>"),
        ("drive_cos", "array<f32, COMPONENTS>"),
        ("drive_bound", "array<f32, NORMALS>"),
        ("drive_held_sin", "array<array<f32, COMPONENTS>, NORMALS>"),
        ("drive_held_cos", "array<array<f32, COMPONENTS>, NORMALS>"),
        ("drive_back_sin", "array<array<f32, BACK_TERMS>, NORMALS>"),
        ("drive_back_cos", "array<array<f32, BACK_TERMS>, NORMALS>"),
    ];
    let of_methods = METHODS.iter().flat_map(|method| {
        method.members.iter().map(|(name, member)| {
            let ty = match member {
                Member::Whole => "u32",
                Member::Number => "f32",
                Member::Components => "array<f32, COMPONENTS>",
            };
            (format!("{}_{name}", method.name), ty)
        })
    });
    let members = shared.into_iter().chain([mirror]).chain(driven.map(|(name, ty)| (name.to_owned(), ty)));
    let members: String =
        members.chain(of_methods).map(|(name, ty)| format!("    {name}: {ty},\n")).collect();
    format!("struct Control {{\n{members}}}\n")
}

/// The struct `Adapted`, which is saved with a trajectory: what changes of each method as it works; and the function
/// `adapted_begin`, which gives what it begins with.
pub fn declaration_of_adapted() -> String {
    let (mut members, mut beginnings) = (String::new(), Vec::new());
    for method in METHODS {
        for (name, beginning) in method.adapted {
            members += &format!("    {}_{name}: f32,\n", method.name);
            beginnings.push(match beginning {
                Beginning::Member(member) => format!("control.{}_{member}", method.name),
                Beginning::Number(number) => format!("{number:?}"),
            });
        }
    }
    let begin =
        format!("fn adapted_begin() -> Adapted {{\n    return Adapted({});\n}}\n", beginnings.join(", "));
    format!("struct Adapted {{\n{members}}}\n{begin}")
}

/// The words of `Control` for a controller on a system.
pub fn control_words(controller: &Controller<f64>, system: &System) -> Vec<u32> {
    match system.coordinates() {
        1 => words_of::<1>(controller, system),
        2 => words_of::<2>(controller, system),
        3 => words_of::<3>(controller, system),
        _ => words_of::<4>(controller, system),
    }
}

fn words_of<const N: usize>(controller: &Controller<f64>, system: &System) -> Vec<u32> {
    let flight = model::Flight::<f64, N>::new(system);
    let surface = Surface::new(system, &flight, controller.stop());
    let written = Controller::<f32>::rounded(controller).written();
    let method = written.as_ref().map_or(0, |(method, _)| code(method));
    let section = [surface.stop.index(), surface.end.normal, surface.end.side, surface.eliminated];
    let mirror = surface.mirror.map_or([MOST as u32; MOST], |mirror| mirror.map(|stop| stop.0.into()));
    let mut words = vec![method];
    words.extend(section.map(|place| place as u32));
    words.extend(mirror);
    match controller.force() {
        Some((coordinate, _)) => words.extend(force_words::<N>(system, coordinate)),
        None => words.extend(vec![0; count_of_force::<N>(flight.count)]),
    }
    for own in METHODS {
        let size = |&(_, member): &(&str, Member)| if member == Member::Components { 2 * N } else { 1 };
        match &written {
            Some((method, members)) if method.name == own.name => words.extend(members),
            _ => words.extend(vec![0; own.members.iter().map(size).sum()]),
        }
    }
    words
}

/// How many words [`force_words`] are.
pub(super) fn count_of_force<const N: usize>(normals: usize) -> usize {
    5 * N + (1 + 4 * N + 2 * BACK_TERMS) * normals
}

/// What a force of 1 on a coordinate, in phase with the forcing, changes of the constants of flight.
pub(super) fn force_words<const N: usize>(system: &System, coordinate: usize) -> Vec<u32> {
    let force = model::Flight::<f64, N>::new(&system.loaded_alone(coordinate));
    let bounds = force.normals().iter().map(|normal| normal.bound.forcing);
    let (sin, cos) = (force.step.gamma_sin.values(), force.step.gamma_cos.values());
    let held = |of: fn(&Step<f64, N>) -> &State<f64, N>| {
        force.normals().iter().flat_map(move |normal| of(&normal.held).values())
    };
    let numbers = force.sin.into_iter().chain(sin).chain(cos).chain(bounds);
    let numbers = numbers.chain(held(|step| &step.gamma_sin)).chain(held(|step| &step.gamma_cos));
    let rounded = force.round::<f32>();
    let back = || rounded.normals().iter().flat_map(|normal| &normal.back[..BACK_TERMS]);
    let back = back().map(|row| row.sin).chain(back().map(|row| row.cos));
    numbers.map(|number| number as f32).chain(back).map(f32::to_bits).collect()
}

shared_struct! {
    /// What became of a controlled trajectory.
    pub struct Outcome {
        pub verdict: Verdict,
        /// The point on σ; the verdict has no state.
        pub section: [f32; MOST_COMPONENTS],
        pub period: u32,
        pub iterates: u32,
        pub converged_at: u32,
        pub signal: f32,
        pub runaway: u32,
        pub escapes: u32,
        pub effort: f32,
    }
}

impl Outcome {
    /// The outcome on the section of a stop with its values widened.
    pub fn widen(&self, system: &System, stop: Stop) -> control::Outcome {
        let verdict = self.verdict.widen(system);
        let point = self.section.map(f64::from);
        let section = SectionValues::from_slice(&point[..2 * system.plant().n])
            .expect("a system has 1 to 4 coordinates");
        control::Outcome {
            verdict: analysis::Verdict { state: section.state(system.plant(), stop), ..verdict },
            section,
            period: self.period,
            iterates: self.iterates,
            converged_at: self.converged_at,
            signal: self.signal,
            runaway: self.runaway != 0,
            escapes: self.escapes,
            effort: self.effort,
        }
    }
}
