//! Picking up, carrying and putting down, from end to end in a simulated world.

use crate::hand::{ALL_STAGES, Manner, TRAY_M, World, near, posterior, settings, table};
use apprentice_msgs::action::{PlaceObjectFeedback, PlaceObjectResult};
use apprentice_msgs::msg::PlacementPlan;
use apprentice_msgs::{from_cdr, to_cdr};
use bus::{ActionRequest, GoalId};
use placement_planner::{Event, Request, Settings};

#[test]
fn a_vase_beside_the_table_is_picked_up_and_stands_where_the_plan_says() {
    let mut world = World::new(settings(), &table(&[0.08, 0.08, 0.2], "cylinder", &TRAY_M));
    world.sees = false;
    world.look();
    assert_eq!(world.plan().outcome, PlacementPlan::CANNOT_PICK, "nobody has seen it yet: {}", world.plan().reason);
    world.sees = true;
    let result = world.place();
    assert_eq!((result.outcome, result.reason.as_str()), (PlaceObjectResult::DONE, "it stands"));
    assert_eq!(world.stages, ALL_STAGES);
    let want = [result.placement.x, result.placement.y, 0.0];
    assert!(near(world.at(), want, 1e-3), "{:?} {want:?}", world.at());
    assert!(near(want, [0.5, 0.5, 0.0], 0.02));
    // It stands there, and that is no reason to pick it up again.
    let plan = world.plan().clone();
    assert!(plan.picks && (plan.pick.position.x, plan.pick.position.y) == (TRAY_M[0], TRAY_M[1]));
    world.look();
    assert_eq!(world.plan().pick, plan.pick);
    // A replay has the recorded plan alone.
    let recorded: PlacementPlan = from_cdr(&to_cdr(&plan)).expect("it is read");
    let task = posterior(&world.scene);
    let request = Request {
        posterior: &task,
        query_id: "",
        scene: &recorded.scene,
        start: &recorded.start,
        pick: Some(&recorded.pick),
        inside_bound: recorded.inside_bound,
    };
    assert_eq!(to_cdr(&world.planner.plan(&request).expect("it can be planned")), to_cdr(&plan));
}

#[test]
fn a_plate_is_taken_by_its_rim_and_a_box_by_its_narrow_side() {
    for (size_m, shape) in [([0.24, 0.24, 0.025], "cylinder"), ([0.03, 0.2, 0.02], "box"), ([0.2, 0.03, 0.02], "box")] {
        let mut world = World::new(settings(), &table(&size_m, shape, &TRAY_M));
        let result = world.place();
        assert_eq!(result.outcome, PlaceObjectResult::DONE, "{size_m:?}: {}", result.reason);
        let want = [result.placement.x, result.placement.y, 0.0];
        assert!(near(world.at(), want, 1e-3), "{size_m:?}: {:?} {want:?}", world.at());
    }
}

#[test]
fn what_is_too_wide_or_out_of_reach_is_left_alone_with_the_reason() {
    let mut world = World::new(settings(), &table(&[0.3, 0.2, 0.05], "box", &TRAY_M));
    let result = world.place();
    assert_eq!(result.outcome, PlaceObjectResult::CANNOT_PICK);
    assert!(result.reason.contains("20.0 cm wide and the gripper opens 15.4 cm"), "{}", result.reason);
    let mut world = World::new(settings(), &table(&[0.08, 0.08, 0.2], "cylinder", &[3.0, 0.2]));
    let result = world.place();
    assert_eq!(result.outcome, PlaceObjectResult::CANNOT_PICK);
    assert!(result.reason.contains("out of the arm's reach"), "{}", result.reason);
}

#[test]
fn a_hand_that_closes_on_nothing_goes_back_and_says_so() {
    let mut world = World::new(settings(), &table(&[0.08, 0.08, 0.2], "cylinder", &[0.9, 0.5]));
    // It is seen where it is not.
    world.seen_at = Some(TRAY_M);
    let start = world.joints();
    let result = world.place();
    assert_eq!(result.outcome, PlaceObjectResult::GRASP_FAILED);
    assert!(result.reason.contains("was not in it"), "{}", result.reason);
    let end = world.joints();
    assert!(start.iter().zip(&end).take(6).all(|(a, b)| (a - b).abs() < 1e-3), "the arm is back: {start:?} {end:?}");
}

