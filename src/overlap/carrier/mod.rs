//! Quadrics that patches lie on or nearly so, such as the cylinder of a hole.
//!
//! How well they fit is a matter of how soon a search ends, and of no bound: each use bounds their functions anew.

mod fit;
mod form;

use super::piece::{Piece, Whole};
use crate::rounding::{gamma, upper_max};
use glam::{DMat3, DVec3, DVec4, Vec4Swizzles};

pub(super) use form::Form;

/// The largest value of a carrier on a piece that counts as lying on it, relative to the piece's radius. It is larger than
/// the rounding of a fit, and far smaller than the distance of boundaries that carriers tell apart.
pub(super) const EXACT: f64 = 1e-9;

/// The roundings of a bound on a slope.
const SLOPE_ROUNDINGS: f64 = 16.0;

/// A polynomial f of degree 2 in space, small on some pieces of a boundary.
#[derive(Debug)]
pub(super) struct Carrier {
    origin: DVec3,
    /// f(x) = constant + gradient·d + d·matrix d with d = x − origin; the matrix is symmetric.
    constant: f64,
    gradient: DVec3,
    matrix: DMat3,
    /// An upper bound on the norm of the matrix.
    curvature: f64,
}

impl Carrier {
    /// Returns a carrier of pieces, about a middle and for a direction in which it has a slope of 1; `None` where they
    /// have none.
    pub(super) fn of(pieces: &[(&Whole, &Piece)], middle: DVec3, normal: DVec3, radius: f64) -> Option<Self> {
        let local = fit::Local::new(pieces, middle, normal, radius)?;
        let frame = local.frame;
        let gradient = frame * local.gradient;
        let matrix = frame * local.matrix * frame.transpose() * (1.0 / radius);
        // The halves of sums are exact, so that the matrix is its own transpose.
        let matrix = (matrix + matrix.transpose()) * 0.5;
        let squares: f64 =
            [matrix.x_axis, matrix.y_axis, matrix.z_axis].map(DVec3::length_squared).iter().sum();
        let curvature = squares.sqrt() * (1.0 + gamma(SLOPE_ROUNDINGS));
        let constant = local.constant * radius;
        let is_finite = constant.is_finite() && gradient.is_finite() && curvature.is_finite();
        is_finite.then_some(Self { origin: middle, constant, gradient, matrix, curvature })
    }

    /// Returns an upper bound on the length of the gradient of f within this distance of a point.
    pub(super) fn slope(&self, point: DVec3, distance: f64) -> f64 {
        let farthest = point.distance(self.origin) + distance;
        (self.gradient.length() + 2.0 * self.curvature * farthest) * (1.0 + gamma(SLOPE_ROUNDINGS))
    }

    /// Returns f at a point, with its roundings.
    pub(super) fn at(&self, point: DVec3) -> f64 {
        let offset = point - self.origin;
        self.constant + (self.gradient + self.matrix * offset).dot(offset)
    }

    /// Returns the dual of a homogeneous point: the product of one point with that of another one is f's polar form.
    fn dual(&self, point: DVec4) -> DVec4 {
        let half = 0.5 * self.gradient;
        let vector = self.matrix * point.xyz() + point.w * half;
        vector.extend(half.dot(point.xyz()) + self.constant * point.w)
    }

    /// Returns an upper bound on the sum of the sizes of the terms of f within this distance of the origin.
    fn size(&self, distance: f64) -> f64 {
        // The sums of the sizes of coordinates of unit vectors are at most √3, and those of their products 3.
        self.constant.abs() + distance * (2.0 * self.gradient.length() + 3.0 * self.curvature * distance)
    }
}

/// A carrier with an upper bound on its size on what it was made for.
#[derive(Debug)]
pub(super) struct Fitted {
    pub(super) carrier: Carrier,
    pub(super) reach: f64,
}

impl Fitted {
    /// Returns the carrier of a piece; `None` for a strip, or if no quadric was found.
    pub(super) fn new(whole: &Whole, piece: &Piece) -> Option<Self> {
        if whole.is_strip {
            return None;
        }
        let normal = super::separation::normal((whole, piece));
        let carrier = Carrier::of(&[(whole, piece)], piece.middle, normal, piece.radius)?;
        let [low, high] = Form::new(&carrier, whole, piece).range();
        let reach = upper_max(-low, high);
        reach.is_finite().then_some(Self { carrier, reach })
    }

