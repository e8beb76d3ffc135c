//! One prepared model, compared with many by several threads at once.

use nurbs_hausdorff::{DistanceOptions, Engine, PreparedModel, Result, shapes::shape};

fn main() -> Result<()> {
    let engine = Engine::cpu();
    let nominal = PreparedModel::new(&shape("sphere")?)?;
    let compare = |name: &str| -> Result<[f64; 2]> {
        let part = PreparedModel::new(&shape(name)?)?;
        let result = engine.distance(&part, &nominal, &DistanceOptions::default()).wait()?;
        Ok([result.lower, result.upper])
    };
    std::thread::scope(|scope| {
        for name in ["sphere-larger", "torus", "wavy-sheet"] {
            let compare = &compare;
            scope.spawn(move || match compare(name) {
                Ok([lower, upper]) => println!("{name} is from {lower} to {upper} away"),
                Err(error) => eprintln!("{name}: error[{}]: {error}", error.code()),
            });
        }
    });
    Ok(())
}
