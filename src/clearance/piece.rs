//! Pieces of patches, made when they are first needed and kept for other pairs.

use super::Body;
use super::newton::moved;
use crate::axis::Axis;
use crate::bezier::Patch;
use crate::carrier::{Carrier, MAX_CONTROLS};
use crate::model::RigidTransform;
use crate::param_box::ParamBox;
use glam::{DVec3, DVec4, Vec4Swizzles};
use std::collections::HashMap;

/// A part of a patch, with its control points after the motion of its model.
#[derive(Debug, Clone)]
pub(super) struct Piece {
    pub(super) patch: u32,
    /// The part of the patch's parameters.
    pub(super) range: ParamBox,
    controls: Vec<DVec4>,
    /// The moved control points, t fastest.
    pub(super) points: Vec<DVec3>,
    /// About how far the hull reaches beyond the surface.
    pub(super) bend: f64,
    /// The axis along which halving makes the hull closer.
    axis: Axis,
    /// The number of halvings from the patch.
    pub(super) level: u32,
    halves: Option<[u32; 2]>,
}

/// The pieces of one model's patches.
#[derive(Debug)]
pub(super) struct Pieces<'a> {
    body: Body<'a>,
    transform: Option<RigidTransform>,
    /// The index of each whole patch that was needed.
    whole: HashMap<u32, u32>,
    /// The carrier of each patch that was asked for it, if it has one.
    carriers: HashMap<u32, Option<Carrier>>,
    list: Vec<Piece>,
    /// The largest number of halvings of a piece.
    pub(super) deepest: u32,
}

impl<'a> Pieces<'a> {
    /// Makes the empty list; pieces are moved by `transform`.
    pub(super) fn new(body: Body<'a>, transform: Option<RigidTransform>) -> Self {
        Self {
            body,
            transform,
            whole: HashMap::new(),
            carriers: HashMap::new(),
            list: Vec::new(),
            deepest: 0,
        }
    }

    /// Returns a piece by its index.
    pub(super) fn piece(&self, index: u32) -> &Piece {
        &self.list[index as usize]
    }

    /// Returns the patch with this index in the model.
    pub(super) fn patch(&self, patch: u32) -> Patch<'a> {
        self.body.target.patches.patch(patch as usize)
    }

    /// Returns the index of the piece that is a whole patch.
    pub(super) fn whole(&mut self, patch: u32) -> u32 {
        if let Some(&index) = self.whole.get(&patch) {
            return index;
        }
        let controls = self.patch(patch).controls.to_vec();
        let index = self.add(patch, ParamBox::UNIT, controls, 0);
        self.whole.insert(patch, index);
        index
    }

    /// Returns the sphere, the cylinder, the cone or the torus that a patch lies on, if any.
    pub(super) fn carrier(&mut self, patch: u32) -> Option<Carrier> {
        if let Some(&known) = self.carriers.get(&patch) {
            return known;
        }
        let whole = self.whole(patch);
        let Piece { points, controls, .. } = self.piece(whole);
        let of_patch = self.patch(patch);
        let jet = |at: [f64; 2]| {
            let jet = of_patch.jet(at);
            self.transform.as_ref().map_or(jet, |transform| moved(&jet, transform))
        };
        let weights: Vec<f64> = controls.iter().map(|control| control.w).collect();
        let found = (points.len() <= MAX_CONTROLS)
            .then(|| Carrier::of(jet, of_patch.degree, points, &weights))
            .flatten();
        self.carriers.insert(patch, found);
        found
    }

    /// Returns the indices of the two halves of a piece.
    pub(super) fn halves(&mut self, index: u32) -> [u32; 2] {
        let Piece { patch, range, axis, level, ref controls, halves, .. } = self.list[index as usize];
        if let Some(halves) = halves {
            return halves;
        }
        let [low, high] = Patch { controls, domain: range, ..self.patch(patch) }.halves(axis);
        let [low_range, high_range] = range.halves(axis);
        let halves =
            [self.add(patch, low_range, low, level + 1), self.add(patch, high_range, high, level + 1)];
        self.list[index as usize].halves = Some(halves);
        halves
    }

    fn add(&mut self, patch: u32, range: ParamBox, controls: Vec<DVec4>, level: u32) -> u32 {
        let Patch { degree, center, .. } = self.patch(patch);
        let at = |control: &DVec4| center + control.xyz() / control.w;
        let points: Vec<DVec3> = match &self.transform {
            Some(transform) => controls.iter().map(|control| transform.apply(at(control))).collect(),
            None => controls.iter().map(at).collect(),
        };
        let (bend, axis) = bend(degree, &points);
        self.deepest = self.deepest.max(level);
        let index = self.list.len() as u32;
        self.list.push(Piece { patch, range, controls, points, bend, axis, level, halves: None });
        index
    }
}

