//! The sine force as a real force between impacts: exact flight, and what it reaches.

use impact_atlas::control::methods::Convention;
use impact_atlas::control::{
    ControlSchedule, Controlled, Controller, Scheme, SectionPoint, Surface, control, multipliers,
};
use impact_atlas::dynamics::{Contact, Event, Point, Stop, Trajectory};
use impact_atlas::model::{Flight, Parameters, State, System};

use super::{Returns, away, run, sine, starts, system};

#[test]
fn a_force_in_phase_is_a_change_of_the_forcing() {
    let f20 = system().parameters().f20;
    let stronger = system().loaded(&[1.0 - f20 - 0.3877, f20]);
    let flight = Flight::<f64, 2>::new(&stronger);
    let schedule =
        ControlSchedule { from: 0, iterates: 40, fixed: true, max_period: ControlSchedule::MAX_PERIOD };
    let start = SectionPoint::<f64, 2>::new(&[-0.3, 0.01, 0.02, 1.9]);
    let surface = Surface::new(&stronger, &flight, Stop::A);
    let follow = |flight: &Flight<f64, 2>| {
        let begun = start.trajectory(flight, &surface, Contact::FREE);
        let mut controlled =
            Controlled::<f64, 2, 2>::new(begun, surface, Controller::None(Stop::A), &schedule);
        let mut returns = Returns::default();
        controlled.follow(flight, &schedule, &mut returns);
        returns.0
    };
    let changed = follow(&flight);

    let controller = sine(Convention::Force, -0.3877, 0.0, 0.0).resolve(&system()).unwrap();
    let flight = Flight::<f64, 3>::new(&controller.flown(&system()).unwrap());
    let begun = start.trajectory(&flight, &surface, Contact::FREE);
    let mut controlled = Controlled::<f64, 2, 3>::new(begun, surface, controller, &schedule);
    controlled.force(&flight);
    let mut forced = Returns::default();
    controlled.follow(&flight, &schedule, &mut forced);
    assert_eq!(forced.0.len(), 40);
    for (a, b) in forced.0.iter().zip(&changed).take(12) {
        assert!(away(a.section, b.section) < 1e-10, "{a:?} {b:?}");
    }
    let unforced = follow(&Flight::new(&system()));
    assert!(away(unforced[0].section, changed[0].section) > 1e-3);
}

/// Eq. (2) with a force B sin θ, θ' = γω, on the first mass, by a thousand Runge-Kutta steps.
fn integrated(system: &System, mut y: [f64; 4], time: f64, b: f64, gamma: f64, phases: [f64; 2]) -> [f64; 4] {
    let omega = system.parameters().omega;
    let rates = |y: [f64; 4], t: f64| {
        let [x1, x2, v1, v2] = y;
        let forcing = (omega * t + phases[0]).sin();
        let Parameters { zeta, mu_m, mu_k, mu_c, f20, .. } = system.parameters();
        let second = mu_m / (1.0 - mu_m);
        let coupling = (x2 - x1) + 2.0 * zeta * (v2 - v1);
        let a1 = coupling + (1.0 - f20) * forcing + b * (gamma * omega * t + phases[1]).sin();
        let ground = mu_k / (1.0 - mu_k) * x2 + 2.0 * zeta * mu_c / (1.0 - mu_c) * v2;
        [v1, v2, a1, (f20 * forcing - coupling - ground) / second]
    };
    let steps = 1000;
    let h = time / f64::from(steps);
    let moved = |y: [f64; 4], k: [f64; 4], s: f64| std::array::from_fn(|i| y[i] + s * k[i]);
    for step in 0..steps {
        let t = f64::from(step) * h;
        let k1 = rates(y, t);
        let k2 = rates(moved(y, k1, h / 2.0), t + h / 2.0);
        let k3 = rates(moved(y, k2, h / 2.0), t + h / 2.0);
        let k4 = rates(moved(y, k3, h), t + h);
        y = std::array::from_fn(|i| y[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]));
    }
    y
}

/// The state of the masses, without the force's.
fn values(state: &State<f64, 3>) -> [f64; 4] {
    let [[x1, x2, _], [v1, v2, _]] = [state.x, state.v];
    [x1, x2, v1, v2]
}

