//! A person at the page who pauses, goes on, finishes, teaches on, begins anew, takes that back, and takes a recording up.

use crate::caller::{Address, Caller, Fate, id, spot};
use crate::chromium::Page;
use crate::recorded::Recorded;
use crate::seated::{begin, listed, open, put, question, state, taken};
use crate::suite::{fresh_folder, run};
use apprentice_msgs::msg::{
    EvidenceLog, LessonStatus, PlacementDemonstration, PlacementQuery, Posterior, QueryResponse,
};
use rustix::process::Signal;
use serde_json::json;
use std::path::PathBuf;

/// A recorded lesson with three placements, of which one was taken back, and a skip: its folder, and the placements that count.
fn earlier_lesson() -> (PathBuf, Vec<[f64; 2]>) {
    let mut suite = begin("controls-before", "");
    let mut page = Caller::join(&Address::of(&mut suite));
    let (mut before, mut placed) = (String::new(), Vec::new());
    for n in 1..=3 {
        let asked = page.question("question", &before);
        let (x, y) = spot(&asked["scene"]);
        let place =
            json!({"type": "place", "id": id(n), "query_id": asked["id"], "x_m": x, "y_m": y, "confidence": "fairly"});
        assert_eq!(page.ask(&place), Fate::Accepted);
        placed.push([x, y]);
        before = asked["id"].as_str().expect("an id").to_owned();
    }
    let skipped = page.question("question", &before)["id"].clone();
    assert_eq!(page.ask(&json!({"type": "respond", "id": id(4), "query_id": skipped, "kind": "skip"})), Fate::Accepted);
    assert_eq!(page.ask(&json!({"type": "retract", "id": id(5), "evidence_id": id(2)})), Fate::Accepted);
    placed.remove(1);
    drop(page);
    assert!(suite.stop(Signal::INT).success(), "{}", suite.dump());
    (suite.session.clone(), placed)
}

/// Waits for the question of a revision.
fn asked_at(page: &mut Page, revision: u64, why: &str) {
    let open = format!(
        "!document.getElementById('skip').disabled \
         && document.getElementById('question-id').dataset.value.startsWith('q{revision}-')"
    );
    page.wait(&format!("question of revision {revision}: {why}"), &open);
}

/// Opens the menu and presses something in it.
fn menu(page: &mut Page, button: &str) {
    page.click("#session summary");
    page.wait("the menu", "document.getElementById('session').open");
    page.wait(button, &format!("!document.getElementById('{button}').disabled"));
    page.click(&format!("#{button}"));
}

/// Waits until posterior and bound of a revision are there, after which a question would come; none may be open then.
fn asks_nothing(page: &mut Page, revision: u64) {
    let settled = format!(
        "document.getElementById('revision').dataset.value === '{revision}' \
         && document.getElementById('bound').dataset.revision === '{revision}'"
    );
    page.wait(&format!("bound of revision {revision}"), &settled);
    for closed in ["document.getElementById('question-id').dataset.value", "!document.getElementById('skip').disabled"]
    {
        let value = page.value(closed);
        assert!(value == "" || value == false, "a question is open in revision {revision}: {closed} is {value}");
    }
}

