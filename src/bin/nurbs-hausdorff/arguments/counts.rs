//! The numbers of points of a grid.

use std::str::FromStr;

/// `nx,ny,nz`, the numbers of points along the axes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Counts(pub(crate) [usize; 3]);

impl FromStr for Counts {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let count = |text: &str| {
            text.trim().parse().map_err(|_| format!("found {text:?}, expected a whole number from 0"))
        };
        let counts: Vec<usize> = text.split(',').map(count).collect::<Result<_, _>>()?;
        let found = counts.len();
        counts.try_into().map(Self).map_err(|_| format!("found {found} numbers, expected 3"))
    }
}
