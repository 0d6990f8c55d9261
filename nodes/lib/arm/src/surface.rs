//! The surface of a hull as triangles, for pictures.

use crate::hull::Hull;
use nalgebra::Vector3;
use parry3d_f64::math::Vector;
use parry3d_f64::transformation::try_convex_hull;

/// The triangles of a box whose corner i has the larger x, y or z where bit 0, 1 or 2 of i is set, counter-clockwise from outside.
const BOX: [[u32; 3]; 12] = [
    [0, 2, 3],
    [0, 3, 1],
    [4, 5, 7],
    [4, 7, 6],
    [0, 1, 5],
    [0, 5, 4],
    [2, 6, 7],
    [2, 7, 3],
    [0, 4, 6],
    [0, 6, 2],
    [1, 3, 7],
    [1, 7, 5],
];

impl Hull {
    /// Corners, metres, and triangles between them, counter-clockwise from outside. Of a hull with more than `most` corners only
    /// those are taken that lie farthest in one of as many directions: the picture is then a little too small.
    pub fn surface(&self, most: usize) -> (Vec<Vector3<f64>>, Vec<[u32; 3]>) {
        let corners: Vec<Vector> = self.corners().map(|c| Vector::new(c.x, c.y, c.z)).collect();
        let kept = if corners.len() > most { farthest_corners(&corners, most) } else { corners };
        let found = try_convex_hull(&kept).ok().filter(|(corners, faces)| {
            let is_whole = |face: &[u32; 3]| face.iter().all(|&i| (i as usize) < corners.len());
            corners.iter().all(|c| c.is_finite()) && !faces.is_empty() && faces.iter().all(is_whole)
        });
        let (corners, faces) = found.unwrap_or_else(|| (box_around(&kept), BOX.to_vec()));
        (corners.iter().map(|c| Vector3::new(c.x, c.y, c.z)).collect(), faces)
    }
}

/// The corners that lie farthest in one of `n` directions, spread evenly over the sphere by the golden angle.
fn farthest_corners(corners: &[Vector], n: usize) -> Vec<Vector> {
    let golden = core::f64::consts::PI * (3.0 - libm::sqrt(5.0));
    let mut kept: Vec<usize> = (0..n)
        .filter_map(|i| {
            let z = 1.0 - 2.0 * (i as f64 + 0.5) / n as f64;
            let (radius, turn) = (libm::sqrt(1.0 - z * z), golden * i as f64);
            let direction = Vector::new(radius * libm::cos(turn), radius * libm::sin(turn), z);
            let far = |&a: &usize, &b: &usize| corners[a].dot(direction).total_cmp(&corners[b].dot(direction));
            (0..corners.len()).max_by(far)
        })
        .collect();
    kept.sort_unstable();
    kept.dedup();
    kept.into_iter().map(|i| corners[i]).collect()
}

fn box_around(points: &[Vector]) -> Vec<Vector> {
    let low = points.iter().fold(Vector::splat(f64::INFINITY), |low, p| low.min(*p));
    let high = points.iter().fold(Vector::splat(f64::NEG_INFINITY), |high, p| high.max(*p));
    let pick = |i: usize, bit: usize, low: f64, high: f64| if i >> bit & 1 == 1 { high } else { low };
    (0..8)
        .map(|i| Vector::new(pick(i, 0, low.x, high.x), pick(i, 1, low.y, high.y), pick(i, 2, low.z, high.z)))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::{BOX, box_around};
    use crate::hull::Hull;
    use nalgebra::Vector3;
    use parry3d_f64::math::Vector;

    /// Six times the volume that triangles enclose; positive when they are seen counter-clockwise from outside.
    fn six_volumes(corners: &[Vector3<f64>], faces: &[[u32; 3]]) -> f64 {
        let at = |i: u32| corners[i as usize];
        faces.iter().map(|&[a, b, c]| at(a).dot(&at(b).cross(&at(c)))).sum()
    }

    #[test]
    fn triangles_enclose_the_hull_seen_from_outside() {
        let cube: Vec<Vector3<f64>> =
            (0..8_u32).map(|i| Vector3::new(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2))).collect();
        let (corners, faces) = Hull::new(&cube, 0.001).expect("a cube").surface(300);
        assert!((six_volumes(&corners, &faces) - 6.0).abs() < 1e-9);
        let boxed = box_around(&[Vector::new(-1.0, -2.0, -3.0), Vector::new(1.0, 2.0, 3.0)]);
        let boxed: Vec<Vector3<f64>> = boxed.iter().map(|c| Vector3::new(c.x, c.y, c.z)).collect();
        assert!((six_volumes(&boxed, &BOX) - 6.0 * 48.0).abs() < 1e-9);
    }

    #[test]
    fn a_hull_of_many_corners_is_drawn_with_few() {
        let turn = |i: usize| (i as f64 * 2.4, 1.0 - 2.0 * (i as f64 + 0.5) / 2000.0);
        let ball: Vec<Vector3<f64>> = (0..2000)
            .map(turn)
            .map(|(angle, z)| Vector3::new((1.0 - z * z).sqrt() * angle.cos(), (1.0 - z * z).sqrt() * angle.sin(), z))
            .collect();
        let hull = Hull::new(&ball, 0.001).expect("a ball");
        let (corners, faces) = hull.surface(200);
        assert!(corners.len() <= 200);
        let share = six_volumes(&corners, &faces) / 6.0 / hull.volume();
        assert!(share > 0.94 && share < 1.0, "{share}");
    }
}
