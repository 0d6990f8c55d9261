//! What the weights are about: named by the first table or world, or counted by the first trajectories.

use exchange::MAX_WEIGHTS;

/// The weights of a session.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Weights {
    names: Vec<String>,
    /// What named them, for people; empty when trajectories have only counted them.
    by: String,
}

impl Weights {
    /// One name per weight; empty while nothing has said what they are about.
    pub(crate) fn names(&self) -> &[String] {
        &self.names
    }

    /// Whether their number is known.
    pub(crate) fn are_known(&self) -> bool {
        !self.names.is_empty()
    }

    /// Whether something with `n` features can be about these weights.
    ///
    /// # Errors
    /// What to tell a person.
    pub(crate) fn fit(&self, n: usize) -> Result<(), String> {
        let known = self.names.len();
        if known == 0 || n == known {
            return Ok(());
        }
        let by = if self.by.is_empty() { "its trajectories".to_owned() } else { self.by.clone() };
        Err(format!("it has {n} features, but this lesson has {known} weights, those of {by}"))
    }

    /// Takes names up, unless a table or a world has given some before.
    pub(crate) fn name(&mut self, names: Vec<String>, by: String) {
        if self.by.is_empty() {
            (self.names, self.by) = (names, by);
        }
    }

    /// Counts the weights by the features of a trajectory, until something names them.
    pub(crate) fn count(&mut self, n: usize) {
        if self.names.is_empty() {
            self.names = (0..n.min(MAX_WEIGHTS)).map(|k| format!("feature_{k}")).collect();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Weights;

    #[test]
    fn the_first_to_name_the_weights_names_them_and_trajectories_only_count_them() {
        let mut weights = Weights::default();
        assert_eq!((weights.are_known(), weights.fit(7)), (false, Ok(())));
        weights.count(2);
        assert_eq!(weights.names(), ["feature_0", "feature_1"]);
        let told = weights.fit(3).expect_err("3 are not 2");
        assert_eq!(told, "it has 3 features, but this lesson has 2 weights, those of its trajectories");
        weights.name(vec!["a".into(), "b".into()], "the world 'w'".into());
        weights.name(vec!["c".into(), "d".into()], "the table 't'".into());
        weights.count(5);
        assert_eq!(weights.names(), ["a", "b"]);
        let told = weights.fit(3).expect_err("3 are not 2");
        assert_eq!(told, "it has 3 features, but this lesson has 2 weights, those of the world 'w'");
    }
}
