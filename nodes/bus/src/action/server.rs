//! The side that does the work.

use std::{
    collections::BTreeMap,
    sync::{Arc, Mutex, MutexGuard, PoisonError},
};

use apprentice_msgs::{
    Action, Message, Service,
    action_msgs::{CancelGoal, CancelGoalRequest, CancelGoalResponse, GoalInfo, GoalStatus, GoalStatusArray},
    builtin_interfaces::Time,
    from_cdr, to_cdr,
};

use super::{GoalId, Names};
use crate::{
    bus::{Bus, EventSender},
    clock::Clock,
    error::BusError,
    publisher::Publisher,
    qos::Qos,
    transport::Answer,
};

/// Goals that are not finished; more are refused.
const MOST_OPEN: usize = 64;
/// Finished goals whose results are kept; the oldest are forgotten.
const MOST_FINISHED: usize = 64;
/// Requests for one result that are kept; more are not answered.
const MOST_WAITING: usize = 16;

/// What clients ask of a server.
#[derive(Debug, Clone, PartialEq)]
pub enum ActionRequest<A: Action> {
    /// New work, to [`accept`](ActionServer::accept) or [`reject`](ActionServer::reject).
    Goal {
        /// Which goal.
        goal_id: GoalId,
        /// What is asked for.
        goal: A::Goal,
    },
    /// An accepted goal is to be cancelled: [`finish`](ActionServer::finish) it.
    Cancel {
        /// Which goal.
        goal_id: GoalId,
    },
}

/// How a goal ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum End {
    /// Done.
    Succeeded,
    /// Cancelled by a client.
    Canceled,
    /// Given up by the server.
    Aborted,
}

/// Serves an action: answers requests, keeps results for those who ask late, and tells the status of every goal.
pub struct ActionServer<A: Action> {
    goals: Arc<Goals>,
    feedback: Publisher<A::FeedbackMessage>,
}

struct Goals {
    inner: Mutex<BTreeMap<[u8; 16], Goal>>,
    status: Publisher<GoalStatusArray>,
    clock: Clock,
}

struct Goal {
    /// Order of arrival.
    number: u64,
    status: i8,
    stamp: Time,
    /// Of the client that waits to hear whether the goal is taken.
    undecided: Option<Answer>,
    /// Of clients that wait for the result.
    waiting: Vec<Answer>,
    /// CDR of the result's response.
    result: Option<Vec<u8>>,
}

impl Goals {
    fn lock(&self) -> MutexGuard<'_, BTreeMap<[u8; 16], Goal>> {
        self.inner.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Tells the status of every goal, and forgets the oldest finished ones.
    fn publish(&self, goals: &mut BTreeMap<[u8; 16], Goal>) {
        let mut finished: Vec<(u64, [u8; 16])> =
            goals.iter().filter(|(_, goal)| goal.result.is_some()).map(|(id, goal)| (goal.number, *id)).collect();
        finished.sort_unstable();
        for (_, id) in finished.iter().take(finished.len().saturating_sub(MOST_FINISHED)) {
            goals.remove(id);
        }
        let mut known: Vec<(u64, GoalStatus)> = goals
            .iter()
            .filter(|(_, goal)| goal.undecided.is_none())
            .map(|(id, goal)| {
                let goal_info = GoalInfo { goal_id: GoalId { uuid: *id }, stamp: goal.stamp };
                (goal.number, GoalStatus { goal_info, status: goal.status })
            })
            .collect();
        known.sort_by_key(|(number, _)| *number);
        let array = GoalStatusArray { status_list: known.into_iter().map(|(_, status)| status).collect() };
        if let Err(error) = self.status.publish(&array) {
            log::warn!("{}: the status could not be published: {error}", self.status.topic());
        }
    }
}

impl<A: Action> ActionServer<A> {
    /// Takes a goal that was asked for.
    pub fn accept(&self, goal_id: GoalId) {
        let mut goals = self.goals.lock();
        let Some(goal) = goals.get_mut(&goal_id.uuid) else { return };
        let Some(answer) = goal.undecided.take() else { return };
        goal.status = GoalStatus::STATUS_EXECUTING;
        goal.stamp = self.goals.clock.now();
        let response = A::goal_response(true, goal.stamp);
        self.goals.publish(&mut goals);
        drop(goals);
        answer(to_cdr(&response));
    }

