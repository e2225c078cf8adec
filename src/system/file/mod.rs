//! Reads a family's file.

mod parameters;
mod plane;
mod stops;

use sha2::{Digest, Sha256};

use super::block::Block;
use super::error::FamilyError;
use super::family::{Equations, Family};
use super::plant::Plant;
use super::table::{Source, Table};

const SECTIONS: [&str; 7] = ["name", "source", "label_order", "parameters", "system", "stop", "plane"];
const SYSTEM: [&str; 7] = ["frequency", "mass", "damping", "stiffness", "force_sin", "force_cos", "load"];

impl Family {
    /// Reads a family from the text of its file; `origin` names the file in messages.
    ///
    /// # Errors
    /// The first thing that is wrong, with file, line, key and remedy. The default values must make a plant.
    pub fn parse(text: &str, origin: &str) -> Result<Self, FamilyError> {
        read(text, origin)
    }
}

fn read(text: &str, origin: &str) -> Result<Family, FamilyError> {
    let source = Source { file: origin, text };
    let document = source.parse()?;
    let root = Table::root(&source, document.get_ref());
    root.only(&SECTIONS)?;
    let name = root.required("name", r#"name = "…" before the first section"#)?.text("a name in quotes")?;
    let from = root.optional("source").map(|item| item.text("a reference in quotes")).transpose()?;
    let parameters = root.required("parameters", "the section [parameters]; it may be empty")?;
    let (parameters, places) = parameters::read(&parameters.table("the section [parameters]")?)?;
    let names: Vec<String> = parameters.iter().map(|parameter| parameter.name.clone()).collect();
    let system =
        root.required("system", "the section [system] with frequency, mass, damping and stiffness")?;
    let equations = equations(&system.table("the section [system]")?, &names)?;
    let stops = stops::read(&root, equations.n, &names)?;
    let label_order = stops::label_order(&root, &stops)?;
    let plane = plane::read(&root, &parameters, equations.n)?;
    let mut family = Family {
        name: name.to_owned(),
        source: from.map(str::to_owned),
        origin: origin.to_owned(),
        text: text.to_owned(),
        hash: Sha256::digest(text).iter().map(|byte| format!("{byte:02x}")).collect(),
        parameters,
        equations,
        stops,
        label_order,
        of_flow: Vec::new(),
        of_stops: Vec::new(),
        plane,
    };
    family.of_flow = family.parameters_of_flow();
    family.of_stops = family.ids().filter(|id| !family.of_flow.contains(id)).collect();
    let used = |place: usize| family.blocks().flat_map(Block::uses).any(|id| id.index() == place);
    if let Some(unused) = (0..places.len()).find(|&i| !used(i)) {
        let problem =
            "no expression uses this parameter: use it in [system] or in a [[stop]], or remove it".to_owned();
        return Err(FamilyError { place: places[unused].clone(), problem });
    }
    family.assemble(&family.defaults()).map_err(|fault| fault.of_defaults())?;
    Ok(family)
}

fn equations(table: &Table, names: &[String]) -> Result<Equations, FamilyError> {
    table.only(&SYSTEM)?;
    let mass = table.required("mass", r#"mass = [["1"]]"#)?;
    let n = Block::rows(&mass)?;
    if n > Plant::MOST_COORDINATES {
        return Err(mass.too_many(n, "coordinates", Plant::MOST_COORDINATES));
    }
    let load = |key: &str| match table.optional(key) {
        Some(item) => Block::vector(&item, n, names),
        None => Ok(Block::zeros(mass.place(), n)),
    };
    let matrix = |key, example| Block::matrix(&table.required(key, example)?, n, names);
    Ok(Equations {
        n,
        frequency: Block::scalar(&table.required("frequency", r#"frequency = "omega""#)?, names)?,
        mass: Block::matrix(&mass, n, names)?,
        damping: matrix("damping", r#"damping = [["0"]], with zeros where nothing is damped"#)?,
        stiffness: matrix("stiffness", r#"stiffness = [["0"]], with zeros where there is no spring"#)?,
        force_sin: load("force_sin")?,
        force_cos: load("force_cos")?,
        load: load("load")?,
    })
}
