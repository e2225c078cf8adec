//! Figs. 15 to 23: chaos at ω = 2.83, δ = 0.1, suppressed from iterate 2000 on.

mod delay;
mod pulse;
mod sine;

pub(super) use delay::{FIGURE_19, FIGURE_20, FIGURE_21, FIGURE_22, FIGURE_23};
pub(super) use pulse::{FIGURE_17, FIGURE_18};
pub(super) use sine::{FIGURE_15, FIGURE_16};

use serde_json::{Value, json};

use super::Claim;
use super::paper_point::WIDTH;
use crate::analysis::Reading;
use crate::control::{
    ControlQuantity, ControlSchedule, History, Outcome, Scheme, SectionValues, Target, control, converged_at,
    multipliers,
};
use crate::figure::{Figure, KeyEntry, Panel, Picture, Row, Text, TooSmall};
use crate::model::{Parameters, System};
use crate::plane::Start;
use crate::render::{ControlPicture, OrbitPanel, Response, orbit_key};
use crate::system::Family;

/// Where the paper suppresses chaos.
const OMEGA: f64 = 2.83;
/// The first controlled iterate.
const FROM: u32 = 2000;
/// Iterates at the end whose flight is drawn.
const DRAWN: u32 = 9;
/// Points of the flight in each forcing period.
const SAMPLES: f64 = 600.0;
/// Starts that differ in x2, by this much, for what only some of them show.
const STARTS: u32 = 50;
const APART: f64 = 0.01;
/// How near the last points others count as converged; non-dimensional.
const CONVERGED: f64 = 1e-6;

/// The target of the sine force and of the pulses: the 1-1-1 motion at ω = 3.7.
const TARGET: Target = Target { reference: 3.7, given: SectionValues::new([None; 4]), own: 0 };

/// A run under control.
struct Run {
    start: Start,
    scheme: Scheme,
    schedule: ControlSchedule,
    history: History,
    outcome: Outcome,
}

fn system() -> System {
    System::new(Parameters { omega: OMEGA, ..Parameters::default() }).expect("the paper's point is in range")
}

/// The start of this number; 0 is at rest.
fn start(number: u32) -> Start {
    if number == 0 { Start::Rest } else { Start::State([0.0, APART * f64::from(number), 0.0, 0.0].into()) }
}

impl Run {
    /// Controls the trajectory from a start for so many iterates altogether.
    fn new(scheme: Scheme, iterates: u32, start: Start) -> Self {
        let system = system();
        let schedule =
            ControlSchedule { from: FROM, iterates, fixed: true, max_period: ControlSchedule::MAX_PERIOD };
        let controller = scheme.resolve(&system).expect("the paper's settings are in range");
        let mut history = History::new(iterates - DRAWN - 1, system.period() / SAMPLES);
        let outcome = control::<f64, _>(&system, &start.state(&system), &controller, &schedule, &mut history);
        let outcome = outcome.expect("the paper's forces are slow enough");
        Run { start, scheme, schedule, history, outcome }
    }

    /// The first start, of so many, that ends as wanted; the run from rest if none does.
    fn first(scheme: Scheme, iterates: u32, starts: u32, wanted: impl Fn(&Run) -> bool) -> Self {
        let mut runs = (0..starts).map(|number| Run::new(scheme, iterates, start(number)));
        runs.find(wanted).unwrap_or_else(|| Run::new(scheme, iterates, Start::Rest))
    }

    /// Whether it ends on the motion that the paper shows.
    fn is_captured(&self) -> bool {
        self.outcome.verdict.label() == "1-2-1"
    }

    fn label(&self) -> String {
        if self.outcome.runaway { "runaway".to_owned() } else { self.outcome.verdict.label() }
    }

    /// The last point.
    fn point(&self) -> [f64; 4] {
        let last = self.history.returns.last();
        last.map_or([f64::NAN; 4], |met| std::array::from_fn(|i| met.section[i]))
    }

    /// Iterates from switching control on until the points stay where they end.
    fn time(&self) -> Option<u32> {
        converged_at(&system(), &self.history.returns, FROM, self.outcome.period, CONVERGED)
    }

    /// The modulus of the largest multiplier of the scheme at a fixed point.
    fn largest_multiplier(scheme: &Scheme, point: [f64; 4]) -> Option<f64> {
        let controller = scheme.resolve(&system()).ok()?;
        Some(multipliers(&system(), &controller, &point).ok()??.first()?.norm())
    }

