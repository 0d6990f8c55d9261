//! Parameters of the node.

use bus::{NodeSettings, ParameterSpec, Range};
use serde::{Deserialize, Serialize};

/// By what a question is chosen: a table among the imagined ones, or what to ask about a world. The lesson ends by the bounds,
/// whatever is asked.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Strategy {
    /// The largest bound on the loss (dissertation section 8.2.4); in a world the largest value at risk (eq. 8.2).
    #[default]
    Var,
    /// The answer that is expected to tell most about the reward; in a world, per second of the person's time, about whether the
    /// policy loses more than `epsilon_loss`.
    Information,
    /// Any.
    Random,
    /// In a world, AS: the state in which the rewards that fit disagree most about what to do (Lopes et al. 2009).
    Entropy,
    /// In a world, ARC: the answer that is expected to tell most about the reward per second (Cui and Niekum 2018).
    RewardInformation,
    /// In a world, the answer that is expected to bring the value at risk down most per second, the robot having taken up what is then best.
    LookAhead,
}

/// What may be asked about a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum TableQuestionKind {
    /// Where the target belongs (section 8.2.4).
    Placement,
    /// In which of two places it is better.
    Comparison,
}

/// What may be asked about a world.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum QuestionKind {
    /// What to do in a state (dissertation Algorithm 5).
    Action,
    /// What is good and what is bad in a way of the MAP policy (Algorithm 6).
    Critique,
    /// Which of two ways is better.
    Comparison,
}

/// Parameters of `active_query`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Settings {
    /// Seed of the hypothetical tables.
    pub seed: i64,
    /// The lesson ends when the bound is below this, metres.
    pub epsilon_m: f64,
    /// A lesson about a world ends when the bound on the normalised loss of the robot's policy is below this.
    pub epsilon_loss: f64,
    /// Hypothetical tables a question is chosen from.
    pub n_candidates: i64,
    /// By what one of them is chosen.
    pub strategy: Strategy,
    /// Whether tables are asked about only where the arm could put the target, which the planner has to tell.
    pub only_reachable: bool,
    /// What may be asked about a table; nothing: the lesson takes what it is given.
    pub table_question_kinds: Vec<TableQuestionKind>,
    /// What may be asked about a world; nothing: the lesson takes what it is given.
    pub question_kinds: Vec<QuestionKind>,
    /// Steps of the ways that questions about a world show, at most.
    pub trajectory_steps: i64,
    /// Share of the questions that are drawn at random, whatever the strategy; about a table these ask which of two places is better.
    pub hold_out_share: f64,
    /// Level at which answers that do not fit end a lesson; 0: none do.
    pub misfit_level: f64,
    /// Share of surprises among answers to random questions that is still tolerable: a lesson is not taught before they show that there
    /// are no more; 1: they need not.
    pub most_surprises: f64,
    /// Nats per second of the person's time that a question must promise; 0: none is too small.
    pub least_gain_per_second: f64,
    /// Questions after which the lesson is given up.
    pub max_questions: i64,
    /// After so many seconds a question about a world is asked that does not know of the newest answer; 0: never.
    pub next_within_s: f64,
    /// So many of them, at most, one after the other.
    pub questions_ahead: i64,
    /// Whether nothing is asked before the person says start.
    pub wait_for_start: bool,
    /// How often the pending question and the lesson's state are sent again, seconds.
    pub republish_period_s: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            seed: 1,
            epsilon_m: 0.10,
            epsilon_loss: 0.10,
            n_candidates: 50,
            strategy: Strategy::Var,
            only_reachable: false,
            table_question_kinds: vec![TableQuestionKind::Placement, TableQuestionKind::Comparison],
            question_kinds: vec![QuestionKind::Action, QuestionKind::Critique, QuestionKind::Comparison],
            trajectory_steps: 8,
            hold_out_share: 0.1,
            misfit_level: 0.002,
            most_surprises: 1.0,
            least_gain_per_second: 0.0,
            max_questions: 60,
            next_within_s: 1.0,
            questions_ahead: 3,
            wait_for_start: false,
            republish_period_s: 2.0,
        }
    }
}

