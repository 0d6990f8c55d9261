//! What the node promises to pages of a lesson about a world, and what becomes of the caution that a page asks for.

mod world;

use apprentice_msgs::msg::{
    ActionDemonstration, EvidenceRecord, FrontierPoint, LessonStatus, PolicyBound, PolicyBounds, PolicyFrontier,
    Posterior, RiskBound, RobustPolicy, TabularWorld, WorldReference,
};
use operator_ui::Event;
use serde_json::json;
use world::table::Table;
use world::{id, log};

/// Two cells side by side; the right one is the end.
fn cells() -> TabularWorld {
    TabularWorld {
        id: "garden".into(),
        gamma: 0.9,
        n_states: 2,
        n_actions: 2,
        feature_names: vec!["path".into(), "door".into()],
        action_names: vec!["left".into(), "right".into()],
        initial: vec![1.0, 0.0],
        from_state: vec![0, 0],
        action: vec![0, 1],
        to_state: vec![0, 1],
        probability: vec![1.0, 1.0],
        features: vec![1.0, 0.0, 0.0, 1.0],
        shape: vec![1, 2],
        ..TabularWorld::default()
    }
}

fn policy(revision: u64, lambda: f64, preference: (u64, &str)) -> RobustPolicy {
    RobustPolicy {
        revision,
        lambda,
        alpha: 0.95,
        preference_number: preference.0,
        preference_id: preference.1.into(),
        expected_return: 1.25,
        value_at_risk: 0.5,
        conditional_value_at_risk: f64::NAN,
        n_states: 2,
        n_actions: 2,
        action_probabilities: vec![0.25, 0.75, 1.0, 0.0],
        visits: vec![1.5, 0.5],
        ..RobustPolicy::default()
    }
}

fn hear(table: &mut Table, message: RobustPolicy) -> world::table::Sent {
    table.hear(Event::Policy(Box::new(message)))
}

#[test]
fn a_world_comes_with_its_picture_and_what_each_action_does_in_it() {
    let mut table = Table::new();
    table.hear(Event::World(Box::new(cells())));
    let shown = table.shown["world"].clone();
    assert_eq!(shown["picture"], json!({"kind": "cells", "rows": 1, "columns": 2, "moves": [[0.0, 0.0], [0.0, 1.0]]}));
    assert_eq!((&shown["cells"], &shown["starts"], &shown["terminals"]), (&json!([0, 1]), &json!([0]), &json!([1])));
    table.shown = json!({});
    table.hear(Event::World(Box::new(cells())));
    assert_eq!(table.shown, json!({}), "a repetition is no news");
    table.hear(Event::World(Box::new(TabularWorld { gamma: f64::NAN, ..cells() })));
    assert!(table.notices[0].contains("the world 'garden' cannot be shown"), "{:?}", table.notices);
}

