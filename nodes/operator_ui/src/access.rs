//! Who may use the page: those who reach it under a name of its own, from a page of its own, with the token.
//!
//! The Host check defeats DNS rebinding (a foreign name that resolves to this machine), the Origin check keeps other
//! sites' scripts from opening the socket, and the token keeps other users of the machine out.

use std::net::{IpAddr, Ipv6Addr};
use subtle::ConstantTimeEq;
use thiserror::Error;

/// A token of one's own must be at least this long.
const MIN_TOKEN: usize = 16;
/// A longer one is refused.
const MAX_TOKEN: usize = 256;

/// Why a token cannot be used, or a request is turned away.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum AccessError {
    /// The token is too short or too long.
    #[error("the token has {got} characters; {MIN_TOKEN} to {MAX_TOKEN} are needed")]
    TokenLength {
        /// Its length.
        got: usize,
    },
    /// The token has characters that do not fit an address.
    #[error("the token holds something else than letters, digits, '-', '.', '_' and '~'")]
    TokenCharacters,
    /// No random token can be had.
    #[error("the system gives no random numbers: {0}")]
    Random(String),
    /// The page was reached under a foreign name.
    #[error("this page is not served under the name '{0}'")]
    Host(String),
    /// The request comes from another site.
    #[error("requests from '{0}' are not answered here")]
    Origin(String),
    /// The token is missing or wrong.
    #[error("the token is missing or wrong; open the address that the operator page's start printed")]
    Token,
}

/// The rules.
#[derive(Clone)]
pub struct Access {
    token: String,
    is_loopback: bool,
    allowed_hosts: Vec<String>,
    cookie: String,
}

impl Access {
    /// Rules for a page at an address and port; without a token of its own it gets a random one of 128 bits.
    pub fn new(token: Option<&str>, bind: IpAddr, port: u16, allowed_hosts: &[String]) -> Result<Self, AccessError> {
        let token = match token {
            None => random_token()?,
            Some(token) if !(MIN_TOKEN..=MAX_TOKEN).contains(&token.len()) => {
                return Err(AccessError::TokenLength { got: token.len() });
            }
            Some(token) if !token.bytes().all(|b| b.is_ascii_alphanumeric() || b"-._~".contains(&b)) => {
                return Err(AccessError::TokenCharacters);
            }
            Some(token) => token.to_owned(),
        };
        Ok(Self {
            token,
            is_loopback: bind.is_loopback(),
            allowed_hosts: allowed_hosts.iter().map(|host| host.to_ascii_lowercase()).collect(),
            // Cookies do not keep ports apart, so the name does.
            cookie: format!("apprentice_{port}"),
        })
    }

    /// The query string that opens the page.
    pub fn query(&self) -> String {
        format!("token={}", self.token)
    }

    /// The cookie that stands for the token from then on.
    pub(crate) fn set_cookie(&self) -> String {
        format!("{}={}; Path=/; HttpOnly; SameSite=Strict", self.cookie, self.token)
    }

    /// Checks the Host header.
    pub(crate) fn check_host(&self, host: Option<&str>) -> Result<(), AccessError> {
        let host = host.unwrap_or_default();
        let name = name_of(host).to_ascii_lowercase();
        let address: Option<IpAddr> = match name.strip_prefix('[').and_then(|rest| rest.strip_suffix(']')) {
            Some(v6) => v6.parse::<Ipv6Addr>().ok().map(IpAddr::V6),
            None => name.parse().ok(),
        };
        let good = match address {
            // A numeric address is resolved by nobody, so it cannot be rebound.
            Some(address) => address.is_loopback() || !self.is_loopback,
            None => name == "localhost" || (!self.is_loopback && self.allowed_hosts.contains(&name)),
        };
        if good { Ok(()) } else { Err(AccessError::Host(host.chars().take(100).collect())) }
    }

    /// Checks the Origin header against the Host header. Requests of no page have no origin, which does for what only
    /// reads and not for the socket.
    pub(crate) fn check_origin(
        &self,
        origin: Option<&str>,
        host: Option<&str>,
        is_needed: bool,
    ) -> Result<(), AccessError> {
        let Some(origin) = origin else {
            return if is_needed { Err(AccessError::Origin("nowhere".into())) } else { Ok(()) };
        };
        let own = origin.strip_prefix("http://").or(origin.strip_prefix("https://"));
        match (own, host) {
            (Some(own), Some(host)) if own.eq_ignore_ascii_case(host) => Ok(()),
            _ => Err(AccessError::Origin(origin.chars().take(100).collect())),
        }
    }

