//! What is asked, when the lesson ends, and that outputs are a function of the messages.

mod table;

use active_query::{ActiveQuery, Event, Output, Settings, Strategy};
use apprentice_msgs::builtin_interfaces::Time;
use apprentice_msgs::msg::{
    Candidates, LessonStatus, PerformanceBounds, PlacementBound, PlacementQuery, Posterior, Rationality,
};
use apprentice_msgs::to_cdr;
use bus::testing::check_parameters;
use table::task;

fn posterior(revision: u64, n_demonstrations: u64) -> Posterior {
    Posterior {
        revision,
        n_demonstrations,
        n_answers: revision,
        evidence_hash: format!("hash {n_demonstrations}"),
        task: task(),
        scene: task(),
        ..Posterior::default()
    }
}

fn bounds(revision: u64, bounds_m: &[f64]) -> PerformanceBounds {
    let bound = |&bound_m: &f64| PlacementBound {
        outcome: if bound_m.is_nan() { PlacementBound::NOT_ENOUGH_SAMPLES } else { PlacementBound::BOUND },
        bound_m,
        point_estimate_m: 0.5,
        ..PlacementBound::default()
    };
    PerformanceBounds {
        revision,
        bounds: bounds_m.iter().map(bound).collect(),
        alpha: 0.95,
        delta: 0.05,
        ..PerformanceBounds::default()
    }
}

fn settings() -> Settings {
    Settings { n_candidates: 3, ..Settings::default() }
}

fn step(node: &mut ActiveQuery, event: Event) -> Vec<Output> {
    node.step(Time::default(), event)
}

fn candidates(node: &mut ActiveQuery, posterior: Posterior) -> Candidates {
    match step(node, Event::Posterior(Box::new(posterior))).as_slice() {
        [Output::Candidates(candidates)] => candidates.clone(),
        other => panic!("candidates were expected, got {other:?}"),
    }
}

fn verdict(node: &mut ActiveQuery, bounds: PerformanceBounds) -> (Option<PlacementQuery>, LessonStatus) {
    match step(node, Event::Bounds(Box::new(bounds))).as_slice() {
        [Output::Query(query), Output::Lesson(lesson)] => (Some((**query).clone()), lesson.clone()),
        [Output::Lesson(lesson)] => (None, lesson.clone()),
        other => panic!("a lesson was expected, got {other:?}"),
    }
}

#[test]
fn parameters_are_documented() {
    check_parameters::<Settings>();
}

#[test]
fn the_first_question_is_about_the_table_as_it_is_however_small_the_bound() {
    let mut node = ActiveQuery::new(settings());
    let asked = candidates(&mut node, posterior(0, 0));
    assert_eq!(asked.scenes.len(), 1);
    assert_eq!(asked.scenes[0].objects, posterior(0, 0).scene.objects);
    let (query, lesson) = verdict(&mut node, bounds(0, &[0.001]));
    assert_eq!(query.expect("nothing has been shown").scene.objects, posterior(0, 0).scene.objects);
    assert_eq!((lesson.state, lesson.questions_asked), (LessonStatus::ASKING, 1));
}

#[test]
fn the_table_with_the_largest_bound_is_asked_about() {
    let mut node = ActiveQuery::new(settings());
    let asked = candidates(&mut node, posterior(1, 1));
    assert_eq!(asked.scenes.len(), 4, "three imagined tables and the one that the lesson is about");
    assert_eq!(asked.scenes[3].objects, task().objects);
    let (query, lesson) = verdict(&mut node, bounds(1, &[0.2, 0.4, 0.3, 0.5]));
    let query = query.expect("the bound is above ε");
    assert_eq!(query.scene, asked.scenes[1]);
    assert_eq!(query.bound_m, 0.4);
    assert!(query.reason.contains("40.0 cm"), "{}", query.reason);
    assert_eq!((lesson.query_id, lesson.questions_asked), (query.id, 2));
}

