//! Which question about a world is asked, shown against values at risk that are computed here by hand.

mod support;

use active_query::{
    ActiveQuery, Event, Output, QuestionKind, Settings, Strategy, WorldInputs, questions_ahead, world_lesson,
    world_question,
};
use apprentice_msgs::builtin_interfaces::Time;
use apprentice_msgs::msg::{
    ActionDemonstration, EvidenceLog, EvidenceRecord, LessonStatus, PolicyBounds, Posterior, QueryResponse,
    Rationality, Retraction, RiskBound, TabularWorld, WorldQuery,
};
use apprentice_msgs::to_cdr;
use exchange::{Picture, World, check_world_query, world_from_message, world_to_message};
use mdp::worlds::GridWorld;
use mdp::{Policy, Solver, successor_features};

const KINDS: [QuestionKind; 3] = [QuestionKind::Action, QuestionKind::Critique, QuestionKind::Comparison];

/// Three rows of five cells of four kinds; it ends in cell 4, and cell 14 cannot be left, but all others can be come to.
fn message() -> TabularWorld {
    let cells = [0, 0, 1, 0, 3, 1, 2, 1, 0, 2, 0, 0, 0, 2, 1];
    let grid = GridWorld { terminals: vec![4], starts: vec![10], ..GridWorld::one_hot(3, 5, &cells, 4) };
    let names = ["path", "lawn", "mud", "door"].map(String::from);
    world_to_message("yard", &names, &grid.mdp().expect("a yard"), Picture::Cells { rows: 3, columns: 5 })
}

fn world() -> World {
    world_from_message(&message()).expect("a good yard")
}

/// Draws that agree about the door and not about lawn and mud.
fn draws() -> Vec<f32> {
    let of = |i: u32| {
        let wave = |by: u32| ((i * by) % 101) as f32 / 101.0;
        [-0.05 - 0.1 * wave(7), 0.6 * wave(37) - 0.4, 0.5 * wave(53) - 0.45, 0.5 + 0.2 * wave(11)]
    };
    (0..100).flat_map(of).collect()
}

fn map() -> Vec<f64> {
    vec![-0.1, -0.05, -0.3, 0.6]
}

fn posterior(revision: u64) -> Posterior {
    let beta = |kind: &str, n: u64| Rationality { kind: kind.into(), n, mean: 5.0, ..Rationality::default() };
    Posterior {
        revision,
        evidence_hash: "h".into(),
        world: world().reference(),
        feature_names: world().feature_names,
        n_chains: 1,
        n_draws: 100,
        draws: draws(),
        map_weights: map(),
        n_answers: revision,
        rationalities: vec![beta("actions", 1), beta("preferences", 0), beta("critiques", 0)],
        ..Posterior::default()
    }
}

fn bounds(revision: u64, bound: f64) -> PolicyBounds {
    support::bounds(revision, RiskBound::BOUND, bound)
}

fn settings() -> Settings {
    Settings { hold_out_share: 0.0, ..Settings::default() }
}

fn only(kind: QuestionKind) -> Settings {
    Settings { question_kinds: vec![kind], ..settings() }
}

fn log(records: &[EvidenceRecord]) -> EvidenceLog {
    EvidenceLog { records: records.to_vec(), ..EvidenceLog::default() }
}

fn step(node: &mut ActiveQuery, event: Event) -> Vec<Output> {
    node.step(Time::default(), event)
}

