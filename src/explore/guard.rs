//! Who is let in: whoever has the token, from a page of this very server.

use axum::http::HeaderMap;
use axum::http::header::{HOST, ORIGIN};
use subtle::ConstantTimeEq;

/// Bytes of chance in a token.
const CHANCE: usize = 24;

/// The token, and the hosts under whose names the server may be asked.
#[derive(Clone, Debug)]
pub struct Guard {
    token: String,
    hosts: Vec<String>,
}

impl Guard {
    /// A new token; `hosts` are names besides those of the machine itself, as behind a proxy.
    ///
    /// # Errors
    /// The operating system gave no random numbers.
    pub fn new(hosts: &[String]) -> Result<Self, getrandom::Error> {
        let mut chance = [0; CHANCE];
        getrandom::fill(&mut chance)?;
        let token = chance.iter().map(|byte| format!("{byte:02x}")).collect();
        Ok(Guard { token, hosts: hosts.iter().map(|host| host.to_ascii_lowercase()).collect() })
    }

    /// The token.
    pub fn token(&self) -> &str {
        &self.token
    }

    /// Whether this is the token, in a time that does not depend on how much of it is right.
    pub fn knows(&self, token: &str) -> bool {
        self.token.as_bytes().ct_eq(token.as_bytes()).into()
    }

    /// Whether a request was sent to a name of this machine, and by a page that came from there.
    ///
    /// A page from elsewhere whose name was made to lead here has another host; one that calls this address has another
    /// origin. What is no browser sends no origin.
    pub fn admits(&self, headers: &HeaderMap) -> bool {
        let text = |name| {
            let mut all = headers.get_all(name).iter();
            match (all.next(), all.next()) {
                (Some(value), None) => value.to_str().ok().map(str::to_ascii_lowercase),
                _ => None,
            }
        };
        let Some(host) = text(HOST) else { return false };
        let Some(name) = name_of(&host) else { return false };
        let own = matches!(name, "localhost" | "127.0.0.1" | "[::1]");
        if !own && !self.hosts.iter().any(|known| known == name) {
            return false;
        }
        if !headers.contains_key(ORIGIN) {
            return true;
        }
        let origin = text(ORIGIN);
        let authority = origin
            .as_deref()
            .and_then(|origin| origin.strip_prefix("http://").or_else(|| origin.strip_prefix("https://")));
        authority == Some(&*host)
    }
}

/// The name in a host with or without a port; none where it is no host.
fn name_of(host: &str) -> Option<&str> {
    let (name, port) = match host.rsplit_once(':') {
        Some((name, port)) if !host.ends_with(']') => (name, Some(port)),
        _ => (host, None),
    };
    let fine = port.is_none_or(|port| port.parse::<u16>().is_ok());
    (fine && !name.is_empty()).then_some(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn headers(host: &str, origin: Option<&str>) -> HeaderMap {
        let mut headers = HeaderMap::new();
        headers.insert(HOST, host.parse().unwrap());
        if let Some(origin) = origin {
            headers.insert(ORIGIN, origin.parse().unwrap());
        }
        headers
    }

    #[test]
    fn only_the_whole_token_opens() {
        let guard = Guard::new(&[]).unwrap();
        let token = guard.token().to_owned();
        assert_eq!(token.len(), 2 * CHANCE);
        assert!(guard.knows(&token));
        for wrong in ["", "x", &token[1..], &format!("{token}0"), &"0".repeat(2 * CHANCE)] {
            assert!(!guard.knows(wrong), "{wrong}");
        }
        assert_ne!(Guard::new(&[]).unwrap().token(), token);
    }

    #[test]
    fn requests_come_from_this_machine() {
        let guard = Guard::new(&["hub.example.org".into()]).unwrap();
        let admitted = [
            ("127.0.0.1:8080", None),
            ("localhost:8080", Some("http://localhost:8080")),
            ("[::1]:8080", Some("http://[::1]:8080")),
            ("localhost", Some("https://localhost")),
            ("hub.example.org", Some("https://hub.example.org")),
            ("HUB.example.org:443", None),
        ];
        for (host, origin) in admitted {
            assert!(guard.admits(&headers(host, origin)), "{host} {origin:?}");
        }
        let kept_out = [
            ("evil.example", None),
            ("evil.example:8080", Some("http://evil.example:8080")),
            ("127.0.0.1.evil.example", None),
            ("127.0.0.1:8080", Some("http://evil.example")),
            ("127.0.0.1:8080", Some("http://127.0.0.1:9090")),
            ("127.0.0.1:8080", Some("null")),
            ("127.0.0.1:8080", Some("file://")),
            ("127.0.0.1:port", None),
            (":8080", None),
            ("localhost@evil.example", None),
        ];
        for (host, origin) in kept_out {
            assert!(!guard.admits(&headers(host, origin)), "{host} {origin:?}");
        }
        assert!(!guard.admits(&HeaderMap::new()));
        let mut twice = headers("localhost", None);
        twice.append(HOST, "evil.example".parse().unwrap());
        assert!(!guard.admits(&twice));
    }
}