    /// Returns whether f is at most this large on a piece.
    pub(super) fn is_within(&self, whole: &Whole, piece: &Piece, reach: f64) -> bool {
        let are_corners = whole.corners(piece).iter().all(|&corner| self.carrier.at(corner).abs() <= reach);
        let range = || Form::new(&self.carrier, whole, piece).range();
        are_corners && range().iter().all(|value| value.abs() <= reach)
    }

    /// Returns whether this is the carrier of a piece that has no point within `margin` of another one: it is farther
    /// above or below on all of that than here.
    pub(super) fn tells(&self, whole: &Whole, piece: &Piece, margin: f64) -> bool {
        let level = self.reach + self.carrier.slope(piece.middle, piece.radius + margin) * margin;
        // Corners are points of the piece, and tell most at once.
        let corners = whole.corners(piece).map(|corner| self.carrier.at(corner));
        if !(corners.iter().all(|&value| value > level) || corners.iter().all(|&value| value < -level)) {
            return false;
        }
        let [low, high] = Form::new(&self.carrier, whole, piece).range();
        low > level || high < -level
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::bezier::extract;
    use crate::model::Model;
    use crate::overlap::BoundarySide;
    use crate::overlap::piece::Patches;
    use crate::shapes;

    fn patches(model: &Model) -> Patches {
        Patches::new(&extract(model).patches, std::iter::empty(), None, |_| BoundarySide::Outward)
    }

    #[test]
    fn patches_of_planes_spheres_and_cylinders_lie_on_their_carriers() {
        for model in [shapes::sphere(DVec3::new(3.0, 1.0, 2.0), 2.0), shapes::cylinder(1.0, 3.0)] {
            for whole in patches(&model.unwrap()).faces() {
                let fitted = whole.carrier(&whole.root).unwrap();
                assert!(fitted.reach < 1e-11, "{fitted:?}");
            }
        }
    }

    /// The carrier of a sphere of radius r is about (|x − c|² − r²)/2r next to it.
    #[test]
    fn a_carrier_has_about_the_height_over_its_surface() {
        let center = DVec3::new(3.0, 1.0, 2.0);
        for whole in patches(&shapes::sphere(center, 2.0).unwrap()).faces() {
            let carrier = &whole.carrier(&whole.root).unwrap().carrier;
            let outward = (whole.root.middle - center).normalize();
            let sign = carrier.gradient.dot(outward).signum();
            for height in [-0.01, 0.01] {
                let value = sign * carrier.at(center + (2.0 + height) * outward);
                assert!((value / height - 1.0).abs() < 0.4, "{value} at {height}");
            }
        }
    }

    /// Of a torus what a carrier is off by falls as the third power of a piece's size.
    #[test]
    fn a_carrier_is_off_a_piece_by_the_third_order() {
        let patches = patches(&shapes::torus(2.0, 0.5).unwrap());
        let whole = patches.faces().next().unwrap();
        let mut piece = &whole.root;
        let mut last = (f64::INFINITY, f64::INFINITY);
        for _ in 0..5 {
            let reach = whole.carrier(piece).unwrap().reach;
            assert!(reach < 0.2 * last.0 || last.0 == f64::INFINITY, "{reach} after {last:?}");
            last = (reach, piece.radius);
            // Both axes.
            piece = whole.halves(whole.halves(piece).unwrap()[1]).unwrap()[0];
        }
    }

    /// The carrier of a patch separates it from the whole patch of a concentric sphere, and from no patch that crosses it.
    #[test]
    fn a_carrier_tells_what_no_plane_does() {
        let ball = |center: f64, radius: f64| {
            patches(&shapes::sphere(DVec3::new(center, 0.0, 0.0), radius).unwrap())
        };
        let (own, inner, across) = (ball(0.0, 1.0), ball(0.0, 0.999), ball(0.001, 1.0));
        let told = |other: &Patches, margin: f64| {
            let pairs = own.faces().zip(other.faces());
            let told = |(own, other): (&Whole, &Whole)| {
                own.carrier(&own.root).unwrap().tells(other, &other.root, margin)
            };
            pairs.filter(|&pair| told(pair)).count()
        };
        let all = own.faces().count();
        assert_eq!([1e-12, 0.0002, 0.0011].map(|margin| told(&inner, margin)), [all, all, 0]);
        assert!(told(&across, 1e-12) < all);
    }
}
