//! Evidence of all kinds from files, and the posterior's terms it makes.

mod arguments;
mod beta;
mod contradictions;
mod hash;

pub use arguments::EvidenceArguments;

use likelihood::actions::{ActionLikelihood, Choice, ChoiceVerdict, without_duplicates};
use likelihood::preferences::{Answer, AnswerModel, PreferenceLikelihood, Verdict, ranking, time_ordered};
use mdp::Mdp;
use posterior::{EvidenceKind, Rationality, Term, TermLikelihood};

use crate::OfflineError;
use crate::files::{Preferences, Table, Wanted, read_critiques, read_demonstrations, read_mdp, read_orders};

/// Largest magnitude of a feature: beyond it squares overflow.
const MAX_FEATURE: f64 = likelihood::preferences::MAX_VALUE;
/// Difference, in nats, below which trajectories seem about equal to a person who may say so.
const EQUAL_THRESHOLD: f64 = 1.0;
/// Largest probability of "can't tell" of a person who may say so.
const CANT_TELL: f64 = 0.5;

/// All evidence of one command, checked.
#[derive(Debug, Clone)]
pub struct Evidence {
    /// Number k of weights that it is about.
    pub n_features: usize,
    /// Trajectories: rows of k features.
    items: Vec<f64>,
    /// Answers about trajectories and pairs of rankings; `None` without such a file.
    preferences: Option<Vec<Answer>>,
    /// Pairs of attempts of learners.
    progress: Option<Vec<Answer>>,
    mdp: Option<Mdp>,
    /// Actions taken.
    actions: Option<Vec<Choice>>,
    /// Actions judged.
    critiques: Option<Vec<Choice>>,
    answer_model: AnswerModel,
    /// What looks wrong but may be meant.
    warnings: Vec<String>,
    rationality: [Rationality; 4],
}

/// The kinds of evidence that files hold, in the order of the terms.
const KINDS: [EvidenceKind; 4] =
    [EvidenceKind::Actions, EvidenceKind::Preferences, EvidenceKind::Critiques, EvidenceKind::Progress];

impl Evidence {
    /// Reads and checks every file that the arguments name.
    ///
    /// # Errors
    /// The first thing that is wrong.
    pub fn read(arguments: &EvidenceArguments) -> Result<Self, OfflineError> {
        let nothing = [
            &arguments.preferences,
            &arguments.rankings,
            &arguments.progress,
            &arguments.demonstrations,
            &arguments.critiques,
        ]
        .iter()
        .all(|file| file.is_none());
        if nothing {
            return Err(flag(
                "evidence",
                "got none, expected --preferences, --rankings or --progress with --features, or --demonstrations or \
                 --critiques with --mdp",
            ));
        }
        let mut warnings = Vec::new();
        let wanted = Wanted { name: "feature", columns: None, largest: MAX_FEATURE };
        let features = arguments.features.as_ref().map(|path| Table::read(path, &wanted)).transpose()?;
        warnings.extend(features.as_ref().and_then(Table::suspicion));
        let mdp = arguments.mdp.as_ref().map(|path| read_mdp(path)).transpose()?;
        let n_features = n_features(features.as_ref(), mdp.as_ref(), arguments)?;
        let n_items = features.as_ref().map_or(0, Table::n_rows);
        let (preferences, has_verdicts) = preferences(arguments, n_items)?;
        let progress = progress(arguments, n_items)?;
        let (actions, critiques) = match &mdp {
            Some(mdp) => choices(arguments, mdp)?,
            None => (None, None),
        };
        let beta = arguments.beta;
        let evidence = Self {
            n_features,
            items: features.map_or_else(Vec::new, |table| table.values),
            answer_model: answer_model(arguments, preferences.as_deref().unwrap_or_default(), has_verdicts)?,
            preferences,
            progress,
            mdp,
            actions,
            critiques,
            warnings,
            rationality: [
                arguments.beta_actions.unwrap_or(beta),
                arguments.beta_preferences.unwrap_or(beta),
                arguments.beta_critiques.unwrap_or(beta),
                arguments.beta_progress.unwrap_or(beta),
            ],
        };
        Ok(evidence)
    }