#[test]
fn what_is_moved_before_the_hand_is_there_is_not_reached_for() {
    let mut world = World::new(settings(), &table(&[0.08, 0.08, 0.2], "cylinder", &TRAY_M));
    world.look();
    world.ask(1);
    for _ in 0..30 {
        world.pass();
    }
    assert_eq!(world.results, []);
    world.seen_at = Some([TRAY_M[0], TRAY_M[1] + 0.02]);
    world.until("an end", |world| !world.results.is_empty());
    let result = world.results.remove(0);
    assert_eq!(result.outcome, PlaceObjectResult::SCENE_CHANGED);
    assert!(result.reason.contains("was moved before the hand was there"), "{}", result.reason);
    // The next plan goes to where it is now.
    world.look();
    assert!((world.plan().pick.position.y - TRAY_M[1] - 0.02).abs() < 1e-12);
}

#[test]
fn what_is_not_seen_any_more_is_not_reached_for() {
    let mut world = World::new(settings(), &table(&[0.08, 0.08, 0.2], "cylinder", &TRAY_M));
    world.look();
    world.sees = false;
    (0..120).for_each(|_| world.pass());
    let result = world.place();
    assert_eq!(result.outcome, PlaceObjectResult::CANNOT_PICK);
    assert!(result.reason.contains("s ago; 5 s are allowed"), "{}", result.reason);
}

#[test]
fn called_off_with_the_target_in_the_hand_the_next_goal_goes_on_from_there() {
    let mut world = World::new(settings(), &table(&[0.08, 0.08, 0.2], "cylinder", &TRAY_M));
    world.look();
    world.ask(1);
    world.until("the vase is carried", |world| world.stages.contains(&PlaceObjectFeedback::MOVING));
    (0..30).for_each(|_| world.pass());
    world.tell(Event::Place(ActionRequest::Cancel { goal_id: GoalId { uuid: [1; 16] } }));
    assert_eq!(world.results.remove(0).outcome, PlaceObjectResult::CANCELED);
    (0..10).for_each(|_| world.pass());
    assert!(world.at()[2] > 0.02, "it hangs in the air: {:?}", world.at());
    world.stages.clear();
    let result = world.place();
    assert_eq!(result.outcome, PlaceObjectResult::DONE, "{}", result.reason);
    assert_eq!(world.stages, ALL_STAGES[2..]);
    assert!(!world.plan().picks);
    assert!(near(world.at(), [result.placement.x, result.placement.y, 0.0], 1e-3), "{:?}", world.at());
}

#[test]
fn a_gripper_lets_go_of_what_was_put_into_the_hand() {
    let in_hand = Settings { pick: false, ..settings() };
    let mut world = World::new(in_hand, &table(&[0.08, 0.08, 0.2], "cylinder", &[]));
    let result = world.place();
    assert_eq!(result.outcome, PlaceObjectResult::DONE, "{}", result.reason);
    assert_eq!(world.stages, ALL_STAGES[2..]);
    let plan = world.plan();
    let (down, up) = (plan.trajectory.points.last(), plan.retreat.points.first());
    assert_eq!(down.map(|point| &point.positions), up.map(|point| &point.positions), "up from where it let go");
}

#[test]
fn a_controller_of_the_gripper_is_told_once_a_step_and_stalling_is_holding() {
    for manner in [Manner::AllowsStalling, Manner::AbortsOnStalling] {
        let settings = Settings { gripper_controller: "/gripper/gripper_cmd".into(), ..settings() };
        let mut world = World::new(settings, &table(&[0.08, 0.08, 0.2], "cylinder", &TRAY_M));
        world.manner = Some(manner);
        let result = world.place();
        assert_eq!(result.outcome, PlaceObjectResult::DONE, "{manner:?}: {}", result.reason);
        assert_eq!((world.grips, &world.stages[..]), (3, &ALL_STAGES[..]), "open, close, open");
        assert!(near(world.at(), [result.placement.x, result.placement.y, 0.0], 1e-3), "{:?}", world.at());
    }
}

#[test]
fn a_controller_of_the_gripper_that_fails_is_told_with_the_reason() {
    for (manner, words, grips) in [
        (Manner::Refuses, "the gripper's controller refused", 1),
        (Manner::Deaf, "the gripper's controller does not answer", 3),
        (Manner::Fails, "the gripper's controller gave up", 1),
    ] {
        let settings = Settings { gripper_controller: "/gripper/gripper_cmd".into(), ..settings() };
        let mut world = World::new(settings, &table(&[0.08, 0.08, 0.2], "cylinder", &TRAY_M));
        world.manner = Some(manner);
        let before = world.joints();
        let result = world.place();
        assert_eq!(result.outcome, PlaceObjectResult::GRASP_FAILED, "{manner:?}: {}", result.reason);
        assert!(result.reason.contains(words), "{manner:?}: {}", result.reason);
        assert_eq!(world.grips, grips, "{manner:?}");
        assert_eq!(world.joints()[..6], before[..6], "the arm has not moved");
    }
}

