//! The command lines that make the same again.

use super::backends::Asked;
use crate::model::{Number, Parameter, Setting};
use crate::plane::fields::Layer;
use crate::plane::{Plane, Quantity, Start};
use crate::system::{BUILTIN, Family};

/// The name under which a page keeps the text of a system of its own.
pub const SYSTEM_FILE: &str = "system.toml";

/// `map` of a plane.
pub fn map(
    plane: &Plane,
    computing: Asked,
    size: [u32; 2],
    curves: Option<u32>,
    layer: Option<Layer>,
) -> String {
    let mut words = vec!["impact-atlas".to_owned(), "map".to_owned()];
    words.extend(system(plane.parameters.family()));
    words.extend(["--x".into(), plane.x.to_string(), "--y".into(), plane.y.to_string()]);
    let varied = |quantity| [plane.x.quantity, plane.y.quantity].contains(&quantity);
    words.extend(set(&plane.parameters, varied));
    words.extend(lengths(plane, plane.start));
    words.extend(computing.options());
    words.extend(["--size".into(), format!("{}x{}", size[0], size[1])]);
    if let Some(layer) = layer {
        words.extend(["--layer".into(), layer.name()]);
    }
    if let Some(max_period) = curves {
        words.extend(["--curves".into(), "--curves-max-period".into(), max_period.to_string()]);
    }
    line(&words)
}

/// `classify` of the one cell of a plane.
pub fn classify(plane: &Plane, computing: Asked) -> String {
    let mut words = vec!["impact-atlas".to_owned(), "classify".to_owned()];
    words.extend(system(plane.parameters.family()));
    words.extend(set(&plane.parameters_at(0, 0), |_| false));
    words.extend(lengths(plane, plane.start_at(0, 0)));
    words.extend(computing.options());
    line(&words)
}

fn system(family: &Family) -> Vec<String> {
    if family.is_paper() {
        return Vec::new();
    }
    let known = BUILTIN.iter().any(|builtin| builtin.name == family.origin);
    let described = family.origin == super::asked::OWN_SYSTEM;
    let name = if described && !known { SYSTEM_FILE } else { &family.origin };
    vec!["--system".into(), name.into()]
}

fn set(setting: &Setting, varied: impl Fn(Quantity) -> bool) -> Vec<String> {
    let defaults = Setting::defaults(setting.family());
    let differs = |(parameter, value): &(Parameter, f64)| {
        !varied(Quantity::Parameter(*parameter)) && *value != defaults.get(*parameter)
    };
    let words = |(parameter, value): (Parameter, f64)| {
        ["--set".into(), format!("{}={}", parameter.name(), Number(value))]
    };
    setting.entries().filter(differs).flat_map(words).collect()
}

fn lengths(plane: &Plane, start: Start) -> Vec<String> {
    let schedule = &plane.task;
    let mut words = vec![
        format!("--start={start}"),
        "--transient".into(),
        schedule.transient.to_string(),
        "--observe".into(),
        schedule.observe.to_string(),
        "--max-period".into(),
        schedule.max_period.to_string(),
    ];
    if schedule.fixed_periods {
        words.push("--fixed-periods".into());
    }
    words
}

/// Words as a shell reads them.
fn line(words: &[String]) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_=:.,/+".contains(c);
    let quoted = |word: &String| match word.chars().all(plain) && !word.is_empty() {
        true => word.clone(),
        false => format!("'{}'", word.replace('\'', r"'\''")),
    };
    words.iter().map(quoted).collect::<Vec<_>>().join(" ")
}
