//! `impact-atlas reproduce`: the paper's figures, and what it prints, computed again.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::Instant;

use anyhow::Context;
use clap::Args;
use impact_atlas::reproduce::{Claim, FIGURES, Finished, Outcome, PaperFigure, ReproduceError, markdown};
use impact_atlas::store::Output;

use super::interrupt::{self, Interruptible};
use super::options::OverwriteArgs;
use super::pictures::{self, Format};
use super::progress::Progress;
use super::terminal::{print, print_json};
use super::{CliError, Result, defaults, note, wrong};

/// Makes the paper's figures again and checks what it prints
///
/// Writes a picture (or several) and a JSON file for each figure, and report.md and report.json with a row for every claim.
/// A figure whose files carry the same configuration is not made again, so that an interrupted run can be resumed,
/// unless --force is given.
/// Figures and reports of an earlier run are brought up to date; other files that are there stay, unless --force is given.
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

    #[command(flatten)]
    overwrite: OverwriteArgs,

    /// Prints the claims as JSON: [{figure, claim, printed, computed, verdict, note}]
    #[arg(long)]
    json: bool,
}

/// Runs the command.
pub fn run(args: &ReproduceArgs) -> Result<()> {
    let wanted = args.wanted()?;
    let folder = &args.out;
    if folder.as_os_str() == Output::STANDARD {
        return Err(wrong!("the figures are files, which standard output cannot hold: name a folder"));
    }
    if folder.exists() && !folder.is_dir() {
        return Err(wrong!(
            "cannot write to `{}`: it is not a directory; give another --out",
            folder.display()
        ));
    }
    fs::create_dir_all(folder)
        .with_context(|| format!("cannot make the directory `{}`", folder.display()))
        .map_err(CliError::Input)?;
    let format = if args.svg { Format::Svg } else { Format::Png };
    let mut book = Book { folder, force: args.overwrite.force, written: Vec::new() };
    let reports = [book.report("report.json")?, book.report("report.md")?];
    note("computing on cpu, in double precision");
    for (i, &figure) in wanted.iter().enumerate() {
        let place = format!("figure {} ({} of {})", figure.number, i + 1, wanted.len());
        if !args.overwrite.force && finished(folder, figure, Some(format)).is_some() {
            note(&format!("{place}: already there"));
            continue;
        }
        let began = Instant::now();
        make(&mut book, figure, format, &place)?;
        note(&format!("{place}: {:.1} s", began.elapsed().as_secs_f64()));
    }
    let all: Vec<Finished> = FIGURES.iter().filter_map(|figure| finished(folder, figure, None)).collect();
    let claims: Vec<&Claim> = all.iter().flat_map(|figure| &figure.claims).collect();
    let json = serde_json::to_vec_pretty(&claims).map_err(CliError::machine)?;
    for (output, bytes) in reports.into_iter().zip([json, markdown(&all).into_bytes()]) {
        book.write(&output, &bytes)?;
    }
    note(&format!("written: {}", book.written.join(", ")));
    if args.json { print_json(&claims) } else { print(&summary(&claims)) }
}

impl ReproduceArgs {
    /// The figures that are asked for, each once.
    fn wanted(&self) -> Result<Vec<&'static PaperFigure>> {
        let known = |number: &u32| FIGURES.iter().any(|figure| figure.number == *number);
        if let Some(unknown) = self.figures.iter().find(|number| !known(number)) {
            let numbers = FIGURES.each_ref().map(|figure| figure.number.to_string()).join(", ");
            return Err(wrong!("there is no figure {unknown} to make: choose from {numbers}"));
        }
        let asked = |figure: &&PaperFigure| self.figures.is_empty() || self.figures.contains(&figure.number);
        Ok(FIGURES.iter().filter(asked).collect())
    }
}

/// The name of a figure's file, with the letter of a part.
fn name(figure: u32, part: &str, extension: &str) -> String {
    format!("fig{figure:02}{part}.{extension}")
}

/// What the files of a figure say, if they are all there and were made with the present configuration; pictures in a
/// certain format, if one is asked for.
fn finished(folder: &Path, figure: &PaperFigure, format: Option<Format>) -> Option<Finished> {
    let text = fs::read_to_string(folder.join(name(figure.number, "", "json"))).ok()?;
    let finished: Finished = serde_json::from_str(&text).ok()?;
    let there = |picture: &String| {
        let named = format.is_none_or(|format| pictures::format_of(Path::new(picture)) == format);
        named && folder.join(picture).is_file()
    };
    (finished.config == figure.config() && finished.pictures.iter().all(there)).then_some(finished)
}

fn make(book: &mut Book<'_>, figure: &'static PaperFigure, format: Format, place: &str) -> Result<()> {
    let progress = Progress::of_unknown(place);
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
        let name = name(figure.number, part, extension);
        let output = book.of_figure(figure.number, &name)?;
        book.write(&output, &pictures::encoded(picture, format)?)?;
        names.push(name);
    }
    let finished = Finished {
        figure: figure.number,
        caption: figure.caption.to_owned(),
        config: figure.config(),
        pictures: names,
        claims: produced.claims,
    };
    let json = serde_json::to_vec_pretty(&finished).map_err(CliError::machine)?;
    let output = book.of_figure(figure.number, &name(figure.number, "", "json"))?;
    book.write(&output, &json)
}

/// The folder, in which only what an earlier run made is replaced, and what was written into it.
struct Book<'a> {
    folder: &'a Path,
    force: bool,
    written: Vec<String>,
}

impl Book<'_> {
    /// One of the reports, which are replaced where the claims are those of an earlier run.
    fn report(&self, name: &str) -> Result<Output> {
        self.output(name, self.holds::<Vec<Claim>>("report.json"))
    }

    /// A file of a figure, which is replaced where an earlier run made that figure.
    fn of_figure(&self, figure: u32, file: &str) -> Result<Output> {
        self.output(file, self.holds::<Finished>(&name(figure, "", "json")))
    }

    fn holds<T: serde::de::DeserializeOwned>(&self, name: &str) -> bool {
        fs::read(self.folder.join(name)).is_ok_and(|bytes| serde_json::from_slice::<T>(&bytes).is_ok())
    }

    fn output(&self, name: &str, ours: bool) -> Result<Output> {
        let output = Output::prepare(self.folder.join(name)).map_err(CliError::input)?;
        if ours || self.force { Ok(output) } else { output.keeping().map_err(CliError::input) }
    }

    fn write(&mut self, output: &Output, bytes: &[u8]) -> Result<()> {
        output.write(|file| file.write_all(bytes)).map_err(CliError::machine)?;
        self.written.push(output.path().display().to_string());
        Ok(())
    }
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
