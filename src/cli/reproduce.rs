//! `impact-atlas reproduce`: the paper's figures, and what it prints, computed again.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

use anyhow::{Context, anyhow};
use clap::Args;
use impact_atlas::reproduce::{
    Claim, Finished, Outcome, PaperFigure, ReproduceError, config_of, markdown, registry,
};
use impact_atlas::store::Output;

use super::interrupt::{self, Interruptible};
use super::pictures::{self, Format};
use super::progress::Progress;
use super::terminal::{print, print_json};
use super::{CliError, defaults, files, note};

/// Makes the paper's figures again and checks what it prints
///
/// Writes a picture (or several) and a JSON file for each figure, and report.md and report.json with a row for every claim.
/// A figure whose files carry the same configuration is not made again, so that an interrupted run can be resumed.
/// Everything is computed in double precision on the CPU.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  impact-atlas reproduce
  impact-atlas reproduce --figure 7 --figure 9 --out paper --svg
  impact-atlas reproduce --json")]
pub struct ReproduceArgs {
    /// The folder for the figures and the report; made if it is not there
    #[arg(long, value_name = "DIR", default_value = defaults::REPRODUCTION)]
    out: PathBuf,

    /// Makes this figure alone; may be repeated [default: all]
    #[arg(long = "figure", value_name = "N")]
    figures: Vec<u32>,

    /// Writes the pictures as SVG instead of PNG
    #[arg(long)]
    svg: bool,

    /// Prints the claims as JSON: [{figure, claim, printed, computed, verdict, note}]
    #[arg(long)]
    json: bool,
}

/// Runs the command.
pub fn run(args: &ReproduceArgs) -> Result<(), CliError> {
    let wanted = args.wanted()?;
    let folder = &args.out;
    if folder.exists() && !folder.is_dir() {
        return Err(CliError::Input(anyhow!(
            "cannot write to `{}`: it is not a directory; give another --out",
            folder.display()
        )));
    }
    fs::create_dir_all(folder)
        .with_context(|| format!("cannot make the directory `{}`", folder.display()))
        .map_err(CliError::Input)?;
    let format = if args.svg { Format::Svg } else { Format::Png };
    note("computing on cpu, in double precision");
    for (i, &figure) in wanted.iter().enumerate() {
        let place = format!("figure {} ({} of {})", figure.number(), i + 1, wanted.len());
        if finished(folder, figure, Some(format)).is_some() {
            note(&format!("{place}: already there"));
            continue;
        }
        let began = Instant::now();
        make(folder, figure, format, &place)?;
        note(&format!("{place}: {:.1} s", began.elapsed().as_secs_f64()));
    }
    let all: Vec<Finished> =
        registry().into_iter().filter_map(|figure| finished(folder, figure, None)).collect();
    let claims: Vec<&Claim> = all.iter().flat_map(|figure| &figure.claims).collect();
    write(&folder.join("report.md"), markdown(&all).as_bytes())?;
    let json = serde_json::to_vec_pretty(&claims).map_err(CliError::machine)?;
    write(&folder.join("report.json"), &json)?;
    note(&format!("written: {}", folder.join("report.md").display()));
    if args.json { print_json(&claims) } else { print(&summary(&claims)) }
}

impl ReproduceArgs {
    /// The figures that are asked for, each once.
    fn wanted(&self) -> Result<Vec<&'static dyn PaperFigure>, CliError> {
        let all = registry();
        let known = |number: &u32| all.iter().any(|figure| figure.number() == *number);
        if let Some(unknown) = self.figures.iter().find(|number| !known(number)) {
            let numbers: Vec<String> = all.iter().map(|figure| figure.number().to_string()).collect();
            return Err(CliError::Input(anyhow!(
                "there is no figure {unknown} to make: choose from {}",
                numbers.join(", ")
            )));
        }
        let asked =
            |figure: &&dyn PaperFigure| self.figures.is_empty() || self.figures.contains(&figure.number());
        Ok(all.into_iter().filter(asked).collect())
    }
}

/// The name of a figure's file, with the letter of a part.
fn name(figure: u32, part: &str, extension: &str) -> String {
    format!("fig{figure:02}{part}.{extension}")
}

/// What the files of a figure say, if they are all there and were made with the present configuration; pictures in a
/// certain format, if one is asked for.
fn finished(folder: &Path, figure: &dyn PaperFigure, format: Option<Format>) -> Option<Finished> {
    let text = fs::read_to_string(folder.join(name(figure.number(), "", "json"))).ok()?;
    let finished: Finished = serde_json::from_str(&text).ok()?;
    let there = |picture: &String| {
        let named =
            format.is_none_or(|format| pictures::format_of(Path::new(picture)).is_ok_and(|f| f == format));
        named && folder.join(picture).is_file()
    };
    (finished.config == config_of(figure) && finished.pictures.iter().all(there)).then_some(finished)
}

fn make(
    folder: &Path,
    figure: &'static dyn PaperFigure,
    format: Format,
    place: &str,
) -> Result<(), CliError> {
    let progress = Progress::of_figure(place);
    let produced = interrupt::abandonable(move || figure.produce(&Interruptible))?;
    let produced = produced.map_err(|error| match error {
        ReproduceError::Sweep(error) => error.into(),
        ReproduceError::Picture(error) => CliError::machine(error),
    })?;
    drop(progress);
    interrupt::check()?;
    let extension = if format == Format::Svg { "svg" } else { "png" };
    let mut names = Vec::new();
    for (part, picture) in &produced.pictures {
        let name = name(figure.number(), part, extension);
        write(&folder.join(&name), &pictures::encoded(picture, format)?)?;
        names.push(name);
    }
    let finished = Finished {
        figure: figure.number(),
        caption: figure.caption().to_owned(),
        config: config_of(figure),
        pictures: names,
        claims: produced.claims,
    };
    let json = serde_json::to_vec_pretty(&finished).map_err(CliError::machine)?;
    write(&folder.join(name(figure.number(), "", "json")), &json)
}

fn write(path: &Path, bytes: &[u8]) -> Result<(), CliError> {
    let output = Output::prepare(path).map_err(CliError::input)?;
    files::write(&output, |file| file.write_all(bytes))
}

fn summary(claims: &[&Claim]) -> String {
    let of = |outcome: Outcome| claims.iter().filter(move |claim| claim.verdict == outcome);
    let mut lines = vec![format!(
        "{} claims: {} agree, {} differ, {} cannot be checked",
        claims.len(),
        of(Outcome::Agrees).count(),
        of(Outcome::Differs).count(),
        of(Outcome::NotChecked).count()
    )];
    lines.extend(of(Outcome::Differs).map(|claim| {
        format!(
            "differs: {}, {}: printed {}, computed {}",
            claim.figure, claim.claim, claim.printed, claim.computed
        )
    }));
    lines.join("\n")
}
