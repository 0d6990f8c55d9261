//! Colours that also differ for the colour-blind.

/// Red, green, blue.
pub(crate) type Colour = (u8, u8, u8);

/// Of lines and marks (Okabe and Ito).
const LINES: [Colour; 7] =
    [(0, 114, 178), (213, 94, 0), (0, 158, 115), (204, 121, 167), (86, 180, 233), (160, 120, 0), (90, 90, 90)];
/// Of cells, pale enough for dark arrows; the first is that of nothing.
const CELLS: [Colour; 8] = [
    (255, 255, 255),
    (246, 238, 214),
    (240, 158, 146),
    (168, 205, 235),
    (186, 221, 170),
    (214, 187, 228),
    (200, 200, 200),
    (170, 222, 214),
];
/// Of a cell shaded fully.
const DEEPEST: Colour = (66, 146, 198);

/// Of text, axes and arrows.
pub(crate) const INK: Colour = (40, 40, 40);

/// Of line `index`.
pub(crate) fn of_line(index: usize) -> Colour {
    LINES[index % LINES.len()]
}

/// Of a cell of kind `index`.
pub(crate) fn of_kind(index: usize) -> Colour {
    CELLS[index % CELLS.len()]
}

/// From white at 0 to a full shade at 1.
pub(crate) fn of_amount(amount: f64) -> Colour {
    let amount = if amount.is_nan() { 0.0 } else { amount.clamp(0.0, 1.0) };
    let mix = |full: u8| (255.0 - amount * (255.0 - f64::from(full))).round() as u8;
    (mix(DEEPEST.0), mix(DEEPEST.1), mix(DEEPEST.2))
}

/// `#rrggbb`.
pub(crate) fn hex((red, green, blue): Colour) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}

#[cfg(test)]
mod tests {
    use super::{hex, of_amount};

    #[test]
    fn shades_go_from_white_to_full() {
        assert_eq!([of_amount(-1.0), of_amount(0.0), of_amount(f64::NAN)].map(hex), ["#ffffff"; 3].map(str::to_owned));
        assert_eq!(hex(of_amount(1.0)), "#4292c6");
        assert_eq!(of_amount(7.0), of_amount(1.0));
        assert!(of_amount(0.5).0 > of_amount(0.6).0);
    }
}
