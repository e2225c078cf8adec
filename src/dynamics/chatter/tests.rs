use super::*;
use crate::dynamics::example::{pair, single};
use crate::model::System;

/// The constants of a cell with one normal, and a force that nothing changes.
struct Cell<T> {
    flight: Flight<T, 1>,
    normal: ContactNormal<T, 1>,
}

impl<T: Real> Cell<T> {
    fn new(system: &System) -> Self {
        let mut flight = Flight::<f64, 1>::new(system).round::<T>();
        // The closed sum is that of a constant force: the rate at which it may drift is asked about by itself.
        flight.rate = T::zero();
        Cell { normal: flight.normals[0], flight }
    }

    fn close(&self, rebound: &Rebound<T>, towards: &Approach<T>) -> Option<Closure<T>> {
        close(&self.flight, &self.normal, rebound, towards)
    }
}

fn rebound<T: Real>(speed: f64, restitution: f64) -> Rebound<T> {
    let room = T::of(1e6);
    Rebound { speed: T::of(speed), restitution: T::of(restitution), unresolved: T::epsilon(), room }
}

fn steady<T: Real>(force: f64) -> Approach<T> {
    Approach { acceleration: T::of(force), jerk: T::zero(), bound: T::zero() }
}

/// ∫ gap dt, the duration and the height of rebounds against a constant force, hop after hop: Simpson's rule has no error on
/// the parabola of a hop.
fn summed(speed: f64, restitution: f64, force: f64) -> [f64; 3] {
    let (mut u, mut integral, mut time, mut height) = (speed, 0.0, 0.0, 0.0f64);
    while u > 1e-17 * speed {
        let lasts = 2.0 * u / force;
        let gap = |s: f64| u * s - 0.5 * force * s * s;
        integral += lasts / 6.0 * (gap(0.0) + 4.0 * gap(0.5 * lasts) + gap(lasts));
        height = height.max(gap(0.5 * lasts));
        time += lasts;
        u *= restitution;
    }
    [integral, time, height]
}

fn sums<T: Real>() {
    let cell = Cell::<T>::new(&single(|_| {}));
    for restitution in [0.0, 0.1, 0.5, 0.8, 0.99, 0.9999] {
        for (speed, force) in [(1e-3, 1.0), (1e-6, 0.02), (0.01, 30.0)] {
            let closure = cell.close(&rebound(speed, restitution), &steady(force)).expect("it closes");
            let [integral, time, height] = summed(speed, restitution, force);
            let near = |found: T, expected: f64| {
                let allowed = 16.0 * T::EPSILON / (1.0 - restitution) + 1e-11;
                (found.widen() / expected - 1.0).abs() < allowed
            };
            assert!(near(closure.gap_integral, integral), "{restitution} {speed} {force}: {closure:?}");
            assert!(!near(closure.gap_integral, 1.2 * integral), "the check can fail");
            assert!(
                near(closure.lasts, 2.0 * time),
                "a force that falls to the half lets them last twice as long"
            );
            assert!(near(closure.height, 2.0 * height), "and rise twice as high");
        }
    }
}

#[test]
fn the_closed_sum_is_that_of_the_rebounds() {
    sums::<f64>();
    sums::<f32>();
}

fn thresholds<T: Real>() {
    let cell = Cell::<T>::new(&single(|_| {}));
    let hop = rebound::<T>(0.25, 0.5);
    let force = steady::<T>(1.0);
    // 2u/(a(1 − r)) = 1, and twice that may be needed before the strobe.
    let closes_within = |room: f64| cell.close(&Rebound { room: T::of(room), ..hop }, &force).is_some();
    assert!(closes_within(2.0) && !closes_within(2.0 * (1.0 - T::EPSILON)));
    // The change of the force over the sequence: its jerk, and the bound on what follows.
    let closes_with = |jerk: f64, bound: f64| {
        cell.close(&hop, &Approach { jerk: T::of(jerk), bound: T::of(bound), ..force }).is_some()
    };
    assert!(closes_with(STEADY, 0.0) && closes_with(-STEADY, 0.0));
    assert!(!closes_with(STEADY * 1.001, 0.0) && !closes_with(-STEADY * 1.001, 0.0));
    assert!(closes_with(0.0, 2.0 * STEADY) && !closes_with(0.0, 2.0 * STEADY * 1.001));
    // And what the springs and dampers may do at their fastest.
    let drifting = |rate: f64| {
        let mut flight = cell.flight;
        flight.rate = T::of(rate);
        close(&flight, &cell.normal, &hop, &force).is_some()
    };
    assert!(drifting(STEADY) && !drifting(STEADY * 1.001));
    // No pressing, or the other sign: nothing completes.
    assert!(cell.close(&hop, &steady(0.0)).is_none() && cell.close(&hop, &steady(-1.0)).is_none());
    // The stop across, a gap of 1 away: u²/a must stay below it.
    let as_far = |speed: f64| cell.close(&rebound::<T>(speed, 0.0), &force).is_some();
    assert!(as_far(0.999) && !as_far(1.0));
}

