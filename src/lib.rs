//! Impact Atlas: parameter planes of vibro-impact systems, explored on the GPU.
//!
//! A linear oscillator M x″ + C x′ + K x = s sin ωt + c cos ωt + l of one to four coordinates, whose masses meet one to four
//! rigid stops: where d·x = gap, the velocities jump by −(1 + r)(d·v) M⁻¹d/(dᵀM⁻¹d). It is described in a
//! [text file](system); the first of those that come with the program is that of Luo, Ma and Lv (2009), two masses on springs of
//! which one rattles in a clearance. Every cell of a plane, a pair of parameters or of start components, is one trajectory,
//! followed to a [verdict](analysis::Verdict): which periodic motion it settles on, or whether it is quasi-periodic,
//! chaotic, sticking or free of impacts. The CPU path in f64 is the reference; the GPU path is the same mathematics in f32.
//!
//! # Rooms
//!
//! Each room uses only those before it:
//!
//! | room | what it holds |
//! |---|---|
//! | [`figure`] | canvas, text, scales and ticks, frames, keys, colour bars: figures that know no oscillator |
//! | [`system`] | any linear oscillator with rigid stops: its file, its parameters, the numbers of one cell |
//! | [`model`] | parameters and their ranges, the equations of motion, the constants of linear flight |
//! | [`dynamics`] | flight, contact, impact, chatter, sticking: a [`Trajectory`](dynamics::Trajectory) moves from event to event |
//! | [`analysis`] | periodicity, the largest Lyapunov exponent, regimes |
//! | [`theory`] | exact periodic motions, multipliers, normal forms, Lyapunov spectra |
//! | [`control`] | suppressing chaos: sine force, period pulse, delayed feedback, small kicks, at each return to the section σ |
//! | [`plane`] | axes, starts, planes, region maps |
//! | [`curves`] | bifurcation curves of a plane, by continuation |
//! | [`paper`] | what the paper calls the curves and regions of its plane |
//! | [`diagram`] | bifurcation diagrams: axis, sweep, section; branches and where they coexist |
//! | [`backend`] | one trait; the CPU in f64 on every core, the GPU in f32; only its folder `gpu` names wgpu |
//! | [`store`], [`render`] | files, and pictures of planes, diagrams and orbits; they know results, never back ends |
//! | [`sweep`], [`validate`] | a plane or a diagram on a back end; two back ends against each other |
//! | [`reproduce`] | the figures of the paper and what it prints, computed again |
//! | [`explore`] | a page in the browser that shows a plane, served on this machine |
//!
//! The command line is the binary's, which needs the feature `cli`, on by default; without it the library needs no clap.
//! `shaders/` has the file names of `src/`; the constants and structs that the two share are generated from Rust when the
//! shader is assembled.
//!
//! # Symbols
//!
//! Everything is non-dimensional; a family's file says in which units. In any of them:
//!
//! | symbol | here | meaning |
//! |---|---|---|
//! | n | `n` | coordinates, 1 to 4 |
//! | x, v | `x1` … `xn`, `v1` … `vn` | displacements and velocities; a *state* is (x, v) at forcing phase 0 |
//! | ω, T, h, M | `omega`, `period()`, `h`, `steps` | forcing frequency and period, step T/M, steps in a period |
//! | d, r | `direction`, `restitution` | a stop is touched where d·x = gap; its coefficient of restitution |
//! | normal | [`ContactNormal`](model::ContactNormal) | a line along which one stop, or two that face each other, are met |
//! | N-p-q-… | `n`, `counts` | N forcing periods, and the impacts at each stop in one period of the motion, in the order of labels |
//! | λ1 | `lyapunov` | largest Lyapunov exponent per forcing period, natural logarithm |
//!
//! In the paper's, lengths are in units of the static deflection (P1+P2)/K1 and times in √(M1/K1):
//!
//! | symbol | here | meaning |
//! |---|---|---|
//! | ω, δ, ζ, r | `omega`, `delta`, `zeta`, `r` | forcing frequency, half clearance, damping ratio, restitution |
//! | μm, μk, μc, f20 | `mu_m`, `mu_k`, `mu_c`, `f20` | shares of the second mass in mass, stiffness, damping and force |
//! | A, Ā | [`Stop::A`](dynamics::Stop::A), [`Stop::B`](dynamics::Stop::B) | the stops at x1 = +δ and x1 = −δ |
//! | N-p-q | `n`, `p`, `q` | p impacts at Ā, q impacts at A |
//!
//! # How a trajectory is followed
//!
//! *Flight.* Free flight is linear, so a step of length h = T/M is one matrix: the exponential of the generator with
//! the forcing phasor in it, computed in f64, once for all cells that differ in gaps and restitutions alone. No modes are
//! formed: any damping is covered, proportional or not, over- or underdamped, and resonance at ζ = 0 is no special case. M is
//! even, and the phasor is set exactly at phases 0 and π, so that rounding cannot drift; ωt is never formed. Shorter flights
//! are Taylor polynomials of the equation of motion, of an order that rounding cannot tell from infinite.
//!
//! *No impact is missed.* Within a step d·x differs from its cubic Hermite interpolant by s²(h − s)²/24 times a bound on
//! |(d·x)''''|: so it lies in the hull of five Bernstein coefficients. Where that hull clears the stops, the step is taken. Where
//! the step ends beyond a stop, the contact is found directly: the polynomial of fifth degree that agrees with d·x and d·v at both
//! ends, and with the two derivatives after them at the end, has its root by three of Newton's steps. How d·x goes along the step,
//! the end of the step says of the way to it, by a polynomial that rounding cannot tell from the whole series; that corrects the
//! root, by so little, in f64 the second time at the latest, that what its fourth power comes to is less than a rounding, and gives
//! the speed of the impact. The impact then changes the end of the step, and the point where it happens is found only where it is
//! asked for. That this contact is the first is certified by the same bound: the hull of the way to it clears the stops. A step
//! that ends within the stops but comes near to one is cut in two, whose hulls clear the stop, where the gap is narrowest, or
//! beside the end towards which it narrows; or the stop is met before, where the speed says that the motion would go beyond it by
//! more than rounding. Where nothing is certified (a touch within rounding, two contacts in a step, chatter about to be complete),
//! the stop is approached from the safe side: the gap is at least that of a quadratic whose acceleration bounds the true one on a
//! window, and the trajectory flies to that quadratic's root: just short of the contact, never beyond. Repeated, this converges
//! faster than Newton's method, and a touch that comes to nothing is passed without harm.
//!
//! *Side by side.* The CPU path follows as many trajectories at once as the processor has room for (sixteen with AVX-512, four
//! with AVX2), from the same source as a single one and with the same bits: products and sums are fused where that is written and
//! nowhere else, and every machine rounds alike; sines, exponentials and logarithms are libm's, not the platform's. The lanes step
//! together until nine of sixteen of them wait for a contact; contacts are then found, and steps taken, by all of them, impacts are
//! tallied lane by lane and noted at the next phase 0 that is looked at, and what is rare is left to the single trajectory. Phase
//! π is passed over except where an odd cycle may show its mirror image, and phase 0 where nothing is to be decided: while a
//! transient only waits for its state to return, and under observation between measurements of its tangent. What is computed for one lane is computed for all: trajectories that carry a tangent along fly in lanes of their own,
//! by turns with the others. The GPU's kernel goes in rounds of the same kind, each invocation for itself; what rests on a stop
//! makes its whole steps together after them.
//!
//! *Impacts* change the velocities along M⁻¹d. What the change does to the end of the step is a polynomial that is known beforehand, so
//! the rest of the step need not be flown again. A small deviation that is carried along is likewise that of the end of the step: a
//! second polynomial, of the flight back, says what part of it lay along d at the impact, and the impact adds as much of the first
//! and of its derivative.
//!
//! *Chatter and sticking.* Rebounds against a pressing force shrink geometrically. Once the effect of the rest of them on the
//! other masses is known to be below rounding, and the force surely outlasts them, the sequence is closed: the mass rests on its
//! stop, its impulse on the others is summed in closed form, and infinitely many impacts are counted. Rebounds without loss
//! (r = 1) never end, but damping drags them down like exp(−ct/3): they are closed once neither the next strobe nor the force that
//! vanishes can find them. Rebounds between several stops at once, each impact throwing the masses on the next stop, end in the
//! corner between them. Contacts hold until the force on one of them changes sign: what presses on a contact during a flight lies
//! in a hull like that of d·x during a step, and where that reaches below 0, the flight ends where the cubic through both ends
//! does, or for as long as a quadratic bound from its beginning says. The contact then opens along its jerk. A flight under contacts
//! is linear too: on stops along one normal, a whole step of it is a matrix of its own.
//!
//! *Verdict.* The strobe state is compared with one remembered state: its first return gives N, and it must keep returning,
//! with the same impacts. A trajectory that has settled, or that energy shows can never impact again, finishes early. A
//! return is no period yet: a spiral that still shrinks returns, and so does every second turn of an alternation that dies
//! out. Half-way through the observation the remembered state moves along with the motion. N is its period where the returns
//! are as close as rounding lets them be, or come closer by the half, where a turn by a divisor of N ends a thousand times
//! farther away, and where nearby trajectories do not part. A tangent vector, carried through flight and impact (the
//! saltation of Eq. (3)), gives λ1 with a standard error from sixteen batches; of a motion that was reached within the
//! observation, only from there on. Where it grows by more than e¹⁰ in the first half of the observation, no less than 64
//! periods without sticking, chaos is plain, and the other half is left out. A motion that has settled before its transient
//! is over is observed turn by turn instead, where there is time for 2n of them: unit deviations carried through one turn
//! each are the columns of its monodromy matrix, and the spectral radius of that is its largest multiplier; where it no
//! longer moves at all and its turns are short, for no longer than that. The matrix M is measured of a state that returns
//! after a short turn and still moves, too: where it contracts, the state leaps to where its returns lead, anchor + Σ Mᵏ
//! (state − anchor), if that is no farther than 10⁻³ and off the stops. It goes on from there; the next return is ten times
//! closer, or the map is measured anew; leaps and measurements are six at most, together. Where there is no period, a growth
//! of more than e⁵ that is significant is chaos; a growth within e^±3 on strobe points that scatter alike early and late is
//! quasi-periodic; everything else is unresolved, and says so.
//!
//! *In doubt.* What returns without having settled is held against the exact motion beside it: Newton's method on the
//! strobe map finds it, its multipliers say whether it is stable and what λ1 is, and its Jacobian must foretell where the
//! state is one turn later. Chaos may be transient, and goes on for 320 forcing periods more; what is observed of it
//! in 64 further ones counts, too. What is still undecided, or
//! neutral, goes on for another transient and is observed four times as long: beside a Neimark–Sacker curve a spiral is slow.
//! What even that leaves undecided goes on for eight transients.
//! [`sweep::certify`] solves the motion of every periodic cell.
//!
//! # Theory
//!
//! *Motions.* A periodic motion is the sequence of its impacts. From one to the next the flight is an exact matrix, so
//! the times and states of all impacts satisfy 2n equations each; Newton's method solves them, for stable and unstable
//! motions alike, and a symmetric motion is solved as half of itself. Whether the system moves like that is then asked
//! of the certified flight. The 1-1-1 symmetric motion needs no iteration.
//!
//! *Stability.* The Jacobian of an impact follows from the same equations; the product over the impacts has the Floquet
//! multipliers. Truncated power series carried along the same path give the derivatives up to the third, exactly, and with
//! them the normal-form coefficients that tell super- from subcritical.
//!
//! *Curves.* Matching equations and the condition of a bifurcation are solved together and followed by
//! pseudo-arclength continuation. Where to begin is read from a map: each region's motion is refined and followed along
//! both axes until it loses stability or grazes. Determinants serve as conditions, so that nothing happens to them where
//! multipliers meet; the points of codimension two are zeros of further functions along the curve.
//!
//! *What the paper prints differently.* For δ in \[0.5352, 0.5602\] it lets the 1-1-1 symmetric motion lose stability in a
//! supercritical and a reverse subcritical Neimark–Sacker bifurcation and a pitchfork in turn. Here the Neimark–Sacker
//! curve begins in a 1:1 resonance on a fold, at (ω, δ) = (1.485, 0.5523), rises to (1.845, 0.6844), falls to (2.508,
//! 0.5422) and rises again: no stability is lost by it below δ = 0.5422. The fold comes down to (1.464, 0.5482).
//!
//! # Limits
//!
//! Two opposed stops without a gap clamp what is between them: the limit of a closing gap (δ = 0 in the paper's). Stops whose
//! directions are linearly dependent without being parallel are refused, and stops farther away than 10¹⁸. A forcing period
//! of more than 65,536 steps of the fastest motion is refused, and so is ω above 10⁶ of the systems that come with the
//! program. r = 1 with strong damping at low frequency makes ever more rebounds in finite time; a trajectory that makes 2²⁴
//! moves more than 2¹⁶ in each forcing period is given up as failed, and so is one that goes farther than 10¹⁸.
#![doc = include_str!("parameter.md")]

