//! The sections [[stop]] and the order in which labels count them.

use super::super::block::Block;
use super::super::error::FamilyError;
use super::super::family::FamilyStop;
use super::super::plant::Plant;
use super::super::table::{Item, Table};

const KEYS: [&str; 5] = ["name", "alias", "direction", "gap", "restitution"];
const SECTION: &str = "a section [[stop]] with name, direction, gap and restitution for every stop";

pub(super) fn read(root: &Table, n: usize, names: &[String]) -> Result<Vec<FamilyStop>, FamilyError> {
    let item = root.required("stop", SECTION)?;
    let items = item.list(SECTION)?;
    if items.len() > Plant::MOST_STOPS {
        return Err(item.too_many(items.len(), "stops", Plant::MOST_STOPS));
    }
    let mut stops: Vec<FamilyStop> = Vec::with_capacity(items.len());
    for item in items {
        let next = stop(&item.table(SECTION)?, n, names, &stops)?;
        stops.push(next);
    }
    Ok(stops)
}

fn stop(table: &Table, n: usize, names: &[String], before: &[FamilyStop]) -> Result<FamilyStop, FamilyError> {
    table.only(&KEYS)?;
    let item = table.required("name", r#"name = "A""#)?;
    let name = own_name(&item, before)?;
    let alias = match table.optional("alias") {
        Some(item) => Some(own_name(&item, before)?),
        None => None,
    };
    let example = r#"direction = ["1"], with one entry for each coordinate"#;
    Ok(FamilyStop {
        name,
        alias,
        direction: Block::vector(&table.required("direction", example)?, n, names)?,
        gap: Block::scalar(&table.required("gap", r#"gap = "delta""#)?, names)?,
        restitution: Block::scalar(&table.required("restitution", r#"restitution = "r""#)?, names)?,
    })
}

fn own_name(item: &Item, before: &[FamilyStop]) -> Result<String, FamilyError> {
    let name = item.text("a name in quotes")?;
    let taken = |stop: &FamilyStop| stop.name == name || stop.alias.as_deref() == Some(name);
    let reason = if name.contains(|c: char| c.is_whitespace() || c.is_control() || ",=:-".contains(c)) {
        "it holds a blank or one of , = : -"
    } else if before.iter().any(taken) {
        "a stop above has it"
    } else {
        return Ok(name.to_owned());
    };
    Err(item.cannot_name("a stop", name, reason))
}

/// Where each stop that labels count first, second, … stands in the order of the file.
pub(super) fn label_order(root: &Table, stops: &[FamilyStop]) -> Result<Vec<usize>, FamilyError> {
    let Some(item) = root.optional("label_order") else { return Ok((0..stops.len()).collect()) };
    let wanted = r#"a list of stops: ["A"]"#;
    let error = |item: &Item, reason: String| {
        let stops: Vec<&str> = stops.iter().map(|stop| stop.name.as_str()).collect();
        item.error(format!("{reason}: write each of {} once", stops.join(", ")))
    };
    let mut order = Vec::with_capacity(stops.len());
    for entry in item.list(wanted)? {
        let name = entry.text(wanted)?;
        let named = |stop: &FamilyStop| stop.name == name || stop.alias.as_deref() == Some(name);
        match stops.iter().position(named) {
            None => return Err(error(&entry, format!("there is no stop `{name}`"))),
            Some(stop) if order.contains(&stop) => {
                return Err(error(&entry, format!("stop `{name}` is named twice")));
            }
            Some(stop) => order.push(stop),
        }
    }
    match (0..stops.len()).find(|stop| !order.contains(stop)) {
        Some(missing) => Err(error(&item, format!("stop `{}` is missing", stops[missing].name))),
        None => Ok(order),
    }
}