/// What is asked once everything of a revision is known.
fn asked(settings: &Settings, records: &[EvidenceRecord]) -> WorldQuery {
    let revision = records.len() as u64;
    let mut node = ActiveQuery::new(settings.clone());
    step(&mut node, Event::World(Box::new(message())));
    step(&mut node, Event::Evidence(Box::new(log(records))));
    step(&mut node, Event::Posterior(Box::new(posterior(revision))));
    match step(&mut node, Event::PolicyBounds(Box::new(bounds(revision, 0.5)))).as_slice() {
        [Output::WorldQuery(query), Output::Lesson(lesson), Output::LookAhead] => {
            assert_eq!((&lesson.query_id, lesson.state), (&query.id, LessonStatus::ASKING));
            assert_eq!(lesson.questions_asked, u32::try_from(revision).expect("few") + 1);
            check_world_query(query, &world()).expect("it can be answered");
            (**query).clone()
        }
        other => panic!("a question was expected, got {other:?}"),
    }
}

fn skipped(query: &WorldQuery, n: u64) -> EvidenceRecord {
    let response = QueryResponse { id: format!("e{n}"), query_id: query.id.clone(), ..QueryResponse::default() };
    EvidenceRecord {
        sequence: n,
        kind: EvidenceRecord::RESPONSE,
        response: vec![response],
        ..EvidenceRecord::default()
    }
}

fn answered(query: &WorldQuery, n: u64) -> EvidenceRecord {
    let shown =
        ActionDemonstration { id: format!("e{n}"), query_id: query.id.clone(), ..ActionDemonstration::default() };
    EvidenceRecord { sequence: n, kind: EvidenceRecord::ACTIONS, actions: vec![shown], ..EvidenceRecord::default() }
}

fn undone(of: u64, n: u64) -> EvidenceRecord {
    let undo = Retraction { id: format!("e{n}"), evidence_id: format!("e{of}"), ..Retraction::default() };
    EvidenceRecord {
        sequence: n,
        kind: EvidenceRecord::RETRACTION,
        retraction: vec![undo],
        ..EvidenceRecord::default()
    }
}

/// 0.95-quantile over the draws of what the MAP policy loses in every state, with a solver for each draw.
fn values_at_risk() -> Vec<f64> {
    let world = world();
    let policy = Policy::Deterministic(Solver::new(&world.mdp).solve(&map()).policy().to_vec());
    let psi = successor_features(&world.mdp, &policy).expect("a policy of the yard");
    let mut losses = vec![Vec::new(); world.mdp.n_states()];
    for draw in draws().chunks_exact(4) {
        let w: Vec<f64> = draw.iter().map(|w| f64::from(*w)).collect();
        let mut solver = Solver::new(&world.mdp);
        let optimum = solver.solve(&w);
        for (state, losses) in losses.iter_mut().enumerate() {
            let own: f64 = psi[state * 4..][..4].iter().zip(&w).map(|(psi, w)| psi * w).sum();
            losses.push(optimum.state_value(state) - own);
        }
    }
    let quantile = |mut of: Vec<f64>| {
        of.sort_by(f64::total_cmp);
        of[94]
    };
    losses.into_iter().map(quantile).collect()
}

/// The state with the largest action entropy, the first of equals: for each action the entropy, over the draws, of its probability
/// for a person of β = 5, in tenths (Lopes et al. 2009).
fn most_torn() -> usize {
    let world = world();
    let mut solver = Solver::new(&world.mdp);
    let (n_states, n_actions) = (world.mdp.n_states(), world.mdp.n_actions());
    let mut bins = vec![[0.0_f64; 10]; n_states * n_actions];
    for draw in draws().chunks(4) {
        let w: Vec<f64> = draw.iter().map(|w| f64::from(*w)).collect();
        let optimum = solver.solve(&w);
        for state in 0..n_states {
            let exp = |action| (5.0 * optimum.q(state, action)).exp();
            let sum: f64 = (0..n_actions).map(exp).sum();
            for action in 0..n_actions {
                let bin = ((10.0 * exp(action) / sum).ceil() as usize).clamp(1, 10) - 1;
                bins[state * n_actions + action][bin] += 0.01;
            }
        }
    }
    let entropy = |bins: &[f64; 10]| -> f64 { bins.iter().filter(|p| **p > 0.0).map(|p| -p * p.ln()).sum() };
    let of: Vec<f64> = bins.chunks(n_actions).map(|of| of.iter().map(entropy).sum()).collect();
    (0..15).filter(|state| *state != 4).fold(0, |best, state| if of[state] > of[best] + 1e-9 { state } else { best })
}

