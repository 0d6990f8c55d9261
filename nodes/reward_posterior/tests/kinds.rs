//! Each kind of evidence says what it should about the weights, alone and beside others, and no more.

mod support;

use apprentice_msgs::msg::{CritiqueSegment, Posterior, PosteriorPreview, TrajectoryPreference};
use reward_posterior::{Event, Prior, Settings};
use support::{
    Bench, LEFT, RIGHT, acted, back, bits, critique, history, mean, ranked, returns, row, settings, shown, table,
    trajectory,
};

/// What is known of the rationality of a kind.
fn of(posterior: &Posterior, kind: &str) -> apprentice_msgs::msg::Rationality {
    posterior.rationalities.iter().find(|one| one.kind == kind).expect("every kind is there").clone()
}

#[test]
fn who_walks_to_the_right_likes_the_right() {
    let mut bench = Bench::in_row(settings(), 5);
    let before = mean(&bench.posterior());
    bench.take(Event::Actions(Box::new(acted("a", &[(2, RIGHT), (3, RIGHT), (4, RIGHT), (2, RIGHT)]))));
    let after = bench.posterior();
    assert!(before.iter().all(|w| w.abs() < 0.1), "the prior knows nothing: {before:?}");
    let after_mean = mean(&after);
    let others = after_mean[..4].iter().fold(f64::NEG_INFINITY, |most, w| most.max(*w));
    assert!(after_mean[4] > others + 0.1, "{after_mean:?}");
    assert_eq!((of(&after, "actions").n, of(&after, "placements").n, after.n_demonstrations), (1, 0, 0));
    assert_eq!((after.world.id.as_str(), after.world.hash.len(), after.feature_names[4].as_str()), ("row", 64, "at 4"));
}

#[test]
fn a_critique_tells_good_from_bad_and_nothing_of_the_rest() {
    let steps = [(1, LEFT), (2, RIGHT), (3, RIGHT)];
    let of = |segments: &[(u32, u32, u8)]| {
        let mut bench = Bench::in_row(settings(), 5);
        bench.take(Event::Critique(Box::new(critique("c", &steps, segments))));
        bench.posterior()
    };
    let good = mean(&of(&[(1, 3, CritiqueSegment::GOOD)]));
    let bad = mean(&of(&[(1, 3, CritiqueSegment::BAD)]));
    assert!(good[4] > good[0] + 0.1, "the right is good: {good:?}");
    assert!(bad[4] < bad[0] - 0.1, "the right is bad: {bad:?}");
    let mut other_rest = critique("c", &steps, &[(1, 3, CritiqueSegment::GOOD)]);
    other_rest.actions[0] = RIGHT;
    let mut bench = Bench::in_row(settings(), 5);
    bench.take(Event::Critique(Box::new(other_rest)));
    let unmarked = bench.posterior();
    let marked = of(&[(1, 3, CritiqueSegment::GOOD)]);
    assert!((unmarked.map_log_likelihood - marked.map_log_likelihood).abs() < 1e-6, "what is not marked says nothing");
}

#[test]
fn a_ranking_is_all_of_its_pairs() {
    let [a, b, c] = [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]];
    let [ta, tb, tc] = [trajectory("a", &a), trajectory("b", &b), trajectory("c", &c)];
    let settings = Settings { beta_preferences: 8.0, ..settings() };
    let mut whole = Bench::in_row(settings.clone(), 3);
    whole.take(Event::Preference(Box::new(ranked("p", &[ta.clone(), tb.clone(), tc.clone()]))));
    let whole = whole.posterior();
    let mut pairs = Bench::in_row(settings, 3);
    for (i, pair) in [[&ta, &tb], [&ta, &tc], [&tb, &tc]].into_iter().enumerate() {
        pairs.take(Event::Preference(Box::new(ranked(&format!("p{i}"), &pair.map(Clone::clone)))));
    }
    let pairs = pairs.posterior();
    let (one, three) = (whole.map_log_likelihood, pairs.map_log_likelihood);
    assert!((one - three).abs() < 1e-3, "the same likelihood: {one} and {three}");
    assert_eq!((of(&whole, "preferences").n, of(&pairs, "preferences").n), (1, 3));
    let mean_of = |features: &[f64]| returns(&whole, features).iter().sum::<f64>() / f64::from(whole.n_draws);
    assert!(mean_of(&a) < mean_of(&b) && mean_of(&b) < mean_of(&c));
}