impl Piece {
    /// Returns the corners of the piece, which are control points and points of the surface.
    pub(super) fn corners(&self, degree: [usize; 2]) -> [DVec3; 4] {
        let [rows, columns] = degree.map(|degree| degree + 1);
        let last = (rows - 1) * columns;
        [0, columns - 1, last, last + columns - 1].map(|index| self.points[index])
    }

    /// Returns the patch's parameters at the mean of the control points' own, with these weights.
    pub(super) fn parameters(
        &self,
        degree: [usize; 2],
        weights: impl Iterator<Item = (usize, f64)>,
    ) -> [f64; 2] {
        let columns = degree[1] + 1;
        let mut fractions = [0.0; 2];
        for (index, weight) in weights {
            fractions[0] += weight * (index / columns) as f64 / degree[0] as f64;
            fractions[1] += weight * (index % columns) as f64 / degree[1] as f64;
        }
        self.range.at(fractions.map(|fraction| fraction.clamp(0.0, 1.0)))
    }
}

/// Returns an estimate of how far the hull of a net reaches beyond its surface, and the axis to
/// halve: the one of larger second differences, or of longer lines where the net only twists.
fn bend([p, q]: [usize; 2], points: &[DVec3]) -> (f64, Axis) {
    let columns = q + 1;
    let at = |i: usize, j: usize| points[i * columns + j];
    let [mut along_u, mut along_v, mut twist, mut lengths] = [0.0_f64, 0.0_f64, 0.0_f64, 0.0_f64];
    for i in 0..=p {
        for j in 0..=q {
            if i > 1 {
                along_u = along_u.max((at(i, j) - 2.0 * at(i - 1, j) + at(i - 2, j)).length());
            }
            if j > 1 {
                along_v = along_v.max((at(i, j) - 2.0 * at(i, j - 1) + at(i, j - 2)).length());
            }
            if i > 0 && j > 0 {
                twist = twist.max((at(i, j) - at(i - 1, j) - at(i, j - 1) + at(i - 1, j - 1)).length());
            }
        }
    }
    for i in 0..=p {
        lengths -= at(i, 0).distance(at(i, q));
    }
    for j in 0..=q {
        lengths += at(0, j).distance(at(p, j)) * (p + 1) as f64 / (q + 1) as f64;
    }
    let degrees = |p: usize, q: usize| (p * q) as f64;
    // Bounds on the distance from a curve to its chord, of an eighth of the second derivative.
    let [along_u, along_v] = [along_u * degrees(p, p - 1) / 8.0, along_v * degrees(q, q - 1) / 8.0];
    let twist = twist * degrees(p, q) / 4.0;
    let longer = if lengths > 0.0 { Axis::U } else { Axis::V };
    let axis = if along_u.max(along_v) < twist || along_u == along_v {
        longer
    } else if along_u > along_v {
        Axis::U
    } else {
        Axis::V
    };
    (along_u + along_v + twist, axis)
}
