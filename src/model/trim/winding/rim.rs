//! Where a region has no boundary, by a conic near its loops.

use super::conic::{Conic, MAX_HALVINGS};
use super::{Winding, WindingPiece};
use crate::axis::Axis;
use crate::param_box::ParamBox;
use crate::rounding::upper_max;
use glam::DVec2;

/// The largest number of pieces of arcs in a box.
const MAX_PIECES: usize = 64;

/// The length of a piece relative to the box's diagonal.
const PIECE_LENGTH: f64 = 0.25;

/// The largest product of the slopes of two sides.
const MAX_SLOPES: f64 = 0.5;

/// How far beyond the conic a box is extended, relative to its length, where the domain goes on.
const EXTENSION: f64 = 0.25;

/// How far between a lower side and the conic a point within it is: at the side it may be on the border of the domain.
const WITHIN: f64 = 0.25;

/// The least derivative of a side's function by its own parameter.
const MIN_RATE: f64 = 0.5;

/// A conic by one parameter v and the other, u, in fractions of the domain relative to a point: a region is where
/// `±v < a + b u + c u² + d u v + f v²`, + if it is upwards.
#[derive(Debug, Clone, Copy)]
pub struct RimSide {
    /// The axis of v.
    pub axis: Axis,
    /// Whether the region ends towards larger v.
    pub is_upwards: bool,
    /// a, b, c, d and f.
    pub coefficients: [f64; 5],
    /// A positive lower bound over the box on `1 ∓ d u ∓ 2 f v`, the derivative by ±v of the left side less the right.
    pub rate: f64,
    /// A bound on `|b + 2 c u + d v| / rate` over the box.
    pub slope: f64,
}

