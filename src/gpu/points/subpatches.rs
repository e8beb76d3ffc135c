//! Patches cut finely, so that the squared distance to each part is nearly always convex.

use crate::axis::Axis;
use crate::bezier::{Patch, PatchSet, center_grid, net_length};
use crate::closest::Target;
use crate::gpu::subpatch_domain::SubpatchDomain;
use crate::rounding::gamma;

/// The number of subpatches below which patches are halved once more: about 40 MB of bicubic ones and their tree.
///
/// benches/RESULTS.md has the shares of points that are decided with 1, 4, 16 and 64 subpatches a patch.
const MAX_SUBPATCHES: usize = 1 << 17;

/// The most halvings of one patch.
const MAX_HALVINGS: u32 = 6;

/// The subpatches of a target.
#[derive(Debug)]
pub(crate) struct Subpatches {
    pub(crate) target: Target,
    /// Where each subpatch is.
    pub(crate) domains: Vec<SubpatchDomain>,
    /// Upper bound on the distance between a point of a subpatch and that of its patch, by rounding in float64: lemma R4
    /// of docs/rounding.md.
    pub(crate) error: f64,
}

impl Subpatches {
    /// Halves every patch as often as the limits allow, each time along the longer side. O(subpatches log subpatches).
    pub(crate) fn new(target: &Target) -> Self {
        let root = target.patches.bounding_box();
        let grid = center_grid(root.diagonal());
        let halvings = (MAX_SUBPATCHES / target.patches.len().max(1)).max(1).ilog2().min(MAX_HALVINGS);
        let (mut patches, mut domains) = (PatchSet::default(), Vec::new());
        for (index, patch) in target.patches.iter().enumerate() {
            let domain = SubpatchDomain::whole(index as u32);
            add(&mut patches, &mut domains, &patch, domain, grid, halvings);
        }
        let roundings = f64::from(2 * halvings) * target.max_degree as f64 + 8.0;
        let error = gamma(roundings) * root.diagonal() + gamma(1.0) * root.farthest_from_origin();
        Self { target: Target::new(patches), domains, error }
    }
}

/// Adds the subpatches into which this number of halvings divides a part of a patch.
fn add(
    patches: &mut PatchSet,
    domains: &mut Vec<SubpatchDomain>,
    part: &Patch<'_>,
    domain: SubpatchDomain,
    grid: f64,
    halvings: u32,
) {
    if halvings == 0 {
        patches.push_centered(*part, grid);
        domains.push(domain);
        return;
    }
    let axis = Axis::of_larger([net_length(part, 0), net_length(part, 1)]);
    for (index, controls) in part.halves(axis).into_iter().enumerate() {
        let half = Patch { controls: &controls, ..*part };
        add(patches, domains, &half, domain.half(axis.index(), index == 1), grid, halvings - 1);
    }
}
