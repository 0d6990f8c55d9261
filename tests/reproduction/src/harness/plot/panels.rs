//! Charts over named places on the x axis: points with error bars, joined by lines.

use super::{Area, Drawn, INK, style};
use plotters::chart::ChartBuilder;
use plotters::element::{Circle, Cross, PathElement, TriangleMarker};
use plotters::series::{DashedLineSeries, LineSeries};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, RGBColor, ShapeStyle};

/// Colours that also differ for the colour-blind (Okabe and Ito).
const COLOURS: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(86, 180, 233),
    RGBColor(160, 120, 0),
    RGBColor(90, 90, 90),
];
/// Opacity of thin lines.
const PALE: f64 = 0.55;
/// Height of a line of the legend, pixels.
const LEGEND_LINE: i32 = 20;
/// Width of an entry of the legend, pixels.
const LEGEND_ENTRY: i32 = 235;
/// Rightwards shift from one series to the next, so that error bars stay apart, in places of the x axis.
const DODGE: f64 = 0.05;

/// Whose numbers a series shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Style {
    /// The dissertation's or its author's: crosses without a line.
    Printed,
    /// Ours as published: triangles on a thin line.
    Published,
    /// Ours at its best: circles, solid.
    Best,
}

/// One series.
#[derive(Debug, Clone)]
pub struct Series {
    /// For the legend; series of several panels that have it in common share an entry.
    pub label: String,
    /// Number of a colour.
    pub colour: usize,
    /// Whose.
    pub style: Style,
    /// (place on the x axis, value, standard error).
    pub points: Vec<(usize, f64, f64)>,
}

/// One chart.
#[derive(Debug, Clone)]
pub struct Panel {
    /// What is on the x axis.
    pub x: String,
    /// What is on the y axis, with its unit.
    pub y: String,
    /// Names of the places on the x axis.
    pub places: Vec<String>,
    /// Least and largest value of the y axis, before the data widen it.
    pub range: [f64; 2],
    /// Whether the y axis is logarithmic; values of 0 and below are then left out.
    pub logarithmic: bool,
    /// A level to draw as a dotted line, and what it is.
    pub levels: Vec<f64>,
    /// What is drawn.
    pub series: Vec<Series>,
}

pub(super) fn draw(area: &Area, panels: &[Panel]) -> Drawn {
    let mut entries: Vec<&Series> = Vec::new();
    for series in panels.iter().flat_map(|panel| &panel.series) {
        if !entries.iter().any(|entry| entry.label == series.label) {
            entries.push(series);
        }
    }
    let (width, height) = area.dim_in_pixel();
    let columns = ((width as i32 - 20) / LEGEND_ENTRY).max(1);
    let lines = (entries.len() as i32 + columns - 1) / columns;
    let (charts, legend) = area.split_vertically(height as i32 - lines * LEGEND_LINE - 8);
    for (panel, area) in panels.iter().zip(charts.split_evenly((1, panels.len()))) {
        panel.draw(&area)?;
    }
    for (i, entry) in entries.iter().enumerate() {
        // Column by column, so that what belongs together stands together.
        let (column, line) = (i as i32 / lines, i as i32 % lines);
        let (x, y) = (20 + column * LEGEND_ENTRY, 10 + line * LEGEND_LINE);
        let colour = COLOURS[entry.colour % COLOURS.len()];
        match entry.style {
            Style::Printed => {}
            Style::Published => {
                legend.draw(&PathElement::new([(x, y), (x + 26, y)], colour.mix(PALE).stroke_width(1)))?;
            }
            Style::Best => legend.draw(&PathElement::new([(x, y), (x + 26, y)], colour.stroke_width(2)))?,
        }
        match entry.style {
            Style::Printed => legend.draw(&Cross::new((x + 13, y), 4, colour.stroke_width(2)))?,
            Style::Published => legend.draw(&TriangleMarker::new((x + 13, y), 5, colour.filled()))?,
            Style::Best => legend.draw(&Circle::new((x + 13, y), 3, colour.filled()))?,
        }
        legend.draw_text(&entry.label, &style(13), (x + 34, y - 6))?;
    }
    Ok(())
}

