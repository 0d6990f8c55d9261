//! Which of two places: when that is asked about a table, that the answers are held against the model, and that the lesson ends by that.

mod table;

use active_query::{ActiveQuery, Event, Output, Settings, Strategy, TableQuestionKind};
use apprentice_msgs::builtin_interfaces::Time;
use apprentice_msgs::msg::{
    EvidenceLog, EvidenceRecord, LessonStatus, PerformanceBounds, PlacementBound, PlacementQuery, Posterior,
    Rationality, TableReach, TrajectoryPreference,
};
use apprentice_msgs::to_cdr;
use exchange::scene_from_message;
use scene::{Point as At, Rbf};
use table::task;

/// After one placement and `n` comparisons; all draws like the middle, half of them the plate, too.
fn posterior(n: u64) -> Posterior {
    let names = ["cup", "plate"].map(String::from).into_iter().chain((0..9).map(|i| format!("table {i}")));
    let draw = |i: usize| {
        let mut w = [0.0_f32; 11];
        w[1] = if i.is_multiple_of(2) { 0.4 } else { -0.4 };
        w[6] = 0.6;
        w
    };
    let of = |kind: &str, n| Rationality { kind: kind.into(), n, mean: 50.0, ..Rationality::default() };
    Posterior {
        revision: 1 + n,
        n_demonstrations: 1,
        n_answers: 1 + n,
        evidence_hash: format!("hash {n}"),
        task: task(),
        scene: task(),
        feature_names: names.collect(),
        n_draws: 40,
        n_chains: 4,
        draws: (0..40).flat_map(draw).collect(),
        map_weights: draw(1).map(f64::from).to_vec(),
        rationalities: vec![of("placements", 1), of("preferences", n)],
        ..Posterior::default()
    }
}

fn bounds(revision: u64, n: usize, bound_m: f64) -> PerformanceBounds {
    let bound =
        PlacementBound { outcome: PlacementBound::BOUND, bound_m, point_estimate_m: 0.5, ..PlacementBound::default() };
    let (alpha, delta) = (0.95, 0.05);
    let bounds = vec![bound; n];
    PerformanceBounds {
        revision,
        bounds,
        outcome: PlacementBound::BOUND,
        bound_m,
        alpha,
        delta,
        ..PerformanceBounds::default()
    }
}

/// What comes of a posterior, the evidence and bounds of `bound_m` on every table.
fn asked(
    settings: &Settings,
    posterior: &Posterior,
    log: &EvidenceLog,
    bound_m: f64,
) -> (Option<PlacementQuery>, LessonStatus) {
    let mut node = ActiveQuery::new(settings.clone());
    let mut step = |event| node.step(Time::default(), event);
    let tables = match step(Event::Posterior(Box::new(posterior.clone()))).as_slice() {
        [Output::Candidates(tables)] => tables.clone(),
        other => panic!("candidates were expected, got {other:?}"),
    };
    let mut outputs = step(Event::Bounds(Box::new(bounds(posterior.revision, tables.scenes.len(), bound_m))));
    outputs.extend(step(Event::Evidence(Box::new(log.clone()))));
    match outputs.as_slice() {
        [Output::Query(query), Output::Lesson(lesson)] => (Some((**query).clone()), lesson.clone()),
        [Output::Lesson(lesson)] => (None, lesson.clone()),
        other => panic!("a lesson was expected, got {other:?}"),
    }
}

fn settings() -> Settings {
    Settings { n_candidates: 6, hold_out_share: 0.0, ..Settings::default() }
}

/// One placement, then comparisons in answer to questions that were drawn at random; each is `expected` or the other way round.
fn said(expected: &[bool]) -> EvidenceLog {
    let rbf = Rbf::new(&scene_from_message(&task()).expect("a good scene"));
    let placed = EvidenceRecord { sequence: 1, ..EvidenceRecord::default() };
    let compared = |(i, &is_expected): (usize, &bool)| {
        let places = [At::new(0.05, 0.95), At::new(0.5, 0.5)];
        let option = |at: &At| apprentice_msgs::msg::FeatureTrajectory {
            id: format!("{} {}", at.x, i),
            features: rbf.features(*at),
        };
        // Worst first: everybody likes the middle.
        let mut trajectories: Vec<_> = places.iter().map(option).collect();
        if !is_expected {
            trajectories.reverse();
        }
        let n = i as u64 + 2;
        let preference = TrajectoryPreference {
            id: format!("e{n}"),
            query_id: format!("Q{}-00ff00ff", n - 1),
            trajectories,
            answer: TrajectoryPreference::RANKED,
            ..TrajectoryPreference::default()
        };
        let (kind, preference) = (EvidenceRecord::PREFERENCE, vec![preference]);
        EvidenceRecord { sequence: n, kind, preference, ..EvidenceRecord::default() }
    };
    let records = [placed].into_iter().chain(expected.iter().enumerate().map(compared)).collect();
    EvidenceLog { records, ..EvidenceLog::default() }
}

