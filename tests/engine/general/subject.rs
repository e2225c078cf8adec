//! The library's trajectories, as the oracle reports its own.

use impact_atlas::dynamics::{Contact, Event, Point, Stop, Trajectory};
use impact_atlas::model::{Flight, Real, State, System};
use impact_atlas::system::{Plant, PlantStop};
use nalgebra::{DMatrix, DVector};

/// Moves in one forcing period that none of the trajectories here needs.
const MOST_MOVES: u32 = 400_000;

/// What a trajectory did in one forcing period.
#[derive(Clone, Debug, Default)]
pub struct Period {
    /// x1 … xn, v1 … vn at its end.
    pub strobe: Vec<f64>,
    /// Impacts at each stop.
    pub impacts: [u32; 4],
    /// Stops that were left, with the time since the beginning of the period.
    pub releases: Vec<(usize, f64)>,
    /// Stops in contact at its end, in order.
    pub held: Vec<usize>,
    /// How far beyond a stop d·x was, at the worst, over samples within every move, and its end.
    pub penetration: f64,
    /// Moves in it.
    pub moves: u32,
    /// Whether rebounds without loss were closed, at speeds of up to 1e-6, in this period or before.
    pub dragged: bool,
}

/// Calls a function of the number of coordinates.
macro_rules! for_coordinates {
    ($n:expr, $function:ident::<$real:ty, _>($($argument:expr),*)) => {
        match $n {
            1 => $function::<$real, 1>($($argument),*),
            2 => $function::<$real, 2>($($argument),*),
            3 => $function::<$real, 3>($($argument),*),
            _ => $function::<$real, 4>($($argument),*),
        }
    };
}

/// Follows a plant from a start at phase 0; fewer periods where it makes no headway.
pub fn follow<T: Real>(plant: &Plant, start: &[f64], periods: usize) -> Vec<Period> {
    for_coordinates!(plant.n, follow_in::<T, _>(plant, start, periods))
}

fn follow_in<T: Real, const N: usize>(plant: &Plant, start: &[f64], periods: usize) -> Vec<Period> {
    let system = System::of_plant(plant.clone()).expect("the plant can be followed");
    let flight = Flight::<f64, N>::new(&system).round::<T>();
    let start: Vec<T> = start.iter().map(|&x| T::of(x)).collect();
    let mut trajectory = Trajectory::new(&flight, State::from_slice(&start));
    let mut done: Vec<Period> = Vec::new();
    let mut period = Period::default();
    let mut moves = 0;
    while done.len() < periods && moves < MOST_MOVES {
        moves += 1;
        let before = trajectory;
        let taken = trajectory.advance(&flight, &mut []);
        for part in 0..=4 {
            let time = taken.time * T::of(0.25 * f64::from(part));
            note_penetration(&flight, &before.point.flown(&flight, time, taken.contact), &mut period);
        }
        note_penetration(&flight, &trajectory.point, &mut period);
        match taken.event {
            Event::Impact(impact) => period.impacts[impact.stop.index()] += 1,
            Event::Caught { impact, complete_chatter, .. } => {
                period.dragged |= complete_chatter && plant.stops[impact.stop.index()].restitution == 1.0;
                period.impacts[impact.stop.index()] += u32::from(impact.velocity_before != T::zero());
            }
            Event::Strobe => {
                period.strobe = trajectory.point.state.values().map(T::widen).collect();
                period.held = held(&flight, trajectory.contact);
                period.moves = moves;
                let dragged = period.dragged;
                done.push(std::mem::replace(&mut period, Period { dragged, ..Period::default() }));
                moves = 0;
            }
            _ => {}
        }
        let time = f64::from(before.step) * flight.h.widen() + before.offset.widen();
        let lost = held(&flight, before.contact);
        let kept = held(&flight, trajectory.contact);
        let at = if matches!(taken.event, Event::Released(_)) { time } else { time + taken.time.widen() };
        period.releases.extend(lost.into_iter().filter(|stop| !kept.contains(stop)).map(|stop| (stop, at)));
    }
    done
}

fn note_penetration<T: Real, const N: usize>(
    flight: &Flight<T, N>,
    point: &Point<T, N>,
    period: &mut Period,
) {
    for normal in flight.normals() {
        let place: f64 = (0..N).map(|i| normal.direction[i].widen() * point.state.x[i].widen()).sum();
        let size: f64 = (0..N).map(|i| (normal.direction[i].widen() * point.state.x[i].widen()).abs()).sum();
        let beyond = (place - normal.gap[0].widen()).max(-place - normal.gap[1].widen());
        period.penetration = period.penetration.max(beyond / (1.0 + size));
    }
}

fn held<T: Real, const N: usize>(flight: &Flight<T, N>, contact: Contact) -> Vec<usize> {
    let ends = (0..flight.count).filter_map(|k| contact.end_along(k));
    let mut stops: Vec<usize> =
        ends.map(|end| Stop(flight.normals[end.normal].stop[end.side]).index()).collect();
    stops.sort_unstable();
    stops
}

/// A plant of masses on the diagonal, at rest unless more is set.
pub fn masses(masses: &[f64], omega: f64) -> Plant {
    let n = masses.len();
    Plant {
        n,
        mass: DMatrix::from_diagonal(&DVector::from_row_slice(masses)),
        damping: DMatrix::zeros(n, n),
        stiffness: DMatrix::zeros(n, n),
        force_sin: DVector::zeros(n),
        force_cos: DVector::zeros(n),
        load: DVector::zeros(n),
        omega,
        stops: Vec::new(),
    }
}

/// A stop.
pub fn stop(direction: &[f64], gap: f64, restitution: f64) -> PlantStop {
    PlantStop { direction: DVector::from_row_slice(direction), gap, restitution }
}
