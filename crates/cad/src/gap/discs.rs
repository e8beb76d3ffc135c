//! The majorants that bound the difference of a part at complex parameters, and rounding.

use super::cells::Crossed;
use super::correspondence::Correspondence;
use super::interpolant::{COUNTS, remainder};
use super::local::{Ends, Local, LocalSurface};
use super::majorant::{CurveMajorant, SurfaceMajorant};
use glam::{DMat3, DVec3};

/// The largest exponent of the ellipses ρ = 2, 4, ….
const MAX_RHO_EXPONENT: u32 = 12;

/// The scale on which the slope of a majorant is taken, a power of 2.
const SLIP_SCALE: f64 = 1_048_576.0;

/// The roundings of an evaluation beside those of polynomials, which take
/// [`ROUNDINGS_A_DEGREE`] for each degree (R1 to R6 of docs/rounding.md).
const ROUNDINGS: usize = 64;
const ROUNDINGS_A_DEGREE: usize = 24;

/// The majorants about the middle of a part.
pub(super) struct Discs {
    curve: CurveMajorant,
    /// The majorants of the surface's cell, and of those beyond the knots that the part passes.
    surfaces: Vec<SurfaceMajorant>,
    edge: CurveMajorant,
    /// The lengths by which the part passes knots.
    passed: [f64; 2],
    /// Half of the range of the curve.
    half: f64,
    /// Bounds on what the locations multiply lengths by.
    norms: [f64; 2],
    /// Errors of the parameters of the curve and of the edge by rounding.
    parameter: f64,
    edge_parameter: f64,
    /// The coordinates of the middle in the parameters of the surface, and their errors by rounding, relative to them.
    middle: [f64; 2],
    relative_of_parameters: f64,
    /// The error of points by rounding, relative to their size.
    relative: f64,
    /// The size of coordinates at the middle.
    size: f64,
}

impl Discs {
    pub(super) fn new(
        local: &Local<'_>,
        [(t0, s0), (t1, s1)]: Ends,
        center: DVec3,
        curve: CurveMajorant,
        crossed: &[Crossed; 2],
    ) -> Self {
        let [t, s] = [0.5 * (t0 + t1), 0.5 * (s0 + s1)];
        let at = [center.x, center.y];
        let [us, vs] = crossed.each_ref().map(|one| one.cells.as_slice());
        let beyond = us.iter().flat_map(|&u| vs.iter().map(move |&v| [u, v])).skip(1);
        let lifted = local.lifted;
        let mut surfaces = vec![SurfaceMajorant::new(&local.surface, at)];
        surfaces.extend(
            beyond.map(|cell| SurfaceMajorant::new(&LocalSurface::new(lifted.surface, at, cell), at)),
        );
        let half = 0.5 * (t1 - t0);
        let roundings = |degree: usize| (ROUNDINGS + ROUNDINGS_A_DEGREE * degree) as f64 * f64::EPSILON;
        let degree = lifted.curve.degree();
        let size = local.on_surface(t).length() + lifted.on_edge(s).length();
        Self {
            curve,
            surfaces,
            edge: CurveMajorant::new(&local.edge, s),
            passed: crossed.each_ref().map(|one| one.by),
            half,
            norms: [lifted.surface_location.matrix3, lifted.edge_location.matrix3].map(norm),
            parameter: roundings(0) * t0.abs().max(t1.abs()),
            middle: at.map(f64::abs),
            relative_of_parameters: roundings(degree),
            edge_parameter: roundings(0) * s0.abs().max(s1.abs()),
            relative: roundings(lifted.surface.total_degree() + lifted.edge.degree()),
            size,
        }
    }

