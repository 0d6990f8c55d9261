//! The text of the Rust files.

use std::collections::BTreeMap;
use std::fmt::Write;

use super::resolve::{ActionItem, Item, Resolved, ServiceItem};
use super::{COMMAND, GenerateError, Kind, MAX_ARRAY, OWN_PACKAGE, Source};
use crate::interface::{Arity, Base, Constant, Field, Literal, Primitive};

/// Largest array for which the standard library and serde implement `Default` and `Serialize`.
const MAX_PLAIN_ARRAY: usize = 32;
/// Name of the octet that stands for a message without members on the wire.
const DUMMY: &str = "structure_needs_at_least_one_member";

/// Writes all files: one per module, and `mod.rs` with the registry.
pub(super) fn emit(sources: &[Source], resolved: &Resolved) -> Result<BTreeMap<String, String>, GenerateError> {
    let mut modules: BTreeMap<String, String> = BTreeMap::new();
    for item in &resolved.items {
        let text = modules.entry(module(&item.message.package, item.kind)).or_default();
        emit_message(text, item)?;
    }
    for service in &resolved.services {
        let text = modules.entry(module(&service.package, service.kind)).or_default();
        emit_service(text, service);
    }
    for action in &resolved.actions {
        let text = modules.entry(module(&action.package, Kind::Action)).or_default();
        // A standard package may call a message and an action alike.
        let is_taken = |item: &Item| item.message.package == action.package && item.message.name == action.name;
        let marker = if resolved.items.iter().any(is_taken) { "Action" } else { "" };
        emit_action(text, action, marker);
    }
    let registry = emit_registry(sources, modules.keys());
    let mut files: BTreeMap<String, String> = modules
        .into_iter()
        .map(|(name, body)| {
            let about = match name.as_str() {
                "msg" => "Messages of this package.".to_owned(),
                "srv" => "Services of this package.".to_owned(),
                "action" => "Actions of this package.".to_owned(),
                _ => format!("Messages of the standard package `{name}`."),
            };
            let head = format!("{}\nuse serde::{{Deserialize, Serialize}};\n", head(&about));
            (format!("{name}.rs"), head + &body)
        })
        .collect();
    files.insert("mod.rs".to_owned(), registry);
    Ok(files)
}

fn head(about: &str) -> String {
    format!("//! {about}\n//!\n//! Generated: do not edit. To write it anew: `{COMMAND}`.\n")
}

fn module(package: &str, kind: Kind) -> String {
    if package == OWN_PACKAGE { kind.directory().to_owned() } else { package.to_owned() }
}

fn emit_registry<'a>(sources: &[Source], modules: impl Iterator<Item = &'a String>) -> String {
    let mut out = head("All interfaces, and the texts they were generated from.");
    out.push('\n');
    for module in modules {
        let _ = writeln!(out, "pub mod {module};");
    }
    for (name, kind, about) in [
        ("MESSAGES", Kind::Message, "Names of all messages, sorted."),
        ("SERVICES", Kind::Service, "Names of all services, sorted."),
        ("ACTIONS", Kind::Action, "Names of all actions, sorted."),
    ] {
        let _ = writeln!(out, "\n/// {about}\npub(crate) const {name}: &[&str] = &[");
        for source in sources.iter().filter(|source| source.kind == kind) {
            let _ = writeln!(out, "    \"{}\",", source.type_name());
        }
        out.push_str("];\n");
    }
    out.push_str("\n/// Names and texts of all definitions, sorted by name.\n");
    out.push_str("pub(crate) const DEFINITIONS: &[(&str, &str)] = &[\n");
    for source in sources {
        let _ = writeln!(out, "    (\"{}\", {}),", source.type_name(), raw_string(&source.text));
    }
    out.push_str("];\n");
    out
}

/// `text` as a raw string literal: the texts are kept whole so that this crate, and with it the
/// generator, still compiles after a definition file was moved or deleted.
fn raw_string(text: &str) -> String {
    let mut hashes = "#".to_owned();
    while text.contains(&format!("\"{hashes}")) {
        hashes.push('#');
    }
    format!("r{hashes}\"{text}\"{hashes}")
}