    /// Refuses a goal that was asked for.
    pub fn reject(&self, goal_id: GoalId) {
        let mut goals = self.goals.lock();
        if goals.get(&goal_id.uuid).is_none_or(|goal| goal.undecided.is_none()) {
            return;
        }
        let answer = goals.remove(&goal_id.uuid).and_then(|goal| goal.undecided);
        drop(goals);
        if let Some(answer) = answer {
            answer(to_cdr(&A::goal_response(false, self.goals.clock.now())));
        }
    }

    /// Tells how far an accepted goal is.
    pub fn feedback(&self, goal_id: GoalId, feedback: A::Feedback) {
        let running = self.goals.lock().get(&goal_id.uuid).is_some_and(|goal| goal.result.is_none());
        if running && let Err(error) = self.feedback.publish(&A::feedback_message(goal_id, feedback)) {
            log::warn!("{}: feedback could not be published: {error}", self.feedback.topic());
        }
    }

    /// Ends an accepted goal; whoever asked for its result gets it.
    pub fn finish(&self, goal_id: GoalId, end: End, result: A::Result) {
        let mut goals = self.goals.lock();
        let Some(goal) = goals.get_mut(&goal_id.uuid) else { return };
        if goal.undecided.is_some() || goal.result.is_some() {
            return;
        }
        goal.status = match end {
            End::Succeeded => GoalStatus::STATUS_SUCCEEDED,
            End::Canceled => GoalStatus::STATUS_CANCELED,
            End::Aborted => GoalStatus::STATUS_ABORTED,
        };
        let response = to_cdr(&A::result_response(goal.status, result));
        goal.result = Some(response.clone());
        let waiting = std::mem::take(&mut goal.waiting);
        self.goals.publish(&mut goals);
        drop(goals);
        for answer in waiting {
            answer(response.clone());
        }
    }
}

impl<A: Action> std::fmt::Debug for ActionServer<A> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("ActionServer").field("action", &A::TYPE).finish_non_exhaustive()
    }
}

impl<E: Send + 'static> Bus<E> {
    /// Offers an action; what clients ask becomes events. A goal that is sent again, since its answer was lost, is answered
    /// again and is no new goal.
    ///
    /// # Errors
    /// On an illegal name, or when DDS refuses.
    pub fn action_server<A: Action>(
        &mut self,
        name: &str,
        to_event: impl Fn(ActionRequest<A>) -> E + Clone + Send + 'static,
    ) -> Result<ActionServer<A>, BusError> {
        let names = Names::new(&self.resolve_as("action", name)?);
        let feedback = self.publisher_absolute(&names.feedback, <A::FeedbackMessage as Message>::TYPE, Qos::Event)?;
        let status = self.publisher_absolute(&names.status, GoalStatusArray::TYPE, Qos::State)?;
        let goals = Arc::new(Goals { inner: Mutex::default(), status: Publisher::new(status), clock: self.clock() });
        self.take_goals(&names.send_goal, &goals, to_event.clone())?;
        self.take_cancellations(&names.cancel_goal, &goals, to_event)?;
        self.give_results::<A>(&names.get_result, &goals)?;
        Ok(ActionServer { goals, feedback: Publisher::new(feedback) })
    }

    fn take_goals<A: Action>(
        &mut self,
        name: &str,
        goals: &Arc<Goals>,
        to_event: impl Fn(ActionRequest<A>) -> E + Send + 'static,
    ) -> Result<(), BusError> {
        let (goals, sender) = (Arc::clone(goals), self.sender());
        let service = name.to_owned();
        let mut arrived: u64 = 0;
        self.serve_raw(name, <A::SendGoal as Service>::TYPE, move |bytes, answer| {
            let (goal_id, goal) = match from_cdr(bytes) {
                Ok(request) => A::goal_of(request),
                Err(error) => {
                    log::warn!("{service}: a malformed goal is not answered: {error}");
                    return;
                }
            };
            let mut known = goals.lock();
            let open = known.values().filter(|goal| goal.result.is_none()).count();
            let response = match known.get_mut(&goal_id.uuid) {
                Some(again) if again.undecided.is_some() => {
                    again.undecided = Some(answer);
                    return;
                }
                Some(again) => Some(A::goal_response(true, again.stamp)),
                None if open >= MOST_OPEN => Some(A::goal_response(false, goals.clock.now())),
                None => None,
            };
            if let Some(response) = response {
                drop(known);
                answer(to_cdr(&response));
                return;
            }
            arrived += 1;
            let goal_state = Goal {
                number: arrived,
                status: GoalStatus::STATUS_ACCEPTED,
                stamp: Time::default(),
                undecided: Some(answer),
                waiting: Vec::new(),
                result: None,
            };
            known.insert(goal_id.uuid, goal_state);
            drop(known);
            sender.send(to_event(ActionRequest::Goal { goal_id, goal }));
        })
    }

    fn take_cancellations<A: Action>(
        &mut self,
        name: &str,
        goals: &Arc<Goals>,
        to_event: impl Fn(ActionRequest<A>) -> E + Send + 'static,
    ) -> Result<(), BusError> {
        let (goals, sender) = (Arc::clone(goals), self.sender());
        let service = name.to_owned();
        self.serve_raw(name, CancelGoal::TYPE, move |bytes, answer| match from_cdr::<CancelGoalRequest>(bytes) {
            Ok(request) => {
                let response = cancel(&goals, &request.goal_info);
                let canceling = response.goals_canceling.clone();
                answer(to_cdr(&response));
                announce(&sender, &to_event, canceling);
            }
            Err(error) => log::warn!("{service}: a malformed request is not answered: {error}"),
        })
    }

    fn give_results<A: Action>(&mut self, name: &str, goals: &Arc<Goals>) -> Result<(), BusError> {
        let goals = Arc::clone(goals);
        let service = name.to_owned();
        self.serve_raw(name, <A::GetResult as Service>::TYPE, move |bytes, answer| {
            let goal_id = match from_cdr(bytes) {
                Ok(request) => A::result_id(&request),
                Err(error) => {
                    log::warn!("{service}: a malformed request is not answered: {error}");
                    return;
                }
            };
            let mut known = goals.lock();
            match known.get_mut(&goal_id.uuid) {
                Some(Goal { result: Some(result), .. }) => {
                    let result = result.clone();
                    drop(known);
                    answer(result);
                }
                Some(goal) if goal.waiting.len() < MOST_WAITING => goal.waiting.push(answer),
                Some(_) => {}
                None => {
                    drop(known);
                    answer(to_cdr(&A::result_response(GoalStatus::STATUS_UNKNOWN, A::Result::default())));
                }
            }
        })
    }
}

