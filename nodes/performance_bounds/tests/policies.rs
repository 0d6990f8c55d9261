//! Any policy that is sent is judged by the rule, on the published draws, in whatever form and order things come.

use apprentice_msgs::builtin_interfaces::Time;
use apprentice_msgs::msg::{
    FeatureTrajectory, PolicyBound, PolicyBounds, PolicySet, PolicyToJudge, Posterior, Rationality, RiskBound,
    TabularWorld,
};
use apprentice_msgs::to_cdr;
use exchange::{World, world_from_message};
use mdp::{Policy, Solver, feature_counts, policy_losses};
use performance_bounds::{Event, Output, PerformanceBoundsNode, Settings};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Three states in a row with a feature each; left, right. From the middle.
fn message() -> TabularWorld {
    TabularWorld {
        id: "row".into(),
        gamma: 0.9,
        n_states: 3,
        n_actions: 2,
        feature_names: vec!["left".into(), "middle".into(), "right".into()],
        initial: vec![0.0, 1.0, 0.0],
        from_state: vec![0, 0, 1, 1, 2, 2],
        action: vec![0, 1, 0, 1, 0, 1],
        to_state: vec![0, 1, 0, 2, 1, 2],
        probability: vec![1.0; 6],
        features: vec![1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0],
        ..TabularWorld::default()
    }
}

fn world() -> World {
    world_from_message(&message()).expect("the world is good")
}

/// Independent draws near `centre` on the L1 sphere: what a sampler would give, without its autocorrelation.
fn posterior(n_draws: u32, centre: [f64; 3]) -> Posterior {
    let mut rng = ChaCha8Rng::seed_from_u64(7);
    let draw = |rng: &mut ChaCha8Rng| {
        let w = centre.map(|w| w + rng.random_range(-0.2..0.2_f64));
        let size: f64 = w.iter().map(|w| w.abs()).sum();
        w.map(|w| (w / size) as f32)
    };
    Posterior {
        revision: 2,
        evidence_hash: "abc".into(),
        world: world().reference(),
        feature_names: message().feature_names,
        n_chains: 4,
        n_draws,
        draws: (0..n_draws).flat_map(|_| draw(&mut rng)).collect(),
        map_weights: centre.to_vec(),
        rhat_max: 1.002,
        acceptance: 0.9,
        rationalities: vec![Rationality { kind: "actions".into(), n: 3, ..Rationality::default() }],
        prior: "l1_sphere".into(),
        seed: 5,
        version: "v".into(),
        ..Posterior::default()
    }
}

const RIGHT: [f64; 3] = [-0.2, 0.1, 0.7];

fn counts(id: &str, feature_counts: &[f64]) -> PolicyToJudge {
    PolicyToJudge { id: id.into(), feature_counts: feature_counts.to_vec(), ..PolicyToJudge::default() }
}

fn always(id: &str, action: u32) -> PolicyToJudge {
    PolicyToJudge { id: id.into(), form: PolicyToJudge::TABULAR, actions: vec![action; 3], ..PolicyToJudge::default() }
}

fn set(number: u64, policies: &[PolicyToJudge]) -> PolicySet {
    PolicySet {
        id: format!("set {number}"),
        number,
        world_id: "row".into(),
        policies: policies.to_vec(),
        ..PolicySet::default()
    }
}

fn outputs(settings: &Settings, events: Vec<Event>) -> Vec<Output> {
    let mut node = PerformanceBoundsNode::new(settings.clone());
    events.into_iter().flat_map(|event| node.step(Time::default(), event)).collect()
}

fn bounds_of(settings: &Settings, posterior: &Posterior, set: &PolicySet) -> PolicyBounds {
    let events = vec![
        Event::World(Box::new(message())),
        Event::Posterior(Box::new(posterior.clone())),
        Event::Policies(Box::new(set.clone())),
    ];
    match outputs(settings, events).as_slice() {
        [Output::PolicyBounds(bounds)] => (**bounds).clone(),
        other => panic!("bounds were expected, got {other:?}"),
    }
}

fn bounds(policies: &[PolicyToJudge]) -> PolicyBounds {
    bounds_of(&Settings::default(), &posterior(4000, RIGHT), &set(1, policies))
}

fn returns(posterior: &Posterior, counts: &[f64]) -> Vec<f64> {
    let of = |w: &[f32]| w.iter().zip(counts).map(|(&w, phi)| f64::from(w) * phi).sum();
    posterior.draws.chunks_exact(counts.len()).map(of).collect()
}