fn emit_service(out: &mut String, service: &ServiceItem) {
    let name = rust_name(&service.name);
    let type_name = format!("{}/{}/{}", service.package, service.kind.directory(), service.name);
    let _ = write!(
        out,
        "\n/// The service `{type_name}`.\n\
         #[derive(Debug, Clone, Copy, PartialEq, Eq)]\n\
         pub struct {name};\n\n\
         impl crate::Service for {name} {{\n    \
         type Request = {name}Request;\n    \
         type Response = {name}Response;\n    \
         const TYPE: &'static str = \"{type_name}\";\n}}\n"
    );
}

/// `marker` is appended to the name of the type that stands for the whole action.
fn emit_action(out: &mut String, action: &ActionItem, marker: &str) {
    let name = rust_name(&action.name);
    let type_name = format!("{}/action/{}", action.package, action.name);
    let id = "super::unique_identifier_msgs::UUID";
    let stamp = "super::builtin_interfaces::Time";
    let _ = write!(
        out,
        "\n/// The action `{type_name}`.\n\
         #[derive(Debug, Clone, Copy, PartialEq, Eq)]\n\
         pub struct {name}{marker};\n\n\
         impl crate::Action for {name}{marker} {{\n    \
         type Goal = {name}Goal;\n    \
         type Result = {name}Result;\n    \
         type Feedback = {name}Feedback;\n    \
         type SendGoal = {name}SendGoal;\n    \
         type GetResult = {name}GetResult;\n    \
         type FeedbackMessage = {name}FeedbackMessage;\n    \
         const TYPE: &'static str = \"{type_name}\";\n\n    \
         fn goal_request(goal_id: {id}, goal: {name}Goal) -> {name}SendGoalRequest {{\n        \
         {name}SendGoalRequest {{ goal_id, goal }}\n    }}\n\n    \
         fn goal_of(request: {name}SendGoalRequest) -> ({id}, {name}Goal) {{\n        \
         (request.goal_id, request.goal)\n    }}\n\n    \
         fn goal_response(accepted: bool, stamp: {stamp}) -> {name}SendGoalResponse {{\n        \
         {name}SendGoalResponse {{ accepted, stamp }}\n    }}\n\n    \
         fn is_accepted(response: &{name}SendGoalResponse) -> bool {{\n        response.accepted\n    }}\n\n    \
         fn result_request(goal_id: {id}) -> {name}GetResultRequest {{\n        \
         {name}GetResultRequest {{ goal_id }}\n    }}\n\n    \
         fn result_id(request: &{name}GetResultRequest) -> {id} {{\n        request.goal_id\n    }}\n\n    \
         fn result_response(status: i8, result: {name}Result) -> {name}GetResultResponse {{\n        \
         {name}GetResultResponse {{ status, result }}\n    }}\n\n    \
         fn result_of(response: {name}GetResultResponse) -> (i8, {name}Result) {{\n        \
         (response.status, response.result)\n    }}\n\n    \
         fn feedback_message(goal_id: {id}, feedback: {name}Feedback) -> {name}FeedbackMessage {{\n        \
         {name}FeedbackMessage {{ goal_id, feedback }}\n    }}\n\n    \
         fn feedback_of(message: {name}FeedbackMessage) -> ({id}, {name}Feedback) {{\n        \
         (message.goal_id, message.feedback)\n    }}\n}}\n"
    );
}

