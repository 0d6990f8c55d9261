//! Claims about what the simulated person shows in a world, and when.

use apprentice_msgs::builtin_interfaces::Time;
use apprentice_msgs::msg::{
    ActionDemonstration, EvidenceReceipt, LessonStatus, TabularWorld, TrajectoryPreference, WorldQuery,
};
use demonstrator::{DemonstratorNode, Event, Noise, Output, Piece, Settings, Teacher};
use exchange::{Picture, World, steps_from_message, world_from_message, world_to_message};
use mdp::Solver;
use mdp::worlds::GridWorld;

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
        shows: 2,
        show_steps: 10,
        compares: 3,
        compare_steps: 6,
        ..Settings::default()
    }
}

fn pieces(settings: &Settings) -> Vec<Piece> {
    let teacher = Teacher::new(settings, world());
    (0..teacher.n_pieces()).map(|i| teacher.piece(i).expect("walks begin at the left")).collect()
}

fn shows(pieces: &[Piece]) -> Vec<&ActionDemonstration> {
    pieces.iter().filter_map(|piece| if let Piece::Show(message) = piece { Some(&**message) } else { None }).collect()
}

fn comparisons(pieces: &[Piece]) -> Vec<&TrajectoryPreference> {
    pieces
        .iter()
        .filter_map(|piece| if let Piece::Compare(message) = piece { Some(&**message) } else { None })
        .collect()
}

#[test]
fn a_rational_person_shows_the_best_walk_and_prefers_the_better_of_two() {
    let pieces = pieces(&settings());
    let kinds: Vec<bool> = pieces.iter().map(|piece| matches!(piece, Piece::Show(_))).collect();
    assert_eq!(kinds, [true, false, true, false, false], "they take turns");
    let world = world();
    let teacher = Teacher::new(&settings(), world.clone());
    assert_eq!(teacher.weights(), [-0.2, 0.0, 0.8]);
    let mut solver = Solver::new(&world.mdp);
    let optimum = solver.solve(teacher.weights());
    for shown in shows(&pieces) {
        let steps = steps_from_message(shown, &world).expect("the posterior takes it");
        assert_eq!((steps[0].0, steps.last().map(|step| step.0)), (0, Some(3)), "from the start to the gate");
        assert!(steps.windows(2).all(|pair| world.mdp.successors(pair[0].0, pair[0].1).any(|(to, _)| to == pair[1].0)));
        let best = |&(s, a): &(usize, usize)| (0..4).all(|b| optimum.q(s, b) <= optimum.q(s, a) + 1e-9);
        assert!(steps.iter().all(best), "{steps:?}");
    }
    for compared in comparisons(&pieces) {
        exchange::check_preference(compared, 3).expect("the posterior takes it");
        let value = |i: usize| -> f64 {
            compared.trajectories[i].features.iter().zip(teacher.weights()).map(|(f, w)| f * w).sum()
        };
        match compared.answer {
            TrajectoryPreference::RANKED => assert!(value(1) > value(0), "worst first"),
            answer => assert!(answer == TrajectoryPreference::EQUAL && (value(1) - value(0)).abs() < 1e-9),
        }
    }
    let mut ids: Vec<&str> = pieces.iter().map(Piece::id).collect();
    ids.sort_unstable();
    ids.dedup();
    assert_eq!(ids.len(), 5, "each has an id of its own");
}

#[test]
fn the_same_person_says_the_same_again_and_another_seed_something_else() {
    assert_eq!(pieces(&settings()), pieces(&settings()));
    let other = pieces(&Settings { seed: 2, ..settings() });
    assert!(pieces(&settings()).iter().zip(&other).all(|(a, b)| a.id() != b.id()));
}

#[test]
fn an_irrational_person_errs_as_often_as_the_model_says() {
    let noisy = Settings { noise: Noise::Boltzmann, beta: 2.0, shows: 300, show_steps: 1, compares: 0, ..settings() };
    let world = world();
    let teacher = Teacher::new(&noisy, world.clone());
    let mut solver = Solver::new(&world.mdp);
    let optimum = solver.solve(teacher.weights());
    let mass: Vec<f64> = (0..4).map(|a| (2.0 * optimum.q(0, a)).exp()).collect();
    let expected = mass[3] / mass.iter().sum::<f64>();
    let all = pieces(&noisy);
    let right = shows(&all).iter().filter(|shown| shown.actions[0] == 3).count() as f64 / 300.0;
    // Three standard errors.
    assert!((right - expected).abs() < 3.0 * (expected * (1.0 - expected) / 300.0).sqrt(), "{right} {expected}");
    let careless = Settings { mistake_rate: 1.0, ..noisy };
    let all = pieces(&careless);
    let right = shows(&all).iter().filter(|shown| shown.actions[0] == 3).count() as f64 / 300.0;
    assert!((right - 0.25).abs() < 3.0 * (0.1875_f64 / 300.0).sqrt(), "{right}");
}