#[test]
fn about_equal_and_cannot_tell_are_data_unless_they_are_not_expected() {
    let pair = [trajectory("a", &[1.0, 0.0, 0.0]), trajectory("b", &[0.0, 1.0, 0.0])];
    let said = |answer| TrajectoryPreference { answer, ..ranked("p", &pair) };
    let spread = |answer| {
        let mut bench = Bench::in_row(Settings { beta_preferences: 20.0, ..settings() }, 3);
        bench.take(Event::Preference(Box::new(said(answer))));
        let difference = returns(&bench.posterior(), &[1.0, -1.0, 0.0]);
        difference.iter().map(|d| d * d).sum::<f64>() / difference.len() as f64
    };
    let mut prior = Bench::in_row(settings(), 3);
    let difference = returns(&prior.posterior(), &[1.0, -1.0, 0.0]);
    let before = difference.iter().map(|d| d * d).sum::<f64>() / difference.len() as f64;
    for answer in [TrajectoryPreference::EQUAL, TrajectoryPreference::CANT_TELL] {
        assert!(spread(answer) < 0.5 * before, "{answer}: {} against {before}", spread(answer));
    }
    let mut strict = Bench::in_row(Settings { equal_threshold: 0.0, cant_tell: 0.0, ..settings() }, 3);
    assert_eq!(
        strict.refused(Event::Preference(Box::new(said(TrajectoryPreference::EQUAL)))),
        "it says 'about equal', which is not expected while equal_threshold is 0"
    );
    assert_eq!(
        strict.refused(Event::Preference(Box::new(said(TrajectoryPreference::CANT_TELL)))),
        "it says 'can't tell', which is not expected while cant_tell is 0"
    );
}

#[test]
fn a_learner_gets_better_but_that_is_a_weak_preference() {
    let attempts = [trajectory("a", &[1.0, 0.0, 0.0]), trajectory("b", &[0.0, 0.0, 1.0])];
    let gain = |event: Event| {
        let mut bench = Bench::in_row(settings(), 3);
        bench.take(event);
        let posterior = bench.posterior();
        returns(&posterior, &[-1.0, 0.0, 1.0]).iter().sum::<f64>() / f64::from(posterior.n_draws)
    };
    let (weak, strong) = (
        gain(Event::History(Box::new(history("h", &attempts)))),
        gain(Event::Preference(Box::new(ranked("p", &attempts)))),
    );
    assert!(weak > 0.01 && weak < 0.6 * strong, "{weak} and {strong}");
}

#[test]
fn confidence_counts_as_a_factor_on_rationality() {
    let pair = [trajectory("a", &[1.0, 0.0, 0.0]), trajectory("b", &[0.0, 1.0, 0.0])];
    let likelihood = |settings: Settings, confidence| {
        let mut bench = Bench::in_row(settings, 3);
        bench.take(Event::Preference(Box::new(TrajectoryPreference { confidence, ..ranked("p", &pair) })));
        bench.posterior().map_log_likelihood
    };
    let halved = Settings { beta_preferences: 0.5, ..settings() };
    let (fairly, sure) = (
        likelihood(settings(), TrajectoryPreference::CONFIDENCE_FAIRLY),
        likelihood(halved, TrajectoryPreference::CONFIDENCE_SURE),
    );
    assert!((fairly - sure).abs() < 1e-9, "{fairly} and {sure}");
}

#[test]
fn all_kinds_stand_together_in_one_posterior() {
    let mut bench = Bench::new(settings());
    bench.step(Event::Scene(Box::new(table())));
    bench.step(Event::World(Box::new(row("row", 11))));
    bench.take(Event::Demonstration(Box::new(shown("d", 0.5, 0.5))));
    bench.take(Event::Actions(Box::new(acted("a", &[(5, RIGHT)]))));
    let unit = |k: usize| (0..11).map(|i| f64::from(u8::from(i == k))).collect::<Vec<f64>>();
    let pair = [trajectory("t", &unit(2)), trajectory("u", &unit(3))];
    bench.take(Event::Preference(Box::new(ranked("p", &pair))));
    bench.take(Event::Critique(Box::new(critique("c", &[(5, LEFT)], &[(0, 1, CritiqueSegment::BAD)]))));
    bench.take(Event::History(Box::new(history("h", &pair))));
    let posterior = bench.posterior();
    assert_eq!(posterior.rationalities.iter().map(|one| one.n).collect::<Vec<_>>(), [1; 5]);
    let kinds: Vec<&str> = posterior.rationalities.iter().map(|one| one.kind.as_str()).collect();
    assert_eq!(kinds, ["placements", "actions", "preferences", "critiques", "progress"]);
    assert_eq!((posterior.revision, posterior.beta, posterior.learned_betas.len()), (6, 100.0, 0));
    assert_eq!(posterior.feature_names[..2], ["cup", "plate"], "the table came first");
    let mut alone = Bench::new(settings());
    alone.step(Event::Scene(Box::new(table())));
    alone.take(Event::Demonstration(Box::new(shown("d", 0.5, 0.5))));
    for (i, id) in ["a", "p", "c", "h"].into_iter().enumerate() {
        bench.take(Event::Retraction(Box::new(back(&format!("r{i}"), id))));
    }
    let (mixed, alone) = (bench.posterior(), alone.posterior());
    assert_eq!(
        (&mixed.draws, &mixed.evidence_hash),
        (&alone.draws, &alone.evidence_hash),
        "a world alone says nothing"
    );
    assert_ne!(posterior.draws, alone.draws);
}

