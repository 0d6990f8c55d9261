//! The interface language: what is read, and what is refused with which words.

use apprentice_msgs::interface::{
    Arity, Base, InterfaceError, Literal, MAX_TEXT_BYTES, Message, Primitive, parse_action, parse_message,
    parse_service,
};
use proptest::prelude::*;

fn read(text: &str) -> Result<Message, InterfaceError> {
    parse_message("pkg", "Name", "Name.msg", text)
}

fn refused(text: &str) -> String {
    read(text).expect_err(text).to_string()
}

#[test]
fn comments_fields_and_constants_are_told_apart() {
    let text = "# Heading,\n# two lines.\n\nint32 X=-0x10 # why\n# between\nfloat64[3]\tx  # metres\r\n";
    let message = read(text).expect("good");
    assert_eq!(message.comment, ["Heading,", "two lines."]);
    assert_eq!(message.constants[0].value, Literal::Integer(-16));
    assert_eq!(message.constants[0].comment, "why");
    let field = &message.fields[0];
    assert_eq!((field.name.as_str(), field.ty.arity), ("x", Arity::Fixed(3)));
    assert_eq!(field.comment, "metres");
}

#[test]
fn every_form_of_type_is_read() {
    let text = "string a\nstring<=5 b\nwstring<=7[] c\nstring<=4[<=2] d\nOther e\nfoo/Bar[<=9] f\nfoo/msg/Bar g\n";
    let message = read(text).expect("good");
    let types: Vec<_> = message.fields.iter().map(|field| (field.ty.base.clone(), field.ty.arity)).collect();
    let other = |package: &str, name: &str| Base::Message { package: package.to_owned(), name: name.to_owned() };
    let expected = [
        (Base::String { bound: None }, Arity::One),
        (Base::String { bound: Some(5) }, Arity::One),
        (Base::WString { bound: Some(7) }, Arity::Unbounded),
        (Base::String { bound: Some(4) }, Arity::Bounded(2)),
        (other("pkg", "Other"), Arity::One),
        (other("foo", "Bar"), Arity::Bounded(9)),
        (other("foo", "Bar"), Arity::One),
    ];
    assert_eq!(types, expected);
    for (name, primitive) in Primitive::ALL {
        let message = read(&format!("{name} x")).expect(name);
        assert_eq!(message.fields[0].ty.base, Base::Primitive(primitive));
    }
}

#[test]
fn defaults_take_quotes_lists_and_hashes() {
    let text = r##"string a "x # \"y\"" # comment
string b 'it''s'
"##;
    assert!(refused(text).starts_with("Name.msg:2: got value `'it''s'`"));
    let text = r##"string a "x # \"y\"" # comment
string[] b ["p,q", 'r'] # two
uint8[<=3] c [1, 0x02]
bool d TRUE
float32 e -1.5e3
string f plain words # cut
string G="a=b"
string h ""
"##;
    let message = read(text).expect("good");
    let defaults: Vec<_> = message.fields.iter().map(|f| f.default.clone()).collect();
    let words = |text: &str| Literal::Text(text.to_owned());
    let expected = [
        words("x # \"y\""),
        Literal::List(vec![words("p,q"), words("r")]),
        Literal::List(vec![Literal::Integer(1), Literal::Integer(2)]),
        Literal::Bool(true),
        Literal::Float(-1500.0),
        words("plain words"),
        words(""),
    ];
    assert_eq!(defaults, expected.map(Some));
    assert_eq!(message.constants[0].value, words("a=b"));
}

#[test]
fn values_that_the_type_cannot_hold_are_refused() {
    for line in [
        "uint8 X=256",
        "int8 X=-129",
        "uint64 X=-1",
        "int32 X=1.5",
        "int32 X=",
        "bool X=yes",
        "float32 X=1e39",
        "float64 X=nan",
        "string<=2 X=abc",
        "uint8[2] x [1]",
        "uint8[<=1] x [1, 2]",
        "uint8[] x 1",
        "Other x 1",
        "string x \"open",
        "int32 X=--5",
        "int32 X=0x-5",
    ] {
        let error = refused(line);
        assert!(error.starts_with("Name.msg:1: got value"), "{line}: {error}");
    }
    assert!(read("uint64 X=18446744073709551615\nint64 Y=-9223372036854775808").is_ok());
}

#[test]
fn lines_outside_the_grammar_are_refused() {
    for line in [
        "int32",
        "int32 ",
        "int32 2x",
        "int32 Camel",
        "int32 a__b",
        "int32 a_",
        "int32 a:b",
        "int32[ x",
        "int32[0] x",
        "int32[-1] x",
        "int32[99999999999] x",
        "int32[<=] x",
        "int32[<3] x",
        "int32] x",
        "int32<=3 x",
        "string<=0 x",
        "int x",
        "a/b/C x",
        "A/B x",
        "int32 lower=3",
        "int32[2] X=3",
        "Other X=3",
        "é x",
    ] {
        let error = refused(line);
        assert!(error.starts_with("Name.msg:1: got `"), "{line}: {error}");
        assert!(error.contains("expected"), "{line}: {error}");
    }
    assert_eq!(refused("int32 x\nint32 x"), "Name.msg:2: got `x` a second time, expected every name once");
}

#[test]
fn sections_are_counted() {
    let service = parse_service("pkg", "Ask", "Ask.srv", "int32 x\n---\nint32 x\n").expect("good");
    assert_eq!(service.request.name, "Ask_Request");
    assert_eq!(service.response.fields.len(), 1);
    let error = parse_service("pkg", "Ask", "Ask.srv", "int32 x").expect_err("one section");
    assert_eq!(error.to_string(), "Ask.srv:0: got 1 sections separated by `---`, expected 2");
    assert!(read("---").is_err());
    let action = "# Go there.\nfloat64 x\n---\n# How it went.\nbool done\n---\nfloat64 left # metres\n";
    let action = parse_action("pkg", "Go", "Go.action", action).expect("good");
    assert_eq!(action.goal.comment, ["Go there."]);
    assert_eq!(action.result.name, "Go_Result");
    assert_eq!(action.feedback.fields[0].comment, "metres");
}

#[test]
fn size_is_limited() {
    let long = "#".repeat(MAX_TEXT_BYTES + 1);
    assert!(refused(&long).contains("expected at most 1048576"));
    let many: String = (0..5000).map(|n| format!("int8 x{n}\n")).collect();
    assert!(refused(&many).contains("more than 4096"));
    let elements = format!("uint8[] x [{}]", "1,".repeat(5000));
    assert!(refused(&elements).starts_with("Name.msg:1: got value"));
}

proptest! {
    #[test]
    fn any_text_is_read_or_refused(text in "\\PC*") {
        let _ = read(&text);
    }

    #[test]
    fn plausible_lines_are_read_or_refused(
        text in "(string|uint8|foo/Bar|wstring)(<=[0-9]{1,3})?(\\[(<=)?[0-9]{0,3}\\])?[ \t]{0,2}[a-zX_]{0,3}[ =]{0,2}[\\[\"'#a-z0-9.,\\]\\\\ é]{0,12}"
    ) {
        let _ = read(&text);
    }

    #[test]
    fn integers_are_read_as_written(value: i64) {
        let message = read(&format!("int64 X={value}")).expect("in range");
        prop_assert_eq!(&message.constants[0].value, &Literal::Integer(value.into()));
    }
}
