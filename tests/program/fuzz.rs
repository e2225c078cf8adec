//! Random invocations: whatever is asked, the program answers with an exit code, in time, and leaves nothing behind.
//!
//! A few hundred are run; `IMPACT_ATLAS_FUZZ=2000` runs as many as it says, `IMPACT_ATLAS_FUZZ_SEED` others.

use std::collections::BTreeMap;
use std::env;
use std::fs::{self, File};
use std::path::Path;
use std::process::{Child, Output, Stdio};
use std::time::{Duration, Instant};

use impact_atlas::store::fields;
use npyz::{DType, NpyFile};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use serde_json::Value;
use tempfile::tempdir;
use zip::ZipArchive;

use crate::invocations::{self, Invocation, Subject};
use crate::run::{names, program, run_in, stderr};

/// How many are run unless the environment says otherwise.
const FEW: usize = 300;

/// What the program announces as soon as something will take longer.
const WORTH_SAYING: Duration = Duration::from_secs(10);

/// What the driver of a software adapter takes to compile the kernels of a number of coordinates and stops.
const COMPILING: Duration = Duration::from_secs(30);

/// By how much a run may exceed what was announced, or could have been.
const PATIENCE: u32 = 10;

fn number(name: &str, default: usize) -> usize {
    env::var(name).ok().map_or(default, |text| text.parse().expect("a number"))
}

#[test]
fn whatever_is_asked_is_answered() {
    let seed = number("IMPACT_ATLAS_FUZZ_SEED", 9) as u64;
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut codes = [0; 4];
    let all = number("IMPACT_ATLAS_FUZZ", FEW);
    for number in 0..all {
        let Invocation { file, before, arguments } = invocations::invocation(&mut random);
        let folder = tempdir().unwrap();
        if let Some((name, text)) = file {
            fs::write(folder.path().join(name), text).unwrap();
        }
        if !before.is_empty() {
            let arguments: Vec<&str> = before.iter().map(String::as_str).collect();
            let prepared = run_in(folder.path(), &arguments);
            assert_eq!(prepared.status.code(), Some(0), "{before:?}: {}", stderr(&prepared));
        }
        let known = Known::of(folder.path());
        let wrong = match answered(folder.path(), &arguments) {
            Ok(output) => {
                let code = output.status.code().unwrap_or(-1);
                if let Some(count) = usize::try_from(code).ok().and_then(|code| codes.get_mut(code)) {
                    *count += 1;
                }
                faults(folder.path(), &known, &output)
            }
            Err(wrong) => vec![wrong],
        };
        let [before, asked] = [before, arguments].map(|arguments| arguments.join(" "));
        assert!(wrong.is_empty(), "invocation {number} of seed {seed}: {before}; {asked}\n{wrong:#?}");
    }
    // Of either kind there were enough that the checks were put to the test.
    println!("exit codes 0 to 3: {codes:?}");
    assert!(codes[0] > all / 4 && codes[2] > all / 20, "{codes:?}");
}

/// What the program said and how it ended, unless it took too long.
fn answered(folder: &Path, arguments: &[String]) -> Result<Output, String> {
    let mut command = program();
    command.args(arguments).current_dir(folder).stdin(Stdio::null());
    let (out, err) = (folder.join("..out"), folder.join("..err"));
    command.stdout(File::create(&out).unwrap()).stderr(File::create(&err).unwrap());
    let began = Instant::now();
    let mut child = command.spawn().unwrap();
    let status = loop {
        if let Some(status) = child.try_wait().unwrap() {
            break status;
        }
        let limit = PATIENCE * announced(&fs::read_to_string(&err).unwrap_or_default());
        if began.elapsed() > limit {
            end(&mut child);
            return Err(format!("not over after {:?}", began.elapsed()));
        }
        std::thread::sleep(Duration::from_millis(3));
    };
    let output = Output { status, stdout: fs::read(&out).unwrap(), stderr: fs::read(&err).unwrap() };
    fs::remove_file(out).unwrap();
    fs::remove_file(err).unwrap();
    Ok(output)
}

fn end(child: &mut Child) {
    child.kill().unwrap();
    child.wait().unwrap();
}