#[test]
fn a_sequence_is_closed_only_where_it_surely_completes() {
    thresholds::<f64>();
    thresholds::<f32>();
}

fn at_rest<T: Real>() {
    let cell = Cell::<T>::new(&single(|_| {}));
    let lost = T::epsilon().widen();
    let nothing = Some(Closure::at_once(T::zero()));
    for restitution in [0.0, 0.7, 1.0] {
        for speed in [0.0, lost] {
            let still = rebound::<T>(speed, restitution);
            for force in [1.0, 0.0, -lost] {
                assert_eq!(cell.close(&still, &steady(force)), nothing, "{speed} {force}");
            }
            assert_eq!(cell.close(&still, &steady(-2.0 * lost)), None, "it is pulled off");
        }
    }
    assert_ne!(
        cell.close(&rebound::<T>(2.0 * lost, 0.7), &steady(1.0)),
        nothing,
        "a speed that is resolved rises"
    );
}

#[test]
fn a_speed_lost_in_rounding_is_rest_unless_it_is_pulled_off() {
    at_rest::<f64>();
    at_rest::<f32>();
}

/// What the rebounds do to a second mass counts only where it is below what may be neglected.
fn neglected<T: Real>() {
    let flight = Flight::<f64, 2>::new(&pair(0.7)).round::<T>();
    let normal = &flight.normals[0];
    assert!(normal.coupling > T::zero());
    let closes = |speed: f64| close(&flight, normal, &rebound(speed, 0.7), &steady::<T>(1.0)).is_some();
    // ⅔ u³/(a²(1 − r³)) times the coupling, times the drift rate·2u/(a(1 − r)), for u: its fourth root.
    let coupling = normal.coupling.widen();
    let share = 2.0 / 3.0 / (1.0 - 0.343) * coupling * flight.rate.widen() * 2.0 / 0.3;
    let most = (T::CHATTER / share).powf(0.25);
    assert!(closes(0.999 * most) && !closes(1.001 * most), "{most}");
}

#[test]
fn a_sequence_that_moves_the_other_mass_is_followed() {
    neglected::<f64>();
    neglected::<f32>();
}

/// All that they do to a second mass must be negligible.
fn dragged_beside<T: Real>() {
    let flight = Flight::<f64, 2>::new(&pair(1.0)).round::<T>();
    let normal = &flight.normals[0];
    let closes = |speed: f64, force: f64| {
        close(&flight, normal, &rebound(speed, 1.0), &pressed(force, normal.drag.widen(), 0.0)).is_some()
    };
    // u²/(2ac) times the coupling, for a.
    let speed = 0.9 * FADING;
    let least = speed * speed * normal.coupling.widen() / (2.0 * normal.drag.widen() * PUSH);
    assert!(closes(speed, 1.001 * least) && !closes(speed, 0.999 * least), "{least}");
}

#[test]
fn rebounds_without_loss_that_move_the_other_mass_are_followed() {
    dragged_beside::<f64>();
    dragged_beside::<f32>();
}

/// What presses on the contact, with its rate of change: in flight a damper takes its share of it.
fn pressed<T: Real>(force: f64, damping: f64, rate: f64) -> Approach<T> {
    Approach { jerk: T::of(rate - damping * force), ..steady(force) }
}