/// Preferences between the ends of random rows, `wrong` of them against the true weights.
fn answers(n: usize, wrong: usize) -> Vec<TrajectoryPreference> {
    let phi = |i: usize| [(i * 7 % 11) as f64 / 2.0, (i * 5 % 13) as f64 / 2.0, (i * 3 % 7) as f64 / 2.0];
    let value = |phi: &[f64; 3]| phi[0] - 0.5 * phi[1];
    let one = |i: usize| {
        let (a, b) = (phi(2 * i), phi(2 * i + 1));
        let mut pair = [trajectory(&format!("a{i}"), &a), trajectory(&format!("b{i}"), &b)];
        if (value(&a) > value(&b)) != (i < wrong) {
            pair.reverse();
        }
        ranked(&format!("p{i}"), &pair)
    };
    (0..n).map(one).collect()
}

#[test]
fn learned_rationality_rises_with_consistent_answers_and_falls_with_contradictory_ones() {
    let learned = Settings { beta_preferences_log_sd: 1.0, n_draws: 2000, ..settings() };
    let told = |wrong: usize| {
        let mut bench = Bench::in_row(learned.clone(), 3);
        let prior = of(&bench.posterior(), "preferences");
        for answer in answers(24, wrong) {
            bench.take(Event::Preference(Box::new(answer)));
        }
        let posterior = bench.posterior();
        let draws = posterior.learned_betas.clone();
        assert_eq!((posterior.learned_kinds.as_slice(), draws.len()), (["preferences".to_owned()].as_slice(), 2000));
        let known = of(&posterior, "preferences");
        let mean_of_draws = draws.iter().map(|&beta| f64::from(beta)).sum::<f64>() / 2000.0;
        assert!((known.mean - mean_of_draws).abs() < 1e-4 * known.mean, "the summary is that of the draws");
        assert!(known.quantile_05 < known.mean && known.mean < known.quantile_95);
        assert_eq!((known.prior_median, known.prior_log_sd), (1.0, 1.0));
        (prior, known)
    };
    let (prior, consistent) = told(0);
    // Log-normal: mean exp(1/2), quantiles exp(-+1.645).
    assert!((prior.mean - 1.648_721).abs() < 1e-5 && (prior.quantile_05 - 0.193_04).abs() < 1e-4, "{prior:?}");
    let (_, contradictory) = told(12);
    assert!(consistent.mean > prior.mean && contradictory.mean < 0.5 * prior.mean, "{consistent:?} {contradictory:?}");
}

#[test]
fn priors_are_what_the_parameters_say() {
    let sizes = |prior: Prior, prior_scale: f64| {
        let mut bench = Bench::in_row(Settings { prior, prior_scale, n_draws: 4000, ..settings() }, 3);
        let posterior = bench.posterior();
        assert_eq!((posterior.prior.as_str(), posterior.prior_scale > 0.0), (prior.name(), prior.has_scale()));
        let norms: Vec<[f64; 3]> = posterior
            .draws
            .chunks_exact(3)
            .map(|w| {
                let w = [f64::from(w[0]), f64::from(w[1]), f64::from(w[2])];
                [w.iter().map(|x| x.abs()).sum(), w.iter().map(|x| x * x).sum(), 1.0]
            })
            .collect();
        let n = norms.len() as f64;
        [0, 1].map(|i| norms.iter().map(|norm| norm[i]).sum::<f64>() / n)
    };
    let [l1, _] = sizes(Prior::L1Sphere, 2.0);
    let [_, l2] = sizes(Prior::L2Sphere, 2.0);
    assert!((l1 - 1.0).abs() < 1e-6 && (l2 - 1.0).abs() < 1e-6, "{l1} {l2}");
    // E sum of squares 3 scale^2 = 12; E sum of sizes 3 scale = 6.
    let [_, squares] = sizes(Prior::Gaussian, 2.0);
    let [sum, _] = sizes(Prior::Laplace, 2.0);
    assert!((squares - 12.0).abs() < 1.5 && (sum - 6.0).abs() < 0.7, "{squares} {sum}");
}

