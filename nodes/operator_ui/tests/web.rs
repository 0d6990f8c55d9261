//! What the web server promises, shown over real sockets on loopback.

mod world;

use bus::{Arguments, Graph, MemoryGraph, NodeError};
use operator_ui::{Access, Event, Hub, Limits, Server, Told};
use std::io::{Read, Write};
use std::net::{IpAddr, Ipv4Addr, SocketAddr, TcpListener, TcpStream};
use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;
use tokio_tungstenite::tungstenite::client::IntoClientRequest;
use tokio_tungstenite::tungstenite::{ClientRequestBuilder, Error, Message, WebSocket, client};

const TOKEN: &str = "0123456789abcdef0123";
const PATIENCE: Duration = Duration::from_secs(10);

struct Site {
    server: Server,
    hub: Hub,
    events: Receiver<Event>,
}

fn site(max_pages: usize) -> Site {
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).expect("there is a free port");
    let address = listener.local_addr().expect("it is bound");
    let access = Access::new(Some(TOKEN), address.ip(), address.port(), &[]).expect("the token is good");
    let (sender, events) = channel();
    let hub = Hub::new(max_pages);
    let limits = Limits { connections: 32, head: Duration::from_millis(300) };
    let server = Server::start(listener, access, hub.clone(), limits, move |event| {
        let _ = sender.send(event);
    })
    .expect("it starts");
    Site { server, hub, events }
}

impl Site {
    fn address(&self) -> SocketAddr {
        self.server.address()
    }

    /// Status, head and body of an answer to a GET with these headers besides Host.
    fn get(&self, target: &str, headers: &str) -> (u16, String, String) {
        self.raw(&format!("GET {target} HTTP/1.1\r\nHost: {}\r\nConnection: close\r\n{headers}\r\n", self.address()))
    }

    fn raw(&self, request: &str) -> (u16, String, String) {
        let mut stream = TcpStream::connect(self.address()).expect("it listens");
        stream.set_read_timeout(Some(PATIENCE)).expect("timeouts can be set");
        stream.write_all(request.as_bytes()).expect("it reads");
        let mut answer = String::new();
        let _ = stream.read_to_string(&mut answer);
        let (head, body) = answer.split_once("\r\n\r\n").unwrap_or((&answer, ""));
        let status = head.split(' ').nth(1).and_then(|code| code.parse().ok()).unwrap_or(0);
        (status, head.to_ascii_lowercase(), body.to_owned())
    }

    fn socket(&self, query: &str, origin: Option<&str>) -> Result<WebSocket<TcpStream>, u16> {
        let stream = TcpStream::connect(self.address()).expect("it listens");
        stream.set_read_timeout(Some(PATIENCE)).expect("timeouts can be set");
        let uri = format!("ws://{}/ws{query}", self.address()).parse().expect("it is an address");
        let mut request = ClientRequestBuilder::new(uri);
        if let Some(origin) = origin {
            request = request.with_header("Origin", origin);
        }
        match client(request.into_client_request().expect("it is a request"), stream) {
            Ok((socket, _)) => Ok(socket),
            Err(error) => match error {
                tokio_tungstenite::tungstenite::HandshakeError::Failure(Error::Http(response)) => {
                    Err(response.status().as_u16())
                }
                other => panic!("an answer was expected, got {other}"),
            },
        }
    }

    fn page(&self) -> Result<WebSocket<TcpStream>, u16> {
        self.socket(&format!("?token={TOKEN}"), Some(&format!("http://{}", self.address())))
    }

    fn event(&self) -> Event {
        self.events.recv_timeout(PATIENCE).expect("something happens")
    }
}

#[test]
fn the_page_needs_the_token_and_then_lives_on_a_cookie() {
    let site = site(4);
    for target in ["/", "/main.js", "/ws", "/?token=", "/?token=0123456789abcdef0124"] {
        let origin = format!("Origin: http://{}\r\n", site.address());
        assert_eq!(site.get(target, &origin).0, 401, "{target}");
    }
    let (status, head, body) = site.get(&format!("/?token={TOKEN}"), "");
    assert_eq!(status, 200);
    assert!(body.contains("id=\"table\""));
    assert!(head.contains("content-security-policy: default-src 'none'"), "{head}");
    assert!(head.contains("cache-control: no-store"));
    let cookie = head.lines().find_map(|line| line.strip_prefix("set-cookie: ")).expect("a cookie is set");
    assert!(cookie.contains("httponly") && cookie.contains("samesite=strict"), "{cookie}");
    let cookie = format!("Cookie: {}\r\n", cookie.split(';').next().unwrap_or_default());
    for target in ["/", "/main.js", "/style.css", "/icon.svg"] {
        assert_eq!(site.get(target, &cookie).0, 200, "{target}");
    }
    assert_eq!(site.get("/../Cargo.toml", &cookie).0, 404);
}

