//! Schema texts: of the types this project knows, else put together from message definitions on disk.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use apprentice_msgs::{SchemaError, compose_schema, definition, schema};

/// Most bytes of one `.msg` file that are read.
const MAX_DEFINITION_BYTES: u64 = 1 << 20;

/// Where message definitions are looked for.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Definitions {
    /// Folders with `PACKAGE/msg/NAME.msg`.
    roots: Vec<PathBuf>,
}

impl Definitions {
    /// Looks in `folders`, then in `share` of every prefix of an `AMENT_PREFIX_PATH` (colon-separated).
    pub fn new(folders: &[String], ament_prefix_path: &str) -> Definitions {
        let prefixes = ament_prefix_path.split(':').filter(|prefix| !prefix.is_empty());
        let shares = prefixes.map(|prefix| Path::new(prefix).join("share"));
        Definitions { roots: folders.iter().map(PathBuf::from).chain(shares).collect() }
    }

    /// The `ros2msg` schema of a type `pkg/msg/Name`.
    ///
    /// # Errors
    /// When the type, or one it needs, is found nowhere or cannot be read.
    pub fn schema(&self, type_name: &str) -> Result<String, SchemaError> {
        match schema(type_name) {
            Some(known) => Ok(known.to_owned()),
            None => compose_schema(type_name, |name| definition(name).map(str::to_owned).or_else(|| self.read(name))),
        }
    }

    /// The text of one definition; `name` is checked to be `pkg/msg/Name` of plain letters by the composer.
    fn read(&self, name: &str) -> Option<String> {
        self.roots.iter().find_map(|root| {
            let mut text = String::new();
            let file = File::open(root.join(format!("{name}.msg"))).ok()?;
            file.take(MAX_DEFINITION_BYTES + 1).read_to_string(&mut text).ok()?;
            (text.len() as u64 <= MAX_DEFINITION_BYTES).then_some(text)
        })
    }
}