#[test]
fn every_bound_is_the_rule_on_the_published_draws() {
    // Under the other posterior even the best return is negative.
    for centre in [RIGHT, [-0.7, -0.3, -0.1]] {
        is_the_rule(&posterior(4000, centre));
    }
}

fn is_the_rule(posterior: &Posterior) {
    let got = bounds_of(&Settings::default(), posterior, &set(3, &[always("right", 1), always("left", 0)]));
    // The third look at the third set, shared by two policies with four bounds each.
    let delta = risk::delta_spent(risk::delta_spent(0.05, 3), 3) / 4.0 / 2.0;
    assert_eq!((got.look, got.set_number, got.delta_spent), (3, 3, delta));
    let draws: Vec<f64> = posterior.draws.iter().map(|&w| f64::from(w)).collect();
    for (bound, action) in got.policies.iter().zip([1, 0]) {
        let phi = feature_counts(&world().mdp, &Policy::Deterministic(vec![action; 3])).expect("a policy of the world");
        assert_eq!(bound.feature_counts, phi);
        let rule = risk::lower_bound(&returns(posterior, &phi), 4, 0.95, delta).expect("finite returns");
        assert_eq!(Some(bound.return_bound.bound), rule.bound());
        assert!((bound.return_bound.mean - rule.receipt().mean).abs() < 1e-12);
        let losses = policy_losses(&world().mdp, &phi, &draws, 1).expect("finite draws");
        let rule = risk::upper_bound(&losses, 4, 0.95, delta).expect("finite losses");
        let known = rule.bound().expect("4000 independent draws are enough");
        assert!((bound.loss_bound.bound - known).abs() < 1e-12 * (1.0 + known), "{known} {:?}", bound.loss_bound);
        let within = losses.iter().filter(|&&loss| loss <= bound.loss_bound.bound).count();
        assert!(within >= 3800, "{within}");
        assert!(bound.loss_cvar.bound >= bound.loss_cvar.point_estimate);
        assert!(bound.loss_cvar.point_estimate >= bound.loss_bound.point_estimate);
        assert!(bound.rollout_standard_error.is_nan() && bound.n_rollouts == 0);
    }
    let [right, left] = got.policies.as_slice() else { panic!("{got:?}") };
    assert_eq!((right.rank, left.rank, right.rank_by_mean, left.rank_by_mean), (1, 2, 1, 2));
    assert!(right.loss_bound.bound < 0.2 * left.loss_bound.bound && right.normalised_loss.bound < 0.5);
    assert!(left.normalised_loss.bound > 1.0, "it is worse than choosing at random");
    assert!((right.probability_best + left.probability_best - 1.0).abs() < 1e-12);
}

#[test]
fn the_worst_case_behind_the_tail_mean_is_the_worst_of_the_whole_sphere() {
    // With few draws the bound on the tail mean rests on the worst case, and must not be less than any draw can give.
    let got = bounds(&[always("left", 0)]);
    let phi = &got.policies[0].feature_counts;
    let world = world();
    let mut solver = Solver::new(&world.mdp);
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    let mut worst: f64 = 0.0;
    for _ in 0..2000 {
        let w: [f64; 3] = std::array::from_fn(|_| rng.random_range(-1.0..1.0));
        let size: f64 = w.iter().map(|w| w.abs()).sum();
        let w = w.map(|w| w / size);
        let value: f64 = w.iter().zip(phi).map(|(w, phi)| w * phi).sum();
        worst = worst.max(solver.solve(&w).value() - value);
    }
    let shift = got.policies[0].loss_cvar.shift;
    let least = got.policies[0].loss_cvar.point_estimate;
    let bound = got.policies[0].loss_cvar.bound;
    assert!(shift > 0.0 && bound >= least && bound <= worst * 1.05, "{shift} {bound} {worst}");
}

