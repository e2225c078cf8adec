// The Taylor series of flight: one recurrence for motions and deviations.

// The unforced part of V(k+1) = s² A V(k-1) + s B V(k) (+ forcing), V(k) = v^(k) s^k, A = -M⁻¹K and B = -M⁻¹C, but for what
// contacts take from them.
struct Series {
    springs: array<X, COORDINATES>,
    dampers: array<X, COORDINATES>,
    time: f32,
    reach: f32,
}

fn series_new(s: f32) -> Series {
    let square = s * s;
    return Series(
        columns_scaled(square, flight.stiffness),
        columns_scaled(s, flight.damping),
        s,
        flight.rate * abs(s),
    );
}

// The same with the contacts that hold.
fn series_under(s: f32, contact: u32) -> Series {
    var series = series_new(s);
    if contact != CONTACT_FREE {
        //: each coordinate
        series.springs[$i] = spared(contact, series.springs[$i]);
        series.dampers[$i] = spared(contact, series.dampers[$i]);
        //: end
    }
    return series;
}

// V(1) from the displacements and V(0), the velocities.
fn series_first(series: Series, contact: u32, x: X, v: X) -> X {
    return applied(series.dampers, v) + series.time * spared(contact, applied(flight.stiffness, x));
}

// V(k+1) from V(k-1), V(k) and what the forcing adds.
fn series_next(series: Series, before: X, last: X, forced: X) -> X {
    let known = forced + applied(series.springs, before);
    return known + applied(series.dampers, last);
}