#[test]
fn now_and_then_two_places_drawn_at_random_are_asked_about_and_never_before_anything_was_said() {
    let mut n_pairs = 0;
    for seed in 0..200 {
        let settings = Settings { seed, hold_out_share: 0.3, ..settings() };
        let (query, lesson) = asked(&settings, &posterior(0), &said(&[]), 0.3);
        let query = query.expect("the bound is above ε");
        assert_eq!(query.held_out, query.options.len() == 2);
        assert_eq!(query.id.starts_with('Q'), query.held_out, "{}", query.id);
        assert_eq!(lesson.query_id, query.id);
        if !query.held_out {
            assert!(query.reason.starts_with("Where does the vase belong "), "{}", query.reason);
            continue;
        }
        n_pairs += 1;
        assert!(query.reason.starts_with("Which of the two places is better for the vase "), "{}", query.reason);
        assert!(query.reason.contains("at random"));
        let scene = scene_from_message(&query.scene).expect("a good scene");
        let rbf = Rbf::new(&scene);
        let places = query.options.iter().map(|option| At::new(option.placement.x, option.placement.y));
        for (option, at_m) in query.options.iter().zip(places.clone()) {
            assert!(scene.occupied().is_free(at_m));
            assert_eq!(option.trajectory.features, rbf.features(scene.normalised(at_m)));
        }
        let places: Vec<At> = places.collect();
        assert!(places[0].distance(places[1]) >= 0.03);
        assert_ne!(query.options[0].trajectory.id, query.options[1].trajectory.id);
    }
    // Three standard deviations of a binomial of 200 and .3.
    assert!((41..=79).contains(&n_pairs), "{n_pairs} of 200");
    let nothing = Posterior { rationalities: Vec::new(), n_demonstrations: 0, ..posterior(0) };
    for seed in 0..50 {
        let settings = Settings { seed, hold_out_share: 0.8, ..settings() };
        assert!(asked(&settings, &nothing, &said(&[]), 0.3).0.expect("nothing was said").options.is_empty());
    }
}

#[test]
fn where_it_may_not_be_asked_where_the_pair_tells_between_the_rewards_that_fit() {
    let only_pairs = Settings { table_question_kinds: vec![TableQuestionKind::Comparison], ..settings() };
    let mut firsts = 0;
    for seed in 0..40 {
        let mut gains = Vec::new();
        for strategy in [Strategy::Var, Strategy::Information] {
            let settings = Settings { seed, strategy, ..only_pairs.clone() };
            let (query, _) = asked(&settings, &posterior(0), &said(&[]), 0.3);
            let query = query.expect("the bound is above ε");
            assert!(!query.held_out);
            let [first, second] = query.options.as_slice() else { panic!("two places") };
            // Weight 1 is the plate's, which is all that the draws differ in.
            let difference = |i: usize| first.trajectory.features[i] - second.trajectory.features[i];
            assert!(difference(1).abs() > 0.02, "{}", difference(1));
            assert!(query.gain > 0.05 && query.gain <= std::f64::consts::LN_2 + 1e-9, "{}", query.gain);
            gains.push(query.gain);
            assert!((query.gain_per_second - query.gain / 5.0).abs() < 1e-12);
            firsts += usize::from(difference(1) > 0.0);
        }
        assert!(gains[1] >= gains[0], "the best of all tables is no worse than that of one: {gains:?}");
    }
    assert!((20..=60).contains(&firsts), "which is A is drawn: {firsts} of 80");
    // Rewards that like the same place best are told apart by other places; something is asked while the bound is large.
    let agreeing = Posterior {
        draws: posterior(0).draws.iter().map(|w| if *w < 0.0 { 0.4 } else { *w }).collect(),
        ..posterior(0)
    };
    for strategy in [Strategy::Var, Strategy::Information, Strategy::Random] {
        let (query, _) = asked(&Settings { strategy, ..only_pairs.clone() }, &agreeing, &said(&[]), 0.3);
        assert_eq!(query.expect("the bound is above ε").options.len(), 2, "{strategy:?}");
    }
    let nothing = Settings { table_question_kinds: Vec::new(), ..settings() };
    let (query, lesson) = asked(&nothing, &posterior(0), &said(&[]), 0.3);
    assert!(query.is_none() && lesson.query_id.is_empty() && lesson.state == LessonStatus::ASKING);
    // A question that is not worth the time ends the lesson.
    let impatient = Settings { least_gain_per_second: 10.0, ..only_pairs };
    let (query, lesson) = asked(&impatient, &posterior(0), &said(&[]), 0.3);
    assert_eq!((query.is_some(), lesson.state), (false, LessonStatus::GAVE_UP));
    assert!(lesson.reason.contains("least_gain_per_second"), "{}", lesson.reason);
}

