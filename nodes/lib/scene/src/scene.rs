//! A table with things on it, checked, and where on it the target cannot be.

use crate::{Object, Point, Shape};
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// More objects than this are refused.
pub const MAX_OBJECTS: usize = 64;
const MAX_NAME: usize = 128;
const MAX_TABLE_M: f64 = 100.0;
/// What has moved less stands where it stood.
const SAME_PLACE_M: f64 = 0.01;
const SAME_YAW_RAD: f64 = 0.1;

/// What stands on a table, and what is to be placed on it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Scene {
    /// Unique within a session.
    pub id: String,
    /// Frame of every coordinate.
    pub frame: String,
    /// Extent along x, metres.
    pub width_m: f64,
    /// Extent along y, metres.
    pub depth_m: f64,
    /// Things on the table.
    pub objects: Vec<Object>,
    /// The thing to place; its position is ignored.
    pub target: Object,
}

/// Why a scene cannot be used.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum SceneError {
    /// A table must have an area.
    #[error("the table of scene '{scene}' is {width_m} m x {depth_m} m; both must lie above 0 and at most 100")]
    Table {
        /// Id of the scene.
        scene: String,
        /// Got.
        width_m: f64,
        /// Got.
        depth_m: f64,
    },
    /// See [`MAX_OBJECTS`].
    #[error("scene '{scene}' has {got} objects; at most {MAX_OBJECTS} are supported")]
    TooMany {
        /// Id of the scene.
        scene: String,
        /// Got.
        got: usize,
    },
    /// Ids name weights, so each must be there once.
    #[error("scene '{scene}' has the object id '{id}' twice; ids must be unique")]
    DuplicateId {
        /// Id of the scene.
        scene: String,
        /// The repeated id.
        id: String,
    },
    /// An id or label is empty or too long.
    #[error("an object of scene '{scene}' has an id or label of {got} characters; 1 to 128 are allowed")]
    Name {
        /// Id of the scene.
        scene: String,
        /// Got.
        got: usize,
    },
    /// A coordinate or an extent is not a number.
    #[error("object '{id}' of scene '{scene}' has a position, rotation or size that is not a finite number")]
    NotFinite {
        /// Id of the scene.
        scene: String,
        /// The object.
        id: String,
    },
    /// Sizes must be positive.
    #[error("object '{id}' of scene '{scene}' has a size of {size_m:?} m; each extent must lie above 0")]
    Size {
        /// Id of the scene.
        scene: String,
        /// The object.
        id: String,
        /// Got.
        size_m: [f64; 3],
    },
    /// An object's centre must be on the table.
    #[error("object '{id}' of scene '{scene}' is at ({x_m}, {y_m}) m, off the {width_m} m x {depth_m} m table")]
    OffTable {
        /// Id of the scene.
        scene: String,
        /// The object.
        id: String,
        /// Got.
        x_m: f64,
        /// Got.
        y_m: f64,
        /// Table.
        width_m: f64,
        /// Table.
        depth_m: f64,
    },
}

impl Scene {
    /// Refuses tables without area, too many objects, repeated ids, and objects without size, off the table or not finite.
    pub fn check(&self) -> Result<(), SceneError> {
        let scene = || self.id.chars().take(MAX_NAME).collect::<String>();
        let extent = |m: f64| m > 0.0 && m <= MAX_TABLE_M;
        if !extent(self.width_m) || !extent(self.depth_m) {
            return Err(SceneError::Table { scene: scene(), width_m: self.width_m, depth_m: self.depth_m });
        }
        if self.objects.len() > MAX_OBJECTS {
            return Err(SceneError::TooMany { scene: scene(), got: self.objects.len() });
        }
        for (i, object) in self.objects.iter().chain([&self.target]).enumerate() {
            let is_target = i == self.objects.len();
            for name in [&object.id, &object.label] {
                if name.is_empty() || name.len() > MAX_NAME {
                    return Err(SceneError::Name { scene: scene(), got: name.len() });
                }
            }
            let id = || object.id.clone();
            if self.objects.iter().take(i).any(|other| other.id == object.id) {
                return Err(SceneError::DuplicateId { scene: scene(), id: id() });
            }
            let size_m = object.shape.extents_m();
            if size_m.iter().any(|v| !v.is_finite())
                || !(is_target || object.position_m.is_finite() && object.yaw_rad.is_finite())
            {
                return Err(SceneError::NotFinite { scene: scene(), id: id() });
            }
            if size_m.iter().any(|&v| v <= 0.0) {
                return Err(SceneError::Size { scene: scene(), id: id(), size_m });
            }
            if !is_target && !self.is_on_table(object.position_m) {
                return Err(SceneError::OffTable {
                    scene: scene(),
                    id: id(),
                    x_m: object.position_m.x,
                    y_m: object.position_m.y,
                    width_m: self.width_m,
                    depth_m: self.depth_m,
                });
            }
        }
        Ok(())
    }

