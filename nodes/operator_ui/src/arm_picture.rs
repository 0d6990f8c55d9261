//! The arm as it was told on the graph, checked and cut to what a page draws.

use crate::protocol::{ArmMotionView, ArmView, CarryingView, ObjectView, PartShape, PartView, Sections};
use crate::view::object_view;
use apprentice_msgs::action::{PlaceObjectFeedback, PlaceObjectResult};
use apprentice_msgs::geometry_msgs::Pose;
use apprentice_msgs::msg::{ArmModel, ArmMotion, ArmPart, ArmPose, Carrying};
use exchange::object_from_message;

/// Numbers of a link's pose.
const POSE: usize = 7;
/// More links are not drawn.
const MAX_LINKS: usize = 500;
/// More solids are not drawn.
const MAX_PARTS: usize = 2000;
/// More corners of all meshes together are not drawn.
const MAX_CORNERS: usize = 100_000;
/// More moments of a motion, or points of its way, are not drawn.
const MAX_MOMENTS: usize = 20_000;
/// Longest reason for an ended motion, characters.
const MAX_REASON: usize = 300;
/// A page gets lengths to a hundredth of a millimetre.
const PRECISION: f64 = 1e5;

/// Which sections have changed.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct ArmNews {
    pub model: bool,
    pub pose: bool,
    pub motion: bool,
    pub carrying: bool,
}

impl ArmNews {
    /// Everything, for a page that has just joined.
    pub const ALL: Self = Self { model: true, pose: true, motion: true, carrying: true };
}

/// See the module. What speaks of another robot than the model's is kept, and not shown.
#[derive(Debug, Clone, Default)]
pub(crate) struct ArmPicture {
    model: Option<ArmView>,
    pose: (String, Vec<f64>),
    motion: Option<(String, ArmMotionView)>,
    carrying: Option<CarryingView>,
}

impl ArmPicture {
    /// Takes what the arm looks like.
    ///
    /// # Errors
    /// In a sentence: a picture that cannot be drawn.
    pub fn take_model(&mut self, message: &ArmModel) -> Result<ArmNews, String> {
        let view = model_view(message).map_err(|reason| format!("the arm cannot be drawn: {reason}"))?;
        if self.model.as_ref() == Some(&view) {
            return Ok(ArmNews::default());
        }
        self.model = Some(view);
        Ok(ArmNews { carrying: false, ..ArmNews::ALL })
    }

    /// Takes where its links are.
    pub fn take_pose(&mut self, message: &ArmPose) -> ArmNews {
        let pose = (message.robot_hash.clone(), rounded(&message.poses));
        let news = ArmNews { pose: self.pose != pose && self.fits(&pose.0, pose.1.len()), ..ArmNews::default() };
        self.pose = pose;
        news
    }

    /// Takes how it would carry out the plan.
    ///
    /// # Errors
    /// In a sentence: a motion that cannot be drawn.
    pub fn take_motion(&mut self, message: &ArmMotion) -> Result<ArmNews, String> {
        let view = motion_view(message).map_err(|reason| format!("the arm's motion cannot be drawn: {reason}"))?;
        let motion = Some((message.robot_hash.clone(), view));
        let news = ArmNews { motion: self.motion != motion, ..ArmNews::default() };
        self.motion = motion;
        Ok(news)
    }

    /// Takes what it is doing.
    pub fn take_carrying(&mut self, message: &Carrying) -> ArmNews {
        let view = Some(CarryingView {
            revision: message.revision,
            stage: match message.stage {
                PlaceObjectFeedback::APPROACHING => "approaching",
                PlaceObjectFeedback::GRASPING => "grasping",
                PlaceObjectFeedback::RELEASING => "releasing",
                PlaceObjectFeedback::RETREATING => "retreating",
                _ => "moving",
            },
            progress: cut(message.progress).clamp(0.0, 1.0),
            over: message.over,
            done: message.over && message.outcome == PlaceObjectResult::DONE,
            reason: message.description.chars().take(MAX_REASON).collect(),
        });
        let news = ArmNews { carrying: self.carrying != view, ..ArmNews::default() };
        self.carrying = view;
        news
    }

    /// Whether poses are of the arm that is drawn.
    fn fits(&self, hash: &str, n: usize) -> bool {
        self.model.as_ref().is_some_and(|model| model.key == hash && n == POSE * model.links.len())
    }

