//! ROS 2 interface definitions (`.msg`, `.srv`, `.action`) as data.

mod error;
mod literal;
mod parse;

pub use error::{InterfaceError, Problem};
pub use parse::{parse_action, parse_message, parse_service};

/// Longest definition text that is read, bytes.
pub const MAX_TEXT_BYTES: usize = 1 << 20;
/// Most fields, and most constants, that one message may have.
pub const MAX_MEMBERS: usize = 4096;

/// A primitive type of the interface language.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Primitive {
    /// One octet, 0 or 1.
    Bool,
    /// One octet without arithmetic meaning.
    Byte,
    /// One unsigned octet (not a code point).
    Char,
    /// Signed, 8 bits.
    Int8,
    /// Unsigned, 8 bits.
    Uint8,
    /// Signed, 16 bits.
    Int16,
    /// Unsigned, 16 bits.
    Uint16,
    /// Signed, 32 bits.
    Int32,
    /// Unsigned, 32 bits.
    Uint32,
    /// Signed, 64 bits.
    Int64,
    /// Unsigned, 64 bits.
    Uint64,
    /// IEEE 754 single.
    Float32,
    /// IEEE 754 double.
    Float64,
}

impl Primitive {
    /// All of them, with their names in the interface language.
    pub const ALL: [(&'static str, Primitive); 13] = [
        ("bool", Primitive::Bool),
        ("byte", Primitive::Byte),
        ("char", Primitive::Char),
        ("int8", Primitive::Int8),
        ("uint8", Primitive::Uint8),
        ("int16", Primitive::Int16),
        ("uint16", Primitive::Uint16),
        ("int32", Primitive::Int32),
        ("uint32", Primitive::Uint32),
        ("int64", Primitive::Int64),
        ("uint64", Primitive::Uint64),
        ("float32", Primitive::Float32),
        ("float64", Primitive::Float64),
    ];

    /// The least and the greatest value of an integer type; `None` for bool and floats.
    pub fn integer_range(self) -> Option<(i128, i128)> {
        Some(match self {
            Primitive::Byte | Primitive::Char | Primitive::Uint8 => (0, u8::MAX.into()),
            Primitive::Int8 => (i8::MIN.into(), i8::MAX.into()),
            Primitive::Int16 => (i16::MIN.into(), i16::MAX.into()),
            Primitive::Uint16 => (0, u16::MAX.into()),
            Primitive::Int32 => (i32::MIN.into(), i32::MAX.into()),
            Primitive::Uint32 => (0, u32::MAX.into()),
            Primitive::Int64 => (i64::MIN.into(), i64::MAX.into()),
            Primitive::Uint64 => (0, u64::MAX.into()),
            Primitive::Bool | Primitive::Float32 | Primitive::Float64 => return None,
        })
    }
}

/// What one element of a field is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Base {
    /// A number or a bool.
    Primitive(Primitive),
    /// UTF-8 text of at most `bound` bytes.
    String {
        /// Bytes; `None`: no bound.
        bound: Option<usize>,
    },
    /// UTF-16 text of at most `bound` units.
    WString {
        /// Units; `None`: no bound.
        bound: Option<usize>,
    },
    /// Another message; a name without a package was resolved to the package of its user.
    Message {
        /// Package that defines it.
        package: String,
        /// Its name, without package.
        name: String,
    },
}

/// How many elements a field has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Arity {
    /// Exactly one: no array.
    One,
    /// `T[n]`: always `n`.
    Fixed(usize),
    /// `T[<=n]`: at most `n`.
    Bounded(usize),
    /// `T[]`: any number.
    Unbounded,
}

/// Type of a field.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FieldType {
    /// What one element is.
    pub base: Base,
    /// How many there are.
    pub arity: Arity,
}

/// A value written in a definition.
#[derive(Debug, Clone, PartialEq)]
pub enum Literal {
    /// `true` or `false`.
    Bool(bool),
    /// Any integer type; within the type's range.
    Integer(i128),
    /// `float32` or `float64`.
    Float(f64),
    /// Text without its quotes.
    Text(String),
    /// Default of an array field.
    List(Vec<Literal>),
}

/// A member that is transmitted.
#[derive(Debug, Clone, PartialEq)]
pub struct Field {
    /// Its name, `snake_case`.
    pub name: String,
    /// Its type.
    pub ty: FieldType,
    /// The type as it is written in the definition.
    pub written_type: String,
    /// Value of a new message; `None`: zero, empty, or the default of the nested message.
    pub default: Option<Literal>,
    /// Comment on the same line; may be empty.
    pub comment: String,
}

/// A named value; not transmitted.
#[derive(Debug, Clone, PartialEq)]
pub struct Constant {
    /// Its name, `UPPER_CASE`.
    pub name: String,
    /// Its type: a primitive or a string.
    pub base: Base,
    /// Its value.
    pub value: Literal,
    /// Comment on the same line; may be empty.
    pub comment: String,
}

/// One message: what a `.msg` file, or a part of a `.srv` or `.action` file, defines.
#[derive(Debug, Clone, PartialEq)]
pub struct Message {
    /// Package it belongs to.
    pub package: String,
    /// Its name without package; parts of services and actions are `Name_Request` and so on.
    pub name: String,
    /// Comment lines before its first member.
    pub comment: Vec<String>,
    /// In order of transmission.
    pub fields: Vec<Field>,
    /// In order of the file.
    pub constants: Vec<Constant>,
}

/// What a `.srv` file defines.
#[derive(Debug, Clone, PartialEq)]
pub struct Service {
    /// `Name_Request`.
    pub request: Message,
    /// `Name_Response`.
    pub response: Message,
}

/// What an `.action` file defines.
#[derive(Debug, Clone, PartialEq)]
pub struct Action {
    /// `Name_Goal`.
    pub goal: Message,
    /// `Name_Result`.
    pub result: Message,
    /// `Name_Feedback`.
    pub feedback: Message,
}
