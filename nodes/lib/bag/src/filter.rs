//! Which topics are recorded or played: regular expressions of whole topic names.

use regex::Regex;

/// Why a list of patterns cannot be used.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum FilterError {
    /// Not a regular expression.
    #[error("`{list}`: '{got}' is no regular expression: {why}")]
    Regex {
        /// Which list it is in: `topics` or `exclude`.
        list: &'static str,
        /// The text.
        got: String,
        /// What is wrong with it.
        why: String,
    },
}

/// Takes topics that fit one pattern of `topics` (all, when there is none) and no pattern of `exclude`.
#[derive(Debug, Clone)]
pub struct TopicFilter {
    topics: Vec<Regex>,
    exclude: Vec<Regex>,
}

impl TopicFilter {
    /// Compiles the patterns; each must fit the whole name.
    ///
    /// # Errors
    /// When one is no regular expression.
    pub fn new(topics: &[String], exclude: &[String]) -> Result<TopicFilter, FilterError> {
        Ok(TopicFilter { topics: compile("topics", topics)?, exclude: compile("exclude", exclude)? })
    }

    /// Whether a topic of this name is taken.
    pub fn takes(&self, topic: &str) -> bool {
        let any = |patterns: &[Regex]| patterns.iter().any(|pattern| pattern.is_match(topic));
        (self.topics.is_empty() || any(&self.topics)) && !any(&self.exclude)
    }
}

fn compile(list: &'static str, patterns: &[String]) -> Result<Vec<Regex>, FilterError> {
    let compile_one = |text: &String| {
        Regex::new(&format!("^(?:{text})$")).map_err(|error| FilterError::Regex {
            list,
            got: text.clone(),
            why: error.to_string().lines().last().unwrap_or_default().trim().to_owned(),
        })
    };
    patterns.iter().map(compile_one).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn strings(patterns: &[&str]) -> Vec<String> {
        patterns.iter().map(|text| (*text).to_owned()).collect()
    }

    #[test]
    fn patterns_are_of_whole_names_and_exclusion_wins() {
        let filter = TopicFilter::new(&strings(&["/a/.*", "/scene"]), &strings(&[".*/image"])).expect("they are valid");
        let taken = ["/a/b", "/scene", "/scene2", "/x/scene", "/a/image", "/b"].map(|topic| filter.takes(topic));
        assert_eq!(taken, [true, true, false, false, false, false]);
        assert!(TopicFilter::new(&[], &[]).expect("there are none").takes("/anything"));
    }

    #[test]
    fn a_broken_pattern_is_one_line_that_names_it() {
        let error = TopicFilter::new(&strings(&["/a("]), &[]).expect_err("the group is open").to_string();
        assert!(error.starts_with("`topics`: '/a(' is no regular expression: "), "{error}");
        assert_eq!(error.lines().count(), 1);
    }
}
