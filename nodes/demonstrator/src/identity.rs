//! Ids of answers, and the random numbers that belong to them.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use sha2::{Digest, Sha256};

/// The id of the answer that `source` gives to a question: the same after every restart.
pub fn answer_id(source: &str, query_id: &str, seed: u64) -> String {
    let hash = digest("answer", source, query_id, seed);
    let hex: String = hash[..8].iter().map(|byte| format!("{byte:02x}")).collect();
    format!("{source}-{hex}")
}

/// The generator for everything random in the answer to one question.
pub(crate) fn generator(source: &str, query_id: &str, seed: u64) -> ChaCha8Rng {
    ChaCha8Rng::from_seed(digest("noise", source, query_id, seed))
}

/// SHA-256 over parts of known length, so that no two lists of parts look alike.
fn digest(purpose: &str, source: &str, query_id: &str, seed: u64) -> [u8; 32] {
    let mut hash = Sha256::new();
    for part in [purpose, source, query_id] {
        hash.update((part.len() as u64).to_le_bytes());
        hash.update(part.as_bytes());
    }
    hash.update(seed.to_le_bytes());
    hash.finalize().into()
}

#[cfg(test)]
mod tests {
    use super::answer_id;

    #[test]
    fn an_id_depends_on_who_what_and_seed_and_on_nothing_else() {
        let id = answer_id("person", "query-1", 1);
        assert_eq!(id, answer_id("person", "query-1", 1));
        for other in
            [answer_id("persons", "query-1", 1), answer_id("person", "query-2", 1), answer_id("person", "query-1", 2)]
        {
            assert_ne!(id, other);
        }
        // "ab" + "c" must not look like "a" + "bc".
        assert_ne!(answer_id("ab", "c", 1)[3..], answer_id("a", "bc", 1)[2..]);
    }
}
