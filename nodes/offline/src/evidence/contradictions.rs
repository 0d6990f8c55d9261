//! What in the evidence speaks against itself: allowed, since people err, but reported.

use std::collections::BTreeMap;

use likelihood::actions::ChoiceVerdict;
use likelihood::preferences::cycles;

use super::Evidence;

impl Evidence {
    /// Cycles of strict preferences, rows of the features: `[a, b, c]` says that b is preferred to a, c to b, and a to c.
    pub fn cycles(&self) -> Vec<Vec<usize>> {
        cycles(self.preferences.as_deref().unwrap_or_default())
    }

    /// Everything that is suspicious, in words; the cycles given are among it.
    pub fn warnings(&self, cycles_found: &[Vec<usize>]) -> Vec<String> {
        let mut warnings = self.warnings.clone();
        if self.counts().iter().all(|(_, n)| *n == 0) {
            warnings.push("the evidence is empty: this is the prior".to_owned());
        }
        warnings.extend(cycles_found.iter().map(|cycle| {
            format!("the preferences go in a circle: {}; no ranking agrees with all of them", in_words(cycle))
        }));
        for cycle in cycles(self.progress.as_deref().unwrap_or_default()) {
            warnings.push(format!("the attempts of learners go in a circle: {}", in_words(&cycle)));
        }
        warnings.extend(self.judged_both_ways());
        warnings
    }

    /// The first state and action that were called bad, and also shown or called good.
    fn judged_both_ways(&self) -> Option<String> {
        // Whether a pair was called bad, and whether it was taken or called good.
        let mut said: BTreeMap<(usize, usize), [bool; 2]> = BTreeMap::new();
        for choice in self.actions.iter().chain(&self.critiques).flatten() {
            let bad = choice.verdict == ChoiceVerdict::Bad;
            said.entry((choice.state, choice.action)).or_default()[usize::from(!bad)] = true;
        }
        let mut both = said.into_iter().filter(|(_, said)| *said == [true, true]).map(|(pair, _)| pair);
        let (state, action) = both.next()?;
        let more = match both.count() {
            0 => String::new(),
            1 => ", and one more such pair".to_owned(),
            n => format!(", and {n} more such pairs"),
        };
        Some(format!("action {action} in state {state} is called bad, and also taken or called good{more}"))
    }
}

/// `a < b < c < a`, shortened.
fn in_words(cycle: &[usize]) -> String {
    let shown = cycle.iter().take(8).map(|row| format!("{row} < ")).collect::<String>();
    let more = if cycle.len() > 8 { format!("… ({} rows) < ", cycle.len()) } else { String::new() };
    format!("{shown}{more}{}", cycle[0])
}
