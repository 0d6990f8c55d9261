//! From parts to compressed rows, refusing everything that is not a process.

use crate::error::{MdpError, check_finite, check_sizes, check_transitions};
use crate::limits::{MAX_GAMMA, MAX_GAMMA_LARGE, MAX_STATES_LONG, SUM_TOLERANCE};
use crate::parts::{Features, MdpParts};

/// Transitions by row s·A + a, targets ascending.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Rows {
    /// Row r occupies `starts[r]..starts[r + 1]`.
    pub(crate) starts: Vec<u32>,
    pub(crate) targets: Vec<u32>,
    pub(crate) probabilities: Vec<f64>,
}

/// Checks everything about `parts`; the transitions as rows if all is well.
pub(crate) fn check(parts: &MdpParts) -> Result<Rows, MdpError> {
    let (n_states, n_actions) = (parts.n_states, parts.n_actions);
    check_sizes(n_states, n_actions, parts.n_features)?;
    check_transitions(parts.transitions.len())?;
    if !(0.0..=MAX_GAMMA).contains(&parts.gamma) {
        return Err(MdpError::Gamma { got: parts.gamma });
    }
    if parts.gamma > MAX_GAMMA_LARGE && n_states > MAX_STATES_LONG {
        return Err(MdpError::Horizon { gamma: parts.gamma, n_states });
    }
    check_distribution("initial", &parts.initial, n_states)?;
    check_features(parts)?;
    if !parts.actions.is_empty() && parts.actions.len() != n_actions {
        let (name, got) = ("actions", parts.actions.len());
        return Err(MdpError::Length { name, got, expected: n_actions, why: "n_actions, or none" });
    }
    if let Some([rows, columns]) = parts.shape
        && rows.checked_mul(columns) != Some(n_states)
    {
        return Err(MdpError::Shape { rows, columns, n_states });
    }
    let rows = compress(parts)?;
    check_rows(&rows, n_states, n_actions)?;
    Ok(rows.without_zeros())
}

/// Refuses a list that is not a distribution over `n` things.
fn check_distribution(name: &'static str, list: &[f64], n: usize) -> Result<(), MdpError> {
    if list.len() != n {
        return Err(MdpError::Length { name, got: list.len(), expected: n, why: "n_states" });
    }
    if let Some(index) = list.iter().position(|p| !(0.0..=1.0).contains(p)) {
        return Err(MdpError::Probability { name, index, got: list[index] });
    }
    let got: f64 = list.iter().sum();
    if (got - 1.0).abs() > SUM_TOLERANCE {
        return Err(MdpError::Sum { name, got });
    }
    Ok(())
}

fn check_features(parts: &MdpParts) -> Result<(), MdpError> {
    let (rows, why) = match &parts.features {
        Features::State(_) => (parts.n_states, "n_states × n_features"),
        Features::StateAction(_) => (parts.n_states * parts.n_actions, "n_states × n_actions × n_features"),
    };
    let (name, values) = (parts.features.name(), parts.features.values());
    if values.len() != rows * parts.n_features {
        return Err(MdpError::Length { name, got: values.len(), expected: rows * parts.n_features, why });
    }
    check_finite(name, values)
}

/// Sorts the transitions into rows, those of probability 0 too.
fn compress(parts: &MdpParts) -> Result<Rows, MdpError> {
    let (n_states, n_actions) = (parts.n_states, parts.n_actions);
    let mut starts = vec![0_u32; n_states * n_actions + 1];
    for (index, &(state, action, target, got)) in parts.transitions.iter().enumerate() {
        for (what, got, below) in
            [("state", state, n_states), ("action", action, n_actions), ("target", target, n_states)]
        {
            if got >= below {
                return Err(MdpError::OutOfRange { name: "transition", index, what, got, below });
            }
        }
        if !(0.0..=1.0).contains(&got) {
            return Err(MdpError::TransitionProbability { index, state, action, target, got });
        }
        starts[state * n_actions + action + 1] += 1;
    }
    for row in 1..starts.len() {
        starts[row] += starts[row - 1];
    }
    let mut next = starts.clone();
    let mut entries = vec![(0_u32, 0.0); parts.transitions.len()];
    for &(state, action, target, probability) in &parts.transitions {
        let place = &mut next[state * n_actions + action];
        entries[*place as usize] = (target as u32, probability);
        *place += 1;
    }
    for row in 0..n_states * n_actions {
        let entries = &mut entries[starts[row] as usize..starts[row + 1] as usize];
        entries.sort_by_key(|entry| entry.0);
        if let Some(pair) = entries.windows(2).find(|pair| pair[0].0 == pair[1].0) {
            let (state, action) = (row / n_actions, row % n_actions);
            return Err(MdpError::Duplicate { state, action, target: pair[0].0 as usize });
        }
    }
    let (targets, probabilities) = entries.into_iter().unzip();
    Ok(Rows { starts, targets, probabilities })
}

/// Refuses rows that do not sum to 1, but for states that have no transitions at all.
fn check_rows(rows: &Rows, n_states: usize, n_actions: usize) -> Result<(), MdpError> {
    for state in 0..n_states {
        let first = state * n_actions;
        if rows.starts[first] == rows.starts[first + n_actions] {
            continue;
        }
        for action in 0..n_actions {
            let range = rows.starts[first + action] as usize..rows.starts[first + action + 1] as usize;
            if range.is_empty() {
                return Err(MdpError::PartlyTerminal { state, action });
            }
            let got: f64 = rows.probabilities[range].iter().sum();
            if (got - 1.0).abs() > SUM_TOLERANCE {
                return Err(MdpError::TransitionSum { state, action, got });
            }
        }
    }
    Ok(())
}

impl Rows {
    /// The same without transitions of probability 0, which nothing follows.
    fn without_zeros(self) -> Self {
        if self.probabilities.iter().all(|p| *p > 0.0) {
            return self;
        }
        let mut kept = Self { starts: vec![0], targets: vec![], probabilities: vec![] };
        for ends in self.starts.windows(2) {
            let range = ends[0] as usize..ends[1] as usize;
            for (target, p) in self.targets[range.clone()].iter().zip(&self.probabilities[range]) {
                if *p > 0.0 {
                    kept.targets.push(*target);
                    kept.probabilities.push(*p);
                }
            }
            kept.starts.push(kept.targets.len() as u32);
        }
        kept
    }
}