#[test]
fn foreign_names_and_foreign_pages_are_turned_away_even_with_the_token() {
    let site = site(4);
    let target = format!("/?token={TOKEN}");
    let foreign =
        format!("GET {target} HTTP/1.1\r\nHost: evil.example:{}\r\nConnection: close\r\n\r\n", site.address().port());
    assert_eq!(site.raw(&foreign).0, 403);
    assert_eq!(site.get(&target, "Origin: http://evil.example\r\n").0, 403);
    assert_eq!(site.get(&target, &format!("Origin: http://{}\r\n", site.address())).0, 200);
    let query = format!("?token={TOKEN}");
    assert_eq!(site.socket(&query, Some("http://evil.example")).err(), Some(403));
    assert_eq!(site.socket(&query, Some("null")).err(), Some(403));
    assert_eq!(site.socket(&query, None).err(), Some(403));
    assert_eq!(site.socket("", Some(&format!("http://{}", site.address()))).err(), Some(401));
    assert!(site.page().is_ok());
}

#[test]
fn texts_travel_both_ways_and_everyone_hears_what_is_for_all() {
    let site = site(4);
    let mut pages = [site.page().expect("it is let in"), site.page().expect("it is let in")];
    assert_eq!((site.event(), site.event()), (Event::Joined(0), Event::Joined(1)));
    pages[1].send(Message::text("hello")).expect("it is sent");
    assert_eq!(site.event(), Event::Said(1, "hello".into()));
    site.hub.tell(Told { to: Some(0), text: "one".into() });
    site.hub.tell(Told { to: None, text: "all".into() });
    let mut read = |page: usize| pages[page].read().expect("a text comes").into_text().expect("it is text").to_string();
    assert_eq!([read(0), read(0), read(1)], ["one", "all", "all"]);
}

#[test]
fn too_long_a_message_ends_its_connection_and_no_other() {
    let site = site(4);
    let mut greedy = site.page().expect("it is let in");
    let mut modest = site.page().expect("it is let in");
    assert_eq!((site.event(), site.event()), (Event::Joined(0), Event::Joined(1)));
    let _ = greedy.send(Message::text("x".repeat(64 * 1024 + 1)));
    let ended = loop {
        match greedy.read() {
            Ok(Message::Close(_)) | Err(_) => break true,
            Ok(_) => {}
        }
    };
    assert!(ended);
    modest.send(Message::text("x".repeat(64 * 1024))).expect("it is sent");
    assert!(matches!(site.event(), Event::Said(1, text) if text.len() == 64 * 1024));
}

#[test]
fn a_page_that_shouts_is_cut_off() {
    let site = site(4);
    let mut page = site.page().expect("it is let in");
    for _ in 0..2000 {
        if page.send(Message::text("{}")).is_err() {
            break;
        }
    }
    let said = std::iter::from_fn(|| site.events.recv_timeout(Duration::from_millis(500)).ok())
        .filter(|event| matches!(event, Event::Said(..)))
        .count();
    assert!(said <= 600, "{said}");
}

#[test]
fn only_so_many_pages_are_open_at_once_and_a_closed_one_makes_room() {
    let site = site(2);
    let first = site.page().expect("it is let in");
    let _second = site.page().expect("it is let in");
    assert_eq!(site.page().err(), Some(503));
    drop(first);
    let again = (0..100).find_map(|_| {
        std::thread::sleep(Duration::from_millis(20));
        site.page().ok()
    });
    assert!(again.is_some());
}

#[test]
fn nonsense_and_silence_do_not_hold_the_server_up() {
    let site = site(4);
    let _silent: Vec<TcpStream> = (0..32).map(|_| TcpStream::connect(site.address()).expect("it listens")).collect();
    std::thread::sleep(Duration::from_millis(600));
    assert_eq!(site.raw("\u{1}\u{2} nonsense\r\n\r\n").0, 400);
    let long = format!("GET / HTTP/1.1\r\nHost: {}\r\nX: {}\r\n\r\n", site.address(), "x".repeat(100_000));
    assert!(matches!(site.raw(&long).0, 0 | 431));
    assert_eq!(
        site.raw(&format!(
            "POST /?token={TOKEN} HTTP/1.1\r\nHost: {}\r\nConnection: close\r\nContent-Length: 0\r\n\r\n",
            site.address()
        ))
        .0,
        405
    );
    assert_eq!(site.get(&format!("/?token={TOKEN}"), "").0, 200);
}

