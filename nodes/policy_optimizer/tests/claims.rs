//! The policy published is the optimum of the published draws, whatever order messages come in, and what is missing is told.

mod garden;

use apprentice_msgs::builtin_interfaces::Time;
use apprentice_msgs::msg::{EvidenceLog, EvidenceRecord, PolicyToJudge, Posterior, RiskPreference, RobustPolicy};
use apprentice_msgs::to_cdr;
use exchange::World;
use garden::{demonstration, message, posterior, shown, world};
use mdp::{Policy, feature_counts, occupancy};
use policy_optimizer::{Event, Inputs, Objective, Output, PolicyOptimizer, Settings, frontier, policy};
use robust::{Problem, performance};

const SETTINGS: fn() -> Settings = || Settings { points: 6, threads: 1, ..Settings::default() };

fn inputs<'a>(posterior: &'a Posterior, world: &'a World) -> Inputs<'a> {
    Inputs { posterior, world, demonstrations: &[] }
}

/// Every output of events in their order; what is asked to be computed is computed at once.
fn outputs(node: &mut PolicyOptimizer, events: Vec<Event>) -> Vec<Output> {
    let mut queue = std::collections::VecDeque::from(events);
    let mut found = Vec::new();
    while let Some(event) = queue.pop_front() {
        for output in node.step(Time::default(), event) {
            match output {
                Output::Compute => queue.push_back(Event::Compute),
                other => found.push(other),
            }
        }
    }
    found
}

fn said(outputs: &[Output]) -> Vec<&'static str> {
    outputs
        .iter()
        .map(|output| match output {
            Output::Policy(_) => "policy",
            Output::Frontier(_) => "frontier",
            Output::Judge(_) => "judge",
            Output::Compute => "compute",
            Output::Warn(_) => "warn",
        })
        .collect()
}

/// The first half of each of the four chains, and the second.
fn halves(draws: &[f64], k: usize) -> (Vec<f64>, Vec<f64>) {
    let half = |chain: &[f64], second: usize| chain[second * 75 * k..][..75 * k].to_vec();
    let of = |second: usize| draws.chunks_exact(150 * k).flat_map(|chain| half(chain, second)).collect();
    (of(0), of(1))
}

fn preference(id: &str, number: u64, lambda: f64) -> RiskPreference {
    RiskPreference { id: id.into(), number, lambda, ..RiskPreference::default() }
}

#[test]
fn the_policy_is_the_optimum_of_the_first_halves_and_is_judged_by_the_second() {
    let (posterior, world) = (posterior(3), world());
    for objective in [Objective::Robust, Objective::Evd] {
        let settings = Settings { objective, ..SETTINGS() };
        let found = policy(&settings, &inputs(&posterior, &world), None).policy;
        assert_eq!(found.outcome, RobustPolicy::OPTIMAL, "{}", found.reason);
        let k = posterior.feature_names.len();
        let draws: Vec<f64> = posterior.draws.iter().map(|&w| f64::from(w)).collect();
        let (first, second) = halves(&draws, k);
        let (first, second) = (first.as_slice(), second.as_slice());
        assert_eq!(
            (found.n_draws, found.held_out, found.draws_used),
            (first.len() as u64 / k as u64, second.len() as u64 / k as u64, 75)
        );
        let psi = match objective {
            Objective::Evd => robust::Objective::Loss,
            _ => robust::Objective::Robust,
        };
        // The optimum, found the other way: one linear program over all visits.
        let problem = Problem::new(&world.mdp, first, None, psi, 1).expect("a good problem");
        let direct = robust::Settings { method: robust::MethodChoice::Direct, ..robust::Settings::default() };
        let optimum = problem.solve(0.95, 0.5, &direct).expect("a good problem");
        assert!(
            (found.objective_value - optimum.objective).abs() < 1e-6,
            "{} {}",
            found.objective_value,
            optimum.objective
        );
        // Everything said of the policy follows from its table alone.
        let table = Policy::Stochastic(found.action_probabilities.clone());
        table.check(&world.mdp).expect("rows that sum to 1, everywhere");
        let counts = feature_counts(&world.mdp, &table).expect("a policy of the world");
        assert!(counts.iter().zip(&found.feature_counts).all(|(a, b)| (a - b).abs() < 1e-9));
        let risk = problem.risk_of(&counts, 0.95, 0.5).expect("a good level");
        for (said, is) in [
            (found.expected_return, risk.expected_return),
            (found.value_at_risk, risk.value_at_risk),
            (found.conditional_value_at_risk, risk.conditional_value_at_risk),
            (found.objective_value, risk.objective),
        ] {
            assert!((said - is).abs() < 1e-7, "{said} is {is}");
        }
        let fresh = performance(&world.mdp, second, psi, &counts, 1).expect("good draws");
        let mean = fresh.iter().sum::<f64>() / fresh.len() as f64;
        assert!((found.held_out_mean - mean).abs() < 1e-7);
        assert!(found.held_out_cvar_low <= found.held_out_cvar && found.held_out_cvar <= found.held_out_cvar_high);
        let u = occupancy(&world.mdp, &table).expect("a policy of the world");
        for (state, visits) in found.visits.iter().enumerate() {
            let row = &u[state * world.mdp.n_actions()..][..world.mdp.n_actions()];
            assert!((f64::from(*visits) - row.iter().sum::<f64>()).abs() < 1e-4, "state {state}");
        }
        assert!(found.reason.contains("in the worst 5 % of what the person may mean"), "{}", found.reason);
    }
}

