//! Questions about decision processes: losses against their definition, answers against the likelihoods they will have as
//! evidence, scores against enumeration.

use inquiry::tabular::{Answering, Over, alternatives, critique_evidence, normalised_state_losses, state_losses};
use inquiry::{
    Belief, DrawnOptima, Effort, InquiryError, Objective, Question, QuestionKind, Round, Selecting, Selection,
    Strategy, reward_information, scores, select, values_at_risk,
};
use likelihood::actions::{ActionLikelihood, Choice, ChoiceVerdict};
use likelihood::preferences::{Answer, AnswerModel, PreferenceLikelihood, Verdict};
use mdp::random::l1_sphere;
use mdp::worlds::{GridWorld, driving};
use mdp::{Mdp, Policy, Solver, policy_losses, rollout, values};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

const BETA: f64 = 7.0;

fn world() -> (Mdp, Vec<f64>) {
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    let grid = GridWorld { slip: 0.1, starts: vec![0, 2, 7], ..GridWorld::random(3, 3, 3, &mut rng) };
    let draws = (0..9).flat_map(|_| l1_sphere(3, &mut rng)).collect();
    (grid.mdp().expect("a world"), draws)
}

#[test]
fn the_riskiest_state_is_the_one_of_the_definition() {
    let (mdp, draws) = world();
    let optima = DrawnOptima::new(&mdp, &draws, 1).expect("draws");
    let policy = Policy::Deterministic(Solver::new(&mdp).solve(&draws[..3]).policy().to_vec());
    let states: Vec<usize> = (0..9).collect();
    let losses = state_losses(&mdp, &optima, &policy, &states).expect("states");
    let belief = Belief::equal(9).expect("draws");
    let at_risk = values_at_risk(&losses, &belief, 0.8).expect("a level");
    for &state in &states {
        // Equation 8.2, draw by draw with other functions, and the smallest x with P(Z ≤ x) ≥ .8: the 8th of 9.
        let mut z: Vec<f64> = draws
            .chunks(3)
            .map(|w| Solver::new(&mdp).solve(w).state_value(state) - values(&mdp, &policy, w).expect("a policy")[state])
            .collect();
        for (z, loss) in z.iter().zip(losses.of(state)) {
            assert!((z - loss).abs() < 1e-12);
        }
        z.sort_unstable_by(f64::total_cmp);
        assert!((at_risk[state] - z[7]).abs() < 1e-12);
    }
    // The policy is optimal under the first draw.
    assert!((0..9).all(|state| losses.of(state)[0] == 0.0));
    // Shares of what the uniform policy loses are that.
    let uniform = Policy::uniform(&mdp);
    let share = normalised_state_losses(&mdp, &optima, &uniform, &uniform, 1e-6, &states).expect("states");
    assert!((0..9).all(|state| share.of(state).iter().all(|x| (x - 1.0).abs() < 1e-12)));
    assert!(state_losses(&mdp, &optima, &policy, &[9]).is_err());
}

fn likelihood_of(mdp: &Mdp, choices: Vec<Choice>, w: &[f64], wrong_rate: f64) -> f64 {
    let theta: Vec<f64> = w.iter().map(|w| BETA * w).collect();
    let likelihood = ActionLikelihood::new(mdp, choices).expect("choices").with_wrong_rate(wrong_rate).expect("a rate");
    likelihood.evaluator().value(&theta).exp()
}

#[test]
fn actions_and_critiques_are_as_probable_as_they_will_be_as_evidence() {
    let (mdp, draws) = world();
    let optima = DrawnOptima::new(&mdp, &draws, 1).expect("draws");
    for wrong_rate in [0.0, 0.2] {
        let answering = Answering { mdp: &mdp, optima: &optima, betas: &[BETA], wrong_rate };
        let answers = answering.action(4).expect("a state");
        let trajectory = [(4, 1), (7, 3), (4, 1), (8, 0)];
        let critique = answering.critique(&trajectory).expect("a trajectory");
        assert_eq!((answers.n(), critique.n()), (4, 8));
        for (draw, w) in draws.chunks(3).enumerate() {
            for action in 0..4 {
                let expected = likelihood_of(&mdp, vec![Choice::taken(4, action)], w, wrong_rate);
                assert!((answers.likelihood(action).expect("an action")[draw] - expected).abs() < 1e-12);
            }
            for labels in 0..8_usize {
                let is_good = |step: usize| Some((labels >> step) & 1 == 1);
                let verdicts = [is_good(0), is_good(1), is_good(0), is_good(2)];
                let evidence = critique_evidence(&trajectory, &verdicts).expect("verdicts");
                assert_eq!(evidence.len(), 3);
                let expected = likelihood_of(&mdp, evidence, w, wrong_rate);
                assert!((critique.likelihood(labels).expect("labels")[draw] - expected).abs() < 1e-12);
            }
        }
    }
    let unjudged = critique_evidence(&[(0, 0), (1, 1)], &[None, Some(false)]).expect("verdicts");
    assert_eq!(unjudged, [Choice { verdict: ChoiceVerdict::Bad, ..Choice::taken(1, 1) }]);
    assert!(critique_evidence(&[(0, 0)], &[]).is_err());
}