fn arguments(parameters: &[String]) -> Arguments {
    let mut args = vec!["--ros-args".to_owned()];
    for parameter in parameters {
        args.extend(["-p".to_owned(), parameter.clone()]);
    }
    Arguments::parse(&args).expect("they are good")
}

#[test]
fn a_port_in_use_is_named_with_the_way_out() {
    let taken = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).expect("there is a free port");
    let port = taken.local_addr().expect("it is bound").port();
    let graph = Graph::Memory(MemoryGraph::new());
    let error = operator_ui::run(&graph, &arguments(&[format!("port:={port}")])).expect_err("the port is taken");
    assert_eq!(error.exit_code(), 2);
    let text = error.to_string();
    assert!(text.contains(&format!("port {port} on 127.0.0.1 is in use")) && text.contains("-p port:=0"), "{text}");
    assert!(!text.contains('\n'));
}

#[test]
fn others_are_let_in_only_with_a_good_token_file() {
    let graph = Graph::Memory(MemoryGraph::new());
    let run = |parameters: &[String]| operator_ui::run(&graph, &arguments(parameters)).expect_err("it must not start");
    let all: IpAddr = Ipv4Addr::UNSPECIFIED.into();
    let open = [format!("bind:={all}"), "port:=0".into()];
    assert!(run(&open).to_string().contains("token_file"));
    let folder = std::env::temp_dir().join(format!("operator_ui_{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("it can be made");
    let file = folder.join("token");
    std::fs::write(&file, "too short\n").expect("it can be written");
    let error = run(&[open[0].clone(), open[1].clone(), format!("token_file:={}", file.display())]);
    assert!(matches!(&error, NodeError::Start(text) if text.contains("9 characters")), "{error}");
    std::fs::remove_dir_all(&folder).expect("it can be removed");
}

#[test]
fn a_token_file_that_is_missing_is_made_and_kept() {
    let folder = std::env::temp_dir().join(format!("operator_ui_kept_{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("it can be made");
    let (token, url) = (folder.join("token"), folder.join("url"));
    let urls: Vec<String> = (0..2)
        .map(|_| {
            let memory = MemoryGraph::new();
            let graph = Graph::Memory(memory.clone());
            let files = [format!("token_file:={}", token.display()), format!("url_file:={}", url.display())];
            let given = arguments(&[&["port:=0".to_owned()], &files[..]].concat());
            let node = std::thread::spawn(move || operator_ui::run(&graph, &given));
            let text = wait_for(&url);
            memory.shutdown();
            node.join().expect("it does not panic").expect("it ends well");
            std::fs::remove_file(&url).expect("it was written");
            text.split_once('?').expect("it has a token").1.to_owned()
        })
        .collect();
    assert_eq!(urls[0], urls[1]);
    assert_eq!(format!("token={}", std::fs::read_to_string(&token).expect("it was made")), urls[0]);
    std::fs::remove_dir_all(&folder).expect("it can be removed");
}

/// What a file holds once it is there.
fn wait_for(file: &std::path::Path) -> String {
    let look = |_| {
        std::thread::sleep(Duration::from_millis(20));
        std::fs::read_to_string(file).ok()
    };
    (0..200).find_map(look).expect("the file is written")
}

#[test]
fn the_node_serves_its_page_at_the_address_in_the_file_until_the_graph_ends() {
    let folder = std::env::temp_dir().join(format!("operator_ui_url_{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("it can be made");
    let file = folder.join("url");
    let memory = MemoryGraph::new();
    let graph = Graph::Memory(memory.clone());
    let given = arguments(&["port:=0".into(), format!("url_file:={}", file.display())]);
    let node = std::thread::spawn(move || operator_ui::run(&graph, &given));
    let url = wait_for(&file);
    let rest = url.trim().strip_prefix("http://").expect("it is an address");
    let (address, target) = rest.split_once('/').expect("it has a path");
    let mut stream = TcpStream::connect(address).expect("it listens");
    stream.set_read_timeout(Some(PATIENCE)).expect("timeouts can be set");
    write!(stream, "GET /{target} HTTP/1.1\r\nHost: {address}\r\nConnection: close\r\n\r\n").expect("it reads");
    let mut answer = String::new();
    stream.read_to_string(&mut answer).expect("it answers");
    assert!(answer.starts_with("HTTP/1.1 200"), "{answer}");
    memory.shutdown();
    node.join().expect("it does not panic").expect("it ends well");
    assert!(TcpStream::connect(address).is_err());
    std::fs::remove_dir_all(&folder).expect("it can be removed");
}
