//! Closed loops of a face's curves, with the material on their left.
//!
//! The stages: [`order`] finds a circuit of a wire's curves; [`chain`] moves them to meet each
//! other across periods; [`rings`] closes loops that run around a period; [`nesting`] directs
//! the loops and adds a missing outer one.
//!
//! What holds on closed surfaces is lemma B1 of `docs/cad.md`: regions with the same directed
//! boundary differ by whole surfaces, so that one alone has an area in (0, W].

mod area;
mod chain;
mod frame;
mod nesting;
mod order;
mod rings;

use super::uses::{self, TrimUse};
use crate::brep::nurbs::Surface;
use crate::brep::report::{FaceFault, Remark};
use crate::brep::topology::{Orientation, ShapeKind, Topology};
use chain::Chain;
pub(super) use rings::crossing;
use std::collections::{HashMap, HashSet};

/// The loops of a face, and what the report says of them.
pub(super) struct Loops {
    pub(super) loops: Vec<Vec<TrimUse>>,
    pub(super) remarks: Vec<Remark>,
    /// Whether the region beyond the loops is a face of the same surface, with the loops reversed.
    pub(super) complement_fits: bool,
}

/// Returns the loops of a face in the parameters of the file, closed and directed with the
/// material on the left.
///
/// # Errors
/// The reason for which the wires bound no region of the surface.
pub(super) fn of_face(file: &Topology, shape: usize, surface: &Surface) -> Result<Loops, FaceFault> {
    let mut chains: Vec<Chain> = Vec::new();
    for wire in &file.shapes[shape].children {
        let bounds = matches!(wire.orientation, Orientation::Forward | Orientation::Reversed);
        if !bounds || !matches!(file.shapes[wire.shape].kind, ShapeKind::Wire) {
            continue;
        }
        let uses = uses::of_wire(file, shape, wire)?;
        if !uses.is_empty() {
            chains.push(chain::chain(uses, surface)?);
        }
    }
    let complement_fits = complement_fits(&chains, surface);
    chains.retain(|chain| !cancels(chain, surface));
    let remarks = chains.iter_mut().flat_map(|chain| std::mem::take(&mut chain.remarks)).collect();
    let loops = nesting::directed(rings::close(chains, surface)?, surface)?;
    Ok(Loops { loops, remarks, complement_fits })
}

/// Returns whether a loop runs along seams and back on a closed surface: its curves cancel, so that
/// it bounds nothing, and a face without other loops is the whole surface.
fn cancels(chain: &Chain, surface: &Surface) -> bool {
    let Some(whole) = area::of_closed(surface) else { return false };
    let mut uses: HashMap<u32, [u32; 2]> = HashMap::new();
    for (edge, reversed) in chain.uses.iter().filter_map(|one| Some((one.edge?, one.reversed))) {
        uses.entry(edge).or_default()[usize::from(reversed)] += 1;
    }
    let in_pairs = chain.turns == [0, 0] && uses.values().all(|uses| *uses == [1, 1]);
    in_pairs && area::of_loop(&chain.uses).abs() <= area::NO_AREA * whole
}

/// Returns whether the loops bound two regions of a closed surface, so that their directions
/// choose one.
///
/// A seam, whose edge is used once each way, lies in the face on both its sides, and the edge
/// of a pole states the part of the pole that does: both exclude the region beyond the loops.
fn complement_fits(chains: &[Chain], surface: &Surface) -> bool {
    let uses = || chains.iter().flat_map(|chain| &chain.uses);
    let mut edges = HashSet::new();
    let seam = uses().filter_map(|trim_use| trim_use.edge).any(|edge| !edges.insert(edge));
    area::of_closed(surface).is_some() && !edges.is_empty() && !seam && !uses().any(|one| one.degenerate)
}
