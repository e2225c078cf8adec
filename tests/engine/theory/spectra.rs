//! Lyapunov spectra.

use impact_atlas::dynamics::{Event, Stop, Trajectory};
use impact_atlas::model::{Flight, Parameters, State, System};
use impact_atlas::theory::Spectrum;

use super::{assert_close, at};

/// Quoted from runs of some thousand iterates, whose own scatter is about 0.01.
#[test]
fn the_spectra_in_chaos_and_on_the_circle() {
    let chaotic = Spectrum::of(&at(2.83, 0.1), [0.0; 4], 500, 20_000).unwrap();
    assert_close(&chaotic.per_time(), &[0.156, -0.193, -0.257, -0.887], 0.012);
    // Long, so that of the two only the quoted one scatters.
    let low = Spectrum::of(&at(1.55, 0.1), [0.0; 4], 500, 60_000).unwrap();
    assert_close(&low.per_time(), &[0.381, -0.206, -0.219, -0.985], 0.012);
    let circle = Spectrum::of(&at(3.03, 0.1), [0.0; 4], 2000, 20_000).unwrap();
    let per_time = circle.per_time();
    let (first, rest) = (per_time[0], &per_time[1..]);
    assert!(first.abs() < 4.0 * circle.standard_error[0] / circle.period + 2e-5, "{circle:?}");
    assert_close(rest, &[-0.0238, -0.503, -0.504], 1e-3);
}

/// The largest exponent from two trajectories that are brought together again after every period, and no tangent
/// vector.
#[test]
fn the_largest_exponent_is_the_separation_of_neighbours() {
    for omega in [2.83, 1.55] {
        let system = at(omega, 0.1);
        let flight = Flight::<f64, 2>::new(&system);
        let strobe = |state: [f64; 4]| {
            let mut trajectory = Trajectory::new(&flight, State::from_slice(&state));
            while trajectory.advance(&flight, &mut []).event != Event::Strobe {}
            std::array::from_fn(|i| trajectory.point.state.get(i))
        };
        let apart = 1e-8;
        let mut state = [0.0; 4];
        for _ in 0..500 {
            state = strobe(state);
        }
        let mut neighbour = state;
        neighbour[1] += apart;
        let mut growth = 0.0;
        let periods = 20_000;
        for _ in 0..periods {
            (state, neighbour) = (strobe(state), strobe(neighbour));
            let difference: [f64; 4] = std::array::from_fn(|k| neighbour[k] - state[k]);
            let distance = difference.iter().map(|d| d * d).sum::<f64>().sqrt();
            growth += (distance / apart).ln();
            neighbour = std::array::from_fn(|k| state[k] + difference[k] * (apart / distance));
        }
        let separation = growth / f64::from(periods);
        let spectrum = Spectrum::of(&system, [0.0; 4], 500, periods).unwrap();
        let error = 5.0 * spectrum.standard_error[0];
        assert!((spectrum.per_period[0] - separation).abs() < error, "{spectrum:?} {separation}");
        assert!((spectrum.per_period[1] - separation).abs() > error, "the check can fail");
    }
}

/// The sum of the exponents is the contraction of volumes, which is known exactly.
#[test]
fn the_exponents_sum_to_the_contraction_of_volume() {
    for (omega, delta) in [(2.83, 0.1), (1.55, 0.1), (3.7, 0.1), (0.57, 0.1), (2.57, 0.6)] {
        let system = at(omega, delta);
        let spectrum = Spectrum::of(&system, [0.0; 4], 100, 160).unwrap();
        let sum: f64 = spectrum.per_period.iter().sum();
        let expected = spectrum.sum_identity(&system);
        assert!((sum - expected).abs() < 1e-6 * expected.abs(), "{omega}, {delta}: {sum} {expected}");
        let other = Parameters { zeta: 0.1001, ..system.parameters() };
        let off = spectrum.sum_identity(&System::new(other).unwrap());
        assert!((sum - off).abs() > 1e-6 * expected.abs(), "the check can fail");
    }
}

#[test]
fn sticking_loses_two_directions() {
    let spectrum = Spectrum::of(&at(0.25, 0.545), [0.0; 4], 100, 64).unwrap();
    assert_eq!(spectrum.lost, 2);
    assert!(spectrum.per_period[..2].iter().all(|exponent| exponent.is_finite()), "{spectrum:?}");
    assert_eq!(spectrum.per_period[2..], [f64::NEG_INFINITY; 2]);
    for stop in [Stop::A, Stop::B] {
        assert_eq!((spectrum.returns(stop), spectrum.per_iterate(stop)), (None, None));
    }
}

/// An iterate is a return to the stop that is asked for: between the stops of an unsymmetric motion they differ.
#[test]
fn iterates_are_returns_to_the_stop_that_is_asked_for() {
    let spectrum = Spectrum::of(&at(1.338_983, 0.14), [0.0; 4], 400, 160).unwrap();
    let [a, b] = [Stop::A, Stop::B].map(|stop| spectrum.returns(stop).unwrap());
    assert_ne!(a, b, "{spectrum:?}");
    let [at_a, at_b] = [Stop::A, Stop::B].map(|stop| spectrum.per_iterate(stop).unwrap()[3]);
    assert!((at_a * a as f64 - at_b * b as f64).abs() < 1e-9 * (at_a * a as f64).abs());
}

#[test]
fn an_impact_without_rebound_loses_one() {
    let parameters = Parameters { omega: 4.0, delta: 0.1, r: 0.0, ..Parameters::default() };
    let spectrum = Spectrum::of(&System::new(parameters).unwrap(), [0.0; 4], 100, 64).unwrap();
    assert!(spectrum.impacts > 0);
    assert_eq!(spectrum.lost, 1, "{spectrum:?}");
}

#[test]
fn without_impacts_the_exponents_are_the_linear_decay() {
    let system = at(3.0, 5.0);
    let spectrum = Spectrum::of(&system, [0.0; 4], 10, 160).unwrap();
    // Proportional damping: −ζωj² twice for each mode.
    let golden = (1.0 + 5f64.sqrt()) / 2.0;
    let decays = [-0.1 / (golden * golden), -0.1 * golden * golden];
    assert_close(&spectrum.per_time(), &[decays[0], decays[0], decays[1], decays[1]], 2e-3);
    assert_eq!((spectrum.impacts, spectrum.per_iterate(Stop::A)), (0, None));
}
