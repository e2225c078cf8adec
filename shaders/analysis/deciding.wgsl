// The regime of a motion that impacts, from what was observed of it.

// What was observed beside the growth of a tangent vector and the spread of points; `measured` unless the vector was lost,
// `half` the points in either half of the observation.
struct Evidence {
    returns: bool,
    settled: bool,
    sticks: bool,
    measured: bool,
    half: u32,
}

fn evidence_regime(seen: Evidence) -> u32 {
    if seen.returns && seen.settled {
        return select(REGIME_PERIODIC, REGIME_PERIODIC_STICKING, seen.sticks);
    }
    if seen.sticks && !seen.returns {
        return REGIME_APERIODIC_STICKING;
    }
    if observer.exponent.batches == 0u || !seen.measured {
        return REGIME_UNRESOLVED;
    }
    if exponent_grows(CHAOTIC_GROWTH) && !seen.sticks {
        return REGIME_CHAOTIC;
    }
    if !seen.returns && abs(observer.exponent.sum) < NEUTRAL_GROWTH && spread_is_stationary(seen.half) {
        return REGIME_QUASI_PERIODIC;
    }
    return REGIME_UNRESOLVED;
}

// Whether a tangent vector grows, by more than that in all and by more than may be chance.
fn exponent_grows(least: f32) -> bool {
    let significant = exponent_per_period() > SIGNIFICANCE * exponent_standard_error();
    return observer.exponent.sum > least && significant;
}
