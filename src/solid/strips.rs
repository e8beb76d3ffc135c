//! The thin sets that close the cracks between the faces of a solid.

use super::curve::Curve;
use super::ray::Ray;
use crate::approximation::bernstein::elevated;
use crate::bezier::binomials;
use crate::bvh::Aabb;
use crate::rounding::{upper_max, upper_min};
use glam::{DVec3, DVec4, Vec4Swizzles};

/// The largest number of times that a strip is divided: its parts are then shorter than rounding.
const MAX_DEPTH: u32 = 40;

/// A set that no ray may come near.
#[derive(Debug, Clone)]
pub(super) enum Strip {
    /// The hull of some points about a corner.
    Corner(Vec<DVec3>),
    /// The segments between the points of two partners at one parameter (lemma S1 of docs/solids.md).
    Pair([Curve; 2]),
}

impl Strip {
    /// Returns a box around the strip.
    pub(super) fn bounding_box(&self) -> Aabb {
        match self {
            Self::Corner(points) => points.iter().copied().fold(Aabb::EMPTY, Aabb::with),
            Self::Pair(curves) => curves.iter().flat_map(Curve::points).fold(Aabb::EMPTY, Aabb::with),
        }
    }

    /// Returns a patch of degree 1 across the strip, which is the strip: its lines join the points of partners at one
    /// parameter. Of a corner, a box around it.
    pub(super) fn ruled(&self) -> Ruled {
        match self {
            Self::Corner(_) => {
                let aabb = self.bounding_box();
                let controls = aabb.corners().map(|corner| (corner - aabb.min).extend(1.0));
                Ruled { center: aabb.min, degree: 3, controls: controls.to_vec(), is_hull: true }
            }
            Self::Pair([a, b]) => {
                let degree = a.controls.len().max(b.controls.len()) - 1;
                let offset = b.center - a.center;
                let moved = |control: &DVec4| (control.xyz() + control.w * offset).extend(control.w);
                let other = b.controls.iter().map(moved).collect();
                let rows = [elevated(a.controls.clone(), degree), elevated(other, degree)];
                Ruled { center: a.center, degree, controls: rows.concat(), is_hull: false }
            }
        }
    }

    /// Returns true only if the ray certainly avoids the strip.
    pub(super) fn is_avoided(&self, ray: &Ray) -> bool {
        match self {
            Self::Corner(points) => ray.avoids(points.iter().copied()),
            Self::Pair(curves) => avoids(curves, ray, 0),
        }
    }
}

/// A patch of degree 1 in its first parameter.
#[derive(Debug, Clone)]
pub(crate) struct Ruled {
    pub(crate) center: DVec3,
    /// The degree in the second parameter.
    pub(crate) degree: usize,
    /// Homogeneous, relative to the centre.
    pub(crate) controls: Vec<DVec4>,
    /// Whether it is the hull of the control points that contains what it stands for, and not the patch.
    pub(crate) is_hull: bool,
}

/// The sizes at which strips are divided no further.
#[derive(Debug, Clone, Copy)]
pub(super) struct StripLimits {
    /// The radius of the tubes in which they are kept.
    pub(super) radius: f64,
    /// The width that is thin enough, whatever the distance of the edges.
    pub(super) width: f64,
}

/// Strips that cover all, with an upper bound on the distance of their points from the faces.
#[derive(Debug, Default)]
pub(super) struct Covering {
    pub(super) strips: Vec<Strip>,
    pub(super) thickness: f64,
    /// An upper bound on the area of all strips between pairs (lemma S6 of docs/solids.md), without the
    /// rounding of their edges, and on the mean length of both edges.
    pub(super) area: f64,
    pub(super) length: f64,
}

impl Covering {
    /// Adds the hull of points about a corner, ends of edges all of them.
    pub(super) fn add_corner(&mut self, points: Vec<DVec3>) {
        let extent = points.iter().copied().fold(Aabb::EMPTY, Aabb::with).diagonal();
        self.thickness = upper_max(self.thickness, extent);
        self.strips.push(Strip::Corner(points));
    }

    /// Adds the strips of another one.
    pub(super) fn add(&mut self, other: Self) {
        self.strips.extend(other.strips);
        self.thickness = upper_max(self.thickness, other.thickness);
        self.area += other.area;
        self.length += other.length;
    }

