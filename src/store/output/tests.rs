//! Files and links, there and not there, kept and replaced.

use tempfile::{TempDir, tempdir};

use super::*;

fn names(directory: &TempDir) -> Vec<String> {
    let entries = fs::read_dir(directory).unwrap();
    entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect()
}

#[test]
fn a_file_is_written_and_replaced() {
    let directory = tempdir().unwrap();
    let path = directory.path().join("map.png");
    for content in ["first", "second"] {
        let output = Output::prepare(&path).unwrap();
        output.write(|file| file.write_all(content.as_bytes())).unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), content);
    }
    assert_eq!(names(&directory), ["map.png"]);
}

#[test]
fn a_file_that_is_to_stay_stays() {
    let directory = tempdir().unwrap();
    let path = directory.path().join("map.png");
    let output = Output::prepare(&path).unwrap().keeping().unwrap();
    let filled = output.fill(|file| file.write_all(b"ours")).unwrap();
    fs::write(&path, "theirs").unwrap();
    assert!(matches!(filled.show(), Err(OutputError::Exists(_))));
    assert_eq!(fs::read_to_string(&path).unwrap(), "theirs");
    let refused = Output::prepare(&path).unwrap().keeping().unwrap_err().to_string();
    assert!(refused.contains("map.png") && refused.contains("--force"), "{refused}");
    assert_eq!(names(&directory), ["map.png"]);
}

#[test]
fn what_is_filled_and_not_shown_is_gone() {
    let directory = tempdir().unwrap();
    let output = Output::prepare(directory.path().join("map.png")).unwrap();
    drop(output.fill(|file| file.write_all(b"content")).unwrap());
    assert!(names(&directory).is_empty());
}

#[test]
fn preparing_changes_nothing() {
    let directory = tempdir().unwrap();
    Output::prepare(directory.path().join("new.npz")).unwrap();
    assert!(names(&directory).is_empty());
    fs::write(directory.path().join("old.npz"), "old").unwrap();
    Output::prepare(directory.path().join("old.npz")).unwrap();
    assert_eq!(fs::read_to_string(directory.path().join("old.npz")).unwrap(), "old");
}

#[test]
fn a_failure_leaves_the_old_file_and_nothing_else() {
    let directory = tempdir().unwrap();
    let path = directory.path().join("map.npz");
    fs::write(&path, "old").unwrap();
    let output = Output::prepare(&path).unwrap();
    let fail = |kind: ErrorKind| {
        output.write(|file| {
            file.write_all(&[0; 100_000])?;
            Err(kind.into())
        })
    };
    let full = fail(ErrorKind::StorageFull).unwrap_err();
    assert!(matches!(full, OutputError::DiskFull { .. }));
    assert!(full.to_string().contains("map.npz"));
    assert!(matches!(fail(ErrorKind::FileTooLarge), Err(OutputError::TooLarge { .. })));
    assert!(matches!(fail(ErrorKind::Other), Err(OutputError::Write { .. })));
    assert_eq!(fs::read_to_string(&path).unwrap(), "old");
    assert_eq!(names(&directory), ["map.npz"]);
}

#[test]
fn what_cannot_work_is_named_beforehand() {
    let directory = tempdir().unwrap();
    let root = directory.path();
    fs::write(root.join("file"), "").unwrap();
    let is = |path: &Path, part: &str| {
        let message = Output::prepare(path).unwrap_err().to_string();
        assert!(message.contains(part) && message.contains(&path.display().to_string()), "{message}");
    };
    is(root, "is a directory");
    is(&root.join("new/"), "is a directory");
    is(&root.join("missing/map.png"), "create it first");
    is(&root.join("file/map.png"), "no directory");
    is(Path::new(""), "names no file");
    is(Path::new(".."), "is a directory");
    let mut permissions = fs::metadata(root.join("file")).unwrap().permissions();
    permissions.set_readonly(true);
    fs::set_permissions(root.join("file"), permissions).unwrap();
    is(&root.join("file"), "write-protected");
}

#[cfg(unix)]
#[test]
fn devices_are_refused_and_links_are_followed() {
    let refused = Output::prepare("/dev/null");
    assert!(matches!(refused, Err(OutputError::Special(_))));
    let directory = tempdir().unwrap();
    let (real, link) = (directory.path().join("real"), directory.path().join("link"));
    fs::write(&real, "old").unwrap();
    std::os::unix::fs::symlink(&real, &link).unwrap();
    Output::prepare(&link).unwrap().write(|file| file.write_all(b"new")).unwrap();
    assert!(link.is_symlink());
    assert_eq!(fs::read_to_string(&real).unwrap(), "new");

    // A link to a file that is yet to be made, by way of another.
    let (far, near) = (directory.path().join("far"), directory.path().join("near"));
    std::os::unix::fs::symlink("made", &far).unwrap();
    std::os::unix::fs::symlink("far", &near).unwrap();
    Output::prepare(&near).unwrap().keeping().unwrap().write(|file| file.write_all(b"new")).unwrap();
    assert!(far.is_symlink() && near.is_symlink());
    assert_eq!(fs::read_to_string(directory.path().join("made")).unwrap(), "new");
    assert!(matches!(Output::prepare(&near).unwrap().keeping(), Err(OutputError::Exists(_))));
    let round = directory.path().join("round");
    std::os::unix::fs::symlink("round", &round).unwrap();
    assert!(matches!(Output::prepare(&round), Err(OutputError::Circle(_))));
}

#[cfg(unix)]
#[test]
fn permissions_are_those_of_any_other_file() {
    use std::os::unix::fs::PermissionsExt;
    let directory = tempdir().unwrap();
    let mode = |name: &str| fs::metadata(directory.path().join(name)).unwrap().permissions().mode();
    let write = |name: &str| {
        let output = Output::prepare(directory.path().join(name)).unwrap();
        output.write(|file| file.write_all(b"content")).unwrap();
    };
    fs::write(directory.path().join("ordinary"), "").unwrap();
    write("ours");
    assert_eq!(mode("ours"), mode("ordinary"));
    fs::set_permissions(directory.path().join("ours"), fs::Permissions::from_mode(0o640)).unwrap();
    write("ours");
    assert_eq!(mode("ours") & 0o777, 0o640);
}
