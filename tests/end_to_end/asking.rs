//! A person at the page of a lesson about a world, who is asked what to do, what is good on a way and which of two is better.

use crate::chromium::Page;
use crate::recorded::Recorded;
use crate::suite::{Suite, fresh_folder, run};
use apprentice_msgs::msg::{
    ActionDemonstration, CritiqueSegment, LessonStatus, QueryResponse, Retraction, SegmentCritique,
    TrajectoryPreference, WorldQuery,
};
use rustix::process::Signal;

/// A lesson about the garden that only a person answers, and its page. It asks for more than a few answers can give, and never before
/// it has learned from the last one, so that what is asked does not depend on how fast the machine is.
fn begin(name: &str, width: u32, height: u32) -> (Suite, Page) {
    let garden = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/config/grid.yaml")).expect("the garden");
    let strict = garden
        .replace("epsilon_loss: 0.05", "epsilon_loss: 0.001\n    next_within_s: 0.0")
        .replace("n_draws: 8000", "n_draws: 4000");
    assert!(strict.len() != garden.len() && strict.contains("n_draws: 4000"), "{garden}");
    let scenario = fresh_folder(&format!("{name}-scenario")).join("garden.yaml");
    std::fs::write(&scenario, strict).expect("the folder of the tests can be written");
    let scenario = scenario.to_string_lossy();
    let mut suite = Suite::start(name, &["--scenario", &scenario, "--demonstrator", "human", "--seed", "3"]);
    let address = suite.page_url();
    let page = Page::open(&address, width, height);
    (suite, page)
}

/// Waits for an open question other than `before`: its id and its kind.
fn question(page: &mut Page, before: &str) -> (String, String) {
    let open = format!(
        "(() => {{ const ask = document.getElementById('ask'), id = ask.dataset.query; \
         return !ask.hidden && id && id !== '{before}' ? [id, ask.dataset.kind] : null; }})()"
    );
    serde_json::from_value(page.wait("open question", &open)).expect("an id and a kind")
}

/// Waits until an answer is taken in as a revision.
fn taken(page: &mut Page, revision: u64) {
    let is_taken = format!("document.getElementById('ask-acknowledgement').dataset.value === '{revision}'");
    page.wait(&format!("revision {revision}"), &is_taken);
}

