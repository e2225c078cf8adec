//! Everything that flying one cell needs, computed once per cell in f64.

use arrayvec::ArrayVec;
use nalgebra::SMatrix;

use super::contact_normal::{ContactNormal, FAR, contact_normal};
use super::equations::Equations;
use super::forced::{ForcedResponse, Trap, slowest};
use super::quiet::{Quiet, quiet};
use super::real::Real;
use super::state::State;
use super::step::Step;
use super::stops_along::StopsAlong;
use super::system::System;
use super::unit::forced;
use super::vector::{MOST, columns};

/// The constants of one cell: a step of fixed length h = T/M, and bounds that hold on it.
///
/// The flow is linear, so a whole step is one matrix, a [`Step`]. M is even and whole, so that phases 0 and π fall on steps and
/// are set exactly. Everything is non-dimensional.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flight<T, const N: usize> {
    /// M, steps in one forcing period.
    pub steps: u32,
    /// h, the length of a step.
    pub h: T,
    /// 1/h.
    pub inverse_h: T,
    /// sin ωh, by which a step turns the forcing phasor.
    pub turn_sin: T,
    /// cos ωh.
    pub turn_cos: T,
    /// ω, forcing frequency.
    pub omega: T,
    /// The fastest rate of the flow: Taylor terms of a flight of length s shrink like (rate·s)ᵏ/k!.
    pub rate: T,
    /// A step of free flight.
    pub step: Step<T, N>,
    /// −M⁻¹K, column by column.
    pub stiffness: [[T; N]; N],
    /// −M⁻¹C, column by column.
    pub damping: [[T; N]; N],
    /// M⁻¹ times the load of sin φ.
    pub sin: [T; N],
    /// M⁻¹ times the load of cos φ.
    pub cos: [T; N],
    /// M⁻¹ times the constant load.
    pub load: [T; N],
    /// The contact normals; those from `count` on mean nothing.
    pub normals: [ContactNormal<T, N>; MOST],
    /// How many contact normals there are.
    pub count: usize,
    /// By the contacts that hold (bit k for normal k), how the pressing on each follows from the accelerations d·a that
    /// the masses would have without them; see [`Equations::pressing`].
    pub pressing: [[[T; MOST]; MOST]; 1 << MOST],
    /// The forced response at phase 0, and the trap that bounds what deviates from it.
    pub quiet: Quiet<T, N>,
    /// The mirror under which the system half a forcing period later is itself, column by column, if it has one.
    pub mirror: Option<[[T; N]; N]>,
    /// The largest exponent of motion without impact, per forcing period.
    pub linear_exponent: T,
    /// How far forces carry masses, of which its unit is made with the gaps.
    pub forced: T,
    /// The displacement, and the velocity, that are of order one; see [`System::unit`].
    pub unit: T,
}

impl<const N: usize> Flight<f64, N> {
    /// Prepares a cell.
    ///
    /// # Panics
    /// If the system does not have N coordinates.
    pub fn new(system: &System) -> Self {
        Flight::kept(system).map_or_else(|| Flight::of(system), |flight| flight.with_stops_of(system))
    }

    /// The same, prepared where it stays: it is large.
    ///
    /// # Panics
    /// As [`Flight::new`].
    pub fn boxed(system: &System) -> Box<Self> {
        let Some(kept) = Flight::kept(system) else { return Box::new(Flight::of(system)) };
        let mut flight = Box::new(*kept);
        flight.take_stops_of(system);
        flight
    }

    /// The constants that are kept for a cell's flow, those of any one of its cells.
    fn kept(system: &System) -> Option<&Self> {
        system.of_flow().constants(|| Flight::of(system))
    }

    /// The stops along each normal of the system that these are the constants of.
    pub fn stops(&self, system: &System) -> ArrayVec<StopsAlong, MOST> {
        self.normals().iter().map(|normal| StopsAlong::at(normal, system)).collect()
    }

    fn of(system: &System) -> Self {
        let equations = Equations::<N>::new(system.plant());
        let steps = system.steps();
        let h = system.period() / f64::from(steps);
        let (turn_sin, turn_cos) = libm::sincos(equations.omega * h);
        let response = ForcedResponse::of(&equations);
        let trap = Trap::of(system.plant(), &equations);
        let decay = slowest(&equations.unforced());
        let mut pressing = [[[0.0; MOST]; MOST]; 1 << MOST];
        for held in 0..1 << MOST {
            // There is nothing to hold on normals that there are not.
            let there = held & ((1 << equations.count) - 1);
            pressing[held] = match there == held {
                true => equations.pressing(held as u32).unwrap_or_else(SMatrix::zeros).transpose().into(),
                false => pressing[there],
            };
        }
        let normal = |k: usize| match equations.normals().get(k) {
            Some(normal) => contact_normal(&equations, normal, k, h, response.as_ref(), trap.as_ref()),
            None => ContactNormal::none(),
        };
        let forced = system.of_flow().forced(|| forced(&equations, response.as_ref()));
        Flight {
            steps,
            h,
            inverse_h: 1.0 / h,
            turn_sin,
            turn_cos,
            omega: equations.omega,
            rate: system.rate(),
            step: Step::of(&equations, h),
            stiffness: columns(&equations.stiffness),
            damping: columns(&equations.damping),
            sin: equations.sin.into(),
            cos: equations.cos.into(),
            load: equations.load.into(),
            normals: std::array::from_fn(normal),
            count: equations.count,
            pressing,
            quiet: quiet(response.as_ref(), trap.as_ref(), decay),
            mirror: system.mirror().map(|mirror| columns(&SMatrix::from_fn(|i, j| mirror.matrix[(i, j)]))),
            linear_exponent: decay * system.period(),
            forced,
            unit: system.unit_of(forced),
        }
    }

