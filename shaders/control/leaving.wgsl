// How a trajectory leaves the section: from where, with which contacts.

// Whether a corrected point is on the section: the masses do not move into its stop, and are beyond no other.
fn leaving_is_admitted(section: SectionPoint) -> bool {
    let state = section_state(section);
    return section_approach(state) <= 0.0 && leaving_holds(state);
}

// Whether a state lies within all stops, up to the rounding of the flights that led to it.
fn leaving_holds(state: State) -> bool {
    var springs = X();
    var dampers = X();
    //: each coordinate
    springs = springs + abs(flight.stiffness[$i] * state.x$c);
    dampers = dampers + abs(flight.damping[$i] * state.v$c);
    //: end
    // The forcing alone, without a control force.
    let loads = (abs(flights[flow].sin) + abs(flights[flow].cos)) + abs(flights[flow].load);
    let moved = abs(state.x) + flight.h * (abs(state.v) + flight.h * ((springs + dampers) + loads));
    var holds = true;
    //: each normal
    let place$k = along(flight.normals[$k].direction, state.x);
    let rounding$k = (ROUNDINGS * EPSILON) * along(abs(flight.normals[$k].direction), abs(moved))
        + (ROUNDINGS * EPSILON) * min(abs(stops.gap[$k][0]), abs(stops.gap[$k][1]));
    holds = holds && place$k - stops.gap[$k][0] <= rounding$k;
    holds = holds && -place$k - stops.gap[$k][1] <= rounding$k;
    //: end
    return holds;
}

// The contacts that still hold at a corrected point: that with the section's stop where the masses rest on it, and those
// from which the correction moves nothing.
fn leaving_contact(section: SectionPoint, correction: SectionPoint) -> u32 {
    let state = section_state(section);
    let moved = surface_unpacked(correction, 0.0);
    var kept = trajectory.contact;
    //: each normal
    var still$k = along(flight.normals[$k].direction, moved.x) == 0.0
        && along(flight.normals[$k].direction, moved.v) == 0.0;
    if control.normal == $ku {
        still$k = section_approach(state) == 0.0;
    }
    if !still$k && !contact_is_clamped_along(kept, $ku) {
        kept = contact_without(kept, $ku);
    }
    //: end
    return kept;
}

// Leaves the section from a corrected point, under a force.
fn leaving_goes_on_from(section: SectionPoint, action: Action) {
    if section_distance(section, section_zero(), flight_reach()) > RUNAWAY {
        controlled.progress = PROGRESS_RUNAWAY;
        return;
    }
    let unchanged = section_is_zero(action.correction);
    if unchanged && action.force == controlled.force {
        return;
    }
    controlled_force(action.force);
    if unchanged {
        trajectory =
            trajectory_from_point(trajectory.point, trajectory.contact, trajectory.step, trajectory.offset);
    } else {
        trajectory = section_trajectory(section, leaving_contact(section, action.correction));
        // A phase that is set back at every return never reaches a strobe.
        controlled.moves = controlled.moves - min(controlled.moves, FAIR_MOVES);
    }
}
