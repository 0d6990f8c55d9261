//! The convex hull of points, built for many questions of the kind "which corner is farthest that way?".

use crate::convex::to_nalgebra;
use nalgebra::{Matrix3, UnitQuaternion, Vector3};
use parry3d_f64::math::{Rotation, Vector};
use parry3d_f64::transformation::try_convex_hull;

/// Hulls with fewer corners are searched one by one.
const FEW: usize = 20;
/// Cells per edge of the cube of directions.
const CELLS: usize = 6;

/// No point lies farther outside of a hull than this share of its size.
const TOLERANCE: f64 = 1e-9;
/// Directions from which the hull is tried.
const ATTEMPTS: i32 = 8;
/// The corners of an octahedron.
const AXES: [Vector; 6] = [Vector::X, Vector::Y, Vector::Z, Vector::NEG_X, Vector::NEG_Y, Vector::NEG_Z];

/// A convex solid given by its corners, which enclose a volume.
#[derive(Debug, Clone, PartialEq)]
pub struct Hull {
    corners: Vec<Vector>,
    /// Corner i's neighbours along edges are `neighbours[first[i]..first[i + 1]]`.
    first: Vec<u32>,
    neighbours: Vec<u32>,
    /// For each cell of a cube around the hull, the corner farthest in the direction of its middle.
    starts: Vec<u32>,
    volume: f64,
    flat: bool,
}

