//! What the checklists of all kinds of kits have.

use std::collections::BTreeMap;

use super::Verdict;
use crate::verify::Check;

/// The checklist of a kind of kit.
pub trait KindSheet {
    /// Returns the verdict over all checks.
    fn verdict(&self) -> Verdict;
    /// Returns every promise with its verdict.
    fn checks(&self) -> &[Check];
    /// Returns what the shop must know.
    fn warnings(&self) -> &[String];
    /// Lists the files of the kit, with the SHA-256 of each.
    fn list_files(&mut self, files: BTreeMap<String, String>);
}

/// Implements [`KindSheet`] for a checklist with fields of these names.
macro_rules! kind_sheet {
    ($sheet:ty) => {
        impl crate::sheet::KindSheet for $sheet {
            fn verdict(&self) -> crate::sheet::Verdict {
                self.verdict
            }

            fn checks(&self) -> &[crate::verify::Check] {
                &self.checks
            }

            fn warnings(&self) -> &[String] {
                &self.warnings
            }

            fn list_files(&mut self, files: std::collections::BTreeMap<String, String>) {
                self.files = files;
            }
        }
    };
}

pub(super) use kind_sheet;
