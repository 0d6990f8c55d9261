//! What a person has done with the handles of a question and not said yet.

use crate::protocol::{SceneView, Segment};

/// See the module.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Draft {
    /// The question.
    pub question: String,
    /// Where the target was put, the table's frame.
    pub at_m: Option<[f64; 2]>,
    /// Whether something is in the way there.
    pub is_blocked: bool,
    /// For each step of a way: good, bad, or nothing.
    pub marks: Vec<Option<bool>>,
    /// What there is to say about the last thing done; empty: nothing.
    pub hint: String,
}

impl Draft {
    /// Nothing done yet.
    pub fn new(question: &str, n_steps: usize) -> Self {
        Self { question: question.to_owned(), marks: vec![None; n_steps], ..Self::default() }
    }

    /// The target was put somewhere: it stays on the table, and what is in its way is named.
    pub fn put(&mut self, scene: &SceneView, obstruction: impl Fn([f64; 2]) -> Option<String>, at_m: [f64; 2]) {
        let [x_m, y_m] = at_m;
        if !x_m.is_finite() || !y_m.is_finite() {
            return;
        }
        let at_m = [x_m.clamp(0.0, scene.width_m), y_m.clamp(0.0, scene.depth_m)];
        let blocked = obstruction(at_m);
        self.at_m = Some(at_m);
        self.is_blocked = blocked.is_some();
        self.hint = blocked.map(|what| format!("{} does not fit here: {what}", scene.target.label)).unwrap_or_default();
    }

    /// A step was pressed: good, then bad, then neither.
    pub fn press(&mut self, step: usize) {
        if let Some(mark) = self.marks.get_mut(step) {
            *mark = match *mark {
                None => Some(true),
                Some(true) => Some(false),
                Some(false) => None,
            };
            self.hint.clear();
        }
    }

    /// The marked parts: neighbours that are marked alike are one.
    pub fn segments(&self) -> Vec<Segment> {
        let mut segments: Vec<Segment> = Vec::new();
        for (step, mark) in (0_u32..).zip(&self.marks) {
            let Some(good) = *mark else { continue };
            match segments.last_mut().filter(|last| last.end == step && last.good == good) {
                Some(last) => last.end = step + 1,
                None => segments.push(Segment { start: step, end: step + 1, good }),
            }
        }
        segments
    }
}

#[cfg(test)]
mod tests {
    use super::Draft;
    use crate::protocol::Segment;

    #[test]
    fn neighbours_that_are_marked_alike_are_one_part() {
        let marks = vec![Some(true), Some(true), None, Some(false), Some(true)];
        let draft = Draft { marks, ..Draft::default() };
        let part = |start, end, good| Segment { start, end, good };
        assert_eq!(draft.segments(), [part(0, 2, true), part(3, 4, false), part(4, 5, true)]);
    }

    #[test]
    fn a_step_is_good_then_bad_then_neither() {
        let mut draft = Draft::new("q", 2);
        let seen: Vec<_> = (0..3)
            .map(|_| {
                draft.press(1);
                draft.marks[1]
            })
            .collect();
        assert_eq!(seen, [Some(true), Some(false), None]);
        draft.press(2);
        assert_eq!(draft.marks, [None, None], "there is no such step");
    }
}
