//! Models of single patches, given by their nets.

use crate::approximation::bernstein::binomial;
use crate::bezier::{LocalDerivativeBounds, Patch, PatchSet, relative};
use crate::certified::cell_context::{CellContext, UpperBound};
use crate::certified::nearest::{Foot, NearestPoint};
use crate::certified::{Cell, Operand, Pair};
use crate::closest::Target;
use crate::model::RigidTransform;
use crate::param_box::ParamBox;
use glam::{DVec3, DVec4, Vec4Swizzles};

/// The rounding of a bound, relative to it.
pub(in crate::certified) const ROUNDING: f64 = 1e-11;

/// What the patches' controls are relative to, up to half of the first of them.
const CENTER: DVec3 = DVec3::new(0.5, -0.25, 0.125);

/// Degrees and homogeneous controls of one patch.
pub(in crate::certified) type Net = ([usize; 2], Vec<DVec4>);

/// One operand with what it borrows. Every patch is a surface of its own.
pub(in crate::certified) struct PatchModel {
    pub(in crate::certified) target: Target,
    bounds: Vec<LocalDerivativeBounds>,
}

impl PatchModel {
    pub(in crate::certified) fn new(nets: &[Net]) -> Self {
        let mut patches = PatchSet::default();
        for (surface, (degree, controls)) in nets.iter().enumerate() {
            // Not at the origin, and different for different models.
            let center = CENTER + 0.5 * controls[0].xyz() / controls[0].w;
            let local = relative(controls, center);
            patches.push(Patch {
                surface,
                degree: *degree,
                domain: ParamBox::UNIT,
                center,
                controls: &local,
                rational: controls.iter().any(|control| control.w != controls[0].w),
            });
        }
        let bounds = patches.iter().map(|_| LocalDerivativeBounds::new(ParamBox::UNIT)).collect();
        Self { target: Target::new(patches), bounds }
    }

    pub(in crate::certified) fn operand(&self) -> Operand<'_> {
        Operand::new(&self.target, &self.bounds)
    }
}

pub(in crate::certified) fn pair<'a>(a: &'a PatchModel, b: &'a PatchModel) -> Pair<'a> {
    Pair { a: a.operand(), b: b.operand(), transform: RigidTransform::IDENTITY }
}

/// The bound of a cell of A's first patch, from the foot on B's first patch.
pub(in crate::certified) fn evaluate(
    bound: &dyn UpperBound,
    a: &PatchModel,
    b: &PatchModel,
    cell: Cell,
    threshold: f64,
) -> Option<f64> {
    let pair = pair(a, b);
    let nearest = NearestPoint::new(pair.b);
    let mut context = CellContext::new(&pair, &nearest, cell, &Foot::start(0, [0.5; 2]));
    bound.evaluate(&mut context, threshold)
}

/// The Bernstein coefficients of `x^power` of this degree.
fn monomial(power: usize, degree: usize) -> Vec<f64> {
    (0..=degree).map(|i| if i < power { 0.0 } else { binomial(i, power) / binomial(degree, power) }).collect()
}

/// The graph z = height + factor s^a t^b over the unit square.
pub(in crate::certified) fn graph(height: f64, factor: f64, [a, b]: [usize; 2]) -> Net {
    let degree = [a.max(1), b.max(1)];
    let [s, t] = [0, 1].map(|axis| monomial(1, degree[axis]));
    let [in_s, in_t] = [monomial(a, degree[0]), monomial(b, degree[1])];
    let point = |i: usize, j: usize| DVec4::new(s[i], t[j], height + factor * in_s[i] * in_t[j], 1.0);
    let controls = (0..=degree[0]).flat_map(|i| (0..=degree[1]).map(move |j| (i, j)));
    (degree, controls.map(|(i, j)| point(i, j)).collect())
}

/// A bilinear patch with these corners: (s, t) = (0, 0), (0, 1), (1, 0), (1, 1).
pub(in crate::certified) fn bilinear(corners: [[f64; 3]; 4]) -> Net {
    ([1, 1], corners.map(|[x, y, z]| DVec4::new(x, y, z, 1.0)).to_vec())
}

/// The rectangle [low, high] x [-2, 3] in the plane z = 0.
pub(in crate::certified) fn plane([low, high]: [f64; 2]) -> Net {
    bilinear([[low, -2.0, 0.0], [low, 3.0, 0.0], [high, -2.0, 0.0], [high, 3.0, 0.0]])
}

/// A patch that is one point.
pub(in crate::certified) fn point(at: [f64; 3]) -> Net {
    bilinear([at; 4])
}

/// A patch that is the line between two points, along t.
pub(in crate::certified) fn line(from: [f64; 3], to: [f64; 3]) -> Net {
    bilinear([from, to, from, to])
}

/// Asserts that a bound is neither below a distance nor above it by more than a part.
#[track_caller]
pub(in crate::certified) fn assert_attained(bound: f64, distance: f64, excess: f64) {
    assert!(bound >= distance * (1.0 - ROUNDING), "{bound} is below {distance}");
    assert!(bound <= distance * (1.0 + excess + ROUNDING), "{bound} is far above {distance}");
}