    /// Adds the strip between two curves in parts, each in a tube of about this radius and about as wide
    /// as the curves are apart, if that takes few.
    pub(super) fn add_pair(&mut self, curves: [Curve; 2], limits: StripLimits, depth: u32) {
        let curves = aligned(curves);
        let (radius, width) = (tube(&curves), width(&curves));
        let apart = curves[0].point(0.5).distance(curves[1].point(0.5));
        let is_narrow = width <= MAX_WIDTH_RATIO * apart + limits.width || depth >= MAX_WIDTH_DIVISIONS;
        if (radius <= limits.radius && is_narrow) || depth == MAX_DIVISIONS {
            // Lemma S1: a point of a segment is nearer than half its length to one of its ends.
            self.thickness = upper_max(self.thickness, upper_min(2.0 * radius, 0.5 * width));
            let length = 0.5 * (curves[0].polygon() + curves[1].polygon());
            self.area += width * length;
            self.length += length;
            self.strips.push(Strip::Pair(curves));
            return;
        }
        let [low, high] = halves(&curves);
        self.add_pair(low, limits, depth + 1);
        self.add_pair(high, limits, depth + 1);
    }
}

/// The largest number of times that a strip is divided before any ray meets it.
const MAX_DIVISIONS: u32 = 8;

/// The same for the width alone, of which each division leaves about an eighth.
const MAX_WIDTH_DIVISIONS: u32 = 5;

/// The width, relative to the distance of the middles, that is not worth a division.
const MAX_WIDTH_RATIO: f64 = 2.0;

/// Returns the largest distance of a control point of both curves from the chord of the first.
fn tube(curves: &[Curve; 2]) -> f64 {
    let [start, end] = curves[0].ends();
    let chord = end - start;
    let distance = |point: DVec3| {
        let along = (point - start).dot(chord) / chord.length_squared();
        // NaN comes from a chord without length.
        let along = if along.is_nan() { 0.0 } else { along.clamp(0.0, 1.0) };
        point.distance(start + along * chord)
    };
    curves.iter().flat_map(Curve::points).map(distance).fold(0.0, upper_max)
}

/// Returns an upper bound on the distance of the points of both curves at one parameter.
///
/// Guarantee (lemma S1 of docs/solids.md): the difference of the points is a convex combination of the
/// quotients of two sums of Bernstein polynomials of the sum of both degrees.
fn width([a, b]: &[Curve; 2]) -> f64 {
    let [of_a, of_b] = [a, b].map(|curve| curve.points().zip(&curve.controls).collect::<Vec<_>>());
    let [in_a, in_b] = [&of_a, &of_b].map(|points| binomials(points.len() - 1));
    let mut sums = vec![(DVec3::ZERO, 0.0); of_a.len() + of_b.len() - 1];
    for (i, (one, weight)) in of_a.iter().enumerate() {
        for (j, (other, other_weight)) in of_b.iter().enumerate() {
            let share = in_a[i] * in_b[j] * weight.w * other_weight.w;
            sums[i + j].0 += share * (*one - *other);
            sums[i + j].1 += share;
        }
    }
    sums.into_iter().map(|(difference, shares)| difference.length() / shares).fold(0.0, upper_max)
}

/// Returns the two curves with the second one in another parameter, in which its middle is near that of
/// the first one: the weights of a curve times the powers of a positive number are those of the curve in
/// a parameter that runs the same way.
fn aligned([a, mut b]: [Curve; 2]) -> [Curve; 2] {
    let middle = b.partner(a.point(0.5));
    let ratio = middle / (1.0 - middle);
    let mut power = 1.0;
    for control in &mut b.controls {
        *control *= power;
        power *= ratio;
    }
    [a, b]
}

/// Returns an upper bound on the distance of two curves' points that correspond in some way from both starts to both
/// ends, but for rounding (lemma S5 of docs/solids.md).
pub(crate) fn edge_width(curves: [Curve; 2]) -> f64 {
    width(&aligned(curves))
}

/// Returns the two halves of a strip.
fn halves(curves: &[Curve; 2]) -> [[Curve; 2]; 2] {
    let [[a_low, a_high], [b_low, b_high]] = [&curves[0], &curves[1]].map(|curve| curve.split(0.5));
    [[a_low, b_low], [a_high, b_high]]
}

