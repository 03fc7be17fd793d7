//! SHA-256, by which outputs name the inputs that they were made from.

use std::fmt;

use sha2::{Digest, Sha256};

/// SHA-256 of `bytes` in hexadecimal, as `sha256sum` prints it.
#[must_use]
pub fn sha256(bytes: &[u8]) -> String {
    hexadecimal(&Sha256::digest(bytes))
}

/// SHA-256 in hexadecimal of what `write` writes, which is never held as a whole.
pub(crate) fn sha256_of(
    write: impl FnOnce(&mut dyn fmt::Write) -> fmt::Result,
) -> Result<String, fmt::Error> {
    /// What is written, as far as it is hashed.
    struct Hashed(Sha256);
    impl fmt::Write for Hashed {
        fn write_str(&mut self, text: &str) -> fmt::Result {
            self.0.update(text.as_bytes());
            Ok(())
        }
    }
    let mut hashed = Hashed(Sha256::new());
    write(&mut hashed)?;
    Ok(hexadecimal(&hashed.0.finalize()))
}

pub(super) fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    #[test]
    fn it_is_what_sha256sum_prints() {
        let empty = "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855";
        assert_eq!(super::sha256(b""), empty, "of nothing");
    }
}
