//! The one table of what result files hold, from which their documentation is made and to which they are held.

mod documentation;
mod field;
mod table;

pub use documentation::documentation;
pub use field::{Field, FileContent};
pub(super) use table::CONTROLLED;
pub use table::files;
