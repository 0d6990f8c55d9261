//! Whether what was said fits the features: told when it does not, and hardly ever when it does.

mod support;

use active_query::{ActiveQuery, Event, Output, Settings, WorldInputs, fitted, world_lesson};
use apprentice_msgs::msg::{
    ActionDemonstration, CritiqueSegment, EvidenceLog, EvidenceRecord, FeatureTrajectory, LessonStatus, Posterior,
    Rationality, RiskBound, RobustPolicy, SegmentCritique, TrajectoryPreference,
};
use exchange::{Picture, World, world_from_message, world_to_message};
use mdp::Solver;
use mdp::random::{categorical, index, uniform};
use mdp::worlds::GridWorld;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

use support::bounds;

const BETA: f64 = 10.0;
const K: usize = 4;

/// Four rows of four cells of four kinds, and a start anywhere.
fn world() -> World {
    let cells = [0, 1, 2, 3, 1, 0, 3, 2, 2, 3, 0, 1, 0, 0, 1, 3];
    let grid = GridWorld { starts: (0..16).collect(), slip: 0.1, ..GridWorld::one_hot(4, 4, &cells, K) };
    let names = ["path", "lawn", "mud", "door"].map(String::from);
    let message =
        world_to_message("yard", &names, &grid.mdp().expect("a yard"), Picture::Cells { rows: 4, columns: 4 });
    world_from_message(&message).expect("a good yard")
}

/// Weights in [−½, ½].
fn weights(rng: &mut ChaCha8Rng) -> Vec<f64> {
    (0..K).map(|_| uniform(rng) - 0.5).collect()
}

/// What a person with these weights does in a state, or anything when they do not care.
fn choice(world: &World, weights: &[f64], state: usize, cares: bool, rng: &mut ChaCha8Rng) -> usize {
    if !cares {
        return index(4, rng);
    }
    let mut solver = Solver::new(&world.mdp);
    let optimum = solver.solve(weights);
    let q: Vec<f64> = (0..4).map(|action| BETA * optimum.q(state, action)).collect();
    let best = q.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let masses: Vec<f64> = q.iter().map(|q| scene::exp(q - best)).collect();
    let total = masses.iter().sum();
    categorical(masses.into_iter(), total, rng)
}

fn action(n: usize, query_id: &str, state: usize, action: usize, confidence: u8) -> EvidenceRecord {
    let shown = ActionDemonstration {
        id: format!("e{n}"),
        world_id: "yard".into(),
        query_id: query_id.into(),
        states: vec![state as u32],
        actions: vec![action as u32],
        confidence,
        ..ActionDemonstration::default()
    };
    EvidenceRecord { sequence: n as u64, kind: EvidenceRecord::ACTIONS, actions: vec![shown], ..Default::default() }
}

/// Draws that believe what the evidence says: weights near `mean`.
fn posterior(mean: &[f64], spread: f64, revision: u64, rng: &mut ChaCha8Rng) -> Posterior {
    let draws: Vec<f32> = (0..200)
        .flat_map(|_| mean.iter().map(|w| (w + spread * (uniform(rng) - 0.5)) as f32).collect::<Vec<_>>())
        .collect();
    let of = |kind: &str| Rationality { kind: kind.into(), n: 1, mean: BETA, ..Rationality::default() };
    Posterior {
        revision,
        evidence_hash: "h".into(),
        world: world().reference(),
        feature_names: world().feature_names,
        n_chains: 1,
        n_draws: 200,
        draws,
        map_weights: mean.to_vec(),
        rationalities: ["actions", "preferences", "critiques"].map(of).to_vec(),
        ..Posterior::default()
    }
}

/// The state of a lesson with these records, whose draws are near `mean`.
fn judged(settings: &Settings, records: Vec<EvidenceRecord>, mean: &[f64], outcome: u8) -> LessonStatus {
    let revision = records.len() as u64;
    let mut rng = ChaCha8Rng::seed_from_u64(5);
    let (posterior, bounds) = (posterior(mean, 0.1, revision, &mut rng), bounds(revision, outcome, 0.05));
    let (world, log) = (world(), EvidenceLog { records, ..EvidenceLog::default() });
    let inputs = WorldInputs { posterior: &posterior, world: &world, log: &log, bounds: &bounds };
    let lesson = world_lesson(settings, &posterior, &bounds).expect("they belong together");
    fitted(settings, &inputs, lesson).expect("they fit together")
}

/// Records of `n` actions, the last `random` of which were asked for at random.
fn records(n: usize, random: usize, weights: &[f64], cares: bool, rng: &mut ChaCha8Rng) -> Vec<EvidenceRecord> {
    let world = world();
    let one = |i: usize| {
        let state = index(16, rng);
        let letter = if i + random > n { 'A' } else { 'a' };
        action(i, &format!("w{i}-{letter}{state}-00ff"), state, choice(&world, weights, state, cares, rng), 0)
    };
    (1..=n).map(one).collect()
}

