//! Verdicts from the fields of a file.

use super::{CellField, CellsError, Extras, NOT_COMPUTED, Values};
use crate::analysis::{Counts, Extent, Measures, Regime, Verdict};
use crate::model::StateVector;
use crate::plane::region_map::{Multipliers, Provenance, RegionMap};
use crate::plane::spec::Plane;
use crate::system::Family;

/// The results of some cells, those beyond verdicts where there are any.
#[derive(Clone, Debug)]
pub struct Assembled {
    /// What became of their trajectories.
    pub verdicts: Vec<Verdict>,
    /// The multipliers of the exact orbits.
    pub multipliers: Option<Vec<Option<Multipliers>>>,
    /// How far the motions go.
    pub extents: Option<Vec<Extent>>,
}

impl Assembled {
    /// The map of a plane with these results.
    pub fn map(self, plane: Plane, provenance: Provenance) -> RegionMap {
        let Assembled { verdicts, multipliers, extents } = self;
        RegionMap { plane, provenance, verdicts, multipliers, extents }
    }
}

impl From<Vec<Verdict>> for Assembled {
    fn from(verdicts: Vec<Verdict>) -> Self {
        Assembled { verdicts, multipliers: None, extents: None }
    }
}

/// The results of so many cells from their fields; what a file has beyond verdicts as far as it is asked for.
///
/// What files do not hold, the impacts over the whole trajectory and what is in question, reads as 0.
///
/// # Errors
/// What could not be read, a code that no regime has (a cell that was not computed has none), a state that is none.
pub fn assembled<E: From<CellsError>>(
    family: &Family,
    cells: usize,
    extras: Extras,
    mut read: impl FnMut(&'static CellField) -> Result<Values, E>,
) -> Result<Assembled, E> {
    let mut get = |name: &str| read(CellField::named(name).expect("the table has the field"));
    let (regime, n, counts, symmetric) = (get("regime")?, get("n")?, get("counts")?, get("symmetric")?);
    let (lyapunov, state, impacts) = (get("lyapunov")?, get("state")?, get("impacts")?);
    let (peak, periods, observed) = (get("peak_impact_velocity")?, get("periods")?, get("observed")?);
    let (power, contact) = (get("power")?, get("contact")?);
    let (stops, components) = (family.stops().len(), 2 * family.n());
    let verdict = |i: usize| {
        let code = regime.whole(i);
        if code == u32::from(NOT_COMPUTED) {
            let remedy = "compute the rest of them first: `map --data` goes on where its store ends";
            return Err(CellsError(format!("some of its cells were not computed: {remedy}")));
        }
        let of_code = u8::try_from(code).ok().and_then(Regime::from_repr);
        let per_stop: Vec<u16> = (0..stops).map(|k| counts.whole(stops * i + k) as u16).collect();
        let place: Vec<f64> = (0..components).map(|k| state.real(components * i + k)).collect();
        Ok(Verdict {
            regime: of_code.ok_or_else(|| CellsError(format!("{code} is not the code of a regime")))?,
            n: n.whole(i) as u16,
            counts: Counts::new(&per_stop),
            symmetric: symmetric.whole(i) != 0,
            lyapunov: lyapunov.real(i) as f32,
            state: StateVector::from_slice(&place)
                .ok_or_else(|| CellsError("the states do not fit the system".to_owned()))?,
            impacts: impacts.whole(i),
            impacts_total: 0,
            peak_impact_velocity: peak.real(i) as f32,
            periods: periods.whole(i),
            returning: 0,
            measures: Measures {
                observed: observed.whole(i),
                power: power.real(i) as f32,
                contact: contact.real(i) as f32,
            },
        })
    };
    let verdicts: Result<Vec<Verdict>, CellsError> = (0..cells).map(verdict).collect();
    let verdicts = verdicts?;
    let multipliers = extras.certified.then(|| get("multipliers")).transpose()?;
    let multipliers = multipliers.map(|numbers| {
        let of_cell = |i: usize| {
            let of = |k: usize| [0, 1].map(|part| numbers.real(2 * (components * i + k) + part));
            let found: Multipliers = (0..components).map(of).take_while(|value| !value[0].is_nan()).collect();
            (!found.is_empty()).then_some(found)
        };
        (0..cells).map(of_cell).collect()
    });
    let extents = extras.extents.then(|| Ok::<_, E>((get("rms")?, get("peak")?))).transpose()?;
    let extents = extents.map(|(rms, peak)| {
        let n = family.n();
        let of_cell = |values: &Values, i: usize| {
            std::array::from_fn(|k| if k < n { values.real(n * i + k) as f32 } else { 0.0 })
        };
        (0..cells).map(|i| Extent { rms: of_cell(&rms, i), peak: of_cell(&peak, i) }).collect()
    });
    Ok(Assembled { verdicts, multipliers, extents })
}
