//! Claims about settings: precedence, types, ranges, suggestions, and the way through YAML.

use proptest::prelude::*;
use serde::{Deserialize, Serialize};

use super::{BusParameters, settings_from_yaml, settings_to_yaml};
use crate::{Arguments, NodeSettings, ParameterError, ParameterSpec, Place, Range, testing::check_parameters};

#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Mode {
    VeryCareful,
    Bold,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Settings {
    active: bool,
    count: u64,
    alpha: f64,
    name: String,
    mode: Mode,
    weights: Vec<f64>,
    names: Vec<String>,
}

impl Default for Settings {
    fn default() -> Self {
        Settings {
            active: true,
            count: 3,
            alpha: 0.95,
            name: "vase".to_owned(),
            mode: Mode::Bold,
            weights: vec![1.0, 2.5],
            names: Vec::new(),
        }
    }
}

const fn spec(name: &'static str, range: Range) -> ParameterSpec {
    ParameterSpec { name, about: "something", range }
}

impl NodeSettings for Settings {
    const NODE: &'static str = "planner";
    const ABOUT: &'static str = "Plans.";
    const PARAMETERS: &'static [ParameterSpec] = &[
        spec("active", Range::Any),
        spec("count", Range::Integer { min: 1, max: 100 }),
        spec("alpha", Range::Float { min: 0.0, max: 1.0 }),
        spec("name", Range::Any),
        spec("mode", Range::Choice(&["very_careful", "bold"])),
        spec("weights", Range::Float { min: -1e300, max: 1e300 }),
        spec("names", Range::Any),
    ];

    fn check(&self) -> Result<(), String> {
        if self.mode == Mode::Bold && self.count == 13 {
            return Err("count 13 is for the very careful only".to_owned());
        }
        Ok(())
    }
}

fn from(args: &[&str]) -> Result<Settings, ParameterError> {
    let args: Vec<String> = args.iter().map(|arg| (*arg).to_owned()).collect();
    Arguments::parse(&args).expect("good arguments").settings()
}

fn refused(args: &[&str]) -> String {
    from(args).expect_err("bad parameters").to_string()
}

/// A parameter file that goes when the test ends.
struct File(std::path::PathBuf);

impl File {
    fn new(name: &str, text: &str) -> File {
        let path = std::env::temp_dir().join(format!("bus-{}-{name}.yaml", std::process::id()));
        std::fs::write(&path, text).expect("a temporary file");
        File(path)
    }

    fn path(&self) -> &str {
        self.0.to_str().expect("a UTF-8 path")
    }
}

impl Drop for File {
    fn drop(&mut self) {
        let _ = std::fs::remove_file(&self.0);
    }
}

#[test]
fn tables_and_fields_agree() {
    check_parameters::<Settings>();
}

#[test]
fn defaults_give_way_to_files_and_files_to_the_command_line() {
    let first = File::new(
        "first",
        "/**:\n  ros__parameters:\n    count: 5\n    alpha: 0.5\n    use_sim_time: true\n\
         planner:\n  ros__parameters:\n    count: 6\n/other/planner:\n  ros__parameters:\n    count: 7\n",
    );
    let second = File::new("second", "/*/planner:\n  ros__parameters: {name: cup}\n");
    let settings = from(&["--ros-args", "--params-file", first.path(), "--params-file", second.path()]);
    let settings = settings.expect("good files");
    assert_eq!((settings.count, settings.alpha, settings.name.as_str()), (6, 0.5, "cup"));
    let settings = from(&["--params-file", first.path(), "-p", "count:=8", "-p", "other:count:=9"]);
    assert_eq!(settings.expect("a good file").count, 8);
    let moved = from(&["--params-file", first.path(), "-r", "__ns:=/other"]);
    assert_eq!(moved.expect("a good file").count, 7);
}

#[test]
fn integers_are_taken_for_doubles_but_not_the_other_way_round() {
    assert_eq!(from(&["-p", "alpha:=1"]).map(|settings| settings.alpha), Ok(1.0));
    assert_eq!(from(&["-p", "weights:=[1, 2]"]).map(|settings| settings.weights), Ok(vec![1.0, 2.0]));
    let text = refused(&["-p", "count:=2.0"]);
    assert!(text.contains("`count`") && text.contains("double 2.0") && text.contains("an integer"), "{text}");
}

