//! Rational Bézier pieces of trimming curves.

use glam::{DVec2, DVec3, Vec3Swizzles};

/// A rational Bézier piece of a trimming curve.
#[derive(Debug, Clone, PartialEq)]
pub struct TrimPiece {
    /// Homogeneous controls `(w u, w v, w)`, w > 0, degree + 1 of them; the first and the
    /// last have w = 1, so that the piece's ends are the floats u and v themselves.
    pub controls: Vec<DVec3>,
    /// The index of the curve in its loop.
    pub curve: u32,
}

/// Returns the point of homogeneous coordinates `(w u, w v, w)`.
pub(super) fn point_of(control: DVec3) -> DVec2 {
    control.xy() / control.z
}

/// Returns the homogeneous coordinates of a point of this weight.
pub(super) fn homogeneous(point: DVec2, weight: f64) -> DVec3 {
    (weight * point).extend(weight)
}

impl TrimPiece {
    /// Returns the degree.
    #[must_use]
    pub fn degree(&self) -> usize {
        self.controls.len() - 1
    }

    /// Returns the first point (u, v).
    #[must_use]
    pub fn start(&self) -> DVec2 {
        point_of(self.controls[0])
    }

    /// Returns the last point (u, v).
    #[must_use]
    pub fn end(&self) -> DVec2 {
        point_of(self.controls[self.controls.len() - 1])
    }

    /// Returns the control points (u, v).
    pub fn points(&self) -> impl Iterator<Item = DVec2> + '_ {
        self.controls.iter().copied().map(point_of)
    }

    /// Returns the two halves, which share the middle point's floats. O(degree²).
    pub(super) fn halves(&self) -> [Self; 2] {
        let order = self.controls.len();
        let (mut low, mut high) = (self.clone(), self.clone());
        for level in 1..order {
            for index in 0..order - level {
                high.controls[index] = 0.5 * (high.controls[index] + high.controls[index + 1]);
            }
            low.controls[level] = high.controls[0];
        }
        [low, high]
    }

    /// Makes the weights at both ends 1 by a linear rational reparametrization, which
    /// leaves the image of the piece unchanged (G. Farin, *Curves and Surfaces for CAGD*,
    /// section on the reparametrization of rational curves).
    pub(super) fn normalize_weights(&mut self) {
        let degree = self.degree();
        let [first, last] = [self.controls[0].z, self.controls[degree].z];
        if first == 1.0 && last == 1.0 {
            return;
        }
        for (index, control) in self.controls.iter_mut().enumerate() {
            let fraction = index as f64 / degree as f64;
            let factor = first.powf(1.0 - fraction) * last.powf(fraction);
            let ends = index == 0 || index == degree;
            let weight = if ends { 1.0 } else { control.z / factor };
            *control = homogeneous(point_of(*control), weight);
        }
    }

    /// Returns the signed area between the piece and `origin`, `½ ∫ u dv - v du` about it,
    /// by Gauss's rule: exact up to rounding for polynomial pieces, else an estimate.
    #[must_use]
    pub fn signed_area(&self, origin: DVec2) -> f64 {
        let moved = self.controls.iter().map(|control| homogeneous(point_of(*control) - origin, control.z));
        let controls: Vec<DVec3> = moved.collect();
        GAUSS.iter().map(|&[t, weight]| weight * area_density(&controls, t)).sum()
    }
}

/// Returns the rate at which the area between the origin and a rational Bézier curve grows.
fn area_density(controls: &[DVec3], t: f64) -> f64 {
    let order = controls.len();
    let mut controls = controls.to_vec();
    for level in 1..order - 1 {
        for index in 0..order - level {
            controls[index] = (1.0 - t) * controls[index] + t * controls[index + 1];
        }
    }
    // u dv - v du of (x / w, y / w) is (x dy - y dx) / w².
    let value = (1.0 - t) * controls[0] + t * controls[1];
    let slope = (order - 1) as f64 * (controls[1] - controls[0]);
    0.5 * value.xy().perp_dot(slope.xy()) / (value.z * value.z)
}

/// The nodes and weights on [0, 1] of Gauss's rule of 16 points, exact to degree 31:
/// the integrand of a polynomial piece has degree 2 · 15 - 1.
const GAUSS: [[f64; 2]; 16] = gauss();

/// Returns the nodes and weights from those of the half range [0, 1] of [-1, 1].
const fn gauss() -> [[f64; 2]; 16] {
    let half = [
        [0.095_012_509_837_637_44, 0.189_450_610_455_068_5],
        [0.281_603_550_779_258_9, 0.182_603_415_044_923_6],
        [0.458_016_777_657_227_4, 0.169_156_519_395_002_5],
        [0.617_876_244_402_643_7, 0.149_595_988_816_576_7],
        [0.755_404_408_355_003, 0.124_628_971_255_533_9],
        [0.865_631_202_387_831_7, 0.095_158_511_682_492_8],
        [0.944_575_023_073_232_6, 0.062_253_523_938_647_9],
        [0.989_400_934_991_649_9, 0.027_152_459_411_754_1],
    ];
    let mut rule = [[0.0; 2]; 16];
    let mut index = 0;
    while index < 8 {
        let [node, weight] = half[index];
        rule[2 * index] = [0.5 - 0.5 * node, 0.5 * weight];
        rule[2 * index + 1] = [0.5 + 0.5 * node, 0.5 * weight];
        index += 1;
    }
    rule
}
