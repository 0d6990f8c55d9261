//! The answer as a page to read.

use crate::{Answer, Posture, tree};
use arm::{Chain, JointKind, Robot};
use std::fmt::Write;

/// Problems and postures listed one by one; more are counted.
const MOST_LISTED: usize = 40;

pub(crate) fn answer(answer: &Answer) -> String {
    let robot = &answer.robot;
    let count = |kind: JointKind| robot.joints.iter().filter(|joint| joint.kind == kind).count();
    let name = if robot.name.is_empty() { "(no name)" } else { &robot.name };
    let mut text = format!(
        "{name}: {} links, {} joints ({} revolute, {} continuous, {} prismatic, {} fixed), {} of them driven\n\n",
        robot.links.len(),
        robot.joints.len(),
        count(JointKind::Revolute),
        count(JointKind::Continuous),
        count(JointKind::Prismatic),
        count(JointKind::Fixed),
        robot.dof()
    );
    text += "Tree: joint → link, limits, shape for collisions\n";
    text += &tree::draw(robot);
    text += "\nArms: the longest chains of joints to a last link\n";
    text += &arms(robot);
    problems(answer, &mut text);
    let list = if answer.by_srdf { "the SRDF" } else { "sampling" };
    // A string takes all that is written to it.
    let _ = write!(
        text,
        "\nPairs of links tested for contact: {} of {} that can move against each other (neighbours left out, and more by {list})\n",
        answer.n_pairs, answer.n_movable_pairs
    );
    for (i, posture) in answer.postures.iter().enumerate().take(MOST_LISTED) {
        posture_words(answer, i, posture, &mut text);
    }
    if answer.postures.len() > MOST_LISTED {
        let touching = answer.postures.iter().filter(|posture| !posture.contacts.is_empty()).count();
        let _ = writeln!(
            text,
            "… {} postures in all, {touching} with links that touch; --json has them all",
            answer.postures.len()
        );
    }
    text
}

fn arms(robot: &Robot) -> String {
    let is_last = |link: usize| robot.joints.iter().all(|joint| joint.parent != link);
    let last = (0..robot.links.len()).filter(|&link| is_last(link));
    let mut chains: Vec<(usize, String)> = last
        .filter_map(|link| {
            let name = &robot.links[link].name;
            let chain = Chain::new(robot, name).ok()?;
            let n = chain.entries.len();
            let reach = chain.levers.iter().copied().fold(0.0, f64::max);
            Some((n, format!("  {name}: {n} joints, reaches at most {reach:.3} m\n")))
        })
        .collect();
    // The longest first, the order of the text among equals.
    chains.sort_by_key(|(n, _)| std::cmp::Reverse(*n));
    if chains.is_empty() {
        return "  none: no joint moves\n".into();
    }
    chains.into_iter().take(6).map(|(_, line)| line).collect()
}

fn problems(answer: &Answer, text: &mut String) {
    let problems = &answer.problems;
    if problems.is_empty() {
        *text += "\nNothing odd was found.\n";
        return;
    }
    let _ = writeln!(text, "\nTo look at: {}", problems.len());
    for problem in problems.iter().take(MOST_LISTED) {
        let line = if problem.line > 0 { format!("line {}: ", problem.line) } else { String::new() };
        let _ = writeln!(text, "  {line}{}\n      → {}", problem.what, problem.advice);
    }
    if problems.len() > MOST_LISTED {
        let _ = writeln!(text, "  … and {} more; --json has them all", problems.len() - MOST_LISTED);
    }
}

fn posture_words(answer: &Answer, i: usize, posture: &Posture, text: &mut String) {
    let robot = &answer.robot;
    let at = if answer.is_list { format!("In posture {i}") } else { "In this posture".into() };
    let name = |link: usize| robot.links[link].name.as_str();
    let _ = match (&posture.contacts[..], posture.nearest) {
        ([], None) => writeln!(text, "{at} no links touch."),
        ([], Some(((a, b), distance))) => {
            writeln!(
                text,
                "{at} no links touch; nearest are {} and {}, {:.1} mm apart.",
                name(a),
                name(b),
                1e3 * distance
            )
        }
        (contacts, _) => {
            let pairs: Vec<String> = contacts.iter().map(|&(a, b)| format!("{} – {}", name(a), name(b))).collect();
            writeln!(text, "{at} {} pairs of links touch: {}", contacts.len(), pairs.join(", "))
        }
    };
    if !answer.is_list {
        *text += "\nWhere the links are: x y z (m), qx qy qz qw\n";
        let width = robot.links.iter().map(|link| link.name.chars().count()).max().unwrap_or(0);
        for (link, pose) in robot.links.iter().zip(&posture.poses) {
            let (t, r) = (&pose.translation.vector, &pose.rotation.coords);
            let padding = " ".repeat(width - link.name.chars().count());
            let numbers = [t.x, t.y, t.z].map(|v| format!(" {:8.4}", tidy(v, 5e-5))).concat();
            let turn = [r.x, r.y, r.z, r.w].map(|v| format!(" {:8.5}", tidy(v, 5e-6))).concat();
            let _ = writeln!(text, "  {}{padding} {numbers} {turn}", link.name);
        }
    }
}

/// What would be shown as 0 is 0: there is no minus 0 to read.
fn tidy(value: f64, smallest: f64) -> f64 {
    if value.abs() < smallest { 0.0 } else { value }
}
