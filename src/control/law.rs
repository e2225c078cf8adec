//! What every control method consists of: its description, its settings, and its law at work.

use super::action::{Action, Seen};
use super::components::Components;
use super::error::ControlError;
use super::option::{Arguments, GivenOptions, MethodOption};
use super::quantity::ControlQuantity;
use super::site::Site;
use super::values::SectionValues;
use crate::model::{Real, System};
use crate::system::Family;

/// A control method, as it is known by name.
#[derive(Debug)]
pub struct Method {
    /// Its name on the command line and in files.
    pub name: &'static str,
    /// What it does, in one line.
    pub about: &'static str,
    /// Its own options, under this heading.
    pub options: (&'static str, &'static [MethodOption]),
    /// What of a target it needs.
    pub aim: Aim,
    /// The settings that an axis can vary, beside the components of a target.
    pub varied: &'static [ControlQuantity],
    /// The control signal: what it is, and its symbol in upright and italic pieces by turns, an upright one first.
    pub signal: (&'static str, &'static [&'static str]),
    /// Its law as the GPU computes it: functions `NAME_act`, `NAME_is_at_rest` and `NAME_passed`.
    pub shader: &'static str,
    /// The numbers that the shader shares with Rust, by name.
    pub constants: &'static [(&'static str, Constant)],
    /// What the law reads of the shader's `Control`, in the order in which it is written there; the shader puts the method's
    /// name before each: `control.NAME_gain`.
    pub members: &'static [(&'static str, Member)],
    /// The numbers of the law that change as it works, and what each begins with: `adapted.NAME_amplitude` in the shader.
    pub adapted: &'static [(&'static str, Beginning)],
}

/// The control signal of methods that correct points.
pub(super) const CORRECTION: (&str, &[&str]) = ("correction ", &["|Δ", "X", "|"]);

/// What a method needs of a target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Aim {
    /// Nothing: it has none.
    Nothing,
    /// One component.
    Component,
    /// The whole point.
    Point,
}

/// A number that a shader shares with Rust.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Constant {
    /// A whole number, a u32.
    Whole(u32),
    /// A number, an f32.
    Number(f64),
}

/// What a member of the shader's `Control` is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Member {
    /// A whole number.
    Whole,
    /// A number.
    Number,
    /// A number for each component of a point on the section.
    Components,
}

/// What a number that adapts begins with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Beginning {
    /// The method's own member of the shader's `Control`.
    Member(&'static str),
    /// Always the same number.
    Number(f64),
}

/// What a picture says of a setting.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shown {
    /// A setting and its value.
    Setting(ControlQuantity, f64),
    /// The diagonal of G.
    Diagonal(SectionValues<f64>),
    /// The coordinate that a force acts on, from 0.
    Coordinate(usize),
}

/// The settings of a method, before any system is known.
pub(super) trait Settings: Sized {
    /// The method at work.
    type Law;

    /// The method.
    const METHOD: &'static Method;

    /// The checked settings that options make on a section; those that were not given are as usual.
    fn given(options: &GivenOptions, site: &Site) -> Result<Self, ControlError>;

    /// The options that make the settings again, on a system of a family.
    fn write(&self, family: &Family, to: &mut Arguments);

    /// Changes one setting; nothing where there is no such setting.
    fn vary(&mut self, quantity: ControlQuantity, value: f64) -> Option<()>;

    /// Refuses the first setting that is out of range.
    fn check(&self) -> Result<(), ControlError>;

    /// The method at work on a system that has the stop.
    fn resolve(&self, system: &System) -> Result<Self::Law, ControlError>;

    /// The method in words, and what is shown of its settings.
    fn shown(&self) -> (&'static str, Vec<Shown>);
}

/// A control method at work.
pub(super) trait Law<T: Real>: Copy {
    /// The same in f64.
    type Exact;

    /// The law rounded from f64.
    fn rounded(exact: &Self::Exact) -> Self;

    /// What it does at a return to σ.
    fn act<const N: usize>(&mut self, seen: &Seen<T, N>) -> Action<T, N>;

    /// What it makes of the deviation of an arriving point, from those of the points before, the last one first.
    fn passed<const N: usize>(
        &self,
        seen: &Seen<T, N>,
        before: &[Components<T, N>],
        arrived: Components<T, N>,
    ) -> Components<T, N>;

    /// Points on which the next one depends.
    fn remembered(&self) -> usize {
        1
    }

    /// Whether it has itself come to rest: only adaptation goes on where the motion may already have settled.
    fn is_at_rest(&self) -> bool {
        true
    }

    /// The law without adaptation, its control signal as given, where one is.
    fn held(self, _signal: Option<T>) -> Self {
        self
    }

    /// The coordinate that a force acts on between impacts, and γ; none for methods that change points only.
    fn force(&self) -> Option<(usize, T)> {
        None
    }

    /// Whether the force begins anew with every return: on a trajectory that returns later it is later too.
    fn begins_anew(&self) -> bool {
        false
    }

    /// What it aims at.
    fn target(&self) -> Option<Vec<T>> {
        None
    }

    /// Refuses what the GPU has no kernel for.
    fn check_on_device(&self) -> Result<(), &'static str> {
        Ok(())
    }

    /// The members of [`Method::members`] in their order; numbers as their bits.
    fn written(&self) -> Vec<u32>;
}

/// A setting with its value, whether that is admitted, and what is, in words.
pub(super) type Range = (ControlQuantity, f64, bool, &'static str);

/// Refuses the first setting that is out of range.
pub(super) fn check_ranges(ranges: &[Range]) -> Result<(), ControlError> {
    match ranges.iter().find(|(_, _, admitted, _)| !admitted) {
        Some(&(quantity, value, _, range)) => {
            Err(ControlError::OutOfRange { name: quantity.name, value, range })
        }
        None => Ok(()),
    }
}

/// The bits of some numbers, rounded.
pub(super) fn bits<T: Real>(values: impl IntoIterator<Item = T>) -> Vec<u32> {
    values.into_iter().map(|value| (value.widen() as f32).to_bits()).collect()
}
