//! A plain line chart as SVG.

use plotters::prelude::{
    ChartBuilder, Color, IntoDrawingArea, IntoFont, LineSeries, Palette, Palette99, PathElement, SVGBackend, WHITE,
};
use std::path::Path;

/// One line.
pub struct Line {
    /// What it shows.
    pub label: String,
    /// (x, y), ascending in x.
    pub points: Vec<(f64, f64)>,
}

/// Draws lines into a file; the y axis starts at 0.
pub fn chart(path: &Path, title: &str, x: &str, y: &str, lines: &[Line]) -> Result<(), String> {
    let all = || lines.iter().flat_map(|line| &line.points);
    let right = all().map(|p| p.0).fold(1.0, f64::max);
    let top = all().map(|p| p.1).fold(0.0, f64::max) * 1.05;
    let area = SVGBackend::new(path, (800, 480)).into_drawing_area();
    let drawn = || -> Result<(), Box<dyn std::error::Error>> {
        area.fill(&WHITE)?;
        let mut chart = ChartBuilder::on(&area)
            .caption(title, ("sans-serif", 20).into_font())
            .margin(12)
            .x_label_area_size(40)
            .y_label_area_size(52)
            .build_cartesian_2d(1.0..right.max(2.0), 0.0..top.max(1e-9))?;
        chart.configure_mesh().x_desc(x).y_desc(y).draw()?;
        for (i, line) in lines.iter().enumerate() {
            let style = Palette99::pick(i).stroke_width(2);
            chart
                .draw_series(LineSeries::new(line.points.iter().copied(), style))?
                .label(line.label.as_str())
                .legend(move |(x, y)| PathElement::new([(x, y), (x + 18, y)], style));
        }
        chart.configure_series_labels().border_style(WHITE.mix(0.8)).background_style(WHITE.mix(0.8)).draw()?;
        area.present()?;
        Ok(())
    };
    drawn().map_err(|error| error.to_string())
}
