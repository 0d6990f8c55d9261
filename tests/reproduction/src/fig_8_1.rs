//! Figure 8.1: the first two questions of action entropy and of ActiveVaR in a grid of four colours.

use crate::chapter8::{ACTIVE_VAR, AS, BETA, Learner, Method, Teacher, heat_maps};
use crate::harness::plot::{Content, Picture};
use crate::harness::{Claim, Options, Outcome, ReproductionError, TextTable, replicates, to_value};
use inquiry::tabular::{Answering, state_losses};
use inquiry::{Belief, DrawnOptima, Question, QuestionKind, Round, scores};
use likelihood::actions::Choice;
use mdp::Mdp;
use mdp::worlds::{GridWorld, RIGHT};
use posterior::Run;

/// Runs with other chains.
const REPLICATES: usize = 20;
/// The grid of the author's program: white, yellow, green, blue.
const CELLS: [usize; 25] = [
    0, 0, 0, 3, 0, //
    0, 0, 2, 3, 0, //
    0, 0, 0, 3, 0, //
    1, 1, 0, 3, 0, //
    0, 0, 0, 3, 0,
];
/// Cells of a row.
const COLUMNS: usize = 5;
/// Colours, as features.
const WHITE: usize = 0;
const YELLOW: usize = 1;
const GREEN: usize = 2;
const BLUE: usize = 3;
/// What the person wants, of each colour.
const WEIGHTS: [f64; 4] = [-0.05, -0.25, 0.5, -0.2];
/// The white cell from which the demonstration goes right, into the green one.
const SHOWN_FROM: usize = 6;

/// The two first questions of a method, with the scores of all cells it may ask about.
#[derive(Debug, Clone, serde::Serialize)]
pub struct Asked {
    /// Cells.
    pub cells: [usize; 2],
    /// Score of every cell before each question; null where nothing starts.
    pub scores: [Vec<Option<f64>>; 2],
}

/// Makes the figure.
///
/// # Errors
/// Too few replicates.
pub fn run(options: &Options) -> Result<Outcome, ReproductionError> {
    let n = options.count(REPLICATES)?;
    let mdp = world()?;
    let teacher = Teacher::new(&mdp, &WEIGHTS);
    let of = |replicate: usize| -> Result<[Asked; 2], ReproductionError> {
        let run = Run { n_draws: 1000, n_chains: 4, warmup: 200, threads: 1 };
        let learner = Learner { mdp: &mdp, run, seed: options.seed, replicate, beta: BETA };
        Ok([ask(&learner, &teacher, &AS)?, ask(&learner, &teacher, &ACTIVE_VAR)?])
    };
    let all = replicates("chains", n, options.threads, of)?;
    let count = |test: &dyn Fn(&[Asked; 2]) -> bool| all.iter().filter(|asked| test(asked)).count();
    let most = |held: usize| 2 * held > n;
    let bottom_right = CELLS.len() - 1;
    let both_first = count(&|[entropy, risk]| entropy.cells[0] == bottom_right && risk.cells[0] == bottom_right);
    let risk_yellow = count(&|[_, risk]| beside(risk.cells[1], YELLOW));
    let entropy_blue = count(&|[entropy, _]| beside(entropy.cells[1], BLUE));
    let right = |cell: usize| cell % COLUMNS == COLUMNS - 1;
    let entropy_right = count(&|[entropy, _]| right(entropy.cells[0]) && right(entropy.cells[1]));
    let risk_right = count(&|[_, risk]| right(risk.cells[0]) && right(risk.cells[1]));
    let said = |held: usize| format!("{held} of {n} runs");
    let mut table = TextTable::new(
        "Cells asked about (row, column from the top left), first run, and how often in all runs",
        &["method", "first", "second", "first in", "second in"],
    );
    for (i, method) in [AS, ACTIVE_VAR].iter().enumerate() {
        let of_first = all[0][i].cells;
        let often = |q: usize| said(all.iter().filter(|asked| asked[i].cells[q] == of_first[q]).count());
        let place = |cell: usize| format!("({}, {})", cell / COLUMNS, cell % COLUMNS);
        table.row(method.label, [place(of_first[0]), place(of_first[1]), often(0), often(1)]);
    }
    let maps = [AS, ACTIVE_VAR].iter().zip(&all[0]).flat_map(|(method, asked)| {
        [0, 1].map(|q| (format!("{}, question {}", method.label, q + 1), asked.scores[q].clone(), asked.cells[q]))
    });
    Ok(Outcome {
        name: "fig-8.1",
        title: "The first two action queries by entropy and by value at risk",
        replicates: n,
        seed: options.seed,
        notes: vec![
            "The grid is that of the author's program; only the picture is printed. White cells are starts, green ends; γ = .95; β = 100. The true weights are ours: white −.05, yellow −.25, green .5, blue −.2.".into(),
            "Scores are drawn from 0 (white) to their largest (dark).".into(),
        ],
        tables: vec![table],
        claims: vec![
            Claim::matched("both ask about the bottom right cell first, in most runs", most(both_first), said(both_first)),
            Claim::matched("AS asks second beside a blue cell, in most runs", most(entropy_blue), said(entropy_blue)),
            Claim::matched("ActiveVaR asks second beside a yellow cell, in most runs", most(risk_yellow), said(risk_yellow)),
            Claim::matched(
                "AS spends both questions on the right, where blue cannot be avoided, in most runs, ActiveVaR in fewer than half",
                most(entropy_right) && !most(risk_right),
                format!("{} and {}", said(entropy_right), said(risk_right)),
            ),
        ],
        picture: Picture {
            title: "Figure 8.1: where to ask".into(),
            content: Content::Drawn(heat_maps(&maps.collect::<Vec<_>>(), &CELLS, COLUMNS)),
        },
        data: to_value(&all),
    })
}

