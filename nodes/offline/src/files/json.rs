//! Decision processes and policies as JSON files.

use std::io::Read;
use std::path::Path;

use mdp::{Mdp, MdpError, Policy};
use serde_json::Value;

use super::lines::open;
use crate::OfflineError;

/// Larger JSON files are refused, in bytes.
pub const MAX_JSON_BYTES: u64 = 1 << 30;

/// Reads and checks a decision process.
///
/// # Errors
/// What cannot be read, is no such JSON, or no decision process.
pub fn read_mdp(path: &Path) -> Result<Mdp, OfflineError> {
    Mdp::from_json(&read(path)?).map_err(|error| OfflineError::Mdp { file: path.display().to_string(), error })
}

/// Reads and checks a policy of `mdp`: a list, or an object that holds one under `policy` among other things.
///
/// # Errors
/// What cannot be read, is no such JSON, or no policy of the process.
pub fn read_policy(path: &Path, mdp: &Mdp) -> Result<Policy, OfflineError> {
    policy(&read(path)?, mdp).map_err(|error| OfflineError::Mdp { file: path.display().to_string(), error })
}

fn policy(bytes: &[u8], mdp: &Mdp) -> Result<Policy, MdpError> {
    let no_json = |message| MdpError::Json { what: "a policy", message };
    let policy = match serde_json::from_slice(bytes).map_err(|error| no_json(error.to_string()))? {
        Value::Object(mut object) => {
            object.remove("policy").ok_or_else(|| no_json("got an object without the key \"policy\"".to_owned()))?
        }
        policy => policy,
    };
    Policy::from_json(serde_json::json!({ "policy": policy }).to_string().as_bytes(), mdp)
}

/// Reads the most probable weights, `n_features` numbers under `map`, from an answer of `apprentice infer --json`.
///
/// # Errors
/// What cannot be read, is no such JSON, or holds other numbers.
pub fn read_map(path: &Path, n_features: usize) -> Result<Vec<f64>, OfflineError> {
    let wrong = |message: String| {
        let error = MdpError::Json { what: "an answer of apprentice infer", message };
        OfflineError::Mdp { file: path.display().to_string(), error }
    };
    let answer: Value = serde_json::from_slice(&read(path)?).map_err(|error| wrong(error.to_string()))?;
    let map = answer.get("map").and_then(Value::as_array);
    let map = map.ok_or_else(|| wrong("got no list under the key \"map\"".to_owned()))?;
    let numbers: Option<Vec<f64>> = map.iter().map(Value::as_f64).collect();
    let numbers = numbers.ok_or_else(|| wrong("got something else than numbers under the key \"map\"".to_owned()))?;
    if numbers.len() != n_features {
        let (got, other) = (numbers.len(), "--mdp".to_owned());
        let (file, what) = (path.display().to_string(), "weights");
        return Err(OfflineError::Widths { file, what, got, other, expected: n_features });
    }
    Ok(numbers)
}

/// All bytes of a file, without a byte order mark.
fn read(path: &Path) -> Result<Vec<u8>, OfflineError> {
    let file = || path.display().to_string();
    let mut bytes = Vec::new();
    open(path)?
        .take(MAX_JSON_BYTES + 1)
        .read_to_end(&mut bytes)
        .map_err(|source| OfflineError::Unreadable { file: file(), source })?;
    if bytes.len() as u64 > MAX_JSON_BYTES {
        return Err(OfflineError::LargeFile { file: file(), most: MAX_JSON_BYTES });
    }
    if bytes.starts_with(&[0xef, 0xbb, 0xbf]) {
        bytes.drain(..3);
    }
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::policy;
    use mdp::worlds::GridWorld;
    use mdp::{Mdp, Policy};
    use proptest::prelude::{any, prop_assert_eq, proptest};

    fn process() -> Mdp {
        let text = r#"{"gamma": 0.5, "n_states": 2, "n_actions": 2, "initial": [1, 0], "features": [[0], [1]],
            "transitions": [[0, 0, 1, 1], [0, 1, 0, 0.5], [0, 1, 1, 0.5]]}"#;
        Mdp::from_json(text.as_bytes()).expect("a process")
    }

    #[test]
    fn a_policy_is_a_list_or_stands_under_its_key() {
        let sure = Ok(Policy::Deterministic(vec![1, 0]));
        assert_eq!(policy(b"[1, 0]", &process()), sure);
        assert_eq!(policy(br#"{"outcome": "solved", "policy": [1, 0], "gap": null}"#, &process()), sure);
        let rows = Ok(Policy::Stochastic(vec![0.1, 0.9, 1.0, 0.0]));
        assert_eq!(policy(br#"{"policy": [[0.1, 0.9], [1, 0]]}"#, &process()), rows);
        for bad in
            ["", "1", "{}", "[0]", "[0, 2]", "[-1, 0]", "[[1], [1]]", "[[0.5, 0.4], [1, 0]]", "[0, [1, 0]]", "[0, 1]]"]
        {
            assert!(policy(bad.as_bytes(), &process()).is_err(), "{bad}");
        }
    }

    proptest! {
        #[test]
        fn any_bytes_give_a_policy_or_an_error(text in "[\\[\\]{}0-9.,:e\" -]{0,40}", bytes in proptest::collection::vec(any::<u8>(), 0..40)) {
            for input in [text.as_bytes(), &bytes] {
                if let Ok(policy) = policy(input, &process()) {
                    prop_assert_eq!(policy.check(&process()), Ok(()));
                }
            }
        }

        #[test]
        fn a_process_with_a_byte_changed_is_one_or_an_error(at in 0..200_usize, byte: u8) {
            let world = GridWorld {
                rows: 1, columns: 2, n_features: 1, features: vec![0.0, 1.0], slip: 0.1, gamma: 0.9, starts: vec![0],
                terminals: vec![1],
            };
            let mut text = world.mdp().expect("a process").to_json().into_bytes();
            let at = at % text.len();
            text[at] = byte;
            if let Ok(mdp) = Mdp::from_json(&text) {
                prop_assert_eq!(Mdp::from_json(mdp.to_json().as_bytes()).expect("it reads back"), mdp);
            }
        }
    }
}
