//! One lesson per ROS domain and namespace on a machine: two would answer each other's questions.

use crate::BringupError;
use std::fs::{File, OpenOptions, TryLockError};
use std::path::Path;

/// The right to teach on a domain; held until dropped.
#[derive(Debug)]
pub struct DomainLock {
    _file: File,
}

impl DomainLock {
    /// Takes the domain, unless another lesson of this user has it. Where locks cannot be had, nothing is guarded.
    ///
    /// # Errors
    /// When another lesson has it.
    pub fn take(folder: &Path, domain: &str, namespace: &str) -> Result<Option<Self>, BringupError> {
        let plain = |text: &str| text.chars().map(|c| if c.is_alphanumeric() { c } else { '-' }).collect::<String>();
        let user = rustix::process::getuid().as_raw();
        let name = format!("apprentice-{user}-domain-{}{}.lock", plain(domain), plain(namespace));
        let Ok(file) = OpenOptions::new().create(true).append(true).open(folder.join(name)) else { return Ok(None) };
        match file.try_lock() {
            Ok(()) => Ok(Some(Self { _file: file })),
            Err(TryLockError::WouldBlock) => {
                let (domain, namespace) = (plain(domain), namespace.to_owned());
                Err(BringupError::DomainInUse { domain, namespace })
            }
            Err(TryLockError::Error(_)) => Ok(None),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::DomainLock;

    #[test]
    fn a_domain_holds_one_lesson_a_namespace_until_it_ends() {
        let folder = tempfile::tempdir().expect("a folder");
        let take = |domain, namespace| DomainLock::take(folder.path(), domain, namespace);
        let first = take("7", "/apprentice").expect("free");
        assert!(first.is_some());
        let error = take("7", "/apprentice").expect_err("taken").to_string();
        assert!(error.contains("domain 7") && error.contains("--domain-id"), "{error}");
        assert!(take("8", "/apprentice").is_ok_and(|lock| lock.is_some()));
        assert!(take("7", "/other").is_ok_and(|lock| lock.is_some()));
        drop(first);
        assert!(take("7", "/apprentice").is_ok());
    }
}
