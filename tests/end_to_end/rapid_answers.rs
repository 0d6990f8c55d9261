//! A thousand answers about a world, as fast as a page may speak: each is accepted or refused with a reason, and none counts
//! twice.

use crate::caller::{Address, Caller, Fate, id};
use crate::recorded::Recorded;
use crate::suite::{Suite, fresh_folder};
use rustix::process::{Pid, Signal};
use serde_json::{Value, json};
use std::collections::BTreeSet;
use std::time::Duration;

const ANSWERS: u64 = 1000;
/// Time from one answer to the next: a little below the rate at which a page is cut off.
const PACE: Duration = Duration::from_millis(11);
/// Memory that a thousand answers may take, KiB: some six times what they do take.
const MAX_GROWTH: u64 = 32 * 1024;

/// A lesson about the garden that only a person answers, and that does not end by itself.
fn begin() -> Suite {
    let garden = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/config/grid.yaml")).expect("the garden");
    let endless = garden
        .replace("epsilon_loss: 0.05", "epsilon_loss: 0.001")
        .replace("max_questions: 120", "max_questions: 10000")
        .replace("n_draws: 8000", "n_draws: 2000");
    assert!(endless.contains("0.001") && endless.contains("10000") && endless.contains("2000"), "{garden}");
    let scenario = fresh_folder("rapid-scenario").join("garden.yaml");
    std::fs::write(&scenario, endless).expect("the folder of the tests can be written");
    Suite::start("rapid", &["--scenario", &scenario.to_string_lossy(), "--demonstrator", "human", "--seed", "3"])
}

/// Memory that a process holds, KiB.
fn resident(pid: Pid) -> u64 {
    let status = std::fs::read_to_string(format!("/proc/{}/status", pid.as_raw_nonzero())).expect("it runs");
    let line = status.lines().find(|line| line.starts_with("VmRSS:")).expect("the kernel tells");
    line.split_whitespace().nth(1).and_then(|number| number.parse().ok()).expect("a number of KiB")
}

/// What is said next: a question is skipped, also one that is closed; every other time the newest skip is taken back.
fn next(n: u64, page: &Caller, skips: &mut Vec<String>) -> Value {
    let is_accepted = |id: &String| page.fates.get(id) == Some(&Fate::Accepted);
    if n.is_multiple_of(2)
        && let Some(at) = skips.iter().rposition(is_accepted)
    {
        return json!({"type": "retract", "id": id(n), "evidence_id": skips.remove(at)});
    }
    skips.push(id(n));
    let question = &page.state["world_question"]["id"];
    json!({"type": "respond", "id": id(n), "query_id": question, "kind": "skip", "reason": ""})
}

#[test]
fn a_thousand_rapid_answers_are_each_accepted_or_refused_and_nothing_grows() {
    let mut suite = begin();
    let address = Address::of(&mut suite);
    let server = suite.node("operator_ui").expect("the page is served");
    let mut page = Caller::join(&address);
    page.question("world_question", "");
    let mut skips = Vec::new();
    let mut memory = vec![resident(server)];
    for n in 1..=ANSWERS {
        let command = next(n, &page, &mut skips);
        page.say(&command);
        page.listen(PACE);
        if n % (ANSWERS / 4) == 0 {
            memory.push(resident(server));
        }
    }
    let all_told = |page: &Caller| (page.fates.len() as u64 == ANSWERS).then_some(());
    page.wait("the fate of each answer", all_told);
    let refused: Vec<&String> =
        page.fates.values().filter_map(|fate| if let Fate::Refused(why) = fate { Some(why) } else { None }).collect();
    let accepted: BTreeSet<String> =
        page.fates.iter().filter(|(_, fate)| **fate == Fate::Accepted).map(|(id, _)| id.clone()).collect();
    println!("{} accepted, {} refused; memory {memory:?} KiB", accepted.len(), refused.len());
    assert!(refused.iter().all(|why| why.len() > 20), "every refusal has a reason");
    assert!(accepted.len() > 20 && refused.len() > 20, "{} accepted, {} refused", accepted.len(), refused.len());
    assert!(page.nonsense.is_empty(), "{:?}", page.nonsense);
    assert_eq!(suite.node("operator_ui"), Some(server), "the server is still the same");
    let grown = memory.iter().max().expect("there are some") - memory[0];
    assert!(grown < MAX_GROWTH, "{ANSWERS} answers took {grown} KiB: {memory:?}");
    // The lesson goes on.
    page.wait("an open question", |page| page.open("world_question"));
    drop(page);
    assert!(suite.stop(Signal::INT).success(), "{}", suite.dump());

    let bag = Recorded::read(&suite.bag()).expect("the bag opens");
    let evidence = bag.accepted();
    let distinct: BTreeSet<String> = evidence.iter().cloned().collect();
    assert_eq!(distinct.len(), evidence.len(), "an id is there twice");
    assert_eq!(distinct, accepted, "what the page was told is what counts");
    let journal = suite.journal();
    let journal = journal.iter().map(exchange::record_id);
    assert_eq!(journal.collect::<Vec<_>>(), evidence, "the journal against the log of evidence");
}
