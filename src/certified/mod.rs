//! Method `certified`: an interval to the tolerance that the user asks for.
//!
//! A is cut into cells. `certify` bounds the distance to B from above over a
//! whole cell, from the foot of its centre alone; `search` halves the cells
//! whose bound is not yet within the tolerance of the largest distance found;
//! `lower` certifies that distance. Every cell ends with a bound, so the
//! largest bound of all is an upper bound of the directed distance whatever
//! an iteration did: one that fails can only loosen.

mod certify;
mod climb;
mod corners;
mod foot_map;
mod nearest;
mod quadratic;
mod region;
mod search;
mod side;

pub(crate) use search::{Interval, Search, Stop};
pub(crate) use side::Side;

pub use quadratic::Quadratic;
/// temporary
pub fn experiment(a: &crate::distance::PreparedModel, b: &crate::distance::PreparedModel, t: crate::RigidTransform, rel: f64, flat: crate::flatness::Flatness, verbose: bool) -> (f64, f64, usize, u32, f64) {
    let (ta, tb) = (a.target(flat), b.target(flat));
    let ba: Vec<_> = ta.target.patches.iter().map(|p| p.derivative_bounds()).collect();
    let bb: Vec<_> = tb.target.patches.iter().map(|p| p.derivative_bounds()).collect();
    let diag = a.bounding_box().diagonal().max(b.bounding_box().diagonal());
    let t0 = crate::distance::now();
    let mut s = Search::new(Side::new(&ta.target, &ba), Side::new(&tb.target, &bb), t, rel * diag, None);
    let mut n = 0;
    loop {
        if let Some(stop) = s.advance() { if verbose { println!("{stop:?}"); } break; }
        n += 1;
        if verbose && n % 50 == 0 { let i = s.interval(); println!("   {n} cells {} levels {} [{:.9e},{:.9e}] gap {:.3e}", s.cells, s.levels, i.lower, i.upper, (i.upper - i.lower) / diag); }
        if crate::distance::now() - t0 > 10.0 { break; }
    }
    let i = s.interval();
    if verbose { s.debug(); }
    (i.lower, i.upper, s.cells, s.levels, crate::distance::now() - t0)
}
