//! What Luo, Ma and Lv (2009) call the curves and regions of their Fig. 5, on the plane of that figure alone.

mod names;
mod naming;
mod regions;

pub use names::{is_plane_of_paper, region_name};
pub use naming::{Named, named};
pub use regions::{REGIONS, regions};
