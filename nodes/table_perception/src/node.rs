//! The node as a state machine: detections, poses and transforms in; one scene out.

use crate::frames::{Frames, isometry_of_pose};
use crate::settings::Settings;
use crate::sighting::{Elsewhere, Sighting, Table, matched};
use apprentice_msgs::builtin_interfaces::Time;
use apprentice_msgs::geometry_msgs::{Pose, PoseStamped};
use apprentice_msgs::msg::TableScene;
use apprentice_msgs::std_msgs::Header;
use apprentice_msgs::tf2_msgs::TFMessage;
use apprentice_msgs::vision_msgs::{Detection3D, Detection3DArray};
use arm::Isometry3;
use exchange::{pose_at, scene_to_message};
use scene::{ListError, Object, Scene, Shape};

/// More detections of one message are not looked at.
const MAX_DETECTIONS: usize = 1000;

/// What reaches the node.
#[derive(Debug, Clone)]
pub enum Event {
    /// What a detector sees.
    Detections(Box<Detection3DArray>),
    /// Where a tracker sees the object of this number.
    Pose(usize, Box<PoseStamped>),
    /// Where a tracker sees the thing to place.
    TargetPose(Box<PoseStamped>),
    /// Where frames are.
    Transforms(Box<TFMessage>),
    /// Twice a second.
    Tick,
}

/// What the node sends.
#[derive(Debug, Clone, PartialEq)]
pub enum Output {
    /// The table.
    Scene(Box<TableScene>),
    /// Where the thing to place stands: the middle of its base, upright, in the table's frame.
    TargetPose(PoseStamped),
    /// Whether all is well, and in words what is seen or missing.
    Status(bool, String),
}

/// Something that was seen.
#[derive(Debug, Clone, Copy)]
struct Seen {
    sighting: Sighting,
    /// When it was heard of, by the node's clock.
    heard: Time,
    /// When it was seen, by the sender's clock.
    stamp: Time,
}

/// See the crate.
#[derive(Debug)]
pub struct TablePerceptionNode {
    settings: Settings,
    /// Everything at the origin.
    known: Scene,
    table: Table,
    frames: Frames,
    seen: Vec<Option<Seen>>,
    /// As it was said last, and the stamp it was said with.
    said: Option<(Scene, Time)>,
    status: Option<(bool, String)>,
    /// What keeps things from being seen, in words.
    trouble: Option<String>,
    ticks: u32,
}

/// The scene is said again with every so many ticks.
const AGAIN_EVERY: u32 = 4;

impl TablePerceptionNode {
    /// A node that has seen nothing.
    ///
    /// # Errors
    /// Lists that do not fit together.
    pub fn new(settings: Settings) -> Result<Self, ListError> {
        let known = settings.scene()?;
        Ok(Self {
            table: Table {
                width_m: settings.table_width_m,
                depth_m: settings.table_depth_m,
                reach_m: settings.reach_m,
                max_tilt_rad: settings.max_tilt_rad,
            },
            frames: Frames::default(),
            seen: vec![None; known.objects.len()],
            said: None,
            status: None,
            trouble: None,
            ticks: 0,
            known,
            settings,
        })
    }

    /// Takes one event.
    pub fn step(&mut self, now: Time, event: Event) -> Vec<Output> {
        match event {
            Event::Transforms(message) => {
                self.frames.take(&message);
                return Vec::new();
            }
            Event::Detections(message) => {
                let target = self.detections(now, &message);
                return target.into_iter().chain(self.say(now, false)).collect();
            }
            Event::TargetPose(message) => {
                self.trouble = None;
                let (header, name) = (&message.header, self.known.target.label.clone());
                let seen = self.target(&name, header.stamp, &header.frame_id, &message.pose);
                return seen.into_iter().chain(self.say(now, false)).collect();
            }
            Event::Pose(i, message) => self.pose(now, i, &message),
            Event::Tick => {
                self.ticks += 1;
                let again = self.ticks.is_multiple_of(AGAIN_EVERY);
                return self.say(now, again);
            }
        }
        self.say(now, false)
    }