#[test]
fn the_same_policy_is_judged_alike_in_every_form() {
    let phi = feature_counts(&world().mdp, &Policy::Deterministic(vec![1; 3])).expect("a policy of the world");
    let rollout =
        |id: &str, by: f64| FeatureTrajectory { id: id.into(), features: vec![phi[0] + by, phi[1] - by, phi[2]] };
    let rollouts = PolicyToJudge {
        id: "rollouts".into(),
        form: PolicyToJudge::ROLLOUTS,
        rollouts: vec![rollout("a", 0.5), rollout("b", -0.5)],
        ..PolicyToJudge::default()
    };
    let table = PolicyToJudge {
        id: "stochastic".into(),
        form: PolicyToJudge::TABULAR,
        action_probabilities: vec![0.0, 1.0, 0.0, 1.0, 0.0, 1.0],
        ..PolicyToJudge::default()
    };
    let got = bounds(&[always("table", 1), counts("counts", &phi), rollouts, table]);
    let [one, rest @ ..] = got.policies.as_slice() else { panic!("{got:?}") };
    let near = |a: &RiskBound, b: &RiskBound| (a.bound - b.bound).abs() < 1e-9 && (a.mean - b.mean).abs() < 1e-9;
    for other in rest {
        assert!(near(&one.return_bound, &other.return_bound) && near(&one.loss_bound, &other.loss_bound), "{other:?}");
    }
    assert_eq!((rest[1].n_rollouts, rest[1].form, rest[2].form), (2, PolicyToJudge::ROLLOUTS, PolicyToJudge::TABULAR));
    // Returns a and b differ by w0 - w1 under the mean weights, and their mean has half of that as its standard error.
    let mean = |i: usize| {
        let posterior = posterior(4000, RIGHT);
        posterior.draws.iter().skip(i).step_by(3).map(|&w| f64::from(w)).sum::<f64>() / 4000.0
    };
    let expected = (mean(0) - mean(1)).abs() / 2.0;
    assert!((rest[1].rollout_standard_error - expected).abs() < 1e-9, "{expected} {:?}", rest[1]);
}

#[test]
fn a_policy_that_profits_from_what_nobody_said_is_warned_of() {
    // As the no-op of Tables 6.7 and 6.8: a long way through a feature of which the evidence says little.
    let mut posterior = posterior(4000, [0.0, 0.05, 0.6]);
    let mut rng = ChaCha8Rng::seed_from_u64(9);
    for w in posterior.draws.chunks_exact_mut(3) {
        w[1] = 0.05 + rng.random_range(-0.3..0.3_f32);
    }
    let policies = [
        counts("a", &[0.0, 1.0, 1.0]),
        counts("b", &[0.0, 1.0, 3.0]),
        counts("c", &[0.0, 1.0, 5.0]),
        counts("no-op", &[0.0, 300.0, 0.0]),
    ];
    let got = bounds_of(&Settings::default(), &posterior, &set(1, &policies));
    let of = |id: &str| got.policies.iter().find(|one| one.id == id).expect("it was judged");
    let no_op = of("no-op");
    assert_eq!((no_op.rank, no_op.rank_by_mean), (4, 1), "{no_op:?}");
    assert!(no_op.warning.starts_with("its mean return, ") && no_op.warning.contains("is below"), "{}", no_op.warning);
    assert!(["a", "b", "c"].iter().all(|id| of(id).warning.is_empty()));
}

#[test]
fn the_receipt_is_complete_and_its_claim_is_of_the_best() {
    let got = bounds(&[always("left", 0), always("right", 1)]);
    assert_eq!((got.alpha, got.delta, got.n, got.n_chains), (0.95, 0.05, 4000, 4));
    assert_eq!((got.prior.as_str(), got.seed, got.version.as_str()), ("l1_sphere", 5, "v"));
    assert_eq!((got.evidence_hash.as_str(), got.acceptance, got.world.id.as_str()), ("abc", 0.9, "row"));
    assert_eq!((got.rationalities.len(), got.set_id.as_str(), got.outcome), (1, "set 1", RiskBound::BOUND));
    assert!(got.rhat_max >= 1.002 && got.ess_min > 500.0 && got.ess_min <= 4000.0);
    let claim =
        "95 % sure: with policy 'right', which ranks first of 2, 95 in 100 of the rewards that fit the evidence";
    assert!(got.reason.starts_with(claim) && got.reason.contains("lose no more than"), "{}", got.reason);
}

