//! Stage `certify`: an upper bound of the distance from a cell of A to B.

use super::Operand;
use super::cell_bounds::CellBounds;
use super::feet::Foot;
use super::foot_map::FootMap;
use super::quadratic::Quadratic;
use super::region::Cell;
use crate::bezier::{DerivativeBounds, Jet};
use glam::{DVec2, DVec3};

/// Distance, in radii of the cell, up to which A lies on B as far as a cell of
/// this size tells. Of 5,800 cells that bent maps sufficed for, in 52 models
/// moved and turned and 300 random pairs, 14 were farther away.
pub(crate) const ON_B: f64 = 0.01;

/// At least the distance to B of every point of the cell, given A's moved jet
/// at its centre and a foot of it.
///
/// For any map φ of the cell into a patch of B, `max d(a, B) <= max |A - B∘φ|`,
/// so no global minimum is needed. Where a patch was cut from its neighbour, φ
/// may leave it by a little: its controls tell the neighbour's points too.
/// With `Q` the Taylor quadratic of
/// `D = A - B∘φ` at the centre, `|D - Q| <= R_A + R_B`, the remainders of third
/// order, and `|Q|` is bounded by [`Quadratic::largest_length_squared`]. φ is
/// the foot's linearisation, constant where there is none, and where A lies on
/// B that bent; the first bound of at most `prune_threshold` ends it, else the least is
/// taken.
///
/// Linear maps give a bound of third order where the distance is positive:
/// what D does along B then counts by its square only. Where A lies on B
/// it counts in full, which the bent map makes third order too.
pub(super) fn certify(
    cell: &Cell,
    a: &Jet,
    a_bounds: &CellBounds<'_>,
    b: &Operand<'_>,
    foot: &Foot,
    prune_threshold: f64,
) -> f64 {
    let distance = foot.distance();
    let [h, k] = cell.half;
    let [s, t] = a_bounds.of_patch().first;
    let radius = h * s + k * t;
    let mut best = distance + radius;
    if best <= prune_threshold {
        return best;
    }
    let facing = Facing::new(cell, a, a_bounds, b, foot);
    let mut try_map = |map: &FootMap| {
        let followed = facing.follow(map);
        let length = followed.quadratic.largest_length_squared().sqrt();
        let mut bound = length + followed.rest(false);
        if length <= prune_threshold && bound > prune_threshold {
            bound = length + followed.rest(true);
        }
        best = best.min(bound);
        best
    };
    let Some(linear) = facing.linear() else { return try_map(&FootMap::CONSTANT) };
    if try_map(&linear) <= prune_threshold || distance > ON_B * radius {
        return best;
    }
    let Quadratic { ss, st, tt, .. } = difference(a, &facing.jet, cell.half, &linear);
    match linear.bent(&facing.jet, [ss, st, tt], facing.frozen) {
        Some(bent) => try_map(&bent),
        None => best,
    }
}

/// A cell of A and a foot of its centre, from which maps into B's patch are made.
pub(super) struct Facing<'a> {
    cell: &'a Cell,
    a: &'a Jet,
    a_bounds: &'a CellBounds<'a>,
    b: &'a Operand<'a>,
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
        a_bounds: &'a CellBounds<'_>,
        b: &'a Operand<'_>,
        foot: &'a Foot,
    ) -> Self {
        let jet = b.patch(foot.patch).jet(foot.parameters);
        let residual = jet.point - a.point;
        let room = b.room(foot.patch);
        let frozen = [0, 1].map(|axis| {
            let [low, high] = room[axis];
            let gradient = residual.dot(if axis == 0 { jet.s } else { jet.t });
            let parameter = foot.parameters[axis];
            (parameter <= low && gradient > 0.0) || (parameter >= high && gradient < 0.0)
        });
        Self { cell, a, a_bounds, b, foot, jet, room, frozen }
    }

    /// The foot's linearisation, where there is one.
    pub(super) fn linear(&self) -> Option<FootMap> {
        let [h, k] = self.cell.half;
        let residual = self.jet.point - self.a.point;
        FootMap::linearised(&self.jet, residual, [h * self.a.s, k * self.a.t], self.frozen)
    }

    /// `A - B∘φ` with φ the map fitted into the patch's room.
    pub(super) fn follow(&self, map: &FootMap) -> Followed<'_> {
        let map = map.fitted(self.foot.parameters, self.room);
        Followed { facing: self, quadratic: difference(self.a, &self.jet, self.cell.half, &map), map }
    }
}

/// `A - B∘φ` over a cell.
pub(super) struct Followed<'a> {
    facing: &'a Facing<'a>,
    map: FootMap,
    /// Its Taylor quadratic at the centre.
    pub(super) quadratic: Quadratic,
}

impl Followed<'_> {
    /// At least how far it may be from the quadratic, by bounds over whole
    /// patches, or by `close` ones over parts, which cost more.
    pub(super) fn rest(&self, close: bool) -> f64 {
        let Facing { cell, a_bounds, b, foot, .. } = self.facing;
        let [low, high] = self.map.image(foot.parameters);
        let (of_a, of_b) = if close {
            (a_bounds.close(), b.bounds(foot.patch, low, high))
        } else {
            (a_bounds.of_patch(), *b.bounds_about(foot.patch, low, high))
        };
        let [width, turn] = [self.map.width().to_array(), self.map.turn().to_array()];
        remainder(of_a, cell.half, [0.0; 2]) + remainder(&of_b, width, turn)
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
