//! What there is to say about a robot.

use crate::{Robot as Arguments, RobotError, inputs};
use arm::{Checker, CollisionModel, Isometry3, Problem, Robot, World};
use std::sync::Arc;

/// Everything that the command found.
#[derive(Debug)]
pub struct Answer {
    /// The robot.
    pub robot: Arc<Robot>,
    /// What is odd about it, its SRDF or the joint positions.
    pub problems: Vec<Problem>,
    /// Number of pairs of links that are tested for contact.
    pub n_pairs: usize,
    /// Of how many that can move against each other.
    pub n_movable_pairs: usize,
    /// Whether an SRDF said which to leave out.
    pub by_srdf: bool,
    /// One for each object of the joints' file; at 0 without one.
    pub postures: Vec<Posture>,
    /// Whether the file held a list.
    pub is_list: bool,
}

/// The robot in one configuration.
#[derive(Debug)]
pub struct Posture {
    /// Positions of the driven joints.
    pub q: Vec<f64>,
    /// root_from_link of every link.
    pub poses: Vec<Isometry3<f64>>,
    /// Pairs of links that touch, by index, sorted.
    pub contacts: Vec<(usize, usize)>,
    /// The two tested links nearest to each other, and their distance, metres.
    pub nearest: Option<((usize, usize), f64)>,
}

/// Reads and checks everything.
///
/// # Errors
/// Inputs that cannot be used.
pub fn answer(arguments: &Arguments) -> Result<Answer, RobotError> {
    let robot = inputs::robot(arguments)?;
    let (exclusions, mut odd) = inputs::exclusions(arguments, &robot)?;
    let (named, is_list) = inputs::postures(arguments.joints.as_deref(), &robot)?;
    let mut problems = robot.problems.clone();
    problems.append(&mut odd);
    let model = CollisionModel::new(&robot, &exclusions);
    let n_pairs = model.n_pairs();
    let n_movable_pairs = n_movable_pairs(&robot);
    let robot = Arc::new(robot);
    let mut checker = Checker::new(Arc::clone(&robot), Arc::new(model));
    let world = World::new();
    let mut postures = Vec::with_capacity(named.len());
    for (i, positions) in named.iter().enumerate() {
        let found = robot.configuration(positions.iter().map(|(name, position)| (name.as_str(), *position)));
        note(&found, if is_list { format!("posture {i}: ") } else { String::new() }, &robot, &mut problems);
        let links = |contact: arm::Contact| match (contact.a, contact.b) {
            (arm::Body::Link(a), arm::Body::Link(b)) => (a, b),
            other => unreachable!("nothing but links is there: {other:?}"),
        };
        let contacts = checker.contacts(&found.q, &world, 0.0).into_iter().map(links).collect();
        let nearest = checker.nearest(&found.q, &world, 10.0).map(|(contact, distance)| (links(contact), distance));
        let poses = checker.poses(&found.q).to_vec();
        postures.push(Posture { q: found.q, poses, contacts, nearest });
    }
    let by_srdf = arguments.srdf.is_some() && !arguments.all_pairs;
    Ok(Answer { robot, problems, n_pairs, n_movable_pairs, by_srdf, postures, is_list })
}

/// What is odd about positions that were given; what was not given is 0 and no oddity.
fn note(found: &arm::NamedPositions, place: String, robot: &Robot, problems: &mut Vec<Problem>) {
    for name in &found.outside {
        let joint = robot.joints.iter().find(|joint| joint.name == *name);
        let limits = joint.map_or((0.0, 0.0), |joint| (joint.limits.lower, joint.limits.upper));
        problems.push(Problem {
            line: 0,
            what: format!("{place}joint '{name}' is outside of its limits [{}, {}]", limits.0, limits.1),
            advice: "the answer is for the position as given".into(),
        });
    }
    for name in &found.astray {
        problems.push(Problem {
            line: 0,
            what: format!("{place}joint '{name}' mimics another, which puts it elsewhere than was given"),
            advice: "the answer is for where its leader puts it".into(),
        });
    }
}

fn n_movable_pairs(robot: &Robot) -> usize {
    let groups = robot.rigid_groups();
    let solid: Vec<usize> = (0..robot.links.len()).filter(|&link| !robot.links[link].solids.is_empty()).collect();
    let pairs = solid.iter().enumerate().flat_map(|(i, &a)| solid[i + 1..].iter().map(move |&b| (a, b)));
    pairs.filter(|&(a, b)| groups[a] != groups[b]).count()
}
