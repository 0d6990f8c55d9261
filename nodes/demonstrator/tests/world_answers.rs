//! Claims about how the simulated person answers questions about a world.

use apprentice_msgs::builtin_interfaces::Time;
use apprentice_msgs::msg::{
    CritiqueSegment, EvidenceReceipt, LessonStatus, QueryResponse, TabularWorld, TrajectoryPreference, WorldQuery,
    WorldTrajectory,
};
use demonstrator::{DemonstratorNode, Event, Noise, Output, Settings, Teacher};
use exchange::{Picture, World, world_from_message, world_to_message};
use mdp::Solver;
use mdp::worlds::GridWorld;

const RIGHT: u32 = 3;

/// Path, flowers and a gate in a row; it ends at the gate, on the right.
fn message() -> TabularWorld {
    let grid = GridWorld { terminals: vec![3], starts: vec![0], ..GridWorld::one_hot(1, 4, &[0, 1, 0, 2], 3) };
    let names = ["path", "flowers", "gate"].map(String::from);
    world_to_message("garden", &names, &grid.mdp().expect("a garden"), Picture::Cells { rows: 1, columns: 4 })
}

fn world() -> World {
    world_from_message(&message()).expect("a good garden")
}

fn settings() -> Settings {
    Settings {
        reward_names: vec!["gate".into(), "path".into()],
        reward_weights: vec![0.8, -0.2],
        ..Settings::default()
    }
}

fn way(id: &str, steps: &[(u32, u32)], features: [f64; 3]) -> WorldTrajectory {
    WorldTrajectory {
        id: id.into(),
        states: steps.iter().map(|step| step.0).collect(),
        actions: steps.iter().map(|step| step.1).collect(),
        features: features.to_vec(),
    }
}

fn question(id: &str, kind: u8, trajectories: Vec<WorldTrajectory>) -> WorldQuery {
    WorldQuery { id: id.into(), world: world().reference(), kind, trajectories, ..WorldQuery::default() }
}

fn compared(id: &str) -> WorldQuery {
    let ways = vec![way("a", &[(0, RIGHT)], [0.0, 0.0, 1.0]), way("b", &[(0, 0)], [1.0, 0.0, 0.0])];
    question(id, WorldQuery::COMPARISON, ways)
}

fn answer(settings: &Settings, query: &WorldQuery) -> Output {
    Teacher::new(settings, world()).answer(query, Default::default()).expect("it is about the garden")
}

#[test]
fn a_rational_person_does_what_is_best_and_says_what_is() {
    let Output::Actions(shown) = answer(&settings(), &question("q", WorldQuery::ACTION, vec![])) else {
        panic!("an action answers a question about an action")
    };
    assert_eq!((shown.states.as_slice(), shown.actions.as_slice()), ([0].as_slice(), [RIGHT].as_slice()));
    assert_eq!((shown.query_id.as_str(), shown.world_id.as_str()), ("q", "garden"));
    // Right, back to the left twice the same, and right again: the repetition is marked once.
    let steps = [(0, RIGHT), (1, 2), (0, 2), (0, 2), (0, RIGHT), (1, RIGHT)];
    let walk = question("q", WorldQuery::CRITIQUE, vec![way("a", &steps, [0.0; 3])]);
    let Output::Critique(marked) = answer(&settings(), &walk) else { panic!("a critique answers a critique") };
    let parts: Vec<_> = marked.segments.iter().map(|part| (part.start, part.end, part.verdict)).collect();
    assert_eq!(parts, [(0, 1, CritiqueSegment::GOOD), (1, 3, CritiqueSegment::BAD), (5, 6, CritiqueSegment::GOOD)]);
    exchange::marks_from_message(&marked, &world()).expect("the posterior takes it");
    let Output::Preference(said) = answer(&settings(), &compared("q")) else { panic!("a comparison was expected") };
    let order: Vec<&str> = said.trajectories.iter().map(|one| one.id.as_str()).collect();
    assert_eq!((order, said.answer, said.query_id.as_str()), (vec!["b", "a"], TrajectoryPreference::RANKED, "q"));
    let even =
        question("q", WorldQuery::COMPARISON, vec![way("a", &[(0, 0)], [1.0; 3]), way("b", &[(0, 0)], [1.0; 3])]);
    assert!(matches!(answer(&settings(), &even), Output::Preference(m) if m.answer == TrajectoryPreference::EQUAL));
}

