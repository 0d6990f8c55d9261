//! Two people at two pages of one lesson: both see the same question, and it is answered once.

use crate::chromium::Page;
use crate::recorded::Recorded;
use crate::seated::{begin, listed, open, put, question, taken};
use crate::suite::run;
use apprentice_msgs::msg::{EvidenceLog, EvidenceRecord, PlacementDemonstration};
use rustix::process::{Signal, kill_process};
use std::collections::BTreeSet;

/// How often both answer the same question.
const ROUNDS: usize = 5;
/// The answers that a page lists: what each is and what became of it.
const ANSWERS: &str =
    "[...document.querySelectorAll('#answers li')].map((item) => `${item.dataset.id} ${item.dataset.state}`)";

/// Waits until both pages have the same open question, another one than before.
fn asked_both(pages: &mut [Page; 2], before: &str) -> String {
    let [first, second] = pages.each_mut().map(|page| question(page, before));
    assert_eq!(first, second, "two pages of one lesson show one question");
    first
}

/// Both press their buttons at the same moment; how many are told that the question was closed already.
fn press_at_once(pages: &mut [Page; 2], buttons: [&str; 2], before: &str) -> u64 {
    let at = pages[0].value("Date.now() + 400").as_f64().expect("a time");
    for (page, button) in pages.iter_mut().zip(buttons) {
        page.value("document.getElementById('notices').replaceChildren()");
        page.value(&format!("setTimeout(() => document.getElementById('{button}').click(), {at} - Date.now())"));
    }
    asked_both(pages, before);
    let late =
        "[...document.querySelectorAll('#notices .notice')].filter((n) => n.innerText.includes('no longer open'))";
    pages.iter_mut().map(|page| page.value(&format!("{late}.length")).as_u64().expect("a number")).sum()
}

#[test]
fn two_pages_show_one_question_and_what_both_answer_counts_once() {
    let mut suite = begin("two-tabs", "");
    let mut pages = [open(&mut suite), open(&mut suite)];

    // One answers. No next question comes meanwhile, so that the other page shows what the answer did to this one.
    let mut asked = vec![asked_both(&mut pages, "")];
    let half_way = put(&mut pages[1], 4);
    let asker = suite.node("active_query").expect("it asks");
    kill_process(asker, Signal::STOP).expect("it runs");
    let placed = put(&mut pages[0], 0);
    pages[0].click("#submit");
    taken(&mut pages[0], 1);
    pages[1].wait("the answer of the other page", &format!("{} === 1", listed("placement", "accepted")));
    for button in ["submit", "skip", "cant-tell"] {
        pages[1].wait(&format!("{button} closed"), &format!("document.getElementById('{button}').disabled"));
    }
    assert_ne!(half_way, placed, "the two mean different places");
    kill_process(asker, Signal::KILL).expect("it is still there");

    // Both answer at the same moment: twice the same, and with different kinds of answer.
    let mut late = 0;
    for round in 0..ROUNDS {
        let before = asked[round].clone();
        let open = asked_both(&mut pages, &before);
        asked.push(open.clone());
        for (page, steps) in pages.iter_mut().zip([round, round + 2]) {
            put(page, steps);
        }
        let second = if round % 2 == 0 { "submit" } else { "skip" };
        late += press_at_once(&mut pages, ["submit", second], &open);
        let [one, other] = pages.each_mut().map(|page| page.value(ANSWERS));
        assert_eq!((&one, one.as_array().map(Vec::len)), (&other, Some(2 + round)), "both list one answer more");
    }
    println!("{late} of {ROUNDS} second answers came to a closed question");
    assert!((1..=ROUNDS as u64).contains(&late), "the two never pressed at once: {late}");
    for page in &pages {
        assert!(page.problems.is_empty(), "{:#?}", page.problems);
    }
    drop(pages);
    assert!(suite.stop(Signal::INT).success(), "{}", suite.dump());

    let bag = Recorded::read(&suite.bag()).expect("the bag opens");
    let log = bag.timed::<EvidenceLog>("evidence").pop().expect("there is evidence").1;
    let answered = |record: &EvidenceRecord| {
        let placed = record.demonstration.first().map(|m| m.query_id.clone());
        placed.or(record.response.first().map(|m| m.query_id.clone())).expect("an answer to a question")
    };
    assert_eq!(log.records.iter().map(answered).collect::<Vec<_>>(), asked, "each question has one answer");
    let sent: Vec<PlacementDemonstration> = bag.distinct("demonstration");
    let ids: BTreeSet<&str> = sent.iter().map(|m| m.id.as_str()).collect();
    let placements = log.records.iter().filter(|record| !record.demonstration.is_empty()).count();
    assert_eq!(ids.len(), placements, "what came too late was not even sent to the posterior");
    assert_eq!([sent[0].placement.x, sent[0].placement.y], placed);
    let output = run(&["replay", "--verify", &suite.bag().to_string_lossy()]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}
