//! One prepared model, compared with many by several threads at once.

use nurbs_hausdorff::{Backend, Engine, NoMonitor, Options, PreparedModel, shapes::shape};
use std::error::Error;

fn main() -> Result<(), Box<dyn Error + Send + Sync>> {
    let engine = pollster::block_on(Engine::new(Backend::Cpu))?;
    let nominal = PreparedModel::new(&shape("sphere")?)?;
    let (engine, nominal) = (&engine, &nominal);
    std::thread::scope(|scope| {
        let compare = |name: &'static str| {
            scope.spawn(move || -> Result<(), Box<dyn Error + Send + Sync>> {
                let part = PreparedModel::new(&shape(name)?)?;
                let distance = engine.distance(&part, nominal, &Options::default(), &mut NoMonitor);
                let result = pollster::block_on(distance)?;
                println!("{name}: from {} to {}", result.lower, result.upper);
                Ok(())
            })
        };
        let threads = ["sphere-larger", "torus", "wavy-sheet"].map(compare);
        threads.into_iter().try_for_each(|thread| thread.join().map_err(|_| "a thread panicked")?)
    })
}
