use super::*;
use crate::dynamics::swing::{Swing, step, stops, towards_upper};
use crate::system::Plant;

fn through<T: Real>() {
    let h = step();
    let mut met = 0;
    for restitution in [0.05, 0.7, 1.0] {
        for phase in [-0.5 * h, 0.0, 0.4, 0.9] {
            for share in [1e-3, 0.1, 0.49, 0.51, 0.9, 0.999] {
                for side in [1.0, -1.0] {
                    let gap = (phase + share * h).sin();
                    if phase + share * h > 1.3 || gap <= phase.sin().abs() {
                        continue;
                    }
                    let swing = Swing::<T>::new(side, phase, stops(gap, restitution));
                    let crossing =
                        crossing(&swing.leg(), &swing.leg().clearances(&swing.flight), &swing.flight);
                    assert!(crossing.certain, "{restitution} {phase} {share} {side}");
                    assert_eq!((crossing.normal.widen(), crossing.upper), (0.0, side > 0.0));
                    let slope = (phase + share * h).cos();
                    let close = |found: T, expected: f64| {
                        (found.widen() - expected).abs() < 32.0 * T::EPSILON / slope
                    };
                    assert!(close(crossing.time, share * h), "{:?} for {}", crossing.time, share * h);
                    assert!(!close(crossing.time, share * h + 1e-4), "the check can fail");
                    let velocity = side * slope;
                    assert!(close(crossing.impact.velocity, velocity));
                    assert!(close(crossing.rebound, -restitution * velocity));
                    let after = crossing.after[0];
                    assert_eq!(after.place.widen(), side * T::of(gap).widen(), "on the stop");
                    assert_eq!(after.speed, crossing.rebound);
                    let left = crossing.rest * swing.flight.h;
                    assert!(close(left, h - share * h));
                    let pull = crossing.impact.pull.widen() + side * gap;
                    assert!(pull.abs() < 256.0 * T::EPSILON / (h * h), "{pull}");
                    // The rest of the step: a swing from the stop, back.
                    let (sin, cos) = (h - share * h).sin_cos();
                    let [x, v] = [
                        side * gap * cos - restitution * velocity * sin,
                        -side * gap * sin - restitution * velocity * cos,
                    ];
                    assert!(close(crossing.ahead.state.x[0], x) && close(crossing.ahead.state.v[0], v));
                    met += 1;
                }
            }
        }
    }
    assert!(met > 50, "contacts are met: {met}");
}

#[test]
fn a_contact_within_a_step_is_that_of_the_closed_form() {
    through::<f64>();
    through::<f32>();
}

/// Hops off a stop against which a load presses: they end where the closed form says.
fn hops<T: Real>() {
    let (gap, load) = (0.5, 2.0);
    let shares = [0.02, 0.05, 0.1, 0.2, 0.4, 0.6, 0.9];
    for (side, share) in [1.0, -1.0].into_iter().flat_map(|side| shares.map(|share| (side, share))) {
        let edit = |plant: &mut Plant| {
            stops(gap, 1.0)(plant);
            plant.load[0] = side * load;
        };
        let mut swing = Swing::<T>::new(0.0, 0.0, edit);
        let time = share * step();
        let speed = (load - gap) * (0.5 * time).tan();
        swing.from.state = State { x: [T::of(side * gap)], v: [T::of(-side * speed)] };
        swing.to = swing.from.stepped(&swing.flight);
        let crossing = crossing(&swing.leg(), &swing.leg().clearances(&swing.flight), &swing.flight);
        assert!(crossing.certain, "{side} {share}");
        let most = 64.0 * T::EPSILON / speed;
        assert!(
            (crossing.time.widen() - time).abs() < most,
            "{side} {share}: {:?} for {time}",
            crossing.time
        );
        assert!((side * crossing.impact.velocity.widen() - speed).abs() < most, "{side} {share}");
        assert!((crossing.time.widen() - 0.9 * time).abs() > most, "the check can fail: {side} {share}");
    }
}

#[test]
fn a_hop_off_a_stop_ends_where_the_closed_form_says() {
    hops::<f64>();
    hops::<f32>();
}

/// What is left to the approach from the safe side.
fn refuses<T: Real>() {
    let h = step();
    let certain = |amplitude: f64, phase: f64, gap: f64, restitution: f64| {
        let swing = Swing::<T>::new(amplitude, phase, stops(gap, restitution));
        crossing(&swing.leg(), &swing.leg().clearances(&swing.flight), &swing.flight).certain
    };
    let gap = (0.5 * h).sin();
    assert!(certain(1.0, 0.0, gap, 0.7));
    assert!(!certain(1.0, 0.0, gap, 0.0), "an impact without rebound may stick");
    assert!(!certain(1.0, 0.0, 2.0 * h, 0.7), "a leg that ends within the stops crosses none");
    assert!(!certain(1.0, 0.0, h.sin() * (1.0 + 4.0 * T::EPSILON), 0.7), "nor one that ends at it");
    assert!(!certain(0.0, 0.0, gap, 0.7), "nor one at rest");
}

#[test]
fn what_is_not_certain_is_refused() {
    refuses::<f64>();
    refuses::<f32>();
}

/// A way to the stop that the certificate is asked about: from rest at `gap` with the speed and the accelerations at both
/// ends of a step of length 1, between which the acceleration changes steadily.
struct Way {
    speed: f64,
    pulls: [f64; 2],
    time: f64,
}

impl Way {
    fn place(&self, s: f64) -> f64 {
        let [first, last] = self.pulls;
        s * (self.speed + s * (0.5 * first + s * (last - first) / 6.0))
    }

    /// Whether the contact after `time` is known to be the first, with the other stop as far away.
    fn certified(&self, bound: f64, width: f64) -> bool {
        let [first, last] = self.pulls;
        let arrives = self.speed + self.time * (first + 0.5 * self.time * (last - first));
        let gap = self.place(self.time);
        stays_off(&towards_upper(gap, bound, width), gap, [self.speed, arrives], self.time)
    }
}

#[test]
fn a_way_within_its_hull_leads_to_the_first_contact() {
    let slows = Way { speed: 0.3, pulls: [-1.0, 3.0], time: 0.9 };
    assert!(slows.certified(0.0, 1.0));
    assert!(!slows.certified(1e3, 1.0), "what bounds it is too far away");
    assert!(!slows.certified(0.0, 0.25), "the other stop lies on the way");
    // It would meet the stop before, and turn: the contact is the second.
    let turns = Way { speed: 2.0, pulls: [-14.0, 20.0], time: 0.85 };
    assert!(turns.place(0.184) > turns.place(turns.time), "the stop is passed before");
    assert!(!turns.certified(0.0, 10.0));
}