    /// Takes note of what is seen; where the thing to place stands is told at once.
    fn detections(&mut self, now: Time, message: &Detection3DArray) -> Option<Output> {
        self.trouble = None;
        let mut target: Option<(f64, String, Pose)> = None;
        let mut by_class: Vec<(String, Vec<Sighting>)> = Vec::new();
        for detection in message.detections.iter().take(MAX_DETECTIONS) {
            let Some((class, score, pose)) = self.best(detection) else { continue };
            let own = &detection.header.frame_id;
            let frame = if own.is_empty() { &message.header.frame_id } else { own };
            if self.of_class(&class).is_empty() {
                // There is one thing to place: the most probable one.
                if target.as_ref().is_none_or(|(known, ..)| score > *known) {
                    target = Some((score, frame.clone(), pose));
                }
                continue;
            }
            let Some(sighting) = self.sight(&class, frame, &pose) else { continue };
            match by_class.iter_mut().find(|(known, _)| *known == class) {
                Some((_, seen)) => seen.push(sighting),
                None => by_class.push((class, vec![sighting])),
            }
        }
        let stamp = message.header.stamp;
        for (class, sightings) in by_class {
            let things: Vec<usize> = self.of_class(&class);
            let before: Vec<_> = things.iter().map(|&i| self.seen[i].map(|seen| seen.sighting.at)).collect();
            for (i, sighting) in things.into_iter().zip(matched(&before, &sightings)) {
                if let Some(sighting) = sighting {
                    self.seen[i] = Some(Seen { sighting, heard: now, stamp });
                }
            }
        }
        let name = self.known.target.label.clone();
        target.and_then(|(_, frame, pose)| self.target(&name, stamp, &frame, &pose))
    }

    /// Where the thing to place stands, its middle being at a pose.
    fn target(&mut self, name: &str, stamp: Time, frame: &str, pose: &Pose) -> Option<Output> {
        let pose = self.in_table_frame(name, frame, pose)?;
        let seen = self.table.sight_nearby(&pose);
        let ([x, y, z], yaw_rad) = self.or_trouble(name, seen)?;
        let header = Header { stamp, frame_id: self.settings.frame.clone() };
        let base_m = z - 0.5 * self.known.target.shape.height_m();
        Some(Output::TargetPose(PoseStamped { header, pose: pose_at([x, y, base_m], yaw_rad) }))
    }

    fn pose(&mut self, now: Time, i: usize, message: &PoseStamped) {
        let Some(object) = self.known.objects.get(i) else { return };
        let name = object.label.clone();
        self.trouble = None;
        if let Some(sighting) = self.sight(&name, &message.header.frame_id, &message.pose) {
            self.seen[i] = Some(Seen { sighting, heard: now, stamp: message.header.stamp });
        }
    }

    /// Class, score and pose of the most probable hypothesis, when it is probable enough and about something that is known.
    fn best(&self, detection: &Detection3D) -> Option<(String, f64, Pose)> {
        let scored = detection.results.iter().filter(|result| result.hypothesis.score.is_finite());
        let best = scored.max_by(|a, b| a.hypothesis.score.total_cmp(&b.hypothesis.score))?;
        let class = &best.hypothesis.class_id;
        let is_known = !self.of_class(class).is_empty() || class == self.settings.target_class();
        if best.hypothesis.score < self.settings.min_score || !is_known {
            return None;
        }
        // Many detectors say where the box is and leave the pose empty.
        let pose = if says_nothing(&best.pose.pose) { detection.bbox.center } else { best.pose.pose };
        Some((class.clone(), best.hypothesis.score, pose))
    }

    fn of_class(&self, class: &str) -> Vec<usize> {
        let objects = self.known.objects.iter().enumerate();
        objects.filter(|(i, object)| self.settings.class(*i, object) == class).map(|(i, _)| i).collect()
    }

    /// A pose on the table; what keeps it from being one is remembered as trouble, unless it is simply elsewhere.
    fn sight(&mut self, name: &str, frame: &str, pose: &Pose) -> Option<Sighting> {
        let pose = self.in_table_frame(name, frame, pose)?;
        let seen = self.table.sight(&pose);
        self.or_trouble(name, seen)
    }

