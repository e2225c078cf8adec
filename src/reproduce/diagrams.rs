//! Fig. 6: bifurcation diagrams over ω at fixed δ with their Lyapunov exponents, and where 1-1-1 loses its stability.

use serde_json::json;

use super::orbits::{CHAOS, largest_exponent};
use super::paper_point::PaperPoint;
use super::stability_loss::{Change, State, changes, lost, state};
use super::{Claim, PaperFigure, Produced};
use crate::analysis::{Probe, Reading, Section};
use crate::backend::Cpu;
use crate::diagram::{DiagramSpec, ExponentUnit, Sweep};
use crate::figure::Size;
use crate::model::Parameters;
use crate::plane::Start;
use crate::render::diagram_figure;
use crate::sweep::diagram;

/// The parts whose δ is known: letter and δ.
const PARTS: [(&str, f64); 3] = [("a", 0.1), ("c", 0.545), ("d", 0.6)];
/// Frequencies at which the loss of stability is looked for before it is located.
const LOOKED_AT: u32 = 1500;
/// Forcing periods over which an exponent is measured.
const PERIODS: u32 = 20_000;

fn spec(delta: f64) -> DiagramSpec {
    DiagramSpec {
        x: "omega=0.2:5:1600".parse().expect("an axis"),
        parameters: Parameters { delta, ..Parameters::default() }.into(),
        sweep: Sweep::Each(Start::Symmetric),
        start: Start::Rest,
        probe: Probe { section: Section::A, reading: Reading::VBefore },
        schedule: DiagramSpec::schedule(1000, 200, 32),
        capacity: 3200,
        spectrum: Some(ExponentUnit::Iterate),
    }
}

/// Bifurcation diagrams of the velocity before impact at A.
pub(super) const FIGURE_6: PaperFigure = PaperFigure {
    number: 6,
    caption: "Velocity before impact and Lyapunov exponents per iterate over the forcing frequency: (a) δ = \
              0.1, (c) δ = 0.545, (d) δ = 0.6; the δ of part (b) is not legible in the text of the paper.",
    settings: || {
        let specs = PARTS.map(|(letter, delta)| json!({ "part": letter, "diagram": spec(delta) }));
        json!({ "diagrams": specs, "frequencies": LOOKED_AT, "exponents": PERIODS, "range": RANGE })
    },
    make: |config, watch| {
        let mut pictures = Vec::new();
        for (letter, delta) in PARTS {
            let diagram = diagram(&spec(delta), &Cpu, watch)?;
            let size = Size::new(2000, 1600).expect("a size");
            pictures.push((letter, diagram_figure(&diagram).draw(size, config)?));
        }
        Ok(Produced { pictures, claims: claims() })
    },
};

fn claims() -> Vec<Claim> {
    let at = |delta| changes(delta, 5.0, 0.5, LOOKED_AT);
    let small = at(0.1);
    let pitchfork = first(&small, State::BeyondMinusOne);
    let mut claims = vec![
        Claim::number(
            6,
            "(a) pitchfork of the 1-1-1 symmetric motion, ω",
            "3.6907",
            pitchfork.map(|c| c.omega),
        ),
        whole_range(pitchfork),
    ];
    let next = lost(&PaperPoint::new(3.5, 0.1), 2.95);
    let computed = next.as_ref().map_or_else(
        || "none".to_owned(),
        |loss| format!("{} {} at ω = {:.4}", loss.label, loss.kind(), loss.omega),
    );
    let holds = next.is_some_and(|loss| loss.multiplier.im != 0.0);
    let printed = "Neimark–Sacker bifurcation of the 1-1-1 unsymmetric motion";
    claims.push(Claim::new(6, "(a) what follows the pitchfork with falling ω", printed, computed, holds));
    claims.push(largest_exponent(6, &CHAOS, PERIODS, "positive (chaos)", |mean, error| mean > 5.0 * error));
    claims.extend(narrow_range(&at(0.545)));
    let large = at(0.6);
    let holds = losses(&large)
        .first()
        .is_some_and(|c| c.after == State::PairOutside && c.supercritical == Some(true));
    let claim = "(d) how 1-1-1 symmetric first loses its stability at δ = 0.6 with falling ω";
    claims.push(Claim::new(6, claim, "supercritical Neimark–Sacker", sequence(&large), holds));
    let between = [2.582, 2.57].map(|omega| state(omega, 0.6));
    let holds = between == [State::Stable, State::PairOutside];
    let computed = format!("{} at 2.582, {} at 2.57", between[0].name(), between[1].name());
    let claim = "(d) the Neimark–Sacker bifurcation at δ = 0.6 lies between ω = 2.582 and 2.57";
    claims.push(Claim::new(6, claim, "stable at 2.582, an invariant circle at 2.57", computed, holds));
    let illegible = "its δ is not legible in the text of the paper";
    claims.push(Claim::unchecked(6, "(b)", "a diagram at another δ", illegible));
    claims
}

