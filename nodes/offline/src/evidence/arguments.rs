//! The flags that name evidence, the same for every command that takes some.

use std::path::PathBuf;

use posterior::Rationality;

use super::beta::parse_beta;

/// Which evidence there is and how it came about.
#[derive(Debug, Clone, clap::Args)]
#[command(next_help_heading = "Evidence: any of these together")]
pub struct EvidenceArguments {
    /// Trajectories, one a row: the sum of the features of their states
    #[arg(long, value_name = "CSV", required_unless_present = "mdp")]
    pub(super) features: Option<PathBuf>,
    /// Answers: less,more[,confidence[,verdict]], rows of --features from 0; confidence: sure, fairly, guess or (0, 1],
    /// a factor on beta; verdict: strict, equal, cant-tell
    #[arg(long, value_name = "CSV", requires = "features")]
    pub(super) preferences: Option<PathBuf>,
    /// Rankings, one a line: rows of --features from worst to best
    #[arg(long, value_name = "CSV", requires = "features")]
    pub(super) rankings: Option<PathBuf>,
    /// Attempts of a learner, a line each learner: rows of --features from first to last, as weak preferences
    #[arg(long, value_name = "CSV", requires = "features")]
    pub(super) progress: Option<PathBuf>,
    /// Decision process in which actions were shown or judged
    #[arg(long, value_name = "JSON")]
    pub(super) mdp: Option<PathBuf>,
    /// Actions shown: state,action[,verdict[,confidence]]; verdict: taken, good, bad
    #[arg(long, value_name = "CSV", requires = "mdp")]
    pub(super) demonstrations: Option<PathBuf>,
    /// Actions judged, state by state of marked segments: state,action,verdict[,confidence]; verdict: good, bad
    #[arg(long, value_name = "CSV", requires = "mdp")]
    pub(super) critiques: Option<PathBuf>,
    /// Count each state-action pair once, as the dissertation's program does; it changes the likelihood
    #[arg(long)]
    pub(super) reproduce: bool,

    /// Rationality of every kind of evidence: a number, or learn[:MEDIAN[:LOG_SD]] with ln beta ~ N(ln MEDIAN, LOG_SD^2),
    /// 10 and 2 unless given
    #[arg(long, value_name = "BETA", default_value = "1", value_parser = parse_beta, help_heading = "How people answer")]
    pub(super) beta: Rationality,
    /// The same for preferences and rankings alone
    #[arg(long, value_name = "BETA", value_parser = parse_beta, help_heading = "How people answer")]
    pub(super) beta_preferences: Option<Rationality>,
    /// The same for demonstrated actions alone
    #[arg(long, value_name = "BETA", value_parser = parse_beta, help_heading = "How people answer")]
    pub(super) beta_actions: Option<Rationality>,
    /// The same for actions judged good or bad alone
    #[arg(long, value_name = "BETA", value_parser = parse_beta, help_heading = "How people answer")]
    pub(super) beta_critiques: Option<Rationality>,
    /// The same for the attempts of learners alone
    #[arg(long, value_name = "BETA", value_parser = parse_beta, help_heading = "How people answer")]
    pub(super) beta_progress: Option<Rationality>,
    /// Factor on beta of the attempts of learners, which seldom get better every time: above 0, at most 1
    #[arg(long, value_name = "FACTOR", default_value_t = 0.5, help_heading = "How people answer")]
    pub(super) progress_confidence: f64,
    /// Share of answers and actions that are given at random: at least 0, below 1
    #[arg(long, value_name = "RATE", default_value_t = 0.0, help_heading = "How people answer")]
    pub(super) wrong_rate: f64,
    /// Difference, in nats, below which two trajectories seem about equal; 0: nobody could say so. Unless given: 1 when
    /// the preferences have verdicts, else 0
    #[arg(long, value_name = "NATS", help_heading = "How people answer")]
    pub(super) equal_threshold: Option<f64>,
    /// Largest probability of "can't tell"; 0: nobody could say so. Unless given: 0.5 when somebody did, else 0
    #[arg(long, value_name = "SHARE", help_heading = "How people answer")]
    pub(super) cant_tell: Option<f64>,
}

impl EvidenceArguments {
    /// Whether the dissertation's program is to be repeated where it departs from its text.
    pub fn reproduce(&self) -> bool {
        self.reproduce
    }
}
