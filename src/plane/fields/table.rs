//! The table of fields: every number that a plane's cells have.

use super::field::{CellField, Drawn, Extras, Inner, Source};
use crate::analysis::regime_codes;
use crate::figure::Spread;

/// The code of the regime of a cell that was not computed yet: no regime has it.
pub const NOT_COMPUTED: u8 = u8::MAX;

const fn drawn(spread: Spread, sentinel: Option<f64>, undefined: &'static str) -> Option<Drawn> {
    Some(Drawn { spread, sentinel, undefined, lost: "minus infinity" })
}

macro_rules! meaning {
    ($first:literal) => {
        concat!($first, "; 0 where not periodic, 65535 for infinitely many (complete chatter)")
    };
}

const fn field(
    name: &'static str,
    title: &'static str,
    (inner, unit): (Inner, &'static str),
    source: Source,
    meaning: &'static str,
    drawn: Option<Drawn>,
) -> CellField {
    CellField { name, title, inner, unit, meaning, needs: Extras::NONE, drawn, source }
}

/// Every field of a cell. The regime is the first, and the last to be written: where it is there, all are.
pub const CELL_FIELDS: &[CellField] = &[
    field(
        "regime",
        "regime",
        (Inner::One, ""),
        Source::U8(|cell| cell.verdict.regime.code()),
        concat!(regime_codes!(), "; in a store 255 where not computed yet"),
        None,
    ),
    field(
        "n",
        "forcing periods in one period of the motion",
        (Inner::One, "forcing periods"),
        Source::U16(|cell, _| cell.verdict.n),
        "N of N-p-q; 0 where not periodic, and in motions under control of less than half a forcing period",
        drawn(Spread::Ratios, Some(0.0), "not periodic"),
    ),
    field(
        "p",
        "impacts at the first stop in one period",
        (Inner::One, "impacts"),
        Source::U16(|cell, _| cell.verdict.p()),
        meaning!("the first count of the label: impacts at x1 = −δ in one period of the paper's oscillator"),
        None,
    ),
    field(
        "q",
        "impacts at the second stop in one period",
        (Inner::One, "impacts"),
        Source::U16(|cell, _| cell.verdict.q()),
        meaning!(
            "the second count of the label: impacts at x1 = +δ in one period of the paper's oscillator, 0 where there is one stop"
        ),
        None,
    ),
    field(
        "counts",
        "impacts at every stop in one period",
        (Inner::Stops, "impacts"),
        Source::U16(|cell, stop| cell.verdict.counts.get(stop).copied().unwrap_or(0)),
        "impacts at every stop in one period, in the order of the labels (p, q for the paper's oscillator)",
        None,
    ),
    field(
        "symmetric",
        "whether the motion is symmetric",
        (Inner::One, ""),
        Source::U8(|cell| cell.verdict.symmetric.into()),
        "1 where x(t + Nπ/ω) = P x(t), P being the mirror (−x(t) of the paper's oscillator), otherwise 0",
        None,
    ),
    CellField {
        drawn: Some(Drawn {
            spread: Spread::AboutZero,
            sentinel: None,
            undefined: "not measured",
            lost: "minus infinity",
        }),
        ..field(
            "lyapunov",
            "largest Lyapunov exponent per forcing period",
            (Inner::One, "per forcing period"),
            Source::F32(|cell, _| cell.verdict.lyapunov),
            "largest Lyapunov exponent, natural logarithm; minus infinity where every deviation is forgotten, NaN \
             where it was not measured",
            None,
        )
    },
    field(
        "state",
        "state at the end",
        (Inner::Components, "1"),
        Source::F64(|cell, i| cell.place[i]),
        "(x1 … xn, v1 … vn) at the end, at forcing phase 0; of masses that drift, in the frame that goes with them; of an inadmissible start that start; NaN only where the regime is failed",
        drawn(Spread::Even, None, "failed"),
    ),
    field(
        "impacts",
        "impacts while observed",
        (Inner::One, "impacts"),
        Source::U32(|cell| cell.verdict.impacts),
        "impacts while the cell was observed; those without end between stops that clamp a mass are in the label alone",
        None,
    ),
    field(
        "observed",
        "forcing periods observed",
        (Inner::One, "forcing periods"),
        Source::U32(|cell| cell.verdict.measures.observed),
        "forcing periods of the observation; 0 where it was proven never to impact again, failed, or did not begin",
        None,
    ),
    field(
        "impacts_per_period",
        "impacts per forcing period",
        (Inner::One, "per forcing period"),
        Source::F32(|cell, _| cell.verdict.impacts_per_period()),
        "impacts per forcing period while the cell was observed, of complete chatter those that were followed one by one; \
         NaN where it was not, since it was proven never to impact again, failed, or did not begin",
        drawn(Spread::Ratios, Some(0.0), "no impact"),
    ),
    field(
        "peak_impact_velocity",
        "largest speed before an impact",
        (Inner::One, "1"),
        Source::F32(|cell, _| cell.verdict.peak_impact_velocity),
        "largest modulus of d·v before an impact while the cell was observed, d being the direction of the first stop on the same line; NaN where the start is inadmissible",
        drawn(Spread::Even, Some(0.0), "no impact"),
    ),
    field(
        "power",
        "power lost in impacts",
        (Inner::One, "1"),
        Source::F32(|cell, _| cell.verdict.measures.power),
        "power lost in impacts while the cell was observed: the sum of ½ (1 − r²) (d·v)²/(dᵀM⁻¹d) and of what two stops \
         without room between them take where an impact throws masses on them, per unit of time; NaN where the regime is failed or the start inadmissible",
        drawn(Spread::Ratios, Some(0.0), "no loss"),
    ),
    field(
        "contact",
        "share of time in contact",
        (Inner::One, "1"),
        Source::F32(|cell, _| cell.verdict.measures.contact),
        "share of the observation in which some contact held, from 0 to 1, rebounds that end in one left out; NaN where the regime is failed or the start inadmissible",
        drawn(Spread::Even, Some(0.0), "never in contact"),
    ),
    field(
        "periods",
        "forcing periods simulated",
        (Inner::One, "forcing periods"),
        Source::U32(|cell| cell.verdict.periods),
        "forcing periods simulated",
        None,
    ),
    field(
        "settling",
        "forcing periods until it had settled",
        (Inner::One, "forcing periods"),
        Source::F32(|cell, _| cell.verdict.settling()),
        "forcing periods before the observation that found the motion, in which it had settled or come so close that the \
         linear map of a turn led on; NaN where it is neither periodic nor free of impacts",
        drawn(Spread::Ratios, Some(0.0), "not settled"),
    ),
    CellField {
        needs: Extras { extents: true, ..Extras::NONE },
        ..field(
            "rms",
            "root mean square of the coordinate",
            (Inner::Coordinates, "1"),
            Source::F32(|cell, i| cell.extent.map_or(f32::NAN, |extent| extent.rms[i])),
            "with `--extents` only: √⟨xᵢ²⟩ of every coordinate over the forcing periods that follow on the observation, \
             whole periods of a periodic motion; NaN where the regime is failed or the start inadmissible",
            drawn(Spread::Even, None, "failed"),
        )
    },
    CellField {
        needs: Extras { extents: true, ..Extras::NONE },
        ..field(
            "peak",
            "peak of the coordinate",
            (Inner::Coordinates, "1"),
            Source::F32(|cell, i| cell.extent.map_or(f32::NAN, |extent| extent.peak[i])),
            "with `--extents` only: the largest modulus of every coordinate of the continuous motion over the same forcing periods, to 1e-4 of it; NaN \
             where the regime is failed or the start inadmissible",
            drawn(Spread::Even, None, "failed"),
        )
    },
    CellField {
        needs: Extras { certified: true, ..Extras::NONE },
        ..field(
            "multipliers",
            "Floquet multipliers",
            (Inner::Multipliers, "1"),
            Source::F64(|cell, i| {
                let multiplier = cell.multipliers.and_then(|all| all.get(i / 2));
                multiplier.map_or(f64::NAN, |value| value[i % 2])
            }),
            "with `--certify` only: real and imaginary parts of the 2n Floquet multipliers, largest modulus first; NaN \
             where no orbit was certified, and for the last ones where the masses may drift",
            None,
        )
    },
];

impl CellField {
    /// The field of a name.
    pub fn named(name: &str) -> Option<&'static CellField> {
        CELL_FIELDS.iter().find(|field| field.name == name)
    }

    /// The fields that a plane has.
    pub fn of_plane(extras: Extras) -> impl Iterator<Item = &'static CellField> {
        CELL_FIELDS.iter().filter(move |field| field.is_with(extras))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_field_comes_twice() {
        for (i, field) in CELL_FIELDS.iter().enumerate() {
            assert!(CELL_FIELDS[..i].iter().all(|other| other.name != field.name), "{}", field.name);
            assert!(field.meaning.len() > 10 && !field.title.is_empty());
            // Which cells are there is told by the regime, which is the last field of a tile to appear.
            assert_eq!(field.name == "regime", i == 0);
        }
    }
}
