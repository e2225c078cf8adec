//! A line along which one stop, or two that face each other, are met.

use nalgebra::SVector;

use super::back::{self, BACK_TERMS, back};
use super::bound::{Bound, OTHERS, others};
use super::equations::{Equations, Normal};
use super::forced::{ForcedResponse, Trap};
use super::kick::{self, KICK_TERMS, kick, polynomial};
use super::real::{Lanes, Real};
use super::row::Row;
use super::state::State;
use super::step::Step;

/// What a contact normal is to a trajectory.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactNormal<T, const N: usize> {
    /// d.
    pub direction: [T; N],
    /// M⁻¹d/(dᵀM⁻¹d): an impact that changes d·v by 1 changes v by this.
    pub response: [T; N],
    /// 1/(dᵀM⁻¹d), the mass that an impact moves.
    pub mass: T,
    /// The gaps at the upper and the lower end: stops where d·x and where −d·x meets them. [`FAR`] where there is none.
    pub gap: [T; 2],
    /// Coefficients of restitution at the ends.
    pub restitution: [T; 2],
    /// Which of the plant's stops are at the ends.
    pub stop: [u8; 2],
    /// That of (d·x)'''' in free flight and in any contact, and of the second derivative of what presses on this contact.
    pub bound: Bound<T, N>,
    /// That of the second derivative of what presses on this contact, by what else holds; see [`others`].
    pub pressed: [Bound<T, N>; OTHERS],
    /// That of the sixth derivative of d·x while nothing holds along this normal, likewise: for x'' as the state, which flows like x
    /// without loads, forced by −ω² times as much.
    pub sixth: [Bound<T, N>; OTHERS],
    /// A step while masses rest on a stop along this normal, and on no other.
    pub held: Step<T, N>,
    /// What a change of d·v by 1 has become a time s later: Σ kickₖ (s/h)ᵏ, 0 ≤ s ≤ h, up to [`Real::KICK_ORDER`].
    pub kick: [State<T, N>; KICK_TERMS],
    /// Where a motion was along d a time s ago in free flight: d·x = Σ (s/h)ᵏ backₖ·(x, v, sin φ, cos φ, 1), likewise, up
    /// to [`Real::BACK_ORDER`].
    pub back: [Row<T, N>; BACK_TERMS],
    /// How fast damping alone takes speed along the normal: −d·(−M⁻¹C)·response.
    pub drag: T,
    /// A bound on what ∫ gap dt of skipped rebounds does to the masses, per unit of it.
    pub coupling: T,
    /// The farthest that the forced response goes towards either end; [`FAR`] where there is none.
    pub reach: [T; 2],
    /// The farthest |d·x| of a deviation from it, per square root of the trap's form.
    pub stretch: T,
}

/// What stands for a stop where a normal has none.
pub const NO_STOP: u8 = u8::MAX;

/// A length, a time or an amplitude beyond all others, and finite in either precision.
pub const FAR: f64 = 1e30;

impl<T: Copy, const N: usize> ContactNormal<T, N> {
    pub(super) fn blank(zero: T) -> Self {
        let vector = [zero; N];
        ContactNormal {
            direction: vector,
            response: vector,
            mass: zero,
            gap: [zero; 2],
            restitution: [zero; 2],
            stop: [0; 2],
            bound: Bound::all(zero),
            pressed: [Bound::all(zero); OTHERS],
            sixth: [Bound::all(zero); OTHERS],
            held: Step::blank(zero),
            kick: [State { x: vector, v: vector }; KICK_TERMS],
            back: [Row::all(zero); BACK_TERMS],
            drag: zero,
            coupling: zero,
            reach: [zero; 2],
            stretch: zero,
        }
    }
}

impl<L: Lanes, const N: usize> ContactNormal<L, N> {
    /// What a change of d·v by 1 has become after the share u = s/h of a step.
    #[inline(always)]
    pub fn wake(&self, u: L) -> State<L, N> {
        polynomial(&self.kick, u)
    }

    /// The row that gives d·x of a deviation before the share u = s/h of a step, from the deviation after it.
    #[inline(always)]
    pub fn look_back(&self, u: L) -> State<L, N> {
        let mut sum = self.back[L::Real::BACK_ORDER].state;
        for k in (0..L::Real::BACK_ORDER).rev() {
            sum = self.back[k].state.plus(u, &sum);
        }
        sum
    }
}

