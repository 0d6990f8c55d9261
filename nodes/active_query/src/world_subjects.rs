//! What could be asked about a world: states that the robot may come to, and ways from there.

use crate::settings::QuestionKind;
use apprentice_msgs::msg::WorldQuery;
use inquiry::DrawnOptima;
use inquiry::tabular::discounted_features;
use mdp::random::index;
use mdp::{Mdp, MdpError, Policy, rollout};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

/// A larger world is looked at in this many states drawn anew for each question (dissertation section 8.2.3).
const MAX_SITUATIONS: usize = 300;
/// Ways of other rewards that the MAP policy's way from a state is held against.
const RIVALS: usize = 3;
/// Random words kept apart for each state: more than a way takes.
const WORDS: u128 = 256;
/// Ways whose features differ by less are the same to a person.
const SAME: f64 = 1e-9;

/// Pairs of a state and an action in the order of time.
pub(crate) type Way = Vec<(usize, usize)>;

/// Something that could be asked.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Subject {
    pub kind: QuestionKind,
    /// Its state, as a place in the list of situations.
    pub situation: usize,
    pub state: usize,
    /// None for an action, one for a critique, two for a comparison.
    pub ways: Vec<Way>,
}

impl Subject {
    /// What a question asks about. Only [`Subject::situation`] is not known from it.
    pub fn of(query: &WorldQuery) -> Self {
        let place = |n: u32| n as usize;
        Self {
            kind: match query.kind {
                WorldQuery::ACTION => QuestionKind::Action,
                WorldQuery::CRITIQUE => QuestionKind::Critique,
                _ => QuestionKind::Comparison,
            },
            situation: 0,
            state: place(query.state),
            ways: query
                .trajectories
                .iter()
                .map(|way| way.states.iter().zip(&way.actions).map(|(s, a)| (place(*s), place(*a))).collect())
                .collect(),
        }
    }
}

/// States in which there is something to do and that the robot can come to at all, ascending; of very many some by lot.
pub(crate) fn situations(mdp: &Mdp, rng: &mut ChaCha8Rng) -> Vec<usize> {
    let mut is_known: Vec<bool> = mdp.initial().iter().map(|p| *p > 0.0).collect();
    let mut open: Vec<usize> = (0..mdp.n_states()).filter(|&state| is_known[state]).collect();
    while let Some(state) = open.pop() {
        for action in 0..mdp.n_actions() {
            for (to, p) in mdp.successors(state, action) {
                if p > 0.0 && !is_known[to] {
                    is_known[to] = true;
                    open.push(to);
                }
            }
        }
    }
    let mut found: Vec<usize> = (0..mdp.n_states()).filter(|&s| is_known[s] && !mdp.is_terminal(s)).collect();
    if found.len() > MAX_SITUATIONS {
        for place in 0..MAX_SITUATIONS {
            let other = place + index(found.len() - place, rng);
            found.swap(place, other);
        }
        found.truncate(MAX_SITUATIONS);
        found.sort_unstable();
    }
    found
}

/// How ways are made.
pub(crate) struct Ways<'a> {
    pub mdp: &'a Mdp,
    /// What the robot would do.
    pub map: &'a [usize],
    pub optima: &'a DrawnOptima,
    /// Steps, at most.
    pub steps: usize,
    pub seed: u64,
    /// Keeps the luck of one question apart from that of another.
    pub stream: u64,
}