#[test]
fn flight_under_a_second_frequency_is_exact() {
    let parameters = Parameters { omega: 2.83, delta: 50.0, f20: 0.3, mu_c: 0.3, ..Parameters::default() };
    for gamma in [0.37, 1.0, 2.5, 7.0] {
        let system = System::new(parameters).unwrap().driven(0, gamma).unwrap();
        let flight = Flight::<f64, 3>::new(&system);
        let phase = 0.7_f64;
        let start = [0.1, -0.2, 0.5, 0.3];
        let rate = gamma * parameters.omega * 0.8 * phase.cos();
        let state = State { x: [0.1, -0.2, 0.8 * phase.sin()], v: [0.5, 0.3, rate] };
        let point = Point::at_phase_zero(state);
        let mut trajectory = Trajectory::from_point(&flight, point, Contact::FREE, 0, 0.0);
        let mut time = 0.0;
        loop {
            let taken = trajectory.advance(&flight, &mut []);
            time += taken.time;
            if taken.event == Event::Strobe {
                break;
            }
        }
        let expected = integrated(&system, start, time, 0.8, gamma, [0.0, phase]);
        assert!(away(values(&trajectory.point.state), expected) < 1e-9, "γ = {gamma}");
        let within = integrated(&system, start, 0.6 * flight.h, 0.8, gamma, [0.0, phase]);
        assert!(
            away(values(&point.flown(&flight, 0.6 * flight.h, Contact::FREE).state), within) < 1e-12,
            "γ = {gamma}"
        );
        let unforced = integrated(&system, start, time, 0.0, gamma, [0.0, phase]);
        assert!(away(expected, unforced) > 1e-2, "the force does nothing");
    }
}

#[test]
fn impacts_under_a_second_frequency_are_on_the_stops() {
    let system = system().driven(0, 2.5).unwrap();
    let flight = Flight::<f64, 3>::new(&system);
    let state = State { x: [0.0; 3], v: [0.5, 0.0, 2.5 * system.plant().omega * 0.8] };
    let point = Point::at_phase_zero(state);
    let mut trajectory = Trajectory::from_point(&flight, point, Contact::FREE, 0, 0.0);
    let mut impacts = 0;
    for _ in 0..20_000 {
        let taken = trajectory.advance(&flight, &mut []);
        assert!(trajectory.point.state.x[0].abs() <= 0.1 * (1.0 + 1e-12));
        impacts += u32::from(matches!(taken.event, Event::Impact(_)));
    }
    assert!(impacts > 1000, "{impacts}");
}

#[test]
fn the_force_in_phase_holds_the_target_with_the_known_amplitude() {
    let runs: Vec<_> =
        starts(10).map(|start| run(&sine(Convention::Force, 0.0, 0.05, 1e-4), 6000, start)).collect();
    let held: Vec<_> = runs.iter().filter(|(outcome, _)| outcome.period == 1).collect();
    assert!(held.len() >= 3, "{}", held.len());
    for (outcome, returns) in held {
        let last = returns.last().unwrap();
        assert_eq!((outcome.verdict.label().as_str(), outcome.verdict.symmetric), ("1-1-1", false));
        assert!((last.signal + 0.3877).abs() < 1e-4, "{last:?}");
        assert!((last.section[3] - 1.802134).abs() < 1e-4);
        let controller = sine(Convention::Force, last.signal, 0.0, 0.0).resolve(&system()).unwrap();
        let largest = multipliers(&system(), &controller, &last.section).unwrap().unwrap()[0];
        assert!(largest.norm() < 1.0, "{largest}");
    }
}

#[test]
fn the_force_counted_from_each_impact_does_not_converge() {
    for start in starts(6) {
        let (outcome, _) = run(&sine(Convention::ForceLocal, 0.0, 0.05, 1e-3), 4000, start);
        assert_ne!(outcome.period, 1, "{outcome:?}");
    }
}

/// ln of the largest multiplier per forcing period, and the exponent of a run that ends there.
fn exponents(convention: Convention, phase: f64, lag_forgotten: bool) -> [f64; 2] {
    let system = System::new(Parameters::default()).unwrap();
    let mut scheme = sine(convention, -0.3, 0.0, 0.0);
    if let Scheme::Sine(setting) = &mut scheme {
        setting.phase = phase;
    }
    let controller = scheme.resolve(&system).unwrap();
    let schedule =
        ControlSchedule { from: 50, iterates: 4050, fixed: true, max_period: ControlSchedule::MAX_PERIOD };
    let mut returns = Returns::default();
    let outcome = control::<f64, _>(&system, &[0.0; 4], &controller, &schedule, &mut returns).unwrap();
    assert_eq!(outcome.verdict.label(), "1-1-1");
    let fixed = returns.0.last().unwrap().section;
    let Controller::Sine(mut held) = controller else { unreachable!("a sine force was asked for") };
    if lag_forgotten {
        // The same force on the same motion, but in phase with the forcing: as if a later impact did not delay it.
        held.convention = Convention::Force;
        held.phase = (held.phase - fixed[3] / std::f64::consts::TAU).rem_euclid(1.0);
    }
    let largest = multipliers(&system, &Controller::Sine(held), &fixed).unwrap().unwrap()[0];
    [f64::from(outcome.verdict.lyapunov), largest.norm().ln()]
}

#[test]
fn exponents_are_those_of_the_multipliers() {
    for convention in [Convention::Force, Convention::ForceLocal] {
        let [measured, predicted] = exponents(convention, 1.5, false);
        assert!((measured - predicted).abs() < 2e-3, "{convention:?}: {measured}, {predicted}");
    }
    let [measured, predicted] = exponents(Convention::ForceLocal, 1.5, true);
    assert!((measured - predicted).abs() > 5e-2, "{measured}, {predicted}");
}