    /// Fills in what changed.
    pub fn fill(&self, news: ArmNews, sections: &mut Sections) {
        sections.arm = news.model.then(|| self.model.clone());
        let (hash, pose) = &self.pose;
        sections.arm_pose = news.pose.then(|| self.fits(hash, pose.len()).then(|| pose.clone()));
        let motion = || {
            let (hash, motion) = self.motion.as_ref()?;
            let drawn = motion.poses.first().is_none_or(|first| self.fits(hash, first.len()));
            drawn.then(|| motion.clone())
        };
        sections.arm_motion = news.motion.then(motion);
        sections.carrying = news.carrying.then(|| self.carrying.clone());
    }
}

fn model_view(message: &ArmModel) -> Result<ArmView, String> {
    let n = message.link_names.len();
    if n > MAX_LINKS || message.parts.len() > MAX_PARTS {
        return Err(format!(
            "it has {n} links and {} solids; {MAX_LINKS} and {MAX_PARTS} are drawn",
            message.parts.len()
        ));
    }
    let corners: usize = message.parts.iter().map(|part| part.points.len() / 3).sum();
    if corners > MAX_CORNERS {
        return Err(format!("its meshes have {corners} corners; {MAX_CORNERS} are drawn"));
    }
    let mut links = vec![Vec::new(); n];
    for part in &message.parts {
        let link = usize::try_from(part.link).ok().and_then(|link| links.get_mut(link));
        link.ok_or_else(|| format!("a solid is of link {} of {n}", part.link))?.push(part_view(part)?);
    }
    Ok(ArmView { key: message.robot_hash.clone(), links })
}

fn part_view(part: &ArmPart) -> Result<PartView, String> {
    let [x, y, z] = [part.size_m.x, part.size_m.y, part.size_m.z];
    let shape = match part.shape {
        ArmPart::BOX => PartShape::Box([x, y, z].map(cut)),
        ArmPart::CYLINDER => PartShape::Cylinder([0.5 * x, z].map(cut)),
        ArmPart::SPHERE => PartShape::Sphere(cut(0.5 * x)),
        ArmPart::CAPSULE => PartShape::Capsule([0.5 * x, z].map(cut)),
        ArmPart::MESH => {
            let n = part.points.len() / 3;
            let known = |corner: &u32| usize::try_from(*corner).is_ok_and(|corner| corner < n);
            if !part.points.len().is_multiple_of(3)
                || !part.triangles.len().is_multiple_of(3)
                || !part.triangles.iter().all(known)
            {
                return Err(format!("the triangles of a mesh with {n} corners do not fit"));
            }
            // A convex mesh of n corners has 2 n - 4 triangles.
            if part.triangles.len() / 3 > 2 * n {
                return Err(format!("a mesh of {n} corners has {} triangles", part.triangles.len() / 3));
            }
            PartShape::Mesh { points: rounded(&part.points), triangles: part.triangles.clone() }
        }
        other => return Err(format!("a solid is of kind {other}")),
    };
    Ok(PartView { at: pose(&part.pose), shape })
}

fn motion_view(message: &ArmMotion) -> Result<ArmMotionView, String> {
    let n = message.times_s.len();
    if n > MAX_MOMENTS || message.way_m.len() > 3 * MAX_MOMENTS {
        return Err(format!(
            "it has {n} moments and {} points; {MAX_MOMENTS} of each are drawn",
            message.way_m.len() / 3
        ));
    }
    let each = message.poses.len().checked_div(n).unwrap_or(0);
    if !each.is_multiple_of(POSE) || each * n != message.poses.len() || each > POSE * MAX_LINKS {
        return Err(format!("{} numbers are no poses at {n} moments", message.poses.len()));
    }
    let target = object_from_message(&message.target).ok().map(|object| object_view(&object));
    let is_there = |of: &ObjectView| {
        let sizes = [of.size_x_m, of.size_y_m, of.size_z_m];
        sizes.iter().all(|size| size.is_finite() && *size > 0.0) && (of.x_m + of.y_m + of.yaw_rad).is_finite()
    };
    let pick = &message.pick.position;
    Ok(ArmMotionView {
        held_s: [message.held_from_s, message.held_until_s].map(cut),
        pick: [pick.x, pick.y, pick.z].iter().all(|m| m.is_finite()).then(|| pose(&message.pick)),
        revision: message.revision,
        times_s: message.times_s.iter().map(|s| cut(*s)).collect(),
        poses: message.poses.chunks_exact(each.max(1)).map(rounded).collect(),
        way: message.way_m.iter().map(|m| cut(*m)).collect(),
        target: target.filter(is_there),
        target_z_m: cut(message.target.pose.position.z),
    })
}