impl Hull {
    /// The hull of finite points; `None` without a point. Points that enclose no volume (a plate, a line, a point) are
    /// thickened by `thickness` to all sides, metres.
    pub fn new(points: &[Vector3<f64>], thickness: f64) -> Option<Self> {
        let mut points: Vec<Vector> = points.iter().map(|p| Vector::new(p.x + 0.0, p.y + 0.0, p.z + 0.0)).collect();
        points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)).then(a.z.total_cmp(&b.z)));
        points.dedup();
        if points.is_empty() {
            return None;
        }
        let frame = Frame::around(&points);
        // Far from the origin, or over a large plate, so little would be lost in rounding.
        let far = points.iter().fold(0.0, |far: f64, p| far.max(p.abs().max_element()));
        let thickness = thickness.max(1e-5 * frame.half.max_element()).max(1e-9 * far);
        let is_flat = frame.half.min_element() <= 1e-6 * frame.half.max_element() + 1e-9 * far;
        let solid = if is_flat { None } else { Self::build(&points, &frame) };
        if solid.is_some() {
            return solid;
        }
        let around = |p: Vector| AXES.map(|axis| p + frame.rotation * (axis * thickness));
        let thick: Vec<Vector> = points.iter().flat_map(|&p| around(p)).collect();
        let hull = Self::build(&thick, &Frame { half: frame.half + thickness, ..frame });
        Some(Self { flat: true, ..hull.unwrap_or_else(|| Self::block(&points, thickness)) })
    }

    /// The box around points, whatever they are.
    fn block(points: &[Vector], thickness: f64) -> Self {
        let corners = box_around(points, thickness);
        let extent = corners[7] - corners[0];
        Self {
            corners: corners.to_vec(),
            first: (0..=8).map(|i| 3 * i).collect(),
            neighbours: (0..8_u32).flat_map(|i| [i ^ 1, i ^ 2, i ^ 4]).collect(),
            starts: Vec::new(),
            volume: extent.x * extent.y * extent.z,
            flat: false,
        }
    }

    /// The hull of points that fill a box, checked: where many points are nearly in one plane, parry's algorithm leaves out a
    /// corner about once in ten thousand times, so what it finds is tried against all points, and again turned.
    fn build(points: &[Vector], frame: &Frame) -> Option<Self> {
        let upright = Frame::upright(points);
        let mut frames = vec![(upright, Rotation::IDENTITY)];
        let turn = |k: f64| Rotation::from_scaled_axis(k * Vector::new(0.41, 0.73, 0.29));
        frames.extend((0..ATTEMPTS).map(|k| (*frame, turn(f64::from(k)))));
        frames
            .iter()
            .filter(|(frame, _)| frame.half.min_element() > 0.0)
            .find_map(|(f, turn)| Self::attempt(points, f, *turn))
    }

    /// The algorithm takes what is much longer than thick for flat, so it is given the points stretched to a cube.
    fn attempt(points: &[Vector], frame: &Frame, turn: Rotation) -> Option<Self> {
        let stretch = |p: &Vector| turn * ((frame.rotation.inverse() * (*p - frame.centre)) / frame.half);
        let stretched: Vec<Vector> = points.iter().map(stretch).collect();
        let (corners, faces) = try_convex_hull(&stretched).ok()?;
        let corner = |i: u32| corners[i as usize];
        let six: f64 = faces.iter().map(|&[a, b, c]| corner(a).dot(corner(b).cross(corner(c)))).sum();
        // Two sides of one polygon, or nothing at all.
        if corners.len() < 4 || corners.iter().any(|c| !c.is_finite()) || six.is_nan() || six / 6.0 <= 1e-6 {
            return None;
        }
        for &[a, b, c] in &faces {
            let Some(normal) = (corner(b) - corner(a)).cross(corner(c) - corner(a)).try_normalize() else { continue };
            let height = normal.dot(corner(a)) + TOLERANCE;
            if stretched.iter().any(|p| normal.dot(*p) > height) {
                return None;
            }
        }
        let volume = six / 6.0 * frame.half.x * frame.half.y * frame.half.z;
        let restore = |c: Vector| frame.centre + frame.rotation * ((turn.inverse() * c) * frame.half);
        let corners: Vec<Vector> = corners.into_iter().map(restore).collect();
        let mut lists: Vec<Vec<u32>> = vec![Vec::new(); corners.len()];
        for &[a, b, c] in &faces {
            for (from, to) in [(a, b), (b, c), (c, a), (b, a), (c, b), (a, c)] {
                if !lists[from as usize].contains(&to) {
                    lists[from as usize].push(to);
                }
            }
        }
        if lists.iter().any(|list| list.len() < 3) {
            return None;
        }
        let mut first = vec![0];
        let mut neighbours = Vec::new();
        for list in &lists {
            neighbours.extend_from_slice(list);
            first.push(neighbours.len() as u32);
        }
        let mut hull = Self { corners, first, neighbours, starts: Vec::new(), volume, flat: false };
        if hull.corners.len() >= FEW {
            hull.starts = (0..6 * CELLS * CELLS).map(|cell| hull.farthest_of_all(middle(cell))).collect();
        }
        Some(hull)
    }

    /// Its corners.
    pub fn corners(&self) -> impl ExactSizeIterator<Item = Vector3<f64>> + Clone {
        self.corners.iter().map(|c| Vector3::new(c.x, c.y, c.z))
    }

    /// Cubic metres.
    pub fn volume(&self) -> f64 {
        self.volume
    }

    /// Whether the points enclosed no volume and were thickened.
    pub fn was_flat(&self) -> bool {
        self.flat
    }

    /// The corner farthest in a direction: from the corner that is farthest in nearly that direction along edges
    /// uphill. On a convex solid no corner but a highest one is without a higher neighbour.
    pub(crate) fn farthest(&self, direction: Vector) -> Vector {
        if self.starts.is_empty() {
            return self.corners[self.farthest_of_all(direction) as usize];
        }
        let mut at = self.starts[cell(direction)] as usize;
        let mut height = self.corners[at].dot(direction);
        loop {
            let mut best = at;
            for &next in &self.neighbours[self.first[at] as usize..self.first[at + 1] as usize] {
                let other = self.corners[next as usize].dot(direction);
                if other > height {
                    height = other;
                    best = next as usize;
                }
            }
            if best == at {
                return self.corners[at];
            }
            at = best;
        }
    }

    fn farthest_of_all(&self, direction: Vector) -> u32 {
        let mut best = (f64::NEG_INFINITY, 0);
        for (i, corner) in self.corners.iter().enumerate() {
            let height = corner.dot(direction);
            if height > best.0 {
                best = (height, i);
            }
        }
        best.1 as u32
    }
}

/// A box along the principal axes of points.
#[derive(Debug, Clone, Copy)]
struct Frame {
    centre: Vector,
    /// From the axes of the box.
    rotation: Rotation,
    half: Vector,
}

impl Frame {
    /// The box along the axes that the points are given in.
    fn upright(points: &[Vector]) -> Self {
        let low = points.iter().copied().fold(Vector::INFINITY, Vector::min);
        let high = points.iter().copied().fold(Vector::NEG_INFINITY, Vector::max);
        Self { centre: 0.5 * (low + high), rotation: Rotation::IDENTITY, half: 0.5 * (high - low) }
    }

    fn around(points: &[Vector]) -> Self {
        let mean = points.iter().copied().sum::<Vector>() / points.len() as f64;
        let mut spread = Matrix3::zeros();
        for p in points {
            let p = to_nalgebra(*p - mean);
            spread += p * p.transpose();
        }
        let mut axes = spread.symmetric_eigen().eigenvectors;
        if axes.determinant() < 0.0 {
            axes.swap_columns(0, 1);
        }
        let turn = UnitQuaternion::from_matrix(&axes).coords;
        let rotation = Rotation::from_xyzw(turn.x, turn.y, turn.z, turn.w).normalize();
        let local = || points.iter().map(|&p| rotation.inverse() * (p - mean));
        let low = local().fold(Vector::INFINITY, Vector::min);
        let high = local().fold(Vector::NEG_INFINITY, Vector::max);
        Self { centre: mean + rotation * (0.5 * (low + high)), rotation, half: 0.5 * (high - low) }
    }
}

