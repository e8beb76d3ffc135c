//! The distance of a finished patch from the composition, proven from values.

use crate::approximation::chebyshev::{node_factor, nodes};
use crate::bezier::{Patch, binomials};
use crate::limits::MAX_DEGREE;
use crate::rounding::{gamma, upper_max};
use crate::untrim::cells::ruling::Ruling;
use crate::untrim::curve::divided;
use crate::untrim::face::UnitFace;
use glam::{DVec2, DVec4, Vec4Swizzles};

/// A surface composed with a ruled map.
pub(super) struct Composition<'a> {
    pub(super) face: &'a UnitFace,
    pub(super) patch: Patch<'a>,
    pub(super) ruling: &'a Ruling,
    /// The degrees in s and t of its homogeneous form, at most.
    pub(super) degree: [usize; 2],
}

impl Composition<'_> {
    /// Returns the radius of the patch about its centre.
    pub(super) fn radius(&self) -> f64 {
        self.patch.local_points().map(|point| point.length()).fold(0.0, upper_max)
    }

    /// Returns an upper bound on the distance between S(φ(s, t)) and the point at (s, t) of the
    /// Bézier patch of degrees `[m, n]` with these homogeneous controls, relative to the centre of
    /// S's patch (lemma T4 of docs/trimming.md).
    ///
    /// Both are evaluated at nodes, S at the points of φ; how the patch was made has no influence.
    /// The difference of the homogeneous forms is a polynomial, which its values at the nodes
    /// bound (lemma T5). O(nodes × controls).
    pub(super) fn deviation(&self, [m, n]: [usize; 2], controls: &[DVec4]) -> f64 {
        let Self { face, patch, ruling, degree } = *self;
        // The degrees of the difference, whatever those of the finished patch are.
        let [along_s, along_t] = [degree[0].max(m), degree[1].max(n)];
        // The fewest nodes: twice as many would cost as much as the cut for half of the bound.
        let counts = [along_s + 1, along_t + 1];
        let radius = self.radius();
        let twist = if face.affine { face.twist } else { 0.0 };
        // A value takes 6 roundings a degree, and its weight's power 4, of terms whose sizes sum to
        // at most the radius times its weight.
        let [p, q] = patch.degree;
        let roundings = 6.0 * (p + q + m + n) as f64 + 4.0 * (p + q) as f64 + 32.0;
        let rounding = 2.0 * gamma(roundings) * radius;
        let mut error = 0.0_f64;
        let across: Vec<_> = nodes(counts[0]).map(|s| (s, bernstein(m, s))).collect();
        for t in nodes(counts[1]) {
            let basis = bernstein(n, t);
            let line: Vec<DVec4> = controls.chunks_exact(n + 1).map(|row| combined(row, &basis)).collect();
            let [left, right] = [&ruling.left, &ruling.right].map(|curve| curve.at(t));
            let weight = self.weight(left.z, right.z);
            let row = Row::new(face, patch, ruling, [divided(left), divided(right)]);
            for (s, basis) in &across {
                let (own, made) = (row.at(*s) * weight, combined(&line, basis));
                let difference = own - made;
                let found = difference.xyz().length() + radius * difference.w.abs();
                error = upper_max(error, found + rounding * (own.w + made.w) + twist * own.w);
            }
        }
        let least = controls.iter().map(|control| control.w).fold(f64::INFINITY, f64::min);
        let factor = node_factor(along_s, counts[0]) * node_factor(along_t, counts[1]);
        let far = gamma(4.0) * patch.center.length() + face.patches.point_error.after(0);
        error * factor / least + 2.0 * twist + far
    }

    /// Returns the factor that makes the composition a polynomial in t.
    fn weight(&self, left: f64, right: f64) -> f64 {
        let power = if self.face.affine { 1 } else { self.patch.degree.iter().sum::<usize>() };
        let weight = if self.ruling.height.is_some() { left } else { left * right };
        weight.powi(power as i32)
    }
}