fn rounded(numbers: &[f32]) -> Vec<f64> {
    numbers.iter().map(|x| cut(f64::from(*x))).collect()
}

/// What is not finite is drawn at 0.
fn cut(x: f64) -> f64 {
    if x.is_finite() { (x * PRECISION).round() / PRECISION } else { 0.0 }
}

fn pose(at: &Pose) -> [f64; 7] {
    let (p, q) = (&at.position, &at.orientation);
    [p.x, p.y, p.z, q.x, q.y, q.z, q.w].map(cut)
}

#[cfg(test)]
mod tests {
    use super::{ArmPicture, POSE};
    use crate::protocol::Sections;
    use apprentice_msgs::msg::{ArmModel, ArmMotion, ArmPart, ArmPose};
    use proptest::prelude::{any, proptest};

    fn model() -> ArmModel {
        let mesh = ArmPart {
            link: 1,
            shape: ArmPart::MESH,
            points: vec![0.0; 12],
            triangles: vec![0, 1, 2, 1, 2, 3],
            ..ArmPart::default()
        };
        ArmModel {
            robot_hash: "r".into(),
            link_names: vec!["a".into(), "b".into()],
            parts: vec![ArmPart::default(), mesh],
            ..ArmModel::default()
        }
    }

    #[test]
    fn poses_are_shown_once_the_arm_they_are_of_is_known() {
        let mut picture = ArmPicture::default();
        let pose = ArmPose { robot_hash: "r".into(), poses: vec![0.25; 2 * POSE], ..ArmPose::default() };
        assert!(!picture.take_pose(&pose).pose, "of what?");
        let news = picture.take_model(&model()).expect("an arm");
        let mut sections = Sections::default();
        picture.fill(news, &mut sections);
        assert_eq!(sections.arm_pose, Some(Some(vec![0.25; 2 * POSE])));
        assert!(!picture.take_model(&model()).expect("the same").model);
        // Of another robot, or of another number of links.
        assert!(!picture.take_pose(&ArmPose { robot_hash: "other".into(), ..pose.clone() }).pose);
        assert!(!picture.take_pose(&ArmPose { poses: vec![0.5; POSE], ..pose }).pose);
    }

    #[test]
    fn what_cannot_be_drawn_is_refused_with_a_reason() {
        let refused = |change: &dyn Fn(&mut ArmModel)| {
            let mut odd = model();
            change(&mut odd);
            ArmPicture::default().take_model(&odd).expect_err("odd")
        };
        assert!(refused(&|m| m.parts[0].link = 2).contains("link 2 of 2"));
        assert!(refused(&|m| m.parts[0].shape = 9).contains("kind 9"));
        assert!(refused(&|m| m.parts[1].triangles[0] = 4).contains("do not fit"));
        assert!(refused(&|m| m.parts[1].triangles = vec![0; 30]).contains("10 triangles"));
        assert!(refused(&|m| m.parts = vec![ArmPart::default(); 2001]).contains("2001 solids"));
        let odd = ArmMotion { times_s: vec![0.0, 1.0], poses: vec![0.0; 15], ..ArmMotion::default() };
        assert!(ArmPicture::default().take_motion(&odd).expect_err("odd").contains("15 numbers"));
    }

    proptest! {
        #[test]
        fn any_numbers_are_survived(
            poses in proptest::collection::vec(any::<f32>(), 0..40),
            times_s in proptest::collection::vec(any::<f64>(), 0..6),
            way_m in proptest::collection::vec(any::<f64>(), 0..8),
        ) {
            let mut picture = ArmPicture::default();
            picture.take_model(&model()).expect("an arm");
            picture.take_pose(&ArmPose { robot_hash: "r".into(), poses: poses.clone(), ..ArmPose::default() });
            let motion = ArmMotion { robot_hash: "r".into(), times_s, poses, way_m, ..ArmMotion::default() };
            let _ = picture.take_motion(&motion);
            let mut sections = Sections::default();
            picture.fill(super::ArmNews::ALL, &mut sections);
            let text = serde_json::to_string(&sections).expect("finite numbers");
            assert!(!text.contains("NaN"));
        }
    }
}
