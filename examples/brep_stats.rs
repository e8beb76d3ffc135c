//! Reads BREP texts and prints what was read.
use std::time::Instant;
fn main() {
    for path in std::env::args().skip(1) {
        let text = std::fs::read_to_string(&path).unwrap();
        let start = Instant::now();
        let read = nurbs_hausdorff::brep::model(&text, None, None);
        let ms = start.elapsed().as_secs_f64() * 1e3;
        let validated = Instant::now();
        match nurbs_hausdorff::Model::from_brep(&text) {
            Ok((model, report)) => {
                let total = validated.elapsed().as_secs_f64() * 1e3;
                println!(
                    "   model of {} faces, gap {:e}, skipped {:?} in {total:.1} ms",
                    model.faces().len(),
                    model.gap(),
                    report.skipped
                );
            }
            Err(error) => println!("   {error}"),
        }
        match read {
            Ok((model, report)) => {
                let loops: usize = model.faces.iter().filter_map(|f| f.trim.as_ref()).map(Vec::len).sum();
                println!(
                    "{path}: faces {} loops {loops} trims {} exact {} fitted {} gap {:e} skipped {} instances {} {ms:.1} ms",
                    report.surfaces,
                    report.trims,
                    report.exact,
                    report.fitted,
                    report.gap,
                    report.skipped.len(),
                    model.instances.len()
                );
                for s in report.skipped.iter().take(12) {
                    println!("    {s:?}");
                }
            }
            Err(error) => println!("{path}: {error}"),
        }
    }
}
