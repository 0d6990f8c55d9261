//! A lesson about a world, as the pages are shown it, and what they ask the robot's caution to be.

use crate::protocol::{
    CautionView, FrontierView, LossPoint, PolicyView, RobustBoundsView, Sections, WeightView, WorldQuestionView,
    WorldView,
};
use crate::question::is_uuid;
use crate::tabular_view::{
    frontier_view, policy_view, robust_bounds_view, weights_view, world_question_view, world_view,
};
use crate::view::{finite, goal};
use apprentice_msgs::msg::{
    LessonStatus, PolicyBounds, PolicyFrontier, Posterior, RiskPreference, RobustPolicy, TabularWorld, WorldQuery,
};
use apprentice_msgs::std_msgs::Header;
use bus::Time;
use exchange::{MAX_ID, World, check_robust_policy, check_world_query, world_from_message, world_hash};

/// A preference that no policy follows yet is published again after this long, nanoseconds.
const REPUBLISH_NS: i128 = 990_000_000;
/// Points of the bound's history kept.
const MAX_TREND: usize = 2000;

/// Which sections have changed.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) struct News {
    world: bool,
    policy: bool,
    frontier: bool,
    bounds: bool,
    caution: bool,
    weights: bool,
    trend: bool,
}

impl News {
    /// Nothing.
    pub const NONE: Self = Self {
        world: false,
        policy: false,
        frontier: false,
        bounds: false,
        caution: false,
        weights: false,
        trend: false,
    };
    /// Everything, for a page that has just joined.
    pub const ALL: Self =
        Self { world: true, policy: true, frontier: true, bounds: true, caution: true, weights: true, trend: true };
}

impl News {
    /// Whether the map of the world looks different.
    pub fn is_drawn(self) -> bool {
        self.world || self.policy
    }
}

impl std::ops::BitOrAssign for News {
    fn bitor_assign(&mut self, other: Self) {
        self.world |= other.world;
        self.policy |= other.policy;
        self.frontier |= other.frontier;
        self.bounds |= other.bounds;
        self.caution |= other.caution;
        self.weights |= other.weights;
        self.trend |= other.trend;
    }
}

/// A preference of this node's pages.
#[derive(Debug, Clone)]
struct Wish {
    message: RiskPreference,
    sent: Option<Time>,
    taken: bool,
}

/// See the module.
#[derive(Debug, Clone, Default)]
pub(crate) struct Tabular {
    world: Option<(World, WorldView)>,
    query: Option<Box<WorldQuery>>,
    policy: Option<PolicyView>,
    /// Number of the preference that the newest policy follows.
    followed: u64,
    frontier: Option<FrontierView>,
    bounds: Option<RobustBoundsView>,
    weights: Vec<WeightView>,
    trend: Vec<LossPoint>,
    wish: Option<Wish>,
}

impl Tabular {
    pub fn take_world(&mut self, message: &TabularWorld) -> Result<News, String> {
        if self.world.as_ref().is_some_and(|(known, _)| known.hash == world_hash(message)) {
            return Ok(News::NONE);
        }
        match world_from_message(message) {
            Ok(world) => {
                let view = world_view(&world);
                self.world = Some((world, view));
                Ok(News { world: true, ..News::NONE })
            }
            Err(error) => {
                let id: String = message.id.chars().take(MAX_ID).collect();
                Err(format!("the world '{id}' cannot be shown: {error}"))
            }
        }
    }

    /// Takes a question about the world; whether that is news. One about a world that is not known, or not yet, is not shown:
    /// it comes again.
    pub fn take_query(&mut self, message: Box<WorldQuery>) -> Result<bool, String> {
        let Some((world, _)) = self.world.as_ref().filter(|(world, _)| world.hash == message.world.hash) else {
            return Ok(false);
        };
        let id: String = message.id.chars().take(MAX_ID).collect();
        check_world_query(&message, world).map_err(|error| format!("question '{id}' cannot be shown: {error}"))?;
        let before = self.query.as_ref().map(|known| world_question_view(known, true));
        let is_news = before != Some(world_question_view(&message, true));
        self.query = Some(message);
        Ok(is_news)
    }

    /// The newest question about the world.
    pub fn query(&self) -> Option<&WorldQuery> {
        self.query.as_deref()
    }

    /// The world as it is shown.
    pub fn world(&self) -> Option<&WorldView> {
        self.world.as_ref().map(|(_, view)| view)
    }

    /// What the robot would do in it.
    pub fn policy(&self) -> Option<&PolicyView> {
        self.policy.as_ref()
    }

