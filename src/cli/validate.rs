//! `impact-atlas validate`: one back end against the reference.

use clap::Args;
use impact_atlas::backend::{self, Backend, Choice};
use impact_atlas::control::Method;
use impact_atlas::curves::{self, bifurcation_curves};
use impact_atlas::plane::{Plane, RegionMap};
use impact_atlas::sweep::{Swept, measure_extents, sweep};
use impact_atlas::validate::{Thresholds, boundaries, compare, compare_continued, continue_strays, tipped};

use super::compared::Compared;
use super::controlled::ControlledArgs;
use super::interrupt::{Interruptible, abandonable};
use super::options::{BackendArgs, PlaneArgs, counts_iterates, sets_control};
use super::progress::Progress;
use super::report::Report;
use super::terminal::{print, print_json};
use super::values::counted;
use super::{CliError, Result, bits, defaults, estimate, note, wrong};

/// Computes the same cells on the CPU's reference and on another back end, and says how well they agree
///
/// Exit code 0 if agreement holds, 1 if it does not. Agreement means the same regime and the same N-p-q; it is
/// counted apart inside regions (cells whose eight neighbours are like them in the reference) and on boundaries. A cell
/// that the reference itself decides otherwise when its start and its parameters change by a rounding error, as happens
/// on boundaries and where motions are captured by chance, does not count.
/// With --control every cell is controlled. From a chaotic start the smallest rounding error decides which motion captures
/// a cell: choose a start, or a method, for which it does not.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  impact-atlas validate
  impact-atlas validate --cells 2000 --adapter llvmpipe --json
  impact-atlas validate --reproducible --cells 2000
  impact-atlas validate --curves --cells 480000
  impact-atlas validate --x omega=0.2:0.5:60 --y r=0.5:0.8:40 --set delta=0.2
  impact-atlas validate --control pulse --x target_v1=-0.45:-0.25:40 --y target_tau=1.4:2.2:30 --set omega=2.83")]
#[command(mut_arg("assignments", sets_control), mut_arg("max_period", counts_iterates))]
pub struct ValidateArgs {
    #[command(flatten)]
    plane: PlaneArgs,

    /// Computes about K cells, whatever COUNT the axes have [default: 120000 where no axis is given]
    #[arg(long, value_name = "K", value_parser = counted(4, Plane::LARGEST_AT_ONCE as u32))]
    cells: Option<u32>,

    #[command(flatten)]
    candidate: CandidateArgs,

    #[command(flatten)]
    control: ControlledArgs,

    /// Also holds the reference map's boundaries against the bifurcation curves
    ///
    /// Both axes must be parameters. The distances are in cells; the median over all curves must be at most one. That asks for
    /// cells smaller than the regions between the curves: for some thousand of them as a rule.
    #[arg(long)]
    curves: bool,

    /// Prints the whole report as JSON
    #[arg(long)]
    json: bool,
}

/// Runs the command.
pub fn run(args: &ValidateArgs) -> Result<()> {
    args.candidate.check()?;
    if let Some(method) = args.control.control {
        return controlled(args, method);
    }
    args.control.refuse_settings(None)?;
    if let Some(from) = args.control.again() {
        return Err(wrong!(
            "--from {} has no effect without control: drop it or choose a method with --control",
            from.display()
        ));
    }
    let plane = args.plane.axes.resized(args.plane.plane()?, args.cells, defaults::VALIDATED_CELLS);
    plane.check().map_err(CliError::input)?;
    if args.curves {
        curves::check(&plane).map_err(CliError::input)?;
    }
    let candidate = args.candidate.open()?;
    if args.candidate.reproducible {
        return bits::hold(&plane, &*candidate, args.json);
    }
    let reference = backend::open(Choice::Cpu, None)?;
    let [mut theirs, mut ours] = computed(&plane, [&*candidate, &*reference])?;
    measure_extents(&mut theirs, &*candidate, &Progress::of_cells("the candidate's extents", plane.cells()))?;
    measure_extents(&mut ours, &*reference, &Progress::of_cells("the reference's extents", plane.cells()))?;
    let strays = impact_atlas::validate::strays(&ours, &theirs).len() as u64;
    let continued = continue_strays(&ours, &theirs, &*reference, &Progress::of_cells("continuing", strays))?;
    let examined = tipped(&ours, &theirs, &*reference, &Interruptible)?;
    let agreement = compare_continued(&ours, &theirs, &continued).leaving_out(&ours, &examined);

    let made = [&ours.provenance, &theirs.provenance];
    let asked = Compared::Free(&ours.plane);
    let report =
        Report::new(asked, made, &agreement, &Thresholds::default(), args.candidate.adapter.as_deref());
    let report = if args.curves {
        let map = ours.clone();
        let curves = abandonable(move || bifurcation_curves(&map, defaults::CURVES_MAX_PERIOD))?;
        report.with_boundaries(boundaries(&ours, &curves.map_err(CliError::input)?.curves))
    } else {
        report
    };
    told(&report, args.json)
}