#[test]
fn a_lesson_is_paused_finished_begun_anew_and_taken_up_from_a_recording() {
    let (folder, earlier) = earlier_lesson();
    let mut suite = begin("controls", "");
    let parent = suite.session.parent().expect("a session lies in a folder").to_owned();
    std::fs::rename(folder, parent.join("earlier")).expect("a recording can be moved");
    let pictures = fresh_folder("controls-pictures");
    let mut page = open(&mut suite);
    let mut shown = Vec::new();
    let mut asked = String::new();
    for revision in 1..=2 {
        asked = question(&mut page, &asked);
        shown.push(put(&mut page, 3 * shown.len()));
        page.click("#submit");
        taken(&mut page, revision);
    }

    question(&mut page, &asked);
    menu(&mut page, "lesson-go");
    state(&mut page, "paused");
    page.wait("the bar of a paused lesson", "!document.getElementById('session-bar').hidden");
    asks_nothing(&mut page, 3);
    page.screenshot(&pictures.join("paused.png"));
    page.click("#go-on");
    state(&mut page, "asking");
    asked_at(&mut page, 4, "going on is the fourth event");

    menu(&mut page, "lesson-finish");
    state(&mut page, "finished");
    asks_nothing(&mut page, 5);
    page.click("#go-on");
    state(&mut page, "asking");
    asked_at(&mut page, 6, "taking the finish back is the sixth event");

    // Who does not confirm changes nothing.
    menu(&mut page, "lesson-new");
    page.wait("the dialog", "document.getElementById('new-dialog').open");
    page.click("#new-dialog button[value=\"keep\"]");
    page.wait("the dialog closed", "!document.getElementById('new-dialog').open");
    menu(&mut page, "lesson-new");
    page.wait("the dialog", "document.getElementById('new-dialog').open");
    page.screenshot(&pictures.join("new-dialog.png"));
    page.click("#new-dialog [data-testid=\"new-confirm\"]");
    page.wait("two placements that are past", &format!("{} === 2", listed("placement", "past")));
    asked_at(&mut page, 7, "the new lesson asks from the beginning");
    assert_eq!(page.value(&listed("placement", "accepted")), 0);
    assert_eq!(page.value("document.querySelectorAll('#answers li.entry[data-state=\"past\"] button').length"), 0);
    page.screenshot(&pictures.join("new-lesson.png"));
    page.click("#undo");
    page.wait("the placements again", &format!("{} === 2", listed("placement", "accepted")));
    assert_eq!(page.value("document.querySelectorAll('#answers li.entry[data-state=\"past\"]').length"), 0);
    asked_at(&mut page, 8, "the old lesson goes on");

    menu(&mut page, "lesson-load");
    page.wait("the recording", "document.querySelector('#recordings input[value=\"earlier\"]') !== null");
    assert_eq!(page.value("document.getElementById('load-confirm').disabled"), true, "nothing is chosen");
    page.click("#recordings label:has(input[value=\"earlier\"])");
    page.wait("the choice", "!document.getElementById('load-confirm').disabled");
    page.screenshot(&pictures.join("load-dialog.png"));
    page.click("[data-testid=\"load-confirm\"]");
    let taken_up = format!("{} === 2 && {} === 2", listed("placement", "past"), listed("placement", "accepted"));
    page.wait("what counted in the recording", &taken_up);
    asked_at(&mut page, 11, "a new lesson with two answers");
    page.screenshot(&pictures.join("taken-up.png"));
    assert!(page.problems.is_empty(), "{:#?}", page.problems);
    drop(page);
    assert!(suite.stop(Signal::INT).success(), "{}", suite.dump());
    is_told(&Recorded::read(&suite.bag()).expect("the bag opens"), &shown, &earlier);
    let output = run(&["replay", "--verify", &suite.bag().to_string_lossy()]);
    let words = format!("{}{}", String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert!(output.status.success() && words.contains("equal bit for bit"), "{words}");
}

/// The topics say the same.
fn is_told(bag: &Recorded, shown: &[[f64; 2]], earlier: &[[f64; 2]]) {
    let log = bag.timed::<EvidenceLog>("evidence").pop().expect("there is evidence").1;
    let said: Vec<u8> = log.records.iter().flat_map(|record| &record.response).map(|response| response.kind).collect();
    let words = [QueryResponse::PAUSE, QueryResponse::START, QueryResponse::FINISH];
    assert_eq!(said, [words.as_slice(), &[QueryResponse::NEW_LESSON; 2]].concat());
    let at = |placed: &PlacementDemonstration| [placed.placement.x, placed.placement.y];
    let in_force: Vec<_> = exchange::in_force(&log.records).flat_map(|record| &record.demonstration).map(at).collect();
    assert_eq!(in_force, earlier, "what counted in the recording counts, and nothing else");
    let all: Vec<[f64; 2]> = log.records.iter().flat_map(|record| &record.demonstration).map(at).collect();
    assert_eq!(all, [shown, earlier].concat(), "nothing is lost, and nothing is there twice");

    let posteriors = bag.distinct::<Posterior>("posterior");
    let of =
        |revision: u64| posteriors.iter().find(|posterior| posterior.revision == revision).expect("it was published");
    let counted: Vec<u64> = [0, 2, 7, 8, 11].map(|revision| of(revision).n_demonstrations).to_vec();
    assert_eq!(counted, [0, 2, 0, 2, 2]);
    assert_eq!(
        (&of(7).draws, &of(7).evidence_hash),
        (&of(0).draws, &of(0).evidence_hash),
        "a new lesson knows nothing"
    );
    assert_eq!(of(8).draws, of(6).draws, "undone, the draws are those of before");
    assert_ne!(of(11).draws, of(6).draws);
    let asked = bag.distinct::<PlacementQuery>("query");
    assert!(asked.iter().all(|query| ![3, 5].contains(&query.revision)), "a lesson that rests asks nothing");
    let lessons = bag.distinct::<LessonStatus>("lesson");
    for (revision, state) in [(3, LessonStatus::PAUSED), (5, LessonStatus::FINISHED)] {
        let mut rested = lessons.iter().filter(|lesson| lesson.revision == revision);
        assert!(rested.all(|lesson| lesson.state == state && lesson.query_id.is_empty()), "{lessons:?}");
        assert!(lessons.iter().any(|lesson| lesson.revision == revision));
    }
}
