//! The pairs of the 2012 paper's Table 1, and the path of A past B.

use super::super::{Anyhow, Setup};
use super::models::model;
use super::plan::{PairPlan, Plan};
use glam::DVec3;
use nurbs_hausdorff::{Model, RigidTransform};

/// Two models; A moves along `axis` through B.
#[derive(Debug)]
pub(crate) struct Pair {
    /// The short name, used in file names.
    pub(crate) name: &'static str,
    pub(crate) title: String,
    pub(crate) a: Model,
    pub(crate) b: Model,
    axis: DVec3,
    /// The offset of A's path from B's centre, relative to B's diagonal.
    aside: DVec3,
    /// The largest distance of A's centre from B's along the path, relative to the
    /// distance at which their boxes separate.
    reach: f64,
}

/// Returns the pairs, including one where A coincides with B at a position and one
/// where A is equally far from all of B; in a quick run only the first, small one.
pub(crate) fn pairs(setup: &Setup, plan: &Plan) -> Anyhow<Vec<Pair>> {
    let count = setup.choose(plan.pairs.len(), 1);
    plan.pairs.iter().take(count).map(|pair| self::pair(plan, pair)).collect()
}

fn pair(plan: &Plan, pair: &PairPlan) -> Anyhow<Pair> {
    let (a, b) = (model(pair.a)?, model(pair.b)?);
    let title = |model: &Model| {
        let largest = model.surfaces().iter().map(|surface| surface.counts()).max_by_key(|[n, m]| n * m);
        let [n, m] = largest.unwrap_or_default();
        let (name, count) = (model.name().unwrap_or("unnamed"), model.surfaces().len());
        let surfaces = if count == 1 { String::new() } else { format!("{count} surfaces, ") };
        format!("{name} ({surfaces}{n} x {m})")
    };
    Ok(Pair {
        name: pair.name,
        title: format!("{} against {}", title(&a), title(&b)),
        a,
        b,
        axis: pair.axis.into(),
        aside: pair.aside.into(),
        reach: plan.reach,
    })
}

impl Pair {
    /// Returns `count` positions of A's centre along the axis, where 0 is next to B's centre.
    pub(crate) fn positions(&self, count: usize) -> Vec<f64> {
        let extent = |model: &Model| model.bounding_box().extent().dot(self.axis);
        let reach = self.reach * 0.5 * (extent(&self.a) + extent(&self.b));
        (0..count).map(|index| reach * (2.0 * index as f64 / (count - 1) as f64 - 1.0)).collect()
    }

    /// Returns the translation that moves A to `position`.
    pub(crate) fn at(&self, position: f64) -> Anyhow<RigidTransform> {
        let [a, b] = [&self.a, &self.b].map(Model::bounding_box);
        let aside = self.aside * b.diagonal();
        Ok(RigidTransform::translation(b.center() - a.center() + aside + position * self.axis)?)
    }
}
