//! A page without a browser: what a browser says over its socket, and what anybody else might say.

use crate::suite::{Suite, now};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::io::ErrorKind;
use std::net::TcpStream;
use std::time::Duration;
use tungstenite::client::IntoClientRequest;
use tungstenite::http::{HeaderName, HeaderValue};
use tungstenite::{Bytes, Error, HandshakeError, Message, WebSocket};

/// Nothing takes longer than this, unless it is broken.
const PATIENCE: Duration = Duration::from_secs(60);

/// Where the page of a lesson is.
pub struct Address {
    /// Name and port.
    pub host: String,
    /// `token=…`.
    pub query: String,
}

impl Address {
    /// Waits until it is announced.
    pub fn of(suite: &mut Suite) -> Address {
        let url = suite.page_url();
        let (host, query) = url.trim_start_matches("http://").split_once("/?").expect("an address with a token");
        Address { host: host.to_owned(), query: query.to_owned() }
    }
}

/// What became of a command.
#[derive(Debug, Clone, PartialEq)]
pub enum Fate {
    /// It is evidence.
    Accepted,
    /// It is not, for this reason.
    Refused(String),
}

/// What a moment of listening brought.
#[derive(Debug, PartialEq)]
pub enum Heard {
    /// The node said something.
    Something,
    /// It did not.
    Nothing,
    /// The connection has ended, with this code of the protocol where one was given.
    End(Option<u16>),
}

/// One connection.
pub struct Caller {
    socket: WebSocket<TcpStream>,
    /// Every section of the state, the newest.
    pub state: Value,
    /// What became of each command, by its id.
    pub fates: BTreeMap<String, Fate>,
    /// Why texts that name no command were refused.
    pub nonsense: Vec<String>,
}

/// The id of the n-th command of a test.
pub fn id(n: u64) -> String {
    format!("00000000-0000-4000-8000-{n:012}")
}

impl Caller {
    /// Connects as the page does.
    pub fn join(address: &Address) -> Caller {
        let origin = format!("http://{}", address.host);
        Caller::knock(&address.host, &address.query, &[("origin", &origin)]).expect("the page is let in")
    }

    /// Connects with any query and headers; the HTTP status when it is turned away.
    pub fn knock(host: &str, query: &str, headers: &[(&str, &str)]) -> Result<Caller, u16> {
        let mut request = format!("ws://{host}/ws?{query}").into_client_request().expect("an address");
        for (name, value) in headers {
            let name = HeaderName::from_bytes(name.as_bytes()).expect("a name of a header");
            request.headers_mut().insert(name, HeaderValue::from_str(value).expect("a value of a header"));
        }
        let stream = TcpStream::connect(host).expect("the page is served");
        stream.set_nodelay(true).expect("a socket has that option");
        stream.set_read_timeout(Some(PATIENCE)).expect("a time-out can be set");
        match tungstenite::client(request, stream) {
            Ok((socket, _)) => Ok(Caller { socket, state: json!({}), fates: BTreeMap::new(), nonsense: Vec::new() }),
            Err(HandshakeError::Failure(Error::Http(response))) => Err(response.status().as_u16()),
            Err(other) => panic!("the handshake broke: {other}"),
        }
    }

    /// Sends a command.
    pub fn say(&mut self, command: &Value) {
        self.say_text(&command.to_string());
    }

    /// Sends any text; a connection that ends meanwhile is noticed by [`Caller::hear`].
    pub fn say_text(&mut self, text: &str) {
        let _ = self.socket.send(Message::text(text));
    }

    /// Sends what is no text.
    pub fn say_bytes(&mut self, bytes: &'static [u8]) {
        let _ = self.socket.send(Message::Binary(Bytes::from_static(bytes)));
    }

    /// Listens for one message, so long at most.
    pub fn hear(&mut self, patience: Duration) -> Heard {
        let patience = patience.max(Duration::from_millis(1));
        self.socket.get_ref().set_read_timeout(Some(patience)).expect("a time-out can be set");
        match self.socket.read() {
            Ok(Message::Text(text)) => {
                let message: Value = serde_json::from_str(&text).expect("the node speaks JSON");
                self.take(message);
                Heard::Something
            }
            Ok(Message::Close(frame)) => Heard::End(frame.map(|frame| frame.code.into())),
            Ok(_) => Heard::Something,
            Err(Error::Io(error)) if [ErrorKind::WouldBlock, ErrorKind::TimedOut].contains(&error.kind()) => {
                Heard::Nothing
            }
            Err(_) => Heard::End(None),
        }
    }

