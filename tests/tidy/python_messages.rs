//! The messages that the Python peer declares have the members of the interface files, in their order.

use crate::files;

/// Members of a message definition: no constants, no comments.
fn members(definition: &str) -> Vec<String> {
    let lines = definition.lines().map(|line| line.split('#').next().unwrap_or("").trim());
    // A bound of a sequence is no constant.
    let fields = lines.filter(|line| !line.is_empty() && !line.replace("<=", "").contains('='));
    fields.filter_map(|line| Some(line.split_whitespace().nth(1)?.to_owned())).collect()
}

/// Name and members of each message of ours in the Python file.
fn declared(python: &str) -> Vec<(String, Vec<String>)> {
    let mut found: Vec<(String, Vec<String>)> = Vec::new();
    let mut ours = false;
    for line in python.lines() {
        if line.starts_with("class ") {
            let name = line.split("apprentice_msgs::msg::dds_::").nth(1).and_then(|rest| rest.split("_\"").next());
            ours = name.is_some();
            found.extend(name.map(|name| (name.to_owned(), Vec::new())));
        } else if let (true, Some((member, _)), Some(last)) = (ours, line.trim().split_once(": "), found.last_mut()) {
            last.1.push(member.to_owned());
        }
    }
    found
}

#[test]
fn the_peer_declares_the_messages_as_they_are() {
    let python = std::fs::read_to_string(files::top().join("tests/python/messages.py")).expect("it is there");
    let declared = declared(&python);
    assert!(declared.len() >= 20, "{declared:?}");
    for (name, found) in declared {
        let path = files::top().join(format!("msgs/msg/{name}.msg"));
        let definition = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        assert_eq!(found, members(&definition), "{name}");
    }
}
