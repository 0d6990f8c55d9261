//! Meshes are found where they may be, and nowhere else.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use robot_files::{Folders, TextError, read_text};
use std::fs;
use std::path::{Path, PathBuf};

/// `ws/my_arm/{urdf/arm.urdf, meshes/link.stl}` and a secret beside `ws`.
fn workspace() -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let package = folder.path().join("ws/my_arm");
    for dir in ["urdf", "meshes"] {
        fs::create_dir_all(package.join(dir)).unwrap();
    }
    fs::write(package.join("urdf/arm.urdf"), "<robot/>").unwrap();
    fs::write(package.join("urdf/near.stl"), "near").unwrap();
    fs::write(package.join("meshes/link.stl"), "mesh").unwrap();
    fs::write(folder.path().join("secret.stl"), "secret").unwrap();
    (folder, package)
}

fn folders(roots: &[&Path], urdf: Option<&Path>) -> Folders {
    Folders::new(&roots.iter().map(|root| (*root).to_owned()).collect::<Vec<_>>(), urdf).unwrap()
}

#[test]
fn packages_are_found_from_their_parent_from_themselves_and_around_the_description() {
    let (_keep, package) = workspace();
    let urdf = package.join("urdf/arm.urdf");
    let name = "package://my_arm/meshes/link.stl";
    for found in [folders(&[package.parent().unwrap()], None), folders(&[&package], None), folders(&[], Some(&urdf))] {
        assert_eq!(found.find(name).unwrap(), b"mesh");
    }
    assert_eq!(folders(&[], Some(&urdf)).find("near.stl").unwrap(), b"near");
    let lost = folders(&[], None).find(name).unwrap_err();
    assert_eq!(lost, "no folder was given that may hold the package 'my_arm'; use --package-path DIR");
    let missing = folders(&[&package], None).find("package://my_arm/meshes/other.stl").unwrap_err();
    assert!(missing.starts_with("not found; looked at ") && missing.contains("other.stl"), "{missing}");
}

#[test]
fn no_name_leads_out_of_the_folders() {
    let (keep, package) = workspace();
    let urdf = package.join("urdf/arm.urdf");
    let secret = keep.path().join("secret.stl");
    let found = folders(&[package.parent().unwrap()], Some(&urdf));
    for name in [
        "package://my_arm/../../secret.stl",
        "package://../secret.stl",
        "package:///etc/passwd",
        "package://my_arm",
        "package://my_arm/",
        "../../../secret.stl",
        "http://example.org/a.stl",
        &format!("file://{}", secret.display()),
        &secret.display().to_string(),
    ] {
        assert!(found.find(name).is_err(), "{name}");
    }
    // `..` that stays inside a given folder is fine; without that folder it is not.
    assert_eq!(found.find("../meshes/link.stl").unwrap(), b"mesh");
    let narrow = folders(&[], Some(&urdf)).find("../meshes/link.stl").unwrap_err();
    assert!(narrow.contains("outside of the folders that were given"), "{narrow}");
}

#[cfg(unix)]
#[test]
fn links_are_followed_inside_only() {
    let (keep, package) = workspace();
    std::os::unix::fs::symlink(keep.path().join("secret.stl"), package.join("meshes/out.stl")).unwrap();
    std::os::unix::fs::symlink(package.join("meshes/link.stl"), package.join("meshes/in.stl")).unwrap();
    let found = folders(&[package.parent().unwrap()], None);
    assert_eq!(found.find("package://my_arm/meshes/in.stl").unwrap(), b"mesh");
    let out = found.find("package://my_arm/meshes/out.stl").unwrap_err();
    assert!(out.contains("leads out of"), "{out}");
}

#[test]
fn only_regular_files_of_limited_size_are_read() {
    let (_keep, package) = workspace();
    let found = folders(&[&package], None);
    fs::create_dir(package.join("meshes/folder.stl")).unwrap();
    assert!(found.find("package://my_arm/meshes/folder.stl").unwrap_err().contains("no regular file"));
    // A file with a hole takes no room on disk.
    let huge = fs::File::create(package.join("meshes/huge.stl")).unwrap();
    huge.set_len(arm::MAX_MESH_BYTES as u64 + 1).unwrap();
    assert!(found.find("package://my_arm/meshes/huge.stl").unwrap_err().contains("simplify"));
    assert!(matches!(read_text(&package.join("meshes/link.stl"), 3), Err(TextError::TooLarge { max: 3, .. })));
    fs::write(package.join("urdf/latin.urdf"), [b'a', 0xff]).unwrap();
    assert!(matches!(read_text(&package.join("urdf/latin.urdf"), 9), Err(TextError::NotText { at: 1, .. })));
    assert!(Folders::new(&[package.join("nowhere")], None).is_err());
}
