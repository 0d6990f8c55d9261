//! Policies on grids of cells: a stochastic one has several arrows in a cell, with areas as probabilities.

use std::fmt::Write;

use crate::arrow::{Direction, arrows};
use crate::colour::{INK, hex, of_amount, of_kind};
use crate::error::PictureError;

/// Most cells of a grid.
pub const MAX_CELLS: usize = 10_000;
/// Width that a grid may take, pixels, and the bounds of the side of a cell.
const GRID_WIDTH: f64 = 320.0;
const SIDES: [f64; 2] = [10.0, 58.0];
/// Grids side by side.
const ABREAST: usize = 4;
/// Space around grids and above each for its caption, pixels.
const MARGIN: f64 = 18.0;
const CAPTION: f64 = 44.0;
const TITLE: f64 = 40.0;
const LEGEND: f64 = 30.0;

/// Colour of a cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shade {
    /// From white at 0 to a full shade at 1.
    Amount(f64),
    /// One of some kinds, 0 is white.
    Kind(usize),
}

/// One cell.
#[derive(Debug, Clone, PartialEq)]
pub struct Cell {
    /// Its colour.
    pub shade: Shade,
    /// Whether it ends there.
    pub terminal: bool,
    /// Whether it starts there; worth showing where it is no matter of course.
    pub start: bool,
    /// Whether the policy ever comes there.
    pub visited: bool,
    /// (direction, probability) of each action.
    pub arrows: Vec<(Direction, f64)>,
    /// What is told of it on hovering.
    pub about: String,
}

/// A policy on a grid.
#[derive(Debug, Clone, PartialEq)]
pub struct GridPicture {
    /// Which.
    pub caption: String,
    /// What is to be known of it, one short line.
    pub detail: String,
    /// Cells of a row.
    pub columns: usize,
    /// Cells row by row.
    pub cells: Vec<Cell>,
}

/// One picture of grids side by side, with `legend`: what each shade means.
///
/// # Errors
/// No grid or one without cells; cells that do not fill whole rows; more than [`MAX_CELLS`].
pub fn policy_grids(title: &str, grids: &[GridPicture], legend: &[(Shade, String)]) -> Result<String, PictureError> {
    if grids.is_empty() {
        return Err(PictureError::Empty { what: "grid" });
    }
    for grid in grids {
        let (cells, columns) = (grid.cells.len(), grid.columns);
        if cells == 0 || columns == 0 {
            return Err(PictureError::Empty { what: "cell" });
        }
        if !cells.is_multiple_of(columns) {
            return Err(PictureError::Ragged { cells, columns });
        }
        if cells > MAX_CELLS {
            return Err(PictureError::TooLarge { got: cells, most: MAX_CELLS });
        }
    }
    let widest = grids.iter().map(|grid| grid.side() * grid.columns as f64).fold(250.0, f64::max);
    let tallest = grids.iter().map(|grid| grid.side() * grid.rows() as f64).fold(0.0, f64::max);
    let abreast = grids.len().min(ABREAST);
    let lines = grids.len().div_ceil(abreast);
    let (panel_width, panel_height) = (widest + MARGIN, tallest + CAPTION + MARGIN);
    let width = (panel_width * abreast as f64 + MARGIN).max(420.0);
    let height = TITLE + panel_height * lines as f64 + LEGEND;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width:.0}\" height=\"{height:.0}\" viewBox=\"0 0 {width:.0} {height:.0}\" \
         font-family=\"sans-serif\" fill=\"{ink}\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n\
         <text x=\"{MARGIN}\" y=\"26\" font-size=\"18\">{}</text>\n",
        escaped(title),
        ink = hex(INK),
    );
    for (index, grid) in grids.iter().enumerate() {
        let x = MARGIN + panel_width * (index % abreast) as f64;
        let y = TITLE + panel_height * (index / abreast) as f64;
        grid.draw(x, y, &mut svg);
    }
    draw_legend(legend, height - LEGEND + 6.0, &mut svg);
    svg += "</svg>\n";
    Ok(svg)
}

fn draw_legend(legend: &[(Shade, String)], y: f64, svg: &mut String) {
    let mut x = MARGIN;
    for (shade, label) in legend {
        let _ = writeln!(
            svg,
            "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"14\" height=\"14\" fill=\"{}\" stroke=\"{}\" stroke-width=\"0.7\"/>\
             <text x=\"{:.1}\" y=\"{:.1}\" font-size=\"13\">{}</text>",
            fill(*shade),
            hex(INK),
            x + 20.0,
            y + 12.0,
            escaped(label)
        );
        // About as wide as the text gets.
        x += 40.0 + 7.2 * label.chars().count() as f64;
    }
}

impl GridPicture {
    fn rows(&self) -> usize {
        self.cells.len() / self.columns
    }

    fn side(&self) -> f64 {
        (GRID_WIDTH / self.columns.max(self.rows()) as f64).clamp(SIDES[0], SIDES[1])
    }

