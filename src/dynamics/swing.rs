//! A swing within a step, and a stop: what the tests of contacts share.

use super::along::{Along, Alongs};
use super::example::single;
use super::face::Face;
use super::hull::Span;
use super::leg::{Leg, Way};
use super::point::Point;
use crate::model::{Flight, Real, State};
use crate::system::Plant;

/// A swing x = A sin(s + φ) of the unit mass on the unit spring, at the beginning of a step: its flight and its step's end.
pub struct Swing<T> {
    pub flight: Flight<T, 1>,
    pub from: Point<T, 1>,
    pub to: Point<T, 1>,
}

impl<T: Real> Swing<T> {
    pub fn new(amplitude: f64, phase: f64, edit: impl FnOnce(&mut Plant)) -> Self {
        let flight = Flight::<f64, 1>::new(&single(edit)).round::<T>();
        let (sin, cos) = phase.sin_cos();
        let state = State { x: [T::of(amplitude * sin)], v: [T::of(amplitude * cos)] };
        let from = Point::at_phase_zero(state);
        Swing { to: from.stepped(&flight), from, flight }
    }

    pub fn leg(&self) -> Leg<'_, T, 1> {
        let from = Alongs::of(&self.from, &self.flight, self.flight.count);
        Leg::new(from, &self.to, Span::of(self.flight.h), &self.flight)
    }
}

/// The length of a step.
pub fn step() -> f64 {
    Swing::<f64>::new(0.0, 0.0, |_| {}).flight.h
}

/// Sets both gaps and restitutions.
pub fn stops(gap: f64, restitution: f64) -> impl Fn(&mut Plant) {
    move |plant| {
        for stop in &mut plant.stops {
            (stop.gap, stop.restitution) = (gap, restitution);
        }
    }
}

/// A leg of a time 1 on which (d·x)'''' is bounded, from where nothing matters.
pub fn bounded(bound: f64) -> Way<f64> {
    let along = Along { place: 0.0, speed: 0.0 };
    Way { from: along, to: along, span: Span::of(1.0), bound }
}

/// The upper stop of a unit mass.
pub fn towards_upper(gap: f64, bound: f64, width: f64) -> Face<f64, 1> {
    Face {
        only: true,
        found: true,
        returns: false,
        opposite_clear: false,
        normal: 0.0,
        upper: true,
        sign: 1.0,
        gap,
        width,
        restitution: 1.0,
        direction: [1.0],
        response: [1.0],
        way: bounded(bound),
        drag: 0.0,
        coupling: 0.0,
    }
}