    /// The terms of the posterior, one for each kind that there are files of, in the order of [`EvidenceKind::ALL`].
    ///
    /// # Errors
    /// Sizes beyond what a likelihood supports.
    pub fn terms(&self) -> Result<Vec<Term<'_>>, OfflineError> {
        let mut terms = Vec::new();
        for (kind, rationality) in KINDS.into_iter().zip(self.rationality) {
            let likelihood = match kind {
                EvidenceKind::Actions => self.actions_likelihood(self.actions.as_deref())?,
                EvidenceKind::Critiques => self.actions_likelihood(self.critiques.as_deref())?,
                EvidenceKind::Preferences => {
                    self.preference_likelihood(self.preferences.as_deref(), self.answer_model)?
                }
                _ => {
                    // Attempts are ordered by a clock: nobody was asked whether two are about equal.
                    let model = AnswerModel { wrong_rate: self.answer_model.wrong_rate, ..AnswerModel::default() };
                    self.preference_likelihood(self.progress.as_deref(), model)?
                }
            };
            terms.extend(likelihood.map(|likelihood| Term { kind, rationality, likelihood }));
        }
        Ok(terms)
    }

    /// Answers, pairs or actions of every kind that there are files of.
    pub fn counts(&self) -> Vec<(EvidenceKind, usize)> {
        let count = |kind| match kind {
            EvidenceKind::Actions => self.actions.as_ref().map(Vec::len),
            EvidenceKind::Preferences => self.preferences.as_ref().map(Vec::len),
            EvidenceKind::Critiques => self.critiques.as_ref().map(Vec::len),
            EvidenceKind::Progress => self.progress.as_ref().map(Vec::len),
            EvidenceKind::Placements => None,
        };
        KINDS.into_iter().filter_map(|kind| Some((kind, count(kind)?))).collect()
    }

    /// Number of trajectories.
    pub fn n_items(&self) -> usize {
        self.items.len() / self.n_features
    }

    /// Features of one trajectory.
    pub fn item(&self, row: usize) -> Option<&[f64]> {
        self.items.chunks_exact(self.n_features).nth(row)
    }

    /// How answers come about, as it is told with every result.
    pub fn answer_model_json(&self) -> serde_json::Value {
        let model = &self.answer_model;
        serde_json::json!({
            "equal_threshold": model.equal_threshold, "cant_tell": model.cant_tell, "wrong_rate": model.wrong_rate,
        })
    }

    /// β of a kind.
    pub fn rationality(&self, kind: EvidenceKind) -> Rationality {
        let at = KINDS.iter().position(|known| *known == kind).unwrap_or(0);
        self.rationality[at]
    }

    /// Whether an answer says anything else than which is better.
    pub fn has_undecided(&self) -> bool {
        self.preferences.iter().flatten().any(|answer| answer.verdict != Verdict::Strict)
    }

    fn actions_likelihood(&self, choices: Option<&[Choice]>) -> Result<Option<TermLikelihood<'_>>, OfflineError> {
        let (Some(mdp), Some(choices)) = (&self.mdp, choices) else { return Ok(None) };
        let likelihood = ActionLikelihood::new(mdp, choices.to_vec())?.with_wrong_rate(self.answer_model.wrong_rate)?;
        Ok(Some(TermLikelihood::Actions(likelihood)))
    }

    fn preference_likelihood(
        &self,
        answers: Option<&[Answer]>,
        model: AnswerModel,
    ) -> Result<Option<TermLikelihood<'_>>, OfflineError> {
        let Some(answers) = answers else { return Ok(None) };
        let likelihood = PreferenceLikelihood::new(self.n_features, self.items.clone(), answers.to_vec(), model)?;
        Ok(Some(TermLikelihood::Preferences(likelihood)))
    }
}

/// The error of a flag.
pub(crate) fn flag(flag: &str, problem: impl Into<String>) -> OfflineError {
    OfflineError::Flag { flag: flag.to_owned(), problem: problem.into() }
}

fn n_features(
    features: Option<&Table>,
    mdp: Option<&Mdp>,
    arguments: &EvidenceArguments,
) -> Result<usize, OfflineError> {
    match (features, mdp) {
        (Some(table), Some(mdp)) if table.n_columns != mdp.n_features() => Err(OfflineError::Widths {
            file: table.file.clone(),
            what: "features",
            got: table.n_columns,
            other: arguments.mdp.as_ref().map_or_else(String::new, |path| path.display().to_string()),
            expected: mdp.n_features(),
        }),
        (Some(table), _) => Ok(table.n_columns),
        (None, Some(mdp)) => Ok(mdp.n_features()),
        (None, None) => Err(flag("evidence", "got neither --features nor --mdp, expected one of them")),
    }
}

