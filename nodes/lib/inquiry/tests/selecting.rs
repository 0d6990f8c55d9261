//! What is chosen from scores: feasible questions, cheap ones, some at random, and several at once.

use inquiry::{
    Alternatives, Answers, Belief, Branches, Chosen, Effort, InquiryError, Losses, Objective, Question, QuestionKind,
    Round, Selecting, Selection, Strategy, class_information, risk_information, scores, select,
};
use proptest::prelude::{prop_assert, proptest};

/// Four draws; questions 0 and 1 tell the first two from the last two, question 2 the even from the odd ones, less well.
fn round() -> Round {
    let question = |kind, situation, right: f64, says: [bool; 4]| {
        let row: Vec<f64> = says.iter().map(|&says| if says { right } else { 1.0 - right }).collect();
        let other: Vec<f64> = row.iter().map(|p| 1.0 - p).collect();
        let answers = Answers::table(4, [row, other].concat()).expect("answers");
        Question { kind, situation, answers, feasible: true }
    };
    let halves = [true, true, false, false];
    Round {
        belief: Belief::equal(4).expect("draws"),
        losses: Losses::new(4, vec![0.3, 0.2, 0.0, 0.0, 0.4, 0.0, 0.4, 0.0]).expect("losses"),
        questions: vec![
            question(QuestionKind::Critique, 0, 0.999, halves),
            question(QuestionKind::Action, 0, 0.998, halves),
            question(QuestionKind::Comparison, 1, 0.9, [true, false, true, false]),
        ],
        alternatives: Some(
            Alternatives::new(4, vec![0.3, 0.2, 0.0, 0.0, 0.0, 0.3, 0.3, 0.3, 0.3, 0.3, 0.0, 0.3]).expect("losses"),
        ),
    }
}

fn by(strategy: Strategy) -> Selecting {
    Selecting { strategy, effort: None, hold_out_share: 0.0, seed: 1 }
}

fn asked(selection: Selection) -> usize {
    selection.chosen().expect("a question").question
}

#[test]
fn each_strategy_asks_by_its_score() {
    let round = round();
    let ask = |strategy| asked(select(&round, &by(strategy), 1).expect("fits"));
    assert_eq!(ask(Strategy::ValueAtRisk { alpha: 0.75 }), 2);
    assert_eq!(ask(Strategy::RewardInformation), 0);
    // Losses above .25: draws 0 and 2 only, which question 2 tells best.
    assert_eq!(ask(Strategy::RiskInformation { epsilon: 0.25 }), 2);
    assert_eq!(ask(Strategy::LookAhead { objective: Objective::Mean, shortlist: 0 }), 0);
}

#[test]
fn looking_ahead_may_be_kept_to_a_few_questions() {
    let round = round();
    let of = |shortlist| {
        scores(&round, &round.belief, Strategy::LookAhead { objective: Objective::Mean, shortlist }).expect("fits")
    };
    let all = of(0);
    assert!(all.iter().all(|score| score.is_finite()));
    assert_eq!(of(2), [all[0], all[1], f64::NEG_INFINITY]);
    assert_eq!(of(3), all);
}

/// The worst situation counts: a draw exceeds ε when any of its losses does.
#[test]
fn risk_information_is_about_the_worst_situation() {
    let round = round();
    let got = scores(&round, &round.belief, Strategy::RiskInformation { epsilon: 0.25 }).expect("fits");
    let worst = [0.4, 0.2, 0.4, 0.0];
    for (score, question) in got.iter().zip(&round.questions) {
        let expected = risk_information(&question.answers, &round.belief, &worst, 0.25).expect("fits");
        assert!((score - expected).abs() < 1e-15);
    }
}

