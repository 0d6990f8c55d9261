//! Arrows whose area says how often an action is taken.

/// Where an action leads on a grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Direction {
    /// To the row above.
    Up,
    /// To the row below.
    Down,
    /// To the column before.
    Left,
    /// To the column after.
    Right,
    /// Nowhere.
    Stay,
}

impl Direction {
    /// From the name of an action, whatever its case; `None` for other names.
    pub fn of_name(name: &str) -> Option<Self> {
        match name.trim().to_ascii_lowercase().as_str() {
            "up" | "north" | "n" | "^" | "↑" => Some(Self::Up),
            "down" | "south" | "s" | "v" | "↓" => Some(Self::Down),
            "left" | "west" | "w" | "<" | "←" => Some(Self::Left),
            "right" | "east" | "e" | ">" | "→" => Some(Self::Right),
            "stay" | "wait" | "noop" | "none" | "-" => Some(Self::Stay),
            _ => None,
        }
    }

    /// Step to the right and down.
    fn step(self) -> (f64, f64) {
        match self {
            Self::Up => (0.0, -1.0),
            Self::Down => (0.0, 1.0),
            Self::Left => (-1.0, 0.0),
            Self::Right => (1.0, 0.0),
            Self::Stay => (0.0, 0.0),
        }
    }
}

/// Half width of the shaft, length up to the head, half width of the head and whole length, for a cell of side 1.
const SHAFT: f64 = 0.055;
const NECK: f64 = 0.26;
const HEAD: f64 = 0.15;
const TIP: f64 = 0.44;
/// Radius of the dot that stands for staying.
const DOT: f64 = 0.14;
/// Actions taken less often than this are not to be seen anyway.
const UNSEEN: f64 = 0.002;

/// Arrows in a cell with its centre at (x, y), each with the area of its probability as a share of that of a sure action. They leave
/// from the centre; one alone lies across it. Empty where nothing would be seen.
pub(crate) fn arrows(x: f64, y: f64, side: f64, actions: &[(Direction, f64)]) -> String {
    let mut seen = actions.iter().filter(|(_, probability)| *probability >= UNSEEN);
    let (x, y) = match (seen.next(), seen.next()) {
        (Some((direction, probability)), None) => {
            let (dx, dy) = direction.step();
            let back = 0.5 * TIP * side * libm::sqrt(probability.min(1.0));
            (x - back * dx, y - back * dy)
        }
        _ => (x, y),
    };
    actions.iter().map(|&(direction, probability)| arrow(x, y, side, direction, probability)).collect()
}

/// One arrow that leaves from (x, y).
fn arrow(x: f64, y: f64, side: f64, direction: Direction, probability: f64) -> String {
    if probability.is_nan() || probability < UNSEEN {
        return String::new();
    }
    let scale = side * libm::sqrt(probability.min(1.0));
    if direction == Direction::Stay {
        return format!("<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{:.2}\"/>", DOT * scale);
    }
    let (dx, dy) = direction.step();
    let point = |along: f64, aside: f64| {
        format!("{:.2} {:.2}", x + scale * (along * dx - aside * dy), y + scale * (along * dy + aside * dx))
    };
    let outline = [(0.0, SHAFT), (NECK, SHAFT), (NECK, HEAD), (TIP, 0.0), (NECK, -HEAD), (NECK, -SHAFT), (0.0, -SHAFT)];
    let points: Vec<String> = outline.into_iter().map(|(along, aside)| point(along, aside)).collect();
    format!("<path d=\"M{}Z\"/>", points.join("L"))
}

#[cfg(test)]
mod tests {
    use super::{Direction, arrow, arrows};

    /// Area within a path of straight lines.
    fn area(path: &str) -> f64 {
        let inner = path.trim_start_matches("<path d=\"M").trim_end_matches("Z\"/>");
        let points: Vec<(f64, f64)> = inner
            .split('L')
            .map(|point| {
                let (x, y) = point.split_once(' ').expect("two numbers");
                (x.parse().expect("a number"), y.parse().expect("a number"))
            })
            .collect();
        let n = points.len();
        let twice: f64 =
            (0..n).map(|i| points[i].0 * points[(i + 1) % n].1 - points[(i + 1) % n].0 * points[i].1).sum();
        0.5 * twice.abs()
    }

    #[test]
    fn area_is_probability() {
        let whole = area(&arrow(0.0, 0.0, 1000.0, Direction::Left, 1.0));
        for direction in [Direction::Up, Direction::Down, Direction::Left, Direction::Right] {
            for probability in [0.1, 0.25, 0.9] {
                let part = area(&arrow(0.0, 0.0, 1000.0, direction, probability));
                assert!((part / whole - probability).abs() < 1e-3, "{direction:?} {probability}");
            }
        }
        assert!(arrow(0.0, 0.0, 50.0, Direction::Up, 0.0).is_empty());
        assert!(arrow(0.0, 0.0, 50.0, Direction::Up, f64::NAN).is_empty());
        assert!(arrow(0.0, 0.0, 50.0, Direction::Stay, 0.5).starts_with("<circle"));
    }

    #[test]
    fn one_arrow_lies_across_the_centre_and_several_leave_from_it() {
        let one = arrows(0.0, 0.0, 100.0, &[(Direction::Right, 1.0), (Direction::Up, 0.0)]);
        assert_eq!(one.split('L').nth(3), Some("22.00 0.00"));
        let two = arrows(0.0, 0.0, 100.0, &[(Direction::Right, 0.5), (Direction::Up, 0.5)]);
        assert!(two.matches("<path").count() == 2 && two.contains("L31.11 0.00L") && two.contains("L0.00 -31.11L"));
    }

    #[test]
    fn arrows_point_where_they_say() {
        // The tip is the fourth corner.
        let tip = |direction| arrow(0.0, 0.0, 100.0, direction, 1.0).split('L').nth(3).map(str::to_owned);
        assert_eq!(tip(Direction::Up).as_deref(), Some("0.00 -44.00"));
        assert_eq!(tip(Direction::Right).as_deref(), Some("44.00 0.00"));
        assert_eq!(Direction::of_name(" East"), Some(Direction::Right));
        assert_eq!(Direction::of_name("grasp"), None);
    }
}
