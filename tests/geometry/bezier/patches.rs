//! Bézier extraction, evaluation, cutting and derivative bounds agree with the
//! textbook recursion on every shape and every model there is.

use crate::support::evaluator::evaluate_on_span;
use crate::support::models;
use glam::{DVec3, DVec4};
use nurbs_hausdorff::internals::bezier::{BezierModel, Jet, Patch, extract};
use nurbs_hausdorff::internals::flatness::{Flatness, flatten};
use nurbs_hausdorff::shapes::{list, shape};
use nurbs_hausdorff::{Axis, Model, NurbsSurface, ParamBox, SurfaceArrays};

/// Part of the diagonal by which points may differ; derivatives by the degree
/// and by its square times that, as differentiating scales rounding.
const TOLERANCE: f64 = 1e-12;

/// Patches looked at in each model, evenly among all.
const PATCHES: usize = 150;

/// Patch parameters looked at along each direction.
const PARAMETERS: [f64; 5] = [0.0, 0.21, 0.5, 0.83, 1.0];

struct Subject {
    name: String,
    model: Model,
    bezier: BezierModel,
    diagonal: f64,
}

fn subjects(test: &str) -> impl Iterator<Item = Subject> {
    list().map(|info| (info.name.to_owned(), shape(info.name).unwrap())).chain(models::all(test)).map(
        |(name, model)| Subject {
            name,
            bezier: extract(&model),
            diagonal: model.bounding_box().diagonal(),
            model,
        },
    )
}

impl Subject {
    /// Some patches, the first and almost coincident knots' always among them.
    fn patches(&self) -> impl Iterator<Item = Patch<'_>> {
        let stride = self.bezier.patches.len().div_ceil(PATCHES);
        self.bezier.patches.iter().enumerate().filter_map(move |(index, patch)| {
            let range = |axis: Axis| {
                let [start, end] = self.model.surfaces()[patch.surface].domain()[axis];
                (patch.domain[axis][1] - patch.domain[axis][0]) / (end - start)
            };
            let short = range(Axis::U).min(range(Axis::V)) < 1e-9;
            (index % stride == 0 || short).then_some(patch)
        })
    }

    /// What the textbook says of the patch at `parameters`, by its own (s, t).
    fn expected(&self, patch: &Patch<'_>, parameters: [f64; 2]) -> Jet {
        let surface = &self.model.surfaces()[patch.surface];
        let spans = Axis::BOTH
            .map(|axis| surface.knots(axis).iter().rposition(|&knot| knot <= patch.domain[axis][0]).unwrap());
        let [u, v] = patch.surface_parameters(parameters);
        let [h, k] = patch.domain.lengths();
        let found = evaluate_on_span(surface, spans, u, v, patch.center.into());
        Jet {
            point: DVec3::from(found.point),
            s: h * DVec3::from(found.u),
            t: k * DVec3::from(found.v),
            ss: h * h * DVec3::from(found.uu),
            st: h * k * DVec3::from(found.uv),
            tt: k * k * DVec3::from(found.vv),
        }
    }

    fn assert_near(&self, what: &str, found: DVec3, expected: DVec3, scale: f64) {
        let error = (found - expected).length() / self.diagonal;
        assert!(error <= TOLERANCE * scale, "{}: {what} off by {error:e} of the diagonal", self.name);
    }
}

fn grid() -> impl Iterator<Item = [f64; 2]> {
    PARAMETERS.into_iter().flat_map(|s| PARAMETERS.map(|t| [s, t]))
}

#[test]
fn patches_have_the_points_and_derivatives_of_the_surface() {
    for subject in subjects("patches_have_the_points_and_derivatives_of_the_surface") {
        for patch in subject.patches() {
            let [p, q] = patch.degree.map(|degree| degree as f64);
            for at in grid() {
                let expected = subject.expected(&patch, at);
                let jet = patch.jet(at);
                subject.assert_near("point", patch.point(at) - patch.center, expected.point, 1.0);
                subject.assert_near("jet's point", jet.point - patch.center, expected.point, 1.0);
                subject.assert_near("s", jet.s, expected.s, p);
                subject.assert_near("t", jet.t, expected.t, q);
                subject.assert_near("ss", jet.ss, expected.ss, p * p);
                subject.assert_near("st", jet.st, expected.st, p * q);
                subject.assert_near("tt", jet.tt, expected.tt, q * q);
            }
        }
    }
}

