//! Whether a box of parameters lies in the trimmed region.

use super::{Winding, WindingPiece};
use crate::param_box::ParamBox;
use glam::DVec2;

/// The largest number of halvings of an arc: a boundary that is nearer to a box than about 2^-8 of
/// the arc's length may count as in it.
const MAX_HALVINGS: u32 = 8;

impl Winding {
    /// Returns true only if every point of a box of parameters, clamped to the domain, has winding number 1
    /// or is a limit of points that have it; a box near a curve may be said to be outside.
    ///
    /// No arc enters the box: a piece from P₀ to P₁ of length at most L lies in the ellipse
    /// `|x - P₀| + |x - P₁| <= L`, and on the box the sum is at least that of the distances of both
    /// ends from the box. The winding number is then constant in the box's interior. An arc on a border
    /// line of the domain does not enter a box of the domain. O(pieces).
    #[must_use]
    pub fn encloses(&self, parameters: &ParamBox) -> bool {
        let margin = DVec2::splat(self.rounding());
        let [low, high] = [parameters.low(), parameters.high()].map(|corner| self.fraction(corner.into()));
        let low = (low - margin).clamp(DVec2::ZERO, DVec2::ONE);
        let high = (high + margin).clamp(DVec2::ZERO, DVec2::ONE);
        let is_box = parameters.intervals().iter().all(|[low, high]| low <= high) && low.cmplt(high).all();
        is_box
            && !self.arcs().any(|arc| !arc.is_on_border && self.may_enter(arc, [low, high]))
            && self.holds(0.5 * (low + high))
    }

    /// Returns true only if a point, in fractions of the domain, has winding number 1. O(arcs), without the
    /// angles of arcs beside it.
    ///
    /// The number is that of the arcs that cross the ray from the point towards smaller u, upwards less
    /// downwards. An arc whose box the ray does not meet, or which is wholly on the ray's side, crosses as its
    /// chord does; a chord includes its lower end and excludes its upper one.
    pub(super) fn holds(&self, point: DVec2) -> bool {
        let mut number = 0;
        for arc in self.arcs() {
            let [low, high] = arc.bounds;
            if point.y < low.y || point.y > high.y || point.x < low.x {
                continue;
            }
            if point.x <= high.x {
                return self.number(self.parameters(point)) == Some(1);
            }
            let [from, to] = arc.ends.map(|end| end.y > point.y);
            number += i32::from(from) - i32::from(to);
        }
        number == 1
    }

    /// Returns whether an arc may have a point in a box.
    fn may_enter(&self, arc: &WindingPiece, [low, high]: [DVec2; 2]) -> bool {
        if arc.is_apart([low, high]) {
            return false;
        }
        let enters =
            |arc: &WindingPiece| arc.ends.iter().any(|end| end.cmpge(low).all() && end.cmple(high).all());
        let mut stack = vec![(arc.clone(), 0)];
        while let Some((arc, halvings)) = stack.pop() {
            if arc.is_apart([low, high]) {
                continue;
            }
            if halvings == MAX_HALVINGS || enters(&arc) {
                return true;
            }
            stack.extend(self.halves(&arc, halvings).map(|half| (half, halvings + 1)));
        }
        false
    }
}

