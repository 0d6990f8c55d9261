//! Robot descriptions and their meshes on disk: read from the folders that were given and nowhere else, whatever a
//! description names.

mod folders;
mod text;

pub use folders::{Folders, FoldersError};
pub use text::{TextError, read_text};