/// The patch along one ruling.
struct Row<'a> {
    patch: Patch<'a>,
    /// The ends of the ruling in the patch's parameters.
    ends: [DVec2; 2],
    /// The controls of the curve of constant v, if the ruling is one.
    line: Option<Vec<DVec4>>,
}

impl<'a> Row<'a> {
    fn new(face: &UnitFace, patch: Patch<'a>, ruling: &Ruling, ends: [DVec2; 2]) -> Self {
        let rectangle = face.rectangle(ruling.rectangle);
        let (low, lengths) = (DVec2::from(rectangle.low()), DVec2::from(rectangle.lengths()));
        let ends = ends.map(|end| (end - low) / lengths);
        let line = ruling.height.is_some().then(|| {
            let basis = bernstein(patch.degree[1], ends[0].y);
            patch.controls.chunks_exact(patch.degree[1] + 1).map(|row| combined(row, &basis)).collect()
        });
        Self { patch, ends, line }
    }

    /// Returns the homogeneous point of the patch.
    fn at(&self, s: f64) -> DVec4 {
        let point = self.ends[0] * (1.0 - s) + self.ends[1] * s;
        let [p, q] = self.patch.degree;
        let basis = bernstein(p, point.x);
        if let Some(line) = &self.line {
            return combined(line, &basis);
        }
        let across = bernstein(q, point.y);
        let columns = self.patch.controls.chunks_exact(q + 1).zip(basis);
        columns.fold(DVec4::ZERO, |sum, (column, share)| sum + combined(column, &across) * share)
    }
}

/// Returns the values of the Bernstein polynomials of this degree, each with at most
/// 2 degree + 1 roundings: binomials are exact. O(degree).
fn bernstein(degree: usize, t: f64) -> [f64; MAX_DEGREE + 1] {
    let mut values = [0.0; MAX_DEGREE + 1];
    let mut power = 1.0;
    for (value, binomial) in values.iter_mut().zip(binomials(degree)) {
        *value = binomial * power;
        power *= t;
    }
    power = 1.0;
    for value in values[..=degree].iter_mut().rev() {
        *value *= power;
        power *= 1.0 - t;
    }
    values
}