#[test]
fn the_frontier_trades_the_mean_for_the_worst_case() {
    let (posterior, world) = (posterior(3), world());
    let found = frontier(&SETTINGS(), &inputs(&posterior, &world));
    assert_eq!((found.outcome, found.points.len()), (RobustPolicy::OPTIMAL, 6), "{}", found.reason);
    for pair in found.points.windows(2) {
        assert!(pair[1].lambda > pair[0].lambda);
        assert!(pair[1].expected_return >= pair[0].expected_return - 1e-7, "{pair:?}");
        assert!(pair[1].conditional_value_at_risk <= pair[0].conditional_value_at_risk + 1e-7, "{pair:?}");
    }
    let [first, .., last] = found.points.as_slice() else { panic!("six points") };
    assert!(last.expected_return - first.expected_return > 0.01, "caution costs something here: {:?}", found.points);
    let cells = world.mdp.n_states() * world.mdp.n_actions();
    assert_eq!(found.policies.len(), 6 * cells);
    // The policy of a point has the numbers of the point.
    let at = |i: usize| {
        policy(&SETTINGS(), &inputs(&posterior, &world), Some(&preference("p", 1, found.points[i].lambda))).policy
    };
    for i in [0, 2, 5] {
        let (one, point) = (at(i), &found.points[i]);
        let value = |mean: f64, cvar: f64| point.lambda * mean + (1.0 - point.lambda) * cvar;
        let (a, b) = (
            value(one.expected_return, one.conditional_value_at_risk),
            value(point.expected_return, point.conditional_value_at_risk),
        );
        assert!((a - b).abs() < 1e-6, "{a} {b}");
    }
}

#[test]
fn what_is_published_does_not_depend_on_the_order_of_the_messages() {
    let events = || {
        [
            Event::World(Box::new(message())),
            Event::Posterior(Box::new(posterior(3))),
            Event::Preference(Box::new(preference("a", 1, 0.25))),
            Event::Preference(Box::new(preference("b", 2, 0.75))),
        ]
    };
    let last = |order: [usize; 4]| {
        let all = events();
        let mut node = PolicyOptimizer::new(SETTINGS());
        let found = outputs(&mut node, order.iter().map(|&i| all[i].clone()).collect());
        let policy = found.iter().rev().find_map(|output| match output {
            Output::Policy(message) => Some(to_cdr(&**message)),
            _ => None,
        });
        let set = found.iter().rev().find_map(|output| match output {
            Output::Judge(message) => Some((message.number, to_cdr(&**message))),
            _ => None,
        });
        (policy.expect("a policy"), set.expect("a set"))
    };
    let first = last([0, 1, 2, 3]);
    assert_eq!(first.1.0, 3 + 2 + 1, "revision + preference + 1");
    for order in [[1, 0, 3, 2], [3, 2, 1, 0], [2, 3, 0, 1]] {
        assert!(last(order) == first, "{order:?}");
    }
}

