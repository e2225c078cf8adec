// Motion that can never impact again.

fn is_quiet(point: Point) -> bool {
    if flight.quiet_exists == 0u {
        return false;
    }
    let away = state_plus(point.state, -1.0, flight.quiet_forced);
    let first = applied(flight.quiet_xx, away.x) + applied(flight.quiet_xv, away.v);
    let second = applied(flight.quiet_vv, away.v);
    let size = sqrt(along(first, first) + along(second, second));
    var stays = true;
    //: each normal
    {
        let stretch = flight.normals[$k].stretch * size;
        stays = stays && flight.normals[$k].reach[0] + stretch < stops.gap[$k][0];
        stays = stays && flight.normals[$k].reach[1] + stretch < stops.gap[$k][1];
    }
    //: end
    return stays;
}
