//! The QR code of a job: what it is called, and the hash that everything in its kit hangs on.

/// Digits of the hash in the code of the running header, which must stay readable at 15 mm: 64
/// bits.
const HEADER_DIGITS: usize = 16;

/// Digits of the hash in the id that people read aloud: 32 bits.
const ID_DIGITS: usize = 8;

/// A job by its name and the SHA-256 of its `checklist.json`, which holds the hashes of the other
/// files.
#[derive(Debug, Clone, Copy)]
pub struct JobId<'a> {
    /// The job's name.
    pub name: &'a str,
    /// The SHA-256 of the kit's `checklist.json`, hexadecimal.
    pub sha256: &'a str,
}

impl JobId<'_> {
    /// The name with the first digits of the hash: `elephant-3f2a9c01`.
    pub fn short(&self) -> String {
        format!("{}-{}", self.name, digits(self.sha256, ID_DIGITS))
    }

    /// What the code on the cover says.
    pub fn text(&self) -> String {
        format!("EQUIPOISE {} SHA256 {}", self.name, self.sha256)
    }

    /// What the code on every page says: the same with the first 16 digits of the hash.
    pub fn header_text(&self) -> String {
        format!(
            "EQUIPOISE {} SHA256 {}",
            self.name,
            digits(self.sha256, HEADER_DIGITS)
        )
    }
}

/// The first digits of a hash.
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
