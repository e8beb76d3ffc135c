//! Stage `certify`: an upper bound of the distance from a cell of A to B.

use super::Side;
use super::feet::Foot;
use super::foot_map::FootMap;
use super::quadratic::Quadratic;
use super::region::Cell;
use crate::bezier::{DerivativeBounds, Jet};
use crate::both::both;
use glam::{DVec2, DVec3};

/// At least the distance to B of every point of the cell, given A's moved jet
/// at its centre and a foot of it.
///
/// For any map φ of the cell into a patch of B, `max d(a, B) <= max |A - B∘φ|`,
/// so no global minimum is needed. Where a patch was cut from its neighbour, φ
/// may leave it by a little: its controls tell the neighbour's points too.
/// With `Q` the Taylor quadratic of
/// `D = A - B∘φ` at the centre, `|D - Q| <= R_A + R_B`, the remainders of third
/// order, and `|Q|` is bounded by [`Quadratic::largest_length_squared`]. φ is
/// the foot's linearisation, then that bent, then constant; the first bound of
/// at most `enough` ends it, else the least is taken.
///
/// Linear maps give a bound of third order where the distance is positive:
/// what D does along B then counts by its square only. Where A lies on B
/// it counts in full, which the bent map makes third order too.
pub(super) fn certify(
    cell: &Cell,
    a: &Jet,
    a_bounds: &DerivativeBounds,
    b: &Side<'_>,
    foot: &Foot,
    enough: f64,
) -> f64 {
    let distance = foot.distance();
    let [h, k] = cell.half;
    let mut best = distance + h * a_bounds.first[0] + k * a_bounds.first[1];
    if best <= enough {
        return best;
    }
    let facing = Facing::new(cell, a, a_bounds, b, foot);
    let mut try_map = |map: &FootMap| {
        let (quadratic, rest) = facing.difference(map);
        best = best.min(quadratic.largest_length_squared().sqrt() + rest);
        best
    };
    if let Some(linear) = facing.linear() {
        if try_map(&linear) <= enough {
            return best;
        }
        let Quadratic { ss, st, tt, .. } = difference(a, &facing.jet, cell.half, &linear);
        if let Some(bent) = linear.bent(&facing.jet, [ss, st, tt], facing.frozen)
            && try_map(&bent) <= enough
        {
            return best;
        }
    }
    try_map(&FootMap::CONSTANT)
}

/// A cell of A and a foot of its centre, from which maps into B's patch are made.
pub(super) struct Facing<'a> {
    cell: &'a Cell,
    a: &'a Jet,
    rest_a: f64,
    b: &'a Side<'a>,
    foot: &'a Foot,
    jet: Jet,
    room: [[f64; 2]; 2],
    frozen: [bool; 2],
}

impl<'a> Facing<'a> {
    /// Of A's moved jet at the cell's centre, its bounds over the cell, and a foot on B.
    pub(super) fn new(
        cell: &'a Cell,
        a: &'a Jet,
        a_bounds: &DerivativeBounds,
        b: &'a Side<'_>,
        foot: &'a Foot,
    ) -> Self {
        let jet = b.patch(foot.patch).jet(foot.parameters);
        let residual = jet.point - a.point;
        let room = b.room(foot.patch);
        let frozen = both(|axis| {
            let [low, high] = room[axis];
            let gradient = residual.dot(if axis == 0 { jet.s } else { jet.t });
            let parameter = foot.parameters[axis];
            (parameter <= low && gradient > 0.0) || (parameter >= high && gradient < 0.0)
        });
        let rest_a = remainder(a_bounds, cell.half, [0.0; 2]);
        Self { cell, a, rest_a, b, foot, jet, room, frozen }
    }

    /// The foot's linearisation, where there is one.
    pub(super) fn linear(&self) -> Option<FootMap> {
        let [h, k] = self.cell.half;
        let residual = self.jet.point - self.a.point;
        FootMap::linearised(&self.jet, residual, [h * self.a.s, k * self.a.t], self.frozen)
    }

    /// The Taylor quadratic of `A - B∘φ` at the centre, φ fitted into the
    /// patch's room, and at least how far the two may be apart in the cell.
    pub(super) fn difference(&self, map: &FootMap) -> (Quadratic, f64) {
        let map = map.fitted(self.foot.parameters, self.room);
        let [low, high] = map.image(self.foot.parameters);
        let bounds = self.b.bounds(self.foot.patch, low, high);
        let rest_b = remainder(&bounds, map.width().to_array(), map.turn().to_array());
        (difference(self.a, &self.jet, self.cell.half, &map), self.rest_a + rest_b)
    }
}

/// Taylor's remainder of third order of a surface along `β + ℓ + ½m` with
/// |ℓ| at most `width` and |m| at most `turn` in each parameter.
///
/// With `g(t) = B(β + tℓ + ½t²m)`, the third derivative of g is
/// `B'''[v, v, v] + 3 B''[v, m]` with the velocity `v = ℓ + tm`, at most
/// `width + turn`; the remainder is at most a sixth of its largest length.
fn remainder(bounds: &DerivativeBounds, width: [f64; 2], [m, n]: [f64; 2]) -> f64 {
    let [h, k] = [width[0] + m, width[1] + n];
    let [ss, st, tt] = bounds.second;
    let [sss, sst, stt, ttt] = bounds.third;
    let third = h * h * h * sss + 3.0 * h * h * k * sst + 3.0 * h * k * k * stt + k * k * k * ttt;
    let turning = h * m * ss + (h * n + k * m) * st + k * n * tt;
    third / 6.0 + 0.5 * turning
}

/// The Taylor quadratic of `A - B∘φ` at the cell's centre, by the chain rule.
fn difference(a: &Jet, b: &Jet, [h, k]: [f64; 2], map: &FootMap) -> Quadratic {
    let (p, q) = (map.p, map.q);
    let second = |uu: f64, uv: f64, vv: f64, bend: DVec2| -> DVec3 {
        uu * b.ss + uv * b.st + vv * b.tt + bend.x * b.s + bend.y * b.t
    };
    Quadratic {
        value: a.point - b.point,
        s: h * a.s - (p.x * b.s + p.y * b.t),
        t: k * a.t - (q.x * b.s + q.y * b.t),
        ss: h * h * a.ss - second(p.x * p.x, 2.0 * p.x * p.y, p.y * p.y, map.bend[0]),
        st: h * k * a.st - second(p.x * q.x, p.x * q.y + p.y * q.x, p.y * q.y, map.bend[1]),
        tt: k * k * a.tt - second(q.x * q.x, 2.0 * q.x * q.y, q.y * q.y, map.bend[2]),
    }
}