    /// Takes everything that the node says in this time, during which it may not end the connection.
    pub fn listen(&mut self, time: Duration) {
        let start = now();
        while let Some(left) = time.checked_sub(start.elapsed()) {
            let heard = self.hear(left);
            assert!(
                !matches!(heard, Heard::End(_)),
                "the connection ended: {heard:?}\n{:?}",
                self.fates.last_key_value()
            );
        }
    }

    fn take(&mut self, mut message: Value) {
        if message["type"] == "refused" {
            let reason = message["reason"].as_str().expect("a refusal has a reason").to_owned();
            match message["id"].as_str() {
                Some(id) => drop(self.fates.insert(id.to_owned(), Fate::Refused(reason))),
                None => self.nonsense.push(reason),
            }
        }
        let Value::Object(sections) = message["sections"].take() else { return };
        for (name, section) in sections {
            self.state[name] = section;
        }
        for answer in self.state["answers"].as_array().into_iter().flatten() {
            for of in [answer, &answer["undo"]] {
                let Some(id) = of["id"].as_str() else { continue };
                let fate = match of["state"].as_str() {
                    Some("accepted" | "undone" | "past") => Fate::Accepted,
                    Some("refused") => Fate::Refused(of["reason"].as_str().unwrap_or_default().to_owned()),
                    _ => continue,
                };
                self.fates.insert(id.to_owned(), fate);
            }
        }
    }

    /// Waits until `look` finds what is wanted.
    pub fn wait<T>(&mut self, what: &str, look: impl Fn(&Caller) -> Option<T>) -> T {
        let start = now();
        loop {
            if let Some(found) = look(self) {
                return found;
            }
            let heard = self.hear(Duration::from_millis(100));
            assert!(!matches!(heard, Heard::End(_)), "the connection ended before {what}: {heard:?}");
            let (lesson, answers) = (&self.state["lesson"], &self.state["answers"]);
            assert!(start.elapsed() < PATIENCE, "no {what}: {lesson}\n{answers}\n{:?}", self.fates);
        }
    }

    /// Waits for the connection to be ended from the other side: the code that is given.
    pub fn wait_for_end(&mut self) -> Option<u16> {
        let start = now();
        loop {
            match self.hear(Duration::from_millis(100)) {
                Heard::End(code) => return code,
                _ => assert!(start.elapsed() < PATIENCE, "the connection does not end"),
            }
        }
    }

    /// Sends a command and waits for what becomes of it.
    pub fn ask(&mut self, command: &Value) -> Fate {
        let id = command["id"].as_str().expect("a command has an id").to_owned();
        self.fates.remove(&id);
        self.say(command);
        self.wait(&format!("answer to {command}"), |caller| caller.fates.get(&id).cloned())
    }

    /// The open question in a section of the state, `question` or `world_question`.
    pub fn open(&self, section: &str) -> Option<Value> {
        Some(&self.state[section]).filter(|question| question["open"] == true).cloned()
    }

    /// Waits for an open question with another id than `before`.
    pub fn question(&mut self, section: &str, before: &str) -> Value {
        self.wait("open question", |caller| caller.open(section).filter(|question| question["id"] != before))
    }
}

/// A roomy spot on the table of a question, metres: where the nearest object is farthest away.
pub fn spot(scene: &Value) -> (f64, f64) {
    let number = |of: &Value| of.as_f64().expect("a number of metres");
    let (width, depth) = (number(&scene["width_m"]), number(&scene["depth_m"]));
    let room = |(x, y): (f64, f64)| {
        let objects = scene["objects"].as_array().expect("a table has objects");
        let to_object = |object: &Value| {
            let radius = 0.5 * f64::hypot(number(&object["size_x_m"]), number(&object["size_y_m"]));
            f64::hypot(x - number(&object["x_m"]), y - number(&object["y_m"])) - radius
        };
        // Half the way to the edge counts as much as the whole way to an object: the middle is a good place.
        let edge = 0.5 * x.min(width - x).min(y).min(depth - y);
        objects.iter().map(to_object).fold(edge, f64::min)
    };
    let spots = (1..40).flat_map(|i| (1..40).map(move |j| (f64::from(i) / 40.0, f64::from(j) / 40.0)));
    spots.map(|(u, v)| (u * width, v * depth)).max_by(|a, b| room(*a).total_cmp(&room(*b))).expect("there are spots")
}