#[test]
fn policy_frontier_and_bounds_are_shown_with_null_for_what_is_unknown() {
    let mut table = Table::new();
    hear(&mut table, policy(3, 0.5, (0, "")));
    assert_eq!(table.shown["policy"]["outcome"], "optimal");
    assert_eq!(table.shown["policy"]["table"], json!([0.25, 0.75, 1.0, 0.0]));
    assert!(table.shown["policy"]["conditional_value_at_risk"].is_null());
    let broken = RobustPolicy { visits: vec![1.0], ..policy(4, 0.5, (0, "")) };
    hear(&mut table, broken);
    assert_eq!((table.shown["policy"]["revision"].as_u64(), table.notices.len()), (Some(3), 1));

    let point = |lambda: f64| FrontierPoint { lambda, expected_return: lambda, ..FrontierPoint::default() };
    let frontier = PolicyFrontier {
        revision: 3,
        n_states: 2,
        n_actions: 2,
        points: vec![point(0.0), point(1.0)],
        policies: vec![0.5; 8],
        ..PolicyFrontier::default()
    };
    table.hear(Event::Frontier(Box::new(frontier.clone())));
    assert_eq!(table.shown["frontier"]["points"][1]["expected_return"], 1.0);
    assert_eq!(table.shown["frontier"]["tables"].as_array().map(Vec::len), Some(8));
    table.hear(Event::Frontier(Box::new(PolicyFrontier { policies: vec![0.5; 7], ..frontier })));
    assert_eq!(table.shown["frontier"]["tables"], json!([]), "tables that do not fit are left out");

    let bound = |bound: f64, outcome: u8| RiskBound { bound, outcome, ..RiskBound::default() };
    let of = |id: &str, least: RiskBound| PolicyBound { id: id.into(), return_bound: least, ..PolicyBound::default() };
    let judged = PolicyBounds {
        revision: 3,
        set_id: "robust-3-0".into(),
        policies: vec![of("robust", bound(0.75, RiskBound::BOUND)), of("mean", bound(f64::NAN, RiskBound::NOT_MIXED))],
        seed: u64::MAX,
        ..PolicyBounds::default()
    };
    table.hear(Event::PolicyBounds(Box::new(PolicyBounds { set_id: "mine".into(), ..judged.clone() })));
    assert!(table.shown.get("robust_bounds").is_none(), "somebody else's policies are not the robot's");
    table.hear(Event::PolicyBounds(Box::new(judged)));
    let shown = &table.shown["robust_bounds"];
    assert_eq!(
        (&shown["least_return"]["bound"], &shown["least_return_of_mean"]["bound"]),
        (&json!(0.75), &json!(null))
    );
    assert_eq!(shown["seed"], "18446744073709551615");
}

#[test]
fn a_caution_goes_out_each_second_until_the_policy_follows_it() {
    let mut table = Table::new();
    hear(&mut table, policy(3, 0.5, (4, "somebody else's")));
    let said = table.say(&json!({"type": "caution", "id": id(1), "lambda": 0.25})).preferences.remove(0);
    assert_eq!((said.number, said.lambda, said.source.as_str()), (5, 0.25, "operator"));
    assert_eq!(table.shown["caution"], json!({"id": id(1), "lambda": 0.25, "taken": false}));
    assert!(table.wait(0.5).preferences.is_empty());
    assert_eq!(table.wait(0.5).preferences, vec![said.clone()]);
    // Sent again by a page that lost its connection, it is the same; a policy of another preference changes nothing.
    assert!(table.say(&json!({"type": "caution", "id": id(1), "lambda": 0.25})).preferences.is_empty());
    hear(&mut table, policy(4, 0.5, (4, "somebody else's")));
    assert_eq!(table.wait(1.0).preferences, vec![said]);
    hear(&mut table, policy(4, 0.25, (5, &id(1))));
    assert_eq!(table.shown["caution"]["taken"], true);
    assert!(table.wait(5.0).preferences.is_empty());
    // The next one counts on from there, also in a node that starts now.
    let next = table.say(&json!({"type": "caution", "id": id(2), "lambda": 1.0})).preferences.remove(0);
    assert_eq!(next.number, 6);
    let mut late = Table::new();
    hear(&mut late, policy(4, 0.25, (5, &id(1))));
    assert!(
        late.say(&json!({"type": "caution", "id": id(1), "lambda": 0.25})).preferences.is_empty(),
        "it is followed"
    );
    assert_eq!(late.say(&json!({"type": "caution", "id": id(3), "lambda": 0.0})).preferences[0].number, 6);
}

#[test]
fn a_caution_that_makes_no_sense_is_refused_in_a_sentence() {
    let mut table = Table::new();
    for (command, reason) in [
        (json!({"type": "caution", "id": id(1), "lambda": 1.5}), "lambda is 1.5"),
        (json!({"type": "caution", "id": "x", "lambda": 0.5}), "UUID"),
        (json!({"type": "caution", "id": id(1)}), "lambda"),
    ] {
        assert!(table.say(&command).preferences.is_empty());
        assert!(table.refused.pop().is_some_and(|(_, told)| told.contains(reason)), "{command}");
    }
}

