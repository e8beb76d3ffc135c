//! Pairs at the edge of what is accepted: the families on which an interval was
//! once false or a search did not end, and those nearest to them.

use super::collapsed::collapsed_nets;
use super::offsets::{Offset, arrays, offset};
use super::pairs::{Pair, random_limit};
use super::partners::{both_sides, cut, near, refined, scale_and_shift};
use super::surfaces::{Weights, surface, weights};
use super::surfaces::{degenerate, direction, magnitude, surface_of_degree};
use fastrand::Rng;
use glam::{DQuat, DVec3};
use nurbs_hausdorff::internals::engine::{Backend, MethodName};
use nurbs_hausdorff::shapes::operations::cut_model;
use nurbs_hausdorff::shapes::{lateral, sphere, sphere_parts, torus};
use nurbs_hausdorff::{Model, RigidTransform, SurfaceArrays};

/// The budgets of cells per direction, with which a pair takes less than a second.
const BUDGETS: [usize; 3] = [1, 1000, 5000];

/// The largest exponent of the power of two by which a model's coordinates are
/// scaled, about 1e100.
const MAX_EXPONENT: i32 = 332;

/// One pair in this many is computed on the GPU, because software adapters are slow.
const GPU_SHARE: u64 = 32;

/// Draws a pair of a family.
type Family = fn(&mut Rng) -> Models;

/// The families, and their names in reports.
const FAMILIES: [(&str, Family); 12] = [
    ("near spheres", near_spheres),
    ("parts of spheres", parts_of_spheres),
    ("reparametrized copies", reparametrized),
    ("split copies", split_copies),
    ("offsets", near_offsets),
    ("almost the same axis", almost_same_axis),
    ("weights far apart", weights_far_apart),
    ("degenerate and folded", folded),
    ("degrees 9 to 15", high_degrees),
    ("knots close together", close_knots),
    ("two sheets", two_sheets),
    ("many surfaces", many_surfaces),
];

/// Seeds with this remainder are of collapsed nets; those of the other families stay the same.
const COLLAPSED: [u64; 2] = [5, 13];

/// A, B and the directed distances from A to B and from B to A, if they are known.
pub(super) struct Models {
    pub(super) a: Vec<SurfaceArrays>,
    pub(super) b: Vec<SurfaceArrays>,
    pub(super) truth: Option<[f64; 2]>,
}

/// Returns the pair of a seed, deterministically; `None` where a model is refused.
pub(crate) fn pair(seed: u64) -> Option<Pair> {
    let [remainder, divisor] = COLLAPSED;
    if seed % divisor == remainder {
        return collapsed_pair(seed);
    }
    let rng = &mut Rng::with_seed(seed);
    let (kind, models) = FAMILIES[rng.usize(0..FAMILIES.len())];
    let models = models(rng);
    with_options(seed, kind, models, rng)
}

/// Returns the pair of collapsed nets of a seed.
pub(crate) fn collapsed_pair(seed: u64) -> Option<Pair> {
    let rng = &mut Rng::with_seed(seed);
    let models = collapsed_nets(rng);
    with_options(seed, "collapsed nets", models, rng)
}

/// Places a pair, and draws the options of its computation.
fn with_options(seed: u64, kind: &'static str, models: Models, rng: &mut Rng) -> Option<Pair> {
    let Models { mut a, mut b, truth } = models;
    // Far from the origin, or of any size.
    if rng.u8(0..4) == 0 {
        let shift = direction(rng) * magnitude(rng, 6.0, 9.0);
        for model in [&mut a, &mut b] {
            scale_and_shift(model, 1.0, shift.to_array());
        }
    }
    let exponent = if rng.u8(0..4) == 0 { rng.i32(-MAX_EXPONENT..=MAX_EXPONENT) } else { 0 };
    let [a, b] = [a, b].map(|model| Model::from_arrays(None, model).ok());
    let (a, b) = (a?, b?);
    let diagonal = a.bounding_box().diagonal().max(b.bounding_box().diagonal());
    // Just below or above the distance where it is known.
    let near_truth = truth.filter(|_| diagonal > 0.0 && rng.u8(0..4) == 0).map(|[forward, _]| {
        let side = if rng.bool() { 1.0 } else { -1.0 };
        forward / diagonal * (1.0 + side * magnitude(rng, -9.0, -1.0))
    });
    Some(Pair {
        kind,
        a,
        b,
        transform: RigidTransform::IDENTITY,
        truth,
        tolerance: magnitude(rng, -9.0, -2.0),
        max_cells: BUDGETS[rng.usize(0..BUDGETS.len())],
        symmetric: truth.is_none() && rng.u8(0..4) == 0,
        limit: near_truth.or_else(|| random_limit(rng)),
        method: match rng.u8(0..8) {
            0 => MethodName::Iteration,
            1 => MethodName::Hierarchy,
            _ => MethodName::Certified,
        },
        backend: if seed % GPU_SHARE == 1 { Backend::Auto } else { Backend::Cpu },
        exponent,
    })
}