fn is_replayed(suite: &Suite) {
    let output = run(&["replay", "--verify", &suite.bag().to_string_lossy()]);
    let words = format!("{}{}", String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert!(output.status.success() && words.contains("equal bit for bit"), "{words}");
}

#[test]
fn every_kind_of_question_is_answered_with_the_mouse_taken_back_and_given_again() {
    let (mut suite, mut page) = begin("asking", 1280, 860);
    let pictures = fresh_folder("asking-pictures");
    let sizes = [("phone", 390, 844), ("tablet", 834, 1112), ("desktop", 1280, 860)];
    let look = |page: &mut Page, what: &str| {
        for (size, width, height) in sizes {
            page.resize(width, height);
            page.value("new Promise((done) => setTimeout(done, 150))");
            let wide = page.value("document.documentElement.scrollWidth <= innerWidth");
            assert_eq!(wide, true, "{what} on a {size}: the page is wider than the screen");
            page.screenshot(&pictures.join(format!("{what}-{size}.png")));
        }
    };

    let (action, kind) = question(&mut page, "");
    assert_eq!(kind, "action");
    assert_eq!(page.value("document.querySelectorAll('#world .move').length"), 0, "its own opinion stays hidden");
    page.wait("the mark where the robot is", "document.querySelector('#world .here') !== null");
    page.click("#ask-action-buttons label[data-side=\"right\"]");
    page.wait("the chosen arrow", "document.querySelector('#world .here-move') !== null");
    look(&mut page, "action");
    page.click("label:has(input[name=\"ask-confidence\"][value=\"fairly\"])");
    page.click("#ask-submit");
    taken(&mut page, 1);

    let (critique, kind) = question(&mut page, &action);
    assert_eq!(kind, "critique");
    assert_eq!(page.value("document.getElementById('ask-submit').disabled"), true, "nothing is marked");
    page.click("#ask-steps li:nth-child(1) button");
    page.click("#ask-steps li:nth-child(2) button");
    page.click("#ask-steps li:nth-child(2) button");
    page.wait("the marks on the way", "document.querySelectorAll('#world .stop.good, #world .stop.bad').length === 2");
    look(&mut page, "critique");
    page.click("#ask-submit");
    taken(&mut page, 2);

    let (comparison, kind) = question(&mut page, &critique);
    assert_eq!(kind, "comparison");
    page.wait("two travellers", "document.querySelectorAll('#world .traveller').length === 2");
    page.wait("that they walk", "Number(document.getElementById('ask-time').value) > 0.2");
    page.click("#ask-better label:has(input[value=\"second\"])");
    look(&mut page, "comparison");
    page.click("#ask-submit");
    taken(&mut page, 3);

    // Undo leads back to the question, redo answers it once more, and a skip leads on.
    let (after, _) = question(&mut page, &comparison);
    page.click("#ask-undo");
    page.wait("the undo", "document.getElementById('ask-acknowledgement').dataset.value === '4'");
    let (again, kind) = question(&mut page, &after);
    assert_eq!(kind, "comparison");
    page.click("#ask-redo");
    taken(&mut page, 5);
    let (skipped, _) = question(&mut page, &again);
    page.click("#ask-skip");
    taken(&mut page, 6);
    let (unknown, _) = question(&mut page, &skipped);
    page.click("#ask-cant-tell");
    taken(&mut page, 7);
    question(&mut page, &unknown);
    page.click("#ask-stop");
    page.wait("the question whether to stop", "document.getElementById('stop-dialog').open");
    page.click("#stop-confirm");
    page.wait("the end", "document.getElementById('state').dataset.value === 'stopped'");
    assert!(page.problems.is_empty(), "{:#?}", page.problems);
    drop(page);
    assert!(suite.stop(Signal::INT).success(), "{}", suite.dump());

    let bag = Recorded::read(&suite.bag()).expect("the bag opens");
    let asked = bag.distinct::<WorldQuery>("world_query");
    let find = |id: &str| asked.iter().find(|query| query.id == id).expect("it was recorded");
    let acted = bag.distinct::<ActionDemonstration>("action_demonstration");
    assert_eq!(acted[0].states, [find(&action).state]);
    assert_eq!((acted[0].query_id.as_str(), acted[0].confidence), (&*action, ActionDemonstration::CONFIDENCE_FAIRLY));
    let marked = &bag.distinct::<SegmentCritique>("critique")[0];
    let parts: Vec<_> = marked.segments.iter().map(|part| (part.start, part.end, part.verdict)).collect();
    assert_eq!(parts, [(0, 1, CritiqueSegment::GOOD), (1, 2, CritiqueSegment::BAD)]);
    assert_eq!((&marked.query_id, &marked.states), (&critique, &find(&critique).trajectories[0].states));
    let compared = bag.distinct::<TrajectoryPreference>("preference");
    for (given, id) in compared.iter().zip([&comparison, &again]) {
        assert_eq!((&given.query_id, given.answer), (id, TrajectoryPreference::RANKED));
        assert_eq!(given.trajectories[1].id, find(id).trajectories[1].id, "the one on the right is better");
    }
    assert_eq!(bag.distinct::<Retraction>("retraction")[0].evidence_id, compared[0].id);
    let responses = bag.distinct::<QueryResponse>("response");
    assert!(responses.iter().any(|m| m.query_id == skipped && m.kind == QueryResponse::SKIP));
    assert!(responses.iter().any(|m| m.kind == QueryResponse::STOP));
    let ended = bag.distinct::<LessonStatus>("lesson").pop().expect("there is one");
    assert_eq!((ended.state, ended.questions_asked), (LessonStatus::STOPPED, 7));
    is_replayed(&suite);
}

#[test]
fn a_lesson_is_answered_with_the_keyboard_alone() {
    let (mut suite, mut page) = begin("keyboard", 1024, 768);
    let focused = |page: &mut Page, selector: &str| {
        let is_there = format!("document.activeElement?.matches('{selector}') ?? false");
        for _ in 0..60 {
            if page.value(&is_there) == true {
                return;
            }
            page.key("Tab");
        }
        panic!("no Tab leads to {selector}");
    };
    let (action, kind) = question(&mut page, "");
    assert_eq!(kind, "action");
    focused(&mut page, "#ask-action input");
    page.key("ArrowUp");
    let chosen = "document.querySelector('#ask-action [data-side=\"up\"] input').checked";
    page.wait("the way up chosen", chosen);
    page.key("Enter");
    taken(&mut page, 1);

    let (critique, kind) = question(&mut page, &action);
    assert_eq!(kind, "critique");
    page.wait("the focus on the first step", "document.activeElement?.matches('#ask-steps li:first-child button')");
    let label = page.value("document.activeElement.getAttribute('aria-label')");
    assert!(label.as_str().is_some_and(|words| words.starts_with("Step 1 of ") && words.ends_with("not marked")));
    page.key("b");
    page.key("g");
    page.wait("two marks", "document.querySelectorAll('.step.bad, .step.good').length === 2");
    page.key("Enter");
    taken(&mut page, 2);

    let (comparison, kind) = question(&mut page, &critique);
    assert_eq!(kind, "comparison");
    page.wait("the focus on the first way", "document.activeElement?.name === 'ask-better'");
    page.key(" ");
    page.key("ArrowRight");
    page.wait("about equal", "document.querySelector('input[name=\"ask-better\"]:checked')?.value === 'equal'");
    page.key("Enter");
    taken(&mut page, 3);
    question(&mut page, &comparison);
    focused(&mut page, "#ask-skip");
    page.key(" ");
    taken(&mut page, 4);
    assert!(page.problems.is_empty(), "{:#?}", page.problems);
    drop(page);
    assert!(suite.stop(Signal::INT).success(), "{}", suite.dump());
    let bag = Recorded::read(&suite.bag()).expect("the bag opens");
    let marked = &bag.distinct::<SegmentCritique>("critique")[0];
    let parts: Vec<_> = marked.segments.iter().map(|part| (part.start, part.end, part.verdict)).collect();
    assert_eq!(parts, [(0, 1, CritiqueSegment::BAD), (1, 2, CritiqueSegment::GOOD)]);
    let said = &bag.distinct::<TrajectoryPreference>("preference")[0];
    assert_eq!((said.answer, &said.query_id), (TrajectoryPreference::EQUAL, &comparison));
    is_replayed(&suite);
}
