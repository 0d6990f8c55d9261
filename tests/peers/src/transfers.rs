//! A Panda that carries a thing from one place among the things on a table to another: the same for the same seed.

use std::path::PathBuf;
use std::sync::Arc;

use arm::{
    AxisGoal, Chain, Checker, CollisionModel, Goal, IkSettings, Isometry3, Placed, Point3, Robot, Translation3,
    Vector3, World, about_z, solutions,
};
use placement::{MotionSettings, TABLE_THICKNESS_M};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use scene::{Point, Scene, Shape};

use crate::arm::{Object, described, interpreter, positions, robot_error, share, solid, uniform, world};
use crate::error::PeersError;
use crate::plans::{Bench, panda};

/// The thing is carried at least this far, metres.
const FAR_M: f64 = 0.3;
/// Pairs of places that are drawn in a scene before the next is taken.
const TRIES: usize = 40;
/// Configurations over a place, of which the first that touches nothing is taken.
const POSTURES: usize = 6;

/// The arm, the table, and how far it keeps from things.
pub(crate) struct Carrier {
    pub robot: Arc<Robot>,
    pub model: Arc<CollisionModel>,
    pub chain: Chain,
    pub settings: MotionSettings,
    bench: Bench,
    share: PathBuf,
    /// Which links may touch what is held.
    hand: Vec<bool>,
    home: Vec<f64>,
    root_from_table: Isometry3<f64>,
}

/// One motion to plan.
pub(crate) struct Transfer {
    /// The table, then what stands on it.
    pub objects: Vec<Object>,
    /// What is held, in the frame of the tool.
    pub held: Object,
    pub world: World,
    /// Configurations of the whole robot that touch nothing.
    pub start: Vec<f64>,
    pub goal: Vec<f64>,
}

impl Carrier {
    /// The Panda behind the table of `peers -- plans`.
    pub fn new() -> Result<Self, PeersError> {
        let bench = panda()?;
        let robot = Arc::new(bench.robot.clone());
        let exclusions = bench.exclusions.clone().unwrap_or_default();
        let model = Arc::new(CollisionModel::new(&robot, &exclusions));
        let chain = Chain::new(&robot, bench.tool).map_err(robot_error)?;
        let mut home = robot.rest();
        for (name, at) in &bench.home {
            if let Some(entry) = robot.joint_names().position(|joint| joint == name) {
                home[entry] = *at;
            }
        }
        let Some(table) = bench.table else {
            return Err(PeersError::Robot { problem: "it stands at no table; give its bench one".into() });
        };
        let [x, y, z] = table.position_m;
        let root_from_table = Isometry3::from_parts(Translation3::new(x, y, z), about_z(table.yaw_rad));
        let hand = chain.hand(&robot);
        let settings = MotionSettings::default();
        Ok(Self { robot, model, chain, settings, bench, share: share(&interpreter())?, hand, home, root_from_table })
    }

    /// One for each thread.
    pub fn checker(&self) -> Checker {
        Checker::new(Arc::clone(&self.robot), Arc::clone(&self.model))
    }

    /// The planned joints of a configuration.
    pub fn part(&self, q: &[f64]) -> Vec<f64> {
        self.chain.entries.iter().map(|&entry| q[entry]).collect()
    }

    /// The configuration with those joints elsewhere.
    pub fn moved_to(&self, q: &[f64], part: &[f64]) -> Vec<f64> {
        let mut whole = q.to_vec();
        self.chain.entries.iter().zip(part).for_each(|(&entry, at)| whole[entry] = *at);
        whole
    }

    /// The first `n` transfers of a seed, at most one in a scene.
    pub fn transfers(&self, seed: u64, n: usize) -> Vec<Transfer> {
        (0..4 * n as u64).filter_map(|scene| self.transfer(seed, scene)).take(n).collect()
    }