#[test]
fn the_lesson_ends_below_epsilon_at_a_stop_and_after_too_many_questions() {
    let end = |posterior: Posterior, bound_m: f64, settings: Settings| {
        let mut node = ActiveQuery::new(settings);
        let revision = posterior.revision;
        let n = candidates(&mut node, posterior).scenes.len();
        let (query, lesson) = verdict(&mut node, bounds(revision, &vec![bound_m; n]));
        (query.is_some(), lesson.state)
    };
    assert_eq!(end(posterior(1, 1), 0.099, settings()), (false, LessonStatus::TAUGHT));
    assert_eq!(end(posterior(1, 1), 0.1, settings()), (true, LessonStatus::ASKING));
    assert_eq!(end(posterior(1, 1), f64::NAN, settings()), (true, LessonStatus::ASKING));
    let wish = |wish| Posterior { wish, ..posterior(1, 1) };
    assert_eq!(end(wish(Posterior::STOP), 0.2, settings()), (false, LessonStatus::STOPPED));
    // A pause holds whatever the bound is; who has said enough may have said enough to teach it.
    assert_eq!(end(wish(Posterior::PAUSE), 0.05, settings()), (false, LessonStatus::PAUSED));
    assert_eq!(end(wish(Posterior::START), 0.2, settings()), (true, LessonStatus::ASKING));
    assert_eq!(end(wish(Posterior::FINISH), 0.2, settings()), (false, LessonStatus::FINISHED));
    assert_eq!(end(wish(Posterior::FINISH), f64::NAN, settings()), (false, LessonStatus::FINISHED));
    assert_eq!(end(wish(Posterior::FINISH), 0.05, settings()), (false, LessonStatus::TAUGHT));
    let waiting = Settings { wait_for_start: true, ..settings() };
    assert_eq!(end(posterior(0, 0), 0.2, waiting.clone()), (false, LessonStatus::PAUSED));
    assert_eq!(end(wish(Posterior::START), 0.2, waiting), (true, LessonStatus::ASKING));
    let few = Settings { max_questions: 5, ..settings() };
    assert_eq!(end(posterior(5, 5), 0.2, few.clone()), (false, LessonStatus::GAVE_UP));
    assert_eq!(end(posterior(4, 4), 0.2, few), (true, LessonStatus::ASKING));
}

#[test]
fn the_table_of_the_lesson_is_asked_about_when_no_imagined_one_is_left() {
    let mut node = ActiveQuery::new(settings());
    candidates(&mut node, posterior(1, 1));
    let (query, lesson) = verdict(&mut node, bounds(1, &[0.05, 0.05, 0.05, 0.3]));
    let query = query.expect("the table of the lesson is above ε");
    assert_eq!((query.scene.objects, lesson.state), (task().objects, LessonStatus::ASKING));
    assert!(query.reason.starts_with("Where does the vase belong on the table as it is?"), "{}", query.reason);
}

#[test]
fn bounds_of_another_revision_or_of_other_tables_ask_nothing() {
    let mut node = ActiveQuery::new(settings());
    candidates(&mut node, posterior(2, 2));
    assert!(step(&mut node, Event::Bounds(Box::new(bounds(1, &[0.2; 4])))).is_empty());
    let wrong = step(&mut node, Event::Bounds(Box::new(bounds(2, &[0.2; 2]))));
    assert!(matches!(wrong.as_slice(), [Output::Warn(text)] if text.contains("judge 2 tables, 4 were asked for")));
    assert!(verdict(&mut node, bounds(2, &[0.2; 4])).0.is_some());
}

#[test]
fn what_is_pending_is_sent_again_unchanged() {
    let mut node = ActiveQuery::new(settings());
    assert!(step(&mut node, Event::Republish).is_empty());
    let asked = candidates(&mut node, posterior(1, 1));
    assert!(matches!(step(&mut node, Event::Republish).as_slice(), [Output::Candidates(again)] if *again == asked));
    let (query, lesson) = verdict(&mut node, bounds(1, &[0.2; 4]));
    let again = step(&mut node, Event::Republish);
    let [Output::Query(q), Output::Lesson(l)] = again.as_slice() else { panic!("{again:?}") };
    assert_eq!(to_cdr(&**q), to_cdr(&query.expect("the bound is above ε")));
    assert_eq!(l.query_id, lesson.query_id);
    assert!(step(&mut node, Event::Bounds(Box::new(bounds(1, &[0.05; 4])))).is_empty(), "a repetition changes nothing");
}

