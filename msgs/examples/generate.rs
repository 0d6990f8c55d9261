//! Writes `msgs/src/generated/` anew from the interface definitions.

use std::error::Error;
use std::fs;
use std::path::Path;

use apprentice_msgs::generator::generate_from;

fn main() -> Result<(), Box<dyn Error>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let directory = root.join("src/generated");
    let files = generate_from(root)?;
    for entry in fs::read_dir(&directory)? {
        let path = entry?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if !files.contains_key(name.as_ref()) {
            fs::remove_file(&path)?;
        }
    }
    for (name, text) in &files {
        fs::write(directory.join(name), text)?;
    }
    println!("wrote {} files to {}", files.len(), directory.display());
    Ok(())
}
