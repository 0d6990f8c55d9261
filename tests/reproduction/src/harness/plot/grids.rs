//! Grids of cells with arrows: a policy as a picture.

use super::{Area, Drawn, INK, style};
use plotters::element::{Circle, PathElement, Polygon, Rectangle};
use plotters::style::{Color, RGBColor, WHITE};

const RED: RGBColor = RGBColor(233, 150, 140);
const GREY: RGBColor = RGBColor(205, 205, 205);
/// Side of a cell, pixels.
const CELL: i32 = 50;

/// One cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Cell {
    /// Whether it is red; else white.
    pub red: bool,
    /// Whether it ends there.
    pub terminal: bool,
    /// Whether it starts there.
    pub start: bool,
    /// Where the policy goes: up, down, left, right.
    pub action: usize,
    /// Whether the policy comes there at all from a start.
    pub visited: bool,
}

/// A policy on a grid.
#[derive(Debug, Clone)]
pub struct Grid {
    /// Which.
    pub caption: String,
    /// What is to be known of it.
    pub detail: String,
    /// Cells of a row.
    pub columns: usize,
    /// Cells row by row.
    pub cells: Vec<Cell>,
}

pub(super) fn draw(area: &Area, grids: &[Grid]) -> Drawn {
    for (grid, area) in grids.iter().zip(area.split_evenly((1, grids.len()))) {
        grid.draw(&area)?;
    }
    Ok(())
}

impl Grid {
    fn draw(&self, area: &Area) -> Drawn {
        area.draw_text(&self.caption, &style(15), (16, 6))?;
        area.draw_text(&self.detail, &style(13), (16, 28))?;
        for (i, cell) in self.cells.iter().enumerate() {
            let (x, y) = (16 + (i % self.columns) as i32 * CELL, 54 + (i / self.columns) as i32 * CELL);
            let colour = if cell.terminal {
                GREY
            } else if cell.red {
                RED
            } else {
                WHITE
            };
            area.draw(&Rectangle::new([(x, y), (x + CELL, y + CELL)], colour.filled()))?;
            area.draw(&Rectangle::new([(x, y), (x + CELL, y + CELL)], INK.stroke_width(1)))?;
            let centre = (x + CELL / 2, y + CELL / 2);
            if cell.start {
                area.draw(&Circle::new(centre, 19, INK.stroke_width(2)))?;
            }
            if cell.terminal {
                area.draw_text("end", &style(14), (x + 12, y + 17))?;
            } else {
                let ink = if cell.visited { INK.mix(1.0) } else { INK.mix(0.35) };
                let (dx, dy) = [(0, -1), (0, 1), (-1, 0), (1, 0)][cell.action];
                let tip = (centre.0 + 15 * dx, centre.1 + 15 * dy);
                let tail = (centre.0 - 13 * dx, centre.1 - 13 * dy);
                let neck = (centre.0 + 6 * dx, centre.1 + 6 * dy);
                area.draw(&PathElement::new([tail, neck], ink.stroke_width(2)))?;
                let barbs = [tip, (neck.0 + 5 * dy, neck.1 + 5 * dx), (neck.0 - 5 * dy, neck.1 - 5 * dx)];
                area.draw(&Polygon::new(barbs.to_vec(), ink.filled()))?;
            }
        }
        Ok(())
    }
}