#[test]
fn refusals_name_place_parameter_got_and_expected() {
    for (args, words) in [
        (vec!["-p", "alpha:=1.5"], vec!["`-p alpha:=1.5`", "got 1.5", "0.0 to 1.0"]),
        (vec!["-p", "alpha:=.nan"], vec!["alpha", "a finite number"]),
        (vec!["-p", "alpha:=.inf"], vec!["alpha", "a finite number"]),
        (vec!["-p", "count:=0"], vec!["got 0", "1 to 100"]),
        (vec!["-p", "alhpa:=0.5"], vec!["no parameter `alhpa`", "did you mean `alpha`?"]),
        (vec!["-p", "zzzzzzzzzz:=1"], vec!["it has active, count, alpha"]),
        (vec!["-p", "mode:=bolt"], vec!["very_careful, bold", "did you mean `bold`?"]),
        (vec!["-p", "mode:=3"], vec!["integer 3", "one of very_careful, bold"]),
        (vec!["-p", "name:=12"], vec!["integer 12", "a string", "quote it"]),
        (vec!["-p", "active:=1"], vec!["a bool"]),
        (vec!["-p", "weights:=[a]"], vec!["string array", "a list"]),
        (vec!["-p", "count:=13"], vec!["do not fit together", "very careful"]),
        (vec!["--params-file", "/no/such/file"], vec!["/no/such/file", "No such file"]),
    ] {
        let text = refused(&args);
        for word in words {
            assert!(text.contains(word), "{word:?} is not in {text:?}");
        }
        assert!(!text.contains('\n'), "{text:?} has two lines");
    }
}

#[test]
fn files_are_refused_with_their_line() {
    let file = File::new("bad", "planner:\n  ros__parameters:\n    active: true\n    alpha: 3.0\n");
    let error = from(&["--params-file", file.path()]).expect_err("out of range");
    assert!(
        matches!(&error, ParameterError::OutOfRange { place, .. } if matches!(**place, Place::File(_, 4))),
        "{error:?}"
    );
}

#[test]
fn the_bus_takes_its_own_parameters() {
    let args = ["-p", "use_sim_time:=true", "-p", "qos_overrides./x.depth:=1"].map(str::to_owned);
    let arguments = Arguments::parse(&args).expect("good arguments");
    assert!(arguments.settings::<Settings>().is_ok());
    let parameters = BusParameters::from_given(&arguments.given("planner").expect("no files"));
    let parameters = parameters.expect("good values");
    assert!(parameters.use_sim_time);
    assert_eq!(parameters.qos_overrides.len(), 1);
    assert!(refused_bus("service_mapping:=basic").contains("auto, enhanced, cyclone"));
}

fn refused_bus(parameter: &str) -> String {
    let args = ["-p".to_owned(), parameter.to_owned()];
    let arguments = Arguments::parse(&args).expect("good arguments");
    BusParameters::from_given(&arguments.given("planner").expect("no files")).expect_err("a bad value").to_string()
}

#[test]
fn help_shows_every_parameter_with_default_and_range() {
    let Err(ParameterError::Help(text)) = from(&["--help"]) else {
        panic!("no help");
    };
    for word in ["Plans.", "alpha = 0.95", "[0.0 to 1.0]", "mode = \"bold\"", "use_sim_time", "-p active:=true"] {
        assert!(text.contains(word), "{word:?} is not in\n{text}");
    }
}

#[test]
fn floats_keep_a_point_so_that_they_stay_doubles() {
    let settings = Settings { weights: vec![1e300, 1e-7, -0.0, 5e-324, 100.0], ..Settings::default() };
    let text = settings_to_yaml(&settings);
    assert!(text.contains("[1.0e300, 1.0e-7, -0.0, 5.0e-324, 100.0]"), "{text}");
}

proptest! {
    #[test]
    fn settings_survive_the_way_through_yaml_bit_for_bit(
        active: bool,
        count in 1_u64..=12,
        alpha in 0.0..=1.0_f64,
        name in any::<String>(),
        weights in proptest::collection::vec(-1e300..1e300_f64, 0..5),
        names in proptest::collection::vec(any::<String>(), 0..4),
    ) {
        let settings = Settings { active, count, alpha, name, mode: Mode::VeryCareful, weights, names };
        let text = settings_to_yaml(&settings);
        let again = settings_from_yaml::<Settings>(&text);
        prop_assert_eq!(again.map(|again| bits(&again)), Ok(bits(&settings)), "{}", text);
    }

    #[test]
    fn no_value_makes_it_panic(value in ".{0,40}") {
        let args = ["-p".to_owned(), format!("alpha:={value}")];
        if let Ok(arguments) = Arguments::parse(&args) {
            let _ = arguments.settings::<Settings>();
        }
    }
}

/// The settings with their doubles as bits.
fn bits(settings: &Settings) -> (Settings, u64, Vec<u64>) {
    (settings.clone(), settings.alpha.to_bits(), settings.weights.iter().map(|weight| weight.to_bits()).collect())
}
