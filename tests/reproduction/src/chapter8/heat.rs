//! Scores of the cells of a grid as heat maps, in SVG.

/// Side of a cell, pixels.
const CELL: usize = 44;
/// Space around a map, pixels.
const MARGIN: usize = 20;
/// Height of its caption, pixels.
const CAPTION: usize = 26;
/// Fill of the rim of cells by colour: white, yellow, green, blue.
const RIMS: [&str; 4] = ["#ffffff", "#f2d03b", "#4caf50", "#3f6fd8"];

/// Maps side by side: caption, score of every cell (none: not asked about) and the cell that was asked about, marked with a ring.
/// Scores run from white at 0 to dark at the largest; `colours` are the rims.
pub fn heat_maps(maps: &[(String, Vec<Option<f64>>, usize)], colours: &[usize], columns: usize) -> String {
    let rows = colours.len() / columns;
    let (wide, high) = (columns * CELL + MARGIN, rows * CELL + CAPTION + 2 * MARGIN);
    let width = maps.len() * wide + MARGIN;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{high}\" font-family=\"sans-serif\" font-size=\"14\">\n\
         <rect width=\"{width}\" height=\"{high}\" fill=\"white\"/>\n"
    );
    for (i, (caption, scores, asked)) in maps.iter().enumerate() {
        let left = MARGIN + i * wide;
        let most = scores.iter().flatten().copied().fold(0.0_f64, f64::max);
        svg += &format!("<text x=\"{left}\" y=\"{}\">{caption}</text>\n", MARGIN + 4);
        for (cell, (score, colour)) in scores.iter().zip(colours).enumerate() {
            let (x, y) = (left + cell % columns * CELL, MARGIN + CAPTION + cell / columns * CELL);
            let rim = RIMS[colour % RIMS.len()];
            svg += &format!(
                "<rect x=\"{x}\" y=\"{y}\" width=\"{CELL}\" height=\"{CELL}\" fill=\"{rim}\" stroke=\"#282828\"/>\n"
            );
            if let Some(score) = score {
                let share = if most > 0.0 { (score / most).clamp(0.0, 1.0) } else { 0.0 };
                let tone = |light: f64, dark: f64| (light + share * (dark - light)).round();
                let fill = format!("rgb({},{},{})", tone(255.0, 140.0), tone(255.0, 20.0), tone(255.0, 20.0));
                let (x, y, side) = (x + 5, y + 5, CELL - 10);
                svg += &format!("<rect x=\"{x}\" y=\"{y}\" width=\"{side}\" height=\"{side}\" fill=\"{fill}\"/>\n");
            }
            if cell == *asked {
                let (x, y) = (x + CELL / 2, y + CELL / 2);
                svg += &format!(
                    "<circle cx=\"{x}\" cy=\"{y}\" r=\"12\" fill=\"none\" stroke=\"#000000\" stroke-width=\"3\"/>\n"
                );
            }
        }
    }
    svg + "</svg>\n"
}
