//! A folder of files and the executable run in it.

use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// The executable.
pub const EXECUTABLE: &str = env!("CARGO_BIN_EXE_apprentice");

/// The top of the tree.
pub fn top() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// A folder for one test, in which `config/examples` stands as in the tree.
pub struct Folder(tempfile::TempDir);

impl Folder {
    pub fn new() -> Self {
        let folder = tempfile::tempdir().expect("a folder can be made");
        std::os::unix::fs::symlink(top().join("config"), folder.path().join("config")).expect("a link can be made");
        Self(folder)
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// Writes a file; gives its name.
    pub fn write(&self, name: &'static str, content: impl AsRef<[u8]>) -> &'static str {
        std::fs::write(self.path(name), content).expect("a file can be written");
        name
    }

    pub fn read(&self, name: &str) -> String {
        std::fs::read_to_string(self.path(name)).expect("the file was written")
    }

    /// Numbers of a CSV file without a header.
    pub fn numbers(&self, name: &str) -> Vec<f64> {
        self.read(name).split([',', '\n']).filter(|field| !field.is_empty()).map(number).collect()
    }

    /// Runs a command line, words apart by spaces.
    pub fn run(&self, line: &str) -> Output {
        Command::new(EXECUTABLE)
            .args(line.split_whitespace())
            .current_dir(self.0.path())
            .output()
            .expect("the executable was built for this test")
    }

    /// The one JSON object that a command answers.
    pub fn json(&self, line: &str) -> Value {
        let output = self.run(&format!("{line} --json"));
        assert_eq!(output.status.code(), Some(0), "{line}: {}", errors(&output));
        serde_json::from_slice(&output.stdout)
            .unwrap_or_else(|error| panic!("{line}: {error}: {}", String::from_utf8_lossy(&output.stdout)))
    }

    /// What a command says that refuses its input.
    pub fn refused(&self, line: &str) -> String {
        let output = self.run(line);
        assert_eq!(output.status.code(), Some(2), "{line}: {}", errors(&output));
        assert!(output.stdout.is_empty(), "{line}: an answer beside an error");
        errors(&output)
    }

    /// Names of all files, sorted.
    pub fn names(&self) -> Vec<String> {
        let entries = std::fs::read_dir(self.0.path()).expect("the folder is there").flatten();
        let mut names: Vec<String> = entries.map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }
}

/// What a command wrote to standard error.
pub fn errors(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

pub fn number(text: &str) -> f64 {
    text.trim().parse().unwrap_or_else(|_| panic!("'{text}' is no number"))
}

/// The number under a path of keys and indices.
pub fn at(value: &Value, path: &str) -> f64 {
    value.pointer(path).and_then(Value::as_f64).unwrap_or_else(|| panic!("{path} is no number in {value}"))
}

/// The numbers of a list under a path.
pub fn list(value: &Value, path: &str) -> Vec<f64> {
    let list = value.pointer(path).and_then(Value::as_array).unwrap_or_else(|| panic!("{path} is no list in {value}"));
    list.iter().map(|x| x.as_f64().expect("a number")).collect()
}

/// The text under a path.
pub fn text<'a>(value: &'a Value, path: &str) -> &'a str {
    value.pointer(path).and_then(Value::as_str).unwrap_or_else(|| panic!("{path} is no text in {value}"))
}

/// Numbers from 0 to 1 that look random, the same each time (splitmix64).
pub struct Uniform(pub u64);

impl Iterator for Uniform {
    type Item = f64;

    fn next(&mut self) -> Option<f64> {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut x = self.0;
        x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        Some(((x ^ (x >> 31)) >> 11) as f64 / (1_u64 << 53) as f64)
    }
}

/// One number a line.
pub fn lines(values: impl IntoIterator<Item = f64>) -> String {
    values.into_iter().map(|value| format!("{value:?}\n")).collect()
}
