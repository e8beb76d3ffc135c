//! Where a region has no boundary, by a parabola near its loops.

use super::piece::{TrimPiece, point_of};
use super::winding::{Winding, WindingPiece};
use crate::axis::Axis;
use crate::chebyshev::binomial;
use crate::param_box::ParamBox;
use crate::rounding::{gamma, upper_max};
use glam::{DMat3, DVec2, DVec3};

/// The largest number of halvings of an arc, and of pieces of arcs in a box.
const MAX_HALVINGS: u32 = 32;
const MAX_PIECES: usize = 64;

/// The length of a piece relative to the box's diagonal.
const PIECE_LENGTH: f64 = 0.25;

/// The largest product of the slopes of two sides.
const MAX_SLOPES: f64 = 0.5;

/// How far beyond the parabola a box is extended, relative to its length.
const EXTENSION: f64 = 0.25;

/// The part of the trace that is added to the normal equations of a parabola.
const REGULARIZATION: f64 = 1e-13;

/// Roundings of a coefficient besides those for each product, relative to the sizes of its terms.
const COEFFICIENT_ROUNDINGS: f64 = 32.0;

/// A parabola over one parameter v, in fractions of the domain relative to a point: with u for the other
/// parameter, a region is where `±v < a + b u + c u²`, + if it is upwards.
#[derive(Debug, Clone, Copy)]
pub struct RimSide {
    /// The axis of v.
    pub axis: Axis,
    /// Whether the region ends towards larger v.
    pub is_upwards: bool,
    /// a, b and c.
    pub coefficients: [f64; 3],
    /// A bound on `|b + 2 c u|` over the box.
    pub slope: f64,
}

/// Where a region has no boundary: in a box, each point within all of its sides, one or two, belongs to it.
///
/// The sides of two axes have slopes of a product below 1, and those of one axis end the region towards the same
/// side. Towards smaller ±v the sides contain the whole side of the box.
#[derive(Debug, Clone)]
pub struct Rim {
    /// The sides.
    pub sides: Vec<RimSide>,
    /// The box, in fractions of the domain.
    pub region: ParamBox,
}

impl Winding {
    /// Finds rims of the region in boxes of parameters that contain the one given, relative to a point.
    /// O(pieces).
    ///
    /// The points of the box within the sides, each by what the arcs that it stands for are within it, are
    /// connected by the box's lower sides, no arc enters them, and one of them has winding number 1.
    #[must_use]
    pub fn rims(&self, parameters: &ParamBox, origin: [f64; 2]) -> Vec<Rim> {
        let margin = DVec2::splat(self.rounding());
        let [low, high] = [parameters.low(), parameters.high()].map(|corner| self.fraction(corner.into()));
        let bounds = [(low - margin).max(DVec2::ZERO), (high + margin).min(DVec2::ONE)];
        let is_inside = low.cmpge(-4.0 * margin).all() && high.cmple(DVec2::ONE + 4.0 * margin).all();
        let pieces = self.pieces_in(bounds).unwrap_or_default();
        if !is_inside || pieces.is_empty() || !bounds[0].cmplt(bounds[1]).all() {
            return Vec::new();
        }
        let origin = self.fraction(origin.into());
        let mut curves: Vec<Curve> = pieces.iter().map(|(curve, _)| *curve).collect();
        curves.sort_unstable();
        curves.dedup();
        let graph = |of: &[Curve]| {
            let arcs = pieces.iter().filter(|(curve, _)| of.contains(curve)).map(|(_, arc)| arc);
            Graph::through(arcs, bounds, origin)
        };
        let mut groups: Vec<Vec<(Graph, Option<Curve>)>> = vec![vec![(graph(&curves), None)]];
        if let [first, second] = curves[..] {
            let [one, other] = [graph(&[first]), graph(&[second])];
            groups.push(vec![(one.clone(), Some(first)), (other.clone(), Some(second))]);
            groups.extend([vec![(one, None)], vec![(other, None)]]);
        }
        let signs = [[true, true], [false, false], [true, false], [false, true]];
        let mut rims = Vec::new();
        for graphs in &groups {
            let of_axes = if graphs.len() == 1 || graphs[0].0.axis == graphs[1].0.axis { 2 } else { 4 };
            rims.extend(signs[..of_axes].iter().find_map(|signs| self.rim_of(graphs, bounds, signs)));
        }
        rims
    }