#[test]
fn what_the_arm_does_is_told_to_everybody() {
    let mut world = World::new(settings(), &table(&[0.08, 0.08, 0.2], "cylinder", &TRAY_M));
    assert_eq!(world.place().outcome, PlaceObjectResult::DONE);
    let said: Vec<&str> = world.carryings.iter().map(|carrying| carrying.description.as_str()).collect();
    let steps = [
        "the gripper opens",
        "the empty hand goes to it",
        "the gripper closes",
        "the arm takes it there",
        "the gripper lets go",
        "the empty hand goes away",
        "it stands",
    ];
    assert_eq!(said, steps);
    assert!(world.carryings.windows(2).all(|pair| pair[0].progress <= pair[1].progress && !pair[0].over));
    let last = world.carryings.last().expect("it was told");
    assert_eq!((last.over, last.outcome, last.progress), (true, PlaceObjectResult::DONE, 1.0));
    assert_eq!((last.object_id.as_str(), last.revision), ("target", 3));
}

#[test]
fn fingers_that_do_not_close_hold_nothing() {
    let settings = Settings { gripper_controller: "/gripper/gripper_cmd".into(), ..settings() };
    let mut world = World::new(settings, &table(&[0.08, 0.08, 0.2], "cylinder", &TRAY_M));
    world.manner = Some(Manner::Stuck);
    let start = world.joints();
    let result = world.place();
    assert_eq!(result.outcome, PlaceObjectResult::GRASP_FAILED, "{}", result.reason);
    assert_eq!(result.reason, "the gripper did not close; the hand goes back");
    let end = world.joints();
    assert!(start.iter().zip(&end).take(6).all(|(a, b)| (a - b).abs() < 1e-3), "the arm is back: {start:?} {end:?}");
    assert!(near(world.at(), [TRAY_M[0], TRAY_M[1], 0.0], 1e-9), "it stands where it stood");
}

#[test]
fn it_can_be_called_off_at_every_stage_and_asked_for_again() {
    for (i, stage) in ALL_STAGES.into_iter().enumerate() {
        for with_controller in [false, true] {
            let gripper_controller = if with_controller { "/gripper/gripper_cmd".to_owned() } else { String::new() };
            let settings = Settings { gripper_controller, ..settings() };
            let mut world = World::new(settings, &table(&[0.08, 0.08, 0.2], "cylinder", &TRAY_M));
            world.manner = with_controller.then_some(Manner::AllowsStalling);
            world.look();
            world.ask(1);
            world.until("the stage is reached", |world| world.stages.contains(&stage));
            (0..4).for_each(|_| world.pass());
            world.tell(Event::Place(ActionRequest::Cancel { goal_id: GoalId { uuid: [1; 16] } }));
            world.until("an end", |world| !world.results.is_empty());
            let result = world.results.remove(0);
            assert_eq!(result.outcome, PlaceObjectResult::CANCELED, "stage {i}: {}", result.reason);
            // It stands still, and where the target is does not change any more.
            let (arm, at) = (world.joints(), world.at());
            (0..10).for_each(|_| world.pass());
            assert!(arm.iter().zip(world.joints()).all(|(a, b)| (a - b).abs() < 1e-9), "stage {i}: the arm moves");
            assert!(near(at, world.at(), 1e-9), "stage {i}: the target moves");
            world.stages.clear();
            let mut result = world.place();
            if stage == PlaceObjectFeedback::RELEASING && !with_controller {
                // The fingers had stopped half-way with it: they opened, and it fell by the few millimetres to the table.
                assert_eq!(result.outcome, PlaceObjectResult::SCENE_CHANGED, "{}", result.reason);
                assert!(result.reason.contains("was moved before the hand was there"), "{}", result.reason);
                result = world.place();
            }
            assert_eq!(result.outcome, PlaceObjectResult::DONE, "stage {i}: {}", result.reason);
            let want = [result.placement.x, result.placement.y, 0.0];
            assert!(near(world.at(), want, 1e-3), "stage {i}: {:?} {want:?}", world.at());
        }
    }
}