/// One weight, uniform on [−1, 1]; "first" is said with s(b w); is the weight above .2? In closed form, ∫ s(b w) dw = ln(1 + e^{bw})/b.
#[test]
fn risk_information_by_quadrature() {
    let (n, b, cut) = (4000, 5.0, 0.2);
    let w: Vec<f64> = (0..n).map(|i| -1.0 + (2.0 * f64::from(i) + 1.0) / f64::from(n)).collect();
    let first: Vec<f64> = w.iter().map(|w| 1.0 / (1.0 + (-b * w).exp())).collect();
    let second: Vec<f64> = first.iter().map(|p| 1.0 - p).collect();
    let answers = Answers::table(w.len(), [first, second].concat()).expect("answers");
    let belief = Belief::equal(w.len()).expect("draws");
    let got = risk_information(&answers, &belief, &w, cut).expect("fits");
    let integral = |from: f64, to: f64| 0.5 * ((b * to).exp().ln_1p() - (b * from).exp().ln_1p()) / b;
    let (above, below) = (integral(cut, 1.0), integral(-1.0, cut));
    let (p_above, p_first) = (0.5 * (1.0 - cut), above + below);
    let joint = [[above, p_above - above], [below, 1.0 - p_above - below]];
    let mut expected = 0.0;
    for (i, of_class) in [p_above, 1.0 - p_above].into_iter().enumerate() {
        for (j, of_answer) in [p_first, 1.0 - p_first].into_iter().enumerate() {
            expected += joint[i][j] * (joint[i][j] / of_class / of_answer).ln();
        }
    }
    assert!((got - expected).abs() < 1e-6, "{got} {expected}");
}

#[test]
fn only_what_can_be_carried_out_is_asked() {
    let mut round = round();
    round.only_feasible(|question| question.kind != QuestionKind::Critique);
    assert_eq!(asked(select(&round, &by(Strategy::RewardInformation), 1).expect("fits")), 1);
    assert_eq!(scores(&round, &round.belief, Strategy::RewardInformation).expect("fits")[0], f64::NEG_INFINITY);
    assert_eq!(round.feasible_kinds(), [QuestionKind::Action, QuestionKind::Comparison]);
    round.questions.iter_mut().for_each(|question| question.feasible = false);
    for strategy in [Strategy::Random, Strategy::RewardInformation] {
        let selection = select(&round, &by(strategy), 1).expect("fits");
        assert_eq!(selection, Selection::NothingFeasible);
        assert!(batch(&round, &by(strategy), 1, 3).expect("fits").is_empty());
    }
    round.questions.clear();
    assert_eq!(select(&round, &by(Strategy::Random), 1).expect("fits"), Selection::NothingFeasible);
}

#[test]
fn gains_are_divided_by_the_time_they_take() {
    let round = round();
    let timed = Selecting { effort: Some(Effort::default()), ..by(Strategy::RewardInformation) };
    let chosen = *select(&round, &timed, 1).expect("fits").chosen().expect("a question");
    // The action tells a little less than the critique, in a quarter of the time.
    assert_eq!((chosen.question, chosen.per_second), (1, Some(chosen.score / 4.0)));
    // A value at risk is no gain.
    let at_risk = Selecting { effort: Some(Effort::default()), ..by(Strategy::ValueAtRisk { alpha: 0.75 }) };
    assert_eq!(select(&round, &at_risk, 1).expect("fits").chosen().expect("a question").per_second, None);
    let never = Effort { action_s: 0.0, ..Effort::default() };
    assert!(select(&round, &Selecting { effort: Some(never), ..timed }, 1).is_err());
}

#[test]
fn a_share_of_questions_is_held_out() {
    let round = round();
    let some = Selecting { hold_out_share: 0.2, ..by(Strategy::RewardInformation) };
    let chosen: Vec<_> =
        (0..2000).map(|look| *select(&round, &some, look).expect("fits").chosen().expect("a question")).collect();
    let held_out = chosen.iter().filter(|chosen| chosen.is_hold_out).count();
    // Standard error 18.
    assert!((330..470).contains(&held_out), "{held_out}");
    for question in 0..3 {
        let n = chosen.iter().filter(|chosen| chosen.is_hold_out && chosen.question == question).count();
        assert!((90..180).contains(&n), "{question}: {n}");
    }
    assert!(chosen.iter().all(|chosen| chosen.is_hold_out || chosen.question == 0));
    assert!(select(&round, &Selecting { hold_out_share: 1.0, ..some }, 1).is_err());
}

/// Questions worth asking together: each by its expected score once those before it are answered.
fn batch(round: &Round, selecting: &Selecting, look: u64, n: usize) -> Result<Vec<Chosen>, InquiryError> {
    let (mut chosen, mut asked): (Vec<Chosen>, Vec<usize>) = (Vec::new(), Vec::new());
    let mut branches = Branches::now(round.belief.clone());
    while chosen.len() < n {
        let Selection::Ask(next) = branches.select(round, selecting, look, &asked)? else { break };
        branches = branches.after(&round.questions[next.question].answers, 64);
        asked.push(next.question);
        chosen.push(next);
    }
    Ok(chosen)
}

