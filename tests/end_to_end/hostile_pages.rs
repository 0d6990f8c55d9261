//! What no page would say: the server turns it away or refuses it, stays alive, and serves good pages as before.

use crate::caller::{Address, Caller, Fate, id};
use crate::recorded::Recorded;
use crate::suite::{Suite, run};
use apprentice_msgs::msg::{ActionDemonstration, QueryResponse};
use rustix::process::Signal;
use serde_json::{Value, json};
use std::io::{Read, Write};
use std::net::TcpStream;
use std::time::Duration;

/// Codes with which a connection is ended.
const UNSUPPORTED: u16 = 1003;
const POLICY: u16 = 1008;
const TOO_LONG: u16 = 1009;

/// The status of a plain request for a path.
fn get(host: &str, path: &str) -> String {
    let mut stream = TcpStream::connect(host).expect("the page is served");
    stream.set_read_timeout(Some(Duration::from_secs(20))).expect("a time-out can be set");
    write!(stream, "GET {path} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n\r\n").expect("it listens");
    let mut answer = String::new();
    stream.read_to_string(&mut answer).expect("an answer in text");
    answer.lines().next().unwrap_or_default().split_whitespace().nth(1).unwrap_or_default().to_owned()
}

/// Those whom the socket does not let in.
fn are_turned_away(address: &Address) {
    let Address { host, query } = address;
    let own = format!("http://{host}");
    let wrong = format!("{}{}", &query[..query.len() - 1], if query.ends_with('0') { '1' } else { '0' });
    let knock = |query: &str, headers: &[(&str, &str)]| Caller::knock(host, query, headers).err();
    for bad in
        ["", "token=", "token", "x=1", &wrong, &query[..query.len() - 1], &format!("{query}0"), &query.to_uppercase()]
    {
        assert_eq!(knock(bad, &[("origin", &own)]), Some(401), "{bad}");
    }
    let cookie = format!("apprentice_1={}", query.trim_start_matches("token="));
    assert_eq!(knock("", &[("origin", &own), ("cookie", &cookie)]), Some(401), "a cookie of another port");
    for origin in [
        "http://evil.example",
        "null",
        "file://",
        &format!("{own}0"),
        "http://localhost",
        &format!("{own}.evil.example"),
    ] {
        assert_eq!(knock(query, &[("origin", origin)]), Some(403), "{origin}");
    }
    assert_eq!(knock(query, &[]), Some(403), "no origin");
    let rebound = [("host", "evil.example:8642"), ("origin", "http://evil.example:8642")];
    assert_eq!(knock(query, &rebound), Some(403), "a foreign name for this machine");
    assert_eq!(
        (get(host, "/"), get(host, "/main.js"), get(host, &format!("/?{query}"))),
        ("401".into(), "401".into(), "200".into())
    );
    assert_eq!(get(host, &format!("/../../etc/passwd?{query}")), "404");
}

/// What ends a connection.
fn are_cut_off(address: &Address) {
    let mut huge = Caller::join(address);
    huge.say(&json!({"type": "respond", "id": id(1), "query_id": "", "kind": "stop", "reason": "x".repeat(1 << 20)}));
    assert!([Some(TOO_LONG), None].contains(&huge.wait_for_end()), "a text of 1 MiB");
    let mut bytes = Caller::join(address);
    bytes.say_bytes(b"{\"type\":\"tick\"}");
    assert_eq!(bytes.wait_for_end(), Some(UNSUPPORTED), "bytes instead of a text");
    let mut loud = Caller::join(address);
    for _ in 0..400 {
        loud.say_text("{}");
    }
    assert!([Some(POLICY), None].contains(&loud.wait_for_end()), "400 texts at once");
}