    /// The rim with these graphs, each for the arcs of a curve or of all, that end the region upwards or not.
    fn rim_of(
        &self,
        graphs: &[(Graph, Option<Curve>)],
        [low, high]: [DVec2; 2],
        signs: &[bool],
    ) -> Option<Rim> {
        let sign = |side: usize| if signs[side] { 1.0 } else { -1.0 };
        let mut region = ParamBox::new([low.x, high.x], [low.y, high.y]);
        // Each side of the box that a graph must not meet is moved beyond it, twice as they depend on each other.
        for _ in 0..2 {
            for (side, (graph, _)) in graphs.iter().enumerate() {
                let axis = graph.axis;
                let lowest =
                    sign(side) * graph.lowest(sign(side), region[axis.other()]) + graph.origin[axis.index()];
                let extension = sign(side) * EXTENSION * (high - low)[axis.index()];
                let [near, far] = [low, high].map(|corner| corner[axis.index()]);
                let end = if signs[side] { near.min(lowest) } else { far.max(lowest) } - extension;
                region[axis][usize::from(!signs[side])] = end;
            }
        }
        let is_inside = region.low().iter().chain(&region.high()).all(|end| (0.0..=1.0).contains(end));
        // A point of the sides that all graphs must not meet.
        let mut within = DVec2::from(region.middle());
        for (side, (graph, _)) in graphs.iter().enumerate() {
            within[graph.axis.index()] = region[graph.axis][usize::from(!signs[side])];
        }
        if !is_inside || !self.holds(within) {
            return None;
        }
        let pieces = self.pieces_in([region.low().into(), region.high().into()])?;
        let is_known =
            |piece: &Curve| graphs.iter().any(|(_, curve)| curve.is_none_or(|curve| curve == *piece));
        if !pieces.iter().all(|(curve, _)| is_known(curve)) {
            return None;
        }
        let mut sides = Vec::with_capacity(graphs.len());
        for (side, (graph, curve)) in graphs.iter().enumerate() {
            let (sign, axis) = (sign(side), graph.axis);
            let arcs = pieces.iter().filter(|(of, _)| curve.is_none_or(|curve| curve == *of));
            let depth =
                arcs.map(|(_, arc)| -graph.least(&arc.piece, sign, self.rounding())).fold(0.0, upper_max);
            let range = region[axis.other()];
            let end = sign * (region[axis][usize::from(!signs[side])] - graph.origin[axis.index()]);
            if !(end < graph.lowest(sign, range) - depth) {
                return None;
            }
            let [a, b, c] = graph.coefficients.map(|coefficient| sign * coefficient);
            let rounding = 8.0 * self.rounding() * (1.0 + b.abs() + c.abs());
            let slope = graph.slope(range) + rounding;
            let coefficients = [a - depth - rounding, b, c];
            sides.push(RimSide { axis, is_upwards: signs[side], coefficients, slope });
        }
        let product: f64 = sides.iter().map(|side| side.slope).product();
        let is_proper = sides.len() == 1 || sides[0].axis == sides[1].axis || product <= MAX_SLOPES;
        is_proper.then_some(Rim { sides, region })
    }

    /// The pieces of arcs that may enter a box, each short against it, with their curves; `None` where they
    /// are many.
    fn pieces_in(&self, [low, high]: [DVec2; 2]) -> Option<Vec<(Curve, WindingPiece)>> {
        let longest = PIECE_LENGTH * low.distance(high);
        let mut pieces = Vec::new();
        let mut stack: Vec<(Curve, WindingPiece, u32)> = Vec::new();
        for index in 0..self.loops() {
            let arcs = self.arcs_of(index).filter(|arc| !arc.is_on_border && !arc.is_apart([low, high]));
            stack.extend(arcs.map(|arc| ((index, arc.piece.curve), arc.clone(), 0)));
        }
        while let Some((curve, arc, halvings)) = stack.pop() {
            if arc.is_apart([low, high]) {
                continue;
            }
            if arc.length <= longest {
                pieces.push((curve, arc));
            } else if halvings < MAX_HALVINGS && pieces.len() + stack.len() < MAX_PIECES {
                stack.extend(self.halves(&arc, halvings).map(|half| (curve, half, halvings + 1)));
            } else {
                return None;
            }
        }
        Some(pieces)
    }
}

