//! The moves of coordinates to knots and common values.

use crate::sorting::sort_by_number;
use crate::untrim::curve::Curve;
use crate::untrim::face::UnitFace;
use glam::DVec2;

/// Moves coordinates to knots and common values.
pub(super) struct Snapper {
    /// The values of v that occur, increasing, with those that represent them.
    v: Vec<(f64, f64)>,
    /// The values of v of all vertices, increasing.
    levels: Vec<f64>,
    /// The knots in u.
    knots: Vec<f64>,
    /// The distances in u and v within which a value is moved.
    snap: [f64; 2],
}

impl Snapper {
    /// Clusters the values of v at the ends of `curves`: knots represent what is near
    /// them, and the first of a cluster what follows it within the tolerance.
    pub(super) fn new<'a>(face: &UnitFace, curves: impl Iterator<Item = &'a Curve>) -> Self {
        let snap_v = face.tolerances.snap[1];
        let mut values: Vec<f64> = curves.flat_map(|curve| [curve.start().y, curve.end().y]).collect();
        sort_by_number(&mut values, |value| *value);
        values.dedup();
        let mut first = f64::NEG_INFINITY;
        let v: Vec<(f64, f64)> = values
            .into_iter()
            .map(|value| {
                let knot = nearest(&face.breaks[1], value);
                if (knot - value).abs() <= snap_v {
                    return (value, knot);
                }
                if value - first > snap_v {
                    first = value;
                }
                (value, first)
            })
            .collect();
        let mut levels: Vec<f64> = v.iter().map(|&(_, level)| level).collect();
        sort_by_number(&mut levels, |level| *level);
        levels.dedup();
        Self { v, levels, knots: face.breaks[0].clone(), snap: face.tolerances.snap }
    }

    /// Returns the vertex for an end of a curve.
    pub(super) fn snapped(&self, point: DVec2) -> DVec2 {
        let knot = nearest(&self.knots, point.x);
        let x = if (knot - point.x).abs() <= self.snap[0] { knot } else { point.x };
        let index = self.v.partition_point(|&(value, _)| value < point.y).min(self.v.len() - 1);
        DVec2::new(x, self.v[index].1)
    }

    /// Returns the level for a joint within an arc: one that is near and lies between these ends
    /// of the arc, or else `v` itself, which becomes one.
    pub(super) fn level(&mut self, v: f64, [low, high]: [f64; 2]) -> f64 {
        let near = nearest(&self.levels, v);
        if (near - v).abs() <= self.snap[1] && low < near && near < high {
            return near;
        }
        let index = self.levels.partition_point(|&level| level < v);
        self.levels.insert(index, v);
        v
    }

    pub(super) fn is_knot(&self, u: f64) -> bool {
        nearest(&self.knots, u) == u
    }
}

/// Returns the nearest of these increasing values.
fn nearest(values: &[f64], value: f64) -> f64 {
    let after = values.partition_point(|&other| other < value);
    let low = values[after.saturating_sub(1)];
    let high = values[after.min(values.len() - 1)];
    if value - low <= high - value { low } else { high }
}
