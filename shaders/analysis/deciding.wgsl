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
    let growth = observer.exponent.sum;
    let significant = exponent_per_period() > SIGNIFICANCE * exponent_standard_error();
    if growth > CHAOTIC_GROWTH && significant && !seen.sticks {
        return REGIME_CHAOTIC;
    }
    if !seen.returns && abs(growth) < NEUTRAL_GROWTH && spread_is_stationary(seen.half) {
        return REGIME_QUASI_PERIODIC;
    }
    return REGIME_UNRESOLVED;
}
