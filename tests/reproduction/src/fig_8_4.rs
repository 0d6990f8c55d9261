//! Figure 8.4: what is asked on a highway after more and more driving has been shown.

use crate::chapter8::compare::{curve_table, differences, fifth_fewer, match_order};
use crate::chapter8::{ACTIVE_VAR, Ask, Course, Learner, OURS, RANDOM, Step, Teacher, curve_panel, hold, purpose};
use crate::chapter8::{Curve, Method};
use crate::harness::plot::{Content, Panel, Picture, Series, Style};
use crate::harness::{
    Claim, Estimate, Options, Outcome, ReproductionError, TextTable, bootstrap_interval, generator, replicates,
    to_value,
};
use inquiry::tabular::Over;
use likelihood::actions::Choice;
use mdp::random::index;
use mdp::worlds::driving;
use mdp::{Mdp, Policy, occupancy, rollout};
use posterior::Run;
use serde::Serialize;
use serde_json::json;

/// Drivers.
const REPLICATES: usize = 50;
/// Steps of driving that are shown before a question.
const SHOWN: [usize; 5] = [2, 10, 30, 100, 300];
/// States drawn as candidates, as the dissertation samples them.
const SAMPLED: usize = 50;
/// Questions of a lesson.
const QUESTIONS: usize = 8;
/// Steps shown before the first of them.
const FIRST: usize = 2;
/// β that is taken for granted of a driver who never errs.
const BETA: f64 = 50.0;
/// Methods, in order.
const METHODS: [Method; 3] = [RANDOM, ACTIVE_VAR, OURS];

/// What was found with one driver.
#[derive(Debug, Clone, Serialize)]
struct Drive {
    /// State with the largest VaR after each amount of driving.
    asked: Vec<usize>,
    /// How often the driver is in it, as a share of the mean over the sampled states.
    frequency: Vec<f64>,
    /// Lessons of each method.
    lessons: Vec<Vec<Step>>,
}

/// Makes the figure.
///
/// # Errors
/// Too few replicates.
pub fn run(options: &Options) -> Result<Outcome, ReproductionError> {
    let n = options.count(REPLICATES)?;
    let mdp = everywhere()?;
    let drives = replicates("drivers", n, options.threads, |replicate| drive(&mdp, options.seed, replicate))?;
    let curves: Vec<Curve> = METHODS
        .iter()
        .enumerate()
        .map(|(i, method)| {
            let lesson = |drive: &Drive| drive.lessons[i].iter().map(|step| step.loss).collect();
            Curve { method: *method, lessons: drives.iter().map(lesson).collect() }
        })
        .collect();
    let frequency: Vec<Vec<f64>> =
        (0..SHOWN.len()).map(|i| drives.iter().map(|drive| drive.frequency[i]).collect()).collect();
    let falls: Vec<f64> =
        frequency[SHOWN.len() - 1].iter().zip(&frequency[0]).map(|(last, first)| last - first).collect();
    let [low, high] = bootstrap_interval(&falls, options.seed);
    let mut asked = TextTable::new(
        "What ActiveVaR asks about after so many steps of driving: how often the driver is there (1: as in the mean state), and the commonest question",
        &["steps shown", "how often there", "commonest question", "asked by"],
    );
    for (i, shown) in SHOWN.iter().enumerate() {
        let (state, count) = commonest(drives.iter().map(|drive| drive.asked[i]));
        asked.row(shown.to_string(), [Estimate::of(&frequency[i]).text(), words(state), format!("{count} of {n}")]);
    }
    let [random, risk, ours] = [0, 1, 2].map(|i| &curves[i]);
    let claims = vec![
        Claim::matched(
            "with more driving shown, questions are about states where the driver is less often",
            high < 0.0,
            format!(
                "from {} to {} steps: {:+.3} [{low:+.3}, {high:+.3}]",
                SHOWN[0],
                SHOWN[SHOWN.len() - 1],
                falls.iter().fold(0.0, |s, x| s + x) / n as f64
            ),
        ),
        match_order(risk, random, QUESTIONS, options.seed),
        Claim::smaller(
            format!("ours loses less than ActiveVaR, mean over {QUESTIONS} questions"),
            &differences(ours, risk, QUESTIONS),
            options.seed,
        ),
        fifth_fewer(ours, risk, QUESTIONS - 3, options.seed),
    ];
    let points = frequency.iter().enumerate().map(|(i, f)| {
        let estimate = Estimate::of(f);
        (i, estimate.mean, estimate.standard_error)
    });
    let series = Series { label: "asked by ActiveVaR".into(), colour: 1, style: Style::Best, points: points.collect() };
    Ok(Outcome {
        name: "fig-8.4",
        title: "Action queries on a highway",
        replicates: n,
        seed: options.seed,
        notes: vec![
            "The dissertation's driver is its author at the keyboard, and no true reward is known; here a driver who avoids collisions and the roadside stands in, so losses can be told. The road is that of chapter 4 (105 states).".into(),
            format!("{SAMPLED} states are sampled, and only those are asked about (section 8.2.3). Lessons begin after {FIRST} steps of driving; losses are means over all states."),
        ],
        tables: vec![asked, curve_table("True loss of the MAP policy, mean over states, after so many answers", &curves, &[0, 1, 2, 3, 5, QUESTIONS])],
        claims,
        picture: Picture {
            title: "Figure 8.4: questions on a highway".into(),
            content: Content::Panels(vec![
                Panel {
                    x: "steps of driving shown".into(),
                    y: "how often the driver is in the state asked about".into(),
                    places: SHOWN.iter().map(usize::to_string).collect(),
                    range: [0.0, 1.0],
                    logarithmic: false,
                    levels: vec![1.0],
                    series: vec![series],
                },
                curve_panel(&curves, "questions answered", "loss of the MAP policy"),
            ]),
        },
        data: json!({ "shown": SHOWN, "drives": to_value(&drives) }),
    })
}

