//! VTK's image data in XML, with the values appended as raw bytes.

use super::{size, write_values};
use nurbs_hausdorff::{Grid, SignedDistances};
use std::io::{Result, Write};

/// Writes the values as point data of the name `distance`, with lengths of 64 bits.
pub(super) fn write(out: &mut dyn Write, distances: &SignedDistances) -> Result<()> {
    let Grid { origin: [x, y, z], spacing, counts, .. } = distances.grid;
    let [i, j, k] = counts.map(|count| count - 1);
    let extent = format!("0 {i} 0 {j} 0 {k}");
    let size = size(distances);
    write!(
        out,
        "<?xml version=\"1.0\"?>\n\
         <VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n\
         <ImageData WholeExtent=\"{extent}\" Origin=\"{x:?} {y:?} {z:?}\" Spacing=\"{spacing:?} {spacing:?} {spacing:?}\">\n\
         <Piece Extent=\"{extent}\">\n<PointData Scalars=\"distance\">\n\
         <DataArray type=\"Float{}\" Name=\"distance\" format=\"appended\" offset=\"0\"/>\n\
         </PointData>\n</Piece>\n</ImageData>\n<AppendedData encoding=\"raw\">\n_",
        8 * size
    )?;
    out.write_all(&((size * distances.values.len()) as u64).to_le_bytes())?;
    write_values(out, distances)?;
    out.write_all(b"\n</AppendedData>\n</VTKFile>\n")
}
