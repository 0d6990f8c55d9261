//! Claims about which node is started, signalled and given up, and when.

use bringup::{Action, Exit, GRACE, LONGEST, SHORTEST, Supervisor, stop_stage};
use proptest::prelude::{prop_assert, prop_assert_eq, prop_oneof, proptest};
use proptest::strategy::{Just, Strategy};
use std::time::Duration;

fn ms(milliseconds: u64) -> Duration {
    Duration::from_millis(milliseconds)
}

/// A recorder (stage 2), two computing nodes (1) and a person (0), all running since 0.
fn running() -> Supervisor {
    let mut supervisor = Supervisor::new(&[2, 1, 1, 0]);
    assert_eq!(supervisor.tick(ms(0)), (0..4).map(Action::Start).collect::<Vec<_>>());
    supervisor
}

#[test]
fn a_node_that_dies_is_started_again_after_its_back_off() {
    let mut supervisor = running();
    let exit = Exit::Signal(9);
    assert_eq!(
        supervisor.exited(ms(100), 1, exit.clone()),
        [Action::Died { node: 1, exit: exit.clone(), wait: SHORTEST }]
    );
    assert_eq!(supervisor.deadline(), Some(ms(300)));
    assert_eq!(supervisor.tick(ms(299)), []);
    assert_eq!(supervisor.tick(ms(300)), [Action::Start(1), Action::Back(1)]);
    assert_eq!(supervisor.exited(ms(301), 1, exit.clone()), [Action::Died { node: 1, exit, wait: 2 * SHORTEST }]);
    assert_eq!(supervisor.starts_and_deaths(1), (2, 2));
    // The report of a death that was reported already changes nothing.
    assert_eq!(supervisor.exited(ms(302), 1, Exit::Code(0)), []);
    assert_eq!(supervisor.exited(ms(302), 99, Exit::Code(0)), []);
}

#[test]
fn bad_input_at_the_first_start_is_final_and_later_only_when_it_persists() {
    let mut supervisor = running();
    let bad = Exit::Code(2);
    assert_eq!(supervisor.exited(ms(5), 1, bad.clone()), [Action::GivenUp { node: 1, exit: bad.clone() }]);
    assert!(supervisor.is_given_up(1));
    assert_eq!(supervisor.tick(ms(60_000)), []);
    // Node 2 ran well at first, so a bad start may be the port that its predecessor still holds.
    let mut now = ms(1000);
    let mut last = supervisor.exited(now, 2, Exit::Signal(9));
    let mut bad_starts = 0;
    while !supervisor.is_given_up(2) {
        now += LONGEST;
        assert_eq!(supervisor.tick(now), [Action::Start(2), Action::Back(2)]);
        last = supervisor.exited(now, 2, bad.clone());
        bad_starts += 1;
    }
    assert_eq!((bad_starts, last), (5, vec![Action::GivenUp { node: 2, exit: bad }]));
}

#[test]
fn a_process_that_cannot_be_started_is_tried_again() {
    let mut supervisor = running();
    let exit = Exit::NotStarted("too many processes".to_owned());
    assert_eq!(supervisor.exited(ms(0), 3, exit.clone()), [Action::Died { node: 3, exit, wait: SHORTEST }]);
}

#[test]
fn nodes_stop_stage_by_stage_and_the_recorder_is_the_last() {
    let mut supervisor = running();
    assert_eq!(supervisor.stop(ms(1000)), [Action::Terminate(3)]);
    assert_eq!(supervisor.stop(ms(1001)), []);
    assert_eq!(supervisor.exited(ms(1002), 3, Exit::Code(0)), [Action::Terminate(1), Action::Terminate(2)]);
    assert_eq!(supervisor.exited(ms(1003), 2, Exit::Code(0)), []);
    assert_eq!(supervisor.exited(ms(1004), 1, Exit::Code(0)), [Action::Terminate(0)]);
    assert_eq!(supervisor.exited(ms(1005), 0, Exit::Code(0)), [Action::AllStopped]);
    assert_eq!(supervisor.starts_and_deaths(0), (1, 0));
    assert_eq!(["demonstrator", "operator_ui", "active_query", "session_recorder"].map(stop_stage), [0, 0, 1, 2]);
}

