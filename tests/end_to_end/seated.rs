//! A person who sits at the page of a lesson about a table, in a browser: what they do and what they see there.

use crate::chromium::Page;
use crate::suite::{ENDLESS, Suite, fresh_folder};

/// Starts a lesson that does not end by itself and that only a person answers; `more` goes into its parameters.
pub fn begin(name: &str, more: &str) -> Suite {
    let file = fresh_folder(&format!("{name}-parameters")).join("endless.yaml");
    std::fs::write(&file, format!("{ENDLESS}{more}")).expect("the folder of the tests can be written");
    Suite::start(name, &["--demonstrator", "human", "--seed", "3", "--params-file", &file.to_string_lossy()])
}

/// Opens the page of a lesson.
pub fn open(suite: &mut Suite) -> Page {
    Page::open(&suite.page_url(), 1280, 860)
}

/// Waits for a question other than `before` that can be answered here: its id.
pub fn question(page: &mut Page, before: &str) -> String {
    let open = format!(
        "(() => {{ const id = document.getElementById('question-id').dataset.value; \
         return !document.getElementById('skip').disabled && id !== '{before}' ? id : null; }})()"
    );
    page.wait("open question", &open).as_str().expect("an id").to_owned()
}

/// Puts the target on the table with the arrow keys, so many steps to the right of the free place nearest to the middle; returns
/// where the page says it is.
pub fn put(page: &mut Page, steps: usize) -> [f64; 2] {
    page.value("document.getElementById('target').focus()");
    page.key("ArrowUp");
    for _ in 0..steps {
        page.key("ArrowRight");
    }
    // Not into an object.
    for _ in 0..60 {
        if page.value("!document.getElementById('submit').disabled") == true {
            break;
        }
        page.key("ArrowRight");
    }
    page.wait("a place that can be answered", "!document.getElementById('submit').disabled");
    let at =
        "[Number(document.getElementById('target').dataset.x), Number(document.getElementById('target').dataset.y)]";
    serde_json::from_value(page.value(at)).expect("the target is on the table")
}

/// Waits until what was said last is taken in as a revision.
pub fn taken(page: &mut Page, revision: u64) {
    let is_taken = format!("document.getElementById('acknowledgement').dataset.value === '{revision}'");
    page.wait(&format!("revision {revision}"), &is_taken);
}

/// Waits until the page shows that the lesson is in a state.
pub fn state(page: &mut Page, word: &str) {
    page.wait(word, &format!("document.getElementById('state').dataset.value === '{word}'"));
}

/// How many answers of a kind the page lists in a state.
pub fn listed(kind: &str, state: &str) -> String {
    format!("document.querySelectorAll('#answers li[data-kind=\"{kind}\"][data-state=\"{state}\"]').length")
}
