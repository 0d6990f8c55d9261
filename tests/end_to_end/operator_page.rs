//! A person at the page: three questions answered by dragging, one answer taken back, and what the page shows is what
//! the topics say.

use crate::chromium::Page;
use crate::recorded::Recorded;
use crate::suite::{Suite, fresh_folder};
use apprentice_msgs::msg::{
    LessonStatus, PerformanceBounds, PlacementDemonstration, PlacementQuery, Posterior, Retraction,
};
use rustix::process::Signal;
use scene::Point;
use std::time::Duration;

/// The numbers that the page shows at a moment.
#[derive(Debug, Clone, PartialEq)]
struct Shown {
    revision: u64,
    bound_m: Option<f64>,
    bound_revision: u64,
    epsilon_m: f64,
    question: String,
}

/// What the page shows once everything of a revision has reached it.
fn shown(page: &mut Page, revision: u64) -> Shown {
    let settled = format!(
        "document.getElementById('revision').dataset.value === '{revision}' \
         && document.getElementById('bound').dataset.revision === '{revision}' \
         && document.getElementById('question-id').dataset.value.startsWith('q{revision}-')"
    );
    page.wait(&format!("revision {revision}"), &settled);
    let bound = page.data("bound");
    Shown {
        revision,
        bound_m: (!bound.is_empty()).then(|| bound.parse().expect("a number of metres")),
        bound_revision: page
            .value("document.getElementById('bound').dataset.revision")
            .as_str()
            .map_or(0, |r| r.parse().expect("a number")),
        epsilon_m: page.data("epsilon").parse().expect("a number of metres"),
        question: page.data("question-id"),
    }
}

/// The open question as it was recorded.
fn question(suite: &mut Suite, id: &str) -> PlacementQuery {
    suite.wait_for(&format!("question {id} in the bag"), Duration::from_secs(20), |suite| {
        let bag = Recorded::read(&suite.bag()).ok()?;
        bag.distinct::<PlacementQuery>("query").into_iter().find(|query| query.id == id)
    })
}

/// Where a person who likes the middle would put it: the free spot nearest to the table's centre.
fn spot(query: &PlacementQuery) -> Point {
    let scene = exchange::scene_from_message(&query.scene).expect("a question is about a good scene");
    let occupied = scene.occupied();
    let centre = Point::new(0.5 * scene.width_m, 0.5 * scene.depth_m);
    let cells = (1..40).flat_map(|i| (1..40).map(move |j| (f64::from(i) / 40.0, f64::from(j) / 40.0)));
    let spots = cells.map(|(u, v)| Point::new(u * scene.width_m, v * scene.depth_m));
    // A pixel or two beside it must be free too.
    let roomy = |at: &Point| {
        [(-0.01, 0.0), (0.01, 0.0), (0.0, -0.01), (0.0, 0.01)]
            .iter()
            .all(|(dx, dy)| occupied.is_free(Point::new(at.x + dx, at.y + dy)))
    };
    spots.filter(roomy).min_by(|a, b| a.distance(centre).total_cmp(&b.distance(centre))).expect("the table is not full")
}

/// Drags the target to a spot, in metres; returns where the page says it is.
fn drag(page: &mut Page, query: &PlacementQuery, to: Point) -> Point {
    let [left, top, width, height] = page.rectangle("#table .board-top");
    let pixel = (left + to.x / query.scene.width_m * width, top + height - to.y / query.scene.depth_m * height);
    let from = page.middle("#target .hit");
    page.drag(from, pixel);
    let at = page.value(
        "[Number(document.getElementById('target').dataset.x), Number(document.getElementById('target').dataset.y)]",
    );
    let [x, y]: [f64; 2] = serde_json::from_value(at).expect("the target is on the table");
    assert!((x - to.x).abs() < 0.01 && (y - to.y).abs() < 0.01, "dragged to {to:?}, it is at ({x}, {y})");
    Point::new(x, y)
}

#[test]
fn three_answers_are_dragged_one_is_taken_back_and_the_page_says_what_the_topics_say() {
    let mut suite = Suite::start("page", &["--demonstrator", "human"]);
    let address = suite.page_url();
    let pictures = fresh_folder("page-pictures");
    let mut page = Page::open(&address, 1280, 860);
    let mut seen = vec![shown(&mut page, 0)];
    let mut placed = Vec::new();
    for revision in 1..=3 {
        let id = seen.last().expect("the first is there").question.clone();
        let query = question(&mut suite, &id);
        page.wait("target to drag", "!document.getElementById('target').hasAttribute('hidden')");
        assert_eq!(page.data("guess-distance"), "", "the robot's guess is hidden before the first drag");
        placed.push(drag(&mut page, &query, spot(&query)));
        page.wait("guess after the drag", "document.getElementById('guess-distance').dataset.value");
        page.screenshot(&pictures.join(format!("question-{revision}.png")));
        page.click("#submit");
        page.wait(
            "acknowledgement",
            &format!("document.getElementById('acknowledgement').dataset.value === '{revision}'"),
        );
        seen.push(shown(&mut page, revision));
    }
    page.click("#undo");
    page.wait("acknowledgement of the undo", "document.getElementById('acknowledgement').dataset.value === '4'");
    seen.push(shown(&mut page, 4));
    page.screenshot(&pictures.join("after-undo.png"));
    let undone = page.value("[...document.querySelectorAll('#answers [data-state=undone]')].length");
    assert_eq!(undone, 1, "the list of answers shows the one that was taken back");
    assert!(page.problems.is_empty(), "{:#?}", page.problems);
    drop(page);
    assert!(suite.stop(Signal::INT).success(), "{}", suite.dump());

    let bag = Recorded::read(&suite.bag()).expect("the bag opens");
    let answers = bag.distinct::<PlacementDemonstration>("demonstration");
    let recorded: Vec<Point> = answers.iter().map(|d| Point::new(d.placement.x, d.placement.y)).collect();
    assert_eq!(recorded, placed, "what was dragged is what was recorded");
    let taken_back: Vec<String> = bag.distinct::<Retraction>("retraction").into_iter().map(|r| r.evidence_id).collect();
    assert_eq!(taken_back, [answers[2].id.clone()], "undo takes the newest answer back");
    assert_eq!(bag.accepted().len(), 4);

    assert_eq!(told(&bag), seen);
    let posteriors = bag.distinct::<Posterior>("posterior");
    assert_eq!(posteriors[4].evidence_hash, posteriors[2].evidence_hash, "undone, the evidence is that of two answers");
    assert_eq!(posteriors[4].draws, posteriors[2].draws);
}

/// What the topics say at each revision.
fn told(bag: &Recorded) -> Vec<Shown> {
    let (lessons, queries) = (bag.distinct::<LessonStatus>("lesson"), bag.distinct::<PlacementQuery>("query"));
    let of = |bounds: PerformanceBounds| Shown {
        revision: bounds.revision,
        bound_m: Some(bounds.bound_m).filter(|bound| bound.is_finite()),
        bound_revision: bounds.revision,
        epsilon_m: lessons.iter().find(|l| l.revision == bounds.revision).map_or(f64::NAN, |l| l.epsilon_m),
        question: queries.iter().find(|q| q.revision == bounds.revision).map_or(String::new(), |q| q.id.clone()),
    };
    bag.distinct::<PerformanceBounds>("bounds").into_iter().map(of).collect()
}