    /// The same constants, rounded to another precision.
    pub fn round<T: Real>(&self) -> Flight<T, N> {
        let vector = |v: [f64; N]| v.map(T::of);
        let state = |s: State<f64, N>| s.map(T::of);
        Flight {
            steps: self.steps,
            h: T::of(self.h),
            inverse_h: T::of(self.inverse_h),
            turn_sin: T::of(self.turn_sin),
            turn_cos: T::of(self.turn_cos),
            omega: T::of(self.omega),
            rate: T::of(self.rate),
            step: self.step.round(),
            stiffness: self.stiffness.map(vector),
            damping: self.damping.map(vector),
            sin: vector(self.sin),
            cos: vector(self.cos),
            load: vector(self.load),
            normals: self.normals.map(|normal| normal.round()),
            count: self.count,
            pressing: self.pressing.map(|matrix| matrix.map(|row| row.map(T::of))),
            quiet: Quiet {
                exists: self.quiet.exists,
                decays: self.quiet.decays,
                forced: state(self.quiet.forced),
                xx: self.quiet.xx.map(vector),
                xv: self.quiet.xv.map(vector),
                vv: self.quiet.vv.map(vector),
            },
            mirror: self.mirror.map(|columns| columns.map(vector)),
            linear_exponent: T::of(self.linear_exponent),
            forced: T::of(self.forced),
            unit: T::of(self.unit),
        }
    }
}

impl<T: Copy, const N: usize> Flight<T, N> {
    /// A flight of so many normals in which every number is `zero`: what a layout is read from, or lanes are filled into.
    pub fn blank(count: usize, zero: T) -> Self {
        let vectors = [[zero; N]; N];
        let state = State { x: [zero; N], v: [zero; N] };
        Flight {
            steps: 0,
            h: zero,
            inverse_h: zero,
            turn_sin: zero,
            turn_cos: zero,
            omega: zero,
            rate: zero,
            step: Step::blank(zero),
            stiffness: vectors,
            damping: vectors,
            sin: [zero; N],
            cos: [zero; N],
            load: [zero; N],
            normals: [ContactNormal::blank(zero); MOST],
            count,
            pressing: [[[zero; MOST]; MOST]; 1 << MOST],
            quiet: Quiet {
                exists: false,
                decays: false,
                forced: state,
                xx: vectors,
                xv: vectors,
                vv: vectors,
            },
            mirror: None,
            linear_exponent: zero,
            forced: zero,
            unit: zero,
        }
    }
}

impl<T: Real, const N: usize> Flight<T, N> {
    /// The constants of another cell with the same flow.
    #[must_use]
    pub(super) fn with_stops_of(&self, system: &System) -> Self {
        let mut flight = *self;
        flight.take_stops_of(system);
        flight
    }

    /// Takes over the stops of another cell with the same flow.
    pub(crate) fn take_stops_of(&mut self, system: &System) {
        for normal in &mut self.normals[..self.count] {
            let along = StopsAlong::at(normal, system).with_values_of(system);
            (normal.gap, normal.restitution) = (along.gap.map(T::of), along.restitution.map(T::of));
        }
        self.unit = T::of(system.unit_of(self.forced.widen()));
    }

    /// The shortest move that is made under contacts, where nothing is met: h √ε, whose square is lost in rounding.
    #[inline(always)]
    pub fn least(&self) -> T {
        self.h * T::epsilon().sqrt()
    }

    /// How far, and how fast, masses may be carried at all: the largest of its unit, of what forces do, and of the gaps.
    #[inline(always)]
    pub fn reach(&self) -> T {
        let mut reach = if self.forced > self.unit { self.forced } else { self.unit };
        for normal in self.normals() {
            for gap in normal.gap {
                let gap = gap.abs();
                if gap < T::of(FAR) && gap > reach {
                    reach = gap;
                }
            }
        }
        reach
    }

    /// The contact normals.
    #[inline(always)]
    pub fn normals(&self) -> &[ContactNormal<T, N>] {
        &self.normals[..self.count]
    }
}