/// Returns true only if the ray avoids the strip between two curves, which lies in the hulls of parts
/// at the same parameters.
fn avoids(curves: &[Curve; 2], ray: &Ray, depth: u32) -> bool {
    if ray.avoids(curves.iter().flat_map(Curve::points)) {
        return true;
    }
    if depth == MAX_DEPTH {
        return false;
    }
    halves(curves).iter().all(|half| avoids(half, ray, depth + 1))
}

/// The range of the partner of a middle: no part is empty.
const INTERIOR: [f64; 2] = [0.05, 0.95];

/// The number of steps toward the partner of a middle: any place is valid, and nearer ones make
/// narrower strips.
const PARTNER_STEPS: u32 = 6;

impl Curve {
    /// Returns the parameter near the middle whose point is near this one.
    fn partner(&self, point: DVec3) -> f64 {
        let mut t = 0.5;
        for _ in 0..PARTNER_STEPS {
            let next = self.step(t, point).clamp(INTERIOR[0], INTERIOR[1]);
            // NaN comes from a cusp, where the steps end; where they stay, all that follow do.
            if next.is_nan() || next == t {
                break;
            }
            t = next;
        }
        t
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    fn line(start: [f64; 3], end: [f64; 3]) -> Curve {
        let controls = [start, end].map(|point| DVec3::from_array(point).extend(1.0)).to_vec();
        Curve { center: DVec3::ZERO, controls }
    }

    fn upwards(x: f64, y: f64) -> Ray {
        Ray::new(DVec3::new(x, y, 0.0), DVec3::Z, 1e-9)
    }

    /// Lemma S6, attained: two parallel lines have a rectangle between them.
    #[test]
    fn a_strip_between_parallel_lines_has_the_area_of_a_rectangle() {
        let mut covering = Covering::default();
        let lines = [0.0, 0.01].map(|y| line([0.0, y, 0.0], [2.0, y, 0.0]));
        covering.add_pair(lines, StripLimits { radius: 1.0, width: 1.0 }, 0);
        let rounding = 1e-12;
        assert!((0.02 - rounding..0.02 + rounding).contains(&covering.area), "{covering:?}");
        assert!((2.0..2.0 + rounding).contains(&covering.length), "{covering:?}");
    }

    /// A cone over the points of a corner is within their extent of each.
    #[test]
    fn a_corner_is_as_thick_as_its_points_are_apart() {
        let mut covering = Covering::default();
        covering.add_corner(vec![DVec3::ONE, DVec3::ONE + DVec3::new(3.0, 0.0, 4.0)]);
        covering.add_corner(vec![DVec3::ZERO]);
        assert_eq!(covering.thickness, 5.0);
    }

    /// The patch of a strip between curves of different degrees, weights and centres has their points at each parameter
    /// on its sides; that of a corner is its box.
    #[test]
    fn a_strip_is_its_patch_and_a_corner_within_the_hull_of_its_own() {
        let [a, b] = [DVec3::ZERO, DVec3::new(0.5, -1.0, 2.0)];
        let bent =
            [DVec4::new(0.0, 0.0, 0.0, 1.0), DVec4::new(2.0, 1.0, 0.5, 2.0), DVec4::new(1.0, 2.0, 0.0, 0.5)];
        let straight = [DVec4::new(0.0, 0.1, 0.0, 1.5), DVec4::new(3.0, 0.5, 1.0, 1.0)];
        let curves = [(a, bent.to_vec()), (b, straight.to_vec())];
        let curves = curves.map(|(center, controls)| Curve { center, controls });
        let strip = Strip::Pair(curves.clone()).ruled();
        assert!(!strip.is_hull && strip.degree == 2);
        for (side, curve) in strip.controls.chunks(3).zip(&curves) {
            let side = Curve { center: strip.center, controls: side.to_vec() };
            for t in [0.0, 0.3, 0.8, 1.0] {
                assert!(side.point(t).distance(curve.point(t)) < 1e-14, "{t}");
            }
        }
        assert!(Strip::Corner(vec![DVec3::ZERO, DVec3::ONE]).ruled().is_hull);
    }

    #[test]
    fn a_ray_through_the_hull_of_a_corner_does_not_avoid_it() {
        let corner =
            Strip::Corner([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]].map(|[x, y]| DVec3::new(x, y, 2.0)).to_vec());
        assert!(!corner.is_avoided(&upwards(0.3, 0.3)));
        assert!(corner.is_avoided(&upwards(-0.1, 0.3)));
        assert!(corner.is_avoided(&upwards(0.6, 0.6)));
    }

