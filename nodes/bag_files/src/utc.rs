//! Times in ns since 1970 as text, in UTC.

/// Year, month, day, hour, minute, second and nanosecond.
fn civil(ns: u64) -> (u64, u64, u64, u64, u64, u64, u64) {
    let (seconds, nanos) = (ns / 1_000_000_000, ns % 1_000_000_000);
    let (days, second_of_day) = (seconds / 86_400, seconds % 86_400);
    // Days since 1 March of year 0, in 400-year eras of 146097 days, after Howard Hinnant's "chrono-compatible
    // low-level date algorithms".
    let shifted = days + 719_468;
    let (era, day_of_era) = (shifted / 146_097, shifted % 146_097);
    let year_of_era = (day_of_era - day_of_era / 1_460 + day_of_era / 36_524 - day_of_era / 146_096) / 365;
    let day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let shifted_month = (5 * day_of_year + 2) / 153;
    let day = day_of_year - (153 * shifted_month + 2) / 5 + 1;
    let month = if shifted_month < 10 { shifted_month + 3 } else { shifted_month - 9 };
    let year = year_of_era + era * 400 + u64::from(month <= 2);
    (year, month, day, second_of_day / 3_600, second_of_day / 60 % 60, second_of_day % 60, nanos)
}

/// For file names, to the second: `20260131T235959Z`.
pub fn utc_stamp(ns: u64) -> String {
    let (year, month, day, hour, minute, second, _) = civil(ns);
    format!("{year:04}{month:02}{day:02}T{hour:02}{minute:02}{second:02}Z")
}

/// For people, to the millisecond: `2026-01-31 23:59:59.999 UTC`.
pub fn utc_text(ns: u64) -> String {
    let (year, month, day, hour, minute, second, nanos) = civil(ns);
    let millis = nanos / 1_000_000;
    format!("{year:04}-{month:02}-{day:02} {hour:02}:{minute:02}:{second:02}.{millis:03} UTC")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_times() {
        assert_eq!(utc_stamp(0), "19700101T000000Z");
        assert_eq!(utc_stamp(951_782_400_000_000_000), "20000229T000000Z");
        assert_eq!(utc_stamp(1_709_251_199_000_000_000), "20240229T235959Z");
        assert_eq!(utc_text(1_700_000_000_123_456_789), "2023-11-14 22:13:20.123 UTC");
    }
}
