//! The side that asks for work.

use std::{
    collections::BTreeMap,
    sync::{
        Arc, Mutex, PoisonError,
        atomic::{AtomicU64, Ordering},
    },
};

use apprentice_msgs::{
    Action, Message, Service, action_msgs,
    action_msgs::{CancelGoal, CancelGoalRequest, GoalInfo, GoalStatusArray},
    from_cdr, to_cdr,
};

use super::{GoalId, Names};
use crate::{
    bus::Bus,
    error::BusError,
    qos::Qos,
    transport::{Answered, Caller},
};

/// Most goals whose news are passed on; the oldest are forgotten.
const MOST_GOALS: usize = 100;

/// What a client hears of its goals.
#[derive(Debug, Clone, PartialEq)]
pub enum ActionEvent<A: Action> {
    /// The server took the goal, or refused it.
    Answered {
        /// Which goal.
        goal_id: GoalId,
        /// Whether it took it.
        accepted: bool,
    },
    /// How far it is.
    Feedback {
        /// Which goal.
        goal_id: GoalId,
        /// What the server says.
        feedback: A::Feedback,
    },
    /// The goal's status changed; one of [`GoalStatus`](apprentice_msgs::action_msgs::GoalStatus). It also tells that a goal
    /// was taken when the answer was lost.
    Status {
        /// Which goal.
        goal_id: GoalId,
        /// Where it stands.
        status: i8,
    },
    /// The server answered a cancellation.
    Cancelling {
        /// Which goal.
        goal_id: GoalId,
        /// One of the constants of `CancelGoal_Response`.
        code: i8,
    },
    /// What came of it.
    Finished {
        /// Which goal.
        goal_id: GoalId,
        /// How it ended; one of [`GoalStatus`](apprentice_msgs::action_msgs::GoalStatus), unknown when the server does not
        /// know the goal.
        status: i8,
        /// What the server says.
        result: A::Result,
    },
}

/// Sends goals to one server. Every request may be lost, and every answer: ask again, with the same id for a result or a
/// cancellation.
pub struct ActionClient<A: Action> {
    send_goal: Requests,
    cancel_goal: Requests,
    get_result: Requests,
    goals: Arc<Mutex<Vec<GoalId>>>,
    action: std::marker::PhantomData<fn(&A)>,
}

/// One of the services, and whose goal each open request is about.
struct Requests {
    caller: Arc<dyn Caller>,
    open: Arc<Mutex<BTreeMap<u64, GoalId>>>,
    next: AtomicU64,
}

impl Requests {
    fn send(&self, goal_id: GoalId, cdr: Vec<u8>) -> Result<(), BusError> {
        let number = self.next.fetch_add(1, Ordering::Relaxed);
        {
            let mut open = self.open.lock().unwrap_or_else(PoisonError::into_inner);
            open.insert(number, goal_id);
            while open.len() > MOST_GOALS {
                open.pop_first();
            }
        }
        self.caller.call(number, cdr)
    }
}

impl<A: Action> ActionClient<A> {
    /// Sends a goal. The answer comes as [`ActionEvent::Answered`].
    ///
    /// # Errors
    /// When DDS does not take it.
    pub fn send_goal(&self, goal_id: GoalId, goal: A::Goal) -> Result<(), BusError> {
        {
            let mut goals = self.goals.lock().unwrap_or_else(PoisonError::into_inner);
            if !goals.contains(&goal_id) {
                goals.push(goal_id);
            }
            if goals.len() > MOST_GOALS {
                goals.remove(0);
            }
        }
        self.send_goal.send(goal_id, to_cdr(&A::goal_request(goal_id, goal)))
    }

    /// Asks for the result, which comes as [`ActionEvent::Finished`] once there is one.
    ///
    /// # Errors
    /// When DDS does not take it.
    pub fn request_result(&self, goal_id: GoalId) -> Result<(), BusError> {
        self.get_result.send(goal_id, to_cdr(&A::result_request(goal_id)))
    }

    /// Asks for a goal to be cancelled. The answer comes as [`ActionEvent::Cancelling`], the end as its result.
    ///
    /// # Errors
    /// When DDS does not take it.
    pub fn cancel(&self, goal_id: GoalId) -> Result<(), BusError> {
        let goal_info = GoalInfo { goal_id, ..GoalInfo::default() };
        self.cancel_goal.send(goal_id, to_cdr(&CancelGoalRequest { goal_info }))
    }

    /// Whether a server is matched on all services.
    pub fn has_server(&self) -> bool {
        [&self.send_goal, &self.cancel_goal, &self.get_result].iter().all(|requests| requests.caller.servers() > 0)
    }
}

impl<A: Action> std::fmt::Debug for ActionClient<A> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("ActionClient").field("action", &A::TYPE).finish_non_exhaustive()
    }
}

