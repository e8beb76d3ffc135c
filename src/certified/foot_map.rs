//! Maps from a cell into B's parameters.

use crate::bezier::Jet;
use crate::param_box::ParamBox;
use glam::{DVec2, DVec3};

/// `φ(σ, τ) = β + σ p + τ q + ½σ² m_0 + στ m_1 + ½τ² m_2`: where the cell's
/// points are sent on B's patch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct FootMap {
    pub(super) p: DVec2,
    pub(super) q: DVec2,
    pub(super) bend: [DVec2; 3],
}

impl FootMap {
    /// All of the cell on the centre's foot.
    pub(super) const CONSTANT: Self = Self { p: DVec2::ZERO, q: DVec2::ZERO, bend: [DVec2::ZERO; 3] };

    /// The derivative of the foot by (σ, τ), given A's scaled derivatives
    /// `a_s`, `a_t`: from `(b - a)·B_u = (b - a)·B_v = 0` by the implicit
    /// function theorem. Frozen parameters stay. `None` where the system is singular.
    pub(super) fn linearised(
        b: &Jet,
        residual: DVec3,
        [a_s, a_t]: [DVec3; 2],
        frozen: [bool; 2],
    ) -> Option<Self> {
        let ss = b.s.dot(b.s) + residual.dot(b.ss);
        let st = b.s.dot(b.t) + residual.dot(b.st);
        let tt = b.t.dot(b.t) + residual.dot(b.tt);
        let follow = |a: DVec3| solve([ss, st, tt], DVec2::new(b.s.dot(a), b.t.dot(a)), frozen);
        Some(Self { p: follow(a_s)?, q: follow(a_t)?, ..Self::CONSTANT })
    }

    /// This map bent so that the second derivatives `second` of `A - B∘φ` by
    /// σσ, στ, ττ lose their part tangential to B.
    pub(super) fn bent(self, b: &Jet, second: [DVec3; 3], frozen: [bool; 2]) -> Option<Self> {
        let metric = [b.s.dot(b.s), b.s.dot(b.t), b.t.dot(b.t)];
        let [ss, st, tt] = second.map(|rest| solve(metric, DVec2::new(b.s.dot(rest), b.t.dot(rest)), frozen));
        Some(Self { bend: [ss?, st?, tt?], ..self })
    }

    /// Shrunk, each parameter by itself, until φ([-1, 1]^2) lies in the room.
    pub(super) fn fitted(self, foot: [f64; 2], room: ParamBox) -> Self {
        let room = DVec2::from_array(
            [0, 1].map(|axis| (foot[axis] - room[axis][0]).min(room[axis][1] - foot[axis]).max(0.0)),
        );
        let reach = self.reach();
        let shrink = |axis: usize| if reach[axis] > room[axis] { room[axis] / reach[axis] } else { 1.0 };
        let factor = DVec2::new(shrink(0), shrink(1));
        Self { p: self.p * factor, q: self.q * factor, bend: self.bend.map(|bend| bend * factor) }
    }

    /// A box around φ([-1, 1]^2).
    pub(super) fn image(&self, foot: [f64; 2]) -> [[f64; 2]; 2] {
        let (foot, reach) = (DVec2::from_array(foot), self.reach());
        [(foot - reach).to_array(), (foot + reach).to_array()]
    }

    fn reach(&self) -> DVec2 {
        self.width() + 0.5 * self.turn()
    }

    /// How far the linear part of φ reaches from the foot in each parameter.
    pub(super) fn width(&self) -> DVec2 {
        self.p.abs() + self.q.abs()
    }

    /// Twice how far the quadratic part reaches.
    pub(super) fn turn(&self) -> DVec2 {
        self.bend[0].abs() + 2.0 * self.bend[1].abs() + self.bend[2].abs()
    }
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
