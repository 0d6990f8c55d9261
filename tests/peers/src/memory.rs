//! How much memory this process has taken, as Linux counts it.

/// Resident bytes now; the peak is counted anew from here.
pub fn start() -> f64 {
    // Where that is not allowed the old peak stays, which only makes ours look worse.
    let _ = std::fs::write("/proc/self/clear_refs", "5");
    field("VmRSS:")
}

/// Most bytes above `before` that were resident since [`start`].
pub fn peak_since(before: f64) -> f64 {
    field("VmHWM:") - before
}

/// A field of the process's status, in bytes; NaN where the system has none.
fn field(name: &str) -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix(name));
    let kibibytes = line.and_then(|line| line.trim().trim_end_matches("kB").trim().parse::<f64>().ok());
    kibibytes.map_or(f64::NAN, |kibibytes| 1024.0 * kibibytes)
}

#[cfg(test)]
mod tests {
    use super::{peak_since, start};

    #[test]
    fn memory_that_was_taken_is_counted() {
        let before = start();
        let block = vec![1_u8; 64 << 20];
        assert!(block.iter().map(|x| u64::from(*x)).sum::<u64>() == 64 << 20);
        drop(block);
        let peak = peak_since(before);
        assert!(peak.is_nan() || peak >= (60 << 20) as f64, "{peak}");
    }
}
