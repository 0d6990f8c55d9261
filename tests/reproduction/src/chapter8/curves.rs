//! Losses over questions as curves.

use super::Method;
use crate::harness::Estimate;
use crate::harness::plot::{Panel, Series, Style};

/// Losses of every replicate over questions, one method.
#[derive(Debug, Clone)]
pub struct Curve {
    /// Whose.
    pub method: Method,
    /// One list a replicate, before the first question first.
    pub lessons: Vec<Vec<f64>>,
}

/// Mean and standard error after every question; lessons that have ended stay where they ended.
pub fn mean_curve(lessons: &[Vec<f64>]) -> Vec<Estimate> {
    let longest = lessons.iter().map(Vec::len).max().unwrap_or(0);
    (0..longest)
        .map(|i| Estimate::of(&lessons.iter().map(|lesson| lesson[i.min(lesson.len() - 1)]).collect::<Vec<_>>()))
        .collect()
}

/// Curves as a chart.
pub fn curve_panel(curves: &[Curve], x: &str, y: &str) -> Panel {
    let n = curves.iter().flat_map(|curve| curve.lessons.iter().map(Vec::len)).max().unwrap_or(1);
    let series = |curve: &Curve| Series {
        label: curve.method.label.into(),
        colour: curve.method.colour,
        style: Style::Best,
        points: mean_curve(&curve.lessons)
            .iter()
            .enumerate()
            .map(|(i, estimate)| (i, estimate.mean, estimate.standard_error))
            .collect(),
    };
    Panel {
        x: x.into(),
        y: y.into(),
        places: (0..n).map(|i| i.to_string()).collect(),
        range: [0.0, 0.0],
        logarithmic: false,
        levels: vec![],
        series: curves.iter().map(series).collect(),
    }
}
