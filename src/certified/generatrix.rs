//! Reduction of surfaces of revolution to their generatrix.
//!
//! Let a rotation about an axis map B onto itself, and let a surface of A be a
//! surface of revolution about the same axis. The rotation takes a point of that
//! surface along a parameter line, and its nearest point on B to one of B. So
//! all points of the line are equally far from B, and only one generatrix of the
//! surface needs to be searched.

use super::{Operand, Pair};
use crate::axis::Axis;
use crate::bezier::{LocalDerivativeBounds, Patch, PatchSet};
use crate::bvh::Aabb;
use crate::closest::Target;
use crate::param_box::ParamBox;
use crate::rounding::upper_max;
use crate::symmetry::Revolution;
use glam::DVec4;

/// Part of the tolerance by which the points of a circle may differ in their
/// distance to B.
const MAX_SLACK_PART: f64 = 1e-2;

/// A with its surfaces of revolution replaced by their generatrices, each a
/// patch that is constant along one parameter.
#[derive(Debug)]
pub(crate) struct Generatrix {
    target: Target,
    bounds: Vec<LocalDerivativeBounds>,
    control_box: Aabb,
    point_error: f64,
    /// A bound on how much farther from B a point is than the generatrix's
    /// point on its circle.
    pub(crate) slack: f64,
}

impl Generatrix {
    /// Reduces A for a search to this tolerance; `None` where no surface can be.
    /// O(patches p q).
    pub(crate) fn new(pair: &Pair<'_>, tolerance: f64) -> Option<Self> {
        let max_slack = MAX_SLACK_PART * tolerance;
        let mut slack = 0.0_f64;
        let reduced: Vec<Option<&Revolution>> = pair
            .a
            .revolutions
            .iter()
            .map(|surface| {
                let of_surface = rotation_slack(surface.as_ref()?, pair, max_slack);
                (of_surface <= max_slack).then(|| slack = slack.max(of_surface))?;
                surface.as_ref()
            })
            .collect();
        if reduced.iter().all(Option::is_none) {
            return None;
        }
        let mut patches = PatchSet::default();
        let mut bounds = Vec::new();
        for index in 0..pair.a.patches().len() as u32 {
            let patch = pair.a.patch(index);
            match reduced.get(patch.surface).copied().flatten() {
                None => {
                    patches.push(patch);
                    bounds.push(LocalDerivativeBounds::new(pair.a.room(index)));
                }
                Some(surface) if patch.domain[surface.round][0] == surface.start => {
                    push_generatrix(&mut patches, &patch, surface.round);
                    bounds.push(LocalDerivativeBounds::new(ParamBox::UNIT));
                }
                Some(_) => {}
            }
        }
        Some(Self {
            target: Target::new(patches),
            bounds,
            control_box: pair.a.control_box,
            point_error: pair.a.point_error,
            slack,
        })
    }

    pub(crate) fn operand(&self) -> Operand<'_> {
        Operand::new(&self.target, &self.bounds).with_accuracy(self.control_box, self.point_error)
    }
}

/// Appends the edge of a patch at the start of one parameter, as a patch of
/// degree 1 in that parameter and constant along it.
fn push_generatrix(patches: &mut PatchSet, patch: &Patch<'_>, round: Axis) {
    let [p, q] = patch.degree;
    let edge: Vec<DVec4> = if round == Axis::U {
        patch.controls[..=q].to_vec()
    } else {
        patch.controls.iter().step_by(q + 1).copied().collect()
    };
    let (degree, controls) = if round == Axis::U {
        ([1, q], edge.repeat(2))
    } else {
        ([p, 1], edge.iter().flat_map(|&control| [control; 2]).collect())
    };
    let mut domain = patch.domain;
    domain[round][1] = domain[round][0];
    patches.push(Patch { degree, domain, controls: &controls, ..*patch });
}

/// A bound on how much the points of a circle of A differ in their distance to
/// B: twice the distance of A's surface, and of B's, from surfaces of
/// revolution, and the difference of the rotations about the two axes; +∞ where
/// B has a surface that is not invariant. Evaluated until it exceeds `max_slack`.
fn rotation_slack(of_a: &Revolution, pair: &Pair<'_>, max_slack: f64) -> f64 {
    let axis = of_a.axis.moved(&pair.transform);
    let mut slack = if pair.b.revolutions.is_empty() { f64::INFINITY } else { 0.0_f64 };
    for of_b in pair.b.revolutions {
        let of_surface = match of_b {
            Some(Revolution { sphere: Some(sphere), .. }) => {
                2.0 * (sphere.deviation + axis.radial(sphere.center).length())
            }
            Some(of_b) if of_b.full => {
                2.0 * of_b.deviation + axis.rotation_difference(&of_b.axis, of_a.radius)
            }
            _ => f64::INFINITY,
        };
        slack = upper_max(slack, of_surface);
        if slack > max_slack {
            break;
        }
    }
    2.0 * of_a.deviation + slack
}
