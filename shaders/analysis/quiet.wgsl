// Motion that can never impact again.

fn is_quiet(point: Point) -> bool {
    let x2 = point.x2 - flight.forced.y;
    let stretch = (point.x1 - flight.forced.x) - x2;
    let v1 = point.v1 - flight.forced.z;
    let v2 = point.v2 - flight.forced.w;
    let twice_energy = (v1 * v1 + flight.mass * v2 * v2) + (stretch * stretch + flight.ground * x2 * x2);
    return flight.reach + flight.compliance * sqrt(twice_energy) < flight.delta;
}
