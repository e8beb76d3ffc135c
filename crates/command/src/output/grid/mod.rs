//! Files of values on a grid.

mod npy;
mod nrrd;
mod vti;

use nurbs_hausdorff::{Precision, SignedDistances};
use std::io::{Result, Write};
use std::path::Path;

/// A format of files of a grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum GridFormat {
    /// NumPy's array, of shape x, y, z.
    Npy,
    /// The "nearly raw raster data" of Teem, which ITK and 3D Slicer read.
    Nrrd,
    /// VTK's image data in XML, which ParaView reads.
    Vti,
}

impl GridFormat {
    /// Returns the format that the ending of a path names.
    pub(crate) fn of_path(path: &Path) -> Option<Self> {
        let ending = path.extension()?.to_str()?.to_ascii_lowercase();
        match ending.as_str() {
            "npy" => Some(Self::Npy),
            "nrrd" => Some(Self::Nrrd),
            "vti" => Some(Self::Vti),
            _ => None,
        }
    }

    /// Writes the values with their grid.
    ///
    /// # Errors
    /// Those of the file.
    pub(crate) fn write(self, out: &mut dyn Write, distances: &SignedDistances) -> Result<()> {
        match self {
            Self::Npy => npy::write(out, distances),
            Self::Nrrd => nrrd::write(out, distances),
            Self::Vti => vti::write(out, distances),
        }
    }
}

/// Returns the number of bytes of a value.
fn size(distances: &SignedDistances) -> usize {
    if distances.precision == Precision::Float32 { 4 } else { 8 }
}

/// Writes the values, x fastest, with the lowest byte of each first.
fn write_values(out: &mut dyn Write, distances: &SignedDistances) -> Result<()> {
    let is_short = distances.precision == Precision::Float32;
    for &value in &distances.values {
        if is_short {
            // Values of that precision are numbers of float32.
            out.write_all(&(value as f32).to_le_bytes())?;
        } else {
            out.write_all(&value.to_le_bytes())?;
        }
    }
    Ok(())
}