    /// Two edges with a ray between them, far from both.
    #[test]
    fn a_ray_between_two_partners_does_not_avoid_their_strip() {
        let curves = [line([-1.0, -3.0, 2.0], [-1.0, 3.0, 2.0]), line([1.0, -3.0, 2.5], [1.0, 3.0, 2.5])];
        let strip = Strip::Pair(curves);
        assert!(!strip.is_avoided(&upwards(0.0, 0.1)));
        assert!(strip.is_avoided(&upwards(1.1, 0.1)) && strip.is_avoided(&upwards(0.0, 3.1)));
        let aabb = strip.bounding_box();
        assert_eq!([aabb.min, aabb.max], [DVec3::new(-1.0, -3.0, 2.0), DVec3::new(1.0, 3.0, 2.5)]);
        let leaves = upwards(1.0, 0.1).leaves(&crate::bvh::Bvh::new(&[aabb]));
        assert_eq!(leaves.len(), 1, "the box has both curves");
    }

    const LIMITS: StripLimits = StripLimits { radius: 0.5, width: 1e-9 };

    fn thickness(curves: [Curve; 2]) -> f64 {
        let mut covering = Covering::default();
        covering.add_pair(curves, LIMITS, 0);
        covering.thickness
    }

    /// The points between parallel edges are nearer than half their distance to one of them, and those
    /// in the middle are not nearer (lemma S1).
    #[test]
    fn a_strip_is_half_as_thick_as_its_edges_are_apart() {
        let curves = [line([0.0; 3], [1.0, 0.0, 0.0]), line([0.0, 0.25, 0.0], [1.0, 0.25, 0.0])];
        assert_eq!(thickness(curves), 0.125);
    }

    /// A quarter of a circle about the z axis at this height, as a conic whose weights have this ratio:
    /// other ratios are other parameters.
    fn quarter(radius: f64, height: f64, ratio: f64) -> Curve {
        let controls =
            [[1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].iter().zip([1.0, 0.5_f64.sqrt(), 1.0]).enumerate();
        let control = |(index, (&[x, y], weight)): (usize, (&[f64; 2], f64))| {
            let weight = weight * ratio.powi(index as i32);
            (weight * DVec3::new(radius * x, radius * y, height)).extend(weight)
        };
        Curve { center: DVec3::ZERO, controls: controls.map(control).collect() }
    }

    /// Arcs whose points are as far apart everywhere, in whichever parameters: the bound is that distance
    /// where the difference is one vector, and at most that of the control points, √2 times it, where it
    /// turns with the arc.
    #[test]
    fn the_width_of_a_strip_between_two_arcs_is_about_their_distance() {
        const TINY: f64 = 1e-9;
        for ratio in [1.0, 0.3, 4.0] {
            for (radius, height, distance, most) in [
                (1.0, 0.0, 0.0, 1.0),
                (1.0, 1e-6, 1e-6, 1.0),
                (1.0 + 1e-6, 0.0, 1e-6, std::f64::consts::SQRT_2),
            ] {
                let found = thickness([quarter(1.0, 0.0, 1.0), quarter(radius, height, ratio)]);
                let half = 0.5 * distance;
                assert!(
                    half - TINY <= found && found <= most * half + TINY,
                    "{ratio}: {found:e} for {half:e}"
                );
            }
        }
    }

    /// A parabola that rises to 0.1 above a straight edge with the same ends: the bound is that of the
    /// coefficients of degree 3.
    #[test]
    fn the_width_of_a_strip_bounds_the_distance_of_its_edges() {
        let controls = [[0.0, 0.0], [0.5, 0.2], [1.0, 0.0]].map(|[x, y]| DVec3::new(x, y, 0.0).extend(1.0));
        let bow = Curve { center: DVec3::ZERO, controls: controls.to_vec() };
        let found = width(&[bow, line([0.0; 3], [1.0, 0.0, 0.0])]);
        // Both inner ones are two thirds of the middle control point's height.
        assert!((found - 0.4 / 3.0).abs() < 1e-15 && found > 0.1, "{found}");
    }

    /// A curve that overflowed has no width.
    #[test]
    fn a_strip_with_points_that_overflowed_has_no_bound() {
        let lost = line([0.0, f64::NAN, 0.0], [1.0, 0.0, 0.0]);
        assert_eq!(thickness([line([0.0; 3], [1.0, 0.0, 0.0]), lost]), f64::INFINITY);
    }
}
