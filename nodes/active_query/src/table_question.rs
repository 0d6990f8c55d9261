//! What is asked about tables: on which of the imagined ones, and whether where the target belongs there or in which of two places.

use crate::reach::{Reach, is_in_reach};
use crate::settings::{Settings, Strategy, TableQuestionKind};
use crate::table_draws::DrawnRewards;
use inquiry::table::{placement_comparison, sampled_placement_answers};
use inquiry::{Answers, Effort, InquiryError, Judged, reward_information};
use likelihood::preferences::AnswerModel;
use mdp::random::{index, uniform};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use scene::{Field, Grid, Point, Rbf, Scene, best_placement};

/// Answers drawn for each table.
const ANSWERS: usize = 24;
/// Points a side of the grid on which densities are normalised, and places looked for.
const GRID_SIDE: usize = 24;
/// Draws whose favourite places are offered against each other.
const TASTES: usize = 8;
/// Places that are nearer to each other look the same to a person.
const APART_M: f64 = 0.03;
/// Pairs drawn before a table is taken to have no room for two places.
const TRIES: usize = 100;
/// Keeps these random numbers apart from those of the imagined tables.
const OWN_STREAM: u64 = 1 << 63;

/// Something that can be asked about a table.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Subject {
    /// Which.
    pub table: usize,
    /// In which of these the target is better; `None`: where it belongs. Normalised coordinates; the first is called A.
    pub places: Option<[Point; 2]>,
    /// Nats, where it was chosen by information; also per second.
    pub gain: Option<[f64; 2]>,
    /// Drawn at random to be held out.
    pub is_held_out: bool,
}

impl Subject {
    /// Where the target belongs on a table.
    pub fn plain(table: usize) -> Self {
        Self { table, places: None, gain: None, is_held_out: false }
    }
}

/// What a question is chosen from.
pub(crate) struct Tables<'a> {
    /// The imagined ones, then that of the lesson.
    pub scenes: &'a [Scene],
    /// What the arm reaches; `None`: wherever that is, it may be asked about.
    pub reach: Option<&'a Reach>,
    pub judged: &'a [Judged],
    /// The one to ask about by its bound.
    pub largest: usize,
    /// Whether anything was said yet.
    pub is_taught_anything: bool,
    /// Whether only a question drawn at random is wanted.
    pub must_confirm: bool,
    pub revision: u64,
}

/// The question of the strategy; none where no kind of question about a table may be asked. A function of its arguments alone.
///
/// # Errors
/// In a sentence: draws that are needed and cannot be used, or are not about the tables.
pub(crate) fn subject(
    settings: &Settings,
    draws: &Result<DrawnRewards, String>,
    tables: &Tables<'_>,
) -> Result<Option<Subject>, String> {
    let may = |kind| settings.table_question_kinds.contains(&kind);
    let (where_, which) = (may(TableQuestionKind::Placement), may(TableQuestionKind::Comparison));
    let mut rng = ChaCha8Rng::seed_from_u64(settings.seed.unsigned_abs());
    rng.set_stream(OWN_STREAM | tables.revision);
    let n_imagined = tables.scenes.len() - 1;
    let possible: Vec<usize> = (0..n_imagined).filter(|&i| !tables.judged[i].point_estimate_m.is_nan()).collect();
    let is_lot = settings.hold_out_share > 0.0 && uniform(&mut rng) < settings.hold_out_share;
    if which && tables.is_taught_anything && (is_lot || tables.must_confirm) {
        let table = if possible.is_empty() { n_imagined } else { possible[index(possible.len(), &mut rng)] };
        if let Some(places) = any_two(&tables.scenes[table], tables.reach, &mut rng) {
            return Ok(Some(Subject { table, places: Some(places), gain: None, is_held_out: true }));
        }
    }
    let most_telling = |of: &[usize], kinds, rng: &mut ChaCha8Rng| {
        let asking =
            Asking { draws: draws.as_ref().map_err(Clone::clone)?, scenes: tables.scenes, reach: tables.reach };
        asking.best(of, kinds, rng).map_err(|error| error.to_string())
    };
    // The table of the lesson comes only when no imagined one is worth asking about, and before anything was said.
    let is_open = tables.is_taught_anything && tables.largest < n_imagined && possible.len() > 1;
    let strategy = if is_open { settings.strategy } else { Strategy::Var };
    let found = match strategy {
        Strategy::Var if where_ => Some(Subject::plain(tables.largest)),
        Strategy::Var if which => most_telling(&[tables.largest], [false, true], &mut rng)?,
        Strategy::Random if where_ || which => {
            let table = possible[index(possible.len(), &mut rng)];
            let wants_two = which && (!where_ || uniform(&mut rng) < 0.5);
            let places = wants_two.then(|| any_two(&tables.scenes[table], tables.reach, &mut rng)).flatten();
            (places.is_some() || where_).then(|| Subject { places, ..Subject::plain(table) })
        }
        Strategy::Var | Strategy::Random => None,
        Strategy::Information | Strategy::Entropy | Strategy::RewardInformation | Strategy::LookAhead => {
            most_telling(&possible, [where_, which], &mut rng)?
        }
    };
    // Where the rewards like the same place best, other places may still tell them apart: the lesson goes on until the bound is small.
    let any = || any_two(&tables.scenes[tables.largest], tables.reach, &mut rng);
    let anyhow =
        || which.then(any).flatten().map(|places| Subject { places: Some(places), ..Subject::plain(tables.largest) });
    Ok(found.or_else(anyhow))
}