/// The index of a loop, and of a curve in it.
type Curve = (usize, u32);

/// The function v = a + b u + c u² relative to a point.
#[derive(Debug, Clone)]
struct Graph {
    axis: Axis,
    origin: DVec2,
    coefficients: [f64; 3],
}

impl Graph {
    /// The parabola nearest to the ends and the middles of these pieces, over the parameter along which they run in the box.
    fn through<'a>(
        pieces: impl Iterator<Item = &'a WindingPiece> + Clone,
        [low, high]: [DVec2; 2],
        origin: DVec2,
    ) -> Self {
        let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
        let run: DVec2 = pieces.clone().map(|arc| (arc.ends[1] - arc.ends[0]).abs() / half).sum();
        let axis = if run.x >= run.y { Axis::V } else { Axis::U };
        let (v, u) = (axis.index(), axis.other().index());
        let (mut matrix, mut right) = (DMat3::ZERO, DVec3::ZERO);
        for point in pieces.flat_map(|arc| [arc.ends[0], arc.piece.halves()[0].end(), arc.ends[1]]) {
            let place = (point - middle) / half;
            let row = DVec3::new(1.0, place[u], place[u] * place[u]);
            matrix += DMat3::from_cols(row.x * row, row.y * row, row.z * row);
            right += place[v] * row;
        }
        let trace = matrix.x_axis.x + matrix.y_axis.y + matrix.z_axis.z;
        let [h0, h1, h2] = ((matrix + DMat3::from_diagonal(DVec3::splat(REGULARIZATION * trace))).inverse()
            * right)
            .to_array();
        // Relative to the point and not to the middle.
        let (shift, ratio) = ((origin[u] - middle[u]) / half[u], half[v] / half[u]);
        let coefficients = [
            middle[v] - origin[v] + half[v] * (h0 + shift * (h1 + shift * h2)),
            ratio * (h1 + 2.0 * shift * h2),
            ratio / half[u] * h2,
        ];
        Self { axis, origin, coefficients }
    }

    /// A bound on the derivative over a range of u.
    fn slope(&self, range: [f64; 2]) -> f64 {
        let [_, b, c] = self.coefficients;
        let origin = self.origin[self.axis.other().index()];
        let [low, high] = range.map(|end| (b + 2.0 * c * (end - origin)).abs());
        upper_max(low, high)
    }

    /// The least value of ±v over a range of u.
    fn lowest(&self, sign: f64, range: [f64; 2]) -> f64 {
        let [a, b, c] = self.coefficients;
        let origin = self.origin[self.axis.other().index()];
        let [low, high] = range.map(|end| end - origin);
        let vertex = (-b / (2.0 * c)).clamp(low, high);
        let vertex = if vertex.is_nan() { low } else { vertex };
        let value = |u: f64| sign * (a + u * (b + u * c));
        value(low).min(value(high)).min(value(vertex))
    }

    /// A lower bound on `±(v - a - b u - c u²)` over a piece.
    ///
    /// With homogeneous controls (U, V, W) relative to the point, the coefficients of
    /// `±(V - a W - b U) W ∓ c U²` over those of W².
    fn least(&self, piece: &TrimPiece, sign: f64, rounding: f64) -> f64 {
        let [a, b, c] = self.coefficients;
        let (v, u) = (self.axis.index(), self.axis.other().index());
        let moved = |control: &DVec3| {
            let place = point_of(*control) - self.origin;
            [place[u], place[v], control.z]
        };
        let controls: Vec<[f64; 3]> = piece.controls.iter().map(moved).collect();
        let term = |[x, y, w]: [f64; 3], [other_x, _, other_w]: [f64; 3]| {
            let weight = w * other_w;
            (weight * sign * (y - a - b * x - c * x * other_x), weight)
        };
        let degree = piece.degree();
        let row: Vec<f64> = (0..=degree).map(|k| binomial(degree, k)).collect();
        let (mut values, mut weights) = (vec![0.0; 2 * degree + 1], vec![0.0; 2 * degree + 1]);
        for (i, left) in controls.iter().enumerate() {
            for (k, right) in controls.iter().enumerate() {
                let (value, weight) = term(*left, *right);
                values[i + k] += row[i] * row[k] * value;
                weights[i + k] += row[i] * row[k] * weight;
            }
        }
        let reach = controls.iter().fold(0.0, |reach, [x, ..]| upper_max(reach, x.abs()));
        let height = controls.iter().fold(0.0, |height, [_, y, _]| upper_max(height, y.abs()));
        let slope = 1.0 + b.abs() + 2.0 * c.abs() * reach;
        let roundings = (2 * (degree + 1)) as f64 + COEFFICIENT_ROUNDINGS;
        let of_points = rounding + gamma(f64::from(MAX_HALVINGS) * (2.0 * degree as f64 + 4.0));
        let sizes = height + a.abs() + reach * (b.abs() + reach * c.abs());
        let error = slope * of_points + gamma(2.0 * roundings) * sizes;
        let mut least = f64::INFINITY;
        for (value, weight) in values.iter().zip(&weights) {
            let value = value / weight;
            // NaN bounds nothing.
            least = if value >= least { least } else { value };
        }
        if least.is_nan() { f64::NEG_INFINITY } else { least - error }
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::model::trim::{Trim, TrimCurveArrays};
    use crate::model::{NurbsSurface, SurfaceArrays};

    /// On a straight piece that lies on the graph, the least value is the allowance: that of the places times
    /// the slope, and the rounding of the coefficients' terms.
    #[test]
    fn the_depth_of_an_arc_has_its_rounding() {
        let coefficients = [0.25, 0.5, 0.0];
        let graph = Graph { axis: Axis::V, origin: DVec2::ZERO, coefficients };
        let ends = [DVec2::new(-0.5, 0.0), DVec2::new(0.5, 0.5)];
        let piece = TrimPiece { controls: ends.map(|end| end.extend(1.0)).to_vec(), curve: 0 };
        let (slope, sizes) = (1.5, 0.5 + 0.25 + 0.25);
        let of_terms = gamma(2.0 * (4.0 + 32.0)) * sizes;
        for rounding in [0.0, 1e-3] {
            let of_places = slope * (rounding + gamma(32.0 * 6.0));
            for sign in [1.0, -1.0] {
                let depth = -graph.least(&piece, sign, rounding);
                let expected = of_places + of_terms;
                assert!((depth / expected - 1.0).abs() < 1e-3, "{depth:e} {expected:e} of {sign}");
            }
        }
    }

    /// The same on a piece of second order: the slope is that at its end, and the sizes are those there.
    #[test]
    fn the_depth_of_a_parabola_has_its_rounding() {
        let graph = Graph { axis: Axis::V, origin: DVec2::ZERO, coefficients: [0.25, 0.5, 0.5] };
        let points = [DVec2::new(-0.5, 0.125), DVec2::new(0.0, 0.125), DVec2::new(0.5, 0.625)];
        let piece = TrimPiece { controls: points.map(|point| point.extend(1.0)).to_vec(), curve: 0 };
        let (slope, sizes) = (1.0 + 0.5 + 0.5, 0.625 + 0.25 + 0.5 * (0.5 + 0.25));
        for rounding in [0.0, 1e-3] {
            let of_places = slope * (rounding + gamma(32.0 * 8.0));
            let expected = of_places + gamma(2.0 * (2.0 * 2.0 + 34.0)) * sizes;
            let depth = -graph.least(&piece, 1.0, rounding);
            assert!((depth / expected - 1.0).abs() < 1e-2, "{depth:e} {expected:e}");
        }
    }

    /// A side is as far within its parabola as arcs are, and by 8 roundings of the domain of each coefficient's
    /// term besides, which its slope is enlarged by, too.
    #[test]
    fn a_side_has_its_rounding() {
        let square = [[-0.5, -1.0], [0.5, -1.0], [0.5, 1.0], [-0.5, 1.0]];
        let winding = region(&square, 0.0).winding();
        let (b, c) = (0.5, 0.25);
        for (is_upwards, sign, v) in [(true, 1.0, 0.75), (false, -1.0, 0.25)] {
            let coefficients = [0.0, sign * b, sign * c];
            let origin = DVec2::new(0.5, v);
            let graph = Graph { axis: Axis::V, origin, coefficients };
            let half = DVec2::splat(1.0 / 32.0);
            let bounds = [origin - half, origin + half];
            let rim = winding.rim_of(&[(graph.clone(), None)], bounds, &[is_upwards]).unwrap();
            let pieces = winding.pieces_in([rim.region.low().into(), rim.region.high().into()]).unwrap();
            let depth = pieces
                .iter()
                .map(|(_, arc)| -graph.least(&arc.piece, sign, winding.rounding()))
                .fold(0.0, upper_max);
            // The loop is straight, at v of the point: below the parabola by as much as that rises.
            let rise = b / 32.0 + c / 1024.0;
            assert!(depth >= rise && depth < 2.0 * rise, "{depth} {rise}");
            let rounding = 8.0 * winding.rounding() * (1.0 + b + c);
            let [side] = &rim.sides[..] else { panic!("{rim:?}") };
            let own = |found: f64| (found / rounding - 1.0).abs() < 0.1;
            assert!(own(side.slope - (b + 2.0 * c / 32.0)), "{side:?} {rounding:e}");
            assert!(own(-side.coefficients[0] - depth), "{side:?} {depth:e} {rounding:e}");
        }
    }

    /// The part of [-1, 1] × [-2, 2] within a polygon, with sides of this middle weight, 0 for straight ones: they
    /// bulge by a fifth of their length, outwards or inwards in turn.
    fn region(corners: &[[f64; 2]], weight: f64) -> Trim {
        let surface = NurbsSurface::new(
            0,
            SurfaceArrays {
                degree: [1, 1],
                knots: [vec![-1.0, -1.0, 1.0, 1.0], vec![-2.0, -2.0, 2.0, 2.0]],
                counts: [2, 2],
                control_points: [-1.0, 1.0].map(|x| [-2.0, 2.0].map(|y| [x, y, 0.0, 1.0])).concat(),
            },
        );
        let side = |k: usize| {
            let [from, to] = [corners[k], corners[(k + 1) % corners.len()]];
            let bulge = if k.is_multiple_of(2) { 0.2 } else { -0.2 };
            let middle = [
                0.5 * (from[0] + to[0]) + bulge * (to[1] - from[1]),
                0.5 * (from[1] + to[1]) - bulge * (to[0] - from[0]),
                weight,
            ];
            let [start, end] = [from, to].map(|[u, v]| [u, v, 1.0]);
            let points = if weight == 0.0 { vec![start, end] } else { vec![start, middle, end] };
            TrimCurveArrays {
                degree: points.len() - 1,
                knots: [vec![0.0; points.len()], vec![1.0; points.len()]].concat(),
                control_points: points,
                ..TrimCurveArrays::default()
            }
        };
        Trim::new(0, &surface.unwrap(), vec![(0..corners.len()).map(side).collect()]).unwrap()
    }

    /// Counterclockwise, with convex, right, obtuse and reflex corners.
    const POLYGON: [[f64; 2]; 6] =
        [[-0.6, -1.3], [0.1, -1.2], [0.2, -0.2], [0.7, 0.1], [0.6, 1.4], [-0.5, 1.0]];

    /// The value of a side at fractions relative to the point: how far they are beyond it.
    fn beyond(side: &RimSide, place: DVec2) -> f64 {
        let (v, u) = (side.axis.index(), side.axis.other().index());
        let [a, b, c] = side.coefficients;
        let sign = if side.is_upwards { 1.0 } else { -1.0 };
        sign * place[v] - a - place[u] * (b + c * place[u])
    }

    /// Every point of the box within all sides belongs to the region, on whichever side it is and of whichever
    /// number of curves; rims are found about most points of the loop, and are close to it.
    #[test]
    fn what_is_within_the_sides_belongs_to_the_region() {
        let random = &mut fastrand::Rng::with_seed(319);
        let (mut found, mut corners, mut close, mut tried) = (0, 0, 0, 0);
        for weight in [0.0, 0.7, 1.0] {
            let winding = region(&POLYGON, weight).winding();
            for _ in 0..1500 {
                let size = 10.0_f64.powf(-0.7 - 2.0 * random.f64());
                let arcs: Vec<&WindingPiece> = winding.arcs().collect();
                let arc = arcs[random.usize(0..arcs.len())];
                let near =
                    if random.bool() { arc.ends[0] } else { arc.ends[0].lerp(arc.ends[1], random.f64()) };
                let mut shift = || size * (random.f64() - 0.5);
                let middle = near + DVec2::new(shift(), shift());
                let half = DVec2::new(size * (0.2 + random.f64()), size * (0.2 + random.f64()));
                let [low, high] = [winding.parameters(middle - half), winding.parameters(middle + half)];
                let parameters = ParamBox::new([low[0], high[0]], [low[1], high[1]]);
                let origin = winding.parameters(middle + 0.3 * half);
                tried += 1;
                for rim in winding.rims(&parameters, origin) {
                    found += 1;
                    corners += usize::from(rim.sides.len() == 2);
                    let [first, last] = [DVec2::from(rim.region.low()), DVec2::from(rim.region.high())];
                    assert!(first.cmple(middle - half).all() && last.cmpge(middle + half).all());
                    let mut outside = f64::INFINITY;
                    for _ in 0..100 {
                        let place = first + (last - first) * DVec2::new(random.f64(), random.f64());
                        let relative = place - (middle + 0.3 * half);
                        let excess = rim
                            .sides
                            .iter()
                            .map(|side| beyond(side, relative))
                            .fold(f64::NEG_INFINITY, f64::max);
                        let number = winding.number(winding.parameters(place));
                        assert!(excess >= 0.0 || number == Some(1), "{rim:?} at {place} {excess:e}");
                        for side in &rim.sides {
                            let (u, c) = (side.axis.other().index(), side.coefficients);
                            assert!((c[1] + 2.0 * c[2] * relative[u]).abs() <= side.slope);
                        }
                        if number == Some(0) {
                            outside = outside.min(excess);
                        }
                    }
                    close += usize::from(outside < 0.5 * size);
                }
            }
        }
        assert!(
            found > tried / 2 && corners > 300 && close > found / 3,
            "{found} {corners} {close} of {tried}"
        );
    }

    /// Straight sides are met exactly: an edge, and both edges of a right corner.
    #[test]
    fn straight_sides_are_exact() {
        let square = [[-0.5, -1.0], [0.5, -1.0], [0.5, 1.0], [-0.5, 1.0]];
        let winding = region(&square, 0.0).winding();
        let edge = &winding.rims(&ParamBox::new([0.45, 0.52], [0.0, 0.1]), [0.5, 0.05])[0];
        let [side] = &edge.sides[..] else { panic!("{edge:?}") };
        assert!(side.axis == Axis::U && side.is_upwards);
        assert!(side.coefficients.iter().all(|value| value.abs() < 1e-9), "{side:?}");
        let rims = winding.rims(&ParamBox::new([-0.52, -0.45], [0.98, 1.02]), [-0.5, 1.0]);
        let corner = rims.iter().find(|rim| rim.sides.len() == 2).unwrap();
        for side in &corner.sides {
            assert_eq!(side.is_upwards, side.axis == Axis::V);
            assert!(
                side.coefficients.iter().all(|value| value.abs() < 1e-9) && side.slope < 1e-9,
                "{side:?}"
            );
        }
    }

    /// No rim is found away from the loop, nor in a box that leaves the domain.
    #[test]
    fn there_is_no_rim_where_there_is_no_loop() {
        let winding = region(&POLYGON, 0.0).winding();
        assert!(winding.rims(&ParamBox::new([-0.1, 0.0], [0.0, 0.1]), [0.0, 0.0]).is_empty());
        assert!(winding.rims(&ParamBox::new([-1.5, 1.0], [0.0, 0.1]), [0.0, 0.0]).is_empty());
        assert!(winding.rims(&ParamBox::new([f64::NAN, 1.0], [0.0, 0.1]), [0.0, 0.0]).is_empty());
    }
}
