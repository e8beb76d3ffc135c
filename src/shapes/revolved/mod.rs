//! Surfaces of revolution, and models of them.

mod cylinder;
mod disc;
mod revolution;
mod sphere;
mod sphere_parts;
mod torus;
mod vessels;

pub use cylinder::{cone, cylinder, lateral};
pub use disc::disc;
pub use revolution::revolve;
pub use sphere::sphere;
pub use sphere_parts::sphere_parts;
pub use torus::torus;
pub use vessels::{bottle, glass};