impl Ways<'_> {
    /// Everything of a kind that could be asked in `situations`.
    ///
    /// # Errors
    /// A state or a policy that is not of the world.
    pub fn subjects(&self, kind: QuestionKind, situations: &[usize]) -> Result<Vec<Subject>, MdpError> {
        let mut subjects = Vec::new();
        for (situation, &state) in situations.iter().enumerate() {
            let subject = |ways| Subject { kind, situation, state, ways };
            match kind {
                QuestionKind::Action => subjects.push(subject(Vec::new())),
                QuestionKind::Critique => {
                    let mut way = self.way(self.map, state)?;
                    // In a state where it ends nothing is done, and a step that comes again is judged once.
                    let is_new = |i: &usize| !way[..*i].contains(&way[*i]) && !self.mdp.is_terminal(way[*i].0);
                    way.truncate((0..way.len()).take_while(is_new).count());
                    if way.len() > 1 {
                        subjects.push(subject(vec![way]));
                    }
                }
                QuestionKind::Comparison => {
                    if let Some(pair) = self.pair(state)? {
                        subjects.push(subject(pair));
                    }
                }
            }
        }
        Ok(subjects)
    }

    /// The MAP policy's way and that of a reward that fits and would go another.
    fn pair(&self, state: usize) -> Result<Option<Vec<Way>>, MdpError> {
        let mut rng = self.luck(state);
        rng.set_word_pos((state as u128 + 1) * WORDS - 2 * RIVALS as u128);
        let own = self.way(self.map, state)?;
        let worth = |way: &[(usize, usize)]| discounted_features(self.mdp, way).unwrap_or_default();
        for _ in 0..RIVALS {
            let other = self.way(self.optima.policy(index(self.optima.n(), &mut rng)), state)?;
            if worth(&own).iter().zip(worth(&other)).any(|(a, b)| (a - b).abs() > SAME) {
                return Ok(Some(vec![own, other]));
            }
        }
        Ok(None)
    }

    /// A way from a state; all ways from it meet with the same luck, so that they differ by what was chosen.
    fn way(&self, policy: &[usize], state: usize) -> Result<Way, MdpError> {
        let policy = Policy::Deterministic(policy.to_vec());
        rollout(self.mdp, &policy, state, self.steps, &mut self.luck(state))
    }

    fn luck(&self, state: usize) -> ChaCha8Rng {
        let mut rng = ChaCha8Rng::seed_from_u64(self.seed);
        rng.set_stream(self.stream);
        rng.set_word_pos(state as u128 * WORDS);
        rng
    }
}

#[cfg(test)]
mod tests {
    use super::{Ways, situations};
    use crate::settings::QuestionKind;
    use inquiry::DrawnOptima;
    use mdp::Solver;
    use mdp::worlds::GridWorld;
    use rand_chacha::ChaCha8Rng;
    use rand_chacha::rand_core::SeedableRng;

    #[test]
    fn only_states_that_can_be_come_to_and_have_something_to_do_are_asked_about() {
        // A row of six cells; it ends in cell 3, so that cells 4 and 5 are never come to.
        let grid =
            GridWorld { terminals: vec![3], starts: vec![1], ..GridWorld::one_hot(1, 6, &[0, 0, 1, 2, 0, 0], 3) };
        let mdp = grid.mdp().expect("a row");
        assert_eq!(situations(&mdp, &mut ChaCha8Rng::seed_from_u64(1)), [0, 1, 2]);
        let wide = GridWorld { starts: vec![0], ..GridWorld::one_hot(20, 20, &[0; 400], 1) };
        let some = situations(&wide.mdp().expect("a field"), &mut ChaCha8Rng::seed_from_u64(1));
        assert!(some.len() == 300 && some.windows(2).all(|pair| pair[0] < pair[1]), "{some:?}");
    }

    #[test]
    fn ways_differ_by_what_was_chosen_and_end_where_it_ends() {
        let grid = GridWorld { terminals: vec![3], starts: vec![1], ..GridWorld::one_hot(1, 4, &[0, 1, 0, 2], 3) };
        let mdp = grid.mdp().expect("a row");
        let draws = [-0.1, -0.1, 1.0, 1.0, -1.0, -1.0];
        let optima = DrawnOptima::new(&mdp, &draws, 1).expect("draws");
        let map = Solver::new(&mdp).solve(&draws[..3]).policy().to_vec();
        let ways = Ways { mdp: &mdp, map: &map, optima: &optima, steps: 5, seed: 1, stream: 1 };
        let critiques = ways.subjects(QuestionKind::Critique, &[0, 1, 2]).expect("ways");
        // From cell 2 there is one step to the end, which is a question about an action.
        assert_eq!(critiques.iter().map(|subject| subject.state).collect::<Vec<_>>(), [0, 1]);
        assert_eq!(critiques[0].ways[0].iter().map(|step| step.0).collect::<Vec<_>>(), [0, 1, 2]);
        let comparisons = ways.subjects(QuestionKind::Comparison, &[0, 1, 2]).expect("ways");
        assert!(!comparisons.is_empty());
        for compared in &comparisons {
            assert!(compared.ways[0] != compared.ways[1] && compared.ways[0][0].0 == compared.state);
            assert_eq!(compared.ways[0].last().map(|step| step.0), Some(3), "the end belongs to the way");
        }
        assert_eq!(comparisons, ways.subjects(QuestionKind::Comparison, &[0, 1, 2]).expect("ways"));
    }
}
