//! Bag folders on the file system: open, create, recover and describe them.

mod describe;
mod error;
mod folder;
mod messages;
mod open;
mod recover;
mod utc;

pub use describe::{BagInfo, TopicInfo};
pub use error::BagFilesError;
pub use folder::{METADATA_FILE, create_folder, file_name, list_files, next_index, write_metadata};
pub use messages::BagMessages;
pub use open::{BagFile, OpenBag, open_bag};
pub use recover::{Recovered, RecoveredFile, recover_in_place};
pub use utc::{utc_stamp, utc_text};