#[test]
fn a_question_depends_on_the_evidence_alone() {
    let ask = |warm: bool| {
        let mut node = ActiveQuery::new(settings());
        if warm {
            candidates(&mut node, posterior(0, 0));
            verdict(&mut node, bounds(0, &[0.3]));
        }
        candidates(&mut node, posterior(1, 1));
        to_cdr(&verdict(&mut node, bounds(1, &[0.2; 4])).0.expect("the bound is above ε"))
    };
    assert_eq!(ask(false), ask(true));
}

#[test]
fn a_posterior_with_a_broken_scene_is_told_and_survived() {
    let mut node = ActiveQuery::new(settings());
    let mut broken = posterior(1, 1);
    broken.scene.objects[0].pose.position.x = f64::NAN;
    let outputs = step(&mut node, Event::Posterior(Box::new(broken)));
    assert!(matches!(outputs.as_slice(), [Output::Warn(text)] if text.contains("'cup'")), "{outputs:?}");
    assert_eq!(candidates(&mut node, posterior(1, 1)).scenes.len(), 4);
}

fn rationality(kind: &str, n: u64) -> Rationality {
    Rationality { kind: kind.into(), n, mean: 50.0, ..Rationality::default() }
}

/// A posterior with draws: they agree about the cup and the table's middle, and differ in whether the plate attracts or repels.
fn drawn() -> Posterior {
    let names = ["cup", "plate"].map(String::from).into_iter().chain((0..9).map(|i| format!("table {i}")));
    let draw = |i: usize| {
        let mut w = [0.0_f32; 11];
        w[1] = if i.is_multiple_of(2) { 0.4 } else { -0.4 };
        w[6] = 0.6;
        w
    };
    Posterior {
        feature_names: names.collect(),
        n_draws: 40,
        n_chains: 4,
        draws: (0..40).flat_map(draw).collect(),
        map_weights: draw(1).map(f64::from).to_vec(),
        beta: 50.0,
        rationalities: vec![rationality("placements", 1), rationality("preferences", 0)],
        ..posterior(1, 1)
    }
}

#[test]
fn the_strategy_decides_which_imagined_table_is_asked_about() {
    let asked = |strategy, seed| {
        let mut node =
            ActiveQuery::new(Settings { strategy, seed, n_candidates: 12, hold_out_share: 0.0, ..Settings::default() });
        let tables = candidates(&mut node, drawn());
        let n = tables.scenes.len();
        // The first has the largest bound; the last is the table of the lesson.
        let all: Vec<f64> = (0..n).map(|i| 0.9 - 0.01 * i as f64).collect();
        let query = verdict(&mut node, bounds(1, &all)).0.expect("the bounds are above ε");
        let index = tables.scenes.iter().position(|scene| *scene == query.scene).expect("one of the candidates");
        (index, n, query.reason)
    };
    let var = asked(Strategy::Var, 3);
    assert_eq!(var.0, 0);
    assert!(var.2.contains("the most of"), "{}", var.2);
    let information: Vec<_> = (1..9).map(|seed| asked(Strategy::Information, seed)).collect();
    assert!(information.iter().any(|asked| asked.0 != 0) && information.iter().all(|asked| asked.0 + 1 < asked.1));
    assert!(information.iter().all(|asked| asked.2.contains("tells me more")), "{}", information[0].2);
    assert_eq!(information, (1..9).map(|seed| asked(Strategy::Information, seed)).collect::<Vec<_>>());
    let random: Vec<_> = (1..9).map(|seed| asked(Strategy::Random, seed).0).collect();
    assert!(random.iter().any(|index| *index != random[0]));
    assert!(asked(Strategy::Random, 3).2.contains("at random"));
}

#[test]
fn draws_that_do_not_fit_are_told_and_the_largest_bound_is_asked_about() {
    let mut node =
        ActiveQuery::new(Settings { strategy: Strategy::Information, n_candidates: 3, ..Settings::default() });
    let n = candidates(&mut node, Posterior { n_chains: 0, ..drawn() }).scenes.len();
    let mut all = vec![0.3; n];
    all[1] = 0.4;
    match step(&mut node, Event::Bounds(Box::new(bounds(1, &all)))).as_slice() {
        [Output::Warn(text), Output::Query(query), Output::Lesson(_)] => {
            assert!(text.contains("0 chains"), "{text}");
            assert_eq!(query.bound_m, 0.4);
        }
        other => panic!("a warning and a question were expected, got {other:?}"),
    }
}
