//! What is known of every cell of a plane: one table, from which files, layers and their documentation follow.

mod assemble;
mod cell;
mod cells;
mod field;
mod layer;
mod table;
mod thinned;
mod values;

pub use assemble::{Assembled, assembled};
pub use cell::CellResult;
pub use cells::{Cells, CellsError};
pub use field::{CellField, Drawn, Extras, Inner};
pub use layer::{Layer, LayerError};
pub use table::{CELL_FIELDS, NOT_COMPUTED};
pub use thinned::thinned;
pub(crate) use values::of_any;
pub use values::{Kind, Values};
