//! The web server: the page's files and its socket, to those whom [`Access`] lets in.

use crate::access::{Access, AccessError};
use crate::assets::{ASSETS, Asset};
use crate::event::Event;
use crate::hub::Hub;
use crate::protocol::MAX_FROM_PAGE;
use crate::socket::converse;
use axum::Router;
use axum::extract::ws::WebSocketUpgrade;
use axum::extract::{Request, State};
use axum::http::header::{CONTENT_TYPE, COOKIE, HOST, HeaderMap, HeaderName, HeaderValue, ORIGIN, SET_COOKIE};
use axum::http::{StatusCode, Uri};
use axum::middleware::{Next, from_fn_with_state};
use axum::response::{IntoResponse, Response};
use axum::routing::get;
use hyper::server::conn::http1;
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::service::TowerToHyperService;
use std::net::{SocketAddr, TcpListener};
use std::sync::Arc;
use std::thread::JoinHandle;
use std::time::Duration;
use tokio::sync::{Semaphore, watch};

/// Nothing is fetched from anywhere else, and no other page may show this one.
const POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; \
                      connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
const HEADERS: [(&str, &str); 7] = [
    ("content-security-policy", POLICY),
    ("x-content-type-options", "nosniff"),
    ("x-frame-options", "DENY"),
    ("referrer-policy", "no-referrer"),
    ("cross-origin-opener-policy", "same-origin"),
    ("cross-origin-resource-policy", "same-origin"),
    ("cache-control", "no-store"),
];

/// What a client may use up.
#[derive(Debug, Clone, Copy)]
pub struct Limits {
    /// Connections at once, sockets included.
    pub connections: usize,
    /// A request's head must be there within this time, and an idle connection is closed after it.
    pub head: Duration,
}

impl Default for Limits {
    fn default() -> Self {
        Self { connections: 128, head: Duration::from_secs(10) }
    }
}

/// What handlers share.
#[derive(Clone)]
pub(crate) struct Shared {
    pub access: Arc<Access>,
    pub hub: Hub,
    pub send: Arc<dyn Fn(Event) + Send + Sync>,
}

/// The running server; dropping it closes every connection.
pub struct Server {
    address: SocketAddr,
    stop: watch::Sender<bool>,
    thread: Option<JoinHandle<()>>,
}

impl Server {
    /// Serves on a bound listener from a thread of its own. `send` takes what pages do.
    ///
    /// # Errors
    /// When the listener cannot be used or the thread cannot start.
    pub fn start(
        listener: TcpListener,
        access: Access,
        hub: Hub,
        limits: Limits,
        send: impl Fn(Event) + Send + Sync + 'static,
    ) -> std::io::Result<Self> {
        let address = listener.local_addr()?;
        listener.set_nonblocking(true)?;
        let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build()?;
        let listener = {
            let _inside = runtime.enter();
            tokio::net::TcpListener::from_std(listener)?
        };
        let (stop, stopped) = watch::channel(false);
        let shared = Shared { access: Arc::new(access), hub, send: Arc::new(send) };
        let thread = std::thread::Builder::new()
            .name("web".into())
            .spawn(move || runtime.block_on(accept(listener, router(shared), limits, stopped)))?;
        Ok(Self { address, stop, thread: Some(thread) })
    }

    /// Where it listens.
    pub fn address(&self) -> SocketAddr {
        self.address
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        self.stop.send_replace(true);
        if let Some(thread) = self.thread.take() {
            // A panic in there has been reported by its own thread.
            let _ = thread.join();
        }
    }
}

impl std::fmt::Debug for Server {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Server").field("address", &self.address).finish_non_exhaustive()
    }
}

async fn accept(listener: tokio::net::TcpListener, router: Router, limits: Limits, mut stopped: watch::Receiver<bool>) {
    let room = Arc::new(Semaphore::new(limits.connections));
    let service = TowerToHyperService::new(router);
    loop {
        let accepted = tokio::select! {
            accepted = listener.accept() => accepted,
            _ = stopped.changed() => return,
        };
        let Ok((stream, _)) = accepted else {
            // Out of file descriptors, or the peer left at once: neither gets better by hurrying.
            tokio::time::sleep(Duration::from_millis(50)).await;
            continue;
        };
        let Ok(place) = Arc::clone(&room).try_acquire_owned() else { continue };
        let _ = stream.set_nodelay(true);
        let service = service.clone();
        tokio::spawn(async move {
            let connection = http1::Builder::new()
                .timer(TokioTimer::new())
                .header_read_timeout(limits.head)
                .max_buf_size(32 * 1024)
                .serve_connection(TokioIo::new(stream), service)
                .with_upgrades();
            // A client that breaks off or talks nonsense concerns nobody else.
            let _ = connection.await;
            drop(place);
        });
    }
}

fn router(shared: Shared) -> Router {
    let mut router = Router::new().route("/ws", get(upgrade));
    for asset in ASSETS {
        router = router.route(asset.path, get(move |state, uri| serve(state, uri, asset)));
    }
    router.layer(from_fn_with_state(shared.clone(), guard)).with_state(shared)
}

/// Turns away whom the rules do not let in, and puts the headers on every answer.
async fn guard(State(shared): State<Shared>, request: Request, next: Next) -> Response {
    let mut response = match check(&shared.access, request.headers(), request.uri()) {
        Ok(()) => next.run(request).await,
        Err(error) => {
            let status = match error {
                AccessError::Token => StatusCode::UNAUTHORIZED,
                _ => StatusCode::FORBIDDEN,
            };
            (status, format!("{error}\n")).into_response()
        }
    };
    for (name, value) in HEADERS {
        response.headers_mut().insert(HeaderName::from_static(name), HeaderValue::from_static(value));
    }
    response
}

fn check(access: &Access, headers: &HeaderMap, uri: &Uri) -> Result<(), AccessError> {
    let header = |name: HeaderName| headers.get(name).and_then(|value| value.to_str().ok());
    let (host, is_socket) = (header(HOST), uri.path() == "/ws");
    access.check_host(host)?;
    access.check_origin(header(ORIGIN), host, is_socket)?;
    access.check_token(uri.query(), header(COOKIE))
}

/// One file. The page itself comes with the cookie, so that its address need not keep the token.
async fn serve(State(shared): State<Shared>, uri: Uri, asset: Asset) -> Response {
    let mut response = ([(CONTENT_TYPE, asset.media_type)], asset.body).into_response();
    let came_with_token = shared.access.check_token(uri.query(), None).is_ok();
    if asset.path == "/"
        && came_with_token
        && let Ok(cookie) = HeaderValue::from_str(&shared.access.set_cookie())
    {
        response.headers_mut().insert(SET_COOKIE, cookie);
    }
    response
}

async fn upgrade(State(shared): State<Shared>, socket: WebSocketUpgrade) -> Response {
    let Some((id, texts)) = shared.hub.join() else {
        return (StatusCode::SERVICE_UNAVAILABLE, "enough pages are open; close one of them\n").into_response();
    };
    let hub = shared.hub.clone();
    socket
        .max_message_size(MAX_FROM_PAGE)
        .max_frame_size(MAX_FROM_PAGE)
        .on_failed_upgrade(move |_| hub.leave(id))
        .on_upgrade(move |socket| converse(socket, id, texts, shared))
}
