//! Overlaps of solids that stand flush, coincide, are turned in themselves or are several of one file,
//! against the boxes and balls that they are.

use super::clearance::{clearance, pose};
use super::exact_clearances::{boxed, moved};
use super::solids::{Random, cube, together};
use glam::DVec3;
use nurbs_hausdorff::shapes::{cylinder, sphere};
use nurbs_hausdorff::{ClearanceOptions, ClearanceResult, Model, Overlap, OverlapUnknown, RigidTransform};

/// A box or a ball.
#[derive(Debug, Clone, Copy)]
enum Body {
    Box { low: DVec3, high: DVec3 },
    Ball { center: DVec3, radius: f64 },
}

/// How two bodies lie by geometry.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Truth {
    Apart,
    Touching,
    Common,
}

impl Body {
    fn model(&self) -> Model {
        match *self {
            Self::Ball { center, radius } => sphere(center, radius).unwrap(),
            Self::Box { low, high } => {
                let mut faces = cube(1.0);
                for control in faces.iter_mut().flat_map(|face| &mut face.control_points) {
                    for axis in 0..3 {
                        control[axis] = if control[axis] < 0.0 { low[axis] } else { high[axis] };
                    }
                }
                Model::from_arrays(None, faces).unwrap()
            }
        }
    }

    /// The distance of a point from the boundary, negative inside; of a box no more than it.
    fn depth(&self, point: DVec3) -> f64 {
        match *self {
            Self::Ball { center, radius } => point.distance(center) - radius,
            Self::Box { low, high } => (low - point).max(point - high).max_element(),
        }
    }

    /// What is true of two bodies whose coordinates are multiples of 1/4, or that are balls.
    fn truth(&self, other: &Self) -> Truth {
        let of_gap = |gap: f64| {
            if gap.abs() < 1e-12 {
                Truth::Touching
            } else if gap > 0.0 {
                Truth::Apart
            } else {
                Truth::Common
            }
        };
        match (*self, *other) {
            (Self::Box { low, high }, Self::Box { low: from, high: to }) => {
                of_gap((low - to).max(from - high).max_element())
            }
            (Self::Ball { center, radius }, Self::Ball { center: at, radius: size }) => {
                of_gap(center.distance(at) - radius - size)
            }
            (Self::Ball { center, radius }, Self::Box { low, high })
            | (Self::Box { low, high }, Self::Ball { center, radius }) => {
                of_gap(center.distance(center.clamp(low, high)) - radius)
            }
        }
    }
}

/// A body of coordinates that are multiples of 1/4, so that many stand flush.
fn body(random: &mut Random) -> Body {
    let mut quarters = |least: f64, count: f64| least + 0.25 * (count * random.next()).floor();
    let at = DVec3::from_array([0; 3].map(|_| quarters(-1.0, 9.0)));
    let size = DVec3::from_array([0; 3].map(|_| quarters(0.25, 6.0)));
    if random.next() < 0.5 {
        Body::Box { low: at, high: at + size }
    } else {
        Body::Ball { center: at, radius: size.x }
    }
}

fn turned(random: &mut Random) -> RigidTransform {
    pose(random.within(1.0).to_array(), 6.0 * random.next(), random.within(3.0).to_array())
}