#[test]
fn the_state_with_the_largest_value_at_risk_is_asked_about_whatever_the_kind() {
    let at_risk = values_at_risk();
    let mut order: Vec<usize> = (0..15).filter(|state| *state != 4).collect();
    order.sort_by(|a, b| at_risk[*b].total_cmp(&at_risk[*a]));
    assert!(at_risk[order[0]] > at_risk[order[1]] + 1e-6, "one is the largest: {at_risk:?}");
    let query = asked(&only(QuestionKind::Action), &[]);
    assert_eq!((query.state as usize, query.kind), (order[0], WorldQuery::ACTION));
    assert!((query.value_at_risk - at_risk[order[0]]).abs() < 1e-9, "{} {at_risk:?}", query.value_at_risk);
    assert!(query.gain.is_nan() && query.n_candidates == 14 && query.loss_bound == 0.5 && query.epsilon_loss == 0.1);
    let (row, column) = (order[0] / 5 + 1, order[0] % 5 + 1);
    assert!(query.reason.starts_with(&format!("What should I do in row {row}, column {column} (")), "{}", query.reason);
    assert!(query.reason.contains("Of 14 places that I may come to"), "{}", query.reason);
    // What was answered comes again only after others, what was skipped not at all.
    let next = asked(&only(QuestionKind::Action), &[answered(&query, 1)]);
    assert_eq!(next.state as usize, order[1]);
    let next = asked(&only(QuestionKind::Action), &[skipped(&query, 1)]);
    assert_eq!(next.state as usize, order[1]);
    for kind in [QuestionKind::Critique, QuestionKind::Comparison] {
        let query = asked(&only(kind), &[]);
        let allowed =
            order.iter().position(|state| *state == query.state as usize).expect("a state with something to do");
        assert!(allowed < 4, "{kind:?} is asked in state {}, of {order:?}", query.state);
        assert!(query.trajectories.iter().all(|way| way.states[0] == query.state));
    }
}

#[test]
fn ways_are_those_of_the_robot_and_of_rivals_with_what_they_amount_to() {
    let world = world();
    let map = Solver::new(&world.mdp).solve(&map()).policy().to_vec();
    let critique = asked(&only(QuestionKind::Critique), &[]);
    let way = &critique.trajectories[0];
    assert!(way.states.len() >= 2 && way.states.len() <= 8);
    for (state, action) in way.states.iter().zip(&way.actions) {
        assert_eq!(*action as usize, map[*state as usize], "the MAP policy's way");
        assert!(!world.mdp.is_terminal(*state as usize));
    }
    let mut first_is_own = Vec::new();
    for seed in 1..9 {
        let compared = asked(&Settings { seed, ..only(QuestionKind::Comparison) }, &[]);
        for way in &compared.trajectories {
            let mut sums = [0.0; 4];
            let mut weight = 1.0;
            for (state, action) in way.states.iter().zip(&way.actions) {
                let phi = world.mdp.features(*state as usize, *action as usize);
                sums.iter_mut().zip(phi).for_each(|(sum, phi)| *sum += weight * phi);
                weight *= world.mdp.gamma();
            }
            assert!(sums.iter().zip(&way.features).all(|(a, b)| (a - b).abs() < 1e-12));
        }
        let is_own = |n: usize| {
            let way = &compared.trajectories[n];
            way.states.iter().zip(&way.actions).all(|(s, a)| map[*s as usize] == *a as usize)
        };
        assert!(is_own(0) || is_own(1));
        first_is_own.push(is_own(0));
    }
    assert!(first_is_own.contains(&true) && first_is_own.contains(&false), "sides are drawn by lot: {first_is_own:?}");
}