#[test]
fn no_bound_is_an_answer_with_its_reason() {
    let judged = |change: fn(&mut Posterior), alpha| {
        let mut posterior = posterior(800, RIGHT);
        change(&mut posterior);
        let settings = Settings { alpha, ..Settings::default() };
        bounds_of(&settings, &posterior, &set(1, &[always("right", 1)]))
    };
    let first = |bounds: &PolicyBounds| -> PolicyBound { bounds.policies[0].clone() };
    let few = judged(|_| {}, 0.99);
    assert_eq!(few.outcome, RiskBound::NOT_ENOUGH_SAMPLES);
    assert!(first(&few).return_bound.bound.is_nan() && first(&few).return_bound.needed > 800);
    assert!(few.reason.starts_with("policy 'right': no bound, because ") && few.reason.contains("n_draws"), "{few:?}");
    let apart = judged(|p| p.draws[..600].iter_mut().for_each(|w| *w = -*w), 0.95);
    assert_eq!(apart.outcome, RiskBound::NOT_MIXED);
    let unmixed = judged(|p| (p.outcome, p.reason) = (Posterior::NOT_MIXED, "because".into()), 0.95);
    let one = first(&unmixed);
    for bound in [one.return_bound, one.loss_bound, one.loss_cvar, one.normalised_loss] {
        assert_eq!((bound.outcome, bound.bound.is_nan()), (RiskBound::NOT_MIXED, true));
        assert_eq!(bound.reason, "no bound, because the chains disagree: because");
    }
    let unbounded = first(&judged(|p| p.prior = "gaussian".into(), 0.95));
    assert_eq!(unbounded.loss_cvar.outcome, RiskBound::UNBOUNDED);
    assert!(unbounded.loss_cvar.reason.contains("arbitrarily large"), "{unbounded:?}");
    assert_eq!(unbounded.loss_bound.outcome, RiskBound::BOUND);
    let mut worldless = posterior(4000, RIGHT);
    worldless.world = Default::default();
    let worldless = bounds_of(&Settings::default(), &worldless, &set(1, &[counts("a", &[0.0, 1.0, 2.0])]));
    let one = first(&worldless);
    assert_eq!((worldless.outcome, one.loss_bound.outcome), (RiskBound::BOUND, RiskBound::NOT_JUDGED));
    assert!(one.loss_bound.reason.starts_with("no bound, because this lesson is about no world"));
    assert_eq!(worldless.delta_spent, risk::delta_spent(risk::delta_spent(0.05, 3), 1), "one bound, all of the share");
}

#[test]
fn the_order_in_which_things_come_changes_nothing() {
    let events = || {
        [
            Event::World(Box::new(message())),
            Event::Posterior(Box::new(posterior(800, RIGHT))),
            Event::Policies(Box::new(set(1, &[always("right", 1), counts("a", &[1.0, 1.0, 1.0])]))),
        ]
    };
    let mut told = Vec::new();
    for order in [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]] {
        let mut shuffled: Vec<Event> = order.iter().map(|&i| events()[i].clone()).collect();
        // What comes again changes nothing.
        shuffled.extend(events());
        match outputs(&Settings::default(), shuffled).as_slice() {
            [Output::PolicyBounds(bounds)] => told.push(to_cdr(&**bounds)),
            other => panic!("{order:?}: {other:?}"),
        }
    }
    assert!(told.iter().all(|bytes| *bytes == told[0]));
}

#[test]
fn the_number_of_threads_changes_no_bit() {
    let of = |threads| {
        let settings = Settings { threads, ..Settings::default() };
        to_cdr(&bounds_of(&settings, &posterior(800, RIGHT), &set(1, &[always("right", 1)])))
    };
    assert_eq!(of(1), of(3));
}

#[test]
fn every_new_posterior_and_every_new_set_is_a_look() {
    let mut node = PerformanceBoundsNode::new(Settings::default());
    let mut step = |event| node.step(Time::default(), event);
    step(Event::World(Box::new(message())));
    let mut looks = Vec::new();
    for (revision, number) in [(0, 1), (1, 1), (1, 2), (2, 2)] {
        let posterior = Posterior { revision, ..posterior(800, RIGHT) };
        let mut outputs = step(Event::Posterior(Box::new(posterior)));
        outputs.extend(step(Event::Policies(Box::new(set(number, &[always("right", 1)])))));
        looks.extend(outputs.into_iter().filter_map(|output| match output {
            Output::PolicyBounds(bounds) => Some((bounds.look, bounds.set_number, bounds.delta_spent)),
            _ => None,
        }));
    }
    let spent = |t, s| (t, s, risk::delta_spent(risk::delta_spent(0.05, t), s) / 4.0);
    assert_eq!(looks, [spent(1, 1), spent(2, 1), spent(2, 2), spent(3, 2)]);
    let total: f64 = (1..300).flat_map(|t| (1..300).map(move |s| spent(t, s).2 * 4.0)).sum();
    assert!(total < 0.05 && total > 0.049, "{total}");
    assert!(matches!(step(Event::Republish).as_slice(), [Output::PolicyBounds(bounds)] if bounds.look == 3));
}