fn at(seconds: f64) -> Time {
    Time::from_nanoseconds((seconds * 1e9) as i128)
}

fn given(outputs: &[Output]) -> Vec<String> {
    outputs
        .iter()
        .map(|output| match output {
            Output::Actions(message) => message.id.clone(),
            Output::Preference(message) => message.id.clone(),
            other => panic!("evidence was expected, got {other:?}"),
        })
        .collect()
}

fn receipt(id: &str, outcome: u8, revision: u64) -> Event {
    Event::Receipt(EvidenceReceipt { id: id.into(), outcome, revision, ..EvidenceReceipt::default() })
}

fn lesson(revision: u64, state: u8) -> Event {
    Event::Lesson(Box::new(LessonStatus { revision, state, ..LessonStatus::default() }))
}

#[test]
fn the_next_piece_is_given_when_the_lesson_has_taken_in_the_last_and_goes_on() {
    let all = pieces(&settings());
    let mut node = DemonstratorNode::new(&settings());
    assert!(node.step(at(0.0), Event::Tick).is_empty(), "there is no world yet");
    assert_eq!(given(&node.step(at(1.0), Event::World(Box::new(message())))), [all[0].id()]);
    assert!(node.step(at(1.5), Event::Tick).is_empty());
    assert_eq!(given(&node.step(at(2.0), Event::Tick)), [all[0].id()], "again until its receipt");
    assert!(node.step(at(2.1), receipt(all[0].id(), EvidenceReceipt::ACCEPTED, 1)).is_empty());
    assert!(node.step(at(2.2), lesson(0, LessonStatus::ASKING)).is_empty(), "that is of before");
    assert_eq!(given(&node.step(at(2.3), lesson(1, LessonStatus::ASKING))), [all[1].id()]);
    // Taught: nothing more, unless somebody takes something back.
    node.step(at(2.4), receipt(all[1].id(), EvidenceReceipt::ACCEPTED, 2));
    assert!(node.step(at(2.5), lesson(2, LessonStatus::TAUGHT)).is_empty());
    assert!(node.step(at(60.0), Event::Tick).is_empty());
    assert_eq!(given(&node.step(at(61.0), lesson(3, LessonStatus::ASKING))), [all[2].id()]);
    // Without a word about the lesson the person waits ten seconds; after a refusal the next piece is tried.
    let told = node.step(at(61.1), receipt(all[2].id(), EvidenceReceipt::REFUSED, 0));
    assert!(matches!(told.as_slice(), [Output::Warning(_), Output::Preference(_)]), "{told:?}");
    node.step(at(62.0), receipt(all[3].id(), EvidenceReceipt::ACCEPTED, 9));
    assert!(node.step(at(71.9), Event::Tick).is_empty());
    assert_eq!(given(&node.step(at(72.1), Event::Tick)), [all[4].id()]);
    node.step(at(73.0), receipt(all[4].id(), EvidenceReceipt::ACCEPTED, 10));
    assert!(node.step(at(74.0), lesson(10, LessonStatus::ASKING)).is_empty(), "that was all");
}

#[test]
fn a_person_who_only_sets_tables_says_nothing_about_worlds() {
    let mut node = DemonstratorNode::new(&Settings::default());
    assert!(node.step(at(1.0), Event::World(Box::new(message()))).is_empty());
    let query = WorldQuery {
        id: "q".into(),
        world: world_from_message(&message()).expect("a good garden").reference(),
        ..WorldQuery::default()
    };
    assert!(node.step(at(2.0), Event::WorldQuery(Box::new(query))).is_empty());
}

#[test]
fn a_world_that_cannot_be_used_and_a_reward_that_is_not_there_are_told_once() {
    let mut node = DemonstratorNode::new(&settings());
    let broken = Event::World(Box::new(TabularWorld { gamma: f64::NAN, ..message() }));
    let told = node.step(at(1.0), broken.clone());
    assert!(matches!(told.as_slice(), [Output::Warning(text)] if text.contains("cannot teach in the world 'garden'")));
    assert!(node.step(at(1.2), broken).is_empty());
    let odd = Settings { reward_names: vec!["gate".into(), "sea".into()], ..settings() };
    let told = DemonstratorNode::new(&odd).step(at(1.0), Event::World(Box::new(message())));
    assert!(matches!(&told[0], Output::Warning(text) if text.ends_with("not in this world: sea")), "{told:?}");
}
