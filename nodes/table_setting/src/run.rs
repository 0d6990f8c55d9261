//! The command: lessons one after another.

use crate::lessons::{self, Files, ending};
use crate::{Course, Flags, Outcome, SettingError, Settings};
use bus::{Arguments, ParameterError};
use rustix::process::Signal;
use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Name and parameter file of the setting built in.
const BREAKFAST: (&str, &str) = ("breakfast", include_str!("../../../config/breakfast.yaml"));
const MAX_BYTES: u64 = 1 << 20;

/// Runs the command.
pub fn run(flags: &Flags) -> ExitCode {
    match set(flags) {
        Ok(code) => ExitCode::from(code),
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(if matches!(error, SettingError::Lesson { .. } | SettingError::Start(_)) { 1 } else { 2 })
        }
    }
}

fn set(flags: &Flags) -> Result<u8, SettingError> {
    flags.check()?;
    let (name, text) = find(&flags.setting)?;
    // A file that is no setting begins no folder, or the mended one would be another setting.
    if flags.setting != BREAKFAST.0 {
        course(Path::new(&flags.setting))?;
    }
    let folder = flags.session.clone().unwrap_or_else(|| unused(&Path::new("bags").join(&name)));
    let file = folder.join("setting.yaml");
    std::fs::create_dir_all(&folder).map_err(|source| SettingError::Write { path: folder.clone(), source })?;
    match std::fs::read_to_string(&file) {
        Ok(known) if known != text => return Err(SettingError::Other { path: folder }),
        Ok(_) => {}
        Err(_) => write(&file, &text)?,
    }
    let mut course = course(&file)?;
    let signals = [(Signal::INT, SIGINT), (Signal::TERM, SIGTERM), (Signal::HUP, SIGHUP)].map(|(signal, number)| {
        let count = Arc::new(AtomicUsize::new(0));
        let counted = Arc::clone(&count);
        // SAFETY is signal-hook's: the action only counts.
        signal_hook::flag::register_usize(number, counted, 1).map(|_| (signal, count))
    });
    let signals: Vec<_> = signals.into_iter().collect::<Result<_, _>>().map_err(SettingError::Start)?;
    let executable = std::env::current_exe().map_err(SettingError::Start)?;

    let mut endings: Vec<(String, String)> = Vec::new();
    while let Some(lesson) = course.upcoming() {
        let files = Files::of(&folder, &lesson);
        if ending(&files).is_none() {
            println!("== {} of {}: {}", lesson.number, course.len(), lesson.label);
            write(&files.parameters, &(lesson.parameters.clone() + &page(&folder)))?;
            let arguments = arguments(&file, &files, &flags.lesson);
            if let Some(code) = lessons::run(&executable, &arguments, &lesson.id, &files, &signals)? {
                println!(
                    "== interrupted; to go on: apprentice setting {} --session {}",
                    flags.setting,
                    folder.display()
                );
                return Ok(u8::try_from(code).unwrap_or(1));
            }
        }
        let (outcome, words) = ending(&files).ok_or_else(|| SettingError::Lesson {
            id: lesson.id.clone(),
            code: 0,
            logs: files.session.join("logs"),
        })?;
        println!("== {}: {words}", lesson.label);
        endings.push((lesson.label.clone(), words));
        course.end(outcome);
        // Between two lessons there is nobody else to hear it.
        if let Some((signal, _)) = signals.iter().find(|(_, count)| count.load(Ordering::Relaxed) > 0) {
            return Ok(if *signal == Signal::INT { 130 } else { 143 });
        }
    }
    let left = course.done().filter(|(_, outcome)| *outcome == Outcome::Left).count();
    println!("== {} of {} have their place; folder {}", course.len() - left, course.len(), folder.display());
    for (label, words) in endings {
        println!("   {label:<12} {words}");
    }
    Ok(u8::from(left > 0))
}

/// Name and text of a setting.
fn find(setting: &str) -> Result<(String, String), SettingError> {
    if setting == BREAKFAST.0 {
        return Ok((BREAKFAST.0.to_owned(), BREAKFAST.1.to_owned()));
    }
    if !setting.contains('/') && !setting.ends_with(".yaml") && !setting.ends_with(".yml") {
        return Err(SettingError::Unknown { got: setting.chars().take(80).collect() });
    }
    let path = PathBuf::from(setting);
    let failed = |source| SettingError::Read { path: path.clone(), source };
    let mut text = String::new();
    std::fs::File::open(&path).map_err(failed)?.take(MAX_BYTES + 1).read_to_string(&mut text).map_err(failed)?;
    if text.len() as u64 > MAX_BYTES {
        return Err(SettingError::Parameters { path, reason: format!("it is longer than {MAX_BYTES} bytes") });
    }
    let name = path.file_stem().map_or_else(|| "setting".into(), |stem| stem.to_string_lossy().into_owned());
    Ok((name, text))
}

/// What the section /**/setting of a file asks for.
fn course(file: &Path) -> Result<Course, SettingError> {
    let name = file.to_string_lossy();
    // What the bus refuses names file and line already; what its rules refuse does not.
    let refused = |reason: String| match reason.contains(name.as_ref()) {
        true => SettingError::File(reason),
        false => SettingError::Parameters { path: file.to_owned(), reason },
    };
    let words = ["--ros-args".to_owned(), "--params-file".to_owned(), name.clone().into_owned()];
    let arguments = Arguments::parse(&words).map_err(|error| SettingError::File(error.to_string()))?;
    let settings: Settings = arguments.settings().map_err(|error: ParameterError| refused(error.to_string()))?;
    Course::new(&settings).map_err(refused)
}

/// The page keeps its address from lesson to lesson.
fn page(folder: &Path) -> String {
    let token = serde_json::Value::from(folder.join("page-token").to_string_lossy().into_owned());
    format!("/**/operator_ui:\n  ros__parameters:\n    token_file: {token}\n")
}

fn arguments(file: &Path, files: &Files, more: &[String]) -> Vec<String> {
    let text = |path: &Path| path.to_string_lossy().into_owned();
    let mut arguments = vec![
        "--scenario".to_owned(),
        text(file),
        "--session".to_owned(),
        text(&files.session),
        "--summary".to_owned(),
        text(&files.summary),
        "--until-taught".to_owned(),
        "--params-file".to_owned(),
        text(&files.parameters),
    ];
    arguments.extend_from_slice(more);
    arguments
}

/// The path, or the path with the first of -2, -3, … that does not exist.
fn unused(path: &Path) -> PathBuf {
    let numbered = |n: u32| PathBuf::from(format!("{}-{n}", path.display()));
    if path.exists() { (2..).map(numbered).find(|path| !path.exists()).unwrap_or_default() } else { path.to_owned() }
}

fn write(path: &Path, text: &str) -> Result<(), SettingError> {
    std::fs::write(path, text).map_err(|source| SettingError::Write { path: path.to_owned(), source })
}
