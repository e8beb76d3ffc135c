//! The format NRRD, version 5, with header and values in one file.

use super::{size, write_values};
use nurbs_hausdorff::{Grid, SignedDistances};
use std::io::{Result, Write};

/// Writes the values as raw bytes, at the nodes of the grid.
pub(super) fn write(out: &mut dyn Write, distances: &SignedDistances) -> Result<()> {
    let Grid { origin: [x, y, z], spacing, counts: [width, depth, height], .. } = distances.grid;
    let kind = if size(distances) == 4 { "float" } else { "double" };
    write!(
        out,
        "NRRD0005\n# signed distances, negative inside\ntype: {kind}\ndimension: 3\nspace dimension: 3\n\
         sizes: {width} {depth} {height}\n\
         space directions: ({spacing:?},0,0) (0,{spacing:?},0) (0,0,{spacing:?})\n\
         space origin: ({x:?},{y:?},{z:?})\nkinds: domain domain domain\ncenterings: node node node\n\
         endian: little\nencoding: raw\n\n"
    )?;
    write_values(out, distances)
}
