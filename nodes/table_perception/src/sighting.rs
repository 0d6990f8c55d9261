//! One thing seen at one place on the table.

use arm::{Isometry3, Vector3};
use scene::Point;

/// What is farther from the table than this is not for it, metres.
const NEARBY_M: f64 = 2.0;

/// Where something was seen, in the table's frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Sighting {
    /// Of its middle, on the table's surface.
    pub at: Point,
    /// About the vertical, radians.
    pub yaw_rad: f64,
}

/// Why something that was seen does not stand on the table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Elsewhere {
    /// Beside it, above it or below it.
    Off,
    /// On it, but lying, or about to fall: by this angle, radians.
    Tilted(f64),
}

/// What counts as standing on the table.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Table {
    pub width_m: f64,
    pub depth_m: f64,
    /// How far above or below the surface the middle of something may be.
    pub reach_m: f64,
    pub max_tilt_rad: f64,
}

impl Table {
    /// What a pose in the table's frame amounts to.
    pub fn sight(&self, pose: &Isometry3<f64>) -> Result<Sighting, Elsewhere> {
        let at = pose.translation.vector;
        let is_on = (0.0..=self.width_m).contains(&at.x) && (0.0..=self.depth_m).contains(&at.y);
        if !is_on || at.z.abs() > self.reach_m {
            return Err(Elsewhere::Off);
        }
        Ok(Sighting { at: Point::new(at.x, at.y), yaw_rad: self.upright(pose)? })
    }

    /// Where the middle of something is that stands on the table, near it, or on a tray beside it: metres, and radians about the
    /// vertical.
    pub fn sight_nearby(&self, pose: &Isometry3<f64>) -> Result<([f64; 3], f64), Elsewhere> {
        let at = pose.translation.vector;
        let is_near = |along_m: f64, extent_m: f64| (-NEARBY_M..=extent_m + NEARBY_M).contains(&along_m);
        if !(is_near(at.x, self.width_m) && is_near(at.y, self.depth_m) && is_near(at.z, 0.0)) {
            return Err(Elsewhere::Off);
        }
        Ok((at.into(), self.upright(pose)?))
    }

    /// How something that stands is turned about the vertical, radians.
    fn upright(&self, pose: &Isometry3<f64>) -> Result<f64, Elsewhere> {
        let up = pose.rotation * Vector3::z();
        // What stands on its head stands: detectors often confuse the two.
        let tilt_rad = up.x.hypot(up.y).atan2(up.z.abs());
        if tilt_rad > self.max_tilt_rad {
            return Err(Elsewhere::Tilted(tilt_rad));
        }
        let along = pose.rotation * Vector3::x();
        Ok(along.y.atan2(along.x))
    }
}

/// Which of several like things each sighting is: the nearest pairs first, by where the things were; the others in the order of
/// x, then y. `before` has an entry for each thing, and so has what is returned.
pub(crate) fn matched(before: &[Option<Point>], seen: &[Sighting]) -> Vec<Option<Sighting>> {
    let mut pairs: Vec<(f64, usize, usize)> = before
        .iter()
        .enumerate()
        .filter_map(|(thing, at)| at.map(|at| (thing, at)))
        .flat_map(|(thing, at)| {
            seen.iter().enumerate().map(move |(i, of)| ((at.x - of.at.x).hypot(at.y - of.at.y), thing, i))
        })
        .collect();
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)).then(a.2.cmp(&b.2)));
    let (mut found, mut is_used) = (vec![None; before.len()], vec![false; seen.len()]);
    for (_, thing, i) in pairs {
        if found[thing].is_none() && !is_used[i] {
            (found[thing], is_used[i]) = (Some(seen[i]), true);
        }
    }
    let mut rest: Vec<Sighting> = (0..seen.len()).filter(|&i| !is_used[i]).map(|i| seen[i]).collect();
    rest.sort_by(|a, b| a.at.x.total_cmp(&b.at.x).then(a.at.y.total_cmp(&b.at.y)));
    let new = (0..before.len()).filter(|&thing| before[thing].is_none());
    for (thing, of) in new.collect::<Vec<_>>().into_iter().zip(rest) {
        found[thing] = Some(of);
    }
    found
}
