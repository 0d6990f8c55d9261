//! Claims about when the simulated person speaks.

use apprentice_msgs::builtin_interfaces::Time;
use apprentice_msgs::msg::{
    EvidenceReceipt, FeatureTrajectory, PlacementOption, PlacementQuery, QueryResponse, TrajectoryPreference,
};
use bus::NodeSettings;
use demonstrator::{DemonstratorNode, Event, MAX_PENDING, Output, Settings, answer_id};
use scene::{Object, Point, Scene, Shape};

fn at(seconds: f64) -> Time {
    Time::from_nanoseconds((seconds * 1e9) as i128)
}

fn query(id: &str) -> Box<PlacementQuery> {
    let cup = Object {
        id: "cup".to_owned(),
        label: "cup".to_owned(),
        shape: Shape::Cylinder { radius_m: 0.05, height_m: 0.1 },
        position_m: Point::new(0.2, 0.2),
        yaw_rad: 0.0,
        supports: false,
    };
    let scene = Scene {
        id: "scene".to_owned(),
        frame: "table".to_owned(),
        width_m: 1.0,
        depth_m: 1.0,
        target: Object { id: "vase".to_owned(), ..cup.clone() },
        objects: vec![cup],
    };
    Box::new(PlacementQuery {
        id: id.to_owned(),
        scene: exchange::scene_to_message(&scene, Time::default()),
        ..PlacementQuery::default()
    })
}

fn receipt(id: &str, outcome: u8) -> EvidenceReceipt {
    EvidenceReceipt { id: id.to_owned(), outcome, reason: "late".to_owned(), ..EvidenceReceipt::default() }
}

fn id_of(outputs: &[Output]) -> &str {
    match outputs {
        [Output::Demonstration(message)] => &message.id,
        [Output::Response(message)] => &message.id,
        other => panic!("expected one answer, got {other:?}"),
    }
}

#[test]
fn an_answer_is_repeated_every_second_until_its_receipt_and_never_after() {
    let mut node = DemonstratorNode::new(&Settings::default());
    let first = node.step(at(10.0), Event::Query(query("q1")));
    let id = id_of(&first).to_owned();
    assert_eq!(id, answer_id("simulated_person", "q1", 1));
    assert!(node.step(at(10.5), Event::Query(query("q1"))).is_empty());
    assert!(node.step(at(10.9), Event::Tick).is_empty());
    assert_eq!(node.step(at(11.0), Event::Tick), first);
    assert!(node.step(at(11.5), Event::Receipt(receipt("somebody else's", EvidenceReceipt::ACCEPTED))).is_empty());
    assert_eq!(node.step(at(12.0), Event::Tick), first);
    assert!(node.step(at(12.1), Event::Receipt(receipt(&id, EvidenceReceipt::ACCEPTED))).is_empty());
    assert_eq!(node.n_pending(), 0);
    assert!(node.step(at(20.0), Event::Tick).is_empty());
    assert!(node.step(at(21.0), Event::Query(query("q1"))).is_empty(), "an answered question was answered again");
}

#[test]
fn a_person_who_comes_back_gives_the_same_answer_under_the_same_id() {
    let answer = || DemonstratorNode::new(&Settings::default()).step(at(1.0), Event::Query(query("q1")));
    assert_eq!(answer(), answer());
}

#[test]
fn the_delay_holds_back_the_first_answer_only() {
    let settings = Settings { response_delay_s: 0.5, ..Settings::default() };
    let mut node = DemonstratorNode::new(&settings);
    assert!(node.step(at(1.0), Event::Query(query("q1"))).is_empty());
    assert!(node.step(at(1.4), Event::Tick).is_empty());
    id_of(&node.step(at(1.5), Event::Tick));
    assert!(node.step(at(2.4), Event::Tick).is_empty());
    id_of(&node.step(at(2.5), Event::Tick));
    // The clock of a looped replay starts over.
    id_of(&node.step(at(0.0), Event::Tick));
}

#[test]
fn a_refusal_is_reported_once_and_ends_the_repetition() {
    let mut node = DemonstratorNode::new(&Settings::default());
    let id = id_of(&node.step(at(1.0), Event::Query(query("q1")))).to_owned();
    let outputs = node.step(at(1.1), Event::Receipt(receipt(&id, EvidenceReceipt::REFUSED)));
    assert_eq!(outputs, [Output::Warning("the answer to question 'q1' was refused: late".to_owned())]);
    assert!(node.step(at(9.0), Event::Tick).is_empty());
}

#[test]
fn a_broken_scene_is_reported_once_and_the_next_question_is_answered() {
    let mut node = DemonstratorNode::new(&Settings::default());
    let mut broken = query("q1");
    broken.scene.objects[0].pose.position.x = f64::NAN;
    let outputs = node.step(at(1.0), Event::Query(broken.clone()));
    assert!(
        matches!(&outputs[..], [Output::Warning(text)] if text.contains("q1") && text.contains("cup")),
        "{outputs:?}"
    );
    assert!(node.step(at(1.1), Event::Query(broken)).is_empty());
    id_of(&node.step(at(1.2), Event::Query(query("q2"))));
    assert!(matches!(&node.step(at(1.3), Event::Query(query("")))[..], [Output::Warning(_)]));
}

