//! The pairs of the 2012 paper's Table 1, and the way that A takes past B.

use super::models::model;
use super::plan::{PairPlan, Plan};
use super::{Anyhow, Setup};
use glam::DVec3;
use nurbs_hausdorff::{Model, RigidTransform};

/// Two models; A moves along `axis` through B.
#[derive(Debug)]
pub(crate) struct Pair {
    /// Short, for file names.
    pub(crate) name: &'static str,
    pub(crate) title: String,
    pub(crate) a: Model,
    pub(crate) b: Model,
    axis: DVec3,
    /// What A passes B's centre at, relative to B's size.
    aside: DVec3,
    /// How far A goes from B's centre, relative to where their boxes part.
    reach: f64,
}

/// The pairs, one whose A comes to lie exactly on B, and one whose A comes to
/// be equally far from all of B; in a quick run the small one only.
pub(crate) fn pairs(setup: &Setup, plan: &Plan) -> Anyhow<Vec<Pair>> {
    let wanted = setup.choose(plan.pairs.len(), 1);
    plan.pairs.iter().take(wanted).map(|pair| self::pair(plan, pair)).collect()
}

fn pair(plan: &Plan, pair: &PairPlan) -> Anyhow<Pair> {
    let (a, b) = (model(pair.a)?, model(pair.b)?);
    let of = |model: &Model| {
        let largest = model.surfaces().iter().map(|surface| surface.counts()).max_by_key(|[n, m]| n * m);
        let [n, m] = largest.unwrap_or_default();
        let (name, count) = (model.name().unwrap_or("unnamed"), model.surfaces().len());
        let surfaces = if count == 1 { String::new() } else { format!("{count} surfaces, ") };
        format!("{name} ({surfaces}{n} x {m})")
    };
    Ok(Pair {
        name: pair.name,
        title: format!("{} against {}", of(&a), of(&b)),
        a,
        b,
        axis: pair.axis.into(),
        aside: pair.aside.into(),
        reach: plan.reach,
    })
}

impl Pair {
    /// `count` positions of A's centre along the axis, 0 beside B's centre.
    pub(crate) fn positions(&self, count: usize) -> Vec<f64> {
        let extent = |model: &Model| model.bounding_box().extent().dot(self.axis);
        let reach = self.reach * 0.5 * (extent(&self.a) + extent(&self.b));
        (0..count).map(|index| reach * (2.0 * index as f64 / (count - 1) as f64 - 1.0)).collect()
    }

    /// The translation that brings A to `position`.
    pub(crate) fn at(&self, position: f64) -> Anyhow<RigidTransform> {
        let [a, b] = [&self.a, &self.b].map(Model::bounding_box);
        let aside = self.aside * b.diagonal();
        Ok(RigidTransform::translation(b.center() - a.center() + aside + position * self.axis)?)
    }
}