/// Stable all the way from ω = 5 down to the pitchfork.
fn whole_range(pitchfork: Option<&Change>) -> Claim {
    let end = pitchfork.map_or(f64::NAN, |change| change.omega);
    let grid = (0..=LOOKED_AT).map(|i| 5.0 + (end + 1e-6 - 5.0) * f64::from(i) / f64::from(LOOKED_AT));
    let stable = pitchfork.is_some() && grid.into_iter().all(|omega| state(omega, 0.1) == State::Stable);
    let computed =
        if stable { format!("stable on [{end:.4}, 5]") } else { "not stable throughout".to_owned() };
    Claim::new(6, "(a) range of the stable 1-1-1 symmetric motion", "ω in [3.6907, 5]", computed, stable)
        .noted(format!("at {} frequencies, from the multipliers of the half map", LOOKED_AT + 1))
}

/// The first change to a kind of instability.
fn first(changes: &[Change], after: State) -> Option<&Change> {
    changes.iter().find(|change| change.after == after)
}

/// What is said of δ in [0.5352, 0.5602], at δ = 0.545 and for the ends of the range.
fn narrow_range(changes: &[Change]) -> Vec<Claim> {
    let found = losses(changes);
    let printed = "Neimark–Sacker, Neimark–Sacker, pitchfork, in turn with falling ω";
    let claim = "(c) how 1-1-1 symmetric loses and regains its stability at δ = 0.545";
    let order = Claim::new(6, claim, printed, sequence(changes), in_turn(changes));
    let criticality = |number: usize, printed: &str, supercritical: bool| {
        let change = found.get(number).filter(|change| is_pair(change));
        let computed = change.map_or_else(|| "none".to_owned(), Change::words);
        let holds = change.is_some_and(|change| change.supercritical == Some(supercritical));
        let which = ["first", "second"][number];
        Claim::new(
            6,
            format!("(c) the {which} Neimark–Sacker bifurcation at δ = 0.545"),
            printed,
            computed,
            holds,
        )
    };
    let [from, until] = range(|delta| in_turn(&self::changes(delta, RANGE.0, RANGE.1, RANGE.2)));
    vec![
        order,
        criticality(0, "supercritical", true),
        criticality(1, "subcritical", false),
        Claim::within(6, "(c) that order from δ", "0.5352", Some(from), RANGE_TOLERANCE),
        Claim::within(6, "(c) that order up to δ", "0.5602", Some(until), RANGE_TOLERANCE),
    ]
}

/// The frequencies at which the order of bifurcations is looked for: from, until, how many.
const RANGE: (f64, f64, u32) = (2.9, 1.1, 500);
/// Half a unit of the last printed digit of the range, and a little for the frequencies that are looked at.
const RANGE_TOLERANCE: f64 = 1e-4;

/// The range of δ about 0.545 in which something holds.
fn range(holds: impl Fn(f64) -> bool) -> [f64; 2] {
    [0.5, 0.6].map(|outside| {
        let (mut inside, mut outside) = (0.545, outside);
        for _ in 0..16 {
            let middle = 0.5 * (inside + outside);
            if holds(middle) {
                inside = middle;
            } else {
                outside = middle;
            }
        }
        0.5 * (inside + outside)
    })
}

fn is_pair(change: &Change) -> bool {
    [change.before, change.after].contains(&State::PairOutside)
}

/// Whether the motion loses its stability to a complex pair, regains it from one, and loses it in a pitchfork, with
/// nothing else in between.
fn in_turn(changes: &[Change]) -> bool {
    let first = changes.iter().position(|change| change.before == State::Stable).unwrap_or(changes.len());
    let [first, second, third, ..] = &changes[first..] else { return false };
    first.after == State::PairOutside
        && [second.before, second.after] == [State::PairOutside, State::Stable]
        && third.after == State::BeyondMinusOne
}

/// The changes between stable and unstable.
fn losses(changes: &[Change]) -> Vec<Change> {
    let stable = |change: &&Change| {
        let states = [change.before, change.after];
        states.contains(&State::Stable) && !states.contains(&State::None)
    };
    changes.iter().filter(stable).copied().collect()
}

/// All that becomes of the stable motion, its beginnings and ends too.
fn sequence(changes: &[Change]) -> String {
    let stable = |change: &&Change| [change.before, change.after].contains(&State::Stable);
    let ends = |change: &&Change| [change.before, change.after].contains(&State::None);
    let all: Vec<String> =
        changes.iter().filter(|change| stable(change) || ends(change)).map(Change::words).collect();
    if all.is_empty() { "never both stable and unstable".to_owned() } else { all.join("; ") }
}