/// ARC by brute force: for every labelling of the trajectory, Bayes' rule with the likelihood of that evidence, and the KL
/// divergence of what is then believed from what is believed now.
#[test]
fn information_about_the_reward_is_that_of_enumeration() {
    let (mdp, draws) = world();
    let optima = DrawnOptima::new(&mdp, &draws, 1).expect("draws");
    let answering = Answering { mdp: &mdp, optima: &optima, betas: &[BETA], wrong_rate: 0.0 };
    let belief = Belief::weighted(&[1.0, 2.0, 1.0, 0.5, 1.0, 1.0, 3.0, 1.0, 1.0]).expect("weights");
    let policy = Policy::Deterministic(optima.policy(0).to_vec());
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    for start in 0..9 {
        let trajectory = rollout(&mdp, &policy, start, 4, &mut rng).expect("a start");
        let steps = inquiry::tabular::distinct(&trajectory);
        let mut gain = 0.0;
        for labels in 0..1_usize << steps.len() {
            let evidence: Vec<Choice> = steps
                .iter()
                .enumerate()
                .map(|(i, &(state, action))| Choice {
                    verdict: if labels >> i & 1 == 1 { ChoiceVerdict::Good } else { ChoiceVerdict::Bad },
                    ..Choice::taken(state, action)
                })
                .collect();
            let likelihood: Vec<f64> = draws.chunks(3).map(|w| likelihood_of(&mdp, evidence.clone(), w, 0.0)).collect();
            let joint: Vec<f64> = belief.weights().iter().zip(&likelihood).map(|(w, p)| w * p).collect();
            let total: f64 = joint.iter().sum();
            gain += joint.iter().zip(belief.weights()).map(|(j, w)| j * (j / total / w).ln()).sum::<f64>();
        }
        let answers = answering.critique(&trajectory).expect("a trajectory");
        let got = reward_information(&answers, &belief).expect("fits");
        assert!((got - gain).abs() < 1e-10, "{start}: {got} {gain}");
    }
}

#[test]
fn comparisons_are_as_probable_as_they_will_be_as_evidence() {
    let (mdp, draws) = world();
    let optima = DrawnOptima::new(&mdp, &draws, 1).expect("draws");
    let answering = Answering { mdp: &mdp, optima: &optima, betas: &[BETA], wrong_rate: 0.0 };
    let (a, b) = ([(0, 1), (3, 1)], [(8, 0), (5, 2), (4, 0)]);
    let model = AnswerModel { equal_threshold: 0.4, cant_tell: 0.2, wrong_rate: 0.05 };
    let answers = answering.comparison(&a, &b, &model).expect("trajectories");
    let features: Vec<f64> =
        [&a[..], &b[..]].iter().flat_map(|t| inquiry::tabular::discounted_features(&mdp, t).expect("pairs")).collect();
    let said = [(1, 0, Verdict::Strict), (0, 1, Verdict::Strict), (0, 1, Verdict::Equal), (0, 1, Verdict::CantTell)];
    for (answer, (less, more, verdict)) in said.into_iter().enumerate() {
        let one = vec![Answer { less, more, factor: 1.0, verdict }];
        let likelihood = PreferenceLikelihood::new(3, features.clone(), one, model).expect("an answer");
        for (draw, w) in draws.chunks(3).enumerate() {
            let theta: Vec<f64> = w.iter().map(|w| BETA * w).collect();
            let got = answers.likelihood(answer).expect("an answer")[draw];
            assert!((got - likelihood.value(&theta).exp()).abs() < 1e-12);
        }
    }
    let plain = answering.comparison(&a, &b, &AnswerModel::default()).expect("trajectories");
    assert_eq!(plain.n(), 2);
    assert!(answering.comparison(&a, &b, &AnswerModel { wrong_rate: 1.0, ..model }).is_err());
    assert!(answering.comparison(&[(0, 4)], &b, &model).is_err());
}

