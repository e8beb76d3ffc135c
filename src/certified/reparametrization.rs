//! Linear maps from a cell into B's parameters.

use crate::bezier::Jet;
use crate::param_box::ParamBox;
use glam::{DVec2, DVec3};

/// `φ(σ, τ) = β + σ p + τ q`: the parameters on B's patch to which the cell's
/// points are mapped.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Reparametrization {
    pub(super) p: DVec2,
    pub(super) q: DVec2,
}

/// The smallest squared sine of the angle between the tangents with which both parameters slide.
const MIN_SINE_SQUARED: f64 = 1e-6;

/// Part of the margin that a clamped map may use: the rounding of its image's
/// box stays inside the domain.
const INSIDE: f64 = 1.0 - 16.0 * f64::EPSILON;

impl Reparametrization {
    /// Maps all of the cell to the foot of its centre.
    pub(super) const CONSTANT: Self = Self { p: DVec2::ZERO, q: DVec2::ZERO };

    /// The derivative of the foot by (σ, τ), given A's scaled derivatives
    /// `a_s`, `a_t`: from `(b - a)·B_u = (b - a)·B_v = 0` by the implicit
    /// function theorem. Frozen parameters stay. `None` where the system is singular.
    pub(super) fn linearized(
        b: &Jet,
        residual: DVec3,
        [a_s, a_t]: [DVec3; 2],
        frozen: [bool; 2],
    ) -> Option<Self> {
        let ss = b.s.dot(b.s) + residual.dot(b.ss);
        let st = b.s.dot(b.t) + residual.dot(b.st);
        let tt = b.t.dot(b.t) + residual.dot(b.tt);
        let derivative = |a: DVec3| solve([ss, st, tt], DVec2::new(b.s.dot(a), b.t.dot(a)), frozen);
        Some(Self { p: derivative(a_s)?, q: derivative(a_t)? })
    }

    /// The map scaled, each parameter by itself, so that φ([-1, 1]^2) lies in the domain.
    pub(super) fn clamped_to(self, domain: ParamBox, foot: [f64; 2]) -> Self {
        let extent = self.extent();
        let scale = DVec2::from_array([0, 1].map(|axis| {
            let margin = INSIDE * (foot[axis] - domain[axis][0]).min(domain[axis][1] - foot[axis]).max(0.0);
            if extent[axis] > margin { margin / extent[axis] } else { 1.0 }
        }));
        Self { p: self.p * scale, q: self.q * scale }
    }

    /// The box around φ([-1, 1]^2): its low and high corners.
    pub(super) fn image(&self, foot: [f64; 2]) -> [[f64; 2]; 2] {
        let (foot, extent) = (DVec2::from_array(foot), self.extent());
        [(foot - extent).to_array(), (foot + extent).to_array()]
    }

    /// Half the width of that box in each parameter.
    pub(super) fn extent(&self) -> DVec2 {
        self.p.abs() + self.q.abs()
    }
}

/// The pseudo-inverse of two tangents, by rows; of the longer one where they are about parallel.
pub(super) fn pseudo_inverse([s, t]: [DVec3; 2]) -> [DVec3; 2] {
    let [ss, st, tt] = [s.dot(s), s.dot(t), t.dot(t)];
    let determinant = ss * tt - st * st;
    if determinant > MIN_SINE_SQUARED * ss * tt {
        return [(tt * s - st * t) / determinant, (ss * t - st * s) / determinant];
    }
    let along = |tangent: DVec3, square: f64| {
        let row = tangent / square;
        if row.is_finite() { row } else { DVec3::ZERO }
    };
    if ss >= tt { [along(s, ss), DVec3::ZERO] } else { [DVec3::ZERO, along(t, tt)] }
}

/// Solves the symmetric system `[ss, st, tt]` for the parameters not frozen.
fn solve([ss, st, tt]: [f64; 3], right: DVec2, frozen: [bool; 2]) -> Option<DVec2> {
    let solution = match frozen {
        [true, true] => DVec2::ZERO,
        [true, false] => DVec2::new(0.0, right.y / tt),
        [false, true] => DVec2::new(right.x / ss, 0.0),
        [false, false] => {
            DVec2::new(tt * right.x - st * right.y, ss * right.y - st * right.x) / (ss * tt - st * st)
        }
    };
    solution.is_finite().then_some(solution)
}
