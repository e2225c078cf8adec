//! A trajectory of any number of coordinates, behind one trait.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};

use super::section_vector::wrapped;
use crate::analysis::Loss;
use crate::dynamics::{Contact, Move, Moves, Stop, Tangent, Trajectory, catch_all};
use crate::model::vector::axpy;
use crate::model::{Flight, OfFlow, State, System, are_bounded};

/// A trajectory of the certified flight, with or without tangent vectors.
pub(super) trait Follower {
    /// Takes over the stops of another system, where its flow is known to be the same; says whether it is.
    fn restop(&mut self, system: &System) -> bool;

    /// Begins at forcing phase 0 with (x, v) within the stops, without tangent vectors.
    fn begin(&mut self, state: &[f64]);

    /// Begins at a forcing phase with displacements and velocities within the stops, without tangent vectors.
    fn begin_at(&mut self, x: &[f64], v: &[f64], phase: f64);

    /// Carries the columns of the unit matrix along from now on, as far as the contacts leave them.
    fn carry(&mut self);

    /// Moves on to the next event, the end of the step at the latest.
    fn advance(&mut self) -> Move<f64>;

    /// Moves on to the next event but the end of a step.
    fn advance_to_event(&mut self) -> Move<f64>;

    /// The displacements.
    fn x(&self) -> &[f64];

    /// The velocities.
    fn v(&self) -> &[f64];

    /// What is in contact.
    fn contact(&self) -> Contact;

    /// The stops that clamp a mass for ever, in the plant's order.
    fn clamping(&self) -> Vec<usize>;

    /// The stops of some contacts.
    fn stops_of(&self, contact: Contact) -> Vec<Stop>;

    /// What impacts took, and how long contacts held, between the events since it began at forcing phase 0.
    fn loss(&self) -> Loss<f64>;

    /// The time since forcing phase 0 was last met.
    fn elapsed(&self) -> f64;

    /// The tangent vectors, (x, v) each, as columns.
    fn tangents(&self) -> DMatrix<f64>;

    /// Replaces the tangent vectors.
    fn set_tangents(&mut self, columns: &DMatrix<f64>);

    /// Moves displacements that lie beyond stops onto them.
    fn bring_within(&self, x: &mut [f64]);

    /// (x, v).
    fn state(&self) -> DVector<f64> {
        DVector::from_iterator(2 * self.x().len(), self.x().iter().chain(self.v()).copied())
    }

    /// Whether every component is a finite number.
    fn is_finite(&self) -> bool {
        self.x().iter().chain(self.v()).all(|value| value.is_finite())
    }

    /// Whether it is followed further: see [`State::is_bounded`].
    fn is_bounded(&self) -> bool {
        are_bounded(self.x().iter().chain(self.v()))
    }

    /// Moves on to the next event but the end of a step; none where the state is not finite then, or the moves are too many.
    fn next_event(&mut self, moves: &mut Moves) -> Option<Move<f64>> {
        let taken = self.advance_to_event();
        moves.add();
        (!moves.are_too_many() && self.is_finite()).then_some(taken)
    }

    /// The forcing phase in [0, 2π).
    fn phase(&self, omega: f64) -> f64 {
        wrapped(omega * self.elapsed())
    }
}

/// A follower of a system, to be begun.
pub(super) fn follower(system: &System) -> Box<dyn Follower> {
    match system.coordinates() {
        1 => Box::new(Following::<1, 2>::new(system)),
        2 => Box::new(Following::<2, 4>::new(system)),
        3 => Box::new(Following::<3, 6>::new(system)),
        _ => Box::new(Following::<4, 8>::new(system)),
    }
}

/// A follower of one system after the other: those with the same flow have it in common.
#[derive(Default)]
pub(super) struct KeptFollower(Option<Box<dyn Follower>>);

impl KeptFollower {
    /// A follower of a system.
    pub fn of(&mut self, system: &System) -> &mut dyn Follower {
        self.0.take_if(|kept| !kept.restop(system));
        self.0.get_or_insert_with(|| follower(system)).as_mut()
    }
}

/// With N coordinates and K = 2N tangent vectors.
struct Following<const N: usize, const K: usize> {
    of_flow: Arc<OfFlow>,
    flight: Box<Flight<f64, N>>,
    trajectory: Trajectory<f64, N>,
    frame: [Tangent<f64, N>; K],
    carries: bool,
    loss: Loss<f64>,
}

