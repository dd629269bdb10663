//! The identity of a job: its name, and the hash on which everything in its kit depends.

/// Digits of the hash in the QR code of the running header, which must stay readable at 15 mm: 64
/// bits.
const HEADER_DIGITS: usize = 16;

/// Digits of the hash in the id that people read aloud: 32 bits.
const ID_DIGITS: usize = 8;

/// A job by its name and the SHA-256 of its `checklist.json`, which holds the hashes of the other
/// files.
#[derive(Debug, Clone, Copy)]
pub struct JobId<'a> {
    /// Name of the job.
    pub name: &'a str,
    /// SHA-256 of the kit's `checklist.json`, hexadecimal.
    pub sha256: &'a str,
}

impl JobId<'_> {
    /// Returns the name with the first digits of the hash: `elephant-3f2a9c01`.
    pub fn short(&self) -> String {
        format!("{}-{}", self.name, digits(self.sha256, ID_DIGITS))
    }

    /// Returns the text of the QR code on the cover.
    pub fn text(&self) -> String {
        format!("EQUIPOISE {} SHA256 {}", self.name, self.sha256)
    }

    /// Returns the text of the QR code on every page, with the first 16 digits of the hash.
    pub fn header_text(&self) -> String {
        format!(
            "EQUIPOISE {} SHA256 {}",
            self.name,
            digits(self.sha256, HEADER_DIGITS)
        )
    }
}

/// Returns the first digits of a hash.
fn digits(sha256: &str, count: usize) -> &str {
    sha256.get(..count).unwrap_or(sha256)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_id_is_the_name_with_the_first_digits_of_the_hash() {
        let hash = "0123456789abcdef".repeat(4);
        let job = JobId {
            name: "box",
            sha256: &hash,
        };
        assert_eq!(job.short(), "box-01234567");
        assert!(job.text().ends_with(&hash) && job.header_text().ends_with(" 0123456789abcdef"));
    }
}