impl<const N: usize> ContactNormal<f64, N> {
    pub(super) fn none() -> Self {
        ContactNormal { gap: [FAR; 2], reach: [FAR; 2], ..ContactNormal::blank(0.0) }
    }

    pub(super) fn round<T: Real>(&self) -> ContactNormal<T, N> {
        ContactNormal {
            direction: self.direction.map(T::of),
            response: self.response.map(T::of),
            mass: T::of(self.mass),
            gap: self.gap.map(T::of),
            restitution: self.restitution.map(T::of),
            stop: self.stop,
            bound: self.bound.round(),
            pressed: self.pressed.map(|bound| bound.round()),
            sixth: self.sixth.map(|bound| bound.round()),
            held: self.held.round(),
            kick: kick::rounded(&self.kick),
            back: back::rounded(&self.back),
            drag: T::of(self.drag),
            coupling: T::of(self.coupling),
            reach: self.reach.map(|reach| T::of(reach.min(FAR))),
            stretch: T::of(self.stretch),
        }
    }
}

pub(super) fn contact_normal<const N: usize>(
    equations: &Equations<N>,
    normal: &Normal<N>,
    k: usize,
    h: f64,
    response: Option<&ForcedResponse<N>>,
    trap: Option<&Trap<N>>,
) -> ContactNormal<f64, N> {
    let Bounds { bound, pressed, sixth } = Bounds::of(equations, k, h);
    let damped = equations.damping * normal.response;
    let rest = |v: SVector<f64, N>| v - normal.response * normal.direction.dot(&v);
    // What ∫ gap dt does: damper and spring act on the masses that the contact leaves free.
    let push = rest(damped);
    let pull = rest(equations.stiffness * normal.response + equations.damping * push);
    let end = |side: usize| normal.ends[side];
    ContactNormal {
        direction: normal.direction.into(),
        response: normal.response.into(),
        mass: normal.mass,
        gap: [0, 1].map(|side| end(side).map_or(FAR, |end| end.gap)),
        restitution: [0, 1].map(|side| end(side).map_or(0.0, |end| end.restitution)),
        stop: [0, 1].map(|side| end(side).map_or(NO_STOP, |end| end.stop as u8)),
        bound,
        pressed,
        sixth,
        held: Step::of(&equations.held_along(k), h),
        kick: kick(equations, h, normal.response),
        back: back(equations, h, normal.direction),
        drag: -normal.direction.dot(&damped),
        coupling: push.norm() + pull.norm(),
        reach: [normal.direction, -normal.direction]
            .map(|row| response.map_or(FAR, |response| response.largest(&row))),
        stretch: trap.map_or(0.0, |trap| trap.stretch(&normal.direction)),
    }
}

/// The bounds of a [`ContactNormal`], each as there.
struct Bounds<const N: usize> {
    bound: Bound<f64, N>,
    pressed: [Bound<f64, N>; OTHERS],
    sixth: [Bound<f64, N>; OTHERS],
}

impl<const N: usize> Bounds<N> {
    fn of(equations: &Equations<N>, k: usize, h: f64) -> Self {
        // What free flight and every set of contacts need, each set with this normal and without.
        let mut largest: Option<Row<f64, N>> = None;
        let (mut pressed, mut sixth) = ([None; OTHERS], [None; OTHERS]);
        for held in 0..1u32 << equations.count {
            let Some(pressing) = equations.pressing(held) else { continue };
            let projector = equations.projector(&pressing);
            let holds = held >> k & 1 == 1;
            let row = if holds {
                // What presses on this contact.
                (0..equations.count)
                    .fold(SVector::zeros(), |row, t| row + equations.normals[t].direction * pressing[(k, t)])
            } else {
                projector.tr_mul(&equations.normals[k].direction)
            };
            let acceleration = Row::of_acceleration(equations, &row);
            let bound = acceleration.second_derivative_bound(equations, &projector, h);
            largest = Some(largest.map_or(bound, |largest| largest.sup(&bound)));
            match holds {
                true => pressed[others(held, k)] = Some(Bound::by(&bound)),
                false => sixth[others(held, k)] = Some(Bound::by(&Row { one: 0.0, ..bound })),
            }
        }
        let bound = Bound::by(&largest.expect("free flight has a bound"));
        // Normals that depend on each other hold no masses together.
        let [pressed, sixth] = [pressed, sixth].map(|each| each.map(|own| own.unwrap_or(bound)));
        Bounds { bound, pressed, sixth }
    }
}
