//! The file that a replayed job reads: the copy in its kit, or one that lies beside the job.

use std::path::{Path, PathBuf};

use crate::base::digest::sha256_hex;
use crate::verify::find_model;

/// Returns the file beside a job that has the bytes of the one it names; `None` if there is none.
///
/// `sha256` is the hash that the job is bound to. A job that is bound to no bytes reads the file it
/// names, unless that name leads nowhere.
pub fn copy_beside(job: &Path, named: &Path, sha256: Option<&str>) -> Option<PathBuf> {
    let folder = job.parent()?;
    let beside = named.file_name().map(|name| folder.join(name));
    let mut candidates = find_model(folder).into_iter().chain(beside);
    candidates.find(|path| match sha256 {
        Some(sha256) => std::fs::read(path).is_ok_and(|bytes| sha256_hex(&[&bytes]) == sha256),
        None => !named.exists() && path.is_file(),
    })
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn a_job_reads_the_file_beside_it_only_with_the_bytes_it_is_bound_to() {
        let folder = tempfile::tempdir().unwrap();
        let job = folder.path().join("job.toml");
        let named = Path::new("elsewhere/a.stl");
        assert_eq!(copy_beside(&job, named, None), None);
        let beside = folder.path().join("a.stl");
        fs::write(&beside, "solid a").unwrap();
        let sha256 = sha256_hex(&[b"solid a"]);
        assert_eq!(
            copy_beside(&job, named, Some(&sha256)),
            Some(beside.clone())
        );
        assert_eq!(copy_beside(&job, named, None), Some(beside.clone()));
        fs::write(&beside, "solid b").unwrap();
        assert_eq!(copy_beside(&job, named, Some(&sha256)), None);
        // A job that is bound to nothing reads the file that it names.
        assert_eq!(copy_beside(&job, &beside, None), None);
    }
}
