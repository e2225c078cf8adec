//! What becomes of files that are there.

use clap::Args;

/// What becomes of files that are there.
#[derive(Clone, Copy, Debug, Args)]
pub struct OverwriteArgs {
    /// Replaces result files that are there; without it they are left alone, and nothing is computed. A store is completed, not
    /// replaced: remove its folder to compute it anew
    #[arg(long)]
    pub force: bool,
}
