//! Lessons about worlds: the robot asks a simulated person about a garden and a road until what it may lose is small.

use crate::recorded::Recorded;
use crate::suite::{fresh_folder, run};
use crate::taught::{Taught, teach};
use apprentice_msgs::msg::{
    ActionDemonstration, LessonStatus, PolicyBounds, PolicyFrontier, PolicySet, Posterior, RobustPolicy,
    SegmentCritique, TabularWorld, TrajectoryPreference, WorldQuery,
};
use exchange::world_from_message;
use mdp::{Policy, Solver, feature_counts};
use serde_json::Value;

/// Every bit of a lesson about a world that a replay can compare.
fn is_replayed(taught: &Taught) -> Value {
    let output = run(&["replay", "--verify", "--json", &taught.bag.to_string_lossy()]);
    let words = format!("{}{}", String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert!(output.status.success(), "{words}");
    let report: Value = serde_json::from_slice(&output.stdout).expect("--json gives JSON");
    let compared = report["verification"].clone();
    assert!(compared["mismatch"].is_null(), "{compared}");
    for kind in ["posteriors", "policy_bounds", "robust_policies", "frontiers", "lessons", "world_queries"] {
        assert!(compared[kind]["recorded"].as_u64() > Some(0), "{kind}: {compared}");
    }
    compared
}

/// What must hold of the bag of a lesson about a world.
fn is_whole(taught: &Taught) -> Recorded {
    let summary = &taught.summary;
    let (bound, goal) = (summary["last_bound_loss"].as_f64(), summary["epsilon_loss"].as_f64());
    assert!(summary["taught"] == true && bound < goal && bound.is_some(), "{summary}");
    assert_eq!(summary["policy"]["optimal"], true, "{summary}");
    let bag = Recorded::read(&taught.bag).expect("the bag opens");
    assert!(bag.whole, "the bag is not finished");
    let last = bag.distinct::<Posterior>("posterior").pop().expect("there is one");
    let policies = bag.distinct::<RobustPolicy>("robust_policy");
    let final_policy = policies.last().expect("there is one");
    assert_eq!((final_policy.revision, &final_policy.evidence_hash), (last.revision, &last.evidence_hash));
    assert_eq!(final_policy.world, last.world);
    // The policy is judged, by draws that did not choose it, and the lesson ends by that judgement.
    let sets = bag.distinct::<PolicySet>("policies");
    let set =
        sets.iter().find(|set| set.id == format!("robust-{}-0", last.revision)).expect("it was sent to be judged");
    assert_eq!(set.policies[0].action_probabilities, final_policy.action_probabilities);
    let judged = bag.distinct::<PolicyBounds>("policy_bounds");
    let bounds = judged.iter().find(|bounds| bounds.set_id == set.id).expect("it was judged");
    assert_eq!((bounds.n_chains, bounds.n), (last.n_chains, u64::from(last.n_draws) / 2));
    assert_eq!(Some(bounds.policies[0].normalised_loss.bound), bound);
    let ended = bag.distinct::<LessonStatus>("lesson").pop().expect("there is one");
    assert_eq!((ended.state, Some(ended.loss_bound)), (LessonStatus::TAUGHT, bound));
    let frontiers = bag.distinct::<PolicyFrontier>("policy_frontier");
    let frontier = frontiers.last().expect("there is one");
    assert_eq!((frontier.points.len(), frontier.outcome), (21, RobustPolicy::OPTIMAL), "{}", frontier.reason);
    for pair in frontier.points.windows(2) {
        assert!(pair[1].expected_return >= pair[0].expected_return - 1e-6, "{pair:?}");
        assert!(pair[1].conditional_value_at_risk <= pair[0].conditional_value_at_risk + 1e-6, "{pair:?}");
    }
    bag
}

/// What the robot's policy really loses under the person's own reward, as a share of what choosing at random loses.
fn truly_lost(bag: &Recorded, weights: &[f64]) -> f64 {
    let world = world_from_message(&bag.distinct::<TabularWorld>("world")[0]).expect("a good world");
    let table = bag.distinct::<RobustPolicy>("robust_policy").pop().expect("there is one").action_probabilities;
    let value = |policy: &Policy| -> f64 {
        let counts = feature_counts(&world.mdp, policy).expect("a policy of the world");
        counts.iter().zip(weights).map(|(phi, w)| phi * w).sum()
    };
    let best = Solver::new(&world.mdp).solve(weights).value();
    (best - value(&Policy::Stochastic(table))) / (best - value(&Policy::uniform(&world.mdp)))
}

/// Every kind of question was asked, and every answer answers one.
fn is_asked(bag: &Recorded) {
    let asked = bag.distinct::<WorldQuery>("world_query");
    for kind in [WorldQuery::ACTION, WorldQuery::CRITIQUE, WorldQuery::COMPARISON] {
        assert!(asked.iter().any(|query| query.kind == kind), "no question of kind {kind}");
    }
    assert!(asked.iter().all(|query| query.ahead == 0), "a simulated person waits for the robot");
    let find = |id: &str| asked.iter().find(|query| query.id == id);
    let shown = bag.distinct::<ActionDemonstration>("action_demonstration");
    let (unasked, acted): (Vec<_>, Vec<_>) = shown.iter().partition(|answer| answer.query_id.is_empty());
    assert_eq!(unasked.len(), 1, "one walk begins the lesson");
    assert!(acted.iter().all(|m| find(&m.query_id).is_some_and(|query| m.states == [query.state])), "{acted:?}");
    let marked = bag.distinct::<SegmentCritique>("critique");
    assert!(marked.iter().all(|m| find(&m.query_id).is_some_and(|query| m.states == query.trajectories[0].states)));
    let compared = bag.distinct::<TrajectoryPreference>("preference");
    assert!(compared.iter().all(|m| find(&m.query_id).is_some_and(|query| query.kind == WorldQuery::COMPARISON)));
    assert!(!acted.is_empty() && !marked.is_empty() && !compared.is_empty());
}

#[test]
fn a_garden_is_taught_by_answers_to_questions_and_replayed_to_the_bit() {
    let taught = teach("grid", &["--scenario", "grid", "--seed", "1"]);
    let bag = is_whole(&taught);
    is_asked(&bag);
    let world = bag.distinct::<TabularWorld>("world").remove(0);
    assert_eq!((world.id.as_str(), world.shape.as_slice()), ("garden", [6, 7].as_slice()));
    let lost = truly_lost(&bag, &[-0.02, -0.08, -0.45, -0.15, 0.3]);
    assert!((0.0..0.05).contains(&(lost + 1e-12)), "with the person's own reward the robot loses {lost}");
    for told in ["a grid of 6 × 7 cells", "taught after", "in the worst 5 % of what the person may mean"] {
        assert!(taught.shown.contains(told), "{told}\n{}", taught.shown);
    }
    is_replayed(&taught);
}

#[test]
fn a_person_whose_robot_learns_slowly_is_asked_ahead_and_that_is_replayed_to_the_bit_too() {
    let slow = fresh_folder("ahead-parameters").join("slow.yaml");
    // Learning takes seconds, and the person answers at once.
    let parameters = "/**/active_query:\n  ros__parameters:\n    next_within_s: 0.2\n\
                      /**/reward_posterior:\n  ros__parameters:\n    n_draws: 30000\n\
                      /**/demonstrator:\n  ros__parameters:\n    response_delay_s: 0.0\n";
    std::fs::write(&slow, parameters).expect("writes");
    let file = slow.to_string_lossy().into_owned();
    let taught = teach("ahead", &["--scenario", "grid", "--seed", "1", "--params-file", &file]);
    let bag = is_whole(&taught);
    let asked = bag.distinct::<WorldQuery>("world_query");
    let ahead: Vec<u32> = asked.iter().map(|query| query.ahead).collect();
    assert!(ahead.iter().any(|n| *n > 0) && ahead.iter().all(|n| *n <= 3), "{ahead:?}");
    // Every question has a revision of its own, and is answered once.
    assert!(asked.windows(2).all(|pair| pair[0].revision < pair[1].revision), "{asked:?}");
    let lost = truly_lost(&bag, &[-0.02, -0.08, -0.45, -0.15, 0.3]);
    assert!((0.0..0.05).contains(&(lost + 1e-12)), "with the person's own reward the robot loses {lost}");
    is_replayed(&taught);
}

#[test]
fn a_road_is_taught_by_answers_to_questions_and_replayed_to_the_bit() {
    let taught = teach("driving", &["--scenario", "driving", "--seed", "1"]);
    let bag = is_whole(&taught);
    is_asked(&bag);
    let world = bag.distinct::<TabularWorld>("world").remove(0);
    assert_eq!((world.shape_of, world.shape.as_slice()), (TabularWorld::ROAD, [5, 7].as_slice()));
    let lost = truly_lost(&bag, &[-0.45, -0.2, 0.0, 0.05, 0.1, -0.2]);
    assert!((0.0..0.05).contains(&(lost + 1e-12)), "with the person's own reward the robot loses {lost}");
    // A person who shuns collisions is followed: where traffic touches next, the robot is not.
    let policy = bag.distinct::<RobustPolicy>("robust_policy").pop().expect("there is one");
    let collisions: f64 = (0..world.n_states as usize)
        .filter(|state| world.features[state * world.feature_names.len()] > 0.0)
        .map(|state| f64::from(policy.visits[state]))
        .sum();
    let all: f64 = policy.visits.iter().map(|visits| f64::from(*visits)).sum();
    assert!(collisions < 0.02 * all, "{collisions} of {all} discounted visits are collisions");
    is_replayed(&taught);
}