// That clippy finds what is denied below is shown by what is expected here.
#[expect(clippy::disallowed_methods)]
const _: fn(f64) -> f64 = f64::sin;
#[expect(clippy::disallowed_methods)]
const _: fn(f32) -> f32 = f32::sin;
#[expect(clippy::disallowed_methods)]
const _: fn(nalgebra::Complex<f64>) -> f64 = nalgebra::Complex::norm;
#[expect(clippy::disallowed_methods)]
const _: fn(f64) -> f64 = num_traits::Float::sin;

#[cfg_attr(not(test), deny(clippy::disallowed_methods))]
pub mod analysis;
#[cfg_attr(not(test), deny(clippy::disallowed_methods))]
pub mod backend;
#[cfg_attr(not(test), deny(clippy::disallowed_methods))]
pub mod control;
pub mod curves;
pub mod diagram;
#[cfg_attr(not(test), deny(clippy::disallowed_methods))]
pub mod dynamics;
pub mod explore;
pub mod figure;
#[cfg_attr(not(test), deny(clippy::disallowed_methods))]
pub mod model;
pub mod paper;
#[cfg_attr(not(test), deny(clippy::disallowed_methods))]
pub mod plane;
pub mod render;
pub mod reproduce;
pub mod store;
#[cfg_attr(not(test), deny(clippy::disallowed_methods))]
pub mod sweep;
#[cfg_attr(not(test), deny(clippy::disallowed_methods))]
pub mod system;
#[cfg_attr(not(test), deny(clippy::disallowed_methods))]
pub mod theory;
pub mod validate;
