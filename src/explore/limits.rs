//! What a page may ask for at most. Whatever is beyond is refused in words.

/// The longest message, in bytes.
pub const MESSAGE: usize = 160 * 1024;

/// The longest description of a system, in bytes.
pub const SYSTEM_TEXT: usize = 64 * 1024;

/// The longest line of it, in characters: expressions nest no deeper.
pub const SYSTEM_LINE: usize = 400;

/// Different systems that pages may describe while the program runs: each is kept until it ends.
pub const SYSTEM_TEXTS: usize = 200;

/// Tiles that are wanted at a time.
pub const WANTED: usize = 1024;

/// The finest and the coarsest level.
pub const FINEST: i32 = 30;
/// See [`FINEST`].
pub const COARSEST: i32 = -12;

/// How far from the first cell a tile may lie, in cells of its level.
pub const FARTHEST: i64 = 1 << 46;

/// Forcing periods of a transient and of an observation.
pub const PERIODS: u32 = 200_000;

/// Cells of a figure or of an archive that is taken along.
pub const SAVED_CELLS: u64 = 4_000_000;

/// Cells from which bifurcation curves are begun.
pub const CURVES_CELLS: u64 = 80_000;

/// Largest N of the motions whose curves are computed.
pub const CURVES_MAX_PERIOD: u32 = 16;

/// Columns of a diagram along a line.
pub const SLICE_COLUMNS: u32 = 2_000;

/// Pixels of a figure along its longer side.
pub const FIGURE: u32 = 8_000;

/// Things that one page has done at a time, tiles apart.
pub const TASKS: usize = 6;

/// Pages at a time.
pub const CONNECTIONS: usize = 32;

/// Planes that are kept, beside those that pages show.
pub const SCENES: usize = 64;

/// Tiles that are kept, over all planes.
pub const TILES: usize = 6_000;

/// Motions that are told apart on a plane; further ones count as the last.
pub const MOTIONS: usize = 60_000;

/// Rows of a legend.
pub const LEGEND_ROWS: usize = 64;

/// Starts from which coexisting motions are looked for.
pub const STARTS: u32 = 64;

/// Bytes that wait for a page to read them.
pub const WAITING: usize = 256 << 20;

/// Cells that were computed before and are held in memory.
pub const HELD_CELLS: u64 = 8_000_000;
