//! Picking the target up: empty-handed over it, straight down, and with it straight up again; every part proven free.

use crate::manipulator::{Cell, solid, under};
use crate::motion::{MOST_POSTURES, POSTURE_RESTARTS, Pace, rise};
use crate::space::ArmSpace;
use arm::{Goal, IkSettings, Isometry3, Obstacle, Placed, Translation3, Vector3, about_axis, about_z, solutions};
use motion::Path;
use scene::{Point, Scene, Shape};
use std::f64::consts::PI;

/// Where the target is before it is placed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Source {
    /// In the hand.
    Hand,
    /// It stands somewhere and has to be picked up.
    Stands(Stand),
    /// It has to be picked up, but nobody knows where it is.
    Unknown,
}

/// Where a thing stands, upright.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stand {
    /// The middle of its base, metres in the table's frame.
    pub at_m: Point,
    /// Height of its base above the table, metres.
    pub base_m: f64,
    /// How it is turned about the vertical, radians.
    pub yaw_rad: f64,
}

/// How the target gets into the hand.
pub(crate) struct Picked {
    /// Empty-handed, from where the arm is to the grasp.
    pub approach: motion::Trajectory,
    /// With the target, straight up.
    pub up: motion::Trajectory,
    /// The whole robot then.
    pub risen: Vec<f64>,
}

impl Cell<'_> {
    /// The same with an empty hand, and the target standing in the way of all of the arm.
    pub fn beside(&self, scene: &Scene, stand: &Stand) -> Self {
        let mut cell = self.clone();
        cell.world.let_go();
        let (solid, root_from_solid) = (solid(&scene.target), self.standing(scene, stand));
        cell.world.add(Obstacle { name: scene.target.id.clone(), solid, root_from_solid });
        cell
    }

    /// The same with an empty hand that is about the standing target: only the rest of the arm must keep off it.
    pub fn around(&self, scene: &Scene, stand: &Stand) -> Self {
        let mut cell = self.clone();
        // What the root holds stands still.
        let placed = Placed { solid: solid(&scene.target), owner_from_solid: self.standing(scene, stand) };
        let robot = self.manipulator.robot();
        let touched =
            (0..robot.links.len()).map(|link| self.manipulator.hand()[link] || robot.fixed_pose(link).is_some());
        cell.world.hold(&scene.target.id, 0, placed, touched.collect());
        let names: Vec<String> = cell.world.obstacle_names().map(str::to_owned).collect();
        names.iter().for_each(|name| cell.world.let_held_touch(name));
        cell
    }

    /// The same with the target in the hand, which may still touch what it stood on.
    fn lifting(&self, scene: &Scene, stand: &Stand) -> Self {
        let mut cell = self.clone();
        std::iter::once("table")
            .chain(under(scene, stand.at_m).map(|object| object.id.as_str()))
            .for_each(|name| cell.world.let_held_touch(name));
        cell
    }

    fn standing(&self, scene: &Scene, stand: &Stand) -> Isometry3<f64> {
        let middle = Translation3::new(stand.at_m.x, stand.at_m.y, stand.base_m + 0.5 * scene.target.shape.height_m());
        self.root_from_table * Isometry3::from_parts(middle, about_z(stand.yaw_rad))
    }

    /// Where the hand is when it is about the standing target, or `up_m` higher: any way round a round thing, either way round
    /// a box.
    fn about(&self, scene: &Scene, stand: &Stand, up_m: f64) -> Vec<Goal> {
        match scene.target.shape {
            Shape::Cylinder { .. } => vec![self.goal(stand.at_m, stand.base_m + up_m)],
            Shape::Box { .. } => {
                let turn_rad = self.grasp.as_ref().map_or(0.0, |grasp| grasp.turn_rad);
                let at = Translation3::new(stand.at_m.x, stand.at_m.y, stand.base_m + up_m + self.grip_height_m);
                let down = about_axis(&Vector3::x_axis(), PI);
                [turn_rad, turn_rad + PI]
                    .map(|turn| {
                        let table_from_tool = Isometry3::from_parts(at, about_z(stand.yaw_rad + turn) * down);
                        Goal::Pose(self.root_from_table * table_from_tool)
                    })
                    .into()
            }
        }
    }

    /// How what is held is turned about the vertical in a configuration, radians in the table's frame.
    pub fn heading_rad(&self, q: &[f64]) -> f64 {
        let x_axis = self.root_from_table.rotation.inverse() * self.chain.tool_pose(q).rotation * Vector3::x();
        libm::atan2(x_axis.y, x_axis.x) - self.grasp.as_ref().map_or(0.0, |grasp| grasp.turn_rad)
    }
}

