//! What the kernel `trace` reads and writes beyond what `follow` does.

use super::follow::Schedule;

shared_struct! {
    /// What the kernel `trace` is told.
    pub struct TraceDispatch {
        pub schedule: Schedule,
        /// Trajectories in this dispatch.
        pub count: u32,
        /// Moves that each of them may make.
        pub budget: u32,
        /// 1 in the first dispatch of a tile, which begins the trajectories; 0 in those that resume them.
        pub begin: u32,
        /// Invocations in one row of workgroups.
        pub row: u32,
        /// The codes of the section and of what is read there.
        pub section: u32,
        pub reading: u32,
        /// Readings that are kept of each trajectory.
        pub capacity: u32,
        pub unused: u32,
    }
}

shared_struct! {
    /// Rows of impacts at one stop, each slower than the one before.
    pub struct Rebounds {
        pub last: f32,
        pub stop: u32,
        pub run: u32,
        pub longest: u32,
    }
}

shared_struct! {
    /// What a trajectory leaves on a section while it is observed.
    pub struct Trace {
        pub rebounds: Rebounds,
        /// Passages through the section.
        pub passages: u32,
    }
}
