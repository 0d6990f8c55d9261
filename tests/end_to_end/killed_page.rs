//! `kill -9` of the page's server between the press of a button and the receipt: the page comes back by itself, and the answer
//! counts once.

use crate::chromium::Page;
use crate::recorded::Recorded;
use crate::seated::{begin, listed, open, put, question};
use crate::suite::{Suite, run};
use apprentice_msgs::msg::EvidenceLog;
use rustix::process::{Signal, kill_process};
use std::net::{Ipv4Addr, TcpListener};
use std::time::Duration;

const LIMIT: Duration = Duration::from_secs(60);
/// Answers during which the server is killed at the very moment of the press.
const AT_ONCE: usize = 3;
/// How many answers the page keeps until it knows what became of them.
const OUTBOX: &str = "JSON.parse(sessionStorage.getItem('apprentice.outbox') ?? '[]').length";
/// The page says why the answer was not sent, and the same question waits once more.
const ASKED_AGAIN: &str = "document.getElementById('hint').dataset.tone === 'bad' \
                           && !document.getElementById('skip').disabled";

/// A port that is free now; the page's address stays the same over a restart.
fn free_port() -> u16 {
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).expect("there is a free port");
    listener.local_addr().expect("it is bound").port()
}

/// Lets a node do nothing from here on; it is killed later, and never goes on.
fn freeze(suite: &Suite, node: &str) {
    let pid = suite.node(node).unwrap_or_else(|| panic!("{node} does not run\n{}", suite.dump()));
    kill_process(pid, Signal::STOP).expect("it runs");
}

/// Kills nodes, and waits until they and the page are there again.
fn kill(suite: &mut Suite, page: &mut Page, nodes: &[&str]) {
    for node in nodes {
        let killed = suite.kill(node);
        suite.wait_for(&format!("{node} to come back"), LIMIT, |suite| suite.node(node).filter(|pid| *pid != killed));
    }
    page.wait("the connection", "!document.body.classList.contains('offline')");
}

/// Waits until the newest answer counts. Where the page says that it was not sent since the server, just started, knew of no
/// question yet, the person presses once more. How often they had to.
fn counts(page: &mut Page, answers: usize) -> usize {
    let counted = format!("{} === {answers}", listed("placement", "accepted"));
    let found = page.wait("the answer", &format!("{counted} ? 'counted' : {ASKED_AGAIN} ? 'again' : null"));
    if found == "again" {
        println!("answer {answers}: {}", page.value("document.getElementById('hint').innerText"));
        page.wait("the place that was meant", "!document.getElementById('submit').disabled");
        page.click("#submit");
        page.wait("the answer given once more", &counted);
    }
    usize::from(found == "again")
}

#[test]
fn an_answer_counts_once_when_the_server_is_killed_before_its_receipt() {
    let fixed = format!("  operator_ui:\n    ros__parameters:\n      port: {}\n", free_port());
    let mut suite = begin("killed-page", &fixed);
    let mut page = open(&mut suite);
    page.value("window.sameDocument = true");

    // The server dies with the answer unread: only the page knows of it.
    let mut asked = vec![question(&mut page, "")];
    let mut placed = vec![put(&mut page, 0)];
    freeze(&suite, "operator_ui");
    page.click("#submit");
    page.wait("the answer on its way", "document.getElementById('acknowledgement').dataset.state === 'sending'");
    assert_eq!((page.value(OUTBOX), suite.journal().len()), (1.into(), 0), "nobody else knows of the answer");
    kill(&mut suite, &mut page, &["operator_ui"]);
    let mut again = counts(&mut page, 1);

    // It dies when the answer has gone out, and the posterior with it before it says anything.
    asked.push(question(&mut page, &asked[0]));
    placed.push(put(&mut page, 3));
    freeze(&suite, "reward_posterior");
    page.click("#submit");
    page.wait("the answer at the server", &format!("{} === 1", listed("placement", "pending")));
    assert_eq!((page.value(OUTBOX), suite.journal().len()), (1.into(), 1), "it has no receipt");
    kill(&mut suite, &mut page, &["operator_ui", "reward_posterior"]);
    again += counts(&mut page, 2);

    // It dies at the very moment of the press: before it reads, sends or hears of the receipt, as it comes.
    for round in 0..AT_ONCE {
        asked.push(question(&mut page, &asked[1 + round]));
        placed.push(put(&mut page, 6 + 2 * round));
        page.click("#submit");
        kill(&mut suite, &mut page, &["operator_ui"]);
        again += counts(&mut page, 3 + round);
    }

    question(&mut page, asked.last().expect("there are some"));
    page.wait("an empty outbox", &format!("{OUTBOX} === 0"));
    println!("{again} of {} answers had to be given once more", placed.len());
    assert_eq!(page.value(&listed("placement", "accepted")), placed.len(), "the restarted server knows every answer");
    assert_eq!(page.value("window.sameDocument"), true, "nobody had to load the page anew");
    let told = |problem: &&String| !problem.contains("ERR_CONNECTION_REFUSED") && !problem.contains("WebSocket");
    let unexpected: Vec<&String> = page.problems.iter().filter(told).collect();
    assert!(unexpected.is_empty(), "{unexpected:#?}");
    drop(page);
    assert!(suite.stop(Signal::INT).success(), "{}", suite.dump());

    let bag = Recorded::read(&suite.bag()).expect("the bag opens");
    let log = bag.timed::<EvidenceLog>("evidence").pop().expect("there is evidence").1;
    let counted: Vec<_> = log.records.iter().flat_map(|record| &record.demonstration).collect();
    let at: Vec<[f64; 2]> = counted.iter().map(|m| [m.placement.x, m.placement.y]).collect();
    assert_eq!((at.len(), log.records.len(), suite.journal().len()), (placed.len(), placed.len(), placed.len()));
    assert_eq!(at, placed, "each answer counts once, in the order in which it was given");
    assert_eq!(counted.iter().map(|m| m.query_id.clone()).collect::<Vec<_>>(), asked);
    let output = run(&["replay", "--verify", &suite.bag().to_string_lossy()]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}
