//! A person at the page of a lesson about a world: looks at other balances, chooses one with the keyboard, and the robot
//! follows it.

use crate::chromium::Page;
use crate::recorded::Recorded;
use crate::suite::{Suite, fresh_folder, run};
use apprentice_msgs::msg::{RiskPreference, RobustPolicy};
use rustix::process::Signal;
use std::time::Duration;

#[test]
fn the_slider_shows_what_caution_costs_and_the_robot_follows_the_choice() {
    let mut suite = Suite::start("caution", &["--scenario", "grid", "--seed", "2"]);
    let address = suite.page_url();
    let pictures = fresh_folder("caution-pictures");
    let mut page = Page::open(&address, 1280, 860);
    page.wait("page about a world", "!document.getElementById('lesson-world').hidden");
    page.wait("arrows", "document.querySelectorAll('#world .move').length > 20");
    page.wait("frontier", "document.querySelectorAll('#frontier .frontier-dot').length === 21");
    let limit = Duration::from_secs(240);
    suite.wait_for("the lesson's end", limit, |suite| suite.shown().contains("taught after").then_some(()));
    page.wait("the lesson's end", "document.getElementById('state').dataset.value === 'taught'");
    assert_eq!(page.value("document.getElementById('lesson-table').hidden"), true);
    let risk = page.value("document.getElementById('world-risk').textContent");
    assert!(
        risk.as_str().is_some_and(|words| words.contains("In the worst 5 % of what the person may mean")),
        "{risk}"
    );
    // The keyboard moves the slider: a preview, which the robot does not follow yet.
    page.value("document.getElementById('lambda').focus()");
    page.key("ArrowRight");
    page.key("ArrowRight");
    page.wait("a preview", "document.getElementById('caution-state').dataset.value === 'preview'");
    assert_eq!(page.value("Number(document.getElementById('lambda').value)"), 0.6);
    let told = page.value("document.getElementById('lambda').getAttribute('aria-valuetext')");
    assert!(told.as_str().is_some_and(|words| words.contains("average return") && words.contains("worst")), "{told}");
    page.screenshot(&pictures.join("preview.png"));
    page.key("Enter");
    page.wait("the choice followed", "document.getElementById('caution-state').dataset.value === 'chosen'");
    page.screenshot(&pictures.join("chosen.png"));
    assert!(page.problems.is_empty(), "{:#?}", page.problems);
    let judged = "document.getElementById('world-claim').textContent.includes('sure')";
    page.wait("a bound on the new policy", judged);
    drop(page);
    assert!(suite.stop(Signal::INT).success(), "{}", suite.dump());

    let bag = Recorded::read(&suite.bag()).expect("the bag opens");
    let said = bag.distinct::<RiskPreference>("risk_preference");
    assert_eq!(said.iter().map(|one| (one.number, one.lambda)).collect::<Vec<_>>(), [(1, 0.6)]);
    let policies = bag.distinct::<RobustPolicy>("robust_policy");
    let last = policies.last().expect("there is one");
    assert_eq!((last.lambda, last.preference_number, &last.preference_id), (0.6, 1, &said[0].id));
    let output = run(&["replay", "--verify", &suite.bag().to_string_lossy()]);
    let words = format!("{}{}", String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert!(output.status.success() && words.contains("equal bit for bit"), "{words}");
}
