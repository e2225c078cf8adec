//! The kernels.

/// A kernel and the fragments that it has beyond those that all kernels have.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(test, derive(strum::VariantArray))]
pub enum Kernel {
    /// Trajectories to their verdicts.
    Follow,
    /// The same, and what is read on a section.
    Trace,
    /// Trajectories under control to their outcomes.
    Control,
    /// How far trajectories go.
    Extent,
}

impl Kernel {
    /// The name of its entry point.
    pub fn entry(self) -> &'static str {
        match self {
            Kernel::Follow => "follow",
            Kernel::Trace => "trace",
            Kernel::Control => "control_trajectories",
            Kernel::Extent => "measure_extents",
        }
    }

    /// Whether it keeps a whole observer, and not a part of one or none.
    pub fn stores_observer(self) -> bool {
        matches!(self, Kernel::Follow | Kernel::Trace)
    }

    /// The struct that it keeps of a trajectory.
    pub fn state(self) -> &'static str {
        match self {
            Kernel::Follow | Kernel::Trace => "Observed",
            Kernel::Control => "Controlled",
            Kernel::Extent => "ExtentObserver",
        }
    }

    pub(super) fn fragments(self) -> &'static [&'static str] {
        match self {
            Kernel::Follow => &[
                include_str!("../../../../shaders/dynamics/tally.wgsl"),
                include_str!("../../../../shaders/analysis/abreast.wgsl"),
                include_str!("../../../../shaders/kernels/follow.wgsl"),
            ],
            Kernel::Trace => &[
                include_str!("../../../../shaders/analysis/rebounds.wgsl"),
                include_str!("../../../../shaders/analysis/probe.wgsl"),
                include_str!("../../../../shaders/analysis/trace.wgsl"),
                include_str!("../../../../shaders/kernels/trace.wgsl"),
            ],
            Kernel::Control => &[
                include_str!("../../../../shaders/control/section_point.wgsl"),
                include_str!("../../../../shaders/control/memory.wgsl"),
                include_str!("../../../../shaders/control/action.wgsl"),
                include_str!("../../../../shaders/control/deviation.wgsl"),
                include_str!("../../../../shaders/control/leaving.wgsl"),
                include_str!("../../../../shaders/control/controlled.wgsl"),
                include_str!("../../../../shaders/control/outcome.wgsl"),
                include_str!("../../../../shaders/kernels/control.wgsl"),
            ],
            Kernel::Extent => &[
                include_str!("../../../../shaders/analysis/extent.wgsl"),
                include_str!("../../../../shaders/kernels/extent.wgsl"),
            ],
        }
    }
}
