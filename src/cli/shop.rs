//! The shop's default printer and the day, as the machine gives them.

use std::path::{Path, PathBuf};
use std::time::{SystemTime, UNIX_EPOCH};

use super::args::ArgsError;
use crate::{
    job::PrinterChoice,
    printer::{CONFIGURATION, ShopDefaults},
};

/// Returns the printer and material that were ordered, or the shop's defaults; `None` if there are
/// neither.
pub fn chosen_printer(
    printer: Option<&str>,
    material: Option<String>,
    model: &Path,
) -> Result<Option<PrinterChoice>, ArgsError> {
    if let Some(id) = printer {
        let id = id.to_owned();
        return Ok(Some(PrinterChoice { id, material }));
    }
    let shop = ShopDefaults::find_in(&shop_folders(model))?;
    Ok(shop.map(|shop| PrinterChoice {
        id: shop.printer,
        material: material.or(shop.material),
    }))
}

/// Returns the folders that may hold `equipoise.toml`, in order: the current one, the model's, the
/// user's.
pub fn shop_folders(model: &Path) -> Vec<PathBuf> {
    let beside = model.parent().map(Path::to_owned);
    [PathBuf::from(".")]
        .into_iter()
        .chain(beside)
        .chain(configuration_folder())
        .collect()
}

/// Returns the program's folder in the user's configuration folder; `None` if the system names
/// none.
fn configuration_folder() -> Option<PathBuf> {
    let named = |name: &str| {
        std::env::var_os(name)
            .filter(|value| !value.is_empty())
            .map(PathBuf::from)
    };
    let home = || named("HOME").map(|home| home.join(".config"));
    let folder = named("XDG_CONFIG_HOME")
        .or_else(|| named("APPDATA"))
        .or_else(home);
    folder.map(|folder| folder.join(CONFIGURATION))
}

/// Seconds of a day.
const DAY_S: u64 = 86_400;

/// Returns the day in UTC, as 2026-11-21.
pub fn today() -> String {
    let since = SystemTime::now()
        .duration_since(UNIX_EPOCH)
        .map_or(0, |since| since.as_secs());
    day(since / DAY_S)
}

/// Returns the day that many days after 1970-01-01, in the Gregorian calendar.
fn day(mut days: u64) -> String {
    let is_leap = |year: u64| {
        year.is_multiple_of(4) && (!year.is_multiple_of(100) || year.is_multiple_of(400))
    };
    let mut year = 1970;
    while days >= 365 + u64::from(is_leap(year)) {
        days -= 365 + u64::from(is_leap(year));
        year += 1;
    }
    let february = 28 + u64::from(is_leap(year));
    let months = [31, february, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31];
    let mut month = 0;
    while days >= months[month] {
        days -= months[month];
        month += 1;
    }
    format!("{year}-{:02}-{:02}", month + 1, days + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn days_are_counted_by_the_calendar() {
        for (days, name) in [
            (0, "1970-01-01"),
            (58, "1970-02-28"),
            (59, "1970-03-01"),
            (11_016, "2000-02-29"),
            (20_778, "2026-11-21"),
        ] {
            assert_eq!(day(days), name);
        }
    }

    #[test]
    fn the_folder_of_the_run_comes_first_then_the_models() {
        let folders = shop_folders(Path::new("models/elephant.obj"));
        assert_eq!(folders[..2], [PathBuf::from("."), PathBuf::from("models")]);
    }
}