    fn picture<'a>(&'a self, system: &'a System, labels: [&'a str; 2]) -> ControlPicture<'a> {
        let Run { start, scheme, schedule, history, .. } = self;
        ControlPicture { system, start: *start, scheme, schedule: *schedule, history, labels }
    }
}

/// What a plot of a run shows.
#[derive(Clone, Copy)]
enum Plot {
    /// A response against the iterate.
    Response(Response),
    /// The section points of the last iterates, after so many under control.
    Section([Reading; 2], u32),
    /// The flight at the end.
    Flight(OrbitPanel),
}

const PORTRAIT: Plot = Plot::Flight(OrbitPanel::Portrait([Reading::X1, Reading::V1]));
const TIME: Plot = Plot::Flight(OrbitPanel::Time(Reading::X1));
const TAU: Plot = Plot::Response(Response::Component(Reading::Tau));

/// The control signal and the four components, as in Figs. 15, 17 and 19.
const RESPONSES: [Plot; 5] = [
    Plot::Response(Response::Signal),
    TAU,
    Plot::Response(Response::Component(Reading::VAfter)),
    Plot::Response(Response::Component(Reading::X2)),
    Plot::Response(Response::Component(Reading::V2)),
];

/// Draws plots of runs, two to a row, lettered.
fn draw(plots: &[(&Run, Plot)], range: Option<[u32; 2]>, config: &str) -> Result<Picture, TooSmall> {
    let system = system();
    let gain = |run: &Run| match run.scheme {
        Scheme::Delay(delay) => Some(delay.gains[0]),
        _ => None,
    };
    let first = plots.first().map(|(run, _)| *run);
    let alike = plots.iter().all(|(run, _)| gain(run) == first.and_then(gain));
    let mut key: Vec<KeyEntry> = Vec::new();
    let mut panels = Vec::new();
    for (letter, (run, plot)) in ('a'..).zip(plots) {
        let picture = run.picture(&system, ["", ""]);
        let mut panel: Panel = match plot {
            Plot::Response(of) => {
                key.insert(0, picture.switch_key());
                picture.response(*of, range)
            }
            Plot::Section(axes, settled) => picture.section(*axes, *settled),
            Plot::Flight(panel) => {
                let flight = picture.orbit().panel(*panel, &[]);
                key = orbit_key(Family::paper(), std::slice::from_ref(&flight))
                    .into_iter()
                    .chain(key)
                    .collect();
                flight
            }
        };
        panel.weight = 1.0;
        let varied = gain(run).filter(|_| !alike).map(|g| format!(" = {g}"));
        let caption = Text::from(format!("({letter}) "));
        panel.caption = Some(match varied {
            Some(value) => caption.italic("g").upright(value),
            None => caption,
        });
        panels.push(panel);
    }
    let mut distinct: Vec<KeyEntry> = Vec::new();
    for entry in key {
        if !distinct.contains(&entry) {
            distinct.push(entry);
        }
    }
    let varied = |setting: ControlQuantity| !alike && setting.name == "gain";
    let title = first.map_or_else(Vec::new, |run| run.picture(&system, ["", ""]).title(varied));
    let figure =
        Figure { title, rows: Row::of(panels, 2, 0.75), key: distinct, notes: Vec::new(), width: 60.0 };
    figure.draw(figure.natural_size(WIDTH), config)
}

/// The settings that every one of these figures has.
fn settings(scheme: &[Scheme], iterates: u32) -> Value {
    json!({ "omega": OMEGA, "from": FROM, "iterates": iterates, "control": scheme, "starts": STARTS })
}

/// The four components of a printed point, each held against the computed one.
fn components(
    figure: u32,
    of: &str,
    printed: [&str; 4],
    computed: Option<[f64; 4]>,
    tolerance: f64,
) -> Vec<Claim> {
    let names = ["x1'+", "x2", "x2'", "τ"];
    let component = |i: usize| {
        let value = computed.map(|point| point[i]);
        Claim::within(figure, format!("{of}: {}", names[i]), printed[i], value, tolerance)
    };
    (0..4).map(component).collect()
}

fn motion(figure: u32, what: &str, printed: &str, run: &Run) -> Claim {
    let label = run.label();
    let holds = label == printed;
    Claim::new(figure, what, printed, label, holds)
}