/// The same under control.
fn controlled(args: &ValidateArgs, method: &Method) -> Result<()> {
    let plane = args.control.plane(method, &args.plane)?;
    let plane = args.plane.axes.resized(plane, args.cells, defaults::VALIDATED_CELLS);
    plane.check().map_err(CliError::input)?;
    let candidate = args.candidate.open()?;
    let reference = backend::open(Choice::Cpu, None)?;
    let [theirs, ours] = computed(&plane, [&*candidate, &*reference])?;
    let agreement = compare(&ours, &theirs);
    let made = [&ours.provenance, &theirs.provenance];
    let asked = Compared::Controlled(&plane);
    let adapter = args.candidate.adapter.as_deref();
    told(&Report::new(asked, made, &agreement, &Thresholds::default(), adapter), args.json)
}

/// A plane as the candidate computes it, and as the reference does.
fn computed<T: Swept>(
    plane: &Plane<T>,
    [candidate, reference]: [&dyn Backend; 2],
) -> Result<[RegionMap<T>; 2]> {
    note(&format!("reference on {}: {}", reference.name(), reference.adapter()));
    let map = |what: &'static str, backend: &dyn Backend| -> Result<RegionMap<T>> {
        estimate::of_plane(&format!("the {what}'s map"), plane, backend)?;
        Ok(sweep(plane, backend, &Progress::of_cells(what, plane.cells()))?)
    };
    Ok([map("candidate", candidate)?, map("reference", reference)?])
}

/// Prints a report; success if every check in it holds.
fn told(report: &Report, json: bool) -> Result<()> {
    if json {
        print_json(report)?
    } else {
        print(&report.text())?
    }
    report.verdict()
}

/// What is held against the reference.
#[derive(Debug, Args)]
struct CandidateArgs {
    /// What is held against the CPU's reference: a GPU, or a software adapter where there is none
    ///
    /// `auto` is the same here; the CPU would be compared with itself, and is refused.
    #[arg(long, value_enum, default_value_t = Choice::Gpu)]
    backend: Choice,

    /// Uses the adapter whose name contains TEXT (see `impact-atlas adapters`)
    #[arg(long, value_name = "TEXT")]
    adapter: Option<String>,

    /// Computes with exact arithmetic, and holds every bit against the CPU's f32 instead
    ///
    /// Exit code 1 if any cell has another bit anywhere: label, exponent, state, impacts, layers.
    #[arg(long, conflicts_with_all = ["curves", "control"])]
    reproducible: bool,
}

impl CandidateArgs {
    fn check(&self) -> Result<()> {
        match self.backend {
            Choice::Auto | Choice::Gpu => Ok(()),
            Choice::Cpu => Err(wrong!(
                "--backend cpu would hold the CPU's reference against itself: drop it, or choose --backend gpu"
            )),
        }
    }

    fn open(&self) -> Result<Box<dyn Backend>> {
        let (adapter, reproducible) = (self.adapter.clone(), self.reproducible);
        BackendArgs { backend: Choice::Gpu, adapter, reproducible }.open()
    }
}

#[cfg(test)]
mod tests {
    use clap::Parser;

    use super::*;

    #[derive(Parser)]
    struct Wrapper {
        #[command(flatten)]
        args: ValidateArgs,
    }

    fn counts(options: &[&str]) -> (u32, u32) {
        let wrapper = Wrapper::parse_from([&["validate"], options].concat());
        let args = wrapper.args;
        let plane = args.plane.plane().unwrap();
        let plane = args.plane.axes.resized(plane, args.cells, defaults::VALIDATED_CELLS);
        (plane.x.count, plane.y.count)
    }

    #[test]
    fn cells_keep_the_proportion_of_the_plane() {
        assert_eq!(counts(&[]), (400, 300));
        assert_eq!(counts(&["--cells", "1200"]), (40, 30));
        assert_eq!(counts(&["--cells", "4"]), (2, 2));
        let wide = ["--x", "omega=1:2:1000", "--y", "r=0.5:0.6:10"];
        assert_eq!(counts(&wide), (1000, 10));
        assert_eq!(counts(&[&wide[..], &["--cells", "100"]].concat()), (50, 2));
        let line = ["--x", "omega=1:1:1", "--y", "r=0.5:0.6:10", "--cells", "50"];
        assert_eq!(counts(&line), (1, 50));
        let row = ["--x", "omega=1:2:7", "--y", "r=0.5:0.5:1", "--cells", "50"];
        assert_eq!(counts(&row), (50, 1));
    }
}
