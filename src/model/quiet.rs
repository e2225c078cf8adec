//! What tells that a motion can never impact again.

use nalgebra::SMatrix;

use super::forced::{ForcedResponse, Trap};
use super::state::State;
use super::vector::columns;

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

/// The forced response and the trap of a cell; `decay` is the largest rate of growth of free motion.
pub(super) fn quiet<const N: usize>(
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
