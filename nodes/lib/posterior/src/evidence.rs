//! A fingerprint of the evidence: the same demonstrations in the same order, and nothing else, give the same one.

use scene::{Object, Shape};
use sha2::{Digest, Sha256};

use crate::{Confidence, Demonstration};

/// SHA-256 over a canonical encoding of the demonstrations in order: counts and texts with their lengths, numbers by
/// their bits, all little-endian.
pub fn evidence_hash(demonstrations: &[Demonstration]) -> [u8; 32] {
    let mut hash = Sha256::new_with_prefix(b"apprentice evidence 1");
    count(&mut hash, demonstrations.len());
    for demonstration in demonstrations {
        let scene = &demonstration.scene;
        text(&mut hash, &demonstration.id);
        text(&mut hash, &scene.id);
        text(&mut hash, &scene.frame);
        numbers(&mut hash, &[scene.width_m, scene.depth_m]);
        count(&mut hash, scene.objects.len());
        for object in &scene.objects {
            add_object(&mut hash, object);
        }
        add_object(&mut hash, &scene.target);
        numbers(&mut hash, &[demonstration.placement.x, demonstration.placement.y]);
        hash.update([match demonstration.confidence {
            Confidence::Sure => 0,
            Confidence::Fairly => 1,
            Confidence::Guess => 2,
        }]);
    }
    hash.finalize().into()
}

fn add_object(hash: &mut Sha256, object: &Object) {
    text(hash, &object.id);
    text(hash, &object.label);
    match object.shape {
        Shape::Cylinder { radius_m, height_m } => {
            hash.update([0]);
            numbers(hash, &[radius_m, height_m]);
        }
        Shape::Box { width_m, depth_m, height_m } => {
            hash.update([1]);
            numbers(hash, &[width_m, depth_m, height_m]);
        }
    }
    numbers(hash, &[object.position_m.x, object.position_m.y, object.yaw_rad]);
    hash.update([u8::from(object.supports)]);
}

fn count(hash: &mut Sha256, n: usize) {
    hash.update((n as u64).to_le_bytes());
}

fn text(hash: &mut Sha256, text: &str) {
    count(hash, text.len());
    hash.update(text.as_bytes());
}

fn numbers(hash: &mut Sha256, numbers: &[f64]) {
    for x in numbers {
        hash.update(x.to_bits().to_le_bytes());
    }
}