impl NodeSettings for Settings {
    const NODE: &'static str = "active_query";
    const ABOUT: &'static str = "Asks the question that removes most of the risk, or says that the robot is taught";
    const PARAMETERS: &'static [ParameterSpec] = &[
        ParameterSpec {
            name: "seed",
            about: "seed of the hypothetical tables",
            range: Range::Integer { min: 0, max: i64::MAX },
        },
        ParameterSpec {
            name: "epsilon_m",
            about: "the lesson ends when the bound on the placement error is below this, metres",
            range: Range::Float { min: 0.001, max: 10.0 },
        },
        ParameterSpec {
            name: "epsilon_loss",
            about: "a lesson about a world ends when the bound on what the robot's policy loses, as a share of what choosing at \
                    random loses, is below this",
            range: Range::Float { min: 0.001, max: 1.0 },
        },
        ParameterSpec {
            name: "n_candidates",
            about: "hypothetical tables a question is chosen from",
            range: Range::Integer { min: 1, max: 1000 },
        },
        ParameterSpec {
            name: "strategy",
            about: "by what a question is chosen: the largest risk, the answer that tells most of whether the risk is too large, or at \
                    random; in a world also where the rewards that fit disagree most (AS), what tells most of the reward (ARC), or \
                    what brings the risk down most; about a table these three choose as information does, and var asks where where it may",
            range: Range::Choice(&["var", "information", "random", "entropy", "reward_information", "look_ahead"]),
        },
        ParameterSpec {
            name: "only_reachable",
            about: "whether only tables and places are asked about where the arm could put the target; nothing is asked before \
                    placement_planner has told what it reaches",
            range: Range::Any,
        },
        ParameterSpec {
            name: "table_question_kinds",
            about: "what may be asked about a table: placement (where), comparison (which of two places); empty: nothing is asked",
            range: Range::Any,
        },
        ParameterSpec {
            name: "question_kinds",
            about: "what may be asked about a world: action, critique, comparison; empty: nothing is asked",
            range: Range::Any,
        },
        ParameterSpec {
            name: "trajectory_steps",
            about: "steps of the ways that questions about a world show, at most",
            range: Range::Integer { min: 2, max: 12 },
        },
        ParameterSpec {
            name: "hold_out_share",
            about: "share of the questions that are drawn at random, whatever the strategy: a check of the model; about a table these \
                    ask which of two places is better",
            range: Range::Float { min: 0.0, max: 0.9 },
        },
        ParameterSpec {
            name: "misfit_level",
            about: "the lesson ends when answers as odd as those given are less probable than this under the rewards that fit, or \
                    surprises among the answers to random questions are; 0: never",
            range: Range::Float { min: 0.0, max: 0.5 },
        },
        ParameterSpec {
            name: "most_surprises",
            about: "a lesson whose bound is good goes on with random questions until they show, with the confidence of the \
                    bound, that no larger share of the answers are surprises; 1: they need not (.4 takes 6 answers without a surprise)",
            range: Range::Float { min: 0.01, max: 1.0 },
        },
        ParameterSpec {
            name: "least_gain_per_second",
            about: "a lesson is given up when the best question is expected to tell less than this for each second of the \
                    person's time, nats, where it is chosen by that",
            range: Range::Float { min: 0.0, max: 100.0 },
        },
        ParameterSpec {
            name: "max_questions",
            about: "questions, or pieces of evidence about a world, after which the lesson is given up",
            range: Range::Integer { min: 1, max: 10_000 },
        },
        ParameterSpec {
            name: "next_within_s",
            about: "when the next question about a world takes longer than this after an answer, one is asked that was chosen before \
                    and does not know of that answer, seconds; 0: the person waits",
            range: Range::Float { min: 0.0, max: 3600.0 },
        },
        ParameterSpec {
            name: "questions_ahead",
            about: "how many such questions are asked one after the other, at most",
            range: Range::Integer { min: 0, max: 16 },
        },
        ParameterSpec {
            name: "wait_for_start",
            about: "whether nothing is asked before the person says start",
            range: Range::Any,
        },
        ParameterSpec {
            name: "republish_period_s",
            about: "how often the pending question and the state of the lesson are sent again, seconds",
            range: Range::Float { min: 0.1, max: 3600.0 },
        },
    ];

    fn seed(&self) -> u64 {
        self.seed.unsigned_abs()
    }
}