/// Where a region has no boundary: in a box, each point within all of its sides, one or two, belongs to it.
///
/// The sides of two axes have slopes of a product below 1, and those of one axis end the region towards the same
/// side. Towards smaller ±v the whole side of the box is within the side.
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
        let conics = |of: &[Curve]| {
            let arcs = pieces.iter().filter(|(curve, _)| of.contains(curve)).map(|(_, arc)| arc);
            Conic::through(arcs, bounds, origin)
        };
        let alone = |conics: [Conic; 2]| conics.map(|conic| vec![(conic, None)]).into();
        let mut choices: Vec<Vec<Sides>> = vec![alone(conics(&curves))];
        if let [first, second] = curves[..] {
            let [one, other] = [conics(&[first]), conics(&[second])];
            let both =
                |x: usize, y: usize| vec![(one[x].clone(), Some(first)), (other[y].clone(), Some(second))];
            choices.push(vec![both(0, 0), both(0, 1), both(1, 0), both(1, 1)]);
            choices.extend([one, other].map(alone));
        }
        let rim_of = |sides: &Sides| {
            let of_axes = if sides.len() == 1 || sides[0].0.axis == sides[1].0.axis { 2 } else { 4 };
            SIGNS[..of_axes].iter().find_map(|signs| self.rim_of(sides, bounds, signs))
        };
        choices.iter().filter_map(|choice| choice.iter().find_map(rim_of)).collect()
    }

    /// The rim with these conics, each for the arcs of a curve or of all, that end the region upwards or not.
    fn rim_of(
        &self,
        conics: &[(Conic, Option<Curve>)],
        [low, high]: [DVec2; 2],
        signs: &[bool],
    ) -> Option<Rim> {
        let sign = |side: usize| if signs[side] { 1.0 } else { -1.0 };
        let mut region = ParamBox::new([low.x, high.x], [low.y, high.y]);
        // A point within the sides, at most as far from the lower sides as those are moved.
        let mut within = DVec2::from(region.middle());
        // Each side of the box that a conic must not meet is moved beyond it, twice as they depend on each other.
        for _ in 0..2 {
            for (side, (conic, _)) in conics.iter().enumerate() {
                let (axis, is_upwards) = (conic.axis, signs[side]);
                let lowest = conic.lowest(sign(side), region[axis.other()]);
                let extension = sign(side) * EXTENSION * (high - low)[axis.index()];
                let [near, far] = [low, high].map(|corner| corner[axis.index()]);
                let lowest = if is_upwards { near.min(lowest) } else { far.max(lowest) };
                let end = (lowest - extension).clamp(0.0, 1.0);
                region[axis][usize::from(!is_upwards)] = end;
                within[axis.index()] = end + WITHIN * (lowest - end);
            }
        }
        let is_inside = region.low().iter().chain(&region.high()).all(|end| (0.0..=1.0).contains(end));
        if !is_inside || !self.holds(within) {
            return None;
        }
        let pieces = self.pieces_in([region.low().into(), region.high().into()])?;
        let is_known =
            |piece: &Curve| conics.iter().any(|(_, curve)| curve.is_none_or(|curve| curve == *piece));
        if !pieces.iter().all(|(curve, _)| is_known(curve)) {
            return None;
        }
        let mut sides = Vec::with_capacity(conics.len());
        for (side, (conic, curve)) in conics.iter().enumerate() {
            let (sign, axis) = (sign(side), conic.axis);
            let arcs = pieces.iter().filter(|(of, _)| curve.is_none_or(|curve| curve == *of));
            let depth =
                arcs.map(|(_, arc)| -conic.least(&arc.piece, sign, self.rounding())).fold(0.0, upper_max);
            let [a, b, c, d, f] = conic.coefficients.map(|coefficient| sign * coefficient);
            let rounding = 8.0 * self.rounding() * (1.0 + b.abs() + c.abs() + d.abs() + f.abs());
            let depth = depth + rounding;
            let rate = conic.rate(&region) - rounding;
            let lower_side = region[axis][usize::from(!signs[side])];
            let is_within = conic.highest(sign, lower_side, region[axis.other()]) < -depth
                && conic.at(sign, within) < -depth;
            if !is_within || !(rate >= MIN_RATE) {
                return None;
            }
            let slope = (conic.slope(&region) + rounding) / rate;
            let coefficients = [a - depth, b, c, d, f];
            sides.push(RimSide { axis, is_upwards: signs[side], coefficients, rate, slope });
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

/// Conics, each for the arcs of a curve or of all.
type Sides = Vec<(Conic, Option<Curve>)>;

/// Whether the sides end the region upwards: both to the same side first, which those over one parameter have to.
const SIGNS: [[bool; 2]; 4] = [[true, true], [false, false], [true, false], [false, true]];

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::model::trim::{Trim, TrimCurveArrays};
    use crate::model::{NurbsSurface, SurfaceArrays};

    /// A side is as far within its conic as arcs are, and by 8 roundings of the domain of each coefficient's term
    /// besides, which its slope is enlarged and its rate lowered by, too.
    #[test]
    fn a_side_has_its_rounding() {
        let square = [[-0.5, -1.0], [0.5, -1.0], [0.5, 1.0], [-0.5, 1.0]];
        let winding = region(&square, 0.0).winding();
        let (b, c, d, f) = (0.5, 0.25, 0.75, 1.5);
        for (is_upwards, sign, v) in [(true, 1.0, 0.75), (false, -1.0, 0.25)] {
            let coefficients = [0.0, sign * b, sign * c, sign * d, sign * f];
            let origin = DVec2::new(0.5, v);
            let conic = Conic { axis: Axis::V, origin, coefficients };
            let half = DVec2::splat(1.0 / 32.0);
            let bounds = [origin - half, origin + half];
            let rim = winding.rim_of(&[(conic.clone(), None)], bounds, &[is_upwards]).unwrap();
            let pieces = winding.pieces_in([rim.region.low().into(), rim.region.high().into()]).unwrap();
            let depth = pieces
                .iter()
                .map(|(_, arc)| -conic.least(&arc.piece, sign, winding.rounding()))
                .fold(0.0, upper_max);
            // The loop is straight, at v of the point: below the conic by as much as that rises.
            let rise = b / 32.0 + c / 1024.0;
            assert!(depth >= rise && depth < 2.0 * rise, "{depth} {rise}");
            let rounding = 8.0 * winding.rounding() * (1.0 + b + c + d + f);
            let [side] = &rim.sides[..] else { panic!("{rim:?}") };
            let own = |found: f64| (found / rounding - 1.0).abs() < 0.1;
            assert!(own(conic.rate(&rim.region) - side.rate), "{side:?} {rounding:e}");
            assert!(own(side.slope * side.rate - conic.slope(&rim.region)), "{side:?} {rounding:e}");
            assert!(own(-side.coefficients[0] - depth), "{side:?} {depth:e} {rounding:e}");
        }
    }

    /// The part of [-1, 1] × [-2, 2] within a polygon, with sides of this middle weight, 0 for straight ones: they
    /// bulge by a fifth of their length, outwards or inwards in turn.
    fn region(corners: &[[f64; 2]], weight: f64) -> Trim {
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
        region_within((0..corners.len()).map(side).collect())
    }

    /// The part of [-1, 1] × [-2, 2] within a loop.
    fn region_within(curves: Vec<TrimCurveArrays>) -> Trim {
        let surface = NurbsSurface::new(
            0,
            SurfaceArrays {
                degree: [1, 1],
                knots: [vec![-1.0, -1.0, 1.0, 1.0], vec![-2.0, -2.0, 2.0, 2.0]],
                counts: [2, 2],
                control_points: [-1.0, 1.0].map(|x| [-2.0, 2.0].map(|y| [x, y, 0.0, 1.0])).concat(),
            },
        );
        Trim::new(0, &surface.unwrap(), vec![curves]).unwrap()
    }

    /// Counterclockwise, with convex, right, obtuse and reflex corners.
    const POLYGON: [[f64; 2]; 6] =
        [[-0.6, -1.3], [0.1, -1.2], [0.2, -0.2], [0.7, 0.1], [0.6, 1.4], [-0.5, 1.0]];

    /// The value of a side at fractions relative to the point: how far they are beyond it.
    fn beyond(side: &RimSide, place: DVec2) -> f64 {
        let (v, u) = (side.axis.index(), side.axis.other().index());
        let [a, b, c, d, f] = side.coefficients;
        let sign = if side.is_upwards { 1.0 } else { -1.0 };
        sign * place[v] - a - place[u] * (b + c * place[u] + d * place[v]) - f * place[v] * place[v]
    }

    /// Whether every point of a lower side of a rim is within that side.
    fn has_lower_sides_within(rim: &Rim, origin: DVec2) -> bool {
        rim.sides.iter().all(|side| {
            let mut place = DVec2::ZERO;
            place[side.axis.index()] = rim.region[side.axis][usize::from(!side.is_upwards)];
            let [low, high] = rim.region[side.axis.other()];
            (0..=64).all(|step| {
                place[side.axis.other().index()] = low + (high - low) * f64::from(step) / 64.0;
                beyond(side, place - origin) < 0.0
            })
        })
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
                    assert!(has_lower_sides_within(&rim, middle + 0.3 * half), "{rim:?}");
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
                            let [u, v] = [side.axis.other(), side.axis].map(|axis| relative[axis.index()]);
                            let [_, b, c, d, f] = side.coefficients;
                            let sign = if side.is_upwards { 1.0 } else { -1.0 };
                            assert!(1.0 - sign * (d * u + 2.0 * f * v) >= side.rate && side.rate >= 0.5);
                            assert!((b + 2.0 * c * u + d * v).abs() <= side.slope * side.rate);
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

    /// Arcs of circles are met exactly from either side: no place within the domain of the rim that is farther
    /// than rounding within the conic is outside, and none as far beyond it is inside.
    #[test]
    fn arcs_of_circles_are_exact() {
        let random = &mut fastrand::Rng::with_seed(3193);
        // Four quarters of a circle about the middle, in fractions of the domain an ellipse.
        let corners = [[0.5, 0.0], [0.0, 0.5], [-0.5, 0.0], [0.0, -0.5]];
        let arc = |k: usize| {
            let ([x0, y0], [x1, y1]): ([f64; 2], [f64; 2]) = (corners[k], corners[(k + 1) % 4]);
            let weight = std::f64::consts::FRAC_1_SQRT_2;
            let middle = [x0 + x1, y0 + y1, weight];
            TrimCurveArrays {
                degree: 2,
                knots: [vec![0.0; 3], vec![1.0; 3]].concat(),
                control_points: vec![[x0, y0, 1.0], middle, [x1, y1, 1.0]],
                ..TrimCurveArrays::default()
            }
        };
        let winding = region_within((0..4).map(arc).collect()).winding();
        let mut found = 0;
        for _ in 0..200 {
            let angle = std::f64::consts::TAU * random.f64();
            let size = 10.0_f64.powf(-1.0 - 3.0 * random.f64());
            let middle = [0.5 * angle.cos(), 0.5 * angle.sin()];
            let box_ = ParamBox::new(
                [middle[0] - size, middle[0] + 0.3 * size],
                [middle[1] - 0.7 * size, middle[1] + size],
            );
            let origin = winding.fraction(DVec2::from(middle));
            let is_conic = |rim: &&Rim| rim.sides.len() == 1 && rim.sides[0].coefficients[3..] != [0.0; 2];
            for rim in winding.rims(&box_, middle).iter().filter(is_conic) {
                found += 1;
                let [low, high] = [DVec2::from(rim.region.low()), DVec2::from(rim.region.high())];
                for _ in 0..50 {
                    let place = low + (high - low) * DVec2::new(random.f64(), random.f64());
                    let excess = beyond(&rim.sides[0], place - origin);
                    let [x, y] = winding.parameters(place);
                    let is_inside = x * x + y * y < 0.25;
                    assert!(excess.abs() < 1e-10 || is_inside == (excess < 0.0), "{excess:e} {rim:?}");
                }
            }
        }
        assert!(found > 150, "{found}");
    }

    /// A loop that ends on the border of the domain has a rim there, over the parameter in which the region can be
    /// left without leaving the domain.
    #[test]
    fn a_loop_has_a_rim_up_to_the_border_of_the_domain() {
        let winding = region(&[[-1.0, -2.0], [1.0, -2.0], [-1.0, 1.0]], 0.0).winding();
        for (box_, origin) in [
            (ParamBox::new([-1.0, -0.98], [0.9, 1.0]), [-1.0, 0.95]),
            (ParamBox::new([0.9, 1.0], [-2.0, -1.9]), [0.95, -2.0]),
        ] {
            let rims = winding.rims(&box_, origin);
            let place = winding.fraction(DVec2::from(origin));
            assert!(rims.iter().all(|rim| has_lower_sides_within(rim, place)), "{rims:?}");
            let [side] = &rims[0].sides[..] else { panic!("{rims:?}") };
            // The region ends at x / 2 + (y + 2) / 3 = 1 / 2, by fractions at x + y = 1.
            let relative = winding.fraction(DVec2::new(-1.0, 1.0)) - winding.fraction(DVec2::from(origin));
            assert!(beyond(side, relative).abs() < 1e-9, "{side:?}");
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
