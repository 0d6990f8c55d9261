//! Line charts side by side, with one legend.

use plotters::backend::SVGBackend;
use plotters::chart::ChartBuilder;
use plotters::coord::Shift;
use plotters::drawing::{DrawingArea, IntoDrawingArea};
use plotters::element::{Circle, Cross, PathElement};
use plotters::series::{DashedLineSeries, LineSeries};
use plotters::style::{Color, IntoFont, RGBColor, TextStyle, WHITE};

use crate::colour::{Colour, INK, of_line};
use crate::error::PictureError;
use crate::ticks::{number, widened};

/// Size of one chart, pixels.
const CHART: (u32, u32) = (520, 400);
const TITLE: u32 = 40;
/// Height of a line of the legend, width of an entry without its label, and about that of a letter, pixels.
const LEGEND_LINE: i32 = 20;
const LEGEND_SIGN: i32 = 56;
const LETTER: i32 = 7;

/// How the points of a line are joined.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stroke {
    /// By a line, with a dot at each.
    Dotted,
    /// By a line.
    Solid,
    /// By a dashed line.
    Dashed,
    /// Not at all: each has a cross.
    Crosses,
}

/// One line.
#[derive(Debug, Clone, PartialEq)]
pub struct Line {
    /// For the legend; lines of several charts that have it in common share an entry.
    pub label: String,
    /// Number of a colour.
    pub colour: usize,
    /// How points are joined.
    pub stroke: Stroke,
    /// (x, y) in the order in which they are joined.
    pub points: Vec<(f64, f64)>,
}

/// A word at a point.
#[derive(Debug, Clone, PartialEq)]
pub struct Mark {
    /// The word.
    pub text: String,
    /// The point.
    pub at: (f64, f64),
}

/// One chart.
#[derive(Debug, Clone, PartialEq)]
pub struct Chart {
    /// What is on the x axis, with its unit.
    pub x: String,
    /// What is on the y axis, with its unit.
    pub y: String,
    /// What is drawn.
    pub lines: Vec<Line>,
    /// Words beside points.
    pub marks: Vec<Mark>,
}

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Drawn = Result<(), Box<dyn std::error::Error>>;

/// One picture of charts side by side.
///
/// # Errors
/// No chart, or one without points; points that are not finite.
pub fn charts(title: &str, charts: &[Chart]) -> Result<String, PictureError> {
    if charts.is_empty() {
        return Err(PictureError::Empty { what: "chart" });
    }
    for chart in charts {
        if chart.lines.iter().all(|line| line.points.is_empty()) {
            return Err(PictureError::Empty { what: "point" });
        }
        for line in &chart.lines {
            for (index, &(x, y)) in line.points.iter().enumerate() {
                for (what, got) in [("x", x), ("y", y)] {
                    if !got.is_finite() {
                        let (label, got) = (line.label.clone(), got.to_string());
                        return Err(PictureError::NotFinite { what, index, label, got });
                    }
                }
            }
        }
    }
    let mut entries: Vec<&Line> = vec![];
    for line in charts.iter().flat_map(|chart| &chart.lines) {
        if !entries.iter().any(|entry| entry.label == line.label) {
            entries.push(line);
        }
    }
    let width = CHART.0 * charts.len() as u32 + 20;
    let longest = entries.iter().map(|entry| entry.label.chars().count() as i32).max().unwrap_or(0);
    let entry_width = LEGEND_SIGN + LETTER * longest;
    let columns = ((width as i32 - 20) / entry_width).max(1);
    let lines = (entries.len() as i32 + columns - 1) / columns;
    let size = (width, TITLE + CHART.1 + (lines * LEGEND_LINE) as u32 + 12);
    let mut svg = String::new();
    let mut drawn = || -> Drawn {
        let area = SVGBackend::with_string(&mut svg, size).into_drawing_area();
        area.fill(&WHITE)?;
        let (head, body) = area.split_vertically(TITLE);
        head.draw_text(title, &style(18), (16, 12))?;
        let (all, legend) = body.split_vertically(CHART.1);
        for (chart, area) in charts.iter().zip(all.split_evenly((1, charts.len()))) {
            chart.draw(&area)?;
        }
        for (index, entry) in entries.iter().enumerate() {
            let (column, line) = (index as i32 / lines.max(1), index as i32 % lines.max(1));
            draw_entry(&legend, entry, (24 + column * entry_width, 10 + line * LEGEND_LINE))?;
        }
        area.present()?;
        Ok(())
    };
    drawn().map_err(|error| PictureError::Drawing(error.to_string()))?;
    Ok(svg)
}

fn draw_entry(legend: &Area, entry: &Line, (x, y): (i32, i32)) -> Drawn {
    let colour = rgb(of_line(entry.colour));
    match entry.stroke {
        Stroke::Dotted | Stroke::Solid => {
            legend.draw(&PathElement::new([(x, y), (x + 26, y)], colour.stroke_width(2)))?;
        }
        Stroke::Dashed => {
            for start in [0, 10, 20] {
                legend.draw(&PathElement::new([(x + start, y), (x + start + 6, y)], colour.stroke_width(2)))?;
            }
        }
        Stroke::Crosses => {}
    }
    match entry.stroke {
        Stroke::Dotted => legend.draw(&Circle::new((x + 13, y), 3, colour.filled()))?,
        Stroke::Crosses => legend.draw(&Cross::new((x + 13, y), 5, colour.stroke_width(2)))?,
        Stroke::Solid | Stroke::Dashed => {}
    }
    legend.draw_text(&entry.label, &style(13), (x + 34, y - 6))?;
    Ok(())
}

