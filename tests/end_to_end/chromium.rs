//! A headless Chromium, driven over its DevTools protocol.

use crate::suite::{Process, now};
use serde_json::{Value, json};
use std::net::TcpStream;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;
use tungstenite::{Message, WebSocket};

/// Nothing on a page takes longer than this, unless it is broken.
const PATIENCE: Duration = Duration::from_secs(60);

/// One page of a browser of its own.
pub struct Page {
    socket: WebSocket<TcpStream>,
    session: String,
    sent: u64,
    /// What went wrong on the page: exceptions, and errors in its log.
    pub problems: Vec<String>,
    _browser: Process,
    _profile: tempfile::TempDir,
}

/// Where Chromium is.
fn executable() -> PathBuf {
    let path =
        std::env::var_os("APPRENTICE_CHROMIUM").map_or_else(|| PathBuf::from("/usr/bin/chromium"), PathBuf::from);
    assert!(path.is_file(), "there is no Chromium at {}; run `tests/run` once, which installs it", path.display());
    path
}

impl Page {
    /// Starts a browser with a page of that size in pixels, and opens an address.
    pub fn open(address: &str, width: u32, height: u32) -> Page {
        let profile = tempfile::tempdir().expect("a folder for the browser");
        let mut command = Command::new(executable());
        command
            .args(["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run"])
            .args(["--disable-background-networking", "--disable-component-update", "--disable-sync"])
            .args(["--disable-dev-shm-usage", "--remote-debugging-port=0", "about:blank"])
            .arg(format!("--user-data-dir={}", profile.path().display()));
        let mut browser = Process::start(command, "chromium");
        let devtools = devtools_address(&mut browser);
        let host = devtools.trim_start_matches("ws://").split('/').next().unwrap_or_default();
        let stream = TcpStream::connect(host).expect("the browser listens");
        stream.set_read_timeout(Some(PATIENCE)).expect("a time-out can be set");
        let (socket, _) = tungstenite::client(devtools.as_str(), stream).expect("the browser speaks DevTools");
        let mut page = Page {
            socket,
            session: String::new(),
            sent: 0,
            problems: Vec::new(),
            _browser: browser,
            _profile: profile,
        };
        let target = page.command("Target.createTarget", json!({"url": "about:blank"}));
        let attached = page.command("Target.attachToTarget", json!({"targetId": target["targetId"], "flatten": true}));
        page.session = attached["sessionId"].as_str().expect("a session").to_owned();
        for domain in ["Page", "Runtime", "Log"] {
            page.command(&format!("{domain}.enable"), json!({}));
        }
        page.resize(width, height);
        page.command("Page.navigate", json!({"url": address}));
        page.wait("page", "location.href !== 'about:blank' && document.readyState === 'complete'");
        page
    }

    /// Sends a command and waits for its result.
    fn command(&mut self, method: &str, params: Value) -> Value {
        self.sent += 1;
        let mut message = json!({"id": self.sent, "method": method, "params": params});
        if !self.session.is_empty() {
            message["sessionId"] = json!(self.session);
        }
        self.socket.send(Message::text(message.to_string())).expect("the browser takes commands");
        loop {
            let message = self.socket.read().unwrap_or_else(|error| panic!("{method}: the browser is silent: {error}"));
            let Message::Text(text) = message else { continue };
            let mut answer: Value = serde_json::from_str(&text).expect("DevTools speaks JSON");
            if answer["id"] == self.sent {
                assert!(answer["error"].is_null(), "{method}: {}", answer["error"]);
                return answer["result"].take();
            }
            self.note(&answer);
        }
    }

    fn note(&mut self, event: &Value) {
        let params = &event["params"];
        match event["method"].as_str() {
            Some("Runtime.exceptionThrown") => self.problems.push(params["exceptionDetails"].to_string()),
            Some("Log.entryAdded") if params["entry"]["level"] == "error" => {
                self.problems.push(params["entry"].to_string())
            }
            _ => {}
        }
    }

    /// The value of a JavaScript expression.
    pub fn value(&mut self, expression: &str) -> Value {
        let params = json!({"expression": expression, "returnByValue": true, "awaitPromise": true});
        let mut result = self.command("Runtime.evaluate", params);
        assert!(result["exceptionDetails"].is_null(), "{expression}: {}", result["exceptionDetails"]);
        result["result"]["value"].take()
    }

    /// Waits until an expression is neither null, false, 0 nor "".
    pub fn wait(&mut self, what: &str, expression: &str) -> Value {
        let start = now();
        loop {
            let value = self.value(expression);
            if !(value.is_null() || value == false || value == 0 || value == "") {
                return value;
            }
            if start.elapsed() > PATIENCE {
                let text = self.value("document.body?.innerText ?? ''");
                panic!(
                    "the page shows no {what}: {}\nproblems: {:#?}",
                    text.as_str().unwrap_or_default(),
                    self.problems
                );
            }
            std::thread::sleep(Duration::from_millis(20));
        }
    }

