//! The section [parameters].

use super::super::error::{FamilyError, Place};
use super::super::expression;
use super::super::parameter::{Bound, Parameter, Range};
use super::super::setting::MOST_PARAMETERS;
use super::super::table::{Item, Table};

const KEYS: [&str; 7] = ["default", "symbol", "about", "at_least", "at_most", "above", "below"];

/// The parameters in the order of the file, with their places.
pub(super) fn read(table: &Table) -> Result<(Vec<Parameter>, Vec<Place>), FamilyError> {
    let items = table.items();
    if let Some((name, item)) = items.get(MOST_PARAMETERS) {
        return Err(item.error(format!(
            "`{name}` is parameter {} of at most {MOST_PARAMETERS}: write numbers that do not vary into the expressions",
            MOST_PARAMETERS + 1
        )));
    }
    let parameters = items.iter().map(|(name, item)| parameter(name, item)).collect::<Result<_, _>>()?;
    Ok((parameters, items.iter().map(|(_, item)| item.place()).collect()))
}

/// Why a name cannot name a parameter, if it cannot.
fn clash(name: &str) -> Option<&'static str> {
    let plain = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let component = name
        .strip_prefix(['x', 'v'])
        .is_some_and(|rest| !rest.is_empty() && rest.chars().all(|c| c.is_ascii_digit()));
    if name.is_empty() || !name.chars().all(plain) || name.starts_with(|c: char| c.is_ascii_digit()) {
        Some("expressions read only ASCII letters, digits and _, the first no digit (the symbol is free)")
    } else if component {
        Some("it names a component of the start")
    } else if name == "phase" {
        Some("it names the forcing phase")
    } else if expression::has_meaning(name) {
        Some("it has a meaning of its own in expressions")
    } else {
        None
    }
}

fn parameter(name: &str, item: &Item) -> Result<Parameter, FamilyError> {
    if let Some(reason) = clash(name) {
        return Err(item.cannot_name("a parameter", name, reason));
    }
    let plain = |default| Parameter {
        name: name.to_owned(),
        default,
        symbol: name.to_owned(),
        about: String::new(),
        range: Range::default(),
    };
    if !item.is_table() {
        return item.number().map(plain);
    }
    let table = item.table("a number, or { default = … }")?;
    table.only(&KEYS)?;
    let text = |key| table.optional(key).map(|item| item.text("a text in quotes")).transpose();
    let default = table.required("default", "default = and a number")?;
    let mut parameter = plain(default.number()?);
    parameter.symbol = text("symbol")?.unwrap_or(name).to_owned();
    parameter.about = text("about")?.unwrap_or_default().to_owned();
    parameter.range = range(item, &table)?;
    parameter.check(parameter.default).map_err(|error| default.error(format!("the default {error}")))?;
    Ok(parameter)
}

fn range(item: &Item, table: &Table) -> Result<Range, FamilyError> {
    let bound = |key, included| -> Result<Option<Bound>, FamilyError> {
        let Some(item) = table.optional(key) else { return Ok(None) };
        Ok(Some(Bound { value: item.number()?, included }))
    };
    let one = |including: Option<Bound>, excluding: Option<Bound>, both: &'static str| {
        if including.is_some() && excluding.is_some() {
            return Err(item.error(both));
        }
        Ok(including.or(excluding))
    };
    let lower =
        one(bound("at_least", true)?, bound("above", false)?, "at_least and above are both given: keep one")?;
    let upper =
        one(bound("at_most", true)?, bound("below", false)?, "at_most and below are both given: keep one")?;
    if let (Some(low), Some(high)) = (lower, upper) {
        let point = low.value == high.value && low.included && high.included;
        if low.value >= high.value && !point {
            return Err(item.error("no number lies within these bounds: widen them"));
        }
    }
    Ok(Range { lower, upper })
}
