//! Everything that flying one cell needs, computed once per cell in f64.

use nalgebra::{SMatrix, SVector};

use super::equations::{Equations, Normal};
use super::flow::{self, Augmented, Functional};
use super::forced::{ForcedResponse, Trap, generator, slowest};
use super::real::Real;
use super::state::State;
use super::system::System;
use super::vector::MOST;

/// The constants of one cell: a step of fixed length h = T/M, and bounds that hold on it.
///
/// The flow is linear, so a whole step is one matrix: y(t + h) = Φ y(t) + Γs sin φ + Γc cos φ + Γ₁ with
/// y = (x1 … xN, v1 … vN). M is even and whole, so that phases 0 and π fall on steps and are set exactly.
/// Everything is non-dimensional; Φ and Γ come from the exponential of the forced generator, so resonance without
/// damping is no special case.
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
    /// Φ's first N columns: what one step makes of unit displacements.
    pub phi_x: [State<T, N>; N],
    /// Φ's last N columns: what one step makes of unit velocities.
    pub phi_v: [State<T, N>; N],
    /// Γs, what one step adds per unit of sin φ at its beginning.
    pub gamma_sin: State<T, N>,
    /// Γc, what one step adds per unit of cos φ at its beginning.
    pub gamma_cos: State<T, N>,
    /// Γ₁, what the constant load adds in one step.
    pub gamma_one: State<T, N>,
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
}

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
    /// |(d·x)''''| ≤ bound_x·|x| + bound_v·|v| + bound_forcing within one step, in free flight and in any contact; the
    /// same bounds the second derivative of what presses on this contact.
    pub bound_x: [T; N],
    /// See `bound_x`.
    pub bound_v: [T; N],
    /// See `bound_x`.
    pub bound_forcing: T,
    /// What a change of d·v by 1 has become a time s later: Σ kickₖ (s/h)ᵏ, 0 ≤ s ≤ h.
    pub kick: [State<T, N>; KICK_TERMS],
    /// How fast damping alone takes speed along the normal: −d·(−M⁻¹C)·response.
    pub drag: T,
    /// A bound on what ∫ gap dt of skipped rebounds does to the masses, per unit of it.
    pub coupling: T,
    /// The farthest that the forced response goes towards either end; [`FAR`] where there is none.
    pub reach: [T; 2],
    /// The farthest |d·x| of a deviation from it, per square root of the trap's form.
    pub stretch: T,
}

/// What tells that a motion can never impact again; see [`Trap`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quiet<T, const N: usize> {
    /// Whether there is a forced response and a trap around it.
    pub exists: bool,
    /// Whether free motion decays onto the forced response.
    pub decays: bool,
    /// The forced response at phase 0.
    pub forced: State<T, N>,
    /// R's upper left block, column by column.
    pub xx: [[T; N]; N],
    /// R's upper right block, column by column.
    pub xv: [[T; N]; N],
    /// R's lower right block, column by column.
    pub vv: [[T; N]; N],
}

/// Terms of the polynomial [`ContactNormal::kick`].
pub const KICK_TERMS: usize = 18;

/// What stands for a stop where a normal has none.
pub const NO_STOP: u8 = u8::MAX;

/// A length, a time or an amplitude beyond all others, and finite in either precision.
pub const FAR: f64 = 1e30;

