//! SIGINT and SIGTERM end the nodes of this process; so does the death of the parent that started it.

use std::{
    sync::{Mutex, OnceLock, PoisonError},
    thread,
    time::{Duration, Instant},
};

use signal_hook::{
    consts::{SIGINT, SIGTERM},
    iterator::Signals,
};

use crate::{error::BusError, stop::Stopper};

/// The variable in which `bringup` names its process to the nodes that it starts.
const PARENT_VARIABLE: &str = "APPRENTICE_PARENT_PID";

/// How often the parent is looked for.
const PARENT_PERIOD: Duration = Duration::from_millis(500);

/// The exit code of a process that has not ended in time, and is interrupted again.
const INTERRUPTED: i32 = 130;

/// How long nodes may take to end before another SIGINT ends the process at once.
const PATIENCE: Duration = Duration::from_secs(10);

/// The nodes to end.
static STOPPERS: Mutex<Vec<Stopper>> = Mutex::new(Vec::new());

/// Whether the handlers are in place, or why not.
static INSTALLED: OnceLock<Result<(), String>> = OnceLock::new();

/// Has a node ended by signals and by the parent's death.
///
/// # Errors
/// When the handlers cannot be installed.
pub(crate) fn stop_on_signals(stopper: &Stopper) -> Result<(), BusError> {
    STOPPERS.lock().unwrap_or_else(PoisonError::into_inner).push(stopper.clone());
    INSTALLED
        .get_or_init(|| install().map_err(|error| error.to_string()))
        .clone()
        .map_err(|reason| BusError::System { what: "signal handlers", source: std::io::Error::other(reason) })
}

/// Forgets a node.
pub(crate) fn forget(stopper: &Stopper) {
    STOPPERS.lock().unwrap_or_else(PoisonError::into_inner).retain(|other| !other.same(stopper));
}

/// Ends every node of this process.
fn stop_all() {
    for stopper in STOPPERS.lock().unwrap_or_else(PoisonError::into_inner).iter() {
        stopper.stop();
    }
}

#[expect(clippy::disallowed_methods, reason = "how long a person has waited is a matter of real time")]
fn now() -> Instant {
    Instant::now()
}

/// Starts the threads that wait.
fn install() -> std::io::Result<()> {
    let mut signals = Signals::new([SIGINT, SIGTERM])?;
    thread::Builder::new().name("signals".to_owned()).spawn(move || {
        let mut first: Option<Instant> = None;
        for signal in signals.forever() {
            // A signal often comes twice, from a terminal and from a launcher; bags are to be finished all the same.
            let now = now();
            if signal == SIGINT && now.duration_since(*first.get_or_insert(now)) > PATIENCE {
                std::process::exit(INTERRUPTED);
            }
            stop_all();
        }
    })?;
    let parent = std::env::var(PARENT_VARIABLE).ok().and_then(|text| text.trim().parse::<u32>().ok());
    if let Some(parent) = parent {
        thread::Builder::new().name("parent".to_owned()).spawn(move || {
            while std::os::unix::process::parent_id() == parent {
                thread::sleep(PARENT_PERIOD);
            }
            log::warn!("the process {parent} that started this node is gone; ending");
            stop_all();
        })?;
    }
    Ok(())
}