    /// The `data-value` of the element with an id.
    pub fn data(&mut self, id: &str) -> String {
        let value = self.value(&format!("document.getElementById('{id}').dataset.value ?? ''"));
        value.as_str().expect("an attribute is text").to_owned()
    }

    /// Left, top, width and height of the first element that a selector finds, in pixels.
    pub fn rectangle(&mut self, selector: &str) -> [f64; 4] {
        let expression = format!(
            "(() => {{ const r = document.querySelector('{selector}').getBoundingClientRect(); return [r.x, r.y, r.width, r.height]; }})()"
        );
        serde_json::from_value(self.value(&expression)).unwrap_or_else(|error| panic!("{selector}: {error}"))
    }

    /// Middle of an element.
    pub fn middle(&mut self, selector: &str) -> (f64, f64) {
        let [x, y, width, height] = self.rectangle(selector);
        (x + 0.5 * width, y + 0.5 * height)
    }

    /// Drags from one place to another, as a hand does: in steps.
    pub fn drag(&mut self, from: (f64, f64), to: (f64, f64)) {
        self.mouse("mouseMoved", from, 0);
        self.mouse("mousePressed", from, 1);
        for step in 1..=12 {
            let share = f64::from(step) / 12.0;
            let at = (from.0 + share * (to.0 - from.0), from.1 + share * (to.1 - from.1));
            self.mouse("mouseMoved", at, 1);
        }
        self.mouse("mouseReleased", to, 0);
    }

    /// Clicks on an element.
    pub fn click(&mut self, selector: &str) {
        self.value(&format!("document.querySelector('{selector}').scrollIntoView({{block: 'nearest'}})"));
        let at = self.middle(selector);
        self.mouse("mouseMoved", at, 0);
        self.mouse("mousePressed", at, 1);
        self.mouse("mouseReleased", at, 0);
    }

    /// Presses a key on whatever has the focus.
    pub fn key(&mut self, key: &str) {
        let code = match key {
            "ArrowUp" => 38,
            "ArrowRight" => 39,
            "ArrowDown" => 40,
            "ArrowLeft" => 37,
            "Enter" => 13,
            "Tab" => 9,
            " " => 32,
            "b" => 66,
            "g" => 71,
            other => panic!("add the key {other} to this list"),
        };
        // A key that types something does what a button does on a space, only with its text.
        let down = if key.len() == 1 { "keyDown" } else { "rawKeyDown" };
        for kind in [down, "keyUp"] {
            let mut params = json!({"type": kind, "key": key, "code": key, "windowsVirtualKeyCode": code});
            if kind == "keyDown" {
                params["text"] = json!(key);
            }
            self.command("Input.dispatchKeyEvent", params);
        }
    }

    fn mouse(&mut self, kind: &str, at: (f64, f64), buttons: u32) {
        let button = if kind == "mouseMoved" && buttons == 0 { "none" } else { "left" };
        let params = json!({"type": kind, "x": at.0, "y": at.1, "button": button, "buttons": buttons, "clickCount": 1});
        self.command("Input.dispatchMouseEvent", params);
    }

    /// Makes the page as large as that, in pixels.
    pub fn resize(&mut self, width: u32, height: u32) {
        let size = json!({"width": width, "height": height, "deviceScaleFactor": 1, "mobile": false});
        self.command("Emulation.setDeviceMetricsOverride", size);
    }

    /// Keeps a picture of the page for people to look at.
    pub fn screenshot(&mut self, path: &Path) {
        let shot = self.command("Page.captureScreenshot", json!({"format": "png"}));
        let picture = data_encoding::BASE64.decode(shot["data"].as_str().expect("text").as_bytes()).expect("base 64");
        std::fs::write(path, picture).expect("the folder of the tests can be written");
    }
}

/// The address that the browser prints when it is ready.
fn devtools_address(browser: &mut Process) -> String {
    let start = now();
    loop {
        let (_, stderr) = browser.output();
        if let Some(at) = stderr.find("DevTools listening on ") {
            let rest = &stderr[at + "DevTools listening on ".len()..];
            if let Some(end) = rest.find('\n') {
                return rest[..end].trim().to_owned();
            }
        }
        let ended = browser.ended();
        assert!(ended.is_none() && start.elapsed() < PATIENCE, "the browser does not start\n{}", browser.dump());
        std::thread::sleep(Duration::from_millis(20));
    }
}
