//! From what a page asks for to a plane that can be computed, within the limits of the command line and narrower ones.

use std::collections::HashSet;

use parking_lot::Mutex;
use thiserror::Error;

use super::limits;
use super::ranges::axis_of;
use super::request::{AskedPlane, AskedSystem};
use crate::analysis::Schedule;
use crate::model::{Parameter, Setting, System};
use crate::plane::{Axis, Plane, Quantity, Start};
use crate::system::{BUILTIN, Family};

/// What a system is called in messages that a page describes itself.
pub const OWN_SYSTEM: &str = "your system";

/// Why a plane was refused, and the line of the system's text where that is at fault.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{message}")]
pub struct Refused {
    /// What, and the remedy.
    pub message: String,
    /// A line of the system's text, from 1.
    pub line: Option<usize>,
}

/// A refusal in words.
pub fn refused(message: impl Into<String>) -> Refused {
    Refused { message: message.into(), line: None }
}

/// A refusal for a reason, with the whole chain of causes.
pub fn because(error: impl std::error::Error + Send + Sync + 'static) -> Refused {
    refused(format!("{:#}", anyhow::Error::new(error)))
}

/// The system that is asked for; `own` is the one that the program was started with.
///
/// # Errors
/// [`Refused`] with the line of the text that is at fault. No file is read.
pub fn family(asked: &AskedSystem, own: &'static Family) -> Result<&'static Family, Refused> {
    static TEXTS: Mutex<Option<HashSet<String>>> = Mutex::new(None);
    match asked {
        AskedSystem::Name(name) if *name == own.origin => Ok(own),
        AskedSystem::Name(name) => match BUILTIN.iter().find(|builtin| builtin.name == name) {
            Some(builtin) => Ok(Family::builtin(builtin.name)),
            None => Err(refused("this system does not come with the program: choose one of the list")),
        },
        AskedSystem::Text(text) if text.len() > limits::SYSTEM_TEXT => Err(refused(format!(
            "the description has {} bytes: at most {} are read",
            text.len(),
            limits::SYSTEM_TEXT
        ))),
        AskedSystem::Text(text) => {
            check_lines(text)?;
            Family::parse(text, OWN_SYSTEM)
                .map_err(|error| Refused { line: Some(error.place.line), message: error.to_string() })?;
            let mut texts = TEXTS.lock();
            let texts = texts.get_or_insert_default();
            if !texts.contains(text) && texts.len() >= limits::SYSTEM_TEXTS {
                return Err(refused("too many systems were described: start the program again"));
            }
            texts.insert(text.clone());
            Family::kept(text, OWN_SYSTEM).map_err(because)
        }
    }
}

/// Refuses lines that are too long, and texts over several of them.
fn check_lines(text: &str) -> Result<(), Refused> {
    let wrong = |(at, line): (usize, &str)| {
        let long = line.chars().count() > limits::SYSTEM_LINE;
        let message = match (long, line.contains("\"\"\"") || line.contains("'''")) {
            (true, _) => format!("a line may have at most {} characters here", limits::SYSTEM_LINE),
            (_, true) => "a text over several lines is not read here: write it in one".to_owned(),
            _ => return None,
        };
        Some(Refused { message: format!("{OWN_SYSTEM}:{}: {message}", at + 1), line: Some(at + 1) })
    };
    text.lines().enumerate().find_map(wrong).map_or(Ok(()), Err)
}

/// The plane that is asked for.
///
/// # Errors
/// [`Refused`] with what cannot be used.
pub fn plane(asked: &AskedPlane, family: &'static Family) -> Result<Plane, Refused> {
    let [own_x, own_y] = own_axes(family);
    let x = axis(asked.x.clone().or(own_x), family, "horizontal")?;
    let y = axis(asked.y.clone().or(own_y), family, "vertical")?;
    let periods = [("transient", asked.transient), ("observation", asked.observe)];
    if let Some((name, periods)) = periods.into_iter().find(|(_, periods)| *periods > limits::PERIODS) {
        return Err(refused(format!(
            "{name} of {periods} forcing periods: here at most {} are followed",
            limits::PERIODS
        )));
    }
    let mut setting = Setting::defaults(family);
    for (name, &value) in &asked.set {
        let parameter = Parameter::of(family, name).map_err(because)?;
        parameter.check(value).map_err(because)?;
        setting = setting.with(parameter, value);
    }
    let plane = Plane {
        x,
        y,
        parameters: setting,
        start: asked.start.parse::<Start>().map_err(because)?,
        task: Schedule {
            transient: asked.transient,
            observe: asked.observe,
            max_period: asked.max_period,
            fixed_periods: asked.fixed_periods,
        },
    };
    check(&plane)?;
    check_systems(&plane)?;
    Ok(plane)
}

/// Places along either axis at which a plane is tried.
const TRIED: u32 = 32;

/// Refuses a plane on which no place of some that stand evenly, its corners among them, has a system; with the reason at the first.
fn check_systems(plane: &Plane) -> Result<(), Refused> {
    let places = |axis: &Axis| {
        let last = u64::from(axis.count - 1);
        (0..=TRIED).map(move |k| (last * u64::from(k) / u64::from(TRIED)) as u32)
    };
    let columns = places(&plane.x).flat_map(|column| places(&plane.y).map(move |row| (column, row)));
    let mut found = columns.map(|(column, row)| System::new(plane.parameters_at(column, row)).map(drop));
    let first = found.next().unwrap_or(Ok(()));
    if first.is_ok() || found.any(|system| system.is_ok()) { Ok(()) } else { first.map_err(because) }
}

/// Whether a plane can be looked at.
///
/// # Errors
/// [`Refused`] with what cannot be used.
pub fn check(plane: &Plane) -> Result<(), Refused> {
    plane.check().map_err(because)?;
    for axis in [&plane.x, &plane.y] {
        if axis.count < 2 {
            return Err(refused(format!("{axis} has no extent: give the axis two different ends")));
        }
    }
    Ok(())
}

/// The axes of a family's own plane; where it has none, those of its first parameters.
fn own_axes(family: &'static Family) -> [Option<String>; 2] {
    match &family.plane {
        Some(plane) => [&plane.x, &plane.y].map(|axis| Some(axis.to_string())),
        None => [0, 1].map(|place| axis_of(family, place)),
    }
}

fn axis(text: Option<String>, family: &'static Family, which: &str) -> Result<Axis, Refused> {
    let text = text.ok_or_else(|| {
        refused(format!("the system has no second parameter: choose the {which} axis in its [plane]"))
    })?;
    let axis = Axis::of_family(&text, family).map_err(because)?;
    match axis.quantity {
        Quantity::Control(_) => Err(refused(format!("{axis} is a setting of a control method"))),
        Quantity::Parameter(_) | Quantity::Start(_) => Ok(axis),
    }
}