fn emit_message(out: &mut String, item: &Item) -> Result<(), GenerateError> {
    let message = &item.message;
    let name = rust_name(&message.name);
    let type_name = format!("{}/{}/{}", message.package, item.kind.directory(), message.name);
    out.push('\n');
    for line in &message.comment {
        let _ = writeln!(out, "{}", format!("/// {}", escape(line)).trim_end());
    }
    if message.comment.is_empty() {
        let _ = writeln!(out, "/// The message `{type_name}`.");
    }
    let manual_default = message.fields.iter().any(needs_manual_default);
    out.push_str("#[derive(Debug, Clone, ");
    for (derive, wanted) in [("Copy", item.copy), ("Default", !manual_default)] {
        if wanted {
            let _ = write!(out, "{derive}, ");
        }
    }
    out.push_str("PartialEq, ");
    if item.eq {
        out.push_str("Eq, ");
    }
    let _ = writeln!(out, "Serialize, Deserialize)]\npub struct {name} {{");
    for field in &message.fields {
        emit_field(out, field, &format!("{}/{}", message.package, message.name))?;
    }
    if message.fields.is_empty() {
        let _ = writeln!(
            out,
            "    /// Always 0; on the wire a message without members is one octet.\n    \
             #[serde(default)]\n    pub {DUMMY}: u8,"
        );
    }
    out.push_str("}\n");
    if manual_default {
        emit_default(out, &name, &message.fields);
    }
    if !message.constants.is_empty() {
        let _ = writeln!(out, "\nimpl {name} {{");
        for constant in &message.constants {
            emit_constant(out, constant);
        }
        out.push_str("}\n");
    }
    let _ = write!(out, "\nimpl crate::Message for {name} {{\n    const TYPE: &'static str = \"{type_name}\";\n}}\n");
    Ok(())
}

fn emit_field(out: &mut String, field: &Field, user: &str) -> Result<(), GenerateError> {
    let unsupported = |got: String, expected| GenerateError::Unsupported {
        user: user.to_owned(),
        field: field.name.clone(),
        got,
        expected,
    };
    if matches!(field.ty.base, Base::WString { .. }) {
        return Err(unsupported("type wstring".to_owned(), "string: middlewares disagree about wstring on the wire"));
    }
    let element = rust_type(&field.ty.base);
    let octets = matches!(field.ty.base, Base::Primitive(Primitive::Byte | Primitive::Char | Primitive::Uint8));
    let comment = match escape(&field.comment) {
        comment if comment.is_empty() => String::new(),
        comment => comment + " ",
    };
    let _ = writeln!(out, "    /// {comment}(`{}`)", field.written_type);
    let (attribute, ty) = match field.ty.arity {
        Arity::One => match field.ty.base {
            Base::String { bound: Some(n) } => {
                (format!("deserialize_with = \"crate::bounded::at_most::<_, _, {n}>\""), element)
            }
            _ => (String::new(), element),
        },
        Arity::Fixed(n) if n > MAX_ARRAY => {
            return Err(unsupported(format!("an array of {n}"), "at most 4096 elements in a fixed array"));
        }
        Arity::Fixed(n) if n > MAX_PLAIN_ARRAY => {
            ("with = \"serde_big_array::BigArray\"".to_owned(), format!("[{element}; {n}]"))
        }
        Arity::Fixed(n) => (String::new(), format!("[{element}; {n}]")),
        Arity::Bounded(n) => {
            (format!("deserialize_with = \"crate::bounded::at_most::<_, _, {n}>\""), format!("Vec<{element}>"))
        }
        Arity::Unbounded if octets => ("with = \"serde_bytes\"".to_owned(), "Vec<u8>".to_owned()),
        Arity::Unbounded => (String::new(), format!("Vec<{element}>")),
    };
    if !attribute.is_empty() {
        let _ = writeln!(out, "    #[serde({attribute})]");
    }
    let _ = writeln!(out, "    pub {}: {ty},", rust_field(&field.name));
    Ok(())
}

fn needs_manual_default(field: &Field) -> bool {
    field.default.as_ref().is_some_and(|value| !is_zero(value))
        || matches!(field.ty.arity, Arity::Fixed(n) if n > MAX_PLAIN_ARRAY)
}

/// True for the value that a derived `Default` gives anyway.
fn is_zero(literal: &Literal) -> bool {
    match literal {
        Literal::Bool(value) => !value,
        Literal::Integer(value) => *value == 0,
        Literal::Float(value) => *value == 0.0 && value.is_sign_positive(),
        Literal::Text(value) => value.is_empty(),
        Literal::List(values) => values.is_empty(),
    }
}

