//! Things described by flat lists, as parameters have them: one list per property, one entry per thing.

use crate::{Object, Point, Shape};
use thiserror::Error;

/// Why lists describe no things.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ListError {
    /// Lists that belong together have different lengths.
    #[error("{name} has {got} entries; {expected} are needed for the {things} {of}_ids")]
    Length {
        /// The parameter.
        name: String,
        /// As in [`Listed::of`].
        of: &'static str,
        /// Got.
        got: usize,
        /// Needed.
        expected: usize,
        /// Number of things.
        things: usize,
    },
    /// A size has three extents.
    #[error("target_size_m has {got} entries; it must have 3 (x, y, z)")]
    TargetSize {
        /// Got.
        got: usize,
    },
    /// Only two shapes are known.
    #[error("the shape of '{id}' is '{got}'; it must be cylinder or box")]
    Shape {
        /// The object.
        id: String,
        /// Got.
        got: String,
    },
    /// A cylinder is as wide as it is deep.
    #[error("'{id}' is a cylinder of {x_m} m by {y_m} m; x and y must both be its diameter")]
    Cylinder {
        /// The object.
        id: String,
        /// Got.
        x_m: f64,
        /// Got.
        y_m: f64,
    },
}

/// What is known of things wherever they stand.
#[derive(Debug, Clone, Copy)]
pub struct Listed<'a> {
    /// What the names of the lists begin with: "object" or "target".
    pub of: &'static str,
    /// Unique ids.
    pub ids: &'a [String],
    /// What people call them; one each, or none to use the ids.
    pub labels: &'a [String],
    /// "cylinder" or "box".
    pub shapes: &'a [String],
    /// Three extents each (x, y, z), metres; a cylinder's x and y are its diameter.
    pub sizes_m: &'a [f64],
    /// Whether other things may stand on them; one each, or none for all false.
    pub supports: &'a [bool],
}

impl Listed<'_> {
    /// The things, each at the origin and not turned.
    ///
    /// # Errors
    /// Lists that do not fit together; a shape that is not known.
    pub fn objects(&self) -> Result<Vec<Object>, ListError> {
        self.fit(&format!("{}_labels", self.of), self.labels.len(), 1, true)?;
        self.fit(&format!("{}_shapes", self.of), self.shapes.len(), 1, false)?;
        self.fit(&format!("{}_sizes_m", self.of), self.sizes_m.len(), 3, false)?;
        self.fit(&format!("{}_supports", self.of), self.supports.len(), 1, true)?;
        let object = |(i, id): (usize, &String)| {
            Ok(Object {
                id: id.clone(),
                label: self.labels.get(i).unwrap_or(id).clone(),
                shape: shape(id, &self.shapes[i], [0, 1, 2].map(|axis| self.sizes_m[3 * i + axis]))?,
                position_m: Point::default(),
                yaw_rad: 0.0,
                supports: self.supports.get(i).copied().unwrap_or(false),
            })
        };
        self.ids.iter().enumerate().map(object).collect()
    }

    /// The things where they stand: two coordinates each (x, y), metres, and their rotations about the vertical, radians, or none for
    /// all zero.
    ///
    /// # Errors
    /// Lists that do not fit together; a shape that is not known.
    pub fn standing(&self, positions_m: &[f64], yaws_rad: &[f64]) -> Result<Vec<Object>, ListError> {
        self.fit(&format!("{}_positions_m", self.of), positions_m.len(), 2, false)?;
        self.fit(&format!("{}_yaws_rad", self.of), yaws_rad.len(), 1, true)?;
        let stands = |(i, object): (usize, Object)| Object {
            position_m: Point::new(positions_m[2 * i], positions_m[2 * i + 1]),
            yaw_rad: yaws_rad.get(i).copied().unwrap_or(0.0),
            ..object
        };
        Ok(self.objects()?.into_iter().enumerate().map(stands).collect())
    }

    /// Whether a list of `got` entries has `each` of them for every thing, or none where it is `optional`.
    ///
    /// # Errors
    /// [`ListError::Length`], which names the list.
    pub fn fit(&self, name: &str, got: usize, each: usize, optional: bool) -> Result<(), ListError> {
        let (of, things, expected) = (self.of, self.ids.len(), self.ids.len() * each);
        let fits = got == expected || (optional && got == 0);
        if fits { Ok(()) } else { Err(ListError::Length { name: name.to_owned(), of, got, expected, things }) }
    }
}

/// The thing to place, wherever that will be.
///
/// # Errors
/// A size that is no size; a shape that is not known.
pub fn listed_target(id: &str, label: &str, shape_name: &str, size_m: &[f64]) -> Result<Object, ListError> {
    let &[x, y, z] = size_m else { return Err(ListError::TargetSize { got: size_m.len() }) };
    Ok(Object {
        id: id.to_owned(),
        label: label.to_owned(),
        shape: shape(id, shape_name, [x, y, z])?,
        position_m: Point::default(),
        yaw_rad: 0.0,
        supports: false,
    })
}

fn shape(id: &str, name: &str, [x_m, y_m, height_m]: [f64; 3]) -> Result<Shape, ListError> {
    match name {
        "cylinder" if x_m == y_m => Ok(Shape::Cylinder { radius_m: 0.5 * x_m, height_m }),
        "cylinder" => Err(ListError::Cylinder { id: id.to_owned(), x_m, y_m }),
        "box" => Ok(Shape::Box { width_m: x_m, depth_m: y_m, height_m }),
        _ => Err(ListError::Shape { id: id.to_owned(), got: name.to_owned() }),
    }
}
