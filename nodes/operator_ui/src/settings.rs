//! Parameters of the node.

use bus::{NodeSettings, ParameterSpec, Range};
use serde::{Deserialize, Serialize};
use std::net::IpAddr;

/// Parameters of `operator_ui`. None of them is a secret: parameters are published on the graph and recorded in bags.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Settings {
    /// Address to listen on.
    pub bind: String,
    /// Port to listen on; 0 takes any free one.
    pub port: i64,
    /// File holding the token, made with a random one where there is none; empty for a new one at every start.
    pub token_file: String,
    /// File the page's address is written to, token included; empty for none.
    pub url_file: String,
    /// Who answers, as `source` of the evidence.
    pub source: String,
    /// Names under which the page may be reached besides numeric addresses; only away from loopback.
    pub allowed_hosts: Vec<String>,
    /// Pages that may be open at once.
    pub max_pages: i64,
    /// Folder of recorded sessions that a lesson can be taken up from; empty for none.
    pub recordings: String,
    /// Frame that a world is drawn in for RViz: its own, or one that tf knows.
    pub world_frame: String,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            bind: "127.0.0.1".into(),
            port: 8642,
            token_file: String::new(),
            url_file: String::new(),
            source: "operator".into(),
            allowed_hosts: Vec::new(),
            max_pages: 16,
            recordings: String::new(),
            world_frame: "world".into(),
        }
    }
}

impl Settings {
    /// The address to listen on.
    pub(crate) fn address(&self) -> Option<IpAddr> {
        match self.bind.as_str() {
            "localhost" => Some(IpAddr::from([127, 0, 0, 1])),
            other => other.parse().ok(),
        }
    }
}

impl NodeSettings for Settings {
    const NODE: &'static str = "operator_ui";
    const ABOUT: &'static str = "Serves the operator's page: the open question, the person's answer, and the bound";
    const PARAMETERS: &'static [ParameterSpec] = &[
        ParameterSpec { name: "bind", about: "numeric address to listen on, or localhost", range: Range::Any },
        ParameterSpec {
            name: "port",
            about: "port to listen on; 0 takes any free one",
            range: Range::Integer { min: 0, max: 65_535 },
        },
        ParameterSpec {
            name: "token_file",
            about: "file holding the page's token, 16 characters or more, made with a random one if missing; empty: a new \
                    token at every start",
            range: Range::Any,
        },
        ParameterSpec {
            name: "url_file",
            about: "file that the page's address is written to, token included; empty: none",
            range: Range::Any,
        },
        ParameterSpec { name: "source", about: "who answers, as recorded with the evidence", range: Range::Any },
        ParameterSpec {
            name: "allowed_hosts",
            about: "names the page may be reached by besides numeric addresses, when not bound to loopback",
            range: Range::Any,
        },
        ParameterSpec {
            name: "max_pages",
            about: "pages that may be open at once",
            range: Range::Integer { min: 1, max: 256 },
        },
        ParameterSpec {
            name: "recordings",
            about: "folder of recorded sessions that a page may take a lesson up from; empty: none",
            range: Range::Any,
        },
        ParameterSpec {
            name: "world_frame",
            about: "frame that the map of a world has in markers for RViz",
            range: Range::Any,
        },
    ];

    fn check(&self) -> Result<(), String> {
        let Some(address) = self.address() else {
            return Err(format!("bind is '{}'; a numeric address or localhost is needed", self.bind));
        };
        if !address.is_loopback() && self.token_file.is_empty() {
            return Err(format!(
                "bind is '{}', which others can reach; that needs token_file, a file with a token of 16 characters or more",
                self.bind
            ));
        }
        if self.source.is_empty() || self.source.len() > 128 {
            return Err(format!("source has {} characters; 1 to 128 are allowed", self.source.len()));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::Settings;
    use bus::NodeSettings;

    #[test]
    fn the_table_of_parameters_matches_the_settings() {
        bus::testing::check_parameters::<Settings>();
    }

    #[test]
    fn others_may_reach_the_page_only_with_a_token_of_ones_own() {
        let open = Settings { bind: "0.0.0.0".into(), ..Settings::default() };
        assert!(open.check().expect_err("no token").contains("token_file"));
        assert!(Settings { token_file: "t".into(), ..open }.check().is_ok());
        assert!(Settings { bind: "::1".into(), ..Settings::default() }.check().is_ok());
        assert!(Settings { bind: "robot.local".into(), ..Settings::default() }.check().is_err());
    }
}
