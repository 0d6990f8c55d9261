//! How soon the page is told that an answer counts, and what the suite costs while it waits for a person.

use crate::idle;
use crate::suite::{Suite, now};
use serde_json::{Value, json};
use std::net::TcpStream;
use std::time::Duration;
use tungstenite::client::IntoClientRequest;
use tungstenite::http::HeaderValue;
use tungstenite::{Message, WebSocket};

/// Answers that are measured.
const ANSWERS: u64 = 30;
const LIMIT: Duration = Duration::from_secs(60);

/// Answers questions as a page does.
pub fn measure() -> Value {
    let mut suite = Suite::start("figures-page", &["--demonstrator", "human"]);
    let address = suite.page_url();
    let mut page = Page::join(&address);
    let (mut acknowledged, mut asked_again) = (Vec::new(), Vec::new());
    for n in 1..=ANSWERS {
        let question = page.wait(|state| state["question"]["open"] == true).clone()["question"]["id"].clone();
        let id = format!("00000000-0000-4000-8000-{n:012}");
        let start = now();
        page.say(&json!({"type": "respond", "id": id, "query_id": question, "kind": "skip", "reason": ""}));
        page.wait(|state| {
            let mut answers = state["answers"].as_array().into_iter().flatten();
            answers.any(|answer| answer["id"] == id.as_str() && answer["state"] == "accepted")
        });
        acknowledged.push(start.elapsed().as_secs_f64() * 1e3);
        page.wait(|state| state["question"]["open"] == true && state["question"]["id"] != question);
        asked_again.push(start.elapsed().as_secs_f64() * 1e3);
    }
    drop(page);
    json!({
        "acknowledged, ms": crate::percentiles(acknowledged),
        "skipped to next question on the page, ms": crate::percentiles(asked_again),
        "idle": idle::measure(&suite),
    })
}

/// A page without a browser.
struct Page {
    socket: WebSocket<TcpStream>,
    state: Value,
}

impl Page {
    fn join(address: &str) -> Page {
        let rest = address.trim_start_matches("http://");
        let (host, query) = rest.split_once("/?").unwrap_or((rest, ""));
        let mut request = format!("ws://{host}/ws?{query}").into_client_request().expect("an address");
        let origin = HeaderValue::from_str(&format!("http://{host}")).expect("a host");
        request.headers_mut().insert("Origin", origin);
        let stream = TcpStream::connect(host).expect("the page is served");
        stream.set_nodelay(true).expect("a socket has that option");
        stream.set_read_timeout(Some(LIMIT)).expect("a time-out can be set");
        let (socket, _) = tungstenite::client(request, stream).expect("the page is served");
        Page { socket, state: json!({}) }
    }

    fn say(&mut self, command: &Value) {
        self.socket.send(Message::text(command.to_string())).expect("the page is served");
    }

    /// Waits until the state is as wanted.
    fn wait(&mut self, wanted: impl Fn(&Value) -> bool) -> &Value {
        while !wanted(&self.state) {
            let Message::Text(text) = self.socket.read().expect("the node speaks within a minute") else { continue };
            let message: Value = serde_json::from_str(&text).expect("the node speaks JSON");
            for (name, section) in message["sections"].as_object().into_iter().flatten() {
                self.state[name] = section.clone();
            }
        }
        &self.state
    }
}