/// Answers and the pairs of rankings; whether the answers have a column of verdicts.
fn preferences(arguments: &EvidenceArguments, n_items: usize) -> Result<(Option<Vec<Answer>>, bool), OfflineError> {
    let (mut answers, mut has_verdicts) = (None, false);
    if let Some(path) = &arguments.preferences {
        let read = Preferences::read(path, n_items)?;
        (answers, has_verdicts) = (Some(read.answers), read.has_verdicts);
    }
    if let Some(path) = &arguments.rankings {
        let answers = answers.get_or_insert_default();
        for order in read_orders(path, n_items)? {
            let strict = |(less, more)| Answer { less, more, factor: 1.0, verdict: Verdict::Strict };
            answers.extend(ranking(&order)?.into_iter().map(strict));
        }
    }
    Ok((answers, has_verdicts))
}

fn progress(arguments: &EvidenceArguments, n_items: usize) -> Result<Option<Vec<Answer>>, OfflineError> {
    let factor = arguments.progress_confidence;
    if !(factor > 0.0 && factor <= 1.0) {
        return Err(flag("--progress-confidence", format!("got {factor}, expected a number above 0 and at most 1")));
    }
    let Some(path) = &arguments.progress else { return Ok(None) };
    let mut answers = Vec::new();
    for order in read_orders(path, n_items)? {
        answers.extend(time_ordered(&order, factor)?);
    }
    Ok(Some(answers))
}

type Choices = Option<Vec<Choice>>;

/// Actions taken, and actions judged, whichever file they stand in.
fn choices(arguments: &EvidenceArguments, mdp: &Mdp) -> Result<(Choices, Choices), OfflineError> {
    let (mut taken, mut judged) = (None, None);
    if let Some(path) = &arguments.demonstrations {
        let (of_taken, of_judged): (Vec<Choice>, Vec<Choice>) =
            read_demonstrations(path, mdp)?.into_iter().partition(|choice| choice.verdict == ChoiceVerdict::Taken);
        taken = Some(of_taken);
        judged = (!of_judged.is_empty()).then_some(of_judged);
    }
    if let Some(path) = &arguments.critiques {
        judged.get_or_insert_default().append(&mut read_critiques(path, mdp)?);
    }
    if arguments.reproduce {
        (taken, judged) = (taken.map(|all| without_duplicates(&all)), judged.map(|all| without_duplicates(&all)));
    }
    Ok((taken, judged))
}

fn answer_model(
    arguments: &EvidenceArguments,
    answers: &[Answer],
    has_verdicts: bool,
) -> Result<AnswerModel, OfflineError> {
    let share = |name: &str, value: f64| match value {
        value if (0.0..1.0).contains(&value) => Ok(value),
        value => Err(flag(name, format!("got {value}, expected a number of at least 0 and below 1"))),
    };
    let said = |verdict| answers.iter().any(|answer| answer.verdict == verdict);
    let equal_threshold = arguments.equal_threshold.unwrap_or(if has_verdicts { EQUAL_THRESHOLD } else { 0.0 });
    if !(0.0..=1e6).contains(&equal_threshold) {
        let problem = format!("got {equal_threshold}, expected a number of at least 0 and at most 1e6");
        return Err(flag("--equal-threshold", problem));
    }
    let cant_tell = arguments.cant_tell.unwrap_or(if said(Verdict::CantTell) { CANT_TELL } else { 0.0 });
    let model = AnswerModel {
        equal_threshold,
        cant_tell: share("--cant-tell", cant_tell)?,
        wrong_rate: share("--wrong-rate", arguments.wrong_rate)?,
    };
    for (name, word, verdict, value) in [
        ("--equal-threshold", "equal", Verdict::Equal, model.equal_threshold),
        ("--cant-tell", "cant-tell", Verdict::CantTell, model.cant_tell),
    ] {
        if value == 0.0 && said(verdict) {
            return Err(flag(name, format!("got 0, expected more: the preferences hold the verdict {word}")));
        }
    }
    Ok(model)
}
