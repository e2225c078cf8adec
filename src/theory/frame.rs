//! A frame of tangent vectors, kept orthogonal, and what it has grown by.

use std::sync::Arc;

use nalgebra::DMatrix;

use super::follower::Follower;
use crate::dynamics::{Event, Stop};
use crate::model::System;
use crate::system::Mooring;

/// The frame is made orthogonal again after so many time constants of the fastest motion, at the latest.
const REACH: f64 = 2.0;

/// What is known of the frame that a trajectory carries.
pub(super) struct Frame {
    /// r of each stop.
    restitution: Vec<f64>,
    /// The rate of the fastest motion.
    rate: f64,
    /// ln of the growths since they were last asked for.
    growth: Vec<f64>,
    /// Time since the frame was last made orthogonal, in time constants of the fastest motion.
    since: f64,
    /// Directions that are lost for ever.
    lost: usize,
    /// Directions that there are: those of what holds the system where it may drift are none.
    dimension: usize,
    /// What holds it.
    mooring: Option<Arc<Mooring>>,
}

impl Frame {
    /// A frame of unit vectors on a trajectory, as far as its contacts leave them: those of coordinates that stops do not
    /// bear on come first, since they are what sticking leaves.
    pub fn new(system: &System, follower: &mut dyn Follower) -> Self {
        let plant = system.plant();
        let n = plant.n;
        let borne = |i: usize| plant.stops.iter().any(|stop| stop.direction[i] != 0.0);
        let free = (0..n).filter(|&i| !borne(i)).flat_map(|i| [i, n + i]);
        let held = || (0..n).filter(|&i| borne(i));
        let order: Vec<usize> = free.chain(held().map(|i| n + i)).chain(held()).collect();
        follower.carry();
        let columns = follower.tangents();
        let columns = DMatrix::from_fn(2 * n, 2 * n, |i, j| columns[(i, order[j])]);
        let mut frame = Frame {
            restitution: plant.stops.iter().map(|stop| stop.restitution).collect(),
            rate: system.rate(),
            growth: vec![0.0; 2 * n],
            since: 0.0,
            lost: 0,
            dimension: system.dimension(),
            mooring: system.mooring().cloned(),
        };
        frame.lose(2 * contacts(follower));
        follower.set_tangents(&match frame.mooring {
            // Projected unit vectors depend on each other.
            Some(_) => frame.relative(columns).col_piv_qr().q(),
            None => columns,
        });
        if frame.kept() < 2 * n {
            frame.orthogonalise(follower);
        }
        frame
    }

    /// How many directions are not lost.
    pub fn kept(&self) -> usize {
        self.dimension - self.lost
    }

    /// Deviations without what they have along what is held.
    fn relative(&self, columns: DMatrix<f64>) -> DMatrix<f64> {
        match &self.mooring {
            Some(mooring) => &mooring.relative * columns,
            None => columns,
        }
    }

    /// What a move has done to the frame.
    pub fn note(&mut self, follower: &mut dyn Follower, time: f64, event: &Event<f64>) {
        self.since += self.rate * time;
        match event {
            Event::Impact(impact) => {
                self.lose(2 * contacts(follower) + usize::from(self.is_plastic(impact.stop)));
                self.orthogonalise(follower);
            }
            Event::Caught { impact, beside, .. } => {
                self.lose(2 * contacts(follower));
                // Of what a squeeze takes and then lets go, a shift in time is left.
                let (held, mut let_go) = (follower.stops_of(follower.contact()), follower.stops_of(*beside));
                if !let_go.is_empty() {
                    let_go.push(impact.stop);
                    let_go.retain(|stop| !held.contains(stop));
                }
                if !let_go.is_empty() {
                    self.lose(2 * (contacts(follower) + let_go.len()) - 1);
                }
                self.orthogonalise(follower);
            }
            _ if self.since > REACH => self.orthogonalise(follower),
            _ => {}
        }
    }

    fn is_plastic(&self, stop: Stop) -> bool {
        self.restitution[stop.index()] == 0.0
    }

    /// From now on so many directions at least are lost for ever.
    fn lose(&mut self, directions: usize) {
        self.lost = self.lost.max(directions);
    }

    /// The QR factorisation: the frame becomes Q, and R's diagonal is counted.
    fn orthogonalise(&mut self, follower: &mut dyn Follower) {
        self.since = 0.0;
        let size = self.growth.len();
        let frame = self.relative(follower.tangents());
        // Vectors that contacts have made vanish come last.
        let mut order: Vec<usize> = (0..size).collect();
        order.sort_by_key(|&j| frame.column(j).amax() == 0.0);
        let (mut q, r) = DMatrix::from_fn(size, size, |i, j| frame[(i, order[j])]).qr().unpack();
        // So little restitution that its square is lost in rounding is none.
        let vanished = (0..self.kept()).filter(|&j| r[(j, j)] == 0.0).count();
        self.lose(self.lost + vanished);
        let kept = self.kept();
        for (j, growth) in self.growth.iter_mut().enumerate() {
            *growth += if j < kept { libm::log(r[(j, j)].abs()) } else { f64::NEG_INFINITY };
        }
        q.columns_mut(kept, size - kept).fill(0.0);
        follower.set_tangents(&q);
    }

    /// The growths since the last call, ln of factors.
    pub fn growth(&mut self, follower: &mut dyn Follower) -> Vec<f64> {
        self.orthogonalise(follower);
        let none = vec![0.0; self.growth.len()];
        std::mem::replace(&mut self.growth, none)
    }
}

/// How many normals are in contact.
fn contacts(follower: &dyn Follower) -> usize {
    follower.contact().held().count_ones() as usize
}