/// Bodies turned about their own centres or not, both moved alike, of which one is given as several bodies
/// of a file in a part of the pairs. Nothing false is stated, and nearly all is decided.
#[test]
fn overlaps_of_boxes_and_balls_are_those_of_geometry() {
    const PAIRS: u64 = 600;
    let (mut undecided, mut counts) = (0, [0; 3]);
    for seed in 0..PAIRS {
        let random = &mut Random(seed);
        let (one, mut others) = (body(random), vec![body(random)]);
        match seed % 6 {
            // The same body, and one more body of the same file.
            0 => others = vec![one],
            1 | 2 => others.push(body(random)),
            _ => {}
        }
        let own = match (seed % 4, one) {
            (0, Body::Ball { center, .. }) => {
                let turn = turned(random).rotation();
                RigidTransform::new(turn, center - turn * center).unwrap()
            }
            _ => RigidTransform::IDENTITY,
        };
        let [place, relative] = [turned(random), turned(random)];
        let [a, b] = [
            moved(&one.model(), &own),
            together(&others.iter().map(Body::model).collect::<Vec<_>>().iter().collect::<Vec<_>>()),
        ]
        .map(|model| moved(&model, &place));
        // A is given elsewhere and moved back in some.
        let (a, transform) = if seed % 3 == 0 {
            let back =
                RigidTransform::new(relative.rotation().inverse(), relative.apply_inverse(DVec3::ZERO))
                    .unwrap();
            (moved(&a, &relative), back)
        } else {
            (a, RigidTransform::IDENTITY)
        };
        let found = clearance(&a, &b, &ClearanceOptions { transform, ..ClearanceOptions::default() });
        let truths: Vec<Truth> = others.iter().map(|other| one.truth(other)).collect();
        let truth = if truths.contains(&Truth::Common) {
            Truth::Common
        } else if truths.contains(&Truth::Touching) {
            Truth::Touching
        } else {
            Truth::Apart
        };
        counts[truth as usize] += 1;
        let name = format!("seed {seed}: {one:?} and {others:?}, {truth:?}");
        let voids = is_in_another(&others);
        match found.overlap {
            None => undecided += 1,
            Some(Overlap::None) => assert!(truth == Truth::Apart || voids, "{name}: {found:?}"),
            // A void takes its space out of its body.
            Some(Overlap::Touching) => assert!(truth == Truth::Touching || voids, "{name}: {found:?}"),
            Some(Overlap::Intersecting { inside_both } | Overlap::Contained { inside_both }) => {
                assert_eq!(truth, Truth::Common, "{name}: {found:?}");
                let point = place.apply_inverse(DVec3::from_array(inside_both));
                let depth = others.iter().map(|other| other.depth(point)).fold(f64::INFINITY, f64::min);
                assert!(one.depth(point) < 1e-12 && depth < 1e-12, "{name}: {point}");
            }
            Some(other) => panic!("{name}: {other:?}"),
        }
        assert_eq!(found.overlap.is_none(), found.overlap_unknown.is_some(), "{name}");
    }
    println!("{undecided} of {PAIRS} undecided; apart, touching and with a common part {counts:?}");
    assert!(undecided <= PAIRS / 50, "{undecided}");
}

/// Whether one of two bodies of a file is certainly within the other one, so that it counts as its void.
fn is_in_another(bodies: &[Body]) -> bool {
    let [one, other] = bodies else { return false };
    let is_within = |inner: &Body, outer: &Body| {
        let points: Vec<DVec3> = match *inner {
            Body::Box { low, high } => (0..8)
                .map(|k| DVec3::select(glam::BVec3::new(k & 1 > 0, k & 2 > 0, k & 4 > 0), low, high))
                .collect(),
            Body::Ball { center, radius } => match *outer {
                Body::Box { .. } => (0..3)
                    .flat_map(|k| [DVec3::AXES[k], -DVec3::AXES[k]])
                    .map(|d| center + radius * d)
                    .collect(),
                Body::Ball { center: about, .. } => {
                    let away = (center - about).normalize_or(DVec3::X);
                    vec![center + radius * away, center - radius * away]
                }
            },
        };
        points.iter().all(|&point| outer.depth(point) < -1e-9)
    };
    is_within(one, other) || is_within(other, one)
}

/// The ball is within both of two bodies that overlap each other.
#[test]
fn a_ball_in_two_bodies_of_a_file_is_contained() {
    let at = |x: f64, radius: f64| sphere(DVec3::new(x, 0.0, 0.0), radius).unwrap();
    let (both, ball) = (together(&[&at(0.0, 1.0), &at(0.8, 1.0)]), at(0.4, 0.1));
    for limit in [None, Some(1e-3)] {
        let found = clearance(&ball, &both, &ClearanceOptions { limit, ..ClearanceOptions::default() });
        let Some(Overlap::Contained { inside_both }) = found.overlap else { panic!("{:?}", found.overlap) };
        assert!(DVec3::from_array(inside_both).distance(DVec3::new(0.4, 0.0, 0.0)) < 0.1 + 1e-12);
        assert_eq!(found.at_least, limit.map(|_| false));
    }
}