#[test]
fn patches_tile_the_domain() {
    for Subject { name, model, bezier, .. } in subjects("patches_tile_the_domain") {
        let mut index = 0;
        for (number, (surface, grid)) in model.surfaces().iter().zip(&bezier.grids).enumerate() {
            assert_eq!(grid.first, index, "{name}");
            for axis in Axis::BOTH {
                let [start, end] = surface.domain()[axis];
                let mut distinct = surface.knots(axis).to_vec();
                distinct.retain(|&knot| (start..=end).contains(&knot));
                distinct.dedup();
                assert_eq!(grid.breaks[axis], distinct, "{name}");
                // Where the surface ends nothing is continuous, whatever its knots.
                let repeated = |&knot: &f64| match knot {
                    _ if knot == start || knot == end => surface.degree()[axis] + 1,
                    _ => surface.knots(axis).iter().filter(|other| **other == knot).count(),
                };
                let expected: Vec<usize> = distinct.iter().map(repeated).collect();
                let found: Vec<usize> = grid.multiplicities[axis].iter().map(|&m| usize::from(m)).collect();
                assert_eq!(found, expected, "{name}");
            }
            for u in grid.breaks[0].windows(2) {
                for v in grid.breaks[1].windows(2) {
                    let patch = bezier.patches.patch(index);
                    assert_eq!(patch.surface, number, "{name}");
                    assert_eq!(patch.domain.intervals(), [[u[0], u[1]], [v[0], v[1]]], "{name}");
                    assert_eq!(patch.degree, surface.degree(), "{name}");
                    index += 1;
                }
            }
        }
        assert_eq!(index, bezier.patches.len(), "{name}");
    }
}

#[test]
fn parameters_are_located_on_their_patch() {
    for Subject { name, model, bezier, .. } in subjects("parameters_are_located_on_their_patch") {
        for (surface, grid) in model.surfaces().iter().zip(&bezier.grids) {
            for axis in Axis::BOTH {
                let [start, end] = surface.domain()[axis];
                for step in 0..=40 {
                    let parameter = (start + f64::from(step) / 40.0 * (end - start)).min(end);
                    let (span, local) = grid.locate(axis, parameter);
                    let [low, high] = [grid.breaks[axis][span], grid.breaks[axis][span + 1]];
                    assert!((low..=high).contains(&parameter), "{name}");
                    let back = (1.0 - local) * low + local * high;
                    assert!((back - parameter).abs() <= 1e-15 * (start.abs() + end.abs()), "{name}");
                }
                let (last, before) = (grid.counts()[axis] - 1, start - 1.0);
                assert_eq!(grid.locate(axis, before), (0, 0.0), "{name}");
                assert_eq!(grid.locate(axis, end + 1.0), (last, 1.0), "{name}");
            }
        }
    }
}

#[test]
fn boxes_hold_their_patches() {
    for subject in subjects("boxes_hold_their_patches") {
        for patch in subject.patches() {
            let bounds = patch.bounding_box();
            for at in grid() {
                let outside = bounds.min_distance_squared(patch.point(at)).sqrt();
                assert!(outside <= TOLERANCE * subject.diagonal, "{}: {outside}", subject.name);
            }
        }
    }
}

#[test]
fn weights_are_positive_and_differ_only_on_rational_patches() {
    for subject in subjects("weights_are_positive_and_differ_only_on_rational_patches") {
        for patch in subject.bezier.patches.iter() {
            assert!(patch.controls.iter().all(|control| control.w > 0.0), "{}", subject.name);
            if !patch.rational {
                let weight = patch.controls[0].w;
                assert!(patch.controls.iter().all(|control| (control.w / weight - 1.0).abs() < 1e-14));
            }
        }
    }
}