    /// The same for pages.
    pub fn question(&self, open: bool) -> Option<WorldQuestionView> {
        self.query.as_ref().map(|query| world_question_view(query, open))
    }

    pub fn take_policy(&mut self, message: &RobustPolicy) -> Result<News, String> {
        check_robust_policy(message)
            .map_err(|error| format!("the policy of revision {} cannot be shown: {error}", message.revision))?;
        let view = policy_view(message);
        self.followed = message.preference_number;
        let mut news = News { policy: self.policy.as_ref() != Some(&view), ..News::NONE };
        self.policy = Some(view);
        if let Some(wish) =
            self.wish.as_mut().filter(|wish| !wish.taken && wish.message.number <= message.preference_number)
        {
            wish.taken = true;
            news.caution = true;
        }
        Ok(news)
    }

    pub fn take_frontier(&mut self, message: &PolicyFrontier) -> News {
        let view = frontier_view(message);
        let frontier = self.frontier.as_ref() != Some(&view);
        self.frontier = Some(view);
        News { frontier, ..News::NONE }
    }

    pub fn take_bounds(&mut self, message: &PolicyBounds) -> News {
        let Some(view) = robust_bounds_view(message) else { return News::NONE };
        let bounds = self.bounds.as_ref() != Some(&view);
        self.bounds = Some(view);
        News { bounds, ..News::NONE }
    }

    pub fn take_posterior(&mut self, message: &Posterior) -> News {
        let view = weights_view(message);
        let weights = self.weights != view;
        self.weights = view;
        News { weights, ..News::NONE }
    }

    pub fn take_lesson(&mut self, message: &LessonStatus) -> News {
        let Some(goal) = goal(message) else { return News::NONE };
        let point = LossPoint {
            revision: message.revision,
            bound: finite(message.loss_bound),
            goal: Some(goal),
            reason: message.reason.clone(),
        };
        if self.trend.last() == Some(&point) {
            return News::NONE;
        }
        // An earlier revision than the last one begins a new session; the same one replaces its point.
        self.trend.retain(|known| known.revision < point.revision);
        self.trend.push(point);
        if self.trend.len() > MAX_TREND {
            self.trend.remove(0);
        }
        News { trend: true, ..News::NONE }
    }

    /// Takes what a page asks the robot's caution to be.
    pub fn say(&mut self, now: &Time, source: &str, id: &str, lambda: f64) -> Result<News, String> {
        if !is_uuid(id) {
            return Err("the id of a command must be a version 4 UUID".into());
        }
        if !(0.0..=1.0).contains(&lambda) {
            return Err(format!("lambda is {lambda}; a number from 0 to 1 is needed"));
        }
        let is_known = self.wish.as_ref().is_some_and(|wish| wish.message.id == id)
            || self.policy.as_ref().is_some_and(|policy| policy.preference_id == id);
        if is_known {
            return Ok(News::NONE);
        }
        let last = self.wish.as_ref().map_or(0, |wish| wish.message.number).max(self.followed);
        self.wish = Some(Wish {
            message: RiskPreference {
                header: Header { stamp: *now, frame_id: String::new() },
                id: id.to_owned(),
                source: source.to_owned(),
                number: last.saturating_add(1),
                lambda,
            },
            sent: None,
            taken: false,
        });
        Ok(News { caution: true, ..News::NONE })
    }

    /// The preference, when it has to be published now, first time or again.
    pub fn due(&mut self, now: &Time) -> Option<RiskPreference> {
        let wish = self.wish.as_mut().filter(|wish| !wish.taken)?;
        if wish.sent.as_ref().is_some_and(|sent| now.nanoseconds_since(sent) < REPUBLISH_NS) {
            return None;
        }
        wish.sent = Some(*now);
        Some(wish.message.clone())
    }

    /// Puts what is new into the sections.
    pub fn fill(&self, news: News, sections: &mut Sections) {
        sections.world = news.world.then(|| self.world.as_ref().map(|(_, view)| view.clone()));
        sections.policy = news.policy.then(|| self.policy.clone());
        sections.frontier = news.frontier.then(|| self.frontier.clone());
        sections.robust_bounds = news.bounds.then(|| self.bounds.clone());
        let caution = || {
            self.wish.as_ref().map(|wish| CautionView {
                id: wish.message.id.clone(),
                lambda: wish.message.lambda,
                taken: wish.taken,
            })
        };
        sections.caution = news.caution.then(caution);
        sections.weights = news.weights.then(|| self.weights.clone());
        sections.loss_trend = news.trend.then(|| self.trend.clone());
    }
}