impl<const N: usize> Flight<f64, N> {
    /// Prepares a cell.
    ///
    /// # Panics
    /// If the system does not have N coordinates.
    pub fn new(system: &System) -> Self {
        let equations = Equations::<N>::new(system.plant());
        let steps = system.steps();
        let h = system.period() / f64::from(steps);
        let unit = |i: usize| SVector::<f64, N>::from_fn(|j, _| if i == j { 1.0 } else { 0.0 });
        let zero = Augmented::<N>::zeros();
        let stepped = |z: Augmented<N>| mechanical(&flow::over(&equations, h, z));
        let (turn_sin, turn_cos) = (equations.omega * h).sin_cos();
        let response = ForcedResponse::of(&equations);
        let trap = Trap::of(system.plant(), &equations);
        let decay = slowest(&generator(&equations));
        let pressing: [_; 1 << MOST] = std::array::from_fn(|held| {
            let matrix = equations.pressing(held as u32).unwrap_or_else(SMatrix::zeros);
            std::array::from_fn(|s| std::array::from_fn(|t| matrix[(s, t)]))
        });
        let normal = |k: usize| match equations.normals().get(k) {
            Some(normal) => contact_normal(&equations, normal, k, h, response.as_ref(), trap.as_ref()),
            None => ContactNormal::none(),
        };
        Flight {
            steps,
            h,
            inverse_h: 1.0 / h,
            turn_sin,
            turn_cos,
            omega: equations.omega,
            rate: system.rate(),
            phi_x: std::array::from_fn(|i| stepped(Augmented { x: unit(i), ..zero })),
            phi_v: std::array::from_fn(|i| stepped(Augmented { v: unit(i), ..zero })),
            gamma_sin: stepped(Augmented { sin: 1.0, ..zero }),
            gamma_cos: stepped(Augmented { cos: 1.0, ..zero }),
            gamma_one: stepped(Augmented { one: 1.0, ..zero }),
            stiffness: columns(&equations.stiffness),
            damping: columns(&equations.damping),
            sin: equations.sin.into(),
            cos: equations.cos.into(),
            load: equations.load.into(),
            normals: std::array::from_fn(normal),
            count: equations.count,
            pressing,
            quiet: quiet(response.as_ref(), trap.as_ref(), decay),
            mirror: system.mirror().map(|mirror| columns(&SMatrix::from_fn(|i, j| mirror[(i, j)]))),
            linear_exponent: decay * system.period(),
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
            phi_x: self.phi_x.map(state),
            phi_v: self.phi_v.map(state),
            gamma_sin: state(self.gamma_sin),
            gamma_cos: state(self.gamma_cos),
            gamma_one: state(self.gamma_one),
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
            phi_x: [state; N],
            phi_v: [state; N],
            gamma_sin: state,
            gamma_cos: state,
            gamma_one: state,
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
        }
    }
}

impl<T: Real, const N: usize> Flight<T, N> {
    /// The contact normals.
    #[inline(always)]
    pub fn normals(&self) -> &[ContactNormal<T, N>] {
        &self.normals[..self.count]
    }
}

impl<T: Copy, const N: usize> ContactNormal<T, N> {
    fn blank(zero: T) -> Self {
        let vector = [zero; N];
        ContactNormal {
            direction: vector,
            response: vector,
            mass: zero,
            gap: [zero; 2],
            restitution: [zero; 2],
            stop: [0; 2],
            bound_x: vector,
            bound_v: vector,
            bound_forcing: zero,
            kick: [State { x: vector, v: vector }; KICK_TERMS],
            drag: zero,
            coupling: zero,
            reach: [zero; 2],
            stretch: zero,
        }
    }
}

impl<const N: usize> ContactNormal<f64, N> {
    fn none() -> Self {
        ContactNormal { gap: [FAR; 2], reach: [FAR; 2], ..ContactNormal::blank(0.0) }
    }

    fn round<T: Real>(&self) -> ContactNormal<T, N> {
        ContactNormal {
            direction: self.direction.map(T::of),
            response: self.response.map(T::of),
            mass: T::of(self.mass),
            gap: self.gap.map(T::of),
            restitution: self.restitution.map(T::of),
            stop: self.stop,
            bound_x: self.bound_x.map(T::of),
            bound_v: self.bound_v.map(T::of),
            bound_forcing: T::of(self.bound_forcing),
            kick: self.kick.map(|term| term.map(T::of)),
            drag: T::of(self.drag),
            coupling: T::of(self.coupling),
            reach: self.reach.map(|reach| T::of(reach.min(FAR))),
            stretch: T::of(self.stretch),
        }
    }
}