#[test]
fn the_worst_of_the_ranked_has_a_return_that_is_not_negative_where_that_is_known() {
    let order = [[-1.0, 0.0, -1.0], [0.0, 1.0, 0.0], [1.0, 1.0, 1.0]];
    let trajectories: Vec<_> = order.iter().enumerate().map(|(i, phi)| trajectory(&format!("t{i}"), phi)).collect();
    let negative = |nonnegative_return: bool| {
        let mut bench = Bench::in_row(Settings { nonnegative_return, ..settings() }, 3);
        bench.take(Event::Preference(Box::new(ranked("p", &trajectories[1..]))));
        bench.take(Event::Preference(Box::new(ranked("q", &trajectories))));
        returns(&bench.posterior(), &order[0]).iter().filter(|x| **x < -1e-6).count()
    };
    assert!(negative(false) > 100, "unknown");
    assert_eq!(negative(true), 0);
}

#[test]
fn a_cycle_of_preferences_is_reported_and_taken_back() {
    let [a, b, c] = ["a", "b", "c"].map(|id| trajectory(id, &[f64::from(id.as_bytes()[0]), 0.0, 1.0]));
    let mut bench = Bench::in_row(settings(), 3);
    for (id, pair) in [("ab", [&a, &b]), ("bc", [&b, &c]), ("ca", [&c, &a])] {
        bench.take(Event::Preference(Box::new(ranked(id, &pair.map(Clone::clone)))));
    }
    let cycles = bench.posterior().cycles;
    assert_eq!(cycles.len(), 1);
    assert_eq!(cycles[0].trajectories, ["a", "b", "c"]);
    bench.take(Event::Retraction(Box::new(back("r", "ca"))));
    assert!(bench.posterior().cycles.is_empty());
}

#[test]
fn a_preview_is_near_what_it_previews_and_changes_nothing() {
    let pair = [trajectory("a", &[0.0, 0.0, 1.0]), trajectory("b", &[1.0, 0.0, 0.0])];
    let lesson = |preview_draws| {
        let mut bench = Bench::in_row(Settings { n_draws: 4000, preview_draws, ..settings() }, 3);
        bench.posterior();
        bench.take(Event::Preference(Box::new(ranked("p", &pair))));
        let posterior = bench.posterior();
        (posterior, bench.previews)
    };
    let (without, none) = lesson(0);
    let (with, previews) = lesson(2000);
    assert!(none.is_empty());
    assert_eq!(
        apprentice_msgs::to_cdr(&with),
        apprentice_msgs::to_cdr(&without),
        "the posterior is the same to the bit"
    );
    let [preview] = previews.as_slice() else { panic!("{previews:?}") };
    assert_eq!((preview.outcome, preview.revision, preview.base_revision), (PosteriorPreview::READY, 1, 0));
    assert_eq!((preview.n_draws, preview.evidence_hash.as_str()), (2000, with.evidence_hash.as_str()));
    assert!(preview.khat < 0.7 && preview.effective_size > 200.0 && preview.reason.is_empty(), "{preview:?}");
    for (preview, full) in preview.mean_weights.iter().zip(mean(&with)) {
        assert!((preview - full).abs() < 0.06, "{preview} and {full}");
    }
    let difference = preview.expected_log_likelihood - with.log_likelihood_mean;
    assert!(difference.abs() < 0.05, "{difference}");
}

