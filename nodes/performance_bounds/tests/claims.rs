//! The bounds are the rule's, of the published draws, with everything needed to check them.

use apprentice_msgs::builtin_interfaces::Time;
use apprentice_msgs::msg::{Candidates, PerformanceBounds, PlacementBound, Posterior};
use apprentice_msgs::std_msgs::Header;
use apprentice_msgs::to_cdr;
use bus::testing::check_parameters;
use exchange::scene_to_message;
use performance_bounds::{Event, Output, PerformanceBoundsNode, Settings};
use placement::{LossBatch, placement_losses};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use scene::{Object, Point, Rbf, Scene, Shape};

fn object(id: &str, x: f64, y: f64, radius_m: f64) -> Object {
    Object {
        id: id.into(),
        label: id.into(),
        shape: Shape::Cylinder { radius_m, height_m: 0.1 },
        position_m: Point::new(x, y),
        yaw_rad: 0.0,
        supports: false,
    }
}

fn table(id: &str, x: f64) -> Scene {
    Scene {
        id: id.into(),
        frame: "table".into(),
        width_m: 1.0,
        depth_m: 1.0,
        objects: vec![object("cup", x, 0.25, 0.05)],
        target: object("vase", 0.0, 0.0, 0.04),
    }
}

/// Independent draws that put the target near the middle: what a sampler would give, without its autocorrelation.
fn posterior(n_draws: u32, revision: u64) -> Posterior {
    let mut rng = ChaCha8Rng::seed_from_u64(7);
    let middle = |k: usize| if k == 5 { 0.6 } else { 0.0 };
    let draw =
        |rng: &mut ChaCha8Rng| (0..10).map(|k| middle(k) + rng.random_range(-0.05..0.05_f32)).collect::<Vec<_>>();
    Posterior {
        header: Header { stamp: Time { sec: 3, nanosec: 1 }, frame_id: "table".into() },
        revision,
        evidence_hash: "abc".into(),
        n_demonstrations: revision,
        feature_names: Rbf::names(&table("t", 0.25)),
        n_chains: 4,
        n_draws,
        draws: (0..n_draws).flat_map(|_| draw(&mut rng)).collect(),
        map_weights: (0..10).map(|k| f64::from(middle(k))).collect(),
        rhat_max: 1.002,
        acceptance: 0.9,
        beta: 100.0,
        prior: "l1_sphere".into(),
        seed: 5,
        version: "v".into(),
        ..Posterior::default()
    }
}

fn judged(settings: Settings, posterior: &Posterior, scenes: &[Scene]) -> Vec<Output> {
    let mut node = PerformanceBoundsNode::new(settings);
    let candidates = Candidates {
        revision: posterior.revision,
        scenes: scenes.iter().map(|scene| scene_to_message(scene, Time::default())).collect(),
        ..Candidates::default()
    };
    let mut outputs = node.step(Time::default(), Event::Posterior(Box::new(posterior.clone())));
    outputs.extend(node.step(Time::default(), Event::Candidates(Box::new(candidates.clone()))));
    assert!(
        node.step(Time::default(), Event::Candidates(Box::new(candidates))).is_empty(),
        "a repetition changes nothing"
    );
    outputs
}

fn bounds(settings: Settings, posterior: &Posterior, scenes: &[Scene]) -> PerformanceBounds {
    match judged(settings, posterior, scenes).as_slice() {
        [Output::Bounds(bounds)] => (**bounds).clone(),
        other => panic!("bounds were expected, got {other:?}"),
    }
}

#[test]
fn parameters_are_documented() {
    check_parameters::<Settings>();
}

#[test]
fn every_bound_is_the_rule_on_the_losses_of_the_published_draws() {
    let (posterior, scenes) = (posterior(4000, 2), [table("a", 0.2), table("b", 0.45)]);
    let got = bounds(Settings::default(), &posterior, &scenes);
    let batch = LossBatch { draws: &posterior.draws, n_features: 10, map_weights: &posterior.map_weights, threads: 1 };
    // The third look of the session, shared by two tables.
    let delta = risk::delta_spent(0.05, 3) / 2.0;
    for (bound, losses) in got.bounds.iter().zip(placement_losses(&scenes, &batch)) {
        let losses = losses.expect("the table has room");
        let rule = risk::upper_bound(&losses.losses_m, 4, 0.95, delta).expect("the losses are finite");
        assert_eq!(Some(bound.bound_m), rule.bound());
        assert_eq!((bound.n, bound.ess, bound.rhat), (4000, rule.receipt().ess, rule.receipt().rhat));
        let within = losses.losses_m.iter().filter(|&&loss| loss <= bound.bound_m).count();
        assert!(within >= 3800 && bound.index as usize <= within, "{within} of 4000 at index {}", bound.index);
    }
    assert_eq!((got.look, got.delta_spent), (3, delta));
}

