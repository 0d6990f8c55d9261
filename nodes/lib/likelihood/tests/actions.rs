//! Claims about the likelihood of chosen actions.

use likelihood::actions::{ActionError, ActionLikelihood, Choice, ChoiceVerdict, without_duplicates};
use mdp::worlds::{chapter4, chapter6};
use mdp::{Mdp, random};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

const SHOWN: [(usize, usize); 6] = [(10, 0), (1, 2), (0, 0), (9, 0), (11, 2), (2, 2)];

fn shown() -> Vec<Choice> {
    SHOWN.iter().map(|&(state, action)| Choice::taken(state, action)).collect()
}

fn rep_0() -> Mdp {
    chapter4::rep_0().mdp().expect("a process")
}

fn times(beta: f64, w: &[f64]) -> Vec<f64> {
    w.iter().map(|w| beta * w).collect()
}

#[test]
fn values_match_the_reference() {
    // Method notes section 6.
    let mdp = rep_0();
    let likelihood = ActionLikelihood::new(&mdp, shown()).expect("choices");
    let mut evaluator = likelihood.evaluator();
    for beta in [1.0, 10.0, 100.0] {
        let value = evaluator.value(&times(beta, &[-0.125; 8]));
        assert!((value + 8.317_766_17).abs() < 5e-9, "{value}");
    }
    for (beta, known) in [(1.0, -6.910_103_09), (10.0, -2.365_131_27), (100.0, -0.678_670_86)] {
        let value = evaluator.value(&times(beta, &chapter4::REP_0_WEIGHTS));
        assert!((value - known).abs() < 5e-9, "{value} {known}");
    }
}

#[test]
fn repeats_count_and_order_does_not() {
    let mdp = rep_0();
    let theta = times(10.0, &chapter4::REP_0_WEIGHTS);
    let value = |choices: Vec<Choice>| ActionLikelihood::new(&mdp, choices).expect("choices").evaluator().value(&theta);
    let once = value(shown());
    let mut twice = [shown(), shown()].concat();
    assert!((value(twice.clone()) - 2.0 * once).abs() < 1e-12);
    assert_eq!(without_duplicates(&twice), shown());
    twice.reverse();
    assert!((value(twice) - 2.0 * once).abs() < 1e-12);
    assert_eq!(value(vec![]), 0.0);
}

/// Choices of every kind.
fn mixed(mdp: &Mdp, rng: &mut ChaCha8Rng) -> Vec<Choice> {
    let verdicts = [ChoiceVerdict::Taken, ChoiceVerdict::Good, ChoiceVerdict::Bad];
    (0..12)
        .map(|i| Choice {
            state: random::index(mdp.n_states(), rng),
            action: random::index(mdp.n_actions(), rng),
            verdict: verdicts[i % 3],
            factor: [1.0, 0.5, 2.0][random::index(3, rng)],
        })
        .collect()
}

#[test]
fn gradients_match_finite_differences() {
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    let mut checked = 0;
    for world in 0..40 {
        let grid = if world % 2 == 0 { chapter4::random(&mut rng) } else { chapter6::random(&mut rng) };
        let mdp = grid.mdp().expect("a process");
        let k = mdp.n_features();
        for wrong_rate in [0.0, 0.1] {
            let likelihood = ActionLikelihood::new(&mdp, mixed(&mdp, &mut rng)).expect("choices");
            let likelihood = likelihood.with_wrong_rate(wrong_rate).expect("a rate");
            let mut evaluator = likelihood.evaluator();
            let theta = times(5.0, &random::l1_sphere(k, &mut rng));
            let mut gradient = vec![0.0; k];
            let value = evaluator.value_and_gradient(&theta, &mut gradient);
            assert!((value - likelihood.evaluator().value(&theta)).abs() < 1e-10 * value.abs());
            for i in 0..k {
                let h = 1e-6;
                let mut at = |step: f64| {
                    let mut moved = theta.clone();
                    moved[i] += step;
                    evaluator.value(&moved)
                };
                let (up, down) = (at(h), at(-h));
                // At a kink the two one-sided slopes differ.
                if ((up - value) - (value - down)).abs() < 1e-9 {
                    let slope = (up - down) / (2.0 * h);
                    assert!((slope - gradient[i]).abs() < 1e-6 * (1.0 + slope.abs()), "{slope} {}", gradient[i]);
                    checked += 1;
                }
            }
        }
    }
    assert!(checked > 400, "only {checked} slopes were away from kinks");
}

#[test]
fn judged_bad_is_the_complement() {
    let mdp = rep_0();
    let judge = |verdict, wrong_rate, beta| {
        let choice = Choice { state: 10, action: 3, verdict, factor: 1.0 };
        let likelihood = ActionLikelihood::new(&mdp, vec![choice]).expect("a choice");
        let likelihood = likelihood.with_wrong_rate(wrong_rate).expect("a rate");
        likelihood.evaluator().value(&times(beta, &chapter4::REP_0_WEIGHTS))
    };
    for wrong_rate in [0.0, 0.2] {
        for beta in [0.0, 1.0, 10.0] {
            let (good, bad) =
                (judge(ChoiceVerdict::Good, wrong_rate, beta), judge(ChoiceVerdict::Bad, wrong_rate, beta));
            assert!((good.exp() + bad.exp() - 1.0).abs() < 1e-12);
        }
    }
    // Where the action is all but certain, its complement is tiny yet finite: a gap of −hundreds, not −∞.
    let best = Choice { state: 10, action: 0, verdict: ChoiceVerdict::Bad, factor: 1.0 };
    let likelihood = ActionLikelihood::new(&mdp, vec![best]).expect("a choice");
    let value = likelihood.evaluator().value(&times(1e5, &chapter4::REP_0_WEIGHTS));
    assert!(value < -100.0 && value.is_finite(), "{value}");
}

#[test]
fn a_factor_is_a_rationality_of_its_own() {
    let mdp = rep_0();
    let doubled: Vec<Choice> = shown().into_iter().map(|choice| Choice { factor: 2.0, ..choice }).collect();
    let once = ActionLikelihood::new(&mdp, shown()).expect("choices");
    let doubled = ActionLikelihood::new(&mdp, doubled).expect("choices");
    let a = once.evaluator().value(&times(20.0, &chapter4::REP_0_WEIGHTS));
    let b = doubled.evaluator().value(&times(10.0, &chapter4::REP_0_WEIGHTS));
    assert!((a - b).abs() < 1e-12);
}

#[test]
fn malformed_choices_are_refused() {
    let mdp = rep_0();
    let refuse = |choice| ActionLikelihood::new(&mdp, vec![Choice::taken(0, 0), choice]).expect_err("refused");
    assert_eq!(refuse(Choice::taken(81, 0)), ActionError::OutOfRange { index: 1, what: "state", got: 81, below: 81 });
    assert_eq!(refuse(Choice::taken(0, 4)), ActionError::OutOfRange { index: 1, what: "action", got: 4, below: 4 });
    let factor = |factor| Choice { factor, ..Choice::taken(0, 0) };
    assert_eq!(refuse(factor(0.0)), ActionError::Factor { index: 1, got: 0.0 });
    assert!(matches!(refuse(factor(f64::NAN)), ActionError::Factor { index: 1, .. }));
    let likelihood = ActionLikelihood::new(&mdp, shown()).expect("choices");
    assert_eq!(likelihood.clone().with_wrong_rate(1.0).err(), Some(ActionError::WrongRate { got: 1.0 }));
    assert_eq!(likelihood.evaluator().value(&[f64::NAN; 8]), f64::NEG_INFINITY);
}
