//! Every message against bytes from an independent implementation, and there and back.

mod support;

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Debug;

use apprentice_msgs::{
    Action, Message, Service, action, action_msgs, builtin_interfaces, control_msgs, diagnostic_msgs, geometry_msgs,
    moveit_msgs, msg, object_recognition_msgs, octomap_msgs, rcl_interfaces, rosgraph_msgs, sensor_msgs, shape_msgs,
    srv, std_msgs, std_srvs, tf2_msgs, trajectory_msgs, unique_identifier_msgs, vision_msgs, visualization_msgs,
};
use apprentice_msgs::{all_actions, all_services, all_types, from_cdr, to_cdr};
use support::filled;

/// Bytes of `tests/golden/cdr.txt`: the type's name, then little-endian, then big-endian.
struct Golden(BTreeMap<&'static str, Vec<Vec<u8>>>);

impl Golden {
    fn read() -> Golden {
        let mut golden: BTreeMap<_, Vec<Vec<u8>>> = BTreeMap::new();
        for line in include_str!("golden/cdr.txt").lines() {
            let (name, hex) = line.split_once(' ').expect("name and bytes");
            let bytes = (0..hex.len()).step_by(2);
            let bytes = bytes.map(|at| u8::from_str_radix(&hex[at..at + 2], 16).expect("hex"));
            golden.entry(name).or_default().push(bytes.collect());
        }
        Golden(golden)
    }
}

/// Padding after the last member does not count: writers differ there.
fn assert_same_bytes(name: &str, ours: &[u8], theirs: &[u8]) {
    let common = ours.len().min(theirs.len());
    assert_eq!(ours[..common], theirs[..common], "{name}");
    assert!(ours.len().abs_diff(theirs.len()) <= 3, "{name}");
    assert!(theirs[common..].iter().all(|byte| *byte == 0), "{name}");
}

fn check<M: Message + Debug + PartialEq>(seen: &mut BTreeSet<&'static str>, golden: &Golden) {
    seen.insert(M::TYPE);
    let message = filled::<M>();
    let bytes = to_cdr(&message);
    assert_eq!(from_cdr::<M>(&bytes).expect(M::TYPE), message);
    if let Some(golden) = golden.0.get(M::TYPE) {
        assert_same_bytes(M::TYPE, &bytes, &golden[0]);
        for bytes in golden {
            assert_eq!(from_cdr::<M>(bytes).expect(M::TYPE), message);
        }
    }
    for end in 0..bytes.len() {
        assert!(from_cdr::<M>(&bytes[..end]).is_err(), "{} cut at {end}", M::TYPE);
    }
}

fn check_service<S: Service>(seen: &mut BTreeSet<&'static str>, golden: &Golden)
where
    S::Request: Debug + PartialEq,
    S::Response: Debug + PartialEq,
{
    assert_eq!(format!("{}_Request", S::TYPE), S::Request::TYPE);
    assert_eq!(format!("{}_Response", S::TYPE), S::Response::TYPE);
    seen.insert(S::TYPE);
    let mut halves = BTreeSet::new();
    check::<S::Request>(&mut halves, golden);
    check::<S::Response>(&mut halves, golden);
}

#[test]
fn every_message_agrees_with_an_independent_implementation() {
    let golden = Golden::read();
    let mut seen = BTreeSet::new();
    let all: [fn(&mut BTreeSet<&'static str>, &Golden); 153] = [
        check::<msg::ActionDemonstration>,
        check::<msg::ArmModel>,
        check::<msg::ArmMotion>,
        check::<msg::ArmPart>,
        check::<msg::ArmPose>,
        check::<msg::Candidates>,
        check::<msg::Carrying>,
        check::<msg::CritiqueSegment>,
        check::<msg::EvidenceLog>,
        check::<msg::EvidenceReceipt>,
        check::<msg::EvidenceRecord>,
        check::<msg::FeatureTrajectory>,
        check::<msg::FrontierPoint>,
        check::<msg::Heartbeat>,
        check::<msg::LearnerHistory>,
        check::<msg::LessonStatus>,
        check::<msg::NodeSettings>,
        check::<msg::PerformanceBounds>,
        check::<msg::PlacementBound>,
        check::<msg::PlacementCandidate>,
        check::<msg::PlacementDemonstration>,
        check::<msg::PlacementOption>,
        check::<msg::PlacementPlan>,
        check::<msg::PlacementQuery>,
        check::<msg::PolicyBound>,
        check::<msg::PolicyBounds>,
        check::<msg::PolicyFrontier>,
        check::<msg::PolicySet>,
        check::<msg::PolicyToJudge>,
        check::<msg::Posterior>,
        check::<msg::PosteriorPreview>,
        check::<msg::PreferenceCycle>,
        check::<msg::QueryResponse>,
        check::<msg::Rationality>,
        check::<msg::Retraction>,
        check::<msg::RiskBound>,
        check::<msg::RiskPreference>,
        check::<msg::RobustPolicy>,
        check::<msg::SceneObject>,
        check::<msg::SegmentCritique>,
        check::<msg::TableReach>,
        check::<msg::TableScene>,
        check::<msg::TabularWorld>,
        check::<msg::TrajectoryPreference>,
        check::<msg::WorldQuery>,
        check::<msg::WorldReference>,
        check::<msg::WorldTrajectory>,
        check::<action_msgs::GoalInfo>,
        check::<action_msgs::GoalStatus>,
        check::<action_msgs::GoalStatusArray>,
        check::<builtin_interfaces::Duration>,
        check::<builtin_interfaces::Time>,
        check::<control_msgs::GripperCommand>,
        check::<control_msgs::JointComponentTolerance>,
        check::<control_msgs::JointTolerance>,
        check::<diagnostic_msgs::DiagnosticArray>,
        check::<diagnostic_msgs::DiagnosticStatus>,
        check::<diagnostic_msgs::KeyValue>,
        check::<geometry_msgs::Accel>,
        check::<geometry_msgs::Point>,
        check::<geometry_msgs::Point32>,
        check::<geometry_msgs::PointStamped>,
        check::<geometry_msgs::Polygon>,
        check::<geometry_msgs::Pose>,
        check::<geometry_msgs::PoseArray>,
        check::<geometry_msgs::PoseStamped>,
        check::<geometry_msgs::PoseWithCovariance>,
        check::<geometry_msgs::PoseWithCovarianceStamped>,
        check::<geometry_msgs::Quaternion>,
        check::<geometry_msgs::QuaternionStamped>,
        check::<geometry_msgs::Transform>,
        check::<geometry_msgs::TransformStamped>,
        check::<geometry_msgs::Twist>,
        check::<geometry_msgs::TwistStamped>,
        check::<geometry_msgs::Vector3>,
        check::<geometry_msgs::Vector3Stamped>,
        check::<geometry_msgs::Wrench>,
        check::<geometry_msgs::WrenchStamped>,
        check::<moveit_msgs::AllowedCollisionEntry>,
        check::<moveit_msgs::AllowedCollisionMatrix>,
        check::<moveit_msgs::AttachedCollisionObject>,
        check::<moveit_msgs::CollisionObject>,
        check::<moveit_msgs::LinkPadding>,
        check::<moveit_msgs::LinkScale>,
        check::<moveit_msgs::ObjectColor>,
        check::<moveit_msgs::PlanningScene>,
        check::<moveit_msgs::PlanningSceneWorld>,
        check::<moveit_msgs::RobotState>,
        check::<object_recognition_msgs::ObjectType>,
        check::<octomap_msgs::Octomap>,
        check::<octomap_msgs::OctomapWithPose>,
        check::<rcl_interfaces::FloatingPointRange>,
        check::<rcl_interfaces::IntegerRange>,
        check::<rcl_interfaces::ListParametersResult>,
        check::<rcl_interfaces::Log>,
        check::<rcl_interfaces::Parameter>,
        check::<rcl_interfaces::ParameterDescriptor>,
        check::<rcl_interfaces::ParameterEvent>,
        check::<rcl_interfaces::ParameterEventDescriptors>,
        check::<rcl_interfaces::ParameterType>,
        check::<rcl_interfaces::ParameterValue>,
        check::<rcl_interfaces::SetParametersResult>,
        check::<rosgraph_msgs::Clock>,
        check::<sensor_msgs::CompressedImage>,
        check::<sensor_msgs::JointState>,
        check::<sensor_msgs::MultiDOFJointState>,
        check::<shape_msgs::Mesh>,
        check::<shape_msgs::MeshTriangle>,
        check::<shape_msgs::Plane>,
        check::<shape_msgs::SolidPrimitive>,
        check::<std_msgs::Bool>,
        check::<std_msgs::Byte>,
        check::<std_msgs::Char>,
        check::<std_msgs::ColorRGBA>,
        check::<std_msgs::Empty>,
        check::<std_msgs::Float32>,
        check::<std_msgs::Float32MultiArray>,
        check::<std_msgs::Float64>,
        check::<std_msgs::Float64MultiArray>,
        check::<std_msgs::Header>,
        check::<std_msgs::Int16>,
        check::<std_msgs::Int32>,
        check::<std_msgs::Int64>,
        check::<std_msgs::Int8>,
        check::<std_msgs::MultiArrayDimension>,
        check::<std_msgs::MultiArrayLayout>,
        check::<std_msgs::String>,
        check::<std_msgs::UInt16>,
        check::<std_msgs::UInt32>,
        check::<std_msgs::UInt64>,
        check::<std_msgs::UInt8>,
        check::<tf2_msgs::TFMessage>,
        check::<trajectory_msgs::JointTrajectory>,
        check::<trajectory_msgs::JointTrajectoryPoint>,
        check::<trajectory_msgs::MultiDOFJointTrajectory>,
        check::<trajectory_msgs::MultiDOFJointTrajectoryPoint>,
        check::<unique_identifier_msgs::UUID>,
        check::<vision_msgs::BoundingBox3D>,
        check::<vision_msgs::Detection3D>,
        check::<vision_msgs::Detection3DArray>,
        check::<vision_msgs::ObjectHypothesis>,
        check::<vision_msgs::ObjectHypothesisWithPose>,
        check::<visualization_msgs::InteractiveMarker>,
        check::<visualization_msgs::InteractiveMarkerControl>,
        check::<visualization_msgs::InteractiveMarkerFeedback>,
        check::<visualization_msgs::InteractiveMarkerInit>,
        check::<visualization_msgs::InteractiveMarkerPose>,
        check::<visualization_msgs::InteractiveMarkerUpdate>,
        check::<visualization_msgs::Marker>,
        check::<visualization_msgs::MarkerArray>,
        check::<visualization_msgs::MenuEntry>,
        check::<visualization_msgs::MeshFile>,
        check::<visualization_msgs::UVCoordinate>,
    ];
    for check in all {
        check(&mut seen, &golden);
    }
    assert!(seen.iter().eq(all_types()), "every message stands in this test's list");
    let standard = all_types().iter().filter(|name| !name.starts_with("apprentice_msgs/"));
    assert!(golden.0.keys().eq(standard), "write_cdr.py knows every standard message");
}

#[test]
fn every_service_goes_there_and_back() {
    let golden = Golden::read();
    let mut seen = BTreeSet::new();
    let all: [fn(&mut BTreeSet<&'static str>, &Golden); 12] = [
        check_service::<action_msgs::CancelGoal>,
        check_service::<rcl_interfaces::DescribeParameters>,
        check_service::<rcl_interfaces::GetParameterTypes>,
        check_service::<rcl_interfaces::GetParameters>,
        check_service::<rcl_interfaces::ListParameters>,
        check_service::<rcl_interfaces::SetParameters>,
        check_service::<rcl_interfaces::SetParametersAtomically>,
        check_service::<std_srvs::Empty>,
        check_service::<std_srvs::SetBool>,
        check_service::<std_srvs::Trigger>,
        check_service::<visualization_msgs::GetInteractiveMarkers>,
        check_service::<srv::SetPaused>,
    ];
    for check in all {
        check(&mut seen, &golden);
    }
    assert!(seen.iter().eq(all_services()), "every service stands in this test's list");
}

fn check_action<A: Action>(seen: &mut BTreeSet<&'static str>, golden: &Golden)
where
    <A::SendGoal as Service>::Request: Debug + PartialEq,
    <A::SendGoal as Service>::Response: Debug + PartialEq,
    <A::GetResult as Service>::Request: Debug + PartialEq,
    <A::GetResult as Service>::Response: Debug + PartialEq,
    A::FeedbackMessage: Debug + PartialEq,
    A::Goal: Debug + PartialEq,
    A::Result: Debug + PartialEq,
    A::Feedback: Debug + PartialEq,
{
    seen.insert(A::TYPE);
    let mut parts = BTreeSet::new();
    check_service::<A::SendGoal>(&mut parts, golden);
    check_service::<A::GetResult>(&mut parts, golden);
    check::<A::FeedbackMessage>(&mut parts, golden);
    assert!(parts.iter().all(|part| part.starts_with(&format!("{}_", A::TYPE))), "{parts:?}");
    // What is put together comes apart again.
    let id = filled();
    let (goal, result, feedback) = (filled::<A::Goal>(), filled::<A::Result>(), filled::<A::Feedback>());
    assert_eq!(A::goal_of(A::goal_request(id, goal.clone())), (id, goal));
    assert_eq!(A::result_of(A::result_response(4, result.clone())), (4, result));
    assert_eq!(A::feedback_of(A::feedback_message(id, feedback.clone())), (id, feedback));
    assert_eq!(A::result_id(&A::result_request(id)), id);
    assert!(A::is_accepted(&A::goal_response(true, filled())) && !A::is_accepted(&A::goal_response(false, filled())));
}

#[test]
fn every_action_goes_there_and_back() {
    let golden = Golden::read();
    let mut seen = BTreeSet::new();
    check_action::<action::PlaceObject>(&mut seen, &golden);
    check_action::<control_msgs::FollowJointTrajectory>(&mut seen, &golden);
    check_action::<control_msgs::GripperCommandAction>(&mut seen, &golden);
    assert!(seen.iter().eq(all_actions()), "every action stands in this test");
}

#[test]
fn a_service_half_without_members_is_one_octet() {
    let request = std_srvs::TriggerRequest::default();
    assert_eq!(to_cdr(&request), [0, 1, 0, 0, 0]);
}

#[test]
fn a_quaternion_starts_as_no_rotation() {
    let quaternion = geometry_msgs::Quaternion::default();
    assert_eq!((quaternion.x, quaternion.w), (0.0, 1.0));
    assert_eq!(geometry_msgs::Pose::default().orientation, quaternion);
}
