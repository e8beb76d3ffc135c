//! Surfaces of A that need be searched along one profile only.

use super::Operand;
use super::region::Cell;
use crate::model::RigidTransform;
use crate::symmetry::Revolution;

/// Part of the tolerance that points of a profile's circle may differ by.
const MAX_SLACK: f64 = 1e-2;

/// Which surfaces of A are of revolution about an axis whose turns leave B as it is.
///
/// A turn about the axis takes a point of such a surface along a parameter
/// line, and its nearest point on B to one of B, so that all points of the line
/// are as far from B.
#[derive(Debug)]
pub(super) struct Profiles {
    /// A surface's parameter that goes round, and its start.
    round: Vec<Option<(usize, f64)>>,
    /// At most how much farther a point is than the profile's of its circle.
    pub(super) slack: f64,
}

impl Profiles {
    pub(super) fn new(a: &Operand<'_>, b: &Operand<'_>, transform: &RigidTransform, tolerance: f64) -> Self {
        let mut profiles = Self { round: Vec::with_capacity(a.revolutions.len()), slack: 0.0 };
        for of_a in a.revolutions {
            let most = MAX_SLACK * tolerance;
            let slack = of_a.as_ref().map_or(f64::INFINITY, |of_a| slack(of_a, b, transform, most));
            let use_it = slack <= most;
            profiles.slack = profiles.slack.max(if use_it { slack } else { 0.0 });
            profiles
                .round
                .push(of_a.as_ref().filter(|_| use_it).map(|of_a| (of_a.round.index(), of_a.start)));
        }
        profiles
    }

    /// Whether any surface is searched along its profile only.
    pub(super) fn any(&self) -> bool {
        self.round.iter().any(Option::is_some)
    }

    /// What of a patch need be searched: all, its edge on the profile, or nothing.
    pub(super) fn cell(&self, a: &Operand<'_>, index: u32) -> Option<Cell> {
        let whole = Cell::whole(index);
        let patch = a.patch(index);
        let Some(&Some((round, start))) = self.round.get(patch.surface) else { return Some(whole) };
        let edge = Cell {
            center: [0, 1].map(|axis| if axis == round { 0.0 } else { whole.center[axis] }),
            half: [0, 1].map(|axis| if axis == round { 0.0 } else { whole.half[axis] }),
            ..whole
        };
        (patch.domain[round][0] == start).then_some(edge)
    }
}

/// By how much the points of a circle of A may differ in their distance to B:
/// twice how far A's surface, and B's, are from surfaces of revolution, and
/// what turns about the two axes differ by; infinite if B has others, and
/// not looked at further once it is above `prune_threshold`.
fn slack(of_a: &Revolution, b: &Operand<'_>, transform: &RigidTransform, prune_threshold: f64) -> f64 {
    let axis = of_a.axis.moved(transform);
    let mut most = if b.revolutions.is_empty() { f64::INFINITY } else { 0.0_f64 };
    for of_b in b.revolutions {
        let slack = match of_b {
            Some(Revolution { sphere: Some(sphere), .. }) => {
                2.0 * (sphere.deviation + axis.radial(sphere.center).length())
            }
            Some(of_b) if of_b.full => {
                2.0 * of_b.deviation + axis.rotation_difference(&of_b.axis, of_a.radius)
            }
            _ => f64::INFINITY,
        };
        most = most.max(slack);
        if most > prune_threshold {
            break;
        }
    }
    2.0 * of_a.deviation + most
}
