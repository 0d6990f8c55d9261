//! A person at the page of a lesson about a table, who is asked which of two places is better: answered in the picture, by keyboard,
//! not at all and by a third place, taken back and given again.

use crate::chromium::Page;
use crate::recorded::Recorded;
use crate::suite::{Suite, fresh_folder, run};
use apprentice_msgs::msg::{
    LessonStatus, PlacementDemonstration, PlacementQuery, Posterior, Retraction, TrajectoryPreference,
};
use rustix::process::Signal;

/// Nearly every question is drawn at random.
const CURIOUS: &str = "/**/active_query:
  ros__parameters:
    hold_out_share: 0.9
    epsilon_m: 0.001
    misfit_level: 0.0
";

/// Waits for an open question that offers two places, or none, after `before`.
fn question(page: &mut Page, before: &str, offers_two: bool) -> String {
    let open = format!(
        "(() => {{ const id = document.getElementById('question-id').dataset.value, pair = document.getElementById('pair'); \
         return id && id !== '{before}' && document.getElementById('veil').hidden && pair.hidden !== {offers_two} ? id : null; }})()"
    );
    page.wait("an open question", &open).as_str().expect("an id").to_owned()
}

fn taken(page: &mut Page, revision: u64) {
    let is_taken = format!("document.getElementById('acknowledgement').dataset.value === '{revision}'");
    page.wait(&format!("revision {revision}"), &is_taken);
}

/// Places the target near the middle by keyboard.
fn place(page: &mut Page) {
    page.value("document.getElementById('target').focus()");
    for _ in 0..3 {
        page.key("ArrowUp");
    }
    page.wait("a place that fits", "!document.getElementById('submit').disabled");
    page.key("Enter");
}

#[test]
fn which_of_two_places_is_answered_in_every_way_taken_back_and_given_again() {
    let file = fresh_folder("pair-settings").join("curious.yaml");
    std::fs::write(&file, CURIOUS).expect("the folder of the tests can be written");
    let file = file.to_string_lossy();
    let mut suite = Suite::start("pair", &["--demonstrator", "human", "--seed", "2", "--params-file", &file]);
    let address = suite.page_url();
    let mut page = Page::open(&address, 1280, 860);
    let pictures = fresh_folder("pair-pictures");
    let first = question(&mut page, "", false);
    place(&mut page);
    taken(&mut page, 1);

    // Who came by keyboard has the first choice in hand; a press in the picture chooses too.
    let chosen = question(&mut page, &first, true);
    page.wait("the focus on A", "document.activeElement?.value === 'first'");
    assert_eq!(page.value("document.getElementById('submit').disabled"), true, "nothing is chosen");
    assert_eq!(page.value("document.getElementById('target').hasAttribute('hidden')"), true);
    assert_eq!(page.value("document.querySelectorAll('.ghost').length"), 0, "the robot's own opinion stays hidden");
    for (size, width, height) in [("phone", 390, 844), ("tablet", 834, 1112), ("desktop", 1280, 860)] {
        page.resize(width, height);
        page.value("new Promise((done) => setTimeout(done, 150))");
        let wide = page.value("document.documentElement.scrollWidth <= innerWidth");
        assert_eq!(wide, true, "on a {size} the page is wider than the screen");
        page.screenshot(&pictures.join(format!("pair-{size}.png")));
    }
    page.click("[data-option=\"1\"]");
    page.wait("B chosen", "document.querySelector('.option-b.chosen') && document.querySelector('#pair input:checked').value === 'second'");
    page.click("#submit");
    taken(&mut page, 2);
    let after = question(&mut page, &chosen, true);
    page.click("#undo");
    taken(&mut page, 3);
    let again = question(&mut page, &after, true);
    page.click("#redo");
    taken(&mut page, 4);

    let equal = question(&mut page, &again, true);
    page.value("document.querySelector('#pair input').focus()");
    page.key("ArrowRight");
    page.wait("about equal", "document.querySelector('#pair input:checked').value === 'equal'");
    page.key("Enter");
    taken(&mut page, 5);
    let unknown = question(&mut page, &equal, true);
    page.click("#cant-tell");
    taken(&mut page, 6);
    let neither = question(&mut page, &unknown, true);
    page.click("#neither");
    page.wait("the target to place", "!document.getElementById('target').hasAttribute('hidden')");
    place(&mut page);
    taken(&mut page, 7);
    page.wait("the list", "document.querySelectorAll('#answers [data-kind=preference]').length >= 3");
    let listed = page.value("document.getElementById('answers').innerText").to_string();
    assert!(
        listed.contains("Chose the better of two places") && listed.contains("Two places are about equal"),
        "{listed}"
    );
    assert!(page.problems.is_empty(), "{:#?}", page.problems);
    drop(page);
    assert!(suite.stop(Signal::INT).success(), "{}", suite.dump());

    let bag = Recorded::read(&suite.bag()).expect("the bag opens");
    let asked = bag.distinct::<PlacementQuery>("query");
    let find = |id: &str| asked.iter().find(|query| query.id == id).expect("it was recorded");
    let said = bag.distinct::<TrajectoryPreference>("preference");
    let better = |of: &TrajectoryPreference| of.trajectories[1].id.clone();
    assert_eq!((said[0].answer, better(&said[0])), (TrajectoryPreference::RANKED, format!("{chosen}-b")));
    assert_eq!(bag.distinct::<Retraction>("retraction")[0].evidence_id, said[0].id);
    assert_eq!(
        (said[1].answer, better(&said[1])),
        (TrajectoryPreference::RANKED, format!("{chosen}-b")),
        "given again"
    );
    assert_eq!((said[2].answer, &said[2].query_id), (TrajectoryPreference::EQUAL, &equal));
    assert_eq!((said[3].answer, &said[3].query_id), (TrajectoryPreference::CANT_TELL, &unknown));
    let shown = bag.distinct::<PlacementDemonstration>("demonstration");
    assert_eq!((shown.len(), &shown[1].query_id), (2, &neither));
    for id in [&chosen, &equal, &unknown, &neither] {
        assert!(find(id).held_out && find(id).options.len() == 2 && id.starts_with('Q'), "{id}");
    }
    let posteriors = bag.distinct::<Posterior>("posterior");
    let at =
        |revision: u64| posteriors.iter().find(|posterior| posterior.revision == revision).expect("it was recorded");
    assert_eq!(at(1).draws, at(3).draws, "taken back, it is as if it had not been said");
    assert_ne!(at(1).draws, at(2).draws, "it says something");
    let lesson = bag.distinct::<LessonStatus>("lesson").pop().expect("there is one");
    // The answer that was given again was given to no question.
    assert_eq!((lesson.state, lesson.held_out), (LessonStatus::ASKING, 0), "{lesson:?}");
    let output = run(&["replay", "--verify", &suite.bag().to_string_lossy()]);
    let words = format!("{}{}", String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert!(output.status.success() && words.contains("equal bit for bit"), "{words}");
}