#[test]
fn a_person_as_the_model_has_them_is_hardly_ever_doubted_and_one_who_acts_by_something_else_is() {
    let settings = Settings::default();
    let mut doubted = [0, 0];
    for seed in 0..60 {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let truth = weights(&mut rng);
        for (of, cares) in [true, false].into_iter().enumerate() {
            let said = records(20, 8, &truth, cares, &mut rng);
            let lesson = judged(&settings, said, &truth, RiskBound::BOUND);
            assert_eq!(lesson.held_out, 8);
            assert!((0.0..=1.0).contains(&lesson.misfit_p), "{lesson:?}");
            doubted[of] += usize::from(lesson.state == LessonStatus::MISFIT);
        }
    }
    // At .002 for each of two checks: three of 60 by chance once in 600 times.
    assert!(doubted[0] <= 2 && doubted[1] >= 50, "{doubted:?}");
}

#[test]
fn a_lesson_that_does_not_fit_says_what_to_look_at_and_goes_on_when_that_is_taken_back() {
    // Everybody who likes the door and nothing else goes there; this person never does.
    let (mean, world) = ([-0.1, -0.1, -0.1, 0.6], world());
    let optimum = |state| {
        let mut solver = Solver::new(&world.mdp);
        let optimum = solver.solve(&mean);
        (0..4).min_by(|&a, &b| optimum.q(state, a).total_cmp(&optimum.q(state, b))).expect("four actions")
    };
    let said: Vec<EvidenceRecord> = (1..=8).map(|n| action(n, "", n + 3, optimum(n + 3), 0)).collect();
    let lesson = judged(&Settings::default(), said.clone(), &mean, RiskBound::BOUND);
    assert_eq!(lesson.state, LessonStatus::MISFIT);
    assert!(
        lesson.reason.contains("path, lawn, mud and door") && lesson.reason.contains("Take back"),
        "{}",
        lesson.reason
    );
    assert!(!lesson.misfits.is_empty() && lesson.misfits.iter().all(|id| id.starts_with('e')), "{:?}", lesson.misfits);
    assert!(lesson.misfit_p < 0.002 && lesson.query_id.is_empty());
    // What fits is no misfit, whatever was bad before; and nothing is judged without a bound, or when it is switched off.
    let fits = judged(&Settings::default(), said[..1].to_vec(), &mean, RiskBound::BOUND);
    assert_eq!((fits.state, fits.misfits.len()), (LessonStatus::TAUGHT, 0));
    let unbounded = judged(&Settings::default(), said.clone(), &mean, RiskBound::NOT_MIXED);
    assert!(unbounded.state == LessonStatus::ASKING && unbounded.misfit_p.is_nan());
    let off = judged(&Settings { misfit_level: 0.0, ..Settings::default() }, said.clone(), &mean, RiskBound::BOUND);
    assert!(off.state == LessonStatus::TAUGHT && off.misfit_p.is_nan());
    // A guess may be wrong.
    let guesses =
        (1..=8).map(|n| action(n, "", n + 3, optimum(n + 3), ActionDemonstration::CONFIDENCE_GUESS)).collect();
    assert_eq!(judged(&Settings::default(), guesses, &mean, RiskBound::BOUND).state, LessonStatus::TAUGHT);
}

#[test]
fn a_good_bound_may_have_to_be_confirmed_by_answers_to_random_questions() {
    let settings = Settings { most_surprises: 0.4, ..Settings::default() };
    let mean = [-0.1, -0.1, -0.1, 0.6];
    let mut rng = ChaCha8Rng::seed_from_u64(11);
    let said = records(20, 12, &mean, true, &mut rng);
    // 1 − .05^(1/n) ≤ .4 from n = 6 on, without a surprise.
    let none = judged(&settings, said[..8].to_vec(), &mean, RiskBound::BOUND);
    assert_eq!((none.state, none.held_out, none.to_confirm), (LessonStatus::ASKING, 0, 6));
    assert!(none.reason.contains("about 6 answers") && none.reason.contains("40 %"), "{}", none.reason);
    let all = judged(&settings, said.clone(), &mean, RiskBound::BOUND);
    assert!(all.held_out == 12 && all.surprises <= 2, "{all:?}");
    assert_eq!((all.state, all.to_confirm), (LessonStatus::TAUGHT, 0));
    let few = Settings { max_questions: 8, ..settings };
    // Demonstrations are counted by the posterior, which has three pieces here.
    let over = judged(&Settings { max_questions: 3, ..few.clone() }, said[..8].to_vec(), &mean, RiskBound::BOUND);
    assert_eq!(over.state, LessonStatus::GAVE_UP);
    assert_eq!(judged(&few, said[..8].to_vec(), &mean, RiskBound::BOUND).state, LessonStatus::ASKING);
}