#[test]
fn kinds_take_turns_and_an_undo_leads_back_to_the_same_question() {
    let mut records = Vec::new();
    let mut kinds = Vec::new();
    let mut before = None;
    for n in 1..=6 {
        let query = asked(&settings(), &records);
        kinds.push(query.kind);
        records.push(if n % 2 == 0 { skipped(&query, n) } else { answered(&query, n) });
        before = Some(query);
    }
    assert_eq!(kinds, [0, 1, 2, 0, 1, 2]);
    let before = before.expect("there were six");
    records.push(undone(6, 7));
    let again = asked(&settings(), &records);
    let bare = |query: &WorldQuery| {
        let mut query = WorldQuery { id: String::new(), revision: 0, ..query.clone() };
        query.trajectories.iter_mut().for_each(|way| way.id.clear());
        to_cdr(&query)
    };
    assert_eq!(bare(&again), bare(&before));
    assert_ne!(again.id, before.id, "ids are used once");
    // Two kinds alone.
    let two = Settings { question_kinds: vec![QuestionKind::Comparison, QuestionKind::Action], ..settings() };
    assert_eq!(asked(&two, &records[..1]).kind, WorldQuery::COMPARISON);
}

#[test]
fn the_most_telling_question_for_its_time_is_asked_and_now_and_then_one_at_random() {
    let telling = Settings { strategy: Strategy::Information, epsilon_loss: 0.3, ..settings() };
    let query = asked(&telling, &[]);
    let seconds = [4.0, 15.0, 5.0][usize::from(query.kind)];
    assert!(query.gain > 0.0 && (query.gain_per_second - query.gain / seconds).abs() < 1e-15, "{query:?}");
    assert!(query.reason.contains("should tell me most"), "{}", query.reason);
    for kind in KINDS {
        let of_kind = asked(&Settings { question_kinds: vec![kind], ..telling.clone() }, &[]);
        assert!(of_kind.gain_per_second <= query.gain_per_second, "{kind:?} would tell more");
    }
    let lots = |share: f64| {
        let drawn = (1..=40).filter(|seed| {
            asked(&Settings { seed: *seed, hold_out_share: share, ..only(QuestionKind::Action) }, &[]).held_out
        });
        drawn.count()
    };
    assert_eq!(lots(0.0), 0);
    assert!((26..40).contains(&lots(0.8)), "{}", lots(0.8));
    // The other ways of choosing: where the optimal actions disagree most, what tells most of the reward, what brings the risk down.
    let torn = asked(&Settings { strategy: Strategy::Entropy, ..settings() }, &[]);
    assert!(torn.kind == WorldQuery::ACTION && torn.reason.contains("disagree most"), "{}", torn.reason);
    assert_eq!(torn.state as usize, most_torn());
    let no_actions = Settings { strategy: Strategy::Entropy, ..only(QuestionKind::Critique) };
    assert_eq!(asked(&no_actions, &[]).kind, WorldQuery::CRITIQUE);
    for (strategy, words) in
        [(Strategy::RewardInformation, "about what you want"), (Strategy::LookAhead, "what I may lose smaller")]
    {
        let query = asked(&Settings { strategy, ..settings() }, &[]);
        assert!(query.gain > 0.0 && query.gain_per_second > 0.0, "{strategy:?}: {query:?}");
        assert!(query.reason.contains(words), "{}", query.reason);
    }
    let random = Settings { strategy: Strategy::Random, ..only(QuestionKind::Action) };
    let states: std::collections::BTreeSet<u32> =
        (1..=30).map(|seed| asked(&Settings { seed, ..random.clone() }, &[]).state).collect();
    assert!(states.len() > 6 && !states.contains(&4), "{states:?}");
}