#[test]
fn halves_and_restrictions_keep_the_points() {
    for subject in subjects("halves_and_restrictions_keep_the_points") {
        for patch in subject.patches() {
            for axis in Axis::BOTH {
                for (half, controls) in patch.halves(axis).iter().enumerate() {
                    let piece = Patch { controls, ..patch };
                    for at in grid() {
                        let mut whole = at;
                        whole[axis] = 0.5 * (half as f64 + at[axis]);
                        subject.assert_near("half", piece.point(at), patch.point(whole), 1.0);
                    }
                }
            }
            for (s, t) in [([0.2, 0.7], [0.0, 1.0]), ([0.0, 0.125], [0.9, 1.0]), ([1.0, 1.0], [0.3, 0.3])] {
                let controls = patch.restricted(s, t);
                let piece = Patch { controls: &controls, ..patch };
                for at in grid() {
                    let inside = |[start, end]: [f64; 2], x: f64| start + x * (end - start);
                    let whole = [inside(s, at[0]), inside(t, at[1])];
                    subject.assert_near("restriction", piece.point(at), patch.point(whole), 1.0);
                }
            }
        }
    }
}

#[test]
fn flat_pieces_tile_the_patches_and_keep_the_points() {
    for subject in subjects("flat_pieces_tile_the_patches_and_keep_the_points") {
        for flatness in [Flatness::None, Flatness::Loose, Flatness::Tight, Flatness::Curvature] {
            let flat = flatten(&subject.bezier.patches, flatness).patches;
            assert!(flat.len() >= subject.bezier.patches.len(), "{}", subject.name);
            let area = |patch: Patch<'_>| {
                let [[u0, u1], [v0, v1]] = patch.domain.intervals();
                (u1 - u0) * (v1 - v0)
            };
            let (whole, pieces): (f64, f64) =
                (subject.bezier.patches.iter().map(area).sum(), flat.iter().map(area).sum());
            assert!((whole - pieces).abs() <= 1e-10 * whole, "{}: {whole} {pieces}", subject.name);
            for patch in flat.iter().step_by(flat.len().div_ceil(PATCHES)) {
                let original = subject.original(&patch);
                for at in grid() {
                    let expected = original.point(subject.on(&original, patch.surface_parameters(at)));
                    subject.assert_near("piece", patch.point(at), expected, 1.0);
                }
            }
        }
    }
}

impl Subject {
    /// The patch that `piece` was cut from.
    fn original(&self, piece: &Patch<'_>) -> Patch<'_> {
        let grid = &self.bezier.grids[piece.surface];
        let [i, j] =
            Axis::BOTH.map(|axis| grid.locate(axis, 0.5 * (piece.domain[axis][0] + piece.domain[axis][1])).0);
        self.bezier.patches.patch(grid.first + i * grid.counts()[1] + j)
    }

    /// The patch parameters of surface parameters.
    fn on(&self, patch: &Patch<'_>, parameters: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|axis| {
            let [start, end] = patch.domain[axis];
            ((parameters[axis] - start) / (end - start)).clamp(0.0, 1.0)
        })
    }
}

#[test]
fn derivative_bounds_hold_at_samples() {
    for subject in subjects("derivative_bounds_hold_at_samples") {
        for patch in subject.patches() {
            let bounds = patch.derivative_bounds();
            let check = |what: &str, found: f64, bound: f64, scale: f64| {
                let room = TOLERANCE * scale * subject.diagonal;
                assert!(found <= bound + room, "{}: {what} {found} over {bound}", subject.name);
            };
            let degree = patch.degree[0].max(patch.degree[1]) as f64;
            let jets: Vec<Vec<Jet>> =
                PARAMETERS.map(|s| PARAMETERS.map(|t| subject.expected(&patch, [s, t])).to_vec()).to_vec();
            for jet in jets.iter().flatten() {
                check("radius", jet.point.length(), bounds.radius, 1.0);
                for (derivative, bound) in [jet.s, jet.t].into_iter().zip(bounds.first) {
                    check("first", derivative.length(), bound, degree);
                }
                for (derivative, bound) in [jet.ss, jet.st, jet.tt].into_iter().zip(bounds.second) {
                    check("second", derivative.length(), bound, degree * degree);
                }
            }
            // By the mean value theorem a difference quotient of the second
            // derivatives is at most the largest third derivative.
            for (fixed, row) in jets.iter().enumerate() {
                for (low, pair) in PARAMETERS.windows(2).enumerate() {
                    let step = pair[1] - pair[0];
                    let [a, b] = [&jets[low][fixed], &jets[low + 1][fixed]];
                    let [c, d] = [&row[low], &row[low + 1]];
                    for (change, bound) in [
                        (b.ss - a.ss, bounds.third[0]),
                        (b.st - a.st, bounds.third[1]),
                        (d.ss - c.ss, bounds.third[1]),
                        (b.tt - a.tt, bounds.third[2]),
                        (d.st - c.st, bounds.third[2]),
                        (d.tt - c.tt, bounds.third[3]),
                    ] {
                        check("third", change.length(), bound * step, degree.powi(3));
                    }
                }
            }
        }
    }
}