#[test]
fn by_information_either_kind_is_asked_whichever_tells_more_for_its_time() {
    let (mut pairs, mut places) = (0, 0);
    for seed in 0..20 {
        let settings = Settings { seed, strategy: Strategy::Information, ..settings() };
        let (query, _) = asked(&settings, &posterior(0), &said(&[]), 0.3);
        let query = query.expect("the bound is above ε");
        // Two rewards are told apart by an answer of either kind, and comparing takes less time.
        assert!(query.gain_per_second >= query.gain / 8.0);
        *(if query.options.is_empty() { &mut places } else { &mut pairs }) += 1;
    }
    assert!(pairs > places, "{pairs} pairs, {places} places");
    let at_random = |seed| {
        let settings = Settings { seed, strategy: Strategy::Random, ..settings() };
        asked(&settings, &posterior(0), &said(&[]), 0.3).0.expect("the bound is above ε").options.len()
    };
    let two = (0..60).filter(|seed| at_random(*seed) == 2).count();
    assert!((15..=45).contains(&two), "{two} of 60");
}

#[test]
fn surprising_comparisons_end_the_lesson_and_expected_ones_confirm_it() {
    // What is likely is never held against the model.
    let (query, lesson) = asked(&settings(), &posterior(4), &said(&[true; 4]), 0.3);
    assert!(query.is_some());
    assert_eq!((lesson.state, lesson.held_out, lesson.surprises), (LessonStatus::ASKING, 4, 0));
    assert!(lesson.misfit_p > 0.5, "{}", lesson.misfit_p);
    let (query, lesson) = asked(&settings(), &posterior(5), &said(&[false; 5]), 0.05);
    assert_eq!((query.is_some(), lesson.state), (false, LessonStatus::MISFIT));
    assert_eq!((lesson.held_out, lesson.surprises), (5, 5));
    assert!(lesson.reason.contains("not what I expected"), "{}", lesson.reason);
    assert!(!lesson.misfits.is_empty() && lesson.misfits.iter().all(|id| id.starts_with('e')), "{:?}", lesson.misfits);
    let tolerant = Settings { misfit_level: 0.0, ..settings() };
    assert_eq!(asked(&tolerant, &posterior(5), &said(&[false; 5]), 0.05).1.state, LessonStatus::TAUGHT);
}

#[test]
fn a_good_bound_is_confirmed_by_random_pairs_where_that_is_wanted() {
    let careful = Settings { most_surprises: 0.4, ..settings() };
    let (query, lesson) = asked(&careful, &posterior(0), &said(&[]), 0.05);
    let query = query.expect("nothing was confirmed yet");
    assert!(query.held_out && query.options.len() == 2);
    assert_eq!((lesson.state, lesson.to_confirm), (LessonStatus::ASKING, 6));
    let (query, lesson) = asked(&careful, &posterior(5), &said(&[true; 5]), 0.05);
    assert_eq!((query.is_some_and(|query| query.held_out), lesson.to_confirm), (true, 1));
    let (query, lesson) = asked(&careful, &posterior(6), &said(&[true; 6]), 0.05);
    assert_eq!((query.is_some(), lesson.state, lesson.to_confirm), (false, LessonStatus::TAUGHT, 0));
    // Where comparing is not to be asked, nothing can be confirmed, and nothing has to be.
    let only_places = Settings { table_question_kinds: vec![TableQuestionKind::Placement], ..careful };
    assert_eq!(asked(&only_places, &posterior(0), &said(&[]), 0.05).1.state, LessonStatus::TAUGHT);
}

