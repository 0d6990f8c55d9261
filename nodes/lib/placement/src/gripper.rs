//! A hand with two fingers: how far it opens, and how it takes hold of a thing.

use arm::{Isometry3, Translation3, Vector3, about_z};
use scene::Shape;
use std::f64::consts::FRAC_PI_2;
use std::str::FromStr;

/// What is between the fingers of a thing that is wider than they open: its wall, metres. Plates and bowls are taken by the rim.
const RIM_M: f64 = 0.008;
/// Open fingers leave this much room on either side of what goes between them, metres, where the gripper opens that far.
const ROOM_M: f64 = 0.01;
/// Closing fingers are told to go this much beyond the surface of what they hold, metres: they stop there, and press.
const SQUEEZE_M: f64 = 0.006;
/// Closed and open are at least this far apart, radians or metres.
const LEAST_STROKE: f64 = 1e-6;
/// Fingers that came as near as this to where they were told to go hold nothing, metres between them.
const NOTHING_M: f64 = 0.002;

/// A thing may be wider than it is known to be by this, metres; fingers that stay farther apart have not closed.
const LARGER_M: f64 = 0.006;

/// The axis of the tool link along which the fingers close.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ClosingAxis {
    /// Its x axis.
    X,
    /// Its y axis.
    #[default]
    Y,
}

/// A gripper with two fingers, moved by one joint.
#[derive(Debug, Clone, PartialEq)]
pub struct Gripper {
    /// The joint; what moves with it mimics it.
    pub joint: String,
    /// Where the joint is when the fingers touch each other, radians or metres.
    pub closed: f64,
    /// Where it is when they are as far apart as they go, radians or metres.
    pub open: f64,
    /// How far apart they are then, metres.
    pub opening_m: f64,
    /// Which way they close.
    pub axis: ClosingAxis,
}

/// How a gripper takes hold of a thing from above.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grasp {
    /// How wide it is where the fingers close, metres.
    pub width_m: f64,
    /// How far the tool is from the thing's own axis, along the closing axis, metres: 0, or at the rim.
    pub aside_m: f64,
    /// How the thing is turned about the vertical seen from the tool, radians.
    pub turn_rad: f64,
}

impl FromStr for ClosingAxis {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "x" => Ok(Self::X),
            "y" => Ok(Self::Y),
            _ => Err(format!("the fingers close along '{text}'; x or y is needed")),
        }
    }
}

impl Gripper {
    /// Whether it is one at all.
    ///
    /// # Errors
    /// In words: it does not open, or by no distance.
    pub fn check(&self) -> Result<(), String> {
        let numbers = [self.closed, self.open, self.opening_m];
        if numbers.iter().all(|x| x.is_finite())
            && (self.open - self.closed).abs() > LEAST_STROKE
            && self.opening_m > 0.0
        {
            return Ok(());
        }
        let (closed, open, opening_m) = (self.closed, self.open, self.opening_m);
        Err(format!("a gripper that is closed at {closed}, open at {open} and then {opening_m} m wide does not open"))
    }

    /// How a thing is held; its narrower side goes between the fingers, else its rim if it is round.
    ///
    /// # Errors
    /// In words: a box that is wider than the gripper opens.
    pub fn grasp(&self, shape: &Shape) -> Result<Grasp, String> {
        match *shape {
            Shape::Cylinder { radius_m, .. } if 2.0 * radius_m <= self.opening_m => {
                Ok(Grasp { width_m: 2.0 * radius_m, aside_m: 0.0, turn_rad: 0.0 })
            }
            Shape::Cylinder { radius_m, .. } => {
                Ok(Grasp { width_m: RIM_M.min(self.opening_m), aside_m: radius_m - 0.5 * RIM_M, turn_rad: 0.0 })
            }
            Shape::Box { width_m, depth_m, .. } => {
                let (narrow_m, closes_along_x) = if width_m < depth_m { (width_m, true) } else { (depth_m, false) };
                if narrow_m > self.opening_m {
                    let (wide, open) = (100.0 * narrow_m, 100.0 * self.opening_m);
                    return Err(format!("it is {wide:.1} cm wide and the gripper opens {open:.1} cm"));
                }
                let turn_rad = if closes_along_x == (self.axis == ClosingAxis::X) { 0.0 } else { FRAC_PI_2 };
                Ok(Grasp { width_m: narrow_m, aside_m: 0.0, turn_rad })
            }
        }
    }

    /// How far apart the fingers are with the joint at a position, metres.
    pub fn apart_m(&self, position: f64) -> f64 {
        (position - self.closed) / (self.open - self.closed) * self.opening_m
    }

    /// Where the joint is with the fingers so far apart, as near as it goes.
    pub fn position(&self, apart_m: f64) -> f64 {
        let share = (apart_m / self.opening_m).clamp(0.0, 1.0);
        self.closed + share * (self.open - self.closed)
    }