    /// Checks the token in the query string or the cookie, in constant time.
    pub(crate) fn check_token(&self, query: Option<&str>, cookies: Option<&str>) -> Result<(), AccessError> {
        let fits = |given: &str| bool::from(given.as_bytes().ct_eq(self.token.as_bytes()));
        let pair = |pairs: &str, separator: char, name: &str| -> bool {
            let mut pairs = pairs.split(separator).filter_map(|pair| pair.trim().split_once('='));
            pairs.any(|(key, value)| key == name && fits(value))
        };
        let good = query.is_some_and(|q| pair(q, '&', "token")) || cookies.is_some_and(|c| pair(c, ';', &self.cookie));
        if good { Ok(()) } else { Err(AccessError::Token) }
    }
}

/// 128 random bits, hex.
pub(crate) fn random_token() -> Result<String, AccessError> {
    let mut bytes = [0_u8; 16];
    getrandom::fill(&mut bytes).map_err(|error| AccessError::Random(error.to_string()))?;
    Ok(bytes.iter().map(|byte| format!("{byte:02x}")).collect())
}

impl std::fmt::Debug for Access {
    /// Without the token.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Access").field("is_loopback", &self.is_loopback).finish_non_exhaustive()
    }
}

/// The host of "host:port", brackets of an IPv6 address kept.
fn name_of(host: &str) -> &str {
    match host.rfind(':') {
        Some(colon) if !host[colon..].contains(']') => &host[..colon],
        _ => host,
    }
}

#[cfg(test)]
mod tests {
    use super::{Access, AccessError};
    use std::net::IpAddr;

    fn access(bind: [u8; 4]) -> Access {
        let hosts = ["Robot.local".to_owned()];
        Access::new(Some("abcdefghijklmnop"), IpAddr::from(bind), 8642, &hosts).expect("the token is good")
    }

    #[test]
    fn a_page_on_loopback_answers_to_loopback_names_only() {
        let access = access([127, 0, 0, 1]);
        for good in ["127.0.0.1:8642", "localhost:9000", "LOCALHOST", "[::1]:8642", "127.0.0.1"] {
            assert_eq!(access.check_host(Some(good)), Ok(()), "{good}");
        }
        for bad in
            ["evil.example:8642", "192.168.1.2:8642", "robot.local", "", "localhost.evil.example", "[::2]:1", "::1"]
        {
            assert!(access.check_host(Some(bad)).is_err(), "{bad}");
        }
        assert!(access.check_host(None).is_err());
    }

    #[test]
    fn a_page_for_others_answers_to_numbers_and_listed_names() {
        let access = access([0, 0, 0, 0]);
        for good in ["192.168.1.2:8642", "robot.LOCAL:8642", "localhost:8642"] {
            assert_eq!(access.check_host(Some(good)), Ok(()), "{good}");
        }
        assert!(access.check_host(Some("evil.example:8642")).is_err());
    }

    #[test]
    fn an_origin_must_be_the_page_itself() {
        let access = access([127, 0, 0, 1]);
        let host = Some("127.0.0.1:8642");
        assert!(access.check_origin(Some("http://127.0.0.1:8642"), host, true).is_ok());
        assert!(access.check_origin(None, host, false).is_ok());
        for bad in ["http://evil.example", "http://127.0.0.1:3000", "null", "http://127.0.0.1:86420", "file://"] {
            assert!(access.check_origin(Some(bad), host, false).is_err(), "{bad}");
        }
        assert!(access.check_origin(None, host, true).is_err());
    }

    #[test]
    fn a_token_is_taken_from_query_or_own_cookie_only() {
        let access = access([127, 0, 0, 1]);
        assert!(access.check_token(Some("a=b&token=abcdefghijklmnop"), None).is_ok());
        assert!(access.check_token(None, Some("x=1; apprentice_8642=abcdefghijklmnop")).is_ok());
        for (query, cookie) in [
            (None, None),
            (Some("token="), None),
            (Some("token=abcdefghijklmno"), None),
            (Some("token=abcdefghijklmnopq"), None),
            (Some("nottoken=abcdefghijklmnop"), None),
            (None, Some("apprentice_8643=abcdefghijklmnop")),
        ] {
            assert_eq!(access.check_token(query, cookie), Err(AccessError::Token));
        }
    }

    #[test]
    fn tokens_are_random_unless_given_and_never_shown() {
        let fresh = || Access::new(None, IpAddr::from([127, 0, 0, 1]), 1, &[]).expect("there are random numbers");
        let (a, b) = (fresh(), fresh());
        assert_ne!(a.query(), b.query());
        assert_eq!(a.query().len(), "token=".len() + 32);
        assert!(!format!("{a:?}").contains(&a.query()[6..]));
        let given = |token| Access::new(Some(token), IpAddr::from([127, 0, 0, 1]), 1, &[]).map(|_| ());
        assert_eq!(given("short"), Err(AccessError::TokenLength { got: 5 }));
        assert_eq!(given("with space in it, long"), Err(AccessError::TokenCharacters));
    }
}
