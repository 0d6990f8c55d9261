//! What a simulated person answers when a question about a world is asked.

use crate::comparing::TIE;
use crate::identity::{answer_id, generator};
use crate::{Noise, Output, Teacher};
use apprentice_msgs::msg::{
    ActionDemonstration, CritiqueSegment, QueryResponse, SegmentCritique, TrajectoryPreference, WorldQuery,
    WorldTrajectory,
};
use apprentice_msgs::std_msgs::Header;
use bus::NodeSettings;
use exchange::{WorldQueryError, check_world_query, feature_trajectory};
use mdp::random::{categorical, uniform};
use rand_chacha::ChaCha8Rng;

impl Teacher {
    /// The answer to a question: a function of the settings, the world, the question's id and what it shows.
    ///
    /// # Errors
    /// A question that is not about this world.
    pub fn answer(&self, query: &WorldQuery, header: Header) -> Result<Output, WorldQueryError> {
        check_world_query(query, &self.world)?;
        let (source, query_id) = (self.settings.source.clone(), query.id.clone());
        let id = answer_id(&source, &query_id, self.settings.seed());
        let mut random = generator(&source, &query_id, self.settings.seed());
        let mood = uniform(&mut random);
        let is_unsure =
            (self.settings.skip_rate..self.settings.skip_rate + self.settings.cant_tell_rate).contains(&mood);
        if mood < self.settings.skip_rate || (is_unsure && query.kind != WorldQuery::COMPARISON) {
            let kind = if is_unsure { QueryResponse::CANT_TELL } else { QueryResponse::SKIP };
            return Ok(Output::Response(QueryResponse { header, id, query_id, source, kind, reason: String::new() }));
        }
        let world_id = self.world.id.clone();
        Ok(match query.trajectories.as_slice() {
            [] => Output::Actions(Box::new(ActionDemonstration {
                header,
                id,
                query_id,
                source,
                world_id,
                states: vec![query.state],
                actions: vec![self.does(query.state as usize, &mut random)],
                confidence: ActionDemonstration::CONFIDENCE_SURE,
            })),
            [first, second] => {
                let mut trajectories = [feature_trajectory(first), feature_trajectory(second)];
                let (mut answer, second_is_better) = self.compares(&trajectories, &mut random);
                if is_unsure {
                    answer = TrajectoryPreference::CANT_TELL;
                }
                if !second_is_better {
                    trajectories.swap(0, 1);
                }
                let confidence = TrajectoryPreference::CONFIDENCE_SURE;
                Output::Preference(Box::new(TrajectoryPreference {
                    header,
                    id,
                    query_id,
                    source,
                    trajectories: trajectories.into(),
                    answer,
                    confidence,
                }))
            }
            [way, ..] => Output::Critique(Box::new(SegmentCritique {
                header,
                id,
                query_id,
                source,
                world_id,
                states: way.states.clone(),
                actions: way.actions.clone(),
                segments: self.marks(way, &mut random),
                confidence: SegmentCritique::CONFIDENCE_SURE,
            })),
        })
    }

    fn does(&self, state: usize, random: &mut ChaCha8Rng) -> u32 {
        let n = self.world.mdp.n_actions();
        let row = (0..n).map(|action| self.hand.probability(n, state, action));
        u32::try_from(categorical(row, 1.0, random)).unwrap_or(u32::MAX)
    }

    /// Parts that are good and parts that are bad; a step that comes again is marked where it comes first. A rational person calls
    /// good what is best, another one calls good what they would do themselves, as often as they would.
    fn marks(&self, way: &WorldTrajectory, random: &mut ChaCha8Rng) -> Vec<CritiqueSegment> {
        let n = self.world.mdp.n_actions();
        let steps: Vec<(usize, usize)> =
            way.states.iter().zip(&way.actions).map(|(s, a)| (*s as usize, *a as usize)).collect();
        let mut segments: Vec<CritiqueSegment> = Vec::new();
        for (step, &(state, action)) in steps.iter().enumerate() {
            if steps[..step].contains(&(state, action)) {
                continue;
            }
            let p = |action| self.hand.probability(n, state, action);
            let is_good = match self.settings.noise {
                Noise::None => (0..n).all(|other| p(other) <= p(action) + TIE),
                Noise::Boltzmann => uniform(random) < p(action),
            };
            let verdict = if is_good { CritiqueSegment::GOOD } else { CritiqueSegment::BAD };
            let at = u32::try_from(step).unwrap_or(u32::MAX);
            match segments.last_mut() {
                Some(last) if last.end == at && last.verdict == verdict => last.end = at + 1,
                _ => segments.push(CritiqueSegment { start: at, end: at + 1, verdict }),
            }
        }
        segments
    }
}