    /// Where the joint is told to go to let a thing in or out.
    pub fn let_in(&self, grasp: &Grasp) -> f64 {
        self.position(grasp.width_m + 2.0 * ROOM_M)
    }

    /// Where the joint is told to go to hold it; the thing keeps it from getting there.
    pub fn hold(&self, grasp: &Grasp) -> f64 {
        self.position(grasp.width_m - SQUEEZE_M)
    }

    /// What fingers have between them that were told to close to `told` and rest `at`.
    pub fn found(&self, told: f64, at: f64) -> Found {
        let farther_m = self.apart_m(at) - self.apart_m(told);
        if farther_m <= NOTHING_M {
            Found::Nothing
        } else if farther_m < SQUEEZE_M + LARGER_M {
            Found::Something
        } else {
            Found::StillOpen
        }
    }
}

/// What closing fingers came to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Found {
    /// They are where they were told to go: nothing is between them.
    Nothing,
    /// Something about as wide as the thing keeps them apart.
    Something,
    /// They are farther apart than it would keep them: they have not closed.
    StillOpen,
}

impl Grasp {
    /// The tool above the middle of a thing.
    pub(crate) const CENTRAL: Self = Self { width_m: 0.0, aside_m: 0.0, turn_rad: 0.0 };

    /// The point of the tool link that stays above the middle of the thing: where it is in the tool's frame.
    pub(crate) fn tool_from_point(&self, axis: ClosingAxis) -> Isometry3<f64> {
        let along = match axis {
            ClosingAxis::X => Vector3::x(),
            ClosingAxis::Y => Vector3::y(),
        };
        Isometry3::from_parts(Translation3::from(along * -self.aside_m), about_z(0.0))
    }
}

#[cfg(test)]
mod tests {
    use super::{ClosingAxis, Found, Gripper};
    use scene::Shape;
    use std::f64::consts::FRAC_PI_2;

    fn gripper(axis: ClosingAxis) -> Gripper {
        Gripper { joint: "finger".into(), closed: 0.7, open: 0.0, opening_m: 0.1, axis }
    }

    #[test]
    fn the_narrow_side_goes_between_the_fingers_and_plates_are_taken_by_the_rim() {
        let by_y = gripper(ClosingAxis::Y);
        let held = by_y.grasp(&Shape::Box { width_m: 0.02, depth_m: 0.2, height_m: 0.01 }).expect("it fits");
        assert_eq!((held.width_m, held.aside_m, held.turn_rad), (0.02, 0.0, FRAC_PI_2));
        let held = by_y.grasp(&Shape::Box { width_m: 0.2, depth_m: 0.02, height_m: 0.01 }).expect("it fits");
        assert_eq!((held.width_m, held.turn_rad), (0.02, 0.0));
        let held = gripper(ClosingAxis::X).grasp(&Shape::Box { width_m: 0.02, depth_m: 0.2, height_m: 0.01 });
        assert_eq!(held.expect("it fits").turn_rad, 0.0);
        let plate = by_y.grasp(&Shape::Cylinder { radius_m: 0.12, height_m: 0.02 }).expect("by the rim");
        assert!((plate.aside_m - 0.116).abs() < 1e-12 && plate.width_m == 0.008);
        let why = by_y.grasp(&Shape::Box { width_m: 0.3, depth_m: 0.2, height_m: 0.05 }).expect_err("a tray");
        assert_eq!(why, "it is 20.0 cm wide and the gripper opens 10.0 cm");
    }

    #[test]
    fn what_does_not_open_is_no_gripper() {
        assert_eq!(gripper(ClosingAxis::X).check(), Ok(()));
        for odd in [
            Gripper { open: 0.7, ..gripper(ClosingAxis::X) },
            Gripper { opening_m: 0.0, ..gripper(ClosingAxis::X) },
            Gripper { closed: f64::NAN, ..gripper(ClosingAxis::X) },
        ] {
            assert!(odd.check().expect_err("it does not open").contains("does not open"));
        }
        assert_eq!("x".parse(), Ok(ClosingAxis::X));
        assert!("z".parse::<ClosingAxis>().is_err());
    }

    #[test]
    fn fingers_that_close_on_something_stop_before_they_are_told_to() {
        let gripper = gripper(ClosingAxis::Y);
        let grasp = gripper.grasp(&Shape::Cylinder { radius_m: 0.02, height_m: 0.1 }).expect("it fits");
        let (wide, told) = (gripper.let_in(&grasp), gripper.hold(&grasp));
        // 6 of 10 cm open, 3.4 of 10 cm closed; 0.7 is closed.
        assert!((wide - 0.28).abs() < 1e-12 && (told - 0.7 * 0.66).abs() < 1e-12);
        assert_eq!(gripper.found(told, 0.7 * 0.6), Found::Something, "4 cm between them");
        assert_eq!(gripper.found(told, told), Found::Nothing);
        assert_eq!(gripper.found(told, told + 0.05), Found::Nothing, "farther than told");
        assert_eq!(gripper.found(told, wide), Found::StillOpen, "they never moved");
    }
}