#[test]
fn the_receipt_is_complete_and_the_largest_bound_leads() {
    let posterior = posterior(4000, 2);
    let got = bounds(Settings::default(), &posterior, &[table("a", 0.2), table("b", 0.45), table("c", 0.8)]);
    let largest = got.bounds.iter().map(|b| b.bound_m).fold(0.0, f64::max);
    assert_eq!((got.outcome, got.bound_m), (PlacementBound::BOUND, largest));
    assert_eq!(got.bounds[got.worst as usize].bound_m, largest);
    assert_eq!((got.alpha, got.delta, got.n, got.n_chains), (0.95, 0.05, 4000, 4));
    assert_eq!((got.beta, got.prior.as_str(), got.seed, got.version.as_str()), (100.0, "l1_sphere", 5, "v"));
    assert_eq!((got.evidence_hash.as_str(), got.acceptance, &got.header), ("abc", 0.9, &posterior.header));
    assert!(got.rhat_max >= 1.002 && got.ess_min > 500.0 && got.ess_min <= 4000.0);
    assert!(got.reason.starts_with("95 % sure: 95 in 100"), "{}", got.reason);
}

#[test]
fn no_bound_is_an_answer_with_what_it_would_take() {
    let strict = Settings { alpha: 0.99, ..Settings::default() };
    let few = bounds(strict, &posterior(800, 2), &[table("a", 0.2)]);
    assert_eq!(few.outcome, PlacementBound::NOT_ENOUGH_SAMPLES);
    assert!(few.bound_m.is_nan() && few.bounds[0].point_estimate_m > 0.0 && few.bounds[0].needed > 800);
    assert!(few.reason.starts_with("no bound, because ") && few.reason.contains("n_draws"), "{}", few.reason);

    let mut apart = posterior(4000, 2);
    for draw in apart.draws.chunks_exact_mut(10).take(1000) {
        draw[8] = 2.0;
    }
    let apart = bounds(Settings::default(), &apart, &[table("a", 0.2)]);
    assert_eq!(apart.outcome, PlacementBound::NOT_MIXED);
    assert!(apart.reason.contains("the chains disagree"), "{}", apart.reason);

    let refused = Posterior { outcome: Posterior::NOT_MIXED, reason: "because".into(), ..posterior(4000, 2) };
    let refused = bounds(Settings::default(), &refused, &[table("a", 0.2)]);
    assert_eq!((refused.outcome, refused.bound_m.is_nan()), (PlacementBound::NOT_MIXED, true));

    let mut full = table("full", 0.2);
    full.target.shape = Shape::Cylinder { radius_m: 0.6, height_m: 0.1 };
    let full = bounds(Settings::default(), &posterior(4000, 2), &[full]);
    assert_eq!(full.outcome, PlacementBound::NO_PLACEMENT);
}

#[test]
fn the_number_of_threads_changes_no_bit() {
    let scenes = [table("a", 0.2), table("b", 0.45)];
    let of = |threads| to_cdr(&bounds(Settings { threads, ..Settings::default() }, &posterior(4000, 1), &scenes));
    assert_eq!(of(1), of(3));
}

#[test]
fn what_does_not_fit_is_told_and_survived() {
    let told = |posterior: &Posterior, scenes: &[Scene]| match judged(Settings::default(), posterior, scenes).as_slice()
    {
        [Output::Warn(text)] => text.clone(),
        other => panic!("a warning was expected, got {other:?}"),
    };
    let broken = Posterior { map_weights: vec![0.0], ..posterior(400, 2) };
    assert_eq!(told(&broken, &[table("a", 0.2)]), "posterior 2 is ignored: it has 10 features but 1 MAP weights");
    let mut other = table("a", 0.2);
    other.objects[0].id = "pan".into();
    assert!(told(&posterior(400, 2), &[other]).contains("the objects of scene 'a' are not those of the posterior"));
    assert!(told(&posterior(400, 2), &[]).contains("0 tables to judge"));
}