/// Plans how the target is picked up from where it stands; `cell` holds it, `current` is the whole robot with an open gripper.
///
/// # Errors
/// In words: why it cannot be picked up there.
pub(crate) fn pick(cell: &Cell, scene: &Scene, stand: &Stand, current: &[f64]) -> Result<Picked, String> {
    let label = &scene.target.label;
    let at = format!("({:.3}, {:.3}) m", stand.at_m.x, stand.at_m.y);
    let manipulator = cell.manipulator;
    let (robot, settings) = (manipulator.robot(), &manipulator.settings);
    let (beside, around, lifting) = (cell.beside(scene, stand), cell.around(scene, stand), cell.lifting(scene, stand));
    let (mut down_space, mut up_space) = (ArmSpace::new(&around, current), ArmSpace::new(&lifting, current));
    let ik = IkSettings { restarts: POSTURE_RESTARTS, seed: settings.seed, ..IkSettings::default() };
    let mut checker = manipulator.checker();
    let mut touched = None;
    let mut solved = false;
    // The way down, turned round, and the way up with the target: the same line, which may end at another height.
    let mut ways: Vec<(Path, Path)> = Vec::new();
    for (which, goal) in cell.about(scene, stand, 0.0).iter().enumerate() {
        let higher = |up_m: f64| cell.about(scene, stand, up_m)[which];
        for q in solutions(robot, &cell.chain, goal, current, &ik, MOST_POSTURES) {
            solved = true;
            if !around.is_free(&q, &mut checker) {
                touched = touched.or_else(|| around.contact(&q));
                continue;
            }
            if !lifting.is_free(&q, &mut checker) {
                touched = touched.or_else(|| lifting.contact(&q));
                continue;
            }
            let down = rise(&mut down_space, &q, higher);
            ways.extend(down.and_then(|down| Some((down, rise(&mut up_space, &q, higher)?))));
        }
    }
    if ways.is_empty() {
        return Err(match touched {
            _ if !solved => format!("'{label}' stands at {at}, out of the arm's reach"),
            Some((a, b)) => format!("'{label}' cannot be picked up at {at}: '{a}' would touch '{b}'"),
            None => format!("'{label}' cannot be picked up at {at}: there is no way straight up"),
        });
    }
    let none = || format!("no collision-free motion leads to '{label}' at {at}");
    let pace = Pace::new(cell, current).ok_or_else(none)?;
    let mut over_space = ArmSpace::new(&beside, current);
    let tops: Vec<Vec<f64>> = ways.iter().map(|(down, _)| down.end().to_vec()).collect();
    let over = pace.way(&mut over_space, current, &tops).ok_or_else(none)?;
    let (down, up) = ways.iter().find(|(down, _)| down.end() == over.end()).ok_or_else(none)?;
    let mut approach = pace.timed(&mut over_space, &over).ok_or_else(none)?;
    approach.append(&pace.timed(&mut down_space, &down.reversed()).ok_or_else(none)?, 0.0);
    let timed_up = pace.timed(&mut up_space, up).ok_or_else(none)?;
    let mut risen = current.to_vec();
    for (&entry, &at) in manipulator.chain.entries.iter().zip(up.end()) {
        risen[entry] = at;
    }
    Ok(Picked { approach, up: timed_up, risen })
}