fn emit_default(out: &mut String, name: &str, fields: &[Field]) {
    let _ = writeln!(out, "\nimpl Default for {name} {{\n    fn default() -> Self {{\n        {name} {{");
    for field in fields {
        let value = match (&field.default, field.ty.arity) {
            (Some(Literal::List(elements)), arity) => {
                let elements: Vec<String> =
                    elements.iter().map(|element| owned_value(element, &field.ty.base)).collect();
                let prefix = if matches!(arity, Arity::Fixed(_)) { "" } else { "vec!" };
                format!("{prefix}[{}]", elements.join(", "))
            }
            (Some(value), _) => owned_value(value, &field.ty.base),
            (None, Arity::Fixed(n)) if n > MAX_PLAIN_ARRAY => "std::array::from_fn(|_| Default::default())".to_owned(),
            (None, _) => "Default::default()".to_owned(),
        };
        let _ = writeln!(out, "            {}: {value},", rust_field(&field.name));
    }
    out.push_str("        }\n    }\n}\n");
}

fn emit_constant(out: &mut String, constant: &Constant) {
    let ty = match &constant.base {
        Base::String { .. } | Base::WString { .. } => "&'static str".to_owned(),
        base => rust_type(base),
    };
    let name = &constant.name;
    let comment = match escape(&constant.comment) {
        comment if comment.is_empty() => format!("The constant `{name}`."),
        comment => comment,
    };
    let _ = writeln!(out, "    /// {comment}\n    pub const {name}: {ty} = {};", value(&constant.value));
}

fn value(literal: &Literal) -> String {
    match literal {
        Literal::Bool(value) => value.to_string(),
        Literal::Integer(value) => value.to_string(),
        Literal::Float(value) => format!("{value:?}"),
        Literal::Text(value) => format!("{value:?}"),
        Literal::List(values) => {
            let values: Vec<String> = values.iter().map(self::value).collect();
            format!("[{}]", values.join(", "))
        }
    }
}

fn owned_value(literal: &Literal, base: &Base) -> String {
    match base {
        Base::String { .. } => format!("{}.to_owned()", value(literal)),
        _ => value(literal),
    }
}

fn rust_type(base: &Base) -> String {
    match base {
        Base::Primitive(primitive) => match primitive {
            Primitive::Bool => "bool",
            Primitive::Byte | Primitive::Char | Primitive::Uint8 => "u8",
            Primitive::Int8 => "i8",
            Primitive::Int16 => "i16",
            Primitive::Uint16 => "u16",
            Primitive::Int32 => "i32",
            Primitive::Uint32 => "u32",
            Primitive::Int64 => "i64",
            Primitive::Uint64 => "u64",
            Primitive::Float32 => "f32",
            Primitive::Float64 => "f64",
        }
        .to_owned(),
        // In full, because `std_msgs` has a message `String`.
        Base::String { .. } | Base::WString { .. } => "std::string::String".to_owned(),
        Base::Message { package, name } => {
            // Parts of an action are the only nested messages with an underscore.
            let kind = if name.contains('_') { Kind::Action } else { Kind::Message };
            format!("super::{}::{}", module(package, kind), rust_name(name))
        }
    }
}

/// `Name_Request` becomes `NameRequest`.
fn rust_name(name: &str) -> String {
    name.replace('_', "")
}

fn rust_field(name: &str) -> String {
    const KEYWORDS: [&str; 47] = [
        "abstract", "as", "async", "await", "become", "box", "break", "const", "continue", "do", "dyn", "else", "enum",
        "extern", "false", "final", "fn", "for", "gen", "if", "impl", "in", "let", "loop", "macro", "match", "mod",
        "move", "mut", "override", "priv", "pub", "ref", "return", "static", "struct", "trait", "true", "try", "type",
        "typeof", "unsafe", "unsized", "use", "virtual", "where", "while",
    ];
    match name {
        // These four cannot be raw identifiers; `Self` cannot occur in snake case.
        "self" | "super" | "crate" => format!("{name}_"),
        _ if KEYWORDS.contains(&name) || name == "yield" => format!("r#{name}"),
        _ => name.to_owned(),
    }
}

/// A comment as rustdoc takes it: no links, no tags.
fn escape(comment: &str) -> String {
    let mut out = String::new();
    for c in comment.chars() {
        if matches!(c, '[' | ']' | '<' | '>' | '*' | '`' | '\\') {
            out.push('\\');
        }
        out.push(c);
    }
    out
}