#[test]
fn a_batch_does_not_ask_the_same_twice() {
    let round = round();
    let questions = |strategy, n| {
        let chosen = batch(&round, &by(strategy), 1, n).expect("fits");
        chosen.iter().map(|chosen| chosen.question).collect::<Vec<_>>()
    };
    // Question 1 scores second, but tells what question 0 told.
    assert_eq!(questions(Strategy::RewardInformation, 2), [0, 2]);
    assert_eq!(questions(Strategy::RewardInformation, 9), [0, 2, 1]);
    assert_eq!(questions(Strategy::Random, 3).len(), 3);
    assert_eq!(questions(Strategy::RewardInformation, 0), Vec::<usize>::new());
}

#[test]
fn parts_that_do_not_fit_are_refused() {
    let mut other = round();
    other.belief = Belief::equal(3).expect("draws");
    assert!(matches!(select(&other, &by(Strategy::Random), 1), Err(InquiryError::Length { .. })));
    let mut other = round();
    other.questions[0].situation = 2;
    assert!(select(&other, &by(Strategy::Random), 1).is_err());
    let mut other = round();
    other.alternatives = None;
    assert!(select(&other, &by(Strategy::LookAhead { objective: Objective::Mean, shortlist: 0 }), 1).is_err());
    assert!(select(&round(), &by(Strategy::ValueAtRisk { alpha: 1.0 }), 1).is_err());
}

#[test]
fn losses_that_are_all_zero_leave_nothing_to_ask_by_risk() {
    let mut safe = round();
    safe.losses = Losses::new(4, vec![0.0; 8]).expect("losses");
    safe.alternatives = Some(Alternatives::new(4, vec![0.0; 8]).expect("losses"));
    for strategy in [
        Strategy::ValueAtRisk { alpha: 0.95 },
        Strategy::RiskInformation { epsilon: 0.1 },
        Strategy::LookAhead { objective: Objective::Mean, shortlist: 0 },
        Strategy::LookAhead { objective: Objective::ValueAtRisk { alpha: 0.95 }, shortlist: 0 },
    ] {
        assert_eq!(select(&safe, &by(strategy), 1).expect("fits"), Selection::NothingToLearn, "{strategy:?}");
    }
    assert!(matches!(select(&safe, &by(Strategy::Random), 1), Ok(Selection::Ask(_))));
}

proptest! {
    /// The expected scores that a batch goes by add up to the information of both answers together.
    #[test]
    fn a_batch_goes_by_joint_information(
        p in proptest::collection::vec(0.05..0.95_f64, 10..11), weights in proptest::collection::vec(0.1..1.0_f64, 5..6),
        losses in proptest::collection::vec(0.0..1.0_f64, 5..6),
    ) {
        let table = |p: &[f64]| -> Answers {
            Answers::table(5, p.iter().copied().chain(p.iter().map(|p| 1.0 - p)).collect()).expect("answers")
        };
        let (a, b) = (table(&p[..5]), table(&p[5..]));
        let mut joint = Vec::new();
        for i in 0..2 {
            for j in 0..2 {
                let (x, y) = (a.likelihood(i).expect("fits"), b.likelihood(j).expect("fits"));
                joint.extend(x.iter().zip(&y).map(|(x, y)| x * y));
            }
        }
        let belief = Belief::weighted(&weights).expect("weights");
        let classes: Vec<usize> = losses.iter().map(|&loss| usize::from(loss > 0.5)).collect();
        let both = class_information(&Answers::table(5, joint).expect("answers"), &belief, &classes, 2).expect("fits");
        let question = |answers: Answers| Question { kind: QuestionKind::Action, situation: 0, answers, feasible: true };
        let round = Round {
            belief, losses: Losses::new(5, losses).expect("losses"), questions: vec![question(a), question(b)], alternatives: None,
        };
        let chosen = batch(&round, &by(Strategy::RiskInformation { epsilon: 0.5 }), 1, 2).expect("fits");
        let sum: f64 = chosen.iter().map(|chosen| chosen.score).sum();
        prop_assert!((sum - both).abs() < 1e-10, "{} {}", sum, both);
    }
}
