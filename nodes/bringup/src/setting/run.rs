//! The command: lessons one after another.

use super::lessons::{self, Files, ending};
use super::{Course, Flags, Outcome, SettingError, Settings};
use crate::session::{unused, write_whole};
use crate::{BringupError, read_parameters};
use bus::Arguments;
use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
use signal_hook::iterator::Signals;
use std::path::Path;
use std::process::ExitCode;

/// Name and parameter file of the setting built in.
const BREAKFAST: (&str, &str) = ("breakfast", include_str!("../../../../config/breakfast.yaml"));

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
    std::fs::create_dir_all(&folder).map_err(|source| BringupError::Write { path: folder.clone(), source })?;
    match std::fs::read_to_string(&file) {
        Ok(known) if known != text => return Err(SettingError::Other { path: folder }),
        Ok(_) => {}
        Err(_) => write(&file, &text)?,
    }
    let mut course = course(&file)?;
    let mut signals = Signals::new([SIGINT, SIGTERM, SIGHUP]).map_err(SettingError::Start)?;
    let executable = std::env::current_exe().map_err(SettingError::Start)?;

    let mut endings: Vec<(String, String)> = Vec::new();
    while let Some(lesson) = course.upcoming() {
        let files = Files::of(&folder, &lesson);
        if ending(&files).is_none() {
            println!("== {} of {}: {}", lesson.number, course.len(), lesson.label);
            write(&files.parameters, &(lesson.parameters.clone() + &page(&folder)))?;
            let arguments = arguments(&file, &files, &flags.lesson);
            if let Some(code) = lessons::run(&executable, &arguments, &lesson.id, &files, &mut signals)? {
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
        if let Some(signal) = signals.pending().next() {
            return Ok(u8::try_from(128 + signal).unwrap_or(1));
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
    let path = Path::new(setting);
    let text = read_parameters(path)?;
    let name = path.file_stem().map_or_else(|| "setting".into(), |stem| stem.to_string_lossy().into_owned());
    Ok((name, text))
}

/// What the section /**/setting of a file asks for.
fn course(file: &Path) -> Result<Course, SettingError> {
    let name = file.to_string_lossy();
    let refused = |reason: String| SettingError::Parameters { path: file.to_owned(), reason };
    let words = ["--ros-args".to_owned(), "--params-file".to_owned(), name.clone().into_owned()];
    let arguments = Arguments::parse(&words).map_err(BringupError::from)?;
    // What the bus refuses names file and line already; what the rules of a setting refuse does not.
    let settings: Settings = arguments.settings().map_err(|error| match error.to_string() {
        reason if reason.contains(name.as_ref()) => BringupError::from(error).into(),
        reason => refused(reason),
    })?;
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
        "--until-placed".to_owned(),
        "--params-file".to_owned(),
        text(&files.parameters),
    ];
    arguments.extend_from_slice(more);
    arguments
}

fn write(path: &Path, text: &str) -> Result<(), BringupError> {
    write_whole(path, text).map_err(|source| BringupError::Write { path: path.to_owned(), source })
}