impl Chart {
    fn draw(&self, area: &Area) -> Drawn {
        let points = || self.lines.iter().flat_map(|line| &line.points);
        let range = |of: fn(&(f64, f64)) -> f64| {
            let low = points().map(of).fold(f64::INFINITY, f64::min);
            widened(low, points().map(of).fold(f64::NEG_INFINITY, f64::max))
        };
        let ([left, right], [bottom, top]) = (range(|point| point.0), range(|point| point.1));
        let mut chart = ChartBuilder::on(area)
            .margin(10)
            .margin_right(18)
            .x_label_area_size(44)
            .y_label_area_size(70)
            .build_cartesian_2d(left..right, bottom..top)?;
        chart
            .configure_mesh()
            .light_line_style(rgb(INK).mix(0.0))
            .bold_line_style(rgb(INK).mix(0.12))
            .x_labels(7)
            .y_labels(8)
            .x_label_formatter(&|x| number(*x, right - left))
            .y_label_formatter(&|y| number(*y, top - bottom))
            .label_style(style(13))
            .axis_desc_style(style(14))
            .x_desc(self.x.as_str())
            .y_desc(self.y.as_str())
            .draw()?;
        for line in &self.lines {
            let colour = rgb(of_line(line.colour));
            let points = line.points.iter().copied();
            match line.stroke {
                Stroke::Dotted => {
                    chart.draw_series(LineSeries::new(points.clone(), colour.stroke_width(2)))?;
                    chart.draw_series(points.map(|at| Circle::new(at, 3, colour.filled())))?;
                }
                Stroke::Solid => {
                    chart.draw_series(LineSeries::new(points, colour.stroke_width(2)))?;
                }
                Stroke::Dashed => {
                    chart.draw_series(DashedLineSeries::new(points, 6, 4, colour.stroke_width(2)))?;
                }
                Stroke::Crosses => {
                    chart.draw_series(points.map(|at| Cross::new(at, 5, colour.stroke_width(2))))?;
                }
            }
        }
        // On the side where there is room.
        let (base_x, base_y) = area.get_base_pixel();
        for mark in &self.marks {
            let (x, y) = chart.backend_coord(&mark.at);
            let width = 8 * mark.text.chars().count() as i32;
            let (x, y) = (x - base_x, y - base_y);
            let x = if x + width + 8 > CHART.0 as i32 - 10 { x - width - 8 } else { x + 8 };
            area.draw_text(&mark.text, &style(13), (x, (y - 18).max(4)))?;
        }
        Ok(())
    }
}

fn style<'a>(size: i32) -> TextStyle<'a> {
    const COLOUR: RGBColor = RGBColor(INK.0, INK.1, INK.2);
    TextStyle::from(("sans-serif", size).into_font()).color(&COLOUR)
}

fn rgb((red, green, blue): Colour) -> RGBColor {
    RGBColor(red, green, blue)
}

#[cfg(test)]
mod tests {
    use super::{Chart, Line, Mark, Stroke, charts};
    use crate::PictureError;

    fn chart(points: Vec<(f64, f64)>) -> Chart {
        let line = Line { label: "<frontier>".into(), colour: 0, stroke: Stroke::Dotted, points };
        let marks = vec![Mark { text: "λ = 0".into(), at: (0.0, 1.0) }];
        Chart { x: "CVaR".into(), y: "mean".into(), lines: vec![line], marks }
    }

    #[test]
    fn a_chart_holds_its_points_words_and_one_legend() {
        let one = chart(vec![(0.0, 1.0), (1.0, 0.5), (2.0, 0.0)]);
        let svg = charts("both", &[one.clone(), one]).expect("a chart");
        // Three dots in each chart and one in the legend.
        assert_eq!(svg.matches("<circle").count(), 7);
        assert_eq!(svg.matches("λ = 0").count(), 2);
        assert_eq!(svg.matches("&lt;frontier&gt;").count(), 1);
        for axis in ["CVaR", "mean"] {
            assert_eq!(svg.matches(axis).count(), 2, "{axis}");
        }
        assert!(svg.trim_end().ends_with("</svg>"));
    }

    #[test]
    fn a_single_point_is_a_chart_and_none_is_not() {
        assert!(charts("", &[chart(vec![(3.0, 3.0)])]).is_ok());
        assert_eq!(charts("", &[]), Err(PictureError::Empty { what: "chart" }));
        assert_eq!(charts("", &[chart(vec![])]), Err(PictureError::Empty { what: "point" }));
        let bad = charts("", &[chart(vec![(0.0, 0.0), (1.0, f64::NAN)])]);
        assert!(matches!(bad, Err(PictureError::NotFinite { what: "y", index: 1, .. })));
    }
}