#[test]
fn of_several_posteriors_only_the_last_is_computed_and_nothing_twice() {
    let mut node = PolicyOptimizer::new(SETTINGS());
    let now = Time::default();
    assert!(node.step(now, Event::World(Box::new(message()))).is_empty());
    assert_eq!(node.step(now, Event::Posterior(Box::new(posterior(1)))), vec![Output::Compute]);
    assert!(node.step(now, Event::Posterior(Box::new(posterior(2)))).is_empty(), "it was asked for already");
    let computed = node.step(now, Event::Compute);
    assert_eq!(said(&computed), ["policy", "judge", "compute"]);
    let Output::Policy(first) = &computed[0] else { panic!("the policy comes first") };
    assert_eq!(first.revision, 2);
    assert_eq!(said(&node.step(now, Event::Compute)), ["frontier"]);
    assert!(node.step(now, Event::Posterior(Box::new(posterior(2)))).is_empty(), "a repetition");
    assert_eq!(said(&node.step(now, Event::Republish)), ["policy", "judge", "frontier"]);
    // Another λ is another policy, but the frontier stays.
    let more = outputs(&mut node, vec![Event::Preference(Box::new(preference("a", 1, 0.0)))]);
    assert_eq!(said(&more), ["policy", "judge"]);
    assert!(outputs(&mut node, vec![Event::Preference(Box::new(preference("a", 1, 0.0)))]).is_empty());
    assert!(outputs(&mut node, vec![Event::Preference(Box::new(preference("z", 0, 0.0)))]).len() == 1, "it is told");
}

#[test]
fn threads_do_not_matter() {
    let (posterior, world) = (posterior(3), world());
    let of = |threads: i64| {
        let settings = Settings { threads, objective: Objective::Evd, ..SETTINGS() };
        let found = policy(&settings, &inputs(&posterior, &world), None);
        (to_cdr(&found.policy), to_cdr(&frontier(&settings, &inputs(&posterior, &world))))
    };
    assert!(of(1) == of(3));
}

#[test]
fn the_set_to_judge_holds_the_policy_and_the_best_for_the_mean() {
    let (posterior, world) = (posterior(4), world());
    let found = policy(&SETTINGS(), &inputs(&posterior, &world), None);
    let set = found.set.expect("a policy that is proved the best");
    assert_eq!((set.id.as_str(), set.number, set.draws_used, set.world_id.as_str()), ("robust-4-0", 5, 75, "garden"));
    let ids: Vec<&str> = set.policies.iter().map(|policy| policy.id.as_str()).collect();
    assert_eq!(ids, ["robust", "mean"]);
    assert_eq!(set.policies[0].action_probabilities, found.policy.action_probabilities);
    assert!(set.policies.iter().all(|policy| policy.form == PolicyToJudge::TABULAR));
    let silent = Settings { judge: false, ..SETTINGS() };
    assert_eq!(policy(&silent, &inputs(&posterior, &world), None).set, None);
}

#[test]
fn too_few_steps_are_an_outcome_with_a_gap_and_not_judged() {
    let (posterior, world) = (posterior(3), world());
    let hasty = Settings { max_rounds: 1, max_iterations: 1, tolerance: 1e-12, lambda: 0.0, ..SETTINGS() };
    let found = policy(&hasty, &inputs(&posterior, &world), None);
    let message = &found.policy;
    assert_ne!(message.outcome, RobustPolicy::OPTIMAL, "{}", message.reason);
    assert!(message.gap > 0.0 && message.reason.contains("not proved the best"), "{}", message.reason);
    assert_eq!(found.set, None);
    let best = policy(&Settings { lambda: 0.0, ..SETTINGS() }, &inputs(&posterior, &world), None).policy;
    assert!(message.objective_value + message.gap >= best.objective_value - 1e-9, "the gap is a true one");
}

