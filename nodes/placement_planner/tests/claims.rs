//! What is planned when, that nothing moves before its time, and that a plan is a function of what it names.

mod support;

use apprentice_msgs::action::PlaceObjectResult;
use apprentice_msgs::msg::{LessonStatus, PlacementPlan, Posterior};
use apprentice_msgs::sensor_msgs::JointState;
use apprentice_msgs::to_cdr;
use bus::testing::check_parameters;
use placement_planner::{Deed, Event, Output, PlacementPlanner, Request, Settings};
use support::{URDF, joints, lesson, only_plan, posterior, query, ready, scene, step};

#[test]
fn parameters_are_documented() {
    check_parameters::<Settings>();
}

#[test]
fn the_guess_is_for_the_open_question_and_the_plan_for_the_table() {
    let mut node = ready();
    assert!(step(&mut node, Event::Scene(Box::new(scene()))).is_empty());
    assert!(step(&mut node, Event::Query(Box::new(query("q1", 1)))).is_empty(), "nothing is known yet");
    let outputs = step(&mut node, Event::Posterior(Box::new(posterior(1))));
    let [Output::Guess(guess), Output::Plan(plan)] = outputs.as_slice() else { panic!("{outputs:?}") };
    assert_eq!((guess.query_id.as_str(), plan.query_id.as_str()), ("q1", ""));
    assert_eq!((plan.outcome, plan.inside_bound), (PlacementPlan::PLANNED, false), "{}", plan.reason);
    assert!((plan.map_placement.x - 0.5).abs() < 1e-6 && (plan.map_placement.y - 0.5).abs() < 1e-6);
    assert!(plan.robust_cvar_m < 1e-6 && !plan.trajectory.points.is_empty());
    assert_eq!((plan.reward_map.len(), plan.cell_state.len()), (1024, 1024));
    assert!(step(&mut node, Event::Query(Box::new(query("q0", 0)))).is_empty(), "of another revision");
    let again = step(&mut node, Event::Republish);
    assert!(matches!(again.as_slice(), [Output::Plan(p)] if to_cdr(&**p) == to_cdr(&**plan)));
}

#[test]
fn nothing_moves_before_the_lesson_is_taught_and_then_once() {
    let mut node = ready();
    step(&mut node, Event::Scene(Box::new(scene())));
    assert!(!only_plan(&step(&mut node, Event::Posterior(Box::new(posterior(3))))).inside_bound);
    assert!(step(&mut node, lesson(LessonStatus::ASKING, 3)).is_empty());
    let other = step(&mut node, lesson(LessonStatus::TAUGHT, 2));
    assert!(!only_plan(&other).inside_bound, "taught is of another revision");
    let outputs = step(&mut node, lesson(LessonStatus::TAUGHT, 3));
    let [Output::Plan(plan), Output::Deed(Deed::Publish(motion))] = outputs.as_slice() else { panic!("{outputs:?}") };
    assert!(plan.inside_bound);
    assert_eq!(**motion, plan.trajectory);
    let mut moved = scene();
    moved.objects[0].pose.position.x += 0.005;
    assert!(
        only_plan(&step(&mut node, Event::Scene(Box::new(moved.clone())))).inside_bound,
        "planned anew, not moved again"
    );
    moved.objects[0].pose.position.x = 0.8;
    let outputs = step(&mut node, Event::Scene(Box::new(moved)));
    let [Output::Deed(Deed::Publish(halt)), Output::Deed(Deed::Over(_, over)), Output::Plan(plan)] = outputs.as_slice()
    else {
        panic!("{outputs:?}")
    };
    assert!(halt.points.is_empty(), "the arm stops");
    assert_eq!(over.outcome, PlaceObjectResult::SCENE_CHANGED);
    assert!(!plan.inside_bound, "the bound is not about this table");

    let mut still = PlacementPlanner::new(Settings { execute: false, ..Settings::default() });
    step(&mut still, Event::Joints(joints()));
    step(&mut still, Event::RobotDescription(URDF.into()));
    step(&mut still, Event::Scene(Box::new(scene())));
    step(&mut still, lesson(LessonStatus::TAUGHT, 3));
    assert!(only_plan(&step(&mut still, Event::Posterior(Box::new(posterior(3))))).inside_bound);

    let mut lost = PlacementPlanner::new(Settings::default());
    step(&mut lost, Event::RobotDescription(URDF.into()));
    step(&mut lost, Event::Scene(Box::new(scene())));
    step(&mut lost, lesson(LessonStatus::TAUGHT, 3));
    only_plan(&step(&mut lost, Event::Posterior(Box::new(posterior(3)))));
    let found = step(&mut lost, Event::Joints(joints()));
    assert!(
        matches!(found.as_slice(), [Output::Plan(_), Output::Deed(Deed::Publish(_))]),
        "an arm that is found may move"
    );
}

#[test]
fn without_a_robot_placements_stand_and_nothing_moves() {
    let mut node = PlacementPlanner::new(Settings::default());
    step(&mut node, Event::Scene(Box::new(scene())));
    step(&mut node, lesson(LessonStatus::TAUGHT, 1));
    let plan = only_plan(&step(&mut node, Event::Posterior(Box::new(posterior(1)))));
    assert_eq!((plan.outcome, plan.robot_hash.as_str()), (PlacementPlan::NO_ROBOT, ""));
    assert!((plan.robust_placement.x - 0.5).abs() < 1e-6 && plan.trajectory.points.is_empty());
}

#[test]
fn a_plan_is_a_function_of_what_it_names() {
    let mut node = ready();
    step(&mut node, Event::Scene(Box::new(scene())));
    let plan = only_plan(&step(&mut node, Event::Posterior(Box::new(posterior(1)))));
    let mut other = PlacementPlanner::new(Settings { threads: 1, ..Settings::default() });
    other.set_robot(URDF, None).expect("the robot is right");
    let request = Request {
        posterior: &posterior(1),
        query_id: &plan.query_id,
        scene: &plan.scene,
        start: &plan.start,
        pick: None,
        inside_bound: plan.inside_bound,
    };
    assert_eq!(to_cdr(&other.plan(&request).expect("it was planned before")), to_cdr(&plan));
}

#[test]
fn bad_input_is_told_once_and_survived() {
    let mut node = ready();
    let warned = |outputs: Vec<Output>| match outputs.as_slice() {
        [Output::Warn(text)] => text.clone(),
        other => panic!("a warning was expected, got {other:?}"),
    };
    assert!(warned(step(&mut node, Event::RobotDescription("<robot".into()))).contains("robot description is ignored"));
    assert!(step(&mut node, Event::RobotDescription("<robot".into())).is_empty());
    let lost = JointState { position: vec![f64::NAN; 7], ..joints() };
    assert!(warned(step(&mut node, Event::Joints(lost.clone()))).contains("'shoulder_yaw' is at NaN"));
    assert!(step(&mut node, Event::Joints(lost)).is_empty());
    let broken = Posterior { draws: vec![f32::NAN; 80], ..posterior(1) };
    assert!(warned(step(&mut node, Event::Posterior(Box::new(broken)))).contains("not finite"));
    let mut nan = scene();
    nan.objects[0].pose.position.x = f64::NAN;
    assert!(step(&mut node, Event::Scene(Box::new(nan))).is_empty(), "nothing is planned yet");
    assert!(warned(step(&mut node, Event::Posterior(Box::new(posterior(1))))).contains("no plan for scene 'task'"));
    assert_eq!(only_plan(&step(&mut node, Event::Scene(Box::new(scene())))).outcome, PlacementPlan::PLANNED);
}