#[test]
fn a_noisy_person_errs_as_often_as_the_model_says() {
    let noisy = Settings { noise: Noise::Boltzmann, beta: 2.0, ..settings() };
    let world = world();
    let teacher = Teacher::new(&noisy, world.clone());
    let mut solver = Solver::new(&world.mdp);
    let optimum = solver.solve(teacher.weights());
    let mass: Vec<f64> = (0..4).map(|a| (2.0 * optimum.q(0, a)).exp()).collect();
    let p = mass[3] / mass.iter().sum::<f64>();
    let n = 400;
    let near = |count: usize, p: f64| {
        let share = count as f64 / f64::from(n);
        // Three standard errors.
        assert!((share - p).abs() < 3.0 * (p * (1.0 - p) / f64::from(n)).sqrt(), "{share} instead of {p}");
    };
    let ids: Vec<String> = (0..n).map(|i| format!("q{i}")).collect();
    let of = |query: WorldQuery| teacher.answer(&query, Default::default()).expect("it is about the garden");
    let right = ids.iter().filter(
        |id| matches!(of(question(id, WorldQuery::ACTION, vec![])), Output::Actions(m) if m.actions == [RIGHT]),
    );
    near(right.count(), p);
    let good = ids.iter().filter(|id| {
        let walk = question(id, WorldQuery::CRITIQUE, vec![way("a", &[(0, RIGHT)], [0.0; 3])]);
        matches!(of(walk), Output::Critique(m) if m.segments[0].verdict == CritiqueSegment::GOOD)
    });
    near(good.count(), p);
    let better =
        ids.iter().filter(|id| matches!(of(compared(id)), Output::Preference(m) if m.trajectories[1].id == "a"));
    near(better.count(), 1.0 / (1.0 + (-2.0_f64).exp()));
}

#[test]
fn some_questions_are_skipped_and_some_nobody_could_tell() {
    let shy = Settings { skip_rate: 1.0, ..settings() };
    assert!(matches!(answer(&shy, &compared("q")), Output::Response(m) if m.kind == QueryResponse::SKIP));
    let unsure = Settings { cant_tell_rate: 1.0, ..settings() };
    let action = answer(&unsure, &question("q", WorldQuery::ACTION, vec![]));
    assert!(matches!(action, Output::Response(m) if m.kind == QueryResponse::CANT_TELL && m.query_id == "q"));
    let compared = answer(&unsure, &compared("q"));
    assert!(matches!(compared, Output::Preference(m) if m.answer == TrajectoryPreference::CANT_TELL));
}

fn at(seconds: f64) -> Time {
    Time::from_nanoseconds((seconds * 1e9) as i128)
}

#[test]
fn questions_wait_for_the_world_and_for_what_is_shown_unasked_and_are_answered_once() {
    let mut node = DemonstratorNode::new(&Settings { shows: 1, show_steps: 3, ..settings() });
    let ask = |id: &str| Event::WorldQuery(Box::new(question(id, WorldQuery::ACTION, vec![])));
    assert!(node.step(at(0.0), ask("q0")).is_empty(), "there is no world yet");
    let walk = node.step(at(1.0), Event::World(Box::new(message())));
    let [Output::Actions(walk)] = walk.as_slice() else { panic!("a walk was expected, got {walk:?}") };
    assert!(node.step(at(1.1), ask("q0")).is_empty(), "the walk has not been taken in");
    let receipt = |id: &str, outcome| {
        Event::Receipt(EvidenceReceipt { id: id.into(), outcome, revision: 1, ..EvidenceReceipt::default() })
    };
    node.step(at(1.2), receipt(&walk.id, EvidenceReceipt::ACCEPTED));
    let lesson = LessonStatus { revision: 1, state: LessonStatus::ASKING, ..LessonStatus::default() };
    assert!(node.step(at(1.3), Event::Lesson(Box::new(lesson))).is_empty());
    let told = node.step(at(1.4), ask("q1"));
    let [Output::Actions(shown)] = told.as_slice() else { panic!("an answer was expected, got {told:?}") };
    assert!(node.step(at(1.5), ask("q1")).is_empty() && shown.query_id == "q1");
    assert_eq!(node.step(at(2.4), Event::Tick), told, "again until its receipt");
    node.step(at(2.5), receipt(&shown.id, EvidenceReceipt::ACCEPTED));
    assert!(node.step(at(9.0), ask("q1")).is_empty());
    let elsewhere = WorldQuery { world: Default::default(), ..question("q2", WorldQuery::ACTION, vec![]) };
    let told = node.step(at(10.0), Event::WorldQuery(Box::new(elsewhere)));
    assert!(
        matches!(told.as_slice(), [Output::Warning(text)] if text.contains("cannot answer question 'q2'")),
        "{told:?}"
    );
    assert!(node.step(at(10.1), ask("q2")).is_empty(), "told once");
}
