//! Options that several subcommands share, and what becomes of them once they are checked.

mod axes;
mod backend;
mod overwrite;
mod plane;
mod system;
mod trajectory;

pub use axes::AxesArgs;
pub use backend::BackendArgs;
pub use overwrite::OverwriteArgs;
pub use plane::{PlaneArgs, counts_iterates};
pub use system::{SystemArgs, sets_control};
pub use trajectory::{Trajectory, TrajectoryArgs};