struct Asking<'a> {
    draws: &'a DrawnRewards,
    scenes: &'a [Scene],
    reach: Option<&'a Reach>,
}

impl Asking<'_> {
    /// The question whose answer is expected to tell most about the reward for each second of the person's time, the first of equals.
    fn best(
        &self,
        tables: &[usize],
        [where_, which]: [bool; 2],
        rng: &mut ChaCha8Rng,
    ) -> Result<Option<Subject>, InquiryError> {
        let belief = self.draws.belief()?;
        let effort = Effort::default();
        let mut best: Option<Subject> = None;
        let mut consider = |table, places: Option<[Point; 2]>, answers: &Answers| -> Result<(), InquiryError> {
            let gain = reward_information(answers, &belief)?;
            let seconds = if places.is_some() { effort.comparison_s } else { effort.placement_s };
            let per_second = gain / seconds;
            if best.as_ref().and_then(|best| best.gain).is_none_or(|[_, most]| per_second > most) {
                best = Some(Subject { table, places, gain: Some([gain, per_second]), is_held_out: false });
            }
            Ok(())
        };
        for &table in tables {
            let scene = &self.scenes[table];
            if where_ {
                let placing = self.draws.placing();
                let answers = sampled_placement_answers(scene, &placing, &belief, ANSWERS, GRID_SIDE, rng)?;
                if let Some(answers) = answers {
                    consider(table, None, &answers)?;
                }
            }
            let pairs = if which { self.favourites(scene) } else { Vec::new() };
            let (betas_and, wrong_rate) = (self.draws.comparing(), self.draws.comparisons.1);
            let model = AnswerModel { wrong_rate, ..AnswerModel::default() };
            for [first, second] in pairs {
                let answers = placement_comparison(scene, &betas_and, first, second, &model)?;
                consider(table, Some([first, second]), &answers)?;
            }
        }
        // Which is called A says nothing about which the robot would choose.
        if let Some(places) = best.as_mut().and_then(|best| best.places.as_mut())
            && uniform(rng) < 0.5
        {
            places.reverse();
        }
        Ok(best)
    }

    /// Pairs of places that some of the draws like best each, so that an answer tells between them.
    fn favourites(&self, scene: &Scene) -> Vec<[Point; 2]> {
        let rbf = Rbf::new(scene);
        let field = Field::new(&rbf, &Grid::midpoints(GRID_SIDE), Some(scene));
        let (n, mut scratch) = (self.draws.n(), Vec::new());
        let mut places: Vec<Point> = Vec::new();
        for taste in 0..TASTES.min(n) {
            let w = self.draws.of(taste * n / TASTES.min(n));
            let Some(best) = best_placement(scene, &rbf, &field, w, &mut scratch) else { break };
            if is_in_reach(self.reach, best.at) && places.iter().all(|known| are_apart(scene, *known, best.at)) {
                places.push(best.at);
            }
        }
        let pairs = |first: usize| places[first + 1..].iter().map(move |second| (first, *second));
        (0..places.len()).flat_map(pairs).map(|(first, second)| [places[first], second]).collect()
    }
}

/// Two free places in reach, drawn uniformly; none where there is no room for two.
fn any_two(scene: &Scene, reach: Option<&Reach>, rng: &mut ChaCha8Rng) -> Option<[Point; 2]> {
    let rbf = Rbf::new(scene);
    let field = Field::new(&rbf, &Grid::midpoints(GRID_SIDE), Some(scene));
    let free: Vec<usize> = (0..field.grid().n())
        .filter(|cell| field.free()[*cell] && is_in_reach(reach, field.grid().at(*cell)))
        .collect();
    if free.len() < 2 {
        return None;
    }
    let mut any = || field.grid().at(free[index(free.len(), rng)]);
    (0..TRIES).map(|_| [any(), any()]).find(|[first, second]| are_apart(scene, *first, *second))
}

fn are_apart(scene: &Scene, first: Point, second: Point) -> bool {
    scene.metres(first).distance(scene.metres(second)) >= APART_M
}