impl WindingPiece {
    /// Returns true only if no point of the arc is in a box.
    pub(super) fn is_apart(&self, [low, high]: [DVec2; 2]) -> bool {
        let is_beside = self.bounds[1].cmplt(low).any() || self.bounds[0].cmpgt(high).any();
        let distances = || self.ends.map(|end| end.distance(end.clamp(low, high)));
        is_beside || distances().iter().sum::<f64>() > self.length
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use crate::model::trim::{Trim, TrimCurveArrays};
    use crate::model::{NurbsSurface, SurfaceArrays};
    use crate::param_box::ParamBox;

    /// Half the diagonal of the hole.
    const HOLE: f64 = 0.5;

    /// The whole of [-1, 1] × [-1, 1] but for a hole whose corners are on the axes, with curved sides if
    /// the weight is not 0: a circle for ½√2.
    fn region(weight: f64) -> Trim {
        let surface = NurbsSurface::new(
            0,
            SurfaceArrays {
                degree: [1, 1],
                knots: [[-1.0, -1.0, 1.0, 1.0].to_vec(), [-1.0, -1.0, 1.0, 1.0].to_vec()],
                counts: [2, 2],
                control_points: [-1.0, 1.0].map(|x| [-1.0, 1.0].map(|y| [x, y, 0.0, 1.0])).concat(),
            },
        );
        let curve = |points: &[[f64; 3]]| TrimCurveArrays {
            degree: points.len() - 1,
            knots: [vec![0.0; points.len()], vec![1.0; points.len()]].concat(),
            control_points: points.to_vec(),
            ..TrimCurveArrays::default()
        };
        let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
        let hole = [[HOLE, 0.0], [0.0, -HOLE], [-HOLE, 0.0], [0.0, HOLE]];
        let ends = |loop_: &[[f64; 2]; 4], k: usize| [loop_[k], loop_[(k + 1) % 4]];
        let outer = (0..4).map(|k| curve(&ends(&corners, k).map(|[u, v]| [u, v, 1.0])));
        let inner = (0..4).map(|k| {
            let [from, to] = ends(&hole, k);
            let middle = [from[0] + to[0], from[1] + to[1], weight];
            let [start, end] = [from, to].map(|[u, v]| [u, v, 1.0]);
            if weight == 0.0 { curve(&[start, end]) } else { curve(&[start, middle, end]) }
        });
        Trim::new(0, &surface.unwrap(), vec![outer.collect(), inner.collect()]).unwrap()
    }

    /// The least distances of a box's points from both axes.
    fn least(parameters: &ParamBox) -> [f64; 2] {
        [0, 1].map(|axis| {
            let [low, high] = parameters[axis];
            low.max(-high).max(0.0)
        })
    }

    #[test]
    fn boxes_beside_a_hole_are_enclosed_and_others_are_not() {
        let random = &mut fastrand::Rng::with_seed(8);
        for weight in [0.0, std::f64::consts::FRAC_1_SQRT_2] {
            let winding = region(weight).winding();
            let mut enclosed = 0;
            for _ in 0..5000 {
                let size = 10.0_f64.powf(-2.0 * random.f64());
                let mut range = || {
                    let middle = 2.0 * random.f64() - 1.0;
                    [(middle - size * random.f64()).max(-1.0), (middle + size * random.f64()).min(1.0)]
                };
                let parameters = ParamBox::new(range(), range());
                let [x, y] = least(&parameters);
                let reach = if weight == 0.0 { x + y } else { x.hypot(y) };
                let found = winding.encloses(&parameters);
                assert!(!found || reach >= HOLE, "{parameters:?}");
                // The size of the halved arcs. The test knows no more of them.
                assert!(found || reach < HOLE + 0.02, "{parameters:?}");
                enclosed += usize::from(found);
            }
            assert!(enclosed > 1000, "{enclosed}");
        }
    }

    #[test]
    fn boxes_that_touch_the_border_are_enclosed_and_empty_ones_are_not() {
        let winding = region(0.0).winding();
        assert!(winding.encloses(&ParamBox::new([-1.0, 1.0], [0.6, 1.0])));
        assert!(winding.encloses(&ParamBox::new([-2.0, -0.9], [0.6, 3.0])));
        assert!(!winding.encloses(&ParamBox::new([1.5, 2.0], [0.6, 1.0])));
        assert!(!winding.encloses(&ParamBox::new([f64::NAN, 0.9], [0.6, 1.0])));
        assert!(!winding.encloses(&ParamBox::new([-0.1, 0.1], [-0.1, 0.1])));
    }
}
