//! Pictures as SVG.

mod grids;
mod panels;

pub use grids::{Cell, Grid};
pub use panels::{Panel, Series, Style};

use super::ReproductionError;
use plotters::backend::SVGBackend;
use plotters::coord::Shift;
use plotters::drawing::{DrawingArea, IntoDrawingArea};
use plotters::style::{IntoFont, RGBColor, TextStyle, WHITE};
use std::error::Error;
use std::path::Path;

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Drawn = Result<(), Box<dyn Error>>;

const INK: RGBColor = RGBColor(40, 40, 40);

/// A picture.
#[derive(Debug, Clone)]
pub struct Picture {
    /// Its heading.
    pub title: String,
    /// What is in it.
    pub content: Content,
}

/// What is in a picture.
#[derive(Debug, Clone)]
pub enum Content {
    /// Charts side by side with one legend.
    Panels(Vec<Panel>),
    /// Grids of cells with arrows, side by side.
    Grids(Vec<Grid>),
    /// The text of a whole SVG file, which `picture` has drawn.
    Drawn(String),
}

impl Picture {
    /// Writes it as an SVG file.
    pub fn write(&self, path: &Path) -> Result<(), ReproductionError> {
        let fail = |message: String| ReproductionError::File { path: path.display().to_string(), message };
        let size = match &self.content {
            Content::Drawn(svg) => return std::fs::write(path, svg).map_err(|error| fail(error.to_string())),
            Content::Panels(panels) => (if panels.len() == 1 { 640 } else { 1000 }, 470),
            Content::Grids(grids) => (290 * grids.len() as u32 + 20, 400),
        };
        let area = SVGBackend::new(path, size).into_drawing_area();
        self.draw(&area).and_then(|()| Ok(area.present()?)).map_err(|error| fail(error.to_string()))
    }

    fn draw(&self, area: &Area) -> Drawn {
        area.fill(&WHITE)?;
        let (head, body) = area.split_vertically(40);
        head.draw_text(&self.title, &style(18), (16, 12))?;
        match &self.content {
            Content::Panels(panels) => panels::draw(&body, panels),
            Content::Grids(grids) => grids::draw(&body, grids),
            Content::Drawn(_) => Ok(()),
        }
    }
}

fn style<'a>(size: i32) -> TextStyle<'a> {
    TextStyle::from(("sans-serif", size).into_font()).color(&INK)
}