/// Cylinders whose caps' edges are arcs of other weights than those of their walls, and 1e-9 smaller.
#[test]
fn solids_with_curved_edges_are_apart_if_their_cracks_are_narrower() {
    let capped = |ratio: f64, factor: f64| {
        let model = cylinder(1.0, 2.0).unwrap();
        let mut surfaces: Vec<_> =
            model.surfaces().iter().map(|surface| surface.clone().into_arrays()).collect();
        for surface in &mut surfaces {
            let [rows, columns] = surface.counts;
            let is_cap = surface.control_points.iter().all(|control| control[2].abs() == 1.0)
                && surface.control_points.windows(2).all(|pair| pair[0][2] == pair[1][2]);
            if !is_cap {
                continue;
            }
            for control in &mut surface.control_points {
                control[0] *= factor;
                control[1] *= factor;
            }
            // Another parameter of each arc, in one polynomial patch or one span of a quarter.
            if surface.knots[0].len() == rows + 3 && rows == 3 {
                for (index, control) in surface.control_points.iter_mut().enumerate() {
                    control[3] *= ratio.powi((index / columns) as i32);
                }
            }
        }
        Model::from_arrays(None, surfaces).unwrap()
    };
    for (ratio, factor) in [(1.0, 1.0), (1.0, 1.0 - 1e-9), (2.0, 1.0 - 1e-9)] {
        let one = capped(ratio, factor);
        for distance in [1e-3, 1e-5, 1e-6] {
            let options = ClearanceOptions {
                transform: pose([0.0, 0.0, 1.0], 0.3, [0.0, 0.0, 2.0 + distance]),
                tolerance: Some(1e-9),
                ..ClearanceOptions::default()
            };
            let found = clearance(&one, &one, &options);
            assert_eq!(found.overlap, Some(Overlap::None), "{ratio} {factor} {distance:e}: {found:?}");
        }
    }
}

/// Why nothing is stated, for each reason that geometry or options give.
#[test]
fn an_overlap_that_is_not_stated_has_a_reason() {
    let (one, far) = (boxed(1.0), pose([0.0, 0.0, 1.0], 0.2, [2.0, 0.0, 0.0]));
    let open = Model::from_arrays(None, cube(1.0)[..5].to_vec()).unwrap();
    let reason = |a: &Model, b: &Model, options: &ClearanceOptions| {
        let ClearanceResult { overlap, overlap_unknown, .. } = clearance(a, b, options);
        assert_eq!(overlap.is_none(), overlap_unknown.is_some());
        overlap_unknown
    };
    let options = ClearanceOptions { transform: far, ..ClearanceOptions::default() };
    assert_eq!(reason(&open, &one, &options), Some(OverlapUnknown::AOpen));
    assert_eq!(reason(&one, &open, &options), Some(OverlapUnknown::BOpen));
    assert_eq!(reason(&open, &open, &options), Some(OverlapUnknown::BothOpen));
    assert_eq!(reason(&one, &one, &options), None);
    // Balls that are 0.1 apart, with a limit and a budget that end before that is known.
    let balls = [1.0, 1.9].map(|radius| sphere(DVec3::ZERO, radius).unwrap());
    let transform = pose([0.3, -1.0, 0.4], 1.1, [3.0, 0.0, 0.0]);
    let limit = ClearanceOptions { limit: Some(2.0), transform, ..ClearanceOptions::default() };
    assert_eq!(reason(&balls[0], &balls[1], &limit), Some(OverlapUnknown::Limit));
    let budget = ClearanceOptions { max_cells: Some(1), transform, ..ClearanceOptions::default() };
    assert_eq!(reason(&balls[0], &balls[1], &budget), Some(OverlapUnknown::Budget));
    // A ball within two that overlap within one body, of which one may be a void.
    let at = |x: f64, radius: f64| sphere(DVec3::new(x, 0.0, 0.0), radius).unwrap();
    let nested = together(&[&at(0.25, 3.0), &at(0.0, 1.0), &at(0.5, 1.0)]);
    assert_eq!(reason(&at(0.25, 0.1), &nested, &ClearanceOptions::default()), Some(OverlapUnknown::Side));
    // The boundaries coincide with that of one of these.
    assert_eq!(reason(&at(0.0, 1.0), &nested, &ClearanceOptions::default()), Some(OverlapUnknown::Side));
}