#[test]
fn surprises_are_counted_among_answers_to_random_questions_alone() {
    let mean = [-0.1, -0.1, -0.1, 0.6];
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    let opposite: Vec<f64> = mean.iter().map(|w| -w).collect();
    let count = |random: usize, rng: &mut ChaCha8Rng| {
        let lesson = judged(&Settings::default(), records(12, random, &opposite, true, rng), &mean, RiskBound::BOUND);
        (lesson.held_out, lesson.surprises)
    };
    assert_eq!(count(0, &mut rng), (0, 0));
    let (n, surprises) = count(12, &mut rng);
    assert!(n == 12 && surprises >= 8, "{surprises}");
}

#[test]
fn critiques_and_comparisons_count_too() {
    let mean = [-0.1, -0.1, -0.1, 0.6];
    let judged_one =
        |record: EvidenceRecord| judged(&Settings::default(), vec![record], &mean, RiskBound::BOUND).misfit_p;
    let trajectory = |id: &str, features: [f64; K]| FeatureTrajectory { id: id.into(), features: features.to_vec() };
    let (none, door) = (trajectory("a", [0.0; K]), trajectory("b", [0.0, 0.0, 0.0, 1.0]));
    let prefers = |trajectories: Vec<FeatureTrajectory>| EvidenceRecord {
        sequence: 1,
        kind: EvidenceRecord::PREFERENCE,
        preference: vec![TrajectoryPreference { id: "e1".into(), trajectories, ..TrajectoryPreference::default() }],
        ..EvidenceRecord::default()
    };
    // exp(−6) is how odd it is to prefer nothing to the door.
    assert_eq!(judged_one(prefers(vec![none.clone(), door.clone()])), 1.0);
    assert!(judged_one(prefers(vec![door, none])) < 0.01);
    // In cell 2 the door is to the right.
    let marked = |action: u32, verdict: u8| EvidenceRecord {
        sequence: 1,
        kind: EvidenceRecord::CRITIQUE,
        critique: vec![SegmentCritique {
            id: "e1".into(),
            world_id: "yard".into(),
            states: vec![2],
            actions: vec![action],
            segments: vec![CritiqueSegment { start: 0, end: 1, verdict }],
            ..SegmentCritique::default()
        }],
        ..EvidenceRecord::default()
    };
    let world = world();
    let mut solver = Solver::new(&world.mdp);
    let optimum = solver.solve(&mean);
    let best = (0..4).max_by(|&a, &b| optimum.q(2, a).total_cmp(&optimum.q(2, b))).expect("four actions") as u32;
    assert_eq!(judged_one(marked(best, CritiqueSegment::GOOD)), 1.0);
    assert!(judged_one(marked(best, CritiqueSegment::BAD)) < 0.5);
    assert!(
        judged_one(marked((best + 2) % 4, CritiqueSegment::GOOD)) < judged_one(marked(best, CritiqueSegment::GOOD))
    );
}

#[test]
fn a_lesson_without_a_policy_goes_on_and_says_why_there_is_none() {
    let mut rng = ChaCha8Rng::seed_from_u64(2);
    let mean = [-0.1, -0.1, -0.1, 0.6];
    let world = world();
    let message = world_to_message("yard", &world.feature_names, &world.mdp, Picture::Cells { rows: 4, columns: 4 });
    let mut node = ActiveQuery::new(Settings::default());
    let mut step = |event: Event| node.step(Default::default(), event);
    step(Event::World(Box::new(message)));
    step(Event::Evidence(Box::new(EvidenceLog {
        records: records(1, 0, &mean, true, &mut rng),
        ..EvidenceLog::default()
    })));
    step(Event::Posterior(Box::new(posterior(&mean, 0.1, 1, &mut rng))));
    let policy = |outcome: u8, reason: &str| {
        let (reason, evidence_hash) = (reason.to_owned(), "h".to_owned());
        Event::Policy(Box::new(RobustPolicy {
            revision: 1,
            evidence_hash,
            outcome,
            reason,
            alpha: 0.95,
            ..Default::default()
        }))
    };
    assert!(step(policy(RobustPolicy::OPTIMAL, "it promises much")).is_empty(), "its bounds are on their way");
    let outputs = step(policy(RobustPolicy::NOT_COMPUTED, "no policy, because the chains disagree"));
    let [Output::WorldQuery(_), Output::Lesson(lesson), Output::LookAhead] = outputs.as_slice() else {
        panic!("a question: {outputs:?}")
    };
    assert_eq!(
        (lesson.state, lesson.reason.as_str()),
        (LessonStatus::ASKING, "no policy, because the chains disagree")
    );
    assert!(lesson.loss_bound.is_nan() && lesson.misfit_p.is_nan());
    assert!(step(policy(RobustPolicy::NOT_COMPUTED, "no policy, because the chains disagree")).is_empty(), "told once");
    // What is judged counts, and what is not judged does not take that back.
    let outputs = step(Event::PolicyBounds(Box::new(bounds(1, RiskBound::BOUND, 0.05))));
    assert!(
        matches!(outputs.as_slice(), [Output::Lesson(lesson)] if lesson.state == LessonStatus::TAUGHT),
        "{outputs:?}"
    );
    assert!(step(policy(RobustPolicy::ITERATION_LIMIT, "too few steps")).is_empty());
}