/// The grid: deterministic moves, every white cell a start.
fn world() -> Result<Mdp, ReproductionError> {
    let starts = (0..CELLS.len()).filter(|&cell| CELLS[cell] == WHITE).collect();
    let terminals = (0..CELLS.len()).filter(|&cell| CELLS[cell] == GREEN).collect();
    let grid = GridWorld { starts, terminals, gamma: 0.95, ..GridWorld::one_hot(5, COLUMNS, &CELLS, WEIGHTS.len()) };
    Ok(grid.mdp()?)
}

/// Asks two questions about starts.
fn ask(learner: &Learner<'_>, teacher: &Teacher<'_>, method: &Method) -> Result<Asked, ReproductionError> {
    let mdp = learner.mdp;
    let starts: Vec<usize> = (0..mdp.n_states()).filter(|&state| mdp.initial()[state] > 0.0).collect();
    let mut evidence = vec![Choice::taken(SHOWN_FROM, RIGHT)];
    let (mut cells, mut all) = ([0; 2], [vec![], vec![]]);
    for question in 0..2 {
        let draws = learner.learn(&evidence, question, None)?;
        let optima = DrawnOptima::new(mdp, &draws.values, 1)?;
        let answering = Answering { mdp, optima: &optima, betas: &[learner.beta], wrong_rate: 0.0 };
        let judged = |(situation, &state): (usize, &usize)| -> Result<Question, ReproductionError> {
            let answers = answering.action(state)?;
            Ok(Question { kind: QuestionKind::Action, situation, answers, feasible: true })
        };
        // As published: the most likely draw stands in for the MAP weights.
        let likely = &draws.log_likelihood;
        let best = (0..likely.len()).fold(0, |best, i| if likely[i] > likely[best] { i } else { best });
        let policy = learner.policy(draws.weights(best));
        let round = Round {
            belief: Belief::equal(optima.n())?,
            losses: state_losses(mdp, &optima, &policy, &starts)?,
            questions: starts.iter().enumerate().map(judged).collect::<Result<_, _>>()?,
            alternatives: None,
        };
        let scores = scores(&round, &round.belief, method.strategy)?;
        let best = (0..scores.len()).fold(0, |best, i| if scores[i] > scores[best] { i } else { best });
        cells[question] = starts[best];
        let of = |cell: usize| starts.iter().position(|start| *start == cell).map(|i| scores[i]);
        all[question] = (0..mdp.n_states()).map(of).collect();
        evidence.push(Choice::taken(starts[best], teacher.action(starts[best])));
    }
    Ok(Asked { cells, scores: all })
}

/// Whether a cell has a neighbour of a colour.
fn beside(cell: usize, colour: usize) -> bool {
    let (row, column) = (cell / COLUMNS, cell % COLUMNS);
    let near = |other: usize| {
        let (other_row, other_column) = (other / COLUMNS, other % COLUMNS);
        row.abs_diff(other_row) + column.abs_diff(other_column) == 1
    };
    (0..CELLS.len()).any(|other| CELLS[other] == colour && near(other))
}