/// The bicubic patch (s, t, s^3 + s t^2), whose derivatives' bounds are known.
#[test]
fn derivative_bounds_of_a_polynomial_are_its_largest_derivatives() {
    let (linear, square, cube) =
        ([0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0], [0.0, 0.0, 1.0 / 3.0, 1.0], [0.0, 0.0, 0.0, 1.0]);
    let controls: Vec<DVec4> = (0..16)
        .map(|k| {
            let (i, j) = (k / 4, k % 4);
            DVec4::new(linear[i], linear[j], cube[i] + linear[i] * square[j], 1.0)
        })
        .collect();
    let patch = Patch {
        surface: 0,
        degree: [3, 3],
        domain: ParamBox::UNIT,
        center: DVec3::ZERO,
        controls: &controls,
        rational: false,
    };
    let bounds = patch.derivative_bounds();
    // First derivatives (1, 0, 3s^2 + t^2) and (0, 1, 2st), second 6s, 2t, 2s, third 6, 0, 2, 0.
    for (found, expected) in
        [(bounds.first, [17_f64.sqrt(), 5_f64.sqrt()])].into_iter().flat_map(|(a, b)| a.into_iter().zip(b))
    {
        assert!((found - expected).abs() < 1e-10, "{found} {expected}");
    }
    for (found, expected) in bounds.second.into_iter().zip([6.0, 2.0, 2.0]) {
        assert!((found - expected).abs() < 1e-10, "{found} {expected}");
    }
    for (found, expected) in bounds.third.into_iter().zip([6.0, 0.0, 2.0, 0.0]) {
        assert!((found - expected).abs() < 1e-10, "{found} {expected}");
    }
}

#[test]
fn degree_15_is_evaluated() {
    let counts = [18, 16];
    let control_points = (0..counts[0] * counts[1])
        .map(|k| {
            let (i, j) = ((k / counts[1]) as f64, (k % counts[1]) as f64);
            [i, j, (i * 0.9).sin() * (j * 0.7).cos(), 1.0 + 0.5 * (i + 2.0 * j).sin()]
        })
        .collect();
    let knots_u = (0..34).map(|k| f64::from(k) + f64::from(k % 3) * 0.3).collect();
    let knots_v = [vec![0.0; 16], vec![2.0; 16]].concat();
    let arrays = SurfaceArrays { degree: [15, 15], knots: [knots_u, knots_v], counts, control_points };
    let model = Model::new(None, vec![NurbsSurface::new(0, arrays).unwrap()]).unwrap();
    let subject = Subject {
        name: "degree 15".to_owned(),
        bezier: extract(&model),
        diagonal: model.bounding_box().diagonal(),
        model,
    };
    assert_eq!(subject.bezier.patches.len(), 3);
    for patch in subject.bezier.patches.iter() {
        for at in [[0.0, 0.0], [0.3, 0.6], [1.0, 0.9]] {
            let (jet, expected) = (patch.jet(at), subject.expected(&patch, at));
            subject.assert_near("point", jet.point - patch.center, expected.point, 1.0);
            subject.assert_near("ss", jet.ss, expected.ss, 225.0);
            subject.assert_near("tt", jet.tt, expected.tt, 225.0);
        }
    }
}

#[test]
fn poles_have_no_normal() {
    let bezier = extract(&shape("sphere").unwrap());
    let pole = bezier.patches.patch(0);
    assert_eq!(pole.jet([0.3, 0.0]).normal(), None);
    let normal = pole.jet([0.3, 0.4]).normal().unwrap();
    assert!((normal - pole.point([0.3, 0.4]) / 2.0).length() < 1e-14);
}