impl<E: Send + 'static> Bus<E> {
    /// Makes a client of an action; what it hears becomes events.
    ///
    /// `to_event` runs on threads of the graph and must neither wait nor publish.
    ///
    /// # Errors
    /// On an illegal name, or when DDS refuses.
    pub fn action_client<A: Action>(
        &mut self,
        name: &str,
        to_event: impl Fn(ActionEvent<A>) -> E + Clone + Send + 'static,
    ) -> Result<ActionClient<A>, BusError> {
        let names = Names::new(&self.resolve_as("action", name)?);
        let goals: Arc<Mutex<Vec<GoalId>>> = Arc::default();
        let send_goal = self.requests::<A::SendGoal, A>(&names.send_goal, to_event.clone(), |goal_id, response| {
            ActionEvent::Answered { goal_id, accepted: A::is_accepted(&response) }
        })?;
        let cancel_goal =
            self.requests::<CancelGoal, A>(&names.cancel_goal, to_event.clone(), |goal_id, response| {
                ActionEvent::Cancelling { goal_id, code: response.return_code }
            })?;
        let get_result =
            self.requests::<A::GetResult, A>(&names.get_result, to_event.clone(), |goal_id, response| {
                let (status, result) = A::result_of(response);
                ActionEvent::Finished { goal_id, status, result }
            })?;
        self.follow_feedback(&names, &goals, to_event.clone())?;
        self.follow_status(&names, &goals, to_event)?;
        Ok(ActionClient { send_goal, cancel_goal, get_result, goals, action: std::marker::PhantomData })
    }

    /// A client of one of the services.
    fn requests<S: Service, A: Action>(
        &mut self,
        name: &str,
        to_event: impl Fn(ActionEvent<A>) -> E + Send + 'static,
        event: impl Fn(GoalId, S::Response) -> ActionEvent<A> + Send + 'static,
    ) -> Result<Requests, BusError> {
        let open: Arc<Mutex<BTreeMap<u64, GoalId>>> = Arc::default();
        let waiting = Arc::clone(&open);
        let sender = self.sender();
        let service = name.to_owned();
        let answered: Answered = Box::new(move |number, cdr| {
            let goal = waiting.lock().unwrap_or_else(PoisonError::into_inner).remove(&number);
            match (goal, from_cdr::<S::Response>(cdr)) {
                (Some(goal), Ok(response)) => sender.send(to_event(event(goal, response))),
                (None, _) => {}
                (_, Err(error)) => log::warn!("{service}: a malformed answer is left out: {error}"),
            }
        });
        let caller = self.client(name, S::TYPE, answered)?;
        Ok(Requests { caller, open, next: AtomicU64::new(0) })
    }

    fn follow_feedback<A: Action>(
        &mut self,
        names: &Names,
        goals: &Arc<Mutex<Vec<GoalId>>>,
        to_event: impl Fn(ActionEvent<A>) -> E + Send + 'static,
    ) -> Result<(), BusError> {
        let sender = self.sender();
        let goals = Arc::clone(goals);
        let topic = names.feedback.clone();
        let mut unread = false;
        // Some servers' feedback has members that others lack (FollowJointTrajectory since 2025). It is news, not needed:
        // what cannot be read is said once and left out.
        self.listen(
            &names.feedback,
            <A::FeedbackMessage as Message>::TYPE,
            &Qos::Event.profile(),
            Box::new(move |raw| match from_cdr::<A::FeedbackMessage>(&raw.cdr) {
                Ok(message) => {
                    let (goal_id, feedback) = A::feedback_of(message);
                    if goals.lock().unwrap_or_else(PoisonError::into_inner).contains(&goal_id) {
                        sender.send(to_event(ActionEvent::Feedback { goal_id, feedback }));
                    }
                }
                Err(error) if !unread => {
                    unread = true;
                    log::info!("{topic}: feedback in another layout is left out: {error}");
                }
                Err(_) => {}
            }),
        )
    }

    fn follow_status<A: Action>(
        &mut self,
        names: &Names,
        goals: &Arc<Mutex<Vec<GoalId>>>,
        to_event: impl Fn(ActionEvent<A>) -> E + Send + 'static,
    ) -> Result<(), BusError> {
        let sender = self.sender();
        let goals = Arc::clone(goals);
        let mut last: BTreeMap<[u8; 16], i8> = BTreeMap::new();
        self.subscribe_decoded::<GoalStatusArray>(&names.status, &Qos::State.profile(), move |array| {
            for action_msgs::GoalStatus { goal_info, status } in array.status_list {
                let goal_id = goal_info.goal_id;
                let own = goals.lock().unwrap_or_else(PoisonError::into_inner).contains(&goal_id);
                if own && last.insert(goal_id.uuid, status) != Some(status) {
                    sender.send(to_event(ActionEvent::Status { goal_id, status }));
                }
                while last.len() > MOST_GOALS {
                    last.pop_first();
                }
            }
        })
    }
}