#[test]
fn moods_become_responses() {
    for (settings, kind) in [
        (Settings { skip_rate: 1.0, ..Settings::default() }, QueryResponse::SKIP),
        (Settings { cant_tell_rate: 1.0, ..Settings::default() }, QueryResponse::CANT_TELL),
    ] {
        let outputs = DemonstratorNode::new(&settings).step(at(1.0), Event::Query(query("q1")));
        assert!(
            matches!(&outputs[..], [Output::Response(message)] if message.kind == kind && message.query_id == "q1")
        );
    }
}

#[test]
fn memory_is_bounded() {
    let mut node = DemonstratorNode::new(&Settings::default());
    for question in 0..MAX_PENDING + 10 {
        node.step(at(1.0), Event::Query(query(&format!("q{question}"))));
    }
    assert_eq!(node.n_pending(), MAX_PENDING);
}

#[test]
fn settings_that_contradict_each_other_are_refused_by_name() {
    let bad = [
        (Settings { reward_weights: vec![], ..Settings::default() }, "reward_weights"),
        (Settings { skip_rate: 0.7, mistake_rate: 0.7, ..Settings::default() }, "skip_rate"),
        (Settings { source: String::new(), ..Settings::default() }, "source"),
        (
            Settings {
                reward_names: vec!["a".to_owned(), "a".to_owned()],
                reward_weights: vec![1.0, 1.0],
                ..Settings::default()
            },
            "reward_names",
        ),
    ];
    for (settings, named) in bad {
        assert!(settings.check().is_err_and(|text| text.contains(named)));
    }
    assert_eq!(Settings::default().check(), Ok(()));
}

/// Which of two places on the table of [`query`], A and B.
fn pair(id: &str, a: (f64, f64), b: (f64, f64)) -> Box<PlacementQuery> {
    let option = |(x, y): (f64, f64), name: &str| PlacementOption {
        placement: apprentice_msgs::geometry_msgs::Point { x, y, z: 0.0 },
        trajectory: FeatureTrajectory { id: format!("{id}-{name}"), features: vec![x, y] },
    };
    Box::new(PlacementQuery { options: vec![option(a, "a"), option(b, "b")], ..*query(id) })
}

#[test]
fn which_of_two_places_is_better_is_said_worst_first_by_the_hidden_reward() {
    let said = |settings: &Settings, query: Box<PlacementQuery>| {
        let outputs = DemonstratorNode::new(settings).step(at(1.0), Event::Query(query));
        let [Output::Preference(message)] = outputs.as_slice() else { panic!("{outputs:?}") };
        assert_eq!((message.query_id.as_str(), message.id.clone()), ("q1", answer_id("simulated_person", "q1", 1)));
        let names: String = message.trajectories.iter().map(|of| of.id.chars().last().expect("a name")).collect();
        assert_eq!(message.trajectories[0].features.len(), 2, "they are sent as they were asked");
        (names, message.answer)
    };
    let person = Settings::default();
    let (middle, corner) = ((0.5, 0.5), (0.9, 0.1));
    assert_eq!(said(&person, pair("q1", middle, corner)), ("ba".to_owned(), TrajectoryPreference::RANKED));
    assert_eq!(said(&person, pair("q1", corner, middle)), ("ab".to_owned(), TrajectoryPreference::RANKED));
    assert_eq!(said(&person, pair("q1", middle, middle)).1, TrajectoryPreference::EQUAL);
    let unsure = Settings { cant_tell_rate: 1.0, ..Settings::default() };
    assert_eq!(said(&unsure, pair("q1", middle, corner)).1, TrajectoryPreference::CANT_TELL);
    let skipping = Settings { skip_rate: 1.0, ..Settings::default() };
    let outputs = DemonstratorNode::new(&skipping).step(at(1.0), Event::Query(pair("q1", middle, corner)));
    assert!(matches!(outputs.as_slice(), [Output::Response(said)] if said.kind == QueryResponse::SKIP), "{outputs:?}");
    // β (R − R') of a Boltzmann person: with β ln 3 / (R − R') three in four say that the middle is better.
    let scene = exchange::scene_from_message(&query("q1").scene).expect("a good scene");
    let rbf = scene::Rbf::new(&scene);
    let weights = demonstrator::Person::new(&person).weights(&scene);
    let gap = rbf.reward(&weights, Point::new(0.5, 0.5)) - rbf.reward(&weights, Point::new(0.9, 0.1));
    let noisy = |seed| Settings {
        seed,
        noise: demonstrator::Noise::Boltzmann,
        beta: 3.0_f64.ln() / gap,
        ..Settings::default()
    };
    let right = (0..400).filter(|&seed| {
        let outputs = DemonstratorNode::new(&noisy(seed)).step(at(1.0), Event::Query(pair("q1", corner, middle)));
        matches!(outputs.as_slice(), [Output::Preference(said)] if said.trajectories[1].id.ends_with('b'))
    });
    // Three standard deviations of a binomial of 400 and 3/4.
    let right = right.count();
    assert!((274..=326).contains(&right), "{right} of 400");
}
