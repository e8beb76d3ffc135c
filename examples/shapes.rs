//! Writes every shape of the catalogue as interchange JSON, one file each.
//!
//! `cargo run --release --example shapes -- FOLDER`

use nurbs_hausdorff::shapes;
use std::path::PathBuf;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = PathBuf::from(std::env::args().nth(1).ok_or("expected a folder")?);
    std::fs::create_dir_all(&folder)?;
    for shape in shapes::list() {
        let path = folder.join(format!("{}.json", shape.name));
        std::fs::write(path, shapes::shape(shape.name)?.to_json()?)?;
    }
    Ok(())
}