/// The time that the program said it would take; what it would have had to say otherwise.
fn announced(said: &str) -> Duration {
    let of_line = |line: &str| {
        let (_, time) = ["will take about ", "may take "].iter().find_map(|said| line.split_once(said))?;
        let mut words = time.split(' ');
        let number: f64 = words.next()?.parse().ok()?;
        let unit = match words.next()? {
            "s" => 1.0,
            "min" => 60.0,
            "h" => 3600.0,
            _ => 86_400.0,
        };
        Some(Duration::from_secs_f64(number * unit))
    };
    let compiles =
        said.lines().any(|line| line.starts_with("computing on gpu: ") && line.ends_with("software)"));
    let compiling = if compiles { COMPILING } else { Duration::ZERO };
    WORTH_SAYING + compiling + said.lines().filter_map(of_line).sum::<Duration>()
}

/// The files that a run found in its folder, as they were.
#[derive(Default)]
struct Known(BTreeMap<String, Vec<u8>>);

impl Known {
    fn of(folder: &Path) -> Self {
        let content = |name: &String| fs::read(folder.join(name)).unwrap_or_default();
        Known(names(folder).into_iter().map(|name| (name.clone(), content(&name))).collect())
    }

    /// Names of files that are new, or not what they were.
    fn changed(&self, folder: &Path) -> Vec<String> {
        let now = Known::of(folder).0;
        now.into_iter()
            .filter(|(name, content)| self.0.get(name) != Some(content))
            .map(|(name, _)| name)
            .collect()
    }

    /// Names of files that are gone.
    fn lost(&self, folder: &Path) -> Vec<&String> {
        self.0.keys().filter(|name| !folder.join(name).exists()).collect()
    }
}

/// Everything that is wrong with an answer.
fn faults(folder: &Path, known: &Known, output: &Output) -> Vec<String> {
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    let code = output.status.code();
    let mut wrong = Vec::new();
    if !matches!(code, Some(0..=3)) {
        wrong.push(format!("exit code {code:?}: {said}"));
    }
    if ["panicked", "internal error", "ZipWriter", "RUST_BACKTRACE"].iter().any(|word| said.contains(word)) {
        wrong.push(format!("a panic: {said}"));
    }
    let files = known.changed(folder);
    wrong.extend(known.lost(folder).iter().map(|name| format!("{name} is gone")));
    if code == Some(0) {
        let listed =
            |name: &&String| said.lines().any(|line| line.starts_with("written: ") && line.contains(*name));
        wrong.extend(files.iter().filter(|name| !listed(name)).map(|name| format!("{name} is not listed")));
        if let Err(why) = is_clean(&output.stdout) {
            wrong.push(why);
        }
    } else if !files.is_empty() {
        wrong.push(format!("exit code {code:?} left {files:?}"));
    }
    if code != Some(0) && said.trim().is_empty() {
        wrong.push(format!("exit code {code:?} without a word"));
    }
    if code == Some(2) && !output.stdout.is_empty() {
        wrong.push("wrong input has a result".to_owned());
    }
    wrong.extend(files.iter().filter_map(|name| unreadable(&folder.join(name)).err()));
    wrong
}

/// Whether a text result has no NaN in it; JSON must be JSON, pictures and archives are not texts.
fn is_clean(result: &[u8]) -> Result<(), String> {
    let Ok(text) = std::str::from_utf8(result) else { return Ok(()) };
    let is_word = |word: &str| word.eq_ignore_ascii_case("nan") || ["inf", "-inf"].contains(&word);
    if text.split(|c: char| !c.is_alphanumeric() && c != '-').any(is_word) {
        return Err(format!("NaN or infinity in {text}"));
    }
    if text.starts_with(['{', '[']) {
        serde_json::from_str::<Value>(text).map_err(|error| format!("no JSON ({error}): {text}"))?;
    }
    Ok(())
}

/// Whether a file is what its name says, with NaN only where the table of fields has it.
fn unreadable(path: &Path) -> Result<(), String> {
    let bytes = fs::read(path).map_err(|error| error.to_string())?;
    let name = path.display();
    match path.extension().and_then(|extension| extension.to_str()) {
        Some("csv") => is_clean(&bytes),
        Some("png") if bytes.starts_with(b"\x89PNG") && bytes.ends_with(b"IEND\xaeB`\x82") => Ok(()),
        Some("svg") if bytes.ends_with(b"</svg>\n") || bytes.ends_with(b"</svg>") => numbers_of_svg(&bytes),
        Some("npz") => archive(path),
        Some("pdf") if bytes.starts_with(b"%PDF") => Ok(()),
        Some("json" | "md") => Ok(()),
        _ => Err(format!("{name} is not what its name says")),
    }
}

