use super::*;
use crate::dynamics::example::single;
use crate::dynamics::{Contact, Trajectory};
use crate::system::Plant;

/// A swing x = A sin(s + φ) of the unit mass on the unit spring, at the beginning of a step: its flight and its step's end.
struct Swing<T> {
    flight: Flight<T, 1>,
    from: Point<T, 1>,
    to: Point<T, 1>,
}

impl<T: Real> Swing<T> {
    fn new(amplitude: f64, phase: f64, edit: impl FnOnce(&mut Plant)) -> Self {
        let flight = Flight::<f64, 1>::new(&single(edit)).round::<T>();
        let (sin, cos) = phase.sin_cos();
        let state = State { x: [T::of(amplitude * sin)], v: [T::of(amplitude * cos)] };
        let from = Point::at_phase_zero(state);
        Swing { to: from.stepped(&flight), from, flight }
    }

    fn leg(&self) -> Leg<'_, T, 1> {
        Leg { from: &self.from, to: &self.to, window: self.flight.h }
    }

    fn h(&self) -> f64 {
        self.flight.h.widen()
    }
}

/// The length of a step.
fn step() -> f64 {
    Swing::<f64>::new(0.0, 0.0, |_| {}).h()
}

/// Sets both gaps and restitutions.
fn stops(gap: f64, restitution: f64) -> impl Fn(&mut Plant) {
    move |plant| {
        for stop in &mut plant.stops {
            (stop.gap, stop.restitution) = (gap, restitution);
        }
    }
}

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
                    assert_eq!((crossing.normals[0], crossing.upper), (true, side > 0.0));
                    let slope = (phase + share * h).cos();
                    let close = |found: T, expected: f64| {
                        (found.widen() - expected).abs() < 32.0 * T::EPSILON / slope
                    };
                    assert!(close(crossing.time, share * h), "{:?} for {}", crossing.time, share * h);
                    assert!(!close(crossing.time, share * h + 1e-4), "the check can fail");
                    let velocity = side * slope;
                    assert!(close(crossing.impact.velocity, velocity));
                    assert!(close(crossing.rebound, -restitution * velocity));
                    assert_eq!(crossing.point.state.x[0].widen(), side * T::of(gap).widen(), "on the stop");
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

/// A swing that turns just short of the stop, at it and just beyond, in the middle of a step: none of these is called certain
/// where that would pass over the touch, and no leg beyond the stop clears.
fn grazes<T: Real>() {
    let h = step();
    let phase = 0.5 * std::f64::consts::PI - 0.5 * h;
    for beyond in [-0.1, -0.05, -1e-3, -64.0 * T::EPSILON, 0.0, 64.0 * T::EPSILON, 1e-3, 1e-2] {
        let amplitude = 0.5 * (1.0 + beyond);
        let swing = Swing::<T>::new(amplitude, phase, stops(0.5, 0.7));
        let clears = swing.leg().clearances(&swing.flight).all(swing.flight.count);
        assert!(!clears || beyond < 0.0, "{beyond}");
        assert!(clears || beyond > -0.05, "a leg well short of the stop clears: {beyond}");
        // The leg ends within the stops unless the swing is large: there is nothing to cross.
        let ends_beyond = swing.to.state.x[0].widen() > 0.5;
        let crossing = crossing(&swing.leg(), &swing.leg().clearances(&swing.flight), &swing.flight);
        assert!(!crossing.certain || ends_beyond, "{beyond}");
        // The trajectory meets the stop if the swing does: at its first contact.
        let mut trajectory = Trajectory::from_point(&swing.flight, swing.from, Contact::FREE, 0, T::zero());
        let (mut at, mut struck) = (0.0, None);
        for _ in 0..200 {
            let taken = trajectory.advance(&swing.flight, &mut []);
            at += taken.time.widen();
            match taken.event {
                crate::dynamics::Event::Impact(impact) => {
                    struck = Some(impact.velocity_before.widen());
                    break;
                }
                crate::dynamics::Event::Flight => {}
                _ => break,
            }
        }
        let touch = 0.5 * std::f64::consts::PI - phase;
        if beyond > 1e-9 && beyond > 128.0 * T::EPSILON {
            let contact = (1.0 / (1.0 + beyond)).asin() - phase;
            let speed = amplitude * (contact + phase).cos();
            assert!((at - contact).abs() < 64.0 * T::EPSILON / speed, "{beyond}: {at} for {contact}");
            let struck = struck.expect("it is struck");
            assert!((struck - speed).abs() < 64.0 * T::EPSILON / speed, "{beyond}: {struck} for {speed}");
        } else if beyond <= -1e-3 {
            assert_eq!(struck, None, "{beyond}");
        } else if let Some(struck) = struck {
            // Within rounding of the touch, an impact is one whose speed is the root of rounding.
            assert!(struck.abs() < 16.0 * T::EPSILON.sqrt() && (at - touch).abs() < 32.0 * T::EPSILON.sqrt());
        }
    }
}

#[test]
fn a_tangential_touch_is_met_where_the_swing_reaches_the_stop() {
    grazes::<f64>();
    grazes::<f32>();
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

/// A way to the stop that the certificates are asked about: from rest at `gap` with the speed and the accelerations at both
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

    /// Whether the contact after `time` is known to be the first, by either certificate, with the other stop as far away.
    fn certified(&self, bound: f64, width: f64) -> [bool; 2] {
        let [first, last] = self.pulls;
        let arrives = self.speed + self.time * (first + 0.5 * self.time * (last - first));
        let gap = self.place(self.time);
        let face = Face::<f64, 1> {
            only: true,
            found: true,
            opposite_clear: false,
            normals: [true, false, false, false],
            upper: true,
            sign: 1.0,
            gap,
            width,
            restitution: 1.0,
            direction: [1.0],
            response: [1.0],
            bound,
            coupling: 0.0,
        };
        [
            is_first(&face, [self.speed, arrives], self.pulls, self.time, 1.0),
            stays_off(&face, gap, [self.speed, arrives], self.time),
        ]
    }
}

#[test]
fn a_way_that_slows_down_and_speeds_up_again_is_certified_by_its_hull() {
    let slows = Way { speed: 0.3, pulls: [-1.0, 3.0], time: 0.9 };
    assert_eq!(slows.certified(0.0, 1.0), [false, true]);
    assert_eq!(slows.certified(1e3, 1.0), [false, false], "what bounds it is too far away");
    assert_eq!(slows.certified(0.0, 0.25), [false, false], "the other stop lies on the way");
    // It would meet the stop before, and turn: the contact is the second.
    let turns = Way { speed: 2.0, pulls: [-14.0, 20.0], time: 0.85 };
    assert!(turns.place(0.184) > turns.place(turns.time), "the stop is passed before");
    assert_eq!(turns.certified(0.0, 10.0), [false, false]);
}