#[test]
fn what_is_taken_back_is_previewed_as_what_is_said() {
    let pair = [trajectory("a", &[0.0, 0.0, 1.0]), trajectory("b", &[1.0, 0.0, 0.0])];
    let mut bench = Bench::in_row(Settings { n_draws: 4000, preview_draws: 4000, ..settings() }, 3);
    bench.take(Event::Actions(Box::new(acted("a", &[(1, RIGHT)]))));
    bench.take(Event::Preference(Box::new(ranked("p", &pair))));
    bench.posterior();
    // Two events at once: one piece goes, another comes.
    bench.take(Event::Retraction(Box::new(back("r", "p"))));
    bench.take(Event::Critique(Box::new(critique("c", &[(1, LEFT)], &[(0, 1, CritiqueSegment::GOOD)]))));
    let full = bench.posterior();
    let preview = bench.previews.last().expect("there was one").clone();
    assert_eq!(
        (preview.outcome, preview.revision, preview.base_revision),
        (PosteriorPreview::READY, 4, 2),
        "{preview:?}"
    );
    for (preview, full) in preview.mean_weights.iter().zip(mean(&full)) {
        assert!((preview - full).abs() < 0.08, "{preview} and {full}");
    }
}

#[test]
fn a_preview_keeps_to_a_return_that_is_known_not_to_be_negative() {
    let at = |id: &str, features: [f64; 3]| trajectory(id, &features);
    let (a, b, c) = (at("a", [1.0, 0.0, 0.0]), at("b", [0.0, 1.0, 0.0]), at("c", [0.0, 0.0, 1.0]));
    let known = Settings { nonnegative_return: true, n_draws: 2000, preview_draws: 2000, ..settings() };
    let mut bench = Bench::in_row(known, 3);
    bench.posterior();
    bench.take(Event::Preference(Box::new(ranked("p", &[a.clone(), b]))));
    let full = bench.posterior();
    let preview = bench.previews.last().expect("there was one").clone();
    assert_eq!(preview.outcome, PosteriorPreview::READY, "{preview:?}");
    assert!((preview.mean_weights[0] - mean(&full)[0]).abs() < 0.06 && preview.mean_weights[0] > 0.1, "{preview:?}");
    // Now c is the worst, and the draws know nothing of weights under which a has a negative return.
    bench.take(Event::Preference(Box::new(ranked("q", &[c, a]))));
    bench.posterior();
    let preview = bench.previews.last().expect("there was one");
    assert_eq!(preview.outcome, PosteriorPreview::UNRELIABLE);
    assert!(preview.reason.contains("another trajectory is the worst ranked one"), "{}", preview.reason);
}

#[test]
fn evidence_that_moves_the_posterior_too_far_makes_its_preview_unreliable() {
    // Two answers that leave next to nothing but one point of the sphere.
    let equal = |id: &str, features: [f64; 3]| TrajectoryPreference {
        answer: TrajectoryPreference::EQUAL,
        ..ranked(id, &[trajectory(&format!("{id}0"), &[0.0; 3]), trajectory(&format!("{id}1"), &features)])
    };
    let mut bench = Bench::in_row(Settings { beta_preferences: 1e4, ..settings() }, 3);
    bench.posterior();
    bench.take(Event::Preference(Box::new(equal("p", [1.0, 1.0, 0.0]))));
    bench.take(Event::Preference(Box::new(equal("q", [0.0, 1.0, 1.0]))));
    bench.posterior();
    let [preview] = bench.previews.as_slice() else { panic!("{:?}", bench.previews) };
    assert_eq!((preview.outcome, preview.revision, preview.base_revision), (PosteriorPreview::UNRELIABLE, 2, 0));
    assert!(preview.reason.contains("k-hat is"), "{}", preview.reason);
}

#[test]
fn what_is_taken_back_was_never_said() {
    let mut bench = Bench::in_row(settings(), 3);
    let prior = bench.posterior();
    let pair = [trajectory("t", &[0.0, 0.0, 1.0]), trajectory("u", &[1.0, 0.0, 0.0])];
    let said = [
        Event::Actions(Box::new(acted("a", &[(1, RIGHT)]))),
        Event::Preference(Box::new(ranked("p", &pair))),
        Event::Critique(Box::new(critique("c", &[(1, RIGHT)], &[(0, 1, CritiqueSegment::GOOD)]))),
        Event::History(Box::new(history("h", &pair))),
    ];
    for (event, id) in said.into_iter().zip(["a", "p", "c", "h"]) {
        bench.take(event);
        assert_ne!(bits(&bench.posterior()), bits(&prior), "{id} says something");
        bench.take(Event::Retraction(Box::new(back(&format!("not-{id}"), id))));
        assert!(bits(&bench.posterior()) == bits(&prior), "{id} was never said");
    }
}