impl<const N: usize, const K: usize> Following<N, K> {
    fn new(system: &System) -> Self {
        let flight = Flight::boxed(system);
        let trajectory = Trajectory::new(&flight, State::zero());
        let of_flow = Arc::clone(system.of_flow());
        let loss = Loss::none(Contact::FREE);
        Following { of_flow, flight, trajectory, frame: [Tangent(State::zero()); K], carries: false, loss }
    }
}

impl<const N: usize, const K: usize> Follower for Following<N, K> {
    fn restop(&mut self, system: &System) -> bool {
        let fits = Arc::ptr_eq(&self.of_flow, system.of_flow());
        if fits {
            self.flight.take_stops_of(system);
        }
        fits
    }

    fn begin(&mut self, state: &[f64]) {
        self.trajectory = Trajectory::new(&self.flight, State::from_slice(state));
        self.carries = false;
        self.loss = Loss::none(self.trajectory.contact);
    }

    fn begin_at(&mut self, x: &[f64], v: &[f64], phase: f64) {
        let state = State { x: std::array::from_fn(|i| x[i]), v: std::array::from_fn(|i| v[i]) };
        self.trajectory = Trajectory::at_phase(&self.flight, state, phase);
        self.carries = false;
    }

    fn carry(&mut self) {
        self.carries = true;
        self.set_tangents(&DMatrix::identity(K, K));
        // Of a trajectory in contact that is what the contacts leave; in flight it is all.
        catch_all(&mut self.frame, &self.flight, self.trajectory.contact);
    }

    fn advance(&mut self) -> Move<f64> {
        if self.carries {
            self.trajectory.advance(&self.flight, &mut self.frame)
        } else {
            self.trajectory.advance(&self.flight, &mut [])
        }
    }

    fn advance_to_event(&mut self) -> Move<f64> {
        let taken = if self.carries {
            self.trajectory.advance_to_event(&self.flight, &mut self.frame)
        } else {
            self.trajectory.advance_to_event(&self.flight, &mut [])
        };
        self.loss.note(&self.flight, &self.trajectory, &taken);
        taken
    }

    fn x(&self) -> &[f64] {
        &self.trajectory.point.state.x
    }

    fn v(&self) -> &[f64] {
        &self.trajectory.point.state.v
    }

    fn contact(&self) -> Contact {
        self.trajectory.contact
    }

    fn clamping(&self) -> Vec<usize> {
        let clamped = |k: &usize| self.trajectory.contact.is_clamped_along(*k);
        let mut stops: Vec<usize> = (0..self.flight.count)
            .filter(clamped)
            .flat_map(|k| self.flight.normals[k].stop.map(usize::from))
            .collect();
        stops.sort_unstable();
        stops
    }

    fn stops_of(&self, contact: Contact) -> Vec<Stop> {
        contact.stops(&self.flight).collect()
    }

    fn loss(&self) -> Loss<f64> {
        self.loss
    }

    fn elapsed(&self) -> f64 {
        f64::from(self.trajectory.step) * self.flight.h + self.trajectory.offset
    }

    fn tangents(&self) -> DMatrix<f64> {
        let mut frame = self.frame;
        self.trajectory.bring_back(&self.flight, &mut frame);
        DMatrix::from_fn(K, K, |i, j| frame[j].0.get(i))
    }

    fn set_tangents(&mut self, columns: &DMatrix<f64>) {
        self.frame = std::array::from_fn(|j| Tangent(State::from_slice(columns.column(j).as_slice())));
        self.trajectory.carry(&self.flight, &mut self.frame);
    }

    /// Along the responses of the normals at whose ends it lies too far, of all of them at once.
    fn bring_within(&self, x: &mut [f64]) {
        let normals = self.flight.normals();
        let mut held = 0;
        for _ in 0..normals.len() {
            let beyond = |k: usize| {
                let normal = &normals[k];
                let place: f64 = normal.direction.iter().zip(&*x).map(|(d, x)| d * x).sum();
                place - place.clamp(-normal.gap[1], normal.gap[0])
            };
            let excess: Vec<f64> = (0..normals.len()).map(beyond).collect();
            let more = (0..normals.len()).filter(|&k| excess[k] != 0.0).fold(held, |held, k| held | 1 << k);
            if more == held {
                return;
            }
            held = more;
            for (s, normal) in normals.iter().enumerate() {
                let push: f64 =
                    (0..normals.len()).map(|t| self.flight.pressing[held][s][t] * excess[t]).sum();
                let here: [f64; N] = std::array::from_fn(|i| x[i]);
                x.copy_from_slice(&axpy(-push, &normal.response, &here));
            }
        }
    }
}