/// Whether no number of a picture is NaN; embedded pixels may well read like it.
fn numbers_of_svg(bytes: &[u8]) -> Result<(), String> {
    let text = String::from_utf8_lossy(bytes);
    match ["\"NaN", " NaN", ",NaN", "\"inf\"", " inf "].iter().find(|word| text.contains(**word)) {
        Some(word) => Err(format!("`{word}` in a picture")),
        None => Ok(()),
    }
}

fn archive(path: &Path) -> Result<(), String> {
    let broken = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
    let mut zip = ZipArchive::new(File::open(path).unwrap()).map_err(|error| broken(&error))?;
    let files: Vec<String> = zip.file_names().map(|name| name.unwrap().into_owned()).collect();
    for file in files {
        let field = file.trim_end_matches(".npy").to_owned();
        let array = NpyFile::new(zip.by_name(&file).unwrap()).map_err(|error| broken(&error))?;
        let DType::Plain(kind) = array.dtype() else { return Err(broken(&"not plain")) };
        let finite = match kind.to_string().trim_matches('\'') {
            "<f4" => array.into_vec::<f32>().map(|values| values.iter().all(|value| value.is_finite())),
            "<f8" => array.into_vec::<f64>().map(|values| values.iter().all(|value| value.is_finite())),
            _ => Ok(true),
        };
        let may_be_missing = fields::files()
            .iter()
            .flat_map(|file| file.fields.clone())
            .any(|known| known.name == field && known.may_be_missing());
        if !finite.map_err(|error| broken(&error))? && !may_be_missing {
            return Err(format!("{}: {field} is not finite", path.display()));
        }
    }
    Ok(())
}

/// The checks find what they are there for.
#[test]
fn faults_would_be_found() {
    let folder = tempdir().unwrap();
    let ended = |command: &str| std::process::Command::new("sh").args(["-c", command]).output().unwrap();
    let found = |command: &str| faults(folder.path(), &Known::default(), &ended(command)).len();
    assert_eq!(found("echo done"), 0);
    assert_eq!(found("echo 'error: no' >&2; exit 2"), 0);
    assert_eq!(found("echo thread panicked >&2; exit 101"), 2);
    assert_eq!(found("echo exponent NaN"), 1);
    assert_eq!(found("echo '{\"a\": inf'"), 1);
    assert_eq!(found("exit 1"), 1);
    assert_eq!(found("echo result; echo no >&2; exit 2"), 1);
    fs::write(folder.path().join("half.csv"), "time\nNaN\n").unwrap();
    assert_eq!(found("echo 'error: no' >&2; exit 2"), 2);
    assert_eq!(found("echo done"), 2);
    // A file that was there may not change without a word, nor go.
    let known = Known::of(folder.path());
    let against = |command: &str| faults(folder.path(), &known, &ended(command)).len();
    assert_eq!(against("echo 'error: no' >&2; exit 2"), 0);
    let path = folder.path().join("half.csv");
    fs::write(&path, "time\n1\n").unwrap();
    assert_eq!(against("echo 'error: no' >&2; exit 2"), 1);
    fs::remove_file(path).unwrap();
    assert_eq!(against("echo 'error: no' >&2; exit 2"), 1);
    assert_eq!(announced("the map will take about 3 min (measured on 512 of 9000 cells)").as_secs(), 190);
    assert_eq!(announced("computing on cpu"), WORTH_SAYING);
}

/// Families from files take part, sound ones and damaged ones.
#[test]
fn files_of_ones_own_are_sound_until_they_are_damaged() {
    let mut random = ChaCha8Rng::seed_from_u64(3);
    let drawn: Vec<Subject> = (0..2000).map(|_| Subject::random(&mut random)).collect();
    let own = |sound: bool| drawn.iter().filter(|s| s.file.is_some() && s.sound == sound).count();
    assert!(own(true) > 100 && own(false) > 50, "{} {}", own(true), own(false));
    let named = |subject: &&Subject| subject.option.starts_with("--system") && subject.file.is_none();
    assert!(drawn.iter().filter(named).count() > 400);
}
