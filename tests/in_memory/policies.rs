//! Policies that are sent are judged under every posterior, over the graph.

use crate::graph::Lesson;
use crate::log_lines;
use crate::row::{Person, both_ways, row};
use apprentice_msgs::msg::{FeatureTrajectory, PolicySet, PolicyToJudge, RiskBound};
use apprentice_msgs::to_cdr;

fn begun(name: &str) -> (Lesson, Person) {
    let mut lesson = Lesson::new(name);
    lesson.start("reward_posterior", reward_posterior::run, &["n_draws:=4000", "threads:=1", "beta_actions:=5.0"]);
    lesson.start("performance_bounds", performance_bounds::run, &["threads:=1"]);
    let person = Person::new(&mut lesson);
    (lesson, person)
}

#[test]
fn bounds_tighten_as_the_person_says_more_and_come_back_with_an_undo() {
    let (mut lesson, person) = begun("judged");
    person.world.publish(&row(5)).expect("memory takes everything");
    person.policies.publish(&both_ways(1, 5)).expect("memory takes everything");
    let before = lesson.policy_bounds(0, 1);
    let ids = person.says_everything(&mut lesson, 5);
    let after = lesson.policy_bounds(4, 1);
    let posterior = lesson.posterior(4);
    assert_eq!((after.evidence_hash.as_str(), after.seed), (posterior.evidence_hash.as_str(), posterior.seed));
    assert_eq!((after.look, after.n, after.world.clone()), (5, 4000, posterior.world));
    let [left, right] = after.policies.as_slice() else { panic!("{after:?}") };
    assert_eq!((left.rank, right.rank), (2, 1), "the person walks to the right");
    assert!(right.probability_best > 0.6 && right.loss_bound.mean < left.loss_bound.mean, "{after:?}");
    let mean_loss = |bounds: &apprentice_msgs::msg::PolicyBounds| bounds.policies[1].loss_bound.mean;
    assert!(mean_loss(&after) < mean_loss(&before));
    for bound in [&right.return_bound, &right.loss_bound, &right.loss_cvar, &right.normalised_loss] {
        assert_eq!(bound.outcome, RiskBound::BOUND, "{}", bound.reason);
        assert!(bound.bound.is_finite() && bound.ess >= bound.needed as f64);
    }
    let revision = Person::takes_back(&mut lesson, &ids);
    let undone = lesson.policy_bounds(revision, 1);
    // The same draws, at a later look: only what depends on the share of delta differs.
    let means = |bounds: &apprentice_msgs::msg::PolicyBounds| {
        bounds
            .policies
            .iter()
            .flat_map(|p| [p.return_bound.mean, p.loss_bound.mean])
            .map(f64::to_bits)
            .collect::<Vec<_>>()
    };
    assert_eq!((means(&undone), undone.evidence_hash), (means(&before), before.evidence_hash));
}

#[test]
fn a_new_set_replaces_the_one_before_and_rollouts_are_judged_by_their_mean() {
    let (mut lesson, person) = begun("sets");
    person.world.publish(&row(3)).expect("memory takes everything");
    person.policies.publish(&both_ways(1, 3)).expect("memory takes everything");
    let first = lesson.policy_bounds(0, 1);
    let phi = first.policies[1].feature_counts.clone();
    let rollout =
        |id: &str, by: f64| FeatureTrajectory { id: id.into(), features: phi.iter().map(|x| x + by).collect() };
    let rollouts = PolicyToJudge {
        id: "run".into(),
        form: PolicyToJudge::ROLLOUTS,
        rollouts: vec![rollout("a", 0.25), rollout("b", -0.25)],
        ..PolicyToJudge::default()
    };
    let set = PolicySet { policies: vec![rollouts], ..both_ways(2, 3) };
    person.policies.publish(&set).expect("memory takes everything");
    let second = lesson.policy_bounds(0, 2);
    assert_eq!(second.policies[0].n_rollouts, 2);
    for (mean, exact) in second.policies[0].feature_counts.iter().zip(&phi) {
        assert!((mean - exact).abs() < 1e-12);
    }
    person.policies.publish(&set).expect("memory takes everything");
    person.says_everything(&mut lesson, 3);
    assert_eq!(lesson.policy_bounds(4, 2).set_id, "set 2");
}

#[test]
fn policies_without_a_world_are_judged_by_their_returns_alone() {
    let (mut lesson, person) = begun("worldless");
    person.preference.publish(&crate::row::preferred("p", crate::row::pair(3, 0, 2))).expect("memory takes everything");
    assert_eq!(lesson.accepted("p"), 1, "nothing else says how many weights there are");
    let counts = |id: &str, feature_counts: [f64; 3]| PolicyToJudge {
        id: id.into(),
        feature_counts: feature_counts.to_vec(),
        ..PolicyToJudge::default()
    };
    let policies = vec![counts("stays", [3.0, 1.0, 0.0]), counts("goes", [0.0, 1.0, 3.0])];
    let set = PolicySet { world_id: String::new(), policies, ..both_ways(1, 3) };
    person.policies.publish(&set).expect("memory takes everything");
    let bounds = lesson.policy_bounds(1, 1);
    assert_eq!((bounds.policies[1].rank, bounds.policies[1].loss_bound.outcome), (1, RiskBound::NOT_JUDGED));
    assert!(bounds.policies[1].return_bound.bound.is_finite() && bounds.world.id.is_empty());
}

#[test]
fn policies_that_cannot_be_judged_are_told_once_and_the_lesson_goes_on() {
    let (mut lesson, person) = begun("unjudged");
    person.world.publish(&row(3)).expect("memory takes everything");
    lesson.posterior(0);
    let hostile = [
        (PolicySet { policies: vec![], ..both_ways(1, 3) }, "set 1", "it holds 0 policies"),
        (both_ways(2, 7), "set 2", "policy has 7 entries, but 3 are expected"),
        (PolicySet { world_id: "moon".into(), ..both_ways(3, 3) }, "set 3", "about the world 'moon'"),
        (PolicySet { number: 0, ..both_ways(4, 3) }, "set 4", "its number is 0"),
    ];
    for (set, id, wanted) in hostile {
        for _ in 0..2 {
            person.policies.publish(&set).expect("memory takes everything");
        }
        let told = log_lines::wait_for_warning(&format!("policies '{id}' are ignored"));
        assert!(told.len() == 1 && told[0].contains(wanted) && !told[0].contains('\n'), "{wanted:?}: {told:#?}");
    }
    person.policies.publish(&both_ways(9, 3)).expect("memory takes everything");
    let bounds = lesson.policy_bounds(0, 9);
    assert!(!to_cdr(&bounds).is_empty() && bounds.policies.len() == 2);
    lesson.check_nodes();
}