    fn transfer(&self, seed: u64, number: u64) -> Option<Transfer> {
        let scene = self.bench.problem(seed, number, 1).scene;
        let height_m = scene.target.shape.height_m();
        let grip_m = height_m - self.settings.grip_m.min(0.5 * height_m);
        let held = object(&scene.target.shape, [0.0, 0.0, grip_m - 0.5 * height_m], 0.0);
        let objects = self.objects(&scene);
        let mut world = world(&objects);
        let [x, y, z] = held.at;
        let placed = Placed { solid: solid(&held), owner_from_solid: Isometry3::translation(x, y, z) };
        world.hold("target", self.chain.tool, placed, self.hand.clone());
        let occupied = scene.occupied();
        // Other numbers than those the scene itself was drawn from.
        let mut rng = ChaCha8Rng::seed_from_u64(seed ^ 0x7a5f_0e11);
        rng.set_stream(number);
        let mut checker = self.checker();
        for _ in 0..TRIES {
            let [from, to] =
                [(); 2].map(|()| Point::new(scene.width_m * uniform(&mut rng), scene.depth_m * uniform(&mut rng)));
            if from.distance(to) < FAR_M || !occupied.is_free(from) || !occupied.is_free(to) {
                continue;
            }
            let mut over = |at_m: Point, near: &[f64]| {
                let goal = self.over(at_m, self.settings.release_m + grip_m);
                let ik = IkSettings { seed, ..IkSettings::default() };
                let found = solutions(&self.robot, &self.chain, &goal, near, &ik, POSTURES);
                found.into_iter().find(|q| checker.is_free(q, &world, self.settings.margin_m))
            };
            let Some(start) = over(from, &self.home) else { continue };
            let Some(goal) = over(to, &start) else { continue };
            return Some(Transfer { objects, held, world, start, goal });
        }
        None
    }

    /// The tool pointing down, so high above a point of the table.
    fn over(&self, at_m: Point, height_m: f64) -> Goal {
        let position = (self.root_from_table * Point3::new(at_m.x, at_m.y, height_m)).coords;
        Goal::Axis(AxisGoal { position, direction: self.root_from_table.rotation * -Vector3::z_axis() })
    }

    fn objects(&self, scene: &Scene) -> Vec<Object> {
        let yaw = self.bench.table.map_or(0.0, |table| table.yaw_rad);
        let at = |x: f64, y: f64, z: f64| <[f64; 3]>::from((self.root_from_table * Point3::new(x, y, z)).coords);
        let (width, depth) = (scene.width_m, scene.depth_m);
        let middle = at(0.5 * width, 0.5 * depth, -0.5 * TABLE_THICKNESS_M);
        let table = Object { shape: "box", size: vec![width, depth, TABLE_THICKNESS_M], at: middle, yaw };
        let things = scene.objects.iter().map(|thing| {
            let Point { x, y } = thing.position_m;
            object(&thing.shape, at(x, y, 0.5 * thing.shape.height_m()), yaw + thing.yaw_rad)
        });
        std::iter::once(table).chain(things).collect()
    }

    /// The arm and all transfers as the Python program takes them.
    pub fn request(&self, transfers: &[Transfer]) -> serde_json::Value {
        let limits = |entry: &usize| self.robot.driven_joint(*entry).limits;
        let entries = &self.chain.entries;
        let solid_links = (0..self.robot.links.len()).filter(|&link| !self.robot.links[link].solids.is_empty());
        let against: Vec<&str> =
            solid_links.filter(|&link| !self.hand[link]).map(|link| self.robot.links[link].name.as_str()).collect();
        let each = transfers.iter().map(|one| {
            serde_json::json!({
                "objects": one.objects, "held": one.held, "start": self.part(&one.start), "goal": self.part(&one.goal),
            })
        });
        let mut request = described(&self.share, &self.robot, &self.model);
        request["planned"] = self.chain.joint_names(&self.robot).collect();
        request["lower"] = entries.iter().map(|entry| limits(entry).lower).collect();
        request["upper"] = entries.iter().map(|entry| limits(entry).upper).collect();
        request["rest"] = positions(&self.robot, &self.home).into();
        request["tool"] = self.bench.tool.into();
        request["held_against"] = against.into();
        request["margin"] = self.settings.margin_m.into();
        request["transfers"] = each.collect();
        request
    }
}

fn object(shape: &Shape, at: [f64; 3], yaw: f64) -> Object {
    match *shape {
        Shape::Cylinder { radius_m, height_m } => Object { shape: "cylinder", size: vec![radius_m, height_m], at, yaw },
        Shape::Box { width_m, depth_m, height_m } => {
            Object { shape: "box", size: vec![width_m, depth_m, height_m], at, yaw }
        }
    }
}
