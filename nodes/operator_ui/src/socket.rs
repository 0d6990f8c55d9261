//! The conversation with one page.

use crate::event::Event;
use crate::hub::PageId;
use crate::server::Shared;
use axum::extract::ws::{CloseFrame, Message, Utf8Bytes, WebSocket, close_code};
use std::time::Duration;
use tokio::sync::mpsc::Receiver;
use tokio::time::{Instant, timeout};

/// A page that does not take a text within this time is given up.
const SEND_TIMEOUT: Duration = Duration::from_secs(10);
/// More texts within [`RATE_WINDOW`] end the connection.
const RATE: u32 = 200;
const RATE_WINDOW: Duration = Duration::from_secs(2);

/// Passes texts on in both directions until either side ends.
pub(crate) async fn converse(mut socket: WebSocket, id: PageId, mut texts: Receiver<Utf8Bytes>, shared: Shared) {
    (shared.send)(Event::Joined(id));
    let farewell = talk(&mut socket, id, &mut texts, &shared).await;
    shared.hub.leave(id);
    if let Some((code, reason)) = farewell {
        let frame = CloseFrame { code, reason: Utf8Bytes::from_static(reason) };
        let _ = timeout(SEND_TIMEOUT, socket.send(Message::Close(Some(frame)))).await;
    }
}

/// The loop of [`converse`]; a reason when it is this side that ends it.
async fn talk(
    socket: &mut WebSocket,
    id: PageId,
    texts: &mut Receiver<Utf8Bytes>,
    shared: &Shared,
) -> Option<(u16, &'static str)> {
    let (mut since, mut heard) = (Instant::now(), 0_u32);
    loop {
        tokio::select! {
            said = socket.recv() => {
                if since.elapsed() > RATE_WINDOW {
                    (since, heard) = (Instant::now(), 0);
                }
                heard += 1;
                if heard > RATE {
                    return Some((close_code::POLICY, "too many messages"));
                }
                match said {
                    Some(Ok(Message::Text(text))) => (shared.send)(Event::Said(id, text.as_str().to_owned())),
                    Some(Ok(Message::Binary(_))) => return Some((close_code::UNSUPPORTED, "texts only")),
                    Some(Ok(Message::Ping(_) | Message::Pong(_))) => {}
                    Some(Ok(Message::Close(_))) | None => return None,
                    Some(Err(_)) => return Some((close_code::SIZE, "a message too long or malformed")),
                }
            }
            text = texts.recv() => {
                let Some(text) = text else { return Some((close_code::AGAIN, "the page fell behind")) };
                match timeout(SEND_TIMEOUT, socket.send(Message::Text(text))).await {
                    Ok(Ok(())) => {}
                    Ok(Err(_)) | Err(_) => return None,
                }
            }
        }
    }
}