#[test]
fn alternatives_lose_what_policies_lose() {
    let (mdp, draws) = world();
    let optima = DrawnOptima::new(&mdp, &draws, 1).expect("draws");
    let current = Policy::uniform(&mdp);
    let mean = alternatives(&mdp, &optima, &current, 3, Over::Starts).expect("a policy");
    let worst = alternatives(&mdp, &optima, &current, 3, Over::WorstStart).expect("a policy");
    assert_eq!((mean.n(), worst.n()), (4, 4));
    let policies =
        [current].into_iter().chain([0, 3, 6].map(|draw| Policy::Deterministic(optima.policy(draw).to_vec())));
    for (i, policy) in policies.enumerate() {
        let counts = mdp::feature_counts(&mdp, &policy).expect("a policy");
        let expected = policy_losses(&mdp, &counts, &draws, 1).expect("draws");
        assert!(mean.of(i).iter().zip(&expected).all(|(a, b)| (a - b).abs() < 1e-12));
        let of_states = state_losses(&mdp, &optima, &policy, &[0, 2, 7]).expect("states");
        for draw in 0..9 {
            let largest = (0..3).map(|s| of_states.of(s)[draw]).fold(0.0, f64::max);
            assert!((worst.of(i)[draw] - largest).abs() < 1e-12);
        }
    }
}

/// A round of action questions in any world; the whole chain of calls that a node makes.
fn round(mdp: &Mdp, draws: &[f64], states: &[usize], threads: usize) -> Result<Round, InquiryError> {
    let optima = DrawnOptima::new(mdp, draws, threads)?;
    let n = optima.n();
    let current = Policy::Deterministic(optima.policy(0).to_vec());
    let answering = Answering { mdp, optima: &optima, betas: &[BETA], wrong_rate: 0.0 };
    let question = |(situation, &state): (usize, &usize)| {
        let answers = answering.action(state)?;
        Ok(Question { kind: QuestionKind::Action, situation, answers, feasible: true })
    };
    Ok(Round {
        belief: Belief::equal(n)?,
        losses: state_losses(mdp, &optima, &current, states)?,
        questions: states.iter().enumerate().map(question).collect::<Result<_, InquiryError>>()?,
        alternatives: Some(alternatives(mdp, &optima, &current, 20, Over::Starts)?),
    })
}

fn strategies() -> [Strategy; 7] {
    [
        Strategy::Random,
        Strategy::ValueAtRisk { alpha: 0.95 },
        Strategy::ActionEntropy,
        Strategy::RewardInformation,
        Strategy::RiskInformation { epsilon: 0.05 },
        Strategy::LookAhead { objective: Objective::Mean, shortlist: 0 },
        Strategy::LookAhead { objective: Objective::ValueAtRisk { alpha: 0.9 }, shortlist: 0 },
    ]
}

fn selecting(strategy: Strategy) -> Selecting {
    Selecting { strategy, effort: Some(Effort::default()), hold_out_share: 0.1, seed: 5 }
}

#[test]
fn questions_do_not_depend_on_the_number_of_threads() {
    let mdp = driving::world();
    let mut rng = ChaCha8Rng::seed_from_u64(9);
    let draws: Vec<f64> = (0..150).flat_map(|_| l1_sphere(driving::N_FEATURES, &mut rng)).collect();
    let states: Vec<usize> = (0..driving::N_STATES).step_by(4).collect();
    let rounds = [1, 2, 5, 64].map(|threads| round(&mdp, &draws, &states, threads).expect("a round"));
    for other in &rounds[1..] {
        assert_eq!(other, &rounds[0]);
    }
    for strategy in strategies() {
        let first = select(&rounds[0], &selecting(strategy), 1).expect("fits");
        assert!(matches!(first, Selection::Ask(_)), "{strategy:?}: {first:?}");
        assert_eq!(first, select(&rounds[3], &selecting(strategy), 1).expect("fits"));
    }
}

#[test]
fn one_draw_leaves_nothing_to_learn() {
    let (mdp, draws) = world();
    let alone = round(&mdp, &draws[..3], &[0, 1, 2], 1).expect("a round");
    for strategy in strategies().into_iter().filter(|strategy| *strategy != Strategy::Random) {
        let never_random = Selecting { hold_out_share: 0.0, ..selecting(strategy) };
        assert_eq!(select(&alone, &never_random, 1).expect("fits"), Selection::NothingToLearn, "{strategy:?}");
        assert!(scores(&alone, &alone.belief, strategy).expect("fits").iter().all(|score| score.abs() < 1e-12));
    }
    assert!(matches!(round(&mdp, &[], &[0], 1), Err(InquiryError::Empty { what: "draws" })));
    assert!(round(&mdp, &draws[..4], &[0], 1).is_err());
}
