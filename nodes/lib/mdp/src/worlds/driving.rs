//! The driving task of section 4.5.4: five lanes, the outer two off the road, and slower traffic to avoid.
//!
//! The dissertation observes the road through 12 binary features and learns without a model. Here is the road itself, so
//! that every value is exact: one car of the traffic at a time, as in the author's experiment, which comes a car's length
//! closer each step and is followed by the next, in a lane drawn anew, once it has fallen behind. A state is (own lane,
//! traffic lane, traffic place): 5 × 3 × 7 = 105 states. [`observation`] gives the 12 features of each.

use crate::parts::{Features, MdpParts};
use crate::policy::Policy;
use crate::solver::Solver;
use crate::{Mdp, MdpError};

/// Lanes: off the road, left, centre, right, off the road.
pub const N_LANES: usize = 5;
/// Lanes with traffic: those of the road.
const TRAFFIC_LANES: [usize; 3] = [1, 2, 3];
/// Places of the traffic: 0 is farthest ahead, 3 to 5 touch a car in the same lane, 6 lies behind.
pub const N_PLACES: usize = 7;
/// States.
pub const N_STATES: usize = N_LANES * 3 * N_PLACES;
/// Change to the lane on the left.
pub const TO_LEFT: usize = 0;
/// Stay in the lane.
pub const STAY: usize = 1;
/// Change to the lane on the right.
pub const TO_RIGHT: usize = 2;
/// Reward features: a collision, then one for each lane.
pub const N_FEATURES: usize = 1 + N_LANES;
/// The feature of a collision; lane l has feature 1 + l.
pub const COLLISION: usize = 0;

/// A driver who avoids collisions and the roadside but has no favourite lane; the one who demonstrates.
pub const SAFE: [f64; N_FEATURES] = [-0.4, -0.2, 0.0, 0.0, 0.0, -0.2];
/// Evaluation policy "right-safe": avoids collisions and the roadside, prefers the right lane.
pub const RIGHT_SAFE: [f64; N_FEATURES] = [-1.0, -1.0, 0.0, 0.1, 0.5, -1.0];
/// Evaluation policy "on-road": avoids the roadside, heeds no traffic.
pub const ON_ROAD: [f64; N_FEATURES] = [0.0, -0.5, 0.0, 0.0, 0.0, -0.5];
/// Evaluation policy "nasty": avoids the roadside, seeks collisions.
pub const NASTY: [f64; N_FEATURES] = [1.0, -1.0, 0.0, 0.0, 0.0, -1.0];

/// The state of a car in `lane` and traffic at `place` of traffic lane 0 to 2.
pub fn state(lane: usize, traffic: usize, place: usize) -> usize {
    (lane * TRAFFIC_LANES.len() + traffic) * N_PLACES + place
}

/// Own lane, lane of the traffic and its place in a state.
fn situation(state: usize) -> (usize, usize, usize) {
    let (lane, rest) = (state / (TRAFFIC_LANES.len() * N_PLACES), state % (TRAFFIC_LANES.len() * N_PLACES));
    (lane, TRAFFIC_LANES[rest / N_PLACES], rest % N_PLACES)
}

/// The process, γ = 0.9: it starts in the centre lane with traffic beside it on the left. Lanes end at the outermost.
pub fn world() -> Mdp {
    build().expect("the numbers of this world make a process")
}

fn build() -> Result<Mdp, MdpError> {
    let mut transitions = Vec::new();
    let mut features = vec![0.0; N_STATES * N_FEATURES];
    for from in 0..N_STATES {
        let (lane, traffic_lane, place) = situation(from);
        features[from * N_FEATURES + COLLISION] = f64::from(u8::from(lane == traffic_lane && touches(place)));
        features[from * N_FEATURES + 1 + lane] = 1.0;
        for action in [TO_LEFT, STAY, TO_RIGHT] {
            let next = (lane + action).saturating_sub(1).min(N_LANES - 1);
            if place + 1 < N_PLACES {
                transitions.push((from, action, state(next, traffic_lane - TRAFFIC_LANES[0], place + 1), 1.0));
            } else {
                let share = 1.0 / TRAFFIC_LANES.len() as f64;
                transitions.extend((0..TRAFFIC_LANES.len()).map(|t| (from, action, state(next, t, 0), share)));
            }
        }
    }
    let mut initial = vec![0.0; N_STATES];
    initial[state(2, 0, 4)] = 1.0;
    Mdp::new(MdpParts {
        gamma: 0.9,
        n_states: N_STATES,
        n_actions: 3,
        n_features: N_FEATURES,
        initial,
        transitions,
        features: Features::State(features),
        actions: vec!["left".into(), "stay".into(), "right".into()],
        shape: None,
    })
}

/// Whether traffic at `place` touches a car in the same lane.
fn touches(place: usize) -> bool {
    (3..=5).contains(&place)
}

/// The 12 binary features through which the dissertation sees a state: collision, traffic one step ahead, two steps ahead,
/// the five lanes, then whether a change to the left would end in a collision or right behind traffic, and to the right.
pub fn observation(state: usize) -> [bool; 12] {
    let (lane, traffic_lane, place) = situation(state);
    let here = lane == traffic_lane;
    let left = traffic_lane + 1 == lane;
    let right = traffic_lane == lane + 1;
    let mut seen = [false; 12];
    (seen[0], seen[1], seen[2]) = (here && touches(place), here && place == 2, here && place == 1);
    seen[3 + lane] = true;
    let (hit, tail) = ((2..=4).contains(&place), place == 1);
    (seen[8], seen[9], seen[10], seen[11]) = (left && hit, left && tail, right && hit, right && tail);
    seen
}

/// The optimal policy under `weights` that takes all equally good actions equally often, as the dissertation's drivers do.
pub fn driver(mdp: &Mdp, weights: &[f64; N_FEATURES]) -> Policy {
    Solver::new(mdp).solve(weights).indifferent_policy()
}
