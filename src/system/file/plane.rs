//! The section [plane]: the axes of a map where none are given.

use super::super::error::FamilyError;
use super::super::family::DefaultPlane;
use super::super::parameter::Parameter;
use super::super::table::Table;

const WANTED: &str = r#"an axis in quotes: "NAME=FIRST:LAST:COUNT""#;
const MALFORMED: &str = "is not an axis: write NAME=FIRST:LAST:COUNT with two numbers and a whole one";

/// The most values of an axis.
const MOST: u32 = 65_536;

pub(super) fn read(
    root: &Table,
    parameters: &[Parameter],
    n: usize,
) -> Result<Option<DefaultPlane>, FamilyError> {
    let Some(item) = root.optional("plane") else { return Ok(None) };
    let table = item.table("the section [plane]")?;
    table.only(&["x", "y"])?;
    let axis = |key, example| -> Result<(String, String), FamilyError> {
        let item = table.required(key, example)?;
        let text = item.text(WANTED)?;
        let wrong = |reason: String| item.error(format!("`{text}` {reason}"));
        Ok((axis_name(text, parameters, n).map_err(wrong)?, text.to_owned()))
    };
    let (across, x) = axis("x", r#"x = "NAME=FIRST:LAST:COUNT""#)?;
    let (up, y) = axis("y", r#"y = "NAME=FIRST:LAST:COUNT""#)?;
    if across == up {
        let problem = format!("`{y}` varies {up} as the other axis does: choose another quantity");
        return Err(table.required("y", WANTED)?.error(problem));
    }
    Ok(Some(DefaultPlane { x, y }))
}

/// The name of what an axis varies, once all of it is sound.
fn axis_name(text: &str, parameters: &[Parameter], n: usize) -> Result<String, String> {
    let malformed = || MALFORMED.to_owned();
    let (name, range) = text.split_once('=').ok_or_else(malformed)?;
    let name = name.trim();
    let parts: Vec<&str> = range.split(':').map(str::trim).collect();
    let [first, last, count] = parts[..] else { return Err(malformed()) };
    let number = |part: &str| part.parse::<f64>().ok().filter(|x| x.is_finite()).ok_or_else(malformed);
    let (first, last) = (number(first)?, number(last)?);
    let count: u32 = count.parse().map_err(|_| malformed())?;
    if !(2..=MOST).contains(&count) || first >= last {
        return Err(format!("is not an axis: FIRST must be less than LAST and COUNT between 2 and {MOST}"));
    }
    let component = |letter| (1..=n).any(|i| name == format!("{letter}{i}"));
    if component('x') || component('v') {
        return Ok(name.to_owned());
    }
    let Some(parameter) = parameters.iter().find(|parameter| parameter.name == name) else {
        let known: Vec<&str> = parameters.iter().map(|parameter| parameter.name.as_str()).collect();
        let known = known.join(", ");
        return Err(format!(
            "varies `{name}`, which is neither a parameter nor a component of the start: write one of {known}, x1 to \
             x{n}, v1 to v{n}"
        ));
    };
    for end in [first, last] {
        parameter
            .check(end)
            .map_err(|error| format!("leaves the range of {name}, {error}: change its ends"))?;
    }
    Ok(name.to_owned())
}