    /// Returns the least number of nodes whose interpolant is within `allowed` of the
    /// difference, and the bound on its error; `None` if none is.
    pub(super) fn nodes(&self, edge: &Correspondence, allowed: f64) -> Option<(usize, f64)> {
        let ellipse = |exponent: u32| {
            let rho = f64::from(2_u32.pow(exponent));
            (rho, self.moved(rho, edge))
        };
        let mut best = ellipse(1);
        let mut larger = (2..=MAX_RHO_EXPONENT).map(ellipse).peekable();
        COUNTS.into_iter().find_map(|count| {
            // The error is unimodal in ρ, and its least place grows with the number of nodes.
            let error = |(rho, moved): (f64, f64)| remainder(count, rho) * moved;
            while let Some(next) = larger.next_if(|&next| error(next) < error(best)) {
                best = next;
            }
            (error(best) <= allowed).then(|| (count, error(best)))
        })
    }

    /// Returns an upper bound on the change of the difference from that of the middles, in the ellipse
    /// of ρ, or for real parameters if ρ = 1.
    pub(super) fn moved(&self, rho: f64, edge: &Correspondence) -> f64 {
        let radii = self.curve.radii(0.5 * (rho + 1.0 / rho) * self.half);
        self.norms[0] * self.surfaces[0].radius([radii.x, radii.y])
            + self.norms[1] * self.edge.radii(edge.reach(rho)).length()
    }

    /// Returns an upper bound on the error of the difference by rounding and by the knots that
    /// the part passes: there the polynomial of either cell slips from their common point.
    pub(super) fn rounding(&self, edge: &Correspondence) -> f64 {
        self.rounding_over(self.half, self.passed, &self.surfaces, edge.reach(1.0))
            + self.relative * self.moved(1.0, edge)
    }

    /// Returns what remains of [`Self::rounding`] in a part about the same middle, however short it is.
    pub(super) fn least_rounding(&self) -> f64 {
        self.rounding_over(0.0, [0.0; 2], &self.surfaces[..1], 0.0)
    }

    /// Returns the error by rounding over `half` of the curve and `reach_of_edge` of the edge about the middle, in cells
    /// of the surface whose knots are passed by this length.
    fn rounding_over(
        &self,
        half: f64,
        passed: [f64; 2],
        surfaces: &[SurfaceMajorant],
        reach_of_edge: f64,
    ) -> f64 {
        let reach = self.curve.radii(half);
        let slip_of_curve = |axis: usize| slip(|radius| self.curve.radii(radius)[axis], half, self.parameter);
        let error = |axis: usize| {
            self.relative_of_parameters * (self.middle[axis] + reach[axis]) + slip_of_curve(axis)
        };
        let moved = [0, 1].map(|axis| error(axis) + 2.0 * passed[axis]);
        let slip_of_surface = |surface: &SurfaceMajorant| {
            let at = |axis: usize, radius: f64| {
                let mut radii = [reach.x, reach.y];
                radii[axis] = radius;
                surface.radius(radii)
            };
            [0, 1].map(|axis| slip(|radius| at(axis, radius), reach[axis], moved[axis])).iter().sum::<f64>()
        };
        let on_surface: f64 = surfaces.iter().map(slip_of_surface).sum();
        let on_edge = slip(|radius| self.edge.radii(radius).length(), reach_of_edge, self.edge_parameter);
        self.norms[0] * on_surface + self.norms[1] * on_edge + self.relative * self.size
    }
}

/// Returns an upper bound on the change of a function whose majorant is `bound`, by a move of the
/// parameter within `radius`. The majorant is convex, so that its difference quotient to the
/// right is at least its derivative, which bounds that of the function.
fn slip(bound: impl Fn(f64) -> f64, radius: f64, moved: f64) -> f64 {
    if moved == 0.0 {
        return 0.0;
    }
    (bound(radius + SLIP_SCALE * moved) - bound(radius)) / SLIP_SCALE
}

/// Returns an upper bound on the factor by which a matrix changes lengths.
fn norm(matrix: DMat3) -> f64 {
    let columns = [matrix.x_axis, matrix.y_axis, matrix.z_axis];
    columns.iter().map(|column| column.length_squared()).sum::<f64>().sqrt()
}