#[test]
fn what_was_shown_in_a_world_is_in_the_list_and_can_be_taken_back() {
    let shown = ActionDemonstration {
        id: "walk".into(),
        source: "simulated_person".into(),
        states: vec![0, 1],
        actions: vec![1, 0],
        ..ActionDemonstration::default()
    };
    let record = EvidenceRecord {
        sequence: 1,
        kind: EvidenceRecord::ACTIONS,
        actions: vec![shown],
        ..EvidenceRecord::default()
    };
    let mut table = Table::new();
    table.hear(Event::Evidence(Box::new(log(vec![record]))));
    let answer = table.answer("walk");
    assert_eq!((&answer["kind"], &answer["n"], &answer["state"]), (&json!("actions"), &json!(2), &json!("accepted")));
    let undo = json!({"type": "retract", "id": id(1), "evidence_id": "walk"});
    assert_eq!(table.say(&undo).retractions[0].evidence_id, "walk");
}

#[test]
fn weights_are_told_by_name_and_the_history_of_the_loss_in_a_lesson_about_a_world_only() {
    let mut table = Table::new();
    let about = Posterior {
        revision: 1,
        world: WorldReference { id: "garden".into(), hash: "abc".into() },
        feature_names: vec!["path".into(), "door".into()],
        map_weights: vec![0.0, 0.0],
        n_chains: 1,
        n_draws: 4,
        draws: vec![-1.0, 1.0, -0.5, 1.0, 0.0, 1.0, 0.5, 1.0],
        ..Posterior::default()
    };
    table.hear(Event::Posterior(Box::new(about.clone())));
    let door = json!({"name": "door", "mean": 1.0, "low": 1.0, "high": 1.0});
    assert_eq!(table.shown["weights"], json!([{"name": "path", "mean": -0.25, "low": -1.0, "high": 0.5}, door]));
    let lesson = |revision: u64, loss_bound: f64| {
        Event::Lesson(Box::new(LessonStatus { revision, loss_bound, epsilon_loss: 0.1, ..LessonStatus::default() }))
    };
    table.hear(lesson(0, f64::NAN));
    table.hear(lesson(1, 0.5));
    table.hear(lesson(1, 0.4));
    let trend = table.shown["loss_trend"].as_array().expect("points").clone();
    let points: Vec<_> = trend.iter().map(|point| (point["revision"].clone(), point["bound"].clone())).collect();
    assert_eq!(points, [(json!(0), json!(null)), (json!(1), json!(0.4))]);
    assert_eq!(table.shown["lesson"]["loss_bound"], 0.4);
    // Evidence that does not fit is named, and not without end.
    let misfits: Vec<String> = (0..40).map(|i| format!("e{i}")).collect();
    let doubted = LessonStatus {
        revision: 2,
        state: LessonStatus::MISFIT,
        held_out: 7,
        surprises: 5,
        misfits,
        ..LessonStatus::default()
    };
    table.hear(Event::Lesson(Box::new(doubted)));
    let shown = &table.shown["lesson"];
    assert_eq!((&shown["state"], &shown["held_out"], &shown["surprises"]), (&json!("misfit"), &json!(7), &json!(5)));
    assert_eq!((&shown["misfits"][15], shown["misfits"].get(16)), (&json!("e15"), None));

    let mut set = Table::asking(3);
    assert_eq!(set.shown.get("loss_trend"), None);
    // In a lesson about a table things are called as they are there, where that tells which is meant.
    let mut task = world::scene("task", 0.0);
    task.objects[1].label = "bowl".into();
    let feature_names: Vec<String> = ["plate", "cup"].map(String::from).into();
    let of_table = Posterior { world: WorldReference::default(), task, feature_names, ..about };
    set.hear(Event::Posterior(Box::new(of_table.clone())));
    let names = |set: &Table| {
        set.shown["weights"].as_array().expect("weights").iter().map(|w| w["name"].clone()).collect::<Vec<_>>()
    };
    assert_eq!(names(&set), ["plate", "cup"], "two things are called a bowl");
    let mut named = of_table;
    named.revision = 2;
    named.task.objects[0].label = "blue plate".into();
    set.hear(Event::Posterior(Box::new(named)));
    assert_eq!(names(&set), ["blue plate", "cup"]);
    assert!(set.shown["lesson"]["loss_bound"].is_null() && set.shown["lesson"]["epsilon_loss"].is_null());
}