#[test]
fn a_node_that_does_not_stop_is_killed_after_its_grace_and_the_next_stage_gets_its_own() {
    let mut supervisor = running();
    supervisor.stop(ms(0));
    assert_eq!(supervisor.deadline(), Some(GRACE));
    assert_eq!(supervisor.tick(GRACE - ms(1)), []);
    assert_eq!(supervisor.tick(GRACE), [Action::Kill(3)]);
    assert_eq!(supervisor.deadline(), None);
    assert_eq!(supervisor.exited(GRACE, 3, Exit::Signal(9)), [Action::Terminate(1), Action::Terminate(2)]);
    assert_eq!(supervisor.deadline(), Some(2 * GRACE));
    assert_eq!(supervisor.hurry(GRACE + ms(1)), [Action::Kill(1), Action::Kill(2)]);
    supervisor.exited(GRACE + ms(2), 1, Exit::Signal(9));
    assert_eq!(supervisor.exited(GRACE + ms(2), 2, Exit::Signal(9)), [Action::Terminate(0)]);
    // The recorder is not hurried: the bag would stay unfinished.
    assert_eq!(supervisor.hurry(GRACE + ms(3)), []);
}

#[test]
fn stopping_while_nodes_wait_for_their_restart_does_not_wait_for_them() {
    let mut supervisor = running();
    for node in 0..4 {
        supervisor.exited(ms(1), node, Exit::Signal(9));
    }
    assert_eq!(supervisor.stop(ms(2)), [Action::AllStopped]);
    assert_eq!(supervisor.tick(ms(60_000)), []);
}

#[derive(Debug, Clone)]
enum Happening {
    Tick,
    Exit(usize, Exit),
    Stop,
}

fn happenings() -> impl Strategy<Value = Vec<(u64, Happening)>> {
    let exit = prop_oneof![
        (0..4).prop_map(Exit::Code),
        (1..16).prop_map(Exit::Signal),
        Just(Exit::NotStarted("no".to_owned()))
    ];
    let one = prop_oneof![
        8 => Just(Happening::Tick),
        8 => (0..4_usize, exit).prop_map(|(node, exit)| Happening::Exit(node, exit)),
        1 => Just(Happening::Stop)
    ];
    proptest::collection::vec((0..5000_u64, one), 1..60)
}

proptest! {
    /// Whatever happens: a node runs at most once, is signalled only while it runs, nothing starts after a stop, and when
    /// every process has ended everything is said to have stopped, once.
    #[test]
    fn no_node_runs_twice_and_every_stop_ends(happenings in happenings()) {
        let mut supervisor = Supervisor::new(&[2, 1, 1, 0]);
        let mut alive = [false; 4];
        let (mut now, mut stopped, mut all_stopped) = (Duration::ZERO, false, 0);
        let mut follow = |alive: &mut [bool; 4], actions: Vec<Action>, stopped: bool| {
            for action in actions {
                match action {
                    Action::Start(node) => {
                        prop_assert!(!alive[node] && !stopped);
                        alive[node] = true;
                    }
                    Action::Terminate(node) | Action::Kill(node) => prop_assert!(alive[node] && stopped),
                    Action::AllStopped => {
                        prop_assert!(stopped && !alive.contains(&true));
                        all_stopped += 1;
                    }
                    Action::Died { .. } | Action::GivenUp { .. } | Action::Back(_) => {}
                }
            }
            Ok(())
        };
        for (wait, happening) in happenings {
            now += ms(wait);
            let actions = match happening {
                Happening::Tick => supervisor.tick(now),
                Happening::Exit(node, exit) if alive[node] => {
                    alive[node] = false;
                    supervisor.exited(now, node, exit)
                }
                Happening::Exit(..) => continue,
                Happening::Stop => {
                    let again = std::mem::replace(&mut stopped, true);
                    let actions = supervisor.stop(now);
                    prop_assert!(!again || actions.is_empty());
                    actions
                }
            };
            follow(&mut alive, actions, stopped)?;
        }
        let last = supervisor.stop(now);
        follow(&mut alive, last, true)?;
        for _ in 0..3 {
            now += GRACE;
            let late = supervisor.tick(now);
            follow(&mut alive, late, true)?;
            for node in 0..4 {
                if std::mem::take(&mut alive[node]) {
                    let actions = supervisor.exited(now, node, Exit::Signal(9));
                    follow(&mut alive, actions, true)?;
                }
            }
        }
        prop_assert_eq!(all_stopped, 1);
    }
}