#[test]
fn nothing_is_asked_before_all_is_known_or_when_the_lesson_is_over_or_nothing_may_be() {
    let mut node = ActiveQuery::new(settings());
    assert!(step(&mut node, Event::Posterior(Box::new(posterior(0)))).is_empty());
    assert!(step(&mut node, Event::PolicyBounds(Box::new(bounds(0, 0.5)))).is_empty(), "neither world nor evidence");
    assert!(step(&mut node, Event::World(Box::new(message()))).is_empty(), "no evidence yet");
    let told = step(&mut node, Event::Evidence(Box::new(log(&[]))));
    assert!(matches!(told.as_slice(), [Output::WorldQuery(_), Output::Lesson(_), Output::LookAhead]), "{told:?}");
    assert!(step(&mut node, Event::PolicyBounds(Box::new(bounds(0, 0.5)))).is_empty(), "a repetition is no news");
    let again = step(&mut node, Event::Republish);
    assert!(matches!(again.as_slice(), [Output::WorldQuery(_), Output::Lesson(_)]), "{again:?}");
    let over = step(&mut node, Event::PolicyBounds(Box::new(bounds(0, 0.05))));
    assert!(matches!(over.as_slice(), [Output::Lesson(lesson)] if lesson.state == LessonStatus::TAUGHT), "{over:?}");
    assert!(matches!(step(&mut node, Event::Republish).as_slice(), [Output::Lesson(_)]), "no question is open");

    let mut silent = ActiveQuery::new(Settings { question_kinds: vec![], ..settings() });
    step(&mut silent, Event::World(Box::new(message())));
    step(&mut silent, Event::Evidence(Box::new(log(&[]))));
    step(&mut silent, Event::Posterior(Box::new(posterior(0))));
    let told = step(&mut silent, Event::PolicyBounds(Box::new(bounds(0, 0.5))));
    assert!(matches!(told.as_slice(), [Output::Lesson(lesson)] if lesson.query_id.is_empty()), "{told:?}");
}

#[test]
fn a_posterior_and_a_world_that_cannot_be_computed_with_are_told_and_the_lesson_goes_on() {
    let mut node = ActiveQuery::new(settings());
    let broken = TabularWorld { gamma: f64::NAN, ..message() };
    let told = step(&mut node, Event::World(Box::new(broken.clone())));
    assert!(
        matches!(told.as_slice(), [Output::Warn(text)] if text.contains("the world 'yard' is ignored")),
        "{told:?}"
    );
    assert!(step(&mut node, Event::World(Box::new(broken))).is_empty(), "once");
    step(&mut node, Event::World(Box::new(message())));
    step(&mut node, Event::Evidence(Box::new(log(&[]))));
    step(&mut node, Event::Posterior(Box::new(Posterior { draws: vec![f32::NAN; 400], ..posterior(0) })));
    let told = step(&mut node, Event::PolicyBounds(Box::new(bounds(0, 0.5))));
    match told.as_slice() {
        [Output::Warn(text), Output::Lesson(lesson)] => {
            assert!(text.contains("nothing can be asked about the world: it holds weights that are not finite"));
            assert!(lesson.query_id.is_empty() && lesson.state == LessonStatus::ASKING);
        }
        other => panic!("a warning and the lesson were expected, got {other:?}"),
    }
}

/// A node that has asked at revision 0, with its question.
fn asking(settings: &Settings) -> (ActiveQuery, WorldQuery) {
    let mut node = ActiveQuery::new(settings.clone());
    step(&mut node, Event::World(Box::new(message())));
    step(&mut node, Event::Evidence(Box::new(log(&[]))));
    step(&mut node, Event::Posterior(Box::new(posterior(0))));
    let outputs = step(&mut node, Event::PolicyBounds(Box::new(bounds(0, 0.5))));
    let Some(Output::WorldQuery(query)) = outputs.first() else { panic!("a question: {outputs:?}") };
    (node, (**query).clone())
}

