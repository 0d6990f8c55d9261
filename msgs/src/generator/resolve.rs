//! All messages and services that the definition files stand for, and what holds for each of them.

use std::collections::BTreeMap;

use super::{GenerateError, Kind, Source};
use crate::interface::{Arity, Base, Field, FieldType, Message, Primitive, parse_action, parse_message, parse_service};

/// One Rust struct to be.
pub(super) struct Item {
    /// Its definition.
    pub message: Message,
    /// Kind of file that it comes from.
    pub kind: Kind,
    /// True when nothing in it is on the heap.
    pub copy: bool,
    /// True when nothing in it is a float.
    pub eq: bool,
}

/// One service to be.
pub(super) struct ServiceItem {
    pub package: String,
    pub kind: Kind,
    /// Name without package; its halves are `name_Request` and `name_Response`.
    pub name: String,
}

/// One action to be; its parts are among the messages and services.
pub(super) struct ActionItem {
    pub package: String,
    /// Name without package.
    pub name: String,
}

/// What [`resolve`] finds.
pub(super) struct Resolved {
    pub items: Vec<Item>,
    pub services: Vec<ServiceItem>,
    pub actions: Vec<ActionItem>,
}

/// Parses `sources` and checks that every nested type is among them and that none contains itself.
pub(super) fn resolve(sources: &[Source]) -> Result<Resolved, GenerateError> {
    let mut parsed = Vec::new();
    let mut services = Vec::new();
    let mut actions = Vec::new();
    for source in sources {
        let (package, name) = (source.package.as_str(), source.name.as_str());
        let mut service = |name: String| {
            services.push(ServiceItem { package: package.to_owned(), kind: source.kind, name });
        };
        match source.kind {
            Kind::Message => {
                let message = parse_message(package, name, &source.path, &source.text)?;
                parsed.push((source.kind, message));
            }
            Kind::Service => {
                let halves = parse_service(package, name, &source.path, &source.text)?;
                parsed.extend([halves.request, halves.response].map(|m| (source.kind, m)));
                service(name.to_owned());
            }
            Kind::Action => {
                let action = parse_action(package, name, &source.path, &source.text)?;
                let derived = action_messages(package, name);
                parsed.extend([action.goal, action.result, action.feedback].map(|m| (source.kind, m)));
                parsed.extend(derived.map(|m| (source.kind, m)));
                service(format!("{name}_SendGoal"));
                service(format!("{name}_GetResult"));
                actions.push(ActionItem { package: package.to_owned(), name: name.to_owned() });
            }
        }
    }
    let index: BTreeMap<(String, String), usize> =
        parsed.iter().enumerate().map(|(at, (_, m))| ((m.package.clone(), m.name.clone()), at)).collect();
    let mut traits = vec![State::Unvisited; parsed.len()];
    for at in 0..parsed.len() {
        visit(at, &parsed, &index, &mut traits)?;
    }
    let items = parsed
        .into_iter()
        .zip(traits)
        .map(|((kind, message), state)| {
            let (copy, eq) = state.traits();
            Item { message, kind, copy, eq }
        })
        .collect();
    Ok(Resolved { items, services, actions })
}

#[derive(Clone, Copy)]
enum State {
    Unvisited,
    Visiting,
    Done { copy: bool, eq: bool },
}

impl State {
    fn traits(self) -> (bool, bool) {
        match self {
            State::Done { copy, eq } => (copy, eq),
            State::Unvisited | State::Visiting => (false, false),
        }
    }
}

/// Works out `Copy` and `Eq` of one message after those of its members.
fn visit(
    at: usize,
    parsed: &[(Kind, Message)],
    index: &BTreeMap<(String, String), usize>,
    states: &mut [State],
) -> Result<(), GenerateError> {
    let message = &parsed[at].1;
    let user = format!("{}/{}", message.package, message.name);
    match states[at] {
        State::Done { .. } => return Ok(()),
        State::Visiting => return Err(GenerateError::Cycle { got: user }),
        State::Unvisited => states[at] = State::Visiting,
    }
    let (mut copy, mut eq) = (true, true);
    for field in &message.fields {
        copy &= matches!(field.ty.arity, Arity::One | Arity::Fixed(_));
        match &field.ty.base {
            Base::Primitive(primitive) => {
                eq &= !matches!(primitive, Primitive::Float32 | Primitive::Float64);
            }
            Base::String { .. } | Base::WString { .. } => copy = false,
            Base::Message { package, name } => {
                let key = (package.clone(), name.clone());
                let nested = *index
                    .get(&key)
                    .ok_or_else(|| GenerateError::Unknown { user: user.clone(), got: format!("{package}/{name}") })?;
                visit(nested, parsed, index, states)?;
                let (nested_copy, nested_eq) = states[nested].traits();
                copy &= nested_copy;
                eq &= nested_eq;
            }
        }
    }
    states[at] = State::Done { copy, eq };
    Ok(())
}

/// The messages that ROS derives from an action for its services and its feedback topic.
fn action_messages(package: &str, name: &str) -> [Message; 5] {
    let goal_id = || nested("goal_id", "unique_identifier_msgs", "UUID");
    let own = |field: &str, part: &str| nested(field, package, &format!("{name}_{part}"));
    let stamp = nested("stamp", "builtin_interfaces", "Time");
    let message = |part: &str, fields: Vec<Field>| Message {
        package: package.to_owned(),
        name: format!("{name}_{part}"),
        comment: Vec::new(),
        fields,
        constants: Vec::new(),
    };
    [
        message("SendGoal_Request", vec![goal_id(), own("goal", "Goal")]),
        message("SendGoal_Response", vec![primitive("accepted", "bool", Primitive::Bool), stamp]),
        message("GetResult_Request", vec![goal_id()]),
        message("GetResult_Response", vec![primitive("status", "int8", Primitive::Int8), own("result", "Result")]),
        message("FeedbackMessage", vec![goal_id(), own("feedback", "Feedback")]),
    ]
}

fn nested(field: &str, package: &str, name: &str) -> Field {
    let base = Base::Message { package: package.to_owned(), name: name.to_owned() };
    plain(field, format!("{package}/{name}"), base)
}

fn primitive(field: &str, written_type: &str, primitive: Primitive) -> Field {
    plain(field, written_type.to_owned(), Base::Primitive(primitive))
}

fn plain(field: &str, written_type: String, base: Base) -> Field {
    Field {
        name: field.to_owned(),
        ty: FieldType { base, arity: Arity::One },
        written_type,
        default: None,
        comment: String::new(),
    }
}