/// Texts that are no command.
fn is_nonsense(page: &mut Caller, query: &Value) {
    let skip = |more: &str| {
        format!("{{\"type\":\"respond\",\"id\":\"{}\",\"query_id\":{query},\"kind\":\"skip\"{more}}}", id(2))
    };
    let deep = format!("{}{}", "[".repeat(5000), "]".repeat(5000));
    let texts = [
        String::new(),
        "{".to_owned(),
        "null".to_owned(),
        "[]".to_owned(),
        "{}".to_owned(),
        "\u{0}".to_owned(),
        deep,
        skip("")[..40].to_owned(),
        skip("").replace("respond", "shutdown"),
        skip("").replace("skip", "destroy"),
        skip(",\"extra\":1"),
        skip(",\"kind\":\"skip\""),
        skip(",\"reason\":7"),
        skip("").replace(&format!("\"{}\"", id(2)), "2"),
        skip(",\"reason\":\"\\ud800\""),
        format!("{} {}", skip(""), skip("")),
        format!("{{\"type\":\"caution\",\"id\":\"{}\",\"lambda\":1e999}}", id(2)),
        format!("{{\"type\":\"act\",\"id\":\"{}\",\"query_id\":{query},\"action\":-1,\"confidence\":\"sure\"}}", id(2)),
        format!(
            "{{\"type\":\"act\",\"id\":\"{}\",\"query_id\":{query},\"action\":4294967296,\"confidence\":\"sure\"}}",
            id(2)
        ),
        format!(
            "{{\"type\":\"mark\",\"id\":\"{}\",\"query_id\":{query},\"segments\":[{{\"start\":0,\"end\":1,\"good\":true,\"x\":1}}],\"confidence\":\"sure\"}}",
            id(2)
        ),
    ];
    for text in texts {
        let before = page.nonsense.len();
        page.say_text(&text);
        page.wait(&format!("refusal of {text:.80}"), |page| (page.nonsense.len() > before).then_some(()));
        assert!(page.nonsense[before].starts_with("the page sent no command: "), "{:?}", page.nonsense[before]);
    }
}

/// Commands that cannot be carried out, each with a word of the reason.
fn are_refused(page: &mut Caller, query: &Value) {
    let act = |query: &Value| json!({"type": "act", "id": id(3), "query_id": query, "action": 0, "confidence": "sure"});
    let respond = |id: &str, kind: &str| json!({"type": "respond", "id": id, "query_id": query, "kind": kind});
    let segments = |segments: Value| json!({"type": "mark", "id": id(3), "query_id": query, "segments": segments, "confidence": "sure"});
    let cases = [
        (act(&json!("q999-nowhere")), "is no longer open"),
        (act(&json!("")), "is no longer open"),
        (act(&json!("x".repeat(30_000))), "is no longer open"),
        (respond("1", "skip"), "UUID"),
        (respond("", "stop"), "UUID"),
        (respond(&id(3).replace("-4000-", "-1000-"), "stop"), "UUID"),
        (respond(&"0".repeat(20_000), "stop"), "UUID"),
        (respond(&id(3), "placement"), "place"),
        (respond(&id(3), "history"), "no response"),
        (segments(json!([])), "does not ask what is good"),
        (segments(json!([{"start": 0, "end": 4_294_967_295_u32, "good": true}])), "does not ask what is good"),
        (
            json!({"type": "compare", "id": id(3), "query_id": query, "better": "first", "confidence": "sure"}),
            "does not ask which",
        ),
        (
            json!({"type": "place", "id": id(3), "query_id": "", "x_m": 0.5, "y_m": 0.5, "confidence": "sure"}),
            "no table",
        ),
        (json!({"type": "retract", "id": id(3), "evidence_id": id(999)}), "not known"),
        (json!({"type": "again", "id": id(3), "evidence_id": id(999)}), "not known"),
        (json!({"type": "caution", "id": id(3), "lambda": 1.5}), "from 0 to 1"),
        (json!({"type": "caution", "id": id(3), "lambda": -1e-300}), "from 0 to 1"),
    ];
    for (command, reason) in cases {
        // An id is cut to 128 characters before it comes back.
        let id: String = command["id"].as_str().expect("an id").chars().take(128).collect();
        page.fates.remove(&id);
        page.say(&command);
        let fate = page.wait(&format!("refusal of {command:.120}"), |page| page.fates.get(&id).cloned());
        assert!(
            matches!(&fate, Fate::Refused(why) if why.contains(reason) && why.len() < 400),
            "{command:.200}: {fate:?}"
        );
    }
}

/// Only what is listed can be taken up, by its plain name.
fn no_other_file_is_read(page: &mut Caller) {
    while page.state["recordings"].as_array().is_none_or(Vec::is_empty) {
        page.state["recordings"] = Value::Null;
        page.say(&json!({"type": "recordings", "id": id(4)}));
        page.listen(Duration::from_millis(50));
        page.wait("list of recordings", |page| (!page.state["recordings"].is_null()).then_some(()));
    }
    assert_eq!(page.state["recordings"][0]["name"], "session", "the folder beside holds this session alone");
    for name in [
        "../x",
        "..",
        ".",
        "",
        "/",
        "/etc/passwd",
        "session/..",
        "session/bag",
        "../hostile/session",
        "session\u{0}",
        "SESSION",
    ] {
        let fate = page.ask(&json!({"type": "load", "id": id(3), "name": name}));
        assert!(matches!(&fate, Fate::Refused(why) if why.contains("no such recording")), "{name:?}: {fate:?}");
    }
    assert!(matches!(page.ask(&json!({"type": "load", "id": "1", "name": "session"})), Fate::Refused(_)));
}