/// Rebounds without loss, that a damper drags down: u falls by ⅔ c u²/a in a hop, since a hop takes c ∫ v² dt.
fn dragged<T: Real>() {
    let (damping, force, speed) = (0.1, 1e-4, 0.999 * SLOW);
    let cell = Cell::<T>::new(&single(|plant| plant.damping[(0, 0)] = damping));
    let closure = cell.close(&rebound(speed, 1.0), &pressed(force, damping, 0.0)).expect("it closes");
    let (mut u, mut integral) = (speed, 0.0);
    for _ in 0..10_000_000 {
        integral += 2.0 / 3.0 * u.powi(3) / (force * force);
        u -= 2.0 / 3.0 * damping * u * u / force;
    }
    let found = closure.gap_integral.widen();
    assert!((found / integral - 1.0).abs() < 5e-3, "{found} for {integral}");
    // Without damping they are followed.
    let elastic = Cell::<T>::new(&single(|_| {}));
    assert!(elastic.close(&rebound(speed, 1.0), &pressed(force, 0.0, 0.0)).is_none());
    // Faster ones are closed where they are slow by the next strobe: u falls like exp(−ct/3).
    let by_the_strobe = |speed: f64, room: f64| {
        cell.close(&Rebound { room: T::of(room), ..rebound(speed, 1.0) }, &pressed(1.0, damping, 0.0))
            .is_some()
    };
    let fades = 3.0 * 50f64.ln() / damping;
    assert!(by_the_strobe(50.0 * SLOW, 1.001 * fades) && !by_the_strobe(50.0 * SLOW, 0.999 * fades));
    assert!(by_the_strobe(0.99 * FADING, 1e4) && !by_the_strobe(1.01 * FADING, 1e4));
    // A force that would vanish before they are slow, after a/(2|a′|), or that changes during a rebound.
    let falling =
        |speed: f64, jerk: f64| cell.close(&rebound(speed, 1.0), &pressed(1.0, damping, -jerk)).is_some();
    assert!(falling(50.0 * SLOW, 0.999 / (2.0 * fades)) && !falling(50.0 * SLOW, 1.001 / (2.0 * fades)));
    let during = STEADY / (2.0 * SLOW);
    assert!(falling(0.999 * SLOW, during) && !falling(0.999 * SLOW, 1.01 * during));
}

/// With a small loss besides: u falls by (1 − r) u in a hop, too. The damper alone, or the loss alone, would be told apart.
fn dragged_with_loss<T: Real>() {
    let (damping, force, speed) = (0.5, 1.0, 0.9 * FADING);
    let cell = Cell::<T>::new(&single(|plant| plant.damping[(0, 0)] = damping));
    // Before the strobe their sum is not reached.
    let room = T::of(3.0 * 100f64.ln() / damping);
    for loss in [3e-5, 1e-5, 3e-6] {
        let restitution = T::of(1.0 - loss);
        let loss = 1.0 - restitution.widen();
        let hop = Rebound { room, restitution, ..rebound(speed, 1.0) };
        let closure = cell.close(&hop, &pressed(force, damping, 0.0)).expect("it closes");
        let (mut u, mut integral) = (speed, 0.0);
        while u > 1e-4 * speed {
            integral += 2.0 / 3.0 * u.powi(3) / (force * force);
            u -= 2.0 / 3.0 * damping * u * u / force + loss * u;
        }
        let found = closure.gap_integral.widen();
        assert!((found / integral - 1.0).abs() < 1e-2, "{loss}: {found} for {integral}");
        assert!(integral < 0.9 * speed * speed / (2.0 * force * damping));
        assert!(integral < 0.9 * 2.0 / 9.0 * speed.powi(3) / (force * force * loss));
    }
    let lossy = Rebound { room, restitution: T::of(1.0 - 2.0 * NEARLY), ..rebound(0.9 * FADING, 1.0) };
    let drifts = Approach { bound: T::of(1e9), ..pressed(force, damping, 0.0) };
    assert!(cell.close(&lossy, &drifts).is_none());
}

#[test]
fn rebounds_with_a_small_loss_are_closed_where_damping_drags_them_down() {
    dragged_with_loss::<f64>();
    dragged_with_loss::<f32>();
}

#[test]
fn rebounds_without_loss_are_closed_where_damping_drags_them_down() {
    dragged::<f64>();
    dragged::<f32>();
}
