//! The sheets at hand: sizes, and how many there are of offcuts.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use crate::base::words::{as_text, choice};

/// The most sizes of a list.
const MOST_SIZES: usize = 8;
/// The longest side, mm.
const LONGEST_MM: f64 = 10_000.0;
/// The most pieces of a size.
const MOST_PIECES: usize = 999;
/// The sign between a size and its number of pieces, and the one between both sides.
const TIMES: char = '*';
const BY: char = 'x';

choice! {
    /// The choice to let panels follow a sheet's grain.
    GrainChoice, "choice about grain" {
        /// All panels lie the same way, or turned by half a turn.
        Keep = "keep",
        /// Panels lie any way.
        Free = "free",
    }
}

/// A size of sheets at hand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StockItem {
    /// Both sides, mm.
    pub size_mm: [f64; 2],
    /// The number of pieces; `None` for any number.
    pub count: Option<usize>,
}

/// The sheets at hand. It is read and printed as `900x600,600x400*2`: any number of the first size,
/// and two of the second.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct StockList(pub Vec<StockItem>);

impl StockList {
    /// Returns true if none are named.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

/// A text that is no list of sheets.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error(
    "`{0}` is no list of sheets; remedy: give up to {MOST_SIZES} sizes in mm such as \
     900x600,600x400*2, where *2 says that there are two"
)]
pub struct StockError(String);

impl FromStr for StockItem {
    type Err = StockError;

    fn from_str(text: &str) -> Result<Self, StockError> {
        let refused = || StockError(text.to_owned());
        let (size, count) = match text.split_once(TIMES) {
            Some((size, count)) => {
                let count = count.trim().parse().ok();
                let count = count.filter(|count| (1..=MOST_PIECES).contains(count));
                (size, Some(count.ok_or_else(refused)?))
            }
            None => (text, None),
        };
        let (length, width) = size.split_once(BY).ok_or_else(refused)?;
        let side = |text: &str| {
            let side: Option<f64> = text.trim().parse().ok();
            side.filter(|side| *side > 0.0 && *side <= LONGEST_MM)
        };
        match (side(length), side(width)) {
            (Some(length), Some(width)) => Ok(Self {
                size_mm: [length, width],
                count,
            }),
            _ => Err(refused()),
        }
    }
}

impl FromStr for StockList {
    type Err = StockError;

    fn from_str(text: &str) -> Result<Self, StockError> {
        let refused = |_| StockError(text.to_owned());
        let items = text.split(',').map(|item| item.trim().parse());
        let items: Vec<StockItem> = items.collect::<Result<_, StockError>>().map_err(refused)?;
        if items.len() > MOST_SIZES {
            return Err(StockError(text.to_owned()));
        }
        Ok(Self(items))
    }
}

impl fmt::Display for StockItem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [length, width] = self.size_mm;
        write!(f, "{length}{BY}{width}")?;
        match self.count {
            Some(count) => write!(f, "{TIMES}{count}"),
            None => Ok(()),
        }
    }
}

impl fmt::Display for StockList {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, item) in self.0.iter().enumerate() {
            if index > 0 {
                f.write_str(",")?;
            }
            item.fmt(f)?;
        }
        Ok(())
    }
}

as_text!(StockList);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_list_prints_as_it_reads() {
        for text in [
            "900x600",
            "900x600,600x400*2",
            "1200.5x800*1",
            "300x200*999",
        ] {
            assert_eq!(text.parse::<StockList>().unwrap().to_string(), text);
        }
        let list: StockList = " 900 x 600 , 600x400 * 2 ".parse().unwrap();
        assert_eq!(list.to_string(), "900x600,600x400*2");
    }

    #[test]
    fn a_text_that_is_no_list_is_refused_with_an_example() {
        for text in [
            "",
            "900",
            "900x",
            "0x600",
            "-9x600",
            "nanx600",
            "infx600",
            "20000x600",
            "900x600*0",
            "900x600*1000",
            "900x600*1.5",
            "900x600,",
            "900by600",
            "1x1,1x1,1x1,1x1,1x1,1x1,1x1,1x1,1x1",
        ] {
            let error = text.parse::<StockList>().unwrap_err().to_string();
            assert!(
                error.contains("such as 900x600,600x400*2"),
                "{text}: {error}"
            );
        }
    }
}