    /// Whether a point lies on the table, edges counted.
    pub fn is_on_table(&self, at_m: Point) -> bool {
        (0.0..=self.width_m).contains(&at_m.x) && (0.0..=self.depth_m).contains(&at_m.y)
    }

    /// Whether another table is the same but for what perception may be off: the same things, each within a centimetre and,
    /// unless it is round, a tenth of a radian.
    pub fn stands_as(&self, other: &Self) -> bool {
        let near = |(a, b): (&Object, &Object)| {
            let turned_rad = a.yaw_rad - b.yaw_rad;
            let is_round = matches!(a.shape, Shape::Cylinder { .. });
            a.id == b.id
                && a.shape == b.shape
                && a.position_m.distance(b.position_m) <= SAME_PLACE_M
                && (is_round || turned_rad.sin().atan2(turned_rad.cos()).abs() <= SAME_YAW_RAD)
        };
        self.objects.len() == other.objects.len()
            && self.objects.iter().zip(&other.objects).all(near)
            && self.target.id == other.target.id
            && (self.width_m, self.depth_m) == (other.width_m, other.depth_m)
    }

    /// From metres to coordinates in which the table is the unit square.
    pub fn normalised(&self, at_m: Point) -> Point {
        Point::new(at_m.x / self.width_m, at_m.y / self.depth_m)
    }

    /// From coordinates in which the table is the unit square to metres.
    pub fn metres(&self, at: Point) -> Point {
        Point::new(at.x * self.width_m, at.y * self.depth_m)
    }

    /// Where the target's centre cannot be.
    pub fn occupied(&self) -> Occupied {
        Occupied {
            margin_m: self.target.shape.bounding_radius_m(),
            width_m: self.width_m,
            depth_m: self.depth_m,
            objects: self.objects.iter().filter(|object| !object.supports).cloned().collect(),
        }
    }
}

/// Where the target's centre cannot be, the target taken as its bounding circle.
#[derive(Debug, Clone, PartialEq)]
pub struct Occupied {
    margin_m: f64,
    width_m: f64,
    depth_m: f64,
    objects: Vec<Object>,
}

/// What keeps the target from a spot.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum Obstruction {
    /// It would reach over the edge.
    #[error("it would stick out over the table's edge")]
    Edge,
    /// It would meet an object.
    #[error("it would stand on '{id}'")]
    Object {
        /// Which.
        id: String,
    },
}

impl Occupied {
    /// What keeps the target's centre from a point in metres; `None` when it is free.
    pub fn reason(&self, at_m: Point) -> Option<Obstruction> {
        let inside = |v: f64, extent: f64| v >= self.margin_m && v <= extent - self.margin_m;
        if !(inside(at_m.x, self.width_m) && inside(at_m.y, self.depth_m)) {
            return Some(Obstruction::Edge);
        }
        self.objects
            .iter()
            .find(|object| object.distance_m(at_m) < self.margin_m)
            .map(|object| Obstruction::Object { id: object.id.clone() })
    }

    /// Whether the target's centre may be at a point in metres.
    pub fn is_free(&self, at_m: Point) -> bool {
        let inside = |v: f64, extent: f64| v >= self.margin_m && v <= extent - self.margin_m;
        inside(at_m.x, self.width_m)
            && inside(at_m.y, self.depth_m)
            && self.objects.iter().all(|object| object.distance_m(at_m) >= self.margin_m)
    }
}