    fn in_table_frame(&mut self, name: &str, frame: &str, pose: &Pose) -> Option<Isometry3<f64>> {
        let table = &self.settings.frame;
        let Some(of_frame) = self.frames.between(table, frame) else {
            self.trouble = Some(format!("tf does not connect '{}' with '{table}'", short(frame)));
            return None;
        };
        let Some(pose) = isometry_of_pose(pose) else {
            self.trouble = Some(format!("the pose of '{}' is not finite, or has no direction", short(name)));
            return None;
        };
        Some(of_frame * pose)
    }

    fn or_trouble<T>(&mut self, name: &str, seen: Result<T, Elsewhere>) -> Option<T> {
        match seen {
            Ok(seen) => Some(seen),
            Err(Elsewhere::Off) => None,
            Err(Elsewhere::Tilted(by_rad)) => {
                self.trouble = Some(format!("'{}' is tilted by {:.0} degrees", short(name), by_rad.to_degrees()));
                None
            }
        }
    }

    fn say(&mut self, now: Time, again: bool) -> Vec<Output> {
        let forget_ns = (self.settings.forget_s * 1e9) as i128;
        let is_there = |seen: &Option<Seen>| {
            // A clock that jumped back forgets nothing.
            seen.as_ref().is_some_and(|seen| now.nanoseconds_since(&seen.heard) <= forget_ns)
        };
        let missing: Vec<String> = (self.known.objects.iter().zip(&self.seen))
            .filter(|(_, seen)| !is_there(seen))
            .map(|(object, _)| object.label.clone())
            .collect();
        let mut outputs = Vec::new();
        // The first scene says what the lesson is about, so it waits for everything; later a thing may go.
        if missing.is_empty() || self.said.is_some() {
            let standing = self.known.objects.iter().zip(&self.seen).filter(|(_, seen)| is_there(seen));
            let objects: Vec<Object> = standing
                .filter_map(|(object, seen)| {
                    let Sighting { at, yaw_rad } = seen.as_ref()?.sighting;
                    Some(Object { position_m: at, yaw_rad, ..object.clone() })
                })
                .collect();
            let stamp = self.seen.iter().flatten().map(|seen| seen.stamp).max_by_key(Time::nanoseconds);
            let scene = Scene { objects, ..self.known.clone() };
            let is_news = self.said.as_ref().is_none_or(|(said, _)| !self.is_still(said, &scene));
            if is_news {
                self.said = Some((scene, stamp.unwrap_or(now)));
            }
            if is_news || again {
                let said = self.said.iter().map(|(scene, stamp)| scene_to_message(scene, *stamp));
                outputs.extend(said.map(|message| Output::Scene(Box::new(message))));
            }
        }
        let status = match (&self.trouble, missing.is_empty()) {
            (None, true) => (true, format!("all {} things are seen", self.known.objects.len())),
            (trouble, _) => {
                let unseen = (!missing.is_empty()).then(|| format!("not seen: {}", missing.join(", ")));
                (false, unseen.into_iter().chain(trouble.clone()).collect::<Vec<_>>().join("; "))
            }
        };
        if self.status.as_ref() != Some(&status) {
            self.status = Some(status.clone());
            outputs.push(Output::Status(status.0, status.1));
        }
        outputs
    }

    /// Whether two tables are the same but for the noise of perception.
    fn is_still(&self, said: &Scene, scene: &Scene) -> bool {
        let near = |a: &Object, b: &Object| {
            let moved_m = (a.position_m.x - b.position_m.x).hypot(a.position_m.y - b.position_m.y);
            let turned_rad = (a.yaw_rad - b.yaw_rad).sin().atan2((a.yaw_rad - b.yaw_rad).cos()).abs();
            let may_turn = matches!(a.shape, Shape::Cylinder { .. });
            a.id == b.id && moved_m <= self.settings.still_m && (may_turn || turned_rad <= self.settings.still_rad)
        };
        said.objects.len() == scene.objects.len() && said.objects.iter().zip(&scene.objects).all(|(a, b)| near(a, b))
    }
}

/// Whether a pose was left as it is made: at the origin, not turned.
fn says_nothing(pose: &Pose) -> bool {
    let (at, turn) = (&pose.position, &pose.orientation);
    [at.x, at.y, at.z, turn.x, turn.y, turn.z].iter().all(|v| *v == 0.0)
}

/// Others' text, cut.
fn short(text: &str) -> String {
    text.chars().take(64).collect()
}
