//! The middle and the principal axes of a surface, by which copies of sheets are found. They depend on the points of the
//! surface and not on its cut into pieces, and no word rests on them.

use crate::area::gauss::rule;
use crate::engine::PreparedModel;
use crate::facets::Facet;
use crate::facts::Principal;
use crate::interval::Interval;
use glam::{DMat3, DVec3};

/// The nodes of a rule along each parameter of a patch: middles of quarters of circles are off by 1e-8 of the radius.
const NODES: usize = 6;

/// The integrals of 1, x and x xᵀ over a surface, about a point near it.
struct Sums {
    about: DVec3,
    area: f64,
    first: DVec3,
    second: DMat3,
}

impl Sums {
    fn add(&mut self, point: DVec3, area: f64) {
        let arm = point - self.about;
        self.area += area;
        self.first += area * arm;
        self.second += DMat3::from_cols(area * arm.x * arm, area * arm.y * arm, area * arm.z * arm);
    }
}

/// Returns the centroid of a surface, and its principal moments, ascending, with their axes; `None` without an area.
/// O(patches).
pub(super) fn middle_and_axes(model: &PreparedModel) -> Option<(DVec3, [f64; 3], [DVec3; 3])> {
    let about = model.control_box().center();
    let mut sums = Sums { about, area: 0.0, first: DVec3::ZERO, second: DMat3::ZERO };
    match model.facets() {
        Some(facets) => {
            for place in 0..facets.target.len() as u32 {
                let Facet::Triangle([a, b, c]) = facets.target.facet(place) else { continue };
                // Exact for quadratic functions.
                let third = (b - a).cross(c - a).length() / 6.0;
                [a + b, b + c, c + a].into_iter().for_each(|twice| sums.add(0.5 * twice, third));
            }
        }
        None => {
            let rule = rule(NODES);
            let nodes = || rule.nodes.iter().zip(&rule.weights);
            for patch in model.bezier().patches.iter() {
                for (&s, of_s) in nodes() {
                    for (&t, of_t) in nodes() {
                        let jet = patch.jet([s, t]);
                        sums.add(jet.point, of_s * of_t * jet.s.cross(jet.t).length());
                    }
                }
            }
        }
    }
    let Sums { area, first, second, .. } = sums;
    if !(area > 0.0) {
        return None;
    }
    let arm = first / area;
    let spread = second - DMat3::from_cols(arm.x * first, arm.y * first, arm.z * first);
    let trace: f64 = (0..3).map(|k| spread.col(k)[k]).sum();
    let inertia = DMat3::from_diagonal(DVec3::splat(trace)) - spread;
    let matrix = [0, 1, 2].map(|i| [0, 1, 2].map(|j| Interval::exactly(inertia.col(i)[j])));
    let Principal { moments, axes, .. } = Principal::new(&matrix);
    Some((about + arm, moments.map(|moment| moment.middle()), axes))
}