/// What is asked in a second, a tick after the other.
fn in_a_second(node: &mut ActiveQuery) -> Vec<WorldQuery> {
    let ticks = (0..10).flat_map(|_| step(node, Event::Tick));
    let query = |output| match output {
        Output::WorldQuery(query) => *query,
        other => panic!("only questions come by themselves: {other:?}"),
    };
    ticks.map(query).collect()
}

#[test]
fn a_person_who_has_waited_for_a_second_is_asked_what_was_chosen_before_and_that_question_stays() {
    for strategy in [Strategy::Var, Strategy::Information, Strategy::LookAhead, Strategy::Entropy, Strategy::Random] {
        let settings = Settings { strategy, ..settings() };
        let (mut node, first) = asking(&settings);
        assert!(step(&mut node, Event::LookAhead).is_empty());
        let records = [answered(&first, 1)];
        step(&mut node, Event::Evidence(Box::new(log(&records))));
        let asked = in_a_second(&mut node);
        let [second] = asked.as_slice() else { panic!("{strategy:?}: one question: {asked:?}") };
        check_world_query(second, &world()).expect("it can be answered");
        assert_eq!((second.revision, second.ahead, first.ahead), (1, 1, 0));
        assert_ne!((second.kind, second.state), (first.kind, first.state), "{strategy:?}: nothing is asked twice");
        assert!(second.reason.ends_with("does not know of it."), "{}", second.reason);
        // Its posterior comes at last: the question is not taken from under the person's hands.
        step(&mut node, Event::Posterior(Box::new(posterior(1))));
        let outputs = step(&mut node, Event::PolicyBounds(Box::new(bounds(1, 0.4))));
        let [Output::Lesson(lesson), Output::LookAhead] = outputs.as_slice() else {
            panic!("no other question: {outputs:?}")
        };
        assert_eq!((&lesson.query_id, lesson.revision, lesson.questions_asked), (&second.id, 1, 2));
        // What may follow it is chosen by that posterior, and asked when the next one is late, too.
        assert!(step(&mut node, Event::LookAhead).is_empty());
        let records = [answered(&first, 1), answered(second, 2)];
        step(&mut node, Event::Evidence(Box::new(log(&records))));
        let asked = in_a_second(&mut node);
        let [third] = asked.as_slice() else { panic!("{strategy:?}: one question: {asked:?}") };
        assert_eq!((third.revision, third.ahead), (2, 1));
        let about = |query: &WorldQuery| (query.kind, query.state);
        assert!(![about(&first), about(second)].contains(&about(third)), "{strategy:?}: nothing is asked twice");
        // One that is not late asks what is then best.
        let records = [answered(&first, 1), answered(second, 2), answered(third, 3)];
        step(&mut node, Event::Evidence(Box::new(log(&records))));
        step(&mut node, Event::Posterior(Box::new(posterior(3))));
        let outputs = step(&mut node, Event::PolicyBounds(Box::new(bounds(3, 0.3))));
        let [Output::WorldQuery(fourth), Output::Lesson(_), Output::LookAhead] = outputs.as_slice() else {
            panic!("{outputs:?}")
        };
        assert_eq!((fourth.revision, fourth.ahead), (3, 0));
    }
}

