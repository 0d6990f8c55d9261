//! Whatever was said and taken back, in whatever order and of whatever kind: only what is in force counts, to the bit.

mod support;

use apprentice_msgs::msg::{FeatureTrajectory, TrajectoryPreference};
use proptest::prelude::{Just, Strategy, any, prop_oneof, proptest};
use proptest::test_runner::{Config, RngSeed};
use reward_posterior::{Event, Settings};
use support::{Bench, acted, back, bits, critique, history, ranked, row, settings, shown, table, trajectory};

/// One thing a person does.
#[derive(Debug, Clone)]
enum Act {
    Place {
        x: u8,
    },
    Choose {
        state: u32,
        action: u32,
        n: usize,
        confidence: u8,
    },
    Rank {
        from: u32,
        n: u32,
        answer: u8,
        confidence: u8,
    },
    Mark {
        state: u32,
        action: u32,
        verdict: u8,
    },
    Learn {
        from: u32,
        n: u32,
    },
    /// Takes one of the pieces in force back, counted from the newest.
    Undo(usize),
}

fn act() -> impl Strategy<Value = Act> {
    prop_oneof![
        (4..=6_u8).prop_map(|x| Act::Place { x }),
        (0..11_u32, 0..2_u32, 1..4_usize, 0..3_u8).prop_map(|(state, action, n, confidence)| Act::Choose {
            state,
            action,
            n,
            confidence
        }),
        (0..9_u32, 2..4_u32, 0..3_u8, 0..3_u8).prop_map(|(from, n, answer, confidence)| Act::Rank {
            from,
            n,
            answer,
            confidence
        }),
        (0..11_u32, 0..2_u32, 0..2_u8).prop_map(|(state, action, verdict)| Act::Mark { state, action, verdict }),
        (0..9_u32, 2..4_u32).prop_map(|(from, n)| Act::Learn { from, n }),
        any::<usize>().prop_map(Act::Undo),
        Just(Act::Undo(0)),
    ]
}

/// Trajectories that are always the same under the same id.
fn trajectories(from: u32, n: u32) -> Vec<FeatureTrajectory> {
    let phi = |i: u32| (0..11).map(|k| f64::from((i * 7 + k * 3) % 5) / 5.0).collect::<Vec<f64>>();
    (from..from + n).map(|i| trajectory(&format!("t{i}"), &phi(i))).collect()
}

fn event(id: &str, act: &Act) -> Option<Event> {
    Some(match *act {
        Act::Place { x } => Event::Demonstration(Box::new(shown(id, f64::from(x) / 10.0, 0.5))),
        Act::Choose { state, action, n, confidence } => {
            let mut message = acted(id, &vec![(state, action); n]);
            message.confidence = confidence;
            Event::Actions(Box::new(message))
        }
        Act::Rank { from, n, answer, confidence } => {
            let message = ranked(id, &trajectories(from, n));
            Event::Preference(Box::new(TrajectoryPreference { answer, confidence, ..message }))
        }
        Act::Mark { state, action, verdict } => {
            Event::Critique(Box::new(critique(id, &[(state, action)], &[(0, 1, verdict)])))
        }
        Act::Learn { from, n } => Event::History(Box::new(history(id, &trajectories(from, n)))),
        Act::Undo(_) => return None,
    })
}

fn begun(settings: &Settings) -> Bench {
    let mut bench = Bench::new(settings.clone());
    bench.step(Event::Scene(Box::new(table())));
    bench.step(Event::World(Box::new(row("row", 11))));
    bench
}

proptest! {
    #![proptest_config(Config { cases: 12, failure_persistence: None, rng_seed: RngSeed::Fixed(5), ..Config::default() })]

    #[test]
    fn only_what_is_in_force_counts(acts in proptest::collection::vec(act(), 1..10), learned: bool) {
        let log_sd = if learned { 0.5 } else { 0.0 };
        let settings = Settings {
            beta_log_sd: log_sd,
            beta_actions_log_sd: log_sd,
            beta_progress_log_sd: log_sd,
            ..settings()
        };
        let mut lived = begun(&settings);
        let mut in_force: Vec<(String, Act)> = Vec::new();
        for (i, act) in acts.iter().enumerate() {
            match (event(&format!("e{i}"), act), act) {
                (Some(event), _) => {
                    lived.take(event);
                    in_force.push((format!("e{i}"), act.clone()));
                }
                (None, Act::Undo(which)) if !in_force.is_empty() => {
                    let (id, _) = in_force.remove(in_force.len() - 1 - which % in_force.len());
                    lived.take(Event::Retraction(Box::new(back(&format!("r{i}"), &id))));
                }
                (None, _) => {}
            }
            // Whether the posterior was computed in between must not matter.
            if i % 3 == 0 {
                lived.posterior();
            }
        }
        let mut fresh = begun(&settings);
        for (id, act) in &in_force {
            fresh.take(event(id, act).expect("only what says something is in force"));
        }
        assert!(bits(&lived.posterior()) == bits(&fresh.posterior()), "{in_force:?}");
    }
}
