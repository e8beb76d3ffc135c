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
mod periods;
mod rings;

use super::uses::{self, Origin, TrimUse};
use crate::nurbs::Surface;
use crate::report::{FaceFault, Remark};
use crate::topology::{Orientation, ShapeKind, Topology};
use chain::Chain;
use nesting::Directed;
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
/// Where the curves that the file states in the parameters bound no region, those made of the edges in
/// space take their place, which is remarked.
///
/// # Errors
/// The reason for which the wires bound no region of the surface.
pub(super) fn of_face(file: &Topology, shape: usize, surface: &Surface) -> Result<Loops, FaceFault> {
    of_curves(file, shape, surface, Origin::Stated).or_else(|fault| {
        let Ok(mut made) = of_curves(file, shape, surface, Origin::Made) else { return Err(fault) };
        let why = format!("the curves in the parameters are made anew of the edges: {}", fault.why);
        made.remarks.push(Remark::new("BREP_CURVES_MADE", why));
        Ok(made)
    })
}

fn of_curves(file: &Topology, shape: usize, surface: &Surface, origin: Origin) -> Result<Loops, FaceFault> {
    let mut chains: Vec<Chain> = Vec::new();
    for wire in &file.shapes[shape].children {
        let bounds = matches!(wire.orientation, Orientation::Forward | Orientation::Reversed);
        if !bounds || !matches!(file.shapes[wire.shape].kind, ShapeKind::Wire) {
            continue;
        }
        let uses = uses::of_wire(file, shape, wire, surface, origin)?;
        if !uses.is_empty() {
            chains.push(turned_about_seam(chain::chain(uses, surface)?, surface));
        }
    }
    let complement_fits = complement_fits(&chains, surface);
    if area::of_closed(surface).is_some() || !chains.iter().all(|chain| cancels(chain, surface)) {
        chains.retain(|chain| !cancels(chain, surface));
    }
    let remarks: Vec<Remark> =
        chains.iter_mut().flat_map(|chain| std::mem::take(&mut chain.remarks)).collect();
    let Directed { loops, remark } = nesting::directed(rings::close(chains, surface)?, surface)?;
    let remarks = remarks.into_iter().chain(remark).collect();
    Ok(Loops { loops, remarks, complement_fits })
}

/// Returns a loop, reversed if it runs clockwise around a part of a closed surface and along a seam on
/// both sides of that part.
///
/// The face lies on both sides of an edge that it uses once each way; the rest of the surface, which the
/// loop as it is would bound, lies on neither (lemma B2 of `docs/cad.md`).
fn turned_about_seam(chain: Chain, surface: &Surface) -> Chain {
    let is_clockwise = chain.turns == [0, 0]
        && area::of_closed(surface).is_some()
        && area::of_loop(&chain.uses) < 0.0
        && has_seam(&chain, surface);
    if !is_clockwise {
        return chain;
    }
    let mut turned = Chain { uses: rings::reversed(chain.uses), ..chain };
    let why = "the loop runs clockwise along both sides of a seam, and is read in the other direction";
    turned.remarks.push(Remark::new("BREP_LOOP_TURNED", why));
    turned
}

/// Returns whether a loop uses an edge once each way, a period apart.
fn has_seam(chain: &Chain, surface: &Surface) -> bool {
    let closures = surface.closures();
    let is_apart = |one: &TrimUse, other: &TrimUse| {
        let step = one.curve.start() - other.curve.end();
        (0..2).any(|axis| closures[axis].is_some_and(|period| step[axis].abs() > 0.5 * period))
    };
    chain.uses.iter().enumerate().any(|(index, one)| {
        let mut others = chain.uses[index + 1..].iter();
        one.edge.is_some()
            && others
                .any(|other| other.edge == one.edge && other.reversed != one.reversed && is_apart(one, other))
    })
}

/// Returns whether a loop runs along edges and back: its curves cancel, so that it bounds nothing, and a face
/// of a closed surface without other loops is the whole surface. On other surfaces it is a slit.
fn cancels(chain: &Chain, surface: &Surface) -> bool {
    let length = |trim_use: &TrimUse| trim_use.hull()[0].distance(trim_use.hull()[1]);
    let around = || chain.uses.iter().map(length).sum::<f64>();
    let whole = area::of_closed(surface).unwrap_or_else(|| around().powi(2));
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
