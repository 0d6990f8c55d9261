//! Three cells in a row, and questions about them.

use super::table::Table;
use apprentice_msgs::msg::{LessonStatus, TabularWorld, WorldQuery, WorldTrajectory};
use exchange::world_from_message;
use operator_ui::Event;

/// Three cells in a row; the right one is the end.
pub fn cells() -> TabularWorld {
    TabularWorld {
        id: "garden".into(),
        gamma: 0.9,
        n_states: 3,
        n_actions: 2,
        feature_names: vec!["path".into(), "door".into()],
        action_names: vec!["left".into(), "right".into()],
        initial: vec![1.0, 0.0, 0.0],
        from_state: vec![0, 0, 1, 1],
        action: vec![0, 1, 0, 1],
        to_state: vec![0, 1, 0, 2],
        probability: vec![1.0; 4],
        features: vec![1.0, 0.0, 1.0, 0.0, 0.0, 1.0],
        shape: vec![1, 3],
        ..TabularWorld::default()
    }
}

/// A way through the cells.
pub fn way(id: &str, steps: &[(u32, u32)], features: [f64; 2]) -> WorldTrajectory {
    WorldTrajectory {
        id: id.into(),
        states: steps.iter().map(|step| step.0).collect(),
        actions: steps.iter().map(|step| step.1).collect(),
        features: features.to_vec(),
    }
}

/// A question of a kind.
pub fn way_query(revision: u64, kind: u8) -> WorldQuery {
    let name = |letter: &str| format!("w{revision}-{letter}");
    let ways = [way(&name("a"), &[(0, 1), (1, 1), (2, 0)], [1.9, 0.81]), way(&name("b"), &[(0, 0)], [1.0, 0.0])];
    WorldQuery {
        id: format!("w{revision}"),
        revision,
        world: world_from_message(&cells()).expect("a good world").reference(),
        kind,
        trajectories: ways[..usize::from(kind)].to_vec(),
        reason: "What should I do? I may be wrong.".into(),
        ..WorldQuery::default()
    }
}

/// A node that has heard of the cells and of a question.
pub fn asking(kind: u8) -> Table {
    let mut table = Table::new();
    table.hear(Event::World(Box::new(cells())));
    ask(&mut table, 0, kind);
    table
}

/// The question of a revision comes.
pub fn ask(table: &mut Table, revision: u64, kind: u8) {
    table.hear(Event::WorldQuery(Box::new(way_query(revision, kind))));
    let query_id = format!("w{revision}");
    table.hear(Event::Lesson(Box::new(LessonStatus { revision, query_id, ..LessonStatus::default() })));
}
