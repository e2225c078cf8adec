//! The table of result files: every file that commands write, with its arrays or columns.

use super::field::{Field, FileContent};
use crate::analysis::regime_codes;
use crate::plane::fields::{CELL_FIELDS, CellField, Inner};

const fn field(
    name: &'static str,
    [kind, shape]: [&'static str; 2],
    unit: &'static str,
    meaning: &'static str,
) -> Field {
    Field { name, kind, shape, unit, meaning }
}

const fn column(name: &'static str, kind: &'static str, unit: &'static str, meaning: &'static str) -> Field {
    Field { name, kind, shape: "", unit, meaning }
}

const REGIME: &str = regime_codes!();
const N: &str =
    "N of N-p-q; 0 where not periodic, and in motions under control of less than half a forcing period";
const P: &str = "the first count of the label: impacts at x1 = −δ in one period of the paper's oscillator; 0 where not periodic, 65535 for infinitely many (complete chatter)";
const PER_STOP: &str = "impacts at every stop in one period, in the order of the system's stops; 0 where not periodic, 65535 \
                        for infinitely many (complete chatter)";
const Q: &str = "the second count of the label: impacts at x1 = +δ in one period of the paper's oscillator, 0 where there is one stop; 0 where not periodic, 65535 for infinitely many (complete chatter)";
const SYMMETRIC: &str = "1 where x(t + Nπ/ω) = −x(t), otherwise 0";
const LYAPUNOV: &str = "largest Lyapunov exponent, natural logarithm; minus infinity where every deviation is \
                        forgotten, NaN where it was not measured";
const STATE: &str = "(x1 … xn, v1 … vn) at the end, at forcing phase 0; NaN only where the regime is failed";
const POINT: &str = "the point on σ of the motion reached, its hardest impact; zeros where nothing \
                     could be controlled, NaN only where the regime is failed";
const CONFIG: &str = "JSON: everything needed to compute the file again, and the version that did";

/// What every file of a plane ends with.
const ENDING: [Field; 3] = [
    field("x", ["f64", "x"], "1", "the values of the horizontal axis"),
    field("y", ["f64", "y"], "1", "the values of the vertical axis"),
    field("config", ["text", ""], "", CONFIG),
];

/// The fields of a file of a plane that are those of its cells.
fn of_cells(wanted: impl Fn(&CellField) -> bool) -> Vec<Field> {
    let shape = |inner: Inner| match inner {
        Inner::One => "y, x",
        Inner::Stops => "y, x, stop",
        Inner::Components => "y, x, component",
        Inner::Coordinates => "y, x, coordinate",
        Inner::Multipliers => "y, x, component, 2",
    };
    let written = |cell: &CellField| Field {
        name: cell.name,
        kind: cell.kind().name(),
        shape: shape(cell.inner),
        unit: cell.unit,
        meaning: cell.meaning,
    };
    CELL_FIELDS.iter().filter(|cell| wanted(cell)).map(written).collect()
}

fn map() -> FileContent {
    let mut fields = of_cells(|_| true);
    fields.extend(ENDING);
    FileContent {
        title: "A map, `map.npz` or `plane.zarr`",
        written_by: "Written by `map`, as `--data` names it. In a Zarr store the configuration is an attribute of the \
                     group, and every array has its dimensions' names, its unit and its meaning as attributes.",
        fields,
    }
}

/// The fields of a cell that a map under control has too.
pub const CONTROLLED: [&str; 11] = [
    "regime",
    "n",
    "p",
    "q",
    "counts",
    "symmetric",
    "lyapunov",
    "state",
    "impacts",
    "peak_impact_velocity",
    "periods",
];

fn control_map() -> FileContent {
    let mut fields = of_cells(|cell| CONTROLLED.contains(&cell.name));
    fields.iter_mut().filter(|field| field.name == "state").for_each(|field| field.meaning = POINT);
    fields.extend([
        field(
            "period",
            ["u32", "y, x"],
            "iterates",
            "iterates in one period of the motion; 0 where it has none",
        ),
        field("iterates", ["u32", "y, x"], "iterates", "iterates followed, those before control included"),
        field(
            "converged_at",
            ["u32", "y, x"],
            "iterates",
            "iterates from switching control on until the points kept returning; 4294967295 for never",
        ),
        field(
            "escapes",
            ["u32", "y, x"],
            "",
            "corrections left out because they led into the stop, or beyond another",
        ),
        field(
            "effort",
            ["f32", "y, x"],
            "1",
            "mean length of the corrections, or of the modulus of B, per iterate",
        ),
        field("signal", ["f32", "y, x"], "1", "B, or the length of the correction, at the end"),
        field(
            "runaway",
            ["u8", "y, x"],
            "",
            "1 where control drove the points beyond all bounds, otherwise 0",
        ),
    ]);
    fields.extend(ENDING);
    FileContent {
        title: "A map under control, `map.npz`",
        written_by: "Written by `map --control`, as `--data` names it.",
        fields,
    }
}

fn control_run() -> FileContent {
    FileContent {
        title: "A run under control, `control.npz`",
        written_by: "Written by `control --data`.",
        fields: vec![
            field("iterate", ["u32", "n"], "iterates", "the number of the return to σ, from 0"),
            field("section", ["f64", "n, component"], "1", "the point on σ as corrected"),
            field("arrived", ["f64", "n, component"], "1", "the point on σ before the correction"),
            field("signal", ["f64", "n"], "1", "B, or the length of the correction that was wanted"),
            field(
                "escaped",
                ["u8", "n"],
                "",
                "1 where the correction was left out because it led into the stop or beyond another, otherwise 0",
            ),
            field(
                "trajectory",
                ["f64", "m, time and component"],
                "1",
                "(time, x1 … xn, v1 … vn) of the flight at the end; time counts from its beginning",
            ),
            field("config", ["text", ""], "", CONFIG),
        ],
    }
}

fn diagram() -> FileContent {
    FileContent {
        title: "A bifurcation diagram, `bifurcation.npz`",
        written_by: "Written by `bifurcation`, as `--data` names it. Branches are each (or down, then up), as in `config`.",
        fields: vec![
            field("x", ["f64", "x"], "1", "the values of the axis, in order of writing"),
            field("counts", ["u32", "branch, x"], "", "readings kept of each column"),
            field(
                "readings",
                ["f64", "sum of counts"],
                "1",
                "the readings, ragged: column after column, branch after branch, `counts` of them each",
            ),
            field("left_out", ["u32", "branch, x"], "", "readings seen beyond `--points`, and not kept"),
            field(
                "rebounds",
                ["u32", "branch, x"],
                "impacts",
                "the longest row of impacts at one stop, each slower than the one before",
            ),
            field("regime", ["u8", "branch, x"], "", REGIME),
            field("n", ["u16", "branch, x"], "forcing periods", N),
            field("p", ["u16", "branch, x"], "impacts", P),
            field("q", ["u16", "branch, x"], "impacts", Q),
            field("symmetric", ["u8", "branch, x"], "", SYMMETRIC),
            field("lyapunov", ["f32", "branch, x"], "per forcing period", LYAPUNOV),
            field("state", ["f64", "branch, x, component"], "1", STATE),
            field("impacts_per_stop", ["u16", "branch, x, stop"], "impacts", PER_STOP),
            field(
                "spectrum",
                ["f64", "branch, x, component"],
                "that of `config`",
                "with `--spectrum` only: the 2n Lyapunov exponents, largest first; minus infinity for directions that are \
             lost, NaN where the trajectory could not be followed or the unit does not exist",
            ),
            field("config", ["text", ""], "", CONFIG),
        ],
    }
}

fn impact_table() -> FileContent {
    FileContent {
        title: "The impacts of an orbit, `impacts.csv`",
        written_by: "Written by `orbit --impacts`, a row for every impact.",
        fields: vec![
            column("time", "number", "1", "time since the start of the trajectory, transient included"),
            column(
                "stop",
                "name",
                "",
                "the stop by its name in the family; the paper's are A, x1 = +δ, and B, x1 = −δ",
            ),
            column(
                "velocity_before",
                "number",
                "1",
                "velocity before the impact along the direction of the first stop on the same line; v1 of the paper's",
            ),
            column("velocity_after", "number", "1", "the same after the impact, −r times that before"),
            column(
                "x2",
                "number",
                "1",
                "x2 at the impact; in general a column for every displacement but the one that alone meets all stops",
            ),
            column(
                "v2",
                "number",
                "1",
                "v2 once the impact is over; in general a column for every such velocity",
            ),
            column("phase", "number", "radians", "forcing phase ωt at the impact, from 0 to 2π"),
        ],
    }
}

fn trajectory_table() -> FileContent {
    FileContent {
        title: "The trajectory of an orbit, `trajectory.csv`",
        written_by: "Written by `orbit --trajectory`, a row for every sample.",
        fields: vec![
            column("time", "number", "1", "time since the start of the trajectory, transient included"),
            column("x1", "number", "1", "displacement of the first coordinate"),
            column("x2", "number", "1", "displacement of the second coordinate, and so on to xn"),
            column("v1", "number", "1", "velocity of the first coordinate"),
            column("v2", "number", "1", "velocity of the second coordinate, and so on to vn"),
        ],
    }
}

fn curve_table() -> FileContent {
    FileContent {
        title: "Bifurcation curves, `curves.csv`",
        written_by: "Written by `curves --out` and `map --curves-out`, a row for every point.",
        fields: vec![
            column("curve", "name", "", "L1 to L7 where the paper names it, otherwise a number from 1"),
            column("kind", "name", "", "fold, pitchfork, period doubling, Neimark-Sacker, or a grazing"),
            column("motion", "N-p-q", "", "the motion that bifurcates, or no impact"),
            column("x", "number", "1", "place on the horizontal axis"),
            column("y", "number", "1", "place on the vertical axis"),
            column(
                "criticality",
                "name",
                "",
                "supercritical or subcritical; empty where there is neither or it is not known",
            ),
            column("point", "name", "", "ordinary, or the name of the special point there"),
            column("symmetric", "true or false", "", "whether the motion that bifurcates is symmetric"),
            column(
                "bounding",
                "true or false",
                "",
                "whether the motion is stable on one side of the curve here",
            ),
        ],
    }
}

/// Every file that holds results.
pub fn files() -> [FileContent; 7] {
    [map(), control_map(), control_run(), diagram(), impact_table(), trajectory_table(), curve_table()]
}
