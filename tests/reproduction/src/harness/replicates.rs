//! Independent replicates on several threads, with a line of progress.

use std::io::{IsTerminal, Write};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

/// Runs `work` for replicates 0..n and gives the results in that order: they do not depend on the number of threads. The first
/// replicate that failed decides the error. Progress goes to standard error.
pub fn replicates<T: Send, E: Send>(
    label: &str,
    n: usize,
    threads: usize,
    work: impl Fn(usize) -> Result<T, E> + Sync,
) -> Result<Vec<T>, E> {
    let next = AtomicUsize::new(0);
    let results: Mutex<Vec<Option<Result<T, E>>>> = Mutex::new((0..n).map(|_| None).collect());
    let progress = Mutex::new(Progress::new(label, n));
    std::thread::scope(|scope| {
        for _ in 0..threads.clamp(1, n.max(1)) {
            scope.spawn(|| {
                loop {
                    let replicate = next.fetch_add(1, Ordering::Relaxed);
                    if replicate >= n {
                        break;
                    }
                    let result = work(replicate);
                    if result.is_err() {
                        next.store(n, Ordering::Relaxed);
                    }
                    results.lock().expect("no thread panics while it holds the results")[replicate] = Some(result);
                    progress.lock().expect("no thread panics while it prints").advance();
                }
            });
        }
    });
    progress.into_inner().expect("no thread panics while it prints").end();
    let results = results.into_inner().expect("no thread panics while it holds the results");
    // Replicates are begun in order, so all before the first that failed are there.
    results.into_iter().flatten().collect()
}

/// How far it is: on a terminal one line that is written over, else a line every tenth part.
struct Progress<'a> {
    label: &'a str,
    n: usize,
    done: usize,
    began: Instant,
    live: bool,
}

impl<'a> Progress<'a> {
    #[expect(clippy::disallowed_methods, reason = "the time left is told to a person and enters no result")]
    fn new(label: &'a str, n: usize) -> Self {
        Self { label, n, done: 0, began: Instant::now(), live: std::io::stderr().is_terminal() }
    }

    fn advance(&mut self) {
        self.done += 1;
        let tenth = self.n.div_ceil(10).max(1);
        if !self.live && !self.done.is_multiple_of(tenth) {
            return;
        }
        let spent = self.began.elapsed().as_secs_f64();
        let left = spent / self.done as f64 * (self.n - self.done) as f64;
        let line = format!("{}: {} of {}, {spent:.0} s so far, about {left:.0} s left", self.label, self.done, self.n);
        if self.live {
            eprint!("\r{line}   ");
            // A line of progress that cannot be shown is no reason to stop.
            let _ = std::io::stderr().flush();
        } else {
            eprintln!("{line}");
        }
    }

    fn end(self) {
        if self.live {
            eprintln!();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::replicates;

    #[test]
    fn results_come_in_order_whatever_the_threads() {
        let square = |i: usize| Ok::<_, String>(i * i);
        let one = replicates("squares", 37, 1, square);
        assert_eq!(one, replicates("squares", 37, 5, square));
        assert_eq!(one.map(|all| all[36]), Ok(36 * 36));
    }

    #[test]
    fn the_first_failure_is_the_answer() {
        let odd = |i: usize| if i % 2 == 1 { Err(format!("replicate {i}")) } else { Ok(i) };
        assert_eq!(replicates("failing", 20, 3, odd), Err("replicate 1".to_owned()));
    }
}