impl Panel {
    fn draw(&self, area: &Area) -> Drawn {
        let scale = |y: f64| if self.logarithmic { libm::log10(y) } else { y };
        let shown = |y: f64| y.is_finite() && (!self.logarithmic || y > 0.0);
        let points = || self.series.iter().flat_map(|series| &series.points).filter(|point| shown(point.1));
        let ends = |point: &(usize, f64, f64)| {
            let error = if point.2.is_finite() { point.2 } else { 0.0 };
            let low = point.1 - error;
            [if shown(low) { low } else { point.1 }, point.1 + error]
        };
        let low = points().map(|point| ends(point)[0]).fold(self.range[0], f64::min);
        let high = points().map(|point| ends(point)[1]).fold(self.range[1], f64::max);
        let (low, high) = (scale(low), scale(high));
        let margin = 0.04 * (high - low).max(1e-9);
        let last = self.places.len() as f64 - 1.0;
        let mut chart = ChartBuilder::on(area)
            .margin(10)
            .x_label_area_size(40)
            .y_label_area_size(62)
            .build_cartesian_2d(-0.4..last + 0.4, low - margin..high + margin)?;
        let name = |x: &f64| {
            let place = x.round();
            let is_place = (x - place).abs() < 1e-6 && place >= 0.0;
            if is_place { self.places.get(place as usize).cloned().unwrap_or_default() } else { String::new() }
        };
        chart
            .configure_mesh()
            .disable_x_mesh()
            .light_line_style(INK.mix(0.0))
            .bold_line_style(INK.mix(0.12))
            .x_labels(self.places.len().max(2) + 1)
            .x_label_formatter(&name)
            .y_labels(if self.logarithmic { 0 } else { 8 })
            .y_label_formatter(&|y| number(*y))
            .label_style(style(13))
            .axis_desc_style(style(14))
            .x_desc(self.x.as_str())
            .y_desc(self.y.as_str())
            .draw()?;
        if self.logarithmic {
            for decade in libm::floor(low - margin) as i32..=libm::ceil(high + margin) as i32 {
                for first in [1.0, 3.0] {
                    let value = first * libm::pow(10.0, f64::from(decade));
                    let y = libm::log10(value);
                    if y < low - margin || y > high + margin {
                        continue;
                    }
                    chart
                        .draw_series([PathElement::new([(-0.4, y), (last + 0.4, y)], INK.mix(0.12).stroke_width(1))])?;
                    let (left, top) = area.get_base_pixel();
                    let (x, y) = chart.backend_coord(&(-0.4, y));
                    let text = style(13).pos(Pos::new(HPos::Right, VPos::Center));
                    area.draw_text(&number(value), &text, (x - left - 6, y - top))?;
                }
            }
        }
        for &level in &self.levels {
            let ends = [(-0.4, scale(level)), (last + 0.4, scale(level))];
            chart.draw_series(DashedLineSeries::new(ends, 2, 4, INK.mix(0.7).stroke_width(1)))?;
        }
        for (i, series) in self.series.iter().enumerate() {
            let shift = DODGE * (i as f64 - (self.series.len() as f64 - 1.0) / 2.0);
            let colour = COLOURS[series.colour % COLOURS.len()];
            let line = ShapeStyle { color: colour.to_rgba(), filled: false, stroke_width: 2 };
            let points: Vec<_> = series.points.iter().filter(|point| shown(point.1)).collect();
            let place = |point: &&(usize, f64, f64)| (point.0 as f64 + shift, scale(point.1));
            let bars = points.iter().filter(|point| point.2.is_finite() && point.2 > 0.0).map(|point| {
                let (x, [low, high]) = (point.0 as f64 + shift, ends(point));
                PathElement::new([(x, scale(low)), (x, scale(high))], colour.stroke_width(1))
            });
            chart.draw_series(bars)?;
            let places: Vec<(f64, f64)> = points.iter().map(place).collect();
            match series.style {
                Style::Printed => {
                    chart.draw_series(places.iter().map(|&at| Cross::new(at, 4, line)))?;
                }
                Style::Published => {
                    let pale = ShapeStyle { color: colour.mix(PALE), stroke_width: 1, ..line };
                    chart.draw_series(LineSeries::new(places.iter().copied(), pale))?;
                    chart.draw_series(places.iter().map(|&at| TriangleMarker::new(at, 5, colour.filled())))?;
                }
                Style::Best => {
                    chart.draw_series(LineSeries::new(places.iter().copied(), line))?;
                    chart.draw_series(places.iter().map(|&at| Circle::new(at, 3, colour.filled())))?;
                }
            }
        }
        Ok(())
    }
}

/// With as many digits as an axis needs.
fn number(y: f64) -> String {
    let text = if y.abs() >= 100.0 { format!("{y:.0}") } else { format!("{y:.4}") };
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}