fn box_around(points: &[Vector], thickness: f64) -> [Vector; 8] {
    let low = points.iter().copied().fold(Vector::INFINITY, Vector::min) - thickness;
    let high = points.iter().copied().fold(Vector::NEG_INFINITY, Vector::max) + thickness;
    std::array::from_fn(|i| {
        let pick = |bit: usize, low: f64, high: f64| if i >> bit & 1 == 0 { low } else { high };
        Vector::new(pick(0, low.x, high.x), pick(1, low.y, high.y), pick(2, low.z, high.z))
    })
}

/// The cell of the cube of directions that a direction points to.
fn cell(direction: Vector) -> usize {
    let [x, y, z] = [direction.x, direction.y, direction.z];
    let [ax, ay, az] = [x.abs(), y.abs(), z.abs()];
    let (face, high, u, v) = if ax >= ay && ax >= az {
        (if x < 0.0 { 1 } else { 0 }, ax, y, z)
    } else if ay >= az {
        (if y < 0.0 { 3 } else { 2 }, ay, x, z)
    } else {
        (if z < 0.0 { 5 } else { 4 }, az, x, y)
    };
    // A direction of length 0 points nowhere: any cell will do. The conversion saturates.
    let place = |w: f64| (((w / high + 1.0) * 0.5 * CELLS as f64) as usize).min(CELLS - 1);
    (face * CELLS + place(u)) * CELLS + place(v)
}

/// The direction of the middle of a cell.
fn middle(cell: usize) -> Vector {
    let place = |i: usize| 2.0 * (i as f64 + 0.5) / CELLS as f64 - 1.0;
    let (u, v) = (place(cell / CELLS % CELLS), place(cell % CELLS));
    match cell / (CELLS * CELLS) {
        0 => Vector::new(1.0, u, v),
        1 => Vector::new(-1.0, u, v),
        2 => Vector::new(u, 1.0, v),
        3 => Vector::new(u, -1.0, v),
        4 => Vector::new(u, v, 1.0),
        _ => Vector::new(u, v, -1.0),
    }
}

#[cfg(test)]
mod tests {
    use super::Hull;
    use nalgebra::Vector3;
    use parry3d_f64::math::Vector;
    use proptest::prelude::{prop, prop_assert, proptest};

    proptest! {
        #[test]
        fn no_point_lies_beyond_the_farthest_corner(
            points in prop::collection::vec(prop::array::uniform3(-1.0..1.0_f64), 1..200),
            round in prop::bool::ANY,
            directions in prop::collection::vec(prop::array::uniform3(-1.0..1.0_f64), 20),
        ) {
            let points: Vec<Vector3<f64>> = points
                .iter()
                .map(|&p| Vector3::from(p))
                // Many corners when round, few and faces with many points on them when not.
                .map(|p| if round { p.normalize() } else { p.map(|v| (4.0 * v).round() / 4.0) })
                .filter(|p| p.iter().all(|v| v.is_finite()))
                .collect();
            let Some(hull) = Hull::new(&points, 1e-3) else { return Ok(()) };
            for d in directions {
                let far = hull.farthest(Vector::from(d)).dot(Vector::from(d));
                let most = points.iter().map(|p| p.dot(&Vector3::from(d))).fold(f64::NEG_INFINITY, f64::max);
                prop_assert!(far >= most - 1e-9, "{far} {most}");
                let slack = if hull.was_flat() { 2e-3 } else { 1e-9 };
                prop_assert!(far <= most + slack * Vector3::from(d).norm().max(1.0), "{far} {most}");
            }
        }
    }

    #[test]
    fn a_plate_is_thickened_and_a_cube_is_not() {
        let corner = |i: usize| Vector3::new((i & 1) as f64, (i >> 1 & 1) as f64, (i >> 2 & 1) as f64);
        let cube: Vec<_> = (0..8).map(corner).collect();
        let hull = Hull::new(&cube, 1e-3).expect("points");
        assert!(!hull.was_flat() && (hull.volume() - 1.0).abs() < 1e-12);
        let plate: Vec<_> = (0..4).map(corner).collect();
        let hull = Hull::new(&plate, 1e-3).expect("points");
        assert!(hull.was_flat() && hull.volume() > 0.0 && hull.volume() < 0.0021);
        assert!(Hull::new(&[], 1e-3).is_none());
        assert!(Hull::new(&[Vector3::x()], 1e-3).is_some_and(|hull| hull.was_flat()));
    }
}