fn turned(rng: &mut Rng, model: &Model) -> Vec<SurfaceArrays> {
    arrays(model, DQuat::from_axis_angle(direction(rng), rng.f64() * 6.0), DVec3::ZERO)
}

/// A sphere against one whose control points and weights are a little off.
fn near_spheres(rng: &mut Rng) -> Models {
    let b = turned(rng, &sphere(DVec3::ZERO, 1.0).unwrap());
    let size = magnitude(rng, -14.0, -2.0);
    let larger = turned(rng, &sphere(DVec3::ZERO, 1.0 + size).unwrap());
    let a = near(rng, &larger, size);
    Models { a, b, truth: None }
}

fn parts_of_spheres(rng: &mut Rng) -> Models {
    let radii = [1.0, 1.0 + magnitude(rng, -12.0, -1.0)];
    let [a, b] = sphere_parts(radii).unwrap();
    let turn = DQuat::from_axis_angle(direction(rng), rng.f64() * 6.0);
    let [a, b] = [a, b].map(|model| arrays(&model, turn, DVec3::ZERO));
    let apart = radii[1] - radii[0];
    // The part that is B is larger: from B to A the distance is not known.
    Models { a, b, truth: Some([apart, f64::NAN]) }
}

/// A Bézier surface against itself by other parameters: weights multiplied by
/// powers of two along rows and columns are a projective change of parameters.
fn reparametrized(rng: &mut Rng) -> Models {
    let weights = weights(rng);
    let degree = [rng.usize(1..=7), rng.usize(1..=7)];
    let mut bezier = surface_of_degree(rng, weights, degree, degree.map(|degree| degree + 1));
    bezier.knots = degree.map(|degree| [0.0, 1.0].map(|end| vec![end; degree + 1]).concat());
    let mut other = bezier.clone();
    let powers = [0, 1].map(|_| rng.i32(-3..=3));
    for (index, point) in other.control_points.iter_mut().enumerate() {
        let [i, j] = [index / other.counts[1], index % other.counts[1]];
        point[3] *= 2.0_f64.powi(powers[0] * i as i32 + powers[1] * j as i32);
    }
    Models { a: vec![bezier], b: vec![other], truth: Some([0.0; 2]) }
}

/// Two cuts of one model, each at its own parameters.
fn split_copies(rng: &mut Rng) -> Models {
    let weights = weights(rng);
    let whole = vec![surface(rng, weights)];
    Models { a: cut(rng, &whole), b: cut(rng, &whole), truth: None }
}

fn near_offsets(rng: &mut Rng) -> Models {
    let Offset { a, b, truth } = offset(rng);
    Models { a, b, truth: Some(truth) }
}

/// A torus or a cylinder against itself about an axis that is a little off.
fn almost_same_axis(rng: &mut Rng) -> Models {
    let model = if rng.bool() {
        torus(2.0, 0.5 + rng.f64()).unwrap()
    } else {
        Model::new(None, vec![lateral([1.0, 0.2 + rng.f64()], [0.0, 2.0]).unwrap()]).unwrap()
    };
    let off = DQuat::from_axis_angle(DVec3::X, magnitude(rng, -14.0, -1.0));
    let shift = direction(rng) * magnitude(rng, -14.0, -1.0);
    Models { a: arrays(&model, off, shift), b: arrays(&model, DQuat::IDENTITY, DVec3::ZERO), truth: None }
}