/// Passes cancellations on to the node.
fn announce<E: Send + 'static, A: Action>(
    sender: &EventSender<E>,
    to_event: &impl Fn(ActionRequest<A>) -> E,
    canceling: Vec<GoalInfo>,
) {
    for info in canceling {
        sender.send(to_event(ActionRequest::Cancel { goal_id: info.goal_id }));
    }
}

/// Marks the goals that a request means: one by its id; all up to a time; both; or, with neither, all.
fn cancel(goals: &Goals, wanted: &GoalInfo) -> CancelGoalResponse {
    let (no_id, no_time) = (wanted.goal_id == GoalId::default(), wanted.stamp == Time::default());
    let mut known = goals.lock();
    if !no_id {
        let code = match known.get(&wanted.goal_id.uuid) {
            None => CancelGoalResponse::ERROR_UNKNOWN_GOAL_ID,
            Some(goal) if goal.result.is_some() => CancelGoalResponse::ERROR_GOAL_TERMINATED,
            Some(goal) if goal.undecided.is_some() => CancelGoalResponse::ERROR_REJECTED,
            Some(_) => CancelGoalResponse::ERROR_NONE,
        };
        if code != CancelGoalResponse::ERROR_NONE {
            return CancelGoalResponse { return_code: code, goals_canceling: Vec::new() };
        }
    }
    let before = |stamp: &Time| (stamp.sec, stamp.nanosec) <= (wanted.stamp.sec, wanted.stamp.nanosec);
    let mut canceling = Vec::new();
    for (id, goal) in known.iter_mut() {
        let meant = match (no_id, no_time) {
            (true, true) => true,
            (true, false) => before(&goal.stamp),
            (false, true) => *id == wanted.goal_id.uuid,
            (false, false) => *id == wanted.goal_id.uuid || before(&goal.stamp),
        };
        if meant && goal.undecided.is_none() && goal.result.is_none() {
            goal.status = GoalStatus::STATUS_CANCELING;
            canceling.push(GoalInfo { goal_id: GoalId { uuid: *id }, stamp: goal.stamp });
        }
    }
    if !canceling.is_empty() {
        goals.publish(&mut known);
    }
    CancelGoalResponse { return_code: CancelGoalResponse::ERROR_NONE, goals_canceling: canceling }
}