#[test]
fn what_is_asked_waits_for_the_evidence_it_depends_on_and_depends_on_nothing_else() {
    let settings = Settings { hold_out_share: 0.5, ..settings() };
    let (posterior, log) = (posterior(3), said(&[true; 3]));
    let mut node = ActiveQuery::new(settings.clone());
    let mut step = |event| node.step(Time::default(), event);
    let short = EvidenceLog { records: log.records[..2].to_vec(), ..EvidenceLog::default() };
    assert!(step(Event::Evidence(Box::new(short))).is_empty());
    assert_eq!(step(Event::Posterior(Box::new(posterior.clone()))).len(), 1);
    assert!(step(Event::Bounds(Box::new(bounds(4, 7, 0.3)))).is_empty(), "the log is older than the posterior");
    assert!(matches!(step(Event::Republish).as_slice(), [Output::Candidates(_)]));
    let longer = said(&[true, true, true, false]);
    let outputs = step(Event::Evidence(Box::new(longer)));
    let [Output::Query(query), Output::Lesson(lesson)] = outputs.as_slice() else { panic!("{outputs:?}") };
    let (other, told) = asked(&settings, &posterior, &log, 0.3);
    assert_eq!((to_cdr(&**query), to_cdr(lesson)), (to_cdr(&other.expect("it asks")), to_cdr(&told)));
}

/// An arm that reaches only the half of the table on the left.
fn left_half() -> TableReach {
    let (side, target_id, robot_hash) = (10, "vase".to_owned(), "an arm".to_owned());
    let reachable = (0..100).map(|cell| cell % 10 < 5).collect();
    TableReach { side, reachable, target_id, robot_hash, width_m: 1.0, depth_m: 1.0, ..TableReach::default() }
}

#[test]
fn what_is_out_of_reach_is_not_asked_about_and_nothing_is_before_the_reach_is_known() {
    let told = |outputs: Vec<Output>| match outputs.as_slice() {
        [Output::Candidates(tables)] => tables.clone(),
        other => panic!("candidates were expected, got {other:?}"),
    };
    for seed in 0..40 {
        let settings = Settings { seed, only_reachable: true, hold_out_share: 0.9, n_candidates: 12, ..settings() };
        let mut node = ActiveQuery::new(settings);
        let mut step = |event| node.step(Time::default(), event);
        let posterior = Posterior { map_weights: leaning(), ..posterior(0) };
        let first = step(Event::Posterior(Box::new(posterior.clone())));
        assert!(matches!(first.as_slice(), [Output::Warn(text)] if text.contains("only_reachable")), "{first:?}");
        assert!(step(Event::Posterior(Box::new(posterior.clone()))).is_empty(), "it was heard of before");
        let other = TableReach { target_id: "cup".into(), ..left_half() };
        assert!(step(Event::Reach(Box::new(other))).is_empty(), "that of another target");
        let tables = told(step(Event::Reach(Box::new(left_half()))));
        assert_eq!(tables.robot_hash, "an arm");
        let n = tables.scenes.len();
        for scene in &tables.scenes[..n - 1] {
            let scene = scene_from_message(scene).expect("a good scene");
            let (rbf, grid) = (Rbf::new(&scene), scene::Grid::midpoints(64));
            let field = scene::Field::new(&rbf, &grid, Some(&scene));
            let best = scene::best_placement(&scene, &rbf, &field, &posterior.map_weights, &mut Vec::new());
            assert!(best.expect("there is room").at.x < 0.55, "{best:?}");
        }
        let outputs = step(Event::Bounds(Box::new(bounds(1, n, 0.3))));
        let [Output::Query(query), Output::Lesson(_)] = outputs.as_slice() else { panic!("{outputs:?}") };
        assert!(query.options.iter().all(|option| option.placement.x < 0.5), "{:?}", query.options);
    }
    let broken = TableReach { side: 7, ..left_half() };
    let outputs = ActiveQuery::new(settings()).step(Time::default(), Event::Reach(Box::new(broken)));
    assert!(matches!(outputs.as_slice(), [Output::Warn(text)] if text.contains("100 cells for 7")), "{outputs:?}");
    // Who knows no reach asks about everything, and says so.
    let mut node = ActiveQuery::new(Settings { only_reachable: true, ..settings() });
    let unknown = TableReach { side: 0, reachable: Vec::new(), reason: "no such link".into(), ..left_half() };
    let outputs = node.step(Time::default(), Event::Reach(Box::new(unknown)));
    assert!(matches!(outputs.as_slice(), [Output::Warn(text)] if text.contains("no such link")), "{outputs:?}");
    told(node.step(Time::default(), Event::Posterior(Box::new(posterior(0)))));
    // Where it is not asked for, nothing waits and nothing is left out.
    let mut node = ActiveQuery::new(settings());
    assert!(told(node.step(Time::default(), Event::Posterior(Box::new(posterior(0))))).robot_hash.is_empty());
}

/// Weights that like the table's middle, and are drawn to the cup: where that is, is where the target goes.
fn leaning() -> Vec<f64> {
    let mut w = vec![0.0; 11];
    (w[0], w[6]) = (0.7, 0.3);
    w
}