fn weights_far_apart(rng: &mut Rng) -> Models {
    let mut models = [0, 1].map(|_| vec![surface(rng, Weights::Moderate)]);
    for arrays in models.iter_mut().flatten() {
        for point in &mut arrays.control_points {
            point[3] = magnitude(rng, -6.0, 6.0);
        }
    }
    let [a, b] = models;
    Models { a, b, truth: None }
}

fn folded(rng: &mut Rng) -> Models {
    let [a, b] = [0, 1].map(|_| {
        let weights = weights(rng);
        let mut arrays = surface(rng, weights);
        degenerate(rng, arrays.counts, &mut arrays.control_points);
        degenerate(rng, arrays.counts, &mut arrays.control_points);
        vec![arrays]
    });
    Models { a, b, truth: None }
}

fn high_degrees(rng: &mut Rng) -> Models {
    let weights = weights(rng);
    let a = high_degree(rng, weights);
    let b = if rng.bool() { near(rng, &a, 1e-3) } else { high_degree(rng, weights) };
    Models { a, b, truth: None }
}

fn high_degree(rng: &mut Rng, weights: Weights) -> Vec<SurfaceArrays> {
    let degree = [rng.usize(9..=15), rng.usize(1..=15)];
    vec![surface_of_degree(rng, weights, degree, degree.map(|degree| degree + 1))]
}

/// A model against itself refined, some of whose knots are moved next to others.
fn close_knots(rng: &mut Rng) -> Models {
    let weights = weights(rng);
    let mut a = vec![surface(rng, weights)];
    for arrays in &mut a {
        for axis in 0..2 {
            let (degree, knots) = (arrays.degree[axis], &mut arrays.knots[axis]);
            for index in degree + 1..knots.len() - degree - 1 {
                if rng.bool() {
                    let gap = magnitude(rng, -16.0, -8.0) * knots[index].abs().max(1.0);
                    knots[index] = (knots[index - 1] + gap).min(knots[index]);
                }
            }
        }
    }
    let b = match rng.u8(0..3) {
        0 => a.clone(),
        1 => near(rng, &a, magnitude(&mut rng.clone(), -9.0, -2.0)),
        _ => refined(rng, &a),
    };
    Models { a, b, truth: None }
}

/// A sheet between two copies, or a plane between two planes by other parameters.
fn two_sheets(rng: &mut Rng) -> Models {
    if rng.bool() {
        let weights = weights(rng);
        let a = vec![surface(rng, weights)];
        let b = both_sides(rng, &a);
        return Models { a, b, truth: None };
    }
    let distance = magnitude(rng, -6.0, 0.0);
    let plane = |half: f64, height: f64, weight: f64| {
        let corner = |x: f64, y: f64| [half * x, half * y, height, if x > 0.0 { weight } else { 1.0 }];
        SurfaceArrays {
            degree: [1, 1],
            knots: [vec![0.0, 0.0, 1.0, 1.0], vec![0.0, 0.0, 1.0, 1.0]],
            counts: [2, 2],
            control_points: vec![corner(-1.0, -1.0), corner(-1.0, 1.0), corner(1.0, -1.0), corner(1.0, 1.0)],
        }
    };
    let a = vec![plane(1.0, 0.0, magnitude(rng, -3.0, 3.0))];
    let b = [-distance, distance].map(|height| plane(1.5, height, magnitude(rng, -3.0, 3.0))).to_vec();
    // From a corner of B, 0.5 beyond A in x and in y.
    Models { a, b, truth: Some([distance, 0.5_f64.sqrt().hypot(distance)]) }
}

/// A model in many pieces against itself moved a little.
fn many_surfaces(rng: &mut Rng) -> Models {
    let weights = weights(rng);
    let whole = Model::from_arrays(None, vec![surface(rng, weights)]).unwrap();
    let fractions = [0, 1].map(|_| -> Vec<f64> {
        let count = rng.usize(2..=5);
        (1..count).map(|index| index as f64 / count as f64).collect()
    });
    let pieces = cut_model(&whole, [&fractions[0], &fractions[1]]).unwrap_or(whole);
    let a: Vec<_> = pieces.surfaces().iter().map(|surface| surface.clone().into_arrays()).collect();
    let size = magnitude(rng, -9.0, -1.0);
    let b = near(rng, &a, size);
    Models { a, b, truth: None }
}