#[test]
fn what_no_page_would_say_is_turned_away_and_good_pages_are_served_on() {
    let mut suite = Suite::start("hostile", &["--scenario", "grid", "--demonstrator", "human", "--seed", "3"]);
    let address = Address::of(&mut suite);
    let server = suite.node("operator_ui");
    let mut good = Caller::join(&address);
    let question = good.question("world_question", "");
    assert_eq!(question["kind"], "action");
    let query = question["id"].clone();
    are_turned_away(&address);
    are_cut_off(&address);
    let mut bad = Caller::join(&address);
    is_nonsense(&mut bad, &query);
    are_refused(&mut bad, &query);

    // An action that the world does not have is for the posterior to refuse; then the question is open again.
    let act = |n: u64, query: &Value, action: u32| json!({"type": "act", "id": id(n), "query_id": query, "action": action, "confidence": "sure"});
    for (n, action) in [(5, 4), (6, u32::MAX)] {
        let fate = bad.ask(&act(n, &query, action));
        assert!(matches!(&fate, Fate::Refused(why) if !why.is_empty()), "action {action}: {fate:?}");
        bad.wait("the question open again", |page| page.open("world_question").filter(|open| open["id"] == query));
    }

    // The good page was never disturbed; its answer counts, and what repeats its id changes nothing.
    assert_eq!(good.ask(&act(7, &query, 1)), Fate::Accepted);
    let next = bad.question("world_question", query.as_str().expect("an id"))["id"].clone();
    let replays = [
        act(7, &query, 1),
        act(7, &query, 2),
        act(7, &next, 3),
        json!({"type": "respond", "id": id(7), "query_id": next, "kind": "skip"}),
        json!({"type": "retract", "id": id(7), "evidence_id": id(7)}),
        json!({"type": "load", "id": id(7), "name": "session"}),
    ];
    for replay in &replays {
        bad.say(replay);
    }
    // Everything that a connection says is taken in its order: this one comes after the replays.
    let last = json!({"type": "respond", "id": id(8), "query_id": next, "kind": "skip", "reason": "after the replays"});
    assert_eq!(bad.ask(&last), Fate::Accepted, "no replay answered the question in its place");
    good.wait("the skip on the good page", |page| page.fates.get(&id(8)).cloned());
    let accepted = |page: &Caller| -> Vec<Value> {
        let answers = page.state["answers"].as_array().expect("there are answers");
        answers
            .iter()
            .filter(|answer| answer["state"] != "refused")
            .map(|answer| json!([answer["id"], answer["state"], answer["revision"]]))
            .collect()
    };
    let both = [json!([id(7), "accepted", 1]), json!([id(8), "accepted", 2])];
    assert_eq!((accepted(&good), accepted(&bad)), (both.to_vec(), both.to_vec()));
    no_other_file_is_read(&mut bad);
    good.question("world_question", next.as_str().expect("an id"));
    assert_eq!(suite.node("operator_ui"), server, "the server was never started anew");
    drop((good, bad));
    assert!(suite.stop(Signal::INT).success(), "{}", suite.dump());

    let bag = Recorded::read(&suite.bag()).expect("the bag opens");
    assert_eq!(bag.accepted(), [id(7), id(8)]);
    let acted = bag.distinct::<ActionDemonstration>("action_demonstration");
    let actions: Vec<(&str, &[u32])> = acted.iter().map(|m| (m.id.as_str(), m.actions.as_slice())).collect();
    let of = |n: u64| acted.iter().filter(|m| m.id == id(n)).map(|m| m.actions.clone()).collect::<Vec<_>>();
    assert_eq!(of(7), [[1]], "the first content of an id is the only one that went out: {actions:?}");
    let said: Vec<String> = bag.distinct::<QueryResponse>("response").into_iter().map(|m| m.id).collect();
    assert_eq!(said, [id(8)], "nothing that was refused went out");
    let output = run(&["replay", "--verify", &suite.bag().to_string_lossy()]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}
