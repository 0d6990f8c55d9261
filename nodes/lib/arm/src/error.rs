//! Everything that can be wrong with a robot description; each message names the element, where it stands and what to do.

use thiserror::Error;

/// Why a URDF text is no robot. `line` counts from 1.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum UrdfError {
    /// Refused before parsing.
    #[error("the robot description has {got} bytes; at most {max} are read: simplify it or remove embedded data")]
    TooLarge {
        /// Got.
        got: usize,
        /// Allowed.
        max: usize,
    },
    /// Refused before parsing.
    #[error("line {line}: elements are nested more than {max} deep; a URDF needs fewer than ten: is this a URDF?")]
    TooDeep {
        /// Where.
        line: usize,
        /// Allowed.
        max: usize,
    },
    /// Refused before parsing.
    #[error("line {line}: more than {max} {what}; simplify the robot description")]
    TooMany {
        /// Where the limit was passed.
        line: usize,
        /// "elements", "links", "joints", "collision shapes" or "attributes on one element".
        what: &'static str,
        /// Allowed.
        max: usize,
    },
    /// Not well-formed XML.
    #[error("line {line}: not well-formed XML: {problem}")]
    Xml {
        /// Where.
        line: usize,
        /// The parser's words.
        problem: String,
    },
    /// Documents with their own entities are refused: they can grow without bound.
    #[error("line {line}: a document type declaration is not allowed in a robot description; remove <!DOCTYPE …>")]
    Doctype {
        /// Where.
        line: usize,
    },
    /// The text is a macro file, not its result.
    #[error("line {line}: <{element}> is a xacro macro; expand the file first: xacro FILE > robot.urdf")]
    Xacro {
        /// Where.
        line: usize,
        /// The element.
        element: String,
    },
    /// The outermost element is something else.
    #[error("line {line}: the outermost element is <{got}>, expected <robot>: is this a URDF?")]
    NotARobot {
        /// Where.
        line: usize,
        /// Got.
        got: String,
    },
    /// The text holds no element, or the robot no link.
    #[error("the robot description holds no link; add at least one <link name=\"…\"/> inside <robot>")]
    Empty,
    /// A required attribute is not there.
    #[error("line {line}: <{element}> lacks the attribute '{attribute}'")]
    MissingAttribute {
        /// Where.
        line: usize,
        /// The element.
        element: String,
        /// The attribute.
        attribute: &'static str,
    },
    /// A required child element is not there.
    #[error("line {line}: {parent} lacks <{element}>")]
    MissingElement {
        /// Where the parent starts.
        line: usize,
        /// The parent, with its name.
        parent: String,
        /// What is missing.
        element: &'static str,
    },
    /// A number is none, not finite, or beyond reason; or a vector has another length.
    #[error("line {line}: {attribute}=\"{got}\" of <{element}> in {owner}: expected {expected}")]
    Number {
        /// Where.
        line: usize,
        /// The element.
        element: Box<str>,
        /// The attribute.
        attribute: Box<str>,
        /// "link 'name'" or "joint 'name'".
        owner: Box<str>,
        /// The text found, shortened.
        got: Box<str>,
        /// What belongs there.
        expected: Box<str>,
    },
    /// A type that URDF does not have.
    #[error(
        "line {line}: joint '{joint}' has the type '{got}'; expected revolute, continuous, prismatic, fixed, floating or planar"
    )]
    JointType {
        /// Where.
        line: usize,
        /// Name.
        joint: String,
        /// Got.
        got: String,
    },
    /// Sizes must be positive.
    #[error("line {line}: the <{shape}> of link '{link}' has a size of {got}; every extent must lie above 0")]
    Size {
        /// Where the link starts.
        line: usize,
        /// Name.
        link: String,
        /// "box", "cylinder", "capsule" or "sphere".
        shape: &'static str,
        /// Got.
        got: f64,
    },
    /// A collision mesh that cannot be had, or is none.
    #[error(
        "line {line}: the collision mesh of link '{link}' cannot be used: {file}: {problem}; \
         give it, or accept a bounding shape in its place"
    )]
    Mesh {
        /// Where the collision element starts.
        line: usize,
        /// Name.
        link: Box<str>,
        /// The mesh.
        file: Box<str>,
        /// Why not.
        problem: Box<str>,
    },
    /// Names must be unique.
    #[error("line {line}: the {what} name '{name}' is used twice (first on line {first}); rename one of them")]
    Duplicate {
        /// Where the second starts.
        line: usize,
        /// "link" or "joint".
        what: &'static str,
        /// The name.
        name: String,
        /// Where the first starts.
        first: usize,
    },
    /// A joint hangs on a link that is not there.
    #[error(
        "line {line}: joint '{joint}' has the {role} link '{link}', which does not exist; add it or correct the name"
    )]
    MissingLink {
        /// Where the joint starts.
        line: usize,
        /// Name.
        joint: String,
        /// "parent" or "child".
        role: &'static str,
        /// The name that leads nowhere.
        link: String,
    },
    /// A link is held by two joints.
    #[error(
        "line {line}: link '{link}' is the child of joint '{first}' and of joint '{second}'; a URDF must be a tree"
    )]
    TwoParents {
        /// Where the second joint starts.
        line: usize,
        /// The link.
        link: String,
        /// The joint that came first.
        first: String,
        /// The other.
        second: String,
    },
    /// Joints lead back to where they started.
    #[error("line {line}: link '{link}' hangs, joint by joint, on itself; a URDF must be a tree without loops")]
    Loop {
        /// Where the link starts.
        line: usize,
        /// One link of the loop.
        link: String,
    },
    /// Parts are not connected.
    #[error("the robot has {n} roots ('{first}' and '{second}' among them); join all links by joints into one tree")]
    SeveralRoots {
        /// How many.
        n: usize,
        /// One.
        first: String,
        /// Another.
        second: String,
    },
    /// An axis needs a direction.
    #[error("line {line}: joint '{joint}' has the axis (0, 0, 0); give the direction it turns about or slides along")]
    ZeroAxis {
        /// Where the joint starts.
        line: usize,
        /// Name.
        joint: String,
    },
    /// The range is empty.
    #[error("line {line}: joint '{joint}' has lower limit {lower} above upper limit {upper}; swap them")]
    LimitsReversed {
        /// Where the joint starts.
        line: usize,
        /// Name.
        joint: String,
        /// Got.
        lower: f64,
        /// Got.
        upper: f64,
    },
    /// A speed has no sign.
    #[error("line {line}: joint '{joint}' has the velocity limit {got}; it must not lie below 0")]
    Velocity {
        /// Where the joint starts.
        line: usize,
        /// Name.
        joint: String,
        /// Got.
        got: f64,
    },
    /// A follower without a leader.
    #[error("line {line}: joint '{joint}' mimics '{leader}', which is no moving joint; correct the name")]
    MimicUnknown {
        /// Where the joint starts.
        line: usize,
        /// Name.
        joint: String,
        /// The name that leads nowhere.
        leader: String,
    },
    /// Followers that lead each other.
    #[error("line {line}: joint '{joint}' mimics, joint by joint, itself; one joint must lead")]
    MimicLoop {
        /// Where the joint starts.
        line: usize,
        /// Name.
        joint: String,
    },
    /// Well-formed XML that is no URDF in a way the checks above do not name.
    #[error("the robot description does not follow the URDF format: {problem}")]
    Format {
        /// The parser's words.
        problem: String,
    },
}

impl UrdfError {
    /// Where it is wrong, from 1; 0 when no line is to blame.
    pub fn line(&self) -> usize {
        let message = self.to_string();
        let digits = message.strip_prefix("line ").and_then(|rest| rest.split_once(':'));
        digits.and_then(|(digits, _)| digits.parse().ok()).unwrap_or(0)
    }
}
