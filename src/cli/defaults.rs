//! Every default of the command line.

use impact_atlas::plane::Start;

/// The system: that of the paper.
pub const SYSTEM: &str = impact_atlas::system::PAPER;

/// Cells that `validate` computes of the default plane: 400 × 300.
pub const VALIDATED_CELLS: u32 = 120_000;

/// Cells of the default plane from which bifurcation curves are begun: 160 × 120.
pub const CURVES_CELLS: u32 = 19_200;

/// The picture.
pub const PICTURE: &str = "map.png";

/// How a trajectory begins that is to be classified, a cell's or a single one, unless an axis varies the start.
pub const START: Start = Start::Symmetric;

/// Forcing periods before a trajectory that is to be classified is observed, a cell's or a single one.
pub const TRANSIENT: u32 = 300;

/// Forcing periods for which it is observed.
pub const OBSERVE: u32 = 150;

/// Largest N looked for.
pub const MAX_PERIOD: u32 = 32;

/// Forcing periods before a single trajectory is recorded, read or solved.
pub const TRAJECTORY_TRANSIENT: u32 = 1000;

/// Forcing periods for which it is then searched for its motion.
pub const TRAJECTORY_OBSERVE: u32 = 500;

/// Forcing periods over which Lyapunov exponents are measured.
pub const SPECTRUM_OBSERVE: u32 = 10_000;

/// Forcing periods of an orbit.
pub const ORBIT_PERIODS: u32 = 20;

/// Points of an orbit in each forcing period.
pub const ORBIT_SAMPLES: u32 = 200;

/// Largest N of the motions whose bifurcation curves are computed.
pub const CURVES_MAX_PERIOD: u32 = 2;

/// The picture's size in pixels.
pub const PICTURE_SIZE: &str = "1600x1200";

/// Points of an orbit in each forcing period where it is drawn.
pub const DRAWN_SAMPLES: u32 = 400;

/// Forcing periods that a section shows.
pub const SECTION_PERIODS: u32 = 2000;

/// The width of a figure of one plot, in pixels.
pub const NARROW_FIGURE: u32 = 1000;

/// The width of a figure of several plots or a diagram, in pixels.
pub const WIDE_FIGURE: u32 = 2000;

/// The first controlled iterate of a single run, as in the paper.
pub const CONTROL_FROM: u32 = 2000;

/// Iterates of a single controlled run.
pub const CONTROL_ITERATES: u32 = 4000;

/// Iterates whose flight is drawn at the end of a controlled run.
pub const CONTROL_PORTRAIT: u32 = 12;

/// The picture of a bifurcation diagram.
pub const DIAGRAM: &str = "bifurcation.png";

/// Forcing periods for which a column of a diagram is observed.
pub const DIAGRAM_OBSERVE: u32 = 300;

/// Points that are kept of a column for every period observed.
pub const POINTS_PER_PERIOD: u32 = 16;

/// The first controlled iterate of a cell of a map.
pub const CONTROL_MAP_FROM: u32 = 200;

/// Iterates of a cell of a map under control.
pub const CONTROL_MAP_ITERATES: u32 = 1200;

/// The folder of the paper's figures.
pub const REPRODUCTION: &str = "reproduction";