    fn draw(&self, x: f64, y: f64, svg: &mut String) {
        let side = self.side();
        // Writing to a text never fails.
        let _ = writeln!(
            svg,
            "<text x=\"{x:.1}\" y=\"{:.1}\" font-size=\"14\">{}</text><text x=\"{x:.1}\" y=\"{:.1}\" font-size=\"12\" \
             fill=\"#666\">{}</text>",
            y + 14.0,
            escaped(&self.caption),
            y + 32.0,
            escaped(&self.detail)
        );
        let all_start = self.cells.iter().all(|cell| cell.start || cell.terminal);
        for (index, cell) in self.cells.iter().enumerate() {
            let left = x + side * (index % self.columns) as f64;
            let top = y + CAPTION + side * (index / self.columns) as f64;
            let (middle, centre) = (left + side / 2.0, top + side / 2.0);
            let _ = write!(
                svg,
                "<g><title>{}</title><rect x=\"{left:.1}\" y=\"{top:.1}\" width=\"{side:.1}\" height=\"{side:.1}\" fill=\"{}\" \
                 stroke=\"{}\" stroke-width=\"0.7\"/>",
                escaped(&cell.about),
                fill(cell.shade),
                hex(INK)
            );
            if cell.start && !all_start {
                let radius = 0.46 * side;
                let _ = write!(
                    svg,
                    "<circle cx=\"{middle:.1}\" cy=\"{centre:.1}\" r=\"{radius:.1}\" fill=\"none\" stroke=\"{}\"/>",
                    hex(INK)
                );
            }
            if cell.terminal {
                let size = (0.28 * side).max(5.0);
                let _ = write!(
                    svg,
                    "<text x=\"{middle:.1}\" y=\"{:.1}\" font-size=\"{size:.1}\" text-anchor=\"middle\">end</text>",
                    centre + 0.35 * size
                );
            } else {
                let opacity = if cell.visited { "1" } else { "0.3" };
                let drawn = arrows(middle, centre, side, &cell.arrows);
                let _ = write!(svg, "<g opacity=\"{opacity}\">{drawn}</g>");
            }
            svg.push_str("</g>\n");
        }
    }
}

fn fill(shade: Shade) -> String {
    match shade {
        Shade::Amount(amount) => hex(of_amount(amount)),
        Shade::Kind(kind) => hex(of_kind(kind)),
    }
}

/// As text between tags; what XML cannot hold is left out.
fn escaped(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => safe += "&amp;",
            '<' => safe += "&lt;",
            '>' => safe += "&gt;",
            '"' => safe += "&quot;",
            '\t' | '\n' | '\r' => safe.push(' '),
            c if c.is_control() || c == '\u{fffe}' || c == '\u{ffff}' => {}
            c => safe.push(c),
        }
    }
    safe
}

#[cfg(test)]
mod tests {
    use super::{Cell, GridPicture, Shade, policy_grids};
    use crate::{Direction, PictureError};
    use proptest::prelude::{prop_assert, proptest};

    fn cell(share: f64, about: &str) -> Cell {
        Cell {
            shade: Shade::Amount(share),
            terminal: false,
            start: false,
            visited: true,
            arrows: vec![(Direction::Up, share), (Direction::Left, 1.0 - share)],
            about: about.to_owned(),
        }
    }

    fn grid(columns: usize, cells: Vec<Cell>) -> GridPicture {
        GridPicture { caption: "a & b".into(), detail: "λ < 1".into(), columns, cells }
    }

    /// Names of the elements; fails where the text is no XML.
    fn elements(svg: &str) -> Vec<String> {
        let mut reader = quick_xml::Reader::from_str(svg);
        reader.config_mut().check_end_names = true;
        let mut names = vec![];
        loop {
            match reader.read_event().expect("well-formed XML") {
                quick_xml::events::Event::Start(tag) | quick_xml::events::Event::Empty(tag) => {
                    names.push(String::from_utf8_lossy(tag.name().as_ref()).into_owned());
                }
                quick_xml::events::Event::Eof => return names,
                _ => {}
            }
        }
    }

    #[test]
    fn every_action_that_is_taken_has_an_arrow() {
        let mut cells = vec![cell(1.0, "sure"), cell(0.5, "either"), cell(0.0, "sure"), cell(0.3, "either")];
        cells[3].terminal = true;
        cells[0].start = true;
        let svg = policy_grids("title", &[grid(2, cells)], &[(Shade::Kind(1), "red <cells>".into())]).expect("a grid");
        let names = elements(&svg);
        let count = |name: &str| names.iter().filter(|found| *found == name).count();
        // One, two, one and none; one start; no cell but the terminal one says that it ends.
        assert_eq!((count("path"), count("circle"), svg.matches(">end<").count()), (4, 1, 1));
        assert!(svg.contains("a &amp; b") && svg.contains("λ &lt; 1") && svg.contains("red &lt;cells&gt;"));
    }

    #[test]
    fn what_cannot_be_seen_is_refused() {
        assert_eq!(policy_grids("", &[], &[]), Err(PictureError::Empty { what: "grid" }));
        assert_eq!(policy_grids("", &[grid(1, vec![])], &[]), Err(PictureError::Empty { what: "cell" }));
        let three = grid(2, vec![cell(1.0, ""); 3]);
        assert_eq!(policy_grids("", &[three], &[]), Err(PictureError::Ragged { cells: 3, columns: 2 }));
        let many = grid(1, vec![cell(1.0, ""); 10_001]);
        assert!(matches!(policy_grids("", &[many], &[]), Err(PictureError::TooLarge { got: 10_001, .. })));
    }

    proptest! {
        #[test]
        fn any_names_give_well_formed_xml(title: String, about: String, share: f64, columns in 1..5_usize, kind: usize) {
            let mut cells = vec![cell(share, &about); 2 * columns];
            cells[0].shade = Shade::Kind(kind);
            let svg = policy_grids(&title, &[grid(columns, cells)], &[(Shade::Amount(share), about)]).expect("a grid");
            prop_assert!(!elements(&svg).is_empty());
        }
    }
}