#[test]
fn what_cannot_be_judged_is_told_once_and_survived() {
    let mut node = PerformanceBoundsNode::new(Settings::default());
    let mut told = |event: Event| match node.step(Time::default(), event).as_slice() {
        [] => None,
        [Output::Warn(text)] => Some(text.clone()),
        other => panic!("a warning at most was expected, got {other:?}"),
    };
    let policies = |set: &PolicySet| Event::Policies(Box::new(set.clone()));
    assert_eq!(told(Event::Posterior(Box::new(posterior(800, RIGHT)))), None);
    assert_eq!(told(policies(&set(1, &[always("a", 1)]))), None, "the world may still be on its way");
    let waits = "policies 'set 1' wait for the world 'row' that the lesson is about: it must be on the topic world or lesson_world";
    assert_eq!(told(Event::Republish).as_deref(), Some(waits));
    assert_eq!(told(Event::Republish), None);
    let other = "policies 'set 1' are ignored: another set came with number 1 before";
    assert_eq!(told(policies(&set(1, &[always("b", 1)]))).as_deref(), Some(other));
    let broken = TabularWorld { gamma: 2.0, ..message() };
    assert!(
        told(Event::World(Box::new(broken))).is_some_and(|text| text.starts_with("the world 'row' is ignored: gamma"))
    );
    let elsewhere = TabularWorld { gamma: 0.5, ..message() };
    assert_eq!(told(Event::World(Box::new(elsewhere))), None, "another world than the posterior's judges nothing");
    let short = set(2, &[counts("a", &[1.0])]);
    assert_eq!(told(policies(&short)), None);
    let reason = "policies 'set 2' are ignored: policy 'a' has 1 feature counts, but this lesson has 3 weights";
    assert_eq!(told(Event::World(Box::new(message()))).as_deref(), Some(reason));
    assert_eq!(told(policies(&short)), None, "once");
    let hostile = [
        (set(3, &[]), "it holds 0 policies"),
        (set(4, &vec![always("a", 1); 2000]), "it holds 2000 policies"),
        (set(0, &[always("a", 1)]), "its number is 0"),
        (set(5, &[counts("a", &[f64::NAN, 0.0, 0.0])]), "feature count 0 of policy 'a' is NaN"),
        (set(6, &[always("a", 9)]), "action is 9"),
        (set(7, &[PolicyToJudge { form: 9, ..always("a", 1) }]), "is of form 9"),
        (PolicySet { world_id: "moon".into(), ..set(8, &[always("a", 1)]) }, "it is about the world 'moon'"),
        (PolicySet { id: String::new(), ..set(9, &[always("a", 1)]) }, "its id has 0 characters"),
    ];
    for (set, wanted) in hostile {
        let text = told(policies(&set)).expect("it cannot be judged");
        assert!(text.contains(wanted) && !text.contains('\n'), "{wanted}: {text}");
    }
    let good = node.step(Time::default(), Event::Policies(Box::new(set(10, &[always("a", 1)]))));
    assert!(matches!(good.as_slice(), [Output::PolicyBounds(_)]), "{good:?}");
}

#[test]
fn policies_are_judged_by_draws_that_did_not_choose_them() {
    let posterior = posterior(4000, RIGHT);
    let chosen = |draws_used: u32| PolicySet { draws_used, ..set(2, &[always("right", 1), always("left", 0)]) };
    let half = bounds_of(&Settings::default(), &posterior, &chosen(400));
    assert_eq!((half.n, half.n_chains), (2400, 4));
    // The same as if the later draws were all there are.
    let k = posterior.feature_names.len();
    let later = posterior.draws.chunks_exact(1000 * k).flat_map(|chain| chain[400 * k..].to_vec()).collect();
    let rest = Posterior { n_draws: 2400, draws: later, ..posterior.clone() };
    let alone = bounds_of(&Settings::default(), &rest, &chosen(0));
    assert_eq!(to_cdr(&half), to_cdr(&alone));
    let all = bounds_of(&Settings::default(), &posterior, &chosen(0));
    assert_ne!(half.policies[0].return_bound.mean.to_bits(), all.policies[0].return_bound.mean.to_bits());
    let events = vec![
        Event::World(Box::new(message())),
        Event::Posterior(Box::new(posterior.clone())),
        Event::Policies(Box::new(chosen(1000))),
    ];
    match outputs(&Settings::default(), events).as_slice() {
        [Output::Warn(text)] => assert!(text.contains("none is left to judge them"), "{text}"),
        other => panic!("a warning was expected, got {other:?}"),
    }
}
