//! A fingerprint of the evidence: the same content in the same order, however its files are laid out, gives the same one.

use likelihood::actions::{Choice, ChoiceVerdict};
use likelihood::preferences::{Answer, Verdict};
use mdp::{Features, Mdp};
use sha2::{Digest, Sha256};

use super::Evidence;

impl Evidence {
    /// SHA-256 over all evidence: a tag, a count and the content of every kind in turn, numbers by their bits, all
    /// little-endian. How rational people are, and how the posterior is sampled, are no part of it.
    pub fn hash(&self) -> [u8; 32] {
        let mut hash = Sha256::new_with_prefix(b"apprentice files 1");
        count(&mut hash, self.n_features);
        section(&mut hash, b"trajectories", self.items.len());
        numbers(&mut hash, &self.items);
        for (tag, answers) in [(b"preferences" as &[u8], &self.preferences), (b"progress", &self.progress)] {
            let answers = answers.as_deref().unwrap_or_default();
            section(&mut hash, tag, answers.len());
            answers.iter().for_each(|answer| add_answer(&mut hash, answer));
        }
        if let Some(mdp) = &self.mdp {
            add_process(&mut hash, mdp);
        }
        for (tag, choices) in [(b"actions" as &[u8], &self.actions), (b"critiques", &self.critiques)] {
            let choices = choices.as_deref().unwrap_or_default();
            section(&mut hash, tag, choices.len());
            choices.iter().for_each(|choice| add_choice(&mut hash, choice));
        }
        hash.finalize().into()
    }
}

fn add_answer(hash: &mut Sha256, answer: &Answer) {
    count(hash, answer.less);
    count(hash, answer.more);
    numbers(hash, &[answer.factor]);
    hash.update([match answer.verdict {
        Verdict::Strict => 0,
        Verdict::Equal => 1,
        Verdict::CantTell => 2,
    }]);
}

fn add_choice(hash: &mut Sha256, choice: &Choice) {
    count(hash, choice.state);
    count(hash, choice.action);
    numbers(hash, &[choice.factor]);
    hash.update([match choice.verdict {
        ChoiceVerdict::Taken => 0,
        ChoiceVerdict::Good => 1,
        ChoiceVerdict::Bad => 2,
    }]);
}

/// All that decides values; names of actions and the shape of a picture do not.
fn add_process(hash: &mut Sha256, mdp: &Mdp) {
    let parts = mdp.parts();
    section(hash, b"process", parts.n_states);
    count(hash, parts.n_actions);
    numbers(hash, &[parts.gamma]);
    numbers(hash, &parts.initial);
    section(hash, b"transitions", parts.transitions.len());
    for (state, action, target, probability) in parts.transitions {
        count(hash, state);
        count(hash, action);
        count(hash, target);
        numbers(hash, &[probability]);
    }
    let (tag, values) = match &parts.features {
        Features::State(values) => (b"features of states" as &[u8], values),
        Features::StateAction(values) => (b"features of actions" as &[u8], values),
    };
    section(hash, tag, values.len());
    numbers(hash, values);
}

fn section(hash: &mut Sha256, tag: &[u8], n: usize) {
    count(hash, tag.len());
    hash.update(tag);
    count(hash, n);
}

fn count(hash: &mut Sha256, n: usize) {
    hash.update((n as u64).to_le_bytes());
}

fn numbers(hash: &mut Sha256, numbers: &[f64]) {
    for x in numbers {
        hash.update(x.to_bits().to_le_bytes());
    }
}
