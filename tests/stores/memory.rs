//! Memory that does not grow with the plane.

#[cfg(target_os = "linux")]
#[test]
fn a_plane_whose_results_do_not_fit_into_memory_is_computed_into_a_store() {
    use std::process::Command;

    use super::program::stderr;

    /// What a process may take, in KiB; the results of the plane take more.
    const LIMIT: u32 = 180_000;
    let folder = tempfile::tempdir().unwrap();
    let program = env!("CARGO_BIN_EXE_impact-atlas");
    let limited = |more: &str| {
        let plane = "--x omega=3:4:1600 --y delta=0.1:0.2:1000 --transient 0 --observe 1 --fixed-periods";
        let command = format!(
            "ulimit -v {LIMIT}; exec {program} map --backend cpu --threads 2 --start rest {plane} {more}"
        );
        Command::new("bash").args(["-c", &command]).current_dir(folder.path()).output().unwrap()
    };
    let refused = limited("");
    assert_eq!(refused.status.code(), Some(3), "{}", stderr(&refused));
    assert!(stderr(&refused).contains("do not fit into this machine's memory"), "{}", stderr(&refused));
    let part = limited("--data plane.zarr --part 1/40");
    assert_eq!(part.status.code(), Some(0), "{}", stderr(&part));
}