/// Returns the sum of controls times Bernstein polynomials.
fn combined(controls: &[DVec4], basis: &[f64]) -> DVec4 {
    controls.iter().zip(basis).fold(DVec4::ZERO, |sum, (&control, &share)| sum + control * share)
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::approximation::chebyshev::{coefficients, to_bernstein};
    use crate::model::{NurbsSurface, SurfaceArrays};
    use crate::untrim::curve::Curve;
    use crate::untrim::testing::{face_within, plane};

    /// Two sides of a trapezium.
    const SIDES: [[[f64; 2]; 2]; 2] = [[[0.1, 0.2], [0.3, 0.8]], [[0.7, 0.2], [0.9, 0.8]]];

    /// A rational biquadratic surface over [0, 1]², whose first corner is this.
    fn surface(corner: f64) -> NurbsSurface {
        let control_points = (0..9)
            .map(|k| {
                let (i, j) = (f64::from(k / 3), f64::from(k % 3));
                [corner + i, j, (i * j).sin(), 1.0 + 0.2 * (i - j)]
            })
            .collect();
        let knots = vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0];
        let arrays =
            SurfaceArrays { degree: [2, 2], knots: [knots.clone(), knots], counts: [3, 3], control_points };
        NurbsSurface::new(0, arrays).unwrap()
    }

    /// The trapezium in a surface, and a map onto it.
    fn face_and_ruling_on(surface: &NurbsSurface) -> (UnitFace, Ruling) {
        let [[a, d], [b, c]] = SIDES;
        let ruling =
            Ruling::between_lines(SIDES.map(|[from, to]| Curve::line(from.into(), to.into())), [0, 0]);
        (face_within(surface, &[&[a, b, c, d]]), ruling)
    }

    fn face_and_ruling() -> (UnitFace, Ruling) {
        face_and_ruling_on(&surface(0.0))
    }

    /// The point of a patch at the largest value of a Bernstein polynomial.
    fn point(degree: [usize; 2], controls: &[DVec4], index: usize) -> glam::DVec3 {
        let order = degree[1] + 1;
        let at = [index / order, index % order];
        let basis = [0, 1].map(|axis| bernstein(degree[axis], at[axis] as f64 / degree[axis] as f64));
        let line: Vec<DVec4> = controls.chunks_exact(order).map(|row| combined(row, &basis[1])).collect();
        let sum = combined(&line, &basis[0]);
        sum.xyz() / sum.w
    }

    #[test]
    fn a_moved_control_point_is_seen_whichever_it_is() {
        let (face, ruling) = face_and_ruling();
        let composed = crate::untrim::patch::composed(&face, &ruling).unwrap();
        let patch = face.patch([0, 0]);
        let composition = Composition { face: &face, patch, ruling: &ruling, degree: [2, 4] };
        let degree = composed.surface.degree();
        let exact = crate::untrim::patch::relative(&composed.surface, patch.center);
        let deviation = composition.deviation(degree, &exact);
        assert_eq!(deviation, composed.deviation);
        assert!(deviation < 4e-10, "{deviation}");
        for index in 0..exact.len() {
            let mut moved = exact.clone();
            moved[index].z += 1e-3 * moved[index].w;
            let found = composition.deviation(degree, &moved);
            // The point at the largest value of the Bernstein polynomials moves by this share.
            let largest = |n: usize, k: usize| bernstein(n, k as f64 / n as f64)[k];
            let order = degree[1] + 1;
            let share = largest(degree[0], index / order) * largest(degree[1], index % order);
            assert!(found > 0.5e-3 * share && found < 8e-3, "{index}: {found} {share}");
            // A weight of its own, which the homogeneous points do not show.
            let mut heavier = exact.clone();
            heavier[index].w *= 1.001;
            let found = composition.deviation(degree, &heavier);
            let [from, to] = [&exact, &heavier].map(|net| point(degree, net, index));
            assert!(found >= from.distance(to) && found > 1e-5 * share, "{index}: {found} {share}");
        }
    }

    /// The largest value of the polynomial of a degree that is 1 and -1 at the nodes in turn, as
    /// Bernstein coefficients: at the end, where it is the nodes' Lebesgue constant.
    fn alternating(degree: usize) -> Vec<f64> {
        let values: Vec<f64> = (0..=degree).map(|k| if k % 2 == 0 { 1.0 } else { -1.0 }).collect();
        to_bernstein(&coefficients(&values), degree)
    }

    /// A difference that is small at all nodes and largest at a corner: the factors of both parameters count.
    #[test]
    fn the_deviation_at_a_corner_is_more_than_at_the_nodes() {
        let (face, ruling) = face_and_ruling();
        let composed = crate::untrim::patch::composed(&face, &ruling).unwrap();
        let patch = face.patch([0, 0]);
        let exact = crate::untrim::patch::relative(&composed.surface, patch.center);
        let [m, n] = composed.surface.degree();
        let composition = Composition { face: &face, patch, ruling: &ruling, degree: [m, n] };
        let (along_s, along_t) = (alternating(m), alternating(n));
        let moved: Vec<DVec4> = exact
            .iter()
            .enumerate()
            .map(|(index, &control)| {
                let height = 1e-3 * along_s[index / (n + 1)] * along_t[index % (n + 1)];
                control + height * DVec4::Z
            })
            .collect();
        let corner = moved.len() - 1;
        let distance = (moved[corner] - exact[corner]).length() / exact[corner].w;
        let found = composition.deviation([m, n], &moved);
        assert!(found >= distance && found <= 2.0 * distance, "{found} {distance}");
    }

    /// The degrees stated are not relied on where the finished patch has higher ones.
    #[test]
    fn a_patch_of_a_higher_degree_has_as_many_nodes_as_it_needs() {
        let (face, ruling) = face_and_ruling();
        let composed = crate::untrim::patch::composed(&face, &ruling).unwrap();
        let patch = face.patch([0, 0]);
        let exact = crate::untrim::patch::relative(&composed.surface, patch.center);
        let degree = composed.surface.degree();
        let deviation = |degree_of_composition| {
            let composition =
                Composition { face: &face, patch, ruling: &ruling, degree: degree_of_composition };
            composition.deviation(degree, &exact)
        };
        assert_eq!(deviation([0, 0]), deviation(degree));
    }

    /// Values that agree exactly are known up to the rounding of lemma T4.
    #[test]
    fn the_rounding_of_values_is_added() {
        let (face, ruling) = face_and_ruling();
        let composed = crate::untrim::patch::composed(&face, &ruling).unwrap();
        let patch = face.patch([0, 0]);
        let exact = crate::untrim::patch::relative(&composed.surface, patch.center);
        let [m, n] = composed.surface.degree();
        let composition = Composition { face: &face, patch, ruling: &ruling, degree: [m, n] };
        let rounding = 2.0 * gamma(6.0 * (4 + m + n) as f64 + 16.0 + 32.0) * composition.radius();
        let factor = node_factor(m, m + 1) * node_factor(n, n + 1);
        // Twice, as two values are compared; no weight is below the least one.
        let found = composition.deviation([m, n], &exact);
        assert!(found >= 2.0 * rounding * factor, "{found} {rounding}");
    }

    /// A patch that is moved by h is h away, whatever unit its weights are in.
    #[test]
    fn small_weights_do_not_hide_a_move() {
        let (face, mut ruling) = face_and_ruling();
        for side in [&mut ruling.left, &mut ruling.right] {
            side.controls.iter_mut().for_each(|control| *control *= 0.5);
        }
        let composed = crate::untrim::patch::composed(&face, &ruling).unwrap();
        let patch = face.patch([0, 0]);
        let mut moved = crate::untrim::patch::relative(&composed.surface, patch.center);
        assert!(moved.iter().all(|control| control.w < 0.25));
        moved.iter_mut().for_each(|control| control.z += 1e-3 * control.w);
        let degree = composed.surface.degree();
        let composition = Composition { face: &face, patch, ruling: &ruling, degree };
        assert!(composition.deviation(degree, &moved) >= 1e-3);
    }

    /// The deviation of the patch that is made on the trapezium, and the centre of the surface's.
    fn deviation_on(face: &UnitFace, ruling: &Ruling) -> (f64, glam::DVec3) {
        let composed = crate::untrim::patch::composed(face, ruling).unwrap();
        (composed.deviation, face.patch([0, 0]).center)
    }

    /// A surface far from the origin loses digits when its centre is added, and in extraction.
    #[test]
    fn the_rounding_about_the_centre_is_added() {
        let (face, ruling) = face_and_ruling_on(&surface(1e6));
        let (deviation, center) = deviation_on(&face, &ruling);
        let added = gamma(4.0) * center.length() + face.patches.point_error.after(0);
        assert!(face.patches.point_error.after(0) > 1e-10 && gamma(4.0) * center.length() > 4e-10);
        assert!(deviation >= added, "{deviation} {added}");
    }

    /// Of a plane the corners' affine map is compared: each value is off by the twist, and so are
    /// both ends of a patch.
    #[test]
    fn the_twist_of_a_plane_counts_at_values_and_at_ends() {
        let (mut face, ruling) = face_and_ruling_on(&plane());
        assert!(face.affine);
        face.twist = 0.0;
        let (without, _) = deviation_on(&face, &ruling);
        face.twist = 1e-12;
        let (with, _) = deviation_on(&face, &ruling);
        assert!(with - without >= 3.0 * face.twist, "{with} {without}");
    }
}