#[test]
fn regret_is_measured_against_the_paths_in_force() {
    let (posterior, world) = (posterior(1), world());
    let settings = Settings { objective: Objective::Regret, ..SETTINGS() };
    let good = demonstration("a", &[(0, 3), (1, 1), (4, 1)]);
    let with =
        |shown: &[&_]| policy(&settings, &Inputs { demonstrations: shown, ..inputs(&posterior, &world) }, None).policy;
    let found = with(&[&good]);
    assert_eq!(found.outcome, RobustPolicy::OPTIMAL, "{}", found.reason);
    let expert =
        robust::expert_feature_counts(&world.mdp, &[vec![(0, 3), (1, 1), (4, 1)]], world.mdp.gamma()).expect("a path");
    let k = posterior.feature_names.len();
    let draws: Vec<f64> = posterior.draws.iter().map(|&w| f64::from(w)).collect();
    let (first, _) = halves(&draws, k);
    let problem =
        Problem::new(&world.mdp, &first, None, robust::Objective::Regret { expert: &expert }, 1).expect("good");
    assert!(
        (problem.risk_of(&found.feature_counts, 0.95, 0.5).expect("good").objective - found.objective_value).abs()
            < 1e-9
    );
    assert_eq!(found.feature_counts.len(), k);
    // Nothing was shown yet: judged by its return, so that there is a policy, a bound on it, and a first question.
    let nothing = with(&[]);
    let robust = policy(&SETTINGS(), &inputs(&posterior, &world), None).policy;
    assert_eq!((nothing.outcome, nothing.objective), (RobustPolicy::OPTIMAL, RobustPolicy::ROBUST));
    assert_eq!(nothing.action_probabilities, robust.action_probabilities);
    assert_eq!(
        nothing.reason,
        format!("{}; by its return, for nothing was shown that regret could be measured against", robust.reason)
    );
    assert!(
        frontier(&settings, &inputs(&posterior, &world))
            .points
            .iter()
            .all(|point| point.outcome == RobustPolicy::OPTIMAL)
    );
    let jump = with(&[&demonstration("jump", &[(0, 3), (5, 1)])]);
    assert!(jump.reason.contains("'jump' does not: no action leads from state 0 to state 5"), "{}", jump.reason);

    // The node waits until the log holds everything that the posterior has taken in.
    let mut node = PolicyOptimizer::new(settings);
    let log =
        |records: Vec<EvidenceRecord>| Event::Evidence(Box::new(EvidenceLog { records, ..EvidenceLog::default() }));
    let start = vec![Event::World(Box::new(message())), Event::Posterior(Box::new(posterior.clone())), log(vec![])];
    assert!(outputs(&mut node, start).is_empty());
    let told = node.step(Time::default(), Event::Republish);
    assert!(
        matches!(told.as_slice(), [Output::Warn(text)] if text.contains("waits for the topic evidence")),
        "{told:?}"
    );
    let heard = outputs(&mut node, vec![log(vec![shown(1, &good)])]);
    assert_eq!(said(&heard), ["policy", "judge", "frontier"]);
    let Output::Policy(message) = &heard[0] else { panic!("the policy comes first") };
    assert_eq!(to_cdr(&**message), to_cdr(&found));
}

#[test]
fn draws_that_disagree_and_worlds_that_do_not_fit_give_a_reason_and_no_number() {
    let world = world();
    let torn = Posterior { outcome: Posterior::NOT_MIXED, reason: "R-hat is 1.4".into(), ..posterior(3) };
    let found = policy(&SETTINGS(), &inputs(&torn, &world), None);
    assert_eq!((found.policy.outcome, found.set), (RobustPolicy::NOT_COMPUTED, None));
    assert!(
        found.policy.reason.contains("the chains of the posterior disagree: R-hat is 1.4"),
        "{}",
        found.policy.reason
    );
    assert!(found.policy.expected_return.is_nan() && found.policy.action_probabilities.is_empty());
    let line = frontier(&SETTINGS(), &inputs(&torn, &world));
    assert_eq!((line.outcome, line.points.len(), &line.reason), (RobustPolicy::NOT_COMPUTED, 0, &found.policy.reason));

    let mut node = PolicyOptimizer::new(SETTINGS());
    let elsewhere = apprentice_msgs::msg::TabularWorld { gamma: 0.5, ..message() };
    let events = vec![Event::World(Box::new(elsewhere)), Event::Posterior(Box::new(posterior(3)))];
    assert!(outputs(&mut node, events).is_empty(), "the posterior is about another world");
    let told = node.step(Time::default(), Event::Republish);
    assert!(
        matches!(told.as_slice(), [Output::Warn(text)] if text.contains("waits for the world 'garden'")),
        "{told:?}"
    );
    let broken = apprentice_msgs::msg::TabularWorld { gamma: f64::NAN, ..message() };
    let told = outputs(&mut node, vec![Event::World(Box::new(broken.clone())), Event::World(Box::new(broken))]);
    assert_eq!(said(&told), ["warn"], "once");
    assert_eq!(said(&outputs(&mut node, vec![Event::World(Box::new(message()))])), ["policy", "judge", "frontier"]);
}

#[test]
fn chains_of_one_draw_choose_with_all_and_say_that_nothing_judged() {
    let (whole, world) = (posterior(3), world());
    let k = whole.feature_names.len();
    let single = Posterior { n_chains: 300, n_draws: 300, draws: whole.draws[..300 * k].to_vec(), ..whole.clone() };
    let found = policy(&SETTINGS(), &inputs(&single, &world), None);
    assert_eq!((found.policy.draws_used, found.policy.held_out, found.policy.n_draws), (0, 0, 300));
    assert!(found.policy.held_out_cvar.is_nan() && !found.policy.reason.contains("did not choose it"));
    let thinned = Settings { n_draws: 100, ..SETTINGS() };
    assert_eq!(policy(&thinned, &inputs(&whole, &world), None).policy.n_draws, 100);
}
