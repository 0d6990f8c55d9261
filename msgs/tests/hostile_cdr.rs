//! What hostile bytes can do: be refused, never a panic, never memory out of proportion.

mod support;

use apprentice_msgs::msg::{
    EvidenceLog, EvidenceRecord, PolicySet, Posterior, TableScene, TabularWorld, TrajectoryPreference,
};
use apprentice_msgs::rcl_interfaces::ParameterValue;
use apprentice_msgs::visualization_msgs::InteractiveMarkerUpdate;
use apprentice_msgs::{CdrError, Message, from_cdr, std_msgs, to_cdr, trajectory_msgs};
use proptest::collection::vec;
use proptest::prelude::*;
use support::filled;

fn read_all(bytes: &[u8]) {
    let _ = from_cdr::<EvidenceLog>(bytes);
    let _ = from_cdr::<Posterior>(bytes);
    let _ = from_cdr::<TabularWorld>(bytes);
    let _ = from_cdr::<TrajectoryPreference>(bytes);
    let _ = from_cdr::<PolicySet>(bytes);
    let _ = from_cdr::<ParameterValue>(bytes);
    let _ = from_cdr::<InteractiveMarkerUpdate>(bytes);
    let _ = from_cdr::<trajectory_msgs::JointTrajectory>(bytes);
}

#[test]
fn a_declared_length_beyond_the_bytes_is_refused() {
    for length in [2_u32, 1000, 0x7fff_ffff, u32::MAX] {
        let mut floats = to_cdr(&std_msgs::Float64MultiArray::default());
        let at = floats.len() - 4;
        floats[at..].copy_from_slice(&length.to_le_bytes());
        assert!(from_cdr::<std_msgs::Float64MultiArray>(&floats).is_err());

        let mut text = to_cdr(&std_msgs::String::default());
        text[4..8].copy_from_slice(&length.to_le_bytes());
        assert!(from_cdr::<std_msgs::String>(&text).is_err());

        let mut nested = to_cdr(&EvidenceLog::default());
        let at = nested.len() - 4;
        nested[at..].copy_from_slice(&length.to_le_bytes());
        assert!(from_cdr::<EvidenceLog>(&nested).is_err());
    }
}

#[test]
fn a_bounded_sequence_with_more_elements_is_refused() {
    let record = EvidenceRecord { retraction: vec![filled(), filled()], ..EvidenceRecord::default() };
    let error = from_cdr::<EvidenceRecord>(&to_cdr(&record)).expect_err("two where one may be");
    assert!(error.to_string().contains("got length 2, expected at most 1"));
}

#[test]
fn errors_name_the_type_and_what_was_expected() {
    let short = from_cdr::<TableScene>(&[0, 1]).expect_err("short");
    assert!(matches!(short, CdrError::NoHeader { got: 2, .. }));
    let mut xcdr2 = to_cdr(&TableScene::default());
    xcdr2[1] = 7;
    let foreign = from_cdr::<TableScene>(&xcdr2).expect_err("XCDR2");
    assert_eq!(
        foreign.to_string(),
        "apprentice_msgs/msg/TableScene: got CDR representation 0x0007, \
         expected 0x0000 (CDR_BE) or 0x0001 (CDR_LE)"
    );
    let mut long = to_cdr(&std_msgs::Bool::default());
    long.extend([0; 7]);
    assert!(from_cdr::<std_msgs::Bool>(&long).is_ok(), "padding to 8 is allowed");
    long.push(0);
    assert!(matches!(from_cdr::<std_msgs::Bool>(&long), Err(CdrError::Trailing { got: 8, .. })));
}

#[test]
fn text_that_is_not_utf8_and_bools_beyond_1_are_refused() {
    assert!(from_cdr::<std_msgs::String>(&[0, 1, 0, 0, 2, 0, 0, 0, 0xff, 0]).is_err());
    assert!(from_cdr::<std_msgs::Bool>(&[0, 1, 0, 0, 2]).is_err());
}

/// Bytes of memory that a scene's members on the heap take.
fn heap(scene: &TableScene) -> usize {
    let object = size_of_val(&scene.target);
    scene.objects.capacity() * object
        + scene.id.capacity()
        + scene.header.frame_id.capacity()
        + scene.objects.iter().map(|object| object.id.capacity() + object.label.capacity()).sum::<usize>()
}

#[test]
fn memory_stays_in_proportion_to_the_bytes() {
    let scene = TableScene { objects: vec![Default::default(); 10_000], ..TableScene::default() };
    let bytes = to_cdr(&scene);
    let back = from_cdr::<TableScene>(&bytes).expect("well formed");
    assert!(heap(&back) <= 8 * bytes.len());
}

/// Plausible bytes: a good message with a few octets replaced, or with its end cut off.
fn mutated<M: Message>() -> impl Strategy<Value = Vec<u8>> {
    let bytes = to_cdr(&filled::<M>());
    let length = bytes.len();
    (vec((0..length, any::<u8>()), 0..6), 0..=length).prop_map(move |(changes, end)| {
        let mut bytes = bytes.clone();
        for (at, octet) in changes {
            bytes[at] = octet;
        }
        bytes.truncate(end.max(length / 2));
        bytes
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(512))]

    #[test]
    fn random_bytes_never_panic(big: bool, body in vec(any::<u8>(), 0..400)) {
        let mut bytes = vec![0, u8::from(!big), 0, 0];
        bytes.extend(&body);
        read_all(&bytes);
        read_all(&body);
    }

    #[test]
    fn damaged_messages_never_panic(
        log in mutated::<EvidenceLog>(),
        posterior in mutated::<Posterior>(),
        world in mutated::<TabularWorld>(),
        policies in mutated::<PolicySet>(),
        markers in mutated::<InteractiveMarkerUpdate>(),
    ) {
        for bytes in [log, posterior, world, policies, markers] {
            read_all(&bytes);
        }
    }

    #[test]
    fn what_is_read_is_written_again_the_same(draws in vec(-1e30_f32..1e30, 0..200), reason: String) {
        let reason = reason.replace('\0', "");
        let posterior = Posterior { draws, reason, ..filled() };
        let bytes = to_cdr(&posterior);
        let back = from_cdr::<Posterior>(&bytes).expect("well formed");
        prop_assert_eq!(to_cdr(&back), bytes);
        prop_assert_eq!(back, posterior);
    }
}