fn contact_normal<const N: usize>(
    equations: &Equations<N>,
    normal: &Normal<N>,
    k: usize,
    h: f64,
    response: Option<&ForcedResponse<N>>,
    trap: Option<&Trap<N>>,
) -> ContactNormal<f64, N> {
    let unit = Augmented { v: normal.response, ..Augmented::zeros() };
    let mut terms = flow::series(equations, h, unit);
    let bound = bound(equations, k, h);
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
        bound_x: bound.x.into(),
        bound_v: bound.v.into(),
        bound_forcing: bound.sin.hypot(bound.cos) + bound.one,
        kick: std::array::from_fn(|_| terms.next().map_or(State::zero(), |term| mechanical(&term))),
        drag: -normal.direction.dot(&damped),
        coupling: push.norm() + pull.norm(),
        reach: [normal.direction, -normal.direction]
            .map(|row| response.map_or(FAR, |response| response.largest(&row))),
        stretch: trap.map_or(0.0, |trap| trap.stretch(&normal.direction)),
    }
}

/// See [`ContactNormal::bound_x`]: the larger of what free flight and every set of contacts need.
fn bound<const N: usize>(equations: &Equations<N>, k: usize, h: f64) -> Functional<N> {
    let mut largest: Option<Functional<N>> = None;
    for held in 0..1u32 << equations.count {
        let Some(pressing) = equations.pressing(held) else { continue };
        let projector = equations.projector(&pressing);
        let row = if held >> k & 1 == 1 {
            // What presses on this contact.
            (0..equations.count)
                .fold(SVector::zeros(), |row, t| row + equations.normals[t].direction * pressing[(k, t)])
        } else {
            projector.tr_mul(&equations.normals[k].direction)
        };
        let acceleration = Functional::of_acceleration(equations, &row);
        let bound = flow::second_derivative_bound(equations, &projector, &acceleration, h);
        largest = Some(largest.map_or(bound, |largest| largest.sup(&bound)));
    }
    largest.expect("free flight has a bound")
}

fn quiet<const N: usize>(
    response: Option<&ForcedResponse<N>>,
    trap: Option<&Trap<N>>,
    decay: f64,
) -> Quiet<f64, N> {
    let forced = response.map_or(State::zero(), |response| State {
        x: response.displacement().into(),
        v: response.velocity.into(),
    });
    let block = |of: fn(&Trap<N>) -> SMatrix<f64, N, N>| columns(&trap.map_or_else(SMatrix::zeros, of));
    Quiet {
        exists: response.is_some() && trap.is_some(),
        decays: decay < 0.0,
        forced,
        xx: block(|trap| trap.xx),
        xv: block(|trap| trap.xv),
        vv: block(|trap| trap.vv),
    }
}

/// What one step adds per unit of the sine and of the cosine of a drive's phase at its beginning.
pub(super) fn driven_steps<const N: usize>(driven: &Equations<N>, h: f64) -> [State<f64, N>; 2] {
    let zero = Augmented::zeros();
    [Augmented { sin: 1.0, ..zero }, Augmented { cos: 1.0, ..zero }]
        .map(|z| mechanical(&flow::over(driven, h, z)))
}

/// What a drive of unit amplitude adds to the bounds on the fourth derivative of d·x, by normal.
pub(super) fn driven_bounds<const N: usize>(driven: &Equations<N>, h: f64) -> [f64; MOST] {
    std::array::from_fn(|k| {
        if k >= driven.count {
            return 0.0;
        }
        let bound = bound(driven, k, h);
        bound.sin.hypot(bound.cos)
    })
}

/// The displacements and velocities of an augmented state.
fn mechanical<const N: usize>(z: &Augmented<N>) -> State<f64, N> {
    State { x: z.x.into(), v: z.v.into() }
}

fn columns<const N: usize>(matrix: &SMatrix<f64, N, N>) -> [[f64; N]; N] {
    std::array::from_fn(|j| std::array::from_fn(|i| matrix[(i, j)]))
}
