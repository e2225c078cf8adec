//! The options of control methods, as a command line has them: what there is, what was given, and how it is written again.

use super::error::ControlError;
use super::quantity::ControlQuantity;
use crate::model::Number;

/// An option of a method.
#[derive(Clone, Copy, Debug)]
pub struct MethodOption {
    /// Its name, without dashes.
    pub name: &'static str,
    /// What its value is called.
    pub value_name: &'static str,
    /// What it is, in one line.
    pub help: &'static str,
    /// What there is to say beyond that; empty where there is nothing.
    pub more: &'static str,
    /// What its value is.
    pub kind: OptionKind,
    /// Another option that it takes the place of.
    pub instead_of: Option<&'static str>,
}

/// What the value of an option is.
#[derive(Clone, Copy, Debug)]
pub enum OptionKind {
    /// A number.
    Number,
    /// A whole number, not negative.
    Count,
    /// Numbers, parted by commas.
    Numbers,
    /// Any word.
    Word,
    /// One of these words, each with what it means.
    Choice(&'static [[&'static str; 2]]),
}

impl MethodOption {
    /// An option by its name and that of its value, with nothing more to say.
    pub(super) const fn new(kind: OptionKind, names: [&'static str; 2], help: &'static str) -> Self {
        MethodOption { name: names[0], value_name: names[1], help, more: "", kind, instead_of: None }
    }

    /// The same with more to say.
    pub(super) const fn more(self, more: &'static str) -> Self {
        MethodOption { more, ..self }
    }

    /// The same in the place of another.
    pub(super) const fn instead_of(self, other: &'static str) -> Self {
        MethodOption { instead_of: Some(other), ..self }
    }

    /// Refuses a value of another kind.
    pub(super) fn check(&self, value: &OptionValue) -> Result<(), ControlError> {
        let wanted = match (self.kind, value) {
            (OptionKind::Number, OptionValue::Number(_))
            | (OptionKind::Count, OptionValue::Count(_))
            | (OptionKind::Numbers, OptionValue::Numbers(_))
            | (OptionKind::Word, OptionValue::Word(_)) => return Ok(()),
            (OptionKind::Number, _) => "a number".to_owned(),
            (OptionKind::Count, _) => "a whole number".to_owned(),
            (OptionKind::Numbers, _) => "a list of numbers".to_owned(),
            (OptionKind::Word, _) => "a word".to_owned(),
            (OptionKind::Choice(words), value) => {
                let known: Vec<&str> = words.iter().map(|[word, _]| *word).collect();
                if let OptionValue::Word(word) = value
                    && known.contains(&word.as_str())
                {
                    return Ok(());
                }
                format!("one of {}", known.join(", "))
            }
        };
        Err(ControlError::Option(format!("--{} cannot be {value:?}: give {wanted}", self.name)))
    }
}

/// The value of an option that was given.
#[derive(Clone, Debug, PartialEq)]
pub enum OptionValue {
    /// See [`OptionKind::Number`].
    Number(f64),
    /// See [`OptionKind::Count`].
    Count(u32),
    /// See [`OptionKind::Numbers`].
    Numbers(Vec<f64>),
    /// See [`OptionKind::Word`] and [`OptionKind::Choice`].
    Word(String),
}

/// The options that were given, by name, in the order in which there are options.
#[derive(Clone, Debug, Default)]
pub struct GivenOptions(pub Vec<(&'static str, OptionValue)>);

impl GivenOptions {
    fn get(&self, name: &str) -> Option<&OptionValue> {
        self.0.iter().find(|(own, _)| *own == name).map(|(_, value)| value)
    }

    /// The number of an option, or what it is where it was not given.
    pub(super) fn number(&self, name: &str, otherwise: f64) -> f64 {
        if let Some(OptionValue::Number(value)) = self.get(name) { *value } else { otherwise }
    }

    /// The whole number of an option, or what it is where it was not given.
    pub(super) fn count(&self, name: &str, otherwise: u32) -> u32 {
        if let Some(OptionValue::Count(value)) = self.get(name) { *value } else { otherwise }
    }

    /// The numbers of an option.
    pub(super) fn numbers(&self, name: &str) -> Option<&[f64]> {
        if let Some(OptionValue::Numbers(values)) = self.get(name) { Some(values) } else { None }
    }

    /// The word of an option.
    pub fn word(&self, name: &str) -> Option<&str> {
        if let Some(OptionValue::Word(word)) = self.get(name) { Some(word) } else { None }
    }
}

/// Options on their way to a command line, without those that an axis varies.
pub(super) struct Arguments<'a> {
    pub text: String,
    pub varied: &'a dyn Fn(ControlQuantity) -> bool,
}

impl Arguments<'_> {
    /// An option.
    pub fn word(&mut self, option: &str, value: &str) {
        self.text += &format!(" --{option} {value}");
    }

    /// An option whose value may be negative.
    pub fn value(&mut self, option: &str, value: &str) {
        self.text += &format!(" --{option}={value}");
    }

    /// A setting, unless it is varied.
    pub fn setting(&mut self, quantity: ControlQuantity, value: f64) {
        if !(self.varied)(quantity) {
            self.value(&quantity.option(), &Number(value).to_string());
        }
    }
}
