//! What `impact-atlas control` prints.

use impact_atlas::control::{
    Controller, History, Method, Outcome, SectionValues, converged_at, multipliers, section_names,
};
use impact_atlas::model::System;
use serde::Serialize;

use super::{CliError, Result, multipliers as written};

/// What is printed; every quantity non-dimensional.
#[derive(Debug, Serialize)]
pub struct Report {
    method: &'static str,
    pub label_before: String,
    pub label_after: String,
    /// The stop at whose impacts it acts.
    stop: &'static str,
    /// The components of X by name.
    section_names: Vec<String>,
    /// X if every iterate ends there.
    fixed_point: Option<SectionValues<f64>>,
    /// Iterates from switching control on until the points stay within the tolerance of the final ones.
    converged_at: Option<u32>,
    tolerance: f64,
    /// Mean length of a correction, or mean |B| of a force.
    effort: f32,
    /// The two points of a period-two motion.
    period_two: Option<[SectionValues<f64>; 2]>,
    escapes: u32,
    /// Iterates in one period of the motion reached.
    period: Option<u32>,
    /// B, or the length of the correction, at the end.
    signal: f32,
    /// What the method aims at: X0, or one component of it.
    target: Option<Vec<f64>>,
    /// The largest Lyapunov exponent under control per forcing period, where there is one.
    lyapunov: f32,
    /// (re, im) of the multipliers of the controlled fixed point, B as it is at the end.
    multipliers: Option<Vec<[f64; 2]>>,
    runaway: bool,
    iterates: usize,
}

/// A run under control, as it is reported.
pub struct Ran<'a> {
    /// The method.
    pub method: &'static Method,
    /// The first iterate that is controlled.
    pub from: u32,
    /// How near the final points count as converged.
    pub tolerance: f64,
    /// The system.
    pub system: &'a System,
    /// What controls it.
    pub controller: &'a Controller<f64>,
    /// Every return.
    pub history: &'a History,
    /// What became of it.
    pub outcome: &'a Outcome,
    /// What the trajectory is without control.
    pub before: String,
}

impl Report {
    pub fn of(ran: Ran) -> Result<Self> {
        let Ran { method, from, tolerance, system, controller, history, outcome, before } = ran;
        let returns = &history.returns;
        let point = |back: usize| returns[returns.len() - 1 - back].section;
        let fixed_point = (outcome.period == 1).then(|| point(0));
        let held = controller.held(Some(f64::from(outcome.signal)));
        let found = match fixed_point {
            Some(fixed) => multipliers(system, &held, &fixed).map_err(CliError::input)?,
            None => None,
        };
        Ok(Report {
            method: method.name,
            label_before: before,
            stop: system.stop_name(controller.stop().index()),
            section_names: section_names(system.plant(), controller.stop()),
            label_after: if outcome.runaway { "runaway".to_owned() } else { outcome.verdict.label() },
            fixed_point,
            converged_at: converged_at(system, returns, from, outcome.period, tolerance),
            tolerance,
            effort: outcome.effort,
            period_two: (outcome.period == 2).then(|| [point(1), point(0)]),
            escapes: outcome.escapes,
            period: (outcome.period > 0).then_some(outcome.period),
            signal: outcome.signal,
            target: controller.target(),
            lyapunov: outcome.verdict.lyapunov,
            multipliers: found.map(|found| found.iter().map(|value| [value.re, value.im]).collect()),
            runaway: outcome.runaway,
            iterates: returns.len(),
        })
    }

    pub fn text(&self) -> String {
        let mut lines = vec![
            format!("before control  {}", self.label_before),
            format!("under control   {}", self.label_after),
        ];
        let point = |values: SectionValues<f64>| written::point(self.section_names.iter().cloned(), &values);
        lines.extend(self.fixed_point.map(|fixed| format!("fixed point     {}", point(fixed))));
        if let Some([a, b]) = self.period_two {
            lines.push(format!("period two      {}\n                {}", point(a), point(b)));
        }
        match (self.converged_at, self.period) {
            (Some(n), _) => lines.push(format!("converged       {n} iterates after control was switched on")),
            (None, Some(_)) => lines.push(format!(
                "converged       not to within {:e} yet: give more --iterates, or a larger --tolerance",
                self.tolerance
            )),
            (None, None) => {}
        }
        lines
            .push(format!("control signal  {:.6e} at the end, mean effort {:.6e}", self.signal, self.effort));
        lines.push(format!("escapes         {}", self.escapes));
        lines.join("\n")
    }
}