#[test]
fn a_lesson_that_waits_to_be_confirmed_asks_at_random_and_one_that_is_not_worth_the_time_ends() {
    let told = |settings: &Settings, bound: f64| {
        let mut node = ActiveQuery::new(settings.clone());
        step(&mut node, Event::World(Box::new(message())));
        step(&mut node, Event::Evidence(Box::new(log(&[]))));
        step(&mut node, Event::Posterior(Box::new(posterior(0))));
        step(&mut node, Event::PolicyBounds(Box::new(bounds(0, bound))))
    };
    let confirming = Settings { most_surprises: 0.4, ..settings() };
    let outputs = told(&confirming, 0.05);
    let [Output::WorldQuery(query), Output::Lesson(lesson), Output::LookAhead] = outputs.as_slice() else {
        panic!("a question: {outputs:?}")
    };
    assert!(query.held_out && query.id.contains(['A', 'K', 'C']), "{}", query.id);
    assert_eq!((lesson.state, lesson.to_confirm), (LessonStatus::ASKING, 6));
    let dear = Settings { strategy: Strategy::Information, least_gain_per_second: 10.0, ..settings() };
    let outputs = told(&dear, 0.5);
    let [Output::Lesson(lesson)] = outputs.as_slice() else { panic!("no question: {outputs:?}") };
    assert!(lesson.state == LessonStatus::GAVE_UP && lesson.reason.contains("least_gain_per_second"), "{lesson:?}");
    // A strategy that reckons no gain has none that is too small.
    let var = told(&Settings { strategy: Strategy::Var, ..dear }, 0.5);
    assert!(matches!(var.first(), Some(Output::WorldQuery(_))), "{var:?}");
}

#[test]
fn so_many_are_asked_ahead_and_a_lesson_that_is_over_ends_them() {
    let settings = Settings { questions_ahead: 2, ..settings() };
    let (mut node, first) = asking(&settings);
    step(&mut node, Event::LookAhead);
    let mut records = vec![answered(&first, 1)];
    for n in 1..=2 {
        step(&mut node, Event::Evidence(Box::new(log(&records))));
        let asked = in_a_second(&mut node);
        assert_eq!(asked.iter().map(|query| query.ahead).collect::<Vec<_>>(), [n]);
        records.push(answered(&asked[0], u64::from(n) + 1));
    }
    step(&mut node, Event::Evidence(Box::new(log(&records))));
    assert!(in_a_second(&mut node).is_empty(), "two were allowed");
    step(&mut node, Event::Posterior(Box::new(posterior(2))));
    let told = step(&mut node, Event::PolicyBounds(Box::new(bounds(2, 0.05))));
    assert!(matches!(told.as_slice(), [Output::Lesson(lesson)] if lesson.state == LessonStatus::TAUGHT));
    assert!(in_a_second(&mut node).is_empty());
}

#[test]
fn nobody_is_asked_ahead_who_did_something_else_or_where_it_is_switched_off() {
    let (mut node, first) = asking(&settings());
    step(&mut node, Event::LookAhead);
    step(&mut node, Event::Evidence(Box::new(log(&[answered(&first, 1), undone(1, 2)]))));
    assert!(in_a_second(&mut node).is_empty());
    for off in [Settings { next_within_s: 0.0, ..settings() }, Settings { questions_ahead: 0, ..settings() }] {
        let (mut node, first) = asking(&off);
        step(&mut node, Event::LookAhead);
        step(&mut node, Event::Evidence(Box::new(log(&[answered(&first, 1)]))));
        assert!(in_a_second(&mut node).is_empty());
    }
}

#[test]
fn the_first_of_the_questions_ahead_is_the_open_one_and_the_rest_are_chosen_as_if_it_was_answered() {
    let (posterior, world, log, bounds) = (posterior(0), world(), log(&[]), bounds(0, 0.5));
    let inputs = WorldInputs { posterior: &posterior, world: &world, log: &log, bounds: &bounds };
    let lesson = world_lesson(&settings(), &posterior, &bounds).expect("a lesson");
    let (open, _) = world_question(&settings(), &inputs, &lesson).expect("inputs that fit");
    let open = open.expect("a question");
    let all = questions_ahead(&settings(), &inputs, &lesson, None, 3).expect("inputs that fit");
    assert_eq!((to_cdr(&all[0]), all.len()), (to_cdr(&open), 4));
    let kinds: Vec<u8> = all.iter().map(|query| query.kind).collect();
    assert_eq!(kinds, [0, 1, 2, 0], "kinds go on taking turns");
    assert!(all.iter().zip(0..).all(|(query, n)| (query.revision, query.ahead) == (u64::from(n), n)));
}