/// The road with every state a start: what the robot must cope with.
fn everywhere() -> Result<Mdp, ReproductionError> {
    let mut parts = driving::world().parts();
    parts.initial = vec![1.0 / parts.n_states as f64; parts.n_states];
    Ok(Mdp::new(parts)?)
}

fn drive(mdp: &Mdp, seed: u64, replicate: usize) -> Result<Drive, ReproductionError> {
    let road = driving::world();
    let teacher = Teacher::new(mdp, &driving::SAFE);
    let driver = driving::driver(&road, &driving::SAFE);
    let mut rng = generator(seed, replicate, purpose::SHOWN);
    // The road goes on for ever, so one drive is long enough for all amounts.
    let start = road.initial().iter().position(|p| *p > 0.0).unwrap_or(0);
    let whole = rollout(&road, &driver, start, SHOWN[SHOWN.len() - 1], &mut rng)?;
    let mut states: Vec<usize> = Vec::new();
    while states.len() < SAMPLED {
        let state = index(mdp.n_states(), &mut rng);
        if !states.contains(&state) {
            states.push(state);
        }
    }
    let visits = visits(&road, &driver)?;
    let mean = states.iter().map(|state| visits[*state]).fold(0.0, |sum, x| sum + x) / SAMPLED as f64;
    let run = Run { n_draws: 400, n_chains: 4, warmup: 150, threads: 1 };
    let learner = Learner { mdp, run, seed, replicate, beta: BETA };
    let course = |shown: &'_ [Choice], n_questions| Course {
        learner: learner.clone(),
        teacher: &teacher,
        shown: shown.to_vec(),
        states: states.clone(),
        ask: Ask::Actions,
        n_questions,
        enough: 0.0,
        over: Over::Starts,
    };
    let (mut asked, mut frequency) = (Vec::new(), Vec::new());
    for n in SHOWN {
        let shown = choices(&whole[..n]);
        let first = learner.learn(&shown, 0, None)?;
        let steps = hold(&course(&shown, 1), &ACTIVE_VAR, &first)?;
        let state = steps[0].asked.unwrap_or(states[0]);
        asked.push(state);
        frequency.push(visits[state] / mean);
    }
    let shown = choices(&whole[..FIRST]);
    let first = learner.learn(&shown, 0, None)?;
    let course = course(&shown, QUESTIONS);
    let lessons = METHODS.iter().map(|method| hold(&course, method, &first)).collect::<Result<_, _>>()?;
    Ok(Drive { asked, frequency, lessons })
}

fn choices(driven: &[(usize, usize)]) -> Vec<Choice> {
    driven.iter().map(|&(state, action)| Choice::taken(state, action)).collect()
}

/// Discounted visits of every state.
fn visits(road: &Mdp, driver: &Policy) -> Result<Vec<f64>, ReproductionError> {
    let occupancy = occupancy(road, driver)?;
    Ok(occupancy.chunks(road.n_actions()).map(|row| row.iter().fold(0.0, |sum, x| sum + x)).collect())
}

/// The state that occurs most often, the smallest of equals, and how often.
fn commonest(states: impl Iterator<Item = usize>) -> (usize, usize) {
    let mut counts = vec![0; driving::N_STATES];
    states.for_each(|state| counts[state] += 1);
    let best = (0..counts.len()).fold(0, |best, i| if counts[i] > counts[best] { i } else { best });
    (best, counts[best])
}

/// A state in words.
fn words(state: usize) -> String {
    const LANES: [&str; driving::N_LANES] =
        ["off the road left", "left lane", "centre lane", "right lane", "off the road right"];
    let (lane, rest) = (state / (3 * driving::N_PLACES), state % (3 * driving::N_PLACES));
    let (traffic, place) = (rest / driving::N_PLACES, rest % driving::N_PLACES);
    let place = match place {
        0..=1 => format!("{} steps ahead", 3 - place),
        2 => "one step ahead".into(),
        3..=5 => "alongside".into(),
        _ => "behind".into(),
    };
    format!("{}, traffic in the {} {place}", LANES[lane], LANES[traffic + 1])
}
