//! Bounds of derivatives over parts of flat pieces, and beyond their edges,
//! hold for the patches that these were cut from.

use crate::support::models;
use nurbs_hausdorff::ParamBox;
use nurbs_hausdorff::internals::bezier::{
    DerivativeBounds, Jet, LocalDerivativeBounds, Patch, PatchSet, extract,
};
use nurbs_hausdorff::internals::flatness::{FlatPatches, Flatness, flatten};
use nurbs_hausdorff::shapes::{list, shape};

/// Part of the diagonal by which points may differ, times the degree for every
/// order of derivative.
const TOLERANCE: f64 = 1e-11;

/// Pieces looked at in each model, evenly among all, and boxes on each.
const PIECES: usize = 40;
const BOXES: usize = 24;

/// A flat piece, the patch it was cut from, and where they can be compared.
struct Piece<'a> {
    piece: Patch<'a>,
    patch: Patch<'a>,
    extension: ParamBox,
    name: &'a str,
    diagonal: f64,
}

fn for_each_piece(test: &str, mut look: impl FnMut(&Piece<'_>)) {
    let shapes = list().map(|info| (info.name.to_owned(), shape(info.name).unwrap()));
    for (name, model) in shapes.chain(models::all(test)) {
        let patches = extract(&model).patches;
        let FlatPatches { patches: flat, places, .. } = flatten(&patches, Flatness::Loose);
        let diagonal = model.bounding_box().diagonal();
        for index in (0..flat.len()).step_by(flat.len().div_ceil(PIECES)) {
            let piece = flat.patch(index);
            let patch = original(&patches, &piece);
            look(&Piece {
                piece,
                patch,
                extension: places.get(index as u32).extension,
                name: &name,
                diagonal,
            });
        }
    }
}

/// By the middle of its domain.
fn original<'a>(patches: &'a PatchSet, piece: &Patch<'_>) -> Patch<'a> {
    let middle = piece.surface_parameters([0.5; 2]);
    patches
        .iter()
        .find(|patch| {
            patch.surface == piece.surface
                && (0..2).all(|axis| {
                    let [start, end] = patch.domain[axis];
                    start < middle[axis] && middle[axis] < end
                })
        })
        .unwrap()
}

impl Piece<'_> {
    /// The piece's width in the patch's parameters, and its start there.
    fn place(&self, axis: usize) -> [f64; 2] {
        let ([start, end], [first, last]) = (self.piece.domain[axis], self.patch.domain[axis]);
        [(end - start) / (last - first), (start - first) / (last - first)]
    }

    /// The patch's parameters of the piece's.
    fn on_patch(&self, at: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|axis| {
            let [width, start] = self.place(axis);
            start + width * at[axis]
        })
    }

    /// The patch's jet by the piece's parameters.
    fn jet(&self, at: [f64; 2]) -> Jet {
        let Jet { point, s, t, ss, st, tt } = self.patch.jet(self.on_patch(at).map(|x| x.clamp(0.0, 1.0)));
        let [[h, _], [k, _]] = [self.place(0), self.place(1)];
        Jet { point, s: h * s, t: k * t, ss: h * h * ss, st: h * k * st, tt: k * k * tt }
    }

    /// Of first and second derivatives directly, of third ones by the mean
    /// value theorem.
    fn check(&self, bounds: &DerivativeBounds, low: [f64; 2], high: [f64; 2]) {
        let degree = *self.piece.degree.iter().max().unwrap() as f64;
        let check = |what: &str, found: f64, bound: f64, order: i32| {
            let lost = TOLERANCE * self.diagonal * degree.powi(order);
            let name = self.name;
            assert!(found <= bound + lost, "{name}: {what} {found} over {bound} in {low:?} to {high:?}");
        };
        let at = |i: usize, j: usize| {
            [i, j]
                .iter()
                .enumerate()
                .map(|(axis, &k)| low[axis] + 0.5 * k as f64 * (high[axis] - low[axis]))
                .collect::<Vec<_>>()
        };
        let jets: Vec<Vec<Jet>> =
            (0..3).map(|i| (0..3).map(|j| self.jet([at(i, j)[0], at(i, j)[1]])).collect()).collect();
        for jet in jets.iter().flatten() {
            for (derivative, bound) in [jet.s, jet.t].into_iter().zip(bounds.first) {
                check("first", derivative.length(), bound, 1);
            }
            for (derivative, bound) in [jet.ss, jet.st, jet.tt].into_iter().zip(bounds.second) {
                check("second", derivative.length(), bound, 2);
            }
        }
        let [h, k] = [0, 1].map(|axis| 0.5 * (high[axis] - low[axis]));
        for (i, row) in jets.iter().enumerate() {
            for j in 0..2 {
                let [a, b] = [&jets[j][i], &jets[j + 1][i]];
                let [c, d] = [&row[j], &row[j + 1]];
                check("sss", (b.ss - a.ss).length(), bounds.third[0] * h, 2);
                check("sst", (b.st - a.st).length(), bounds.third[1] * h, 2);
                check("stt", (b.tt - a.tt).length(), bounds.third[2] * h, 2);
                check("sst", (d.ss - c.ss).length(), bounds.third[1] * k, 2);
                check("stt", (d.st - c.st).length(), bounds.third[2] * k, 2);
                check("ttt", (d.tt - c.tt).length(), bounds.third[3] * k, 2);
            }
        }
    }
}

#[test]
fn bounds_over_parts_hold() {
    let random = &mut fastrand::Rng::with_seed(5);
    for_each_piece("bounds_over_parts_hold", |piece| {
        let bounds = LocalDerivativeBounds::new(piece.extension);
        for _ in 0..BOXES {
            // Of all sizes, often at an edge, where there may be a pole.
            let [s, t] = piece.extension.intervals().map(|[low, high]| {
                let width = 0.5_f64.powi(random.i32(1..15)).min(high - low);
                let start = match random.u8(0..4) {
                    0 => low,
                    1 => high - width,
                    _ => low + random.f64() * (high - low - width),
                };
                [start, (start + width).min(high)]
            });
            let (low, high) = ([s[0], t[0]], [s[1], t[1]]);
            piece.check(&bounds.over(&piece.piece, low, high), low, high);
            piece.check(bounds.about(&piece.piece, low, high), low, high);
        }
    });
}

/// Next to a pole the derivatives along it are small, and the bounds follow.
#[test]
fn bounds_shrink_towards_a_pole() {
    let patches = extract(&shape("sphere").unwrap()).patches;
    let patch = patches.patch(0);
    let bounds = LocalDerivativeBounds::new(ParamBox::UNIT);
    let columns = patch.degree[1] + 1;
    let points: Vec<_> = patch.local_points().collect();
    // Which axis runs along the pole, and at which end it is.
    let edges = [(0, 0, 1), (0, points.len() - columns, 1), (1, 0, columns), (1, columns - 1, columns)];
    let (across, first, _) = edges
        .into_iter()
        .find(|&(_, first, step)| points[first].distance(points[first + step]) < 1e-12)
        .unwrap();
    let near = |width: f64| {
        let (mut low, mut high) = ([0.4; 2], [0.5; 2]);
        [low[across], high[across]] = if first == 0 { [0.0, width] } else { [1.0 - width, 1.0] };
        bounds.over(&patch, low, high)
    };
    let (far, close) = (near(0.25), near(0.25 / 256.0));
    let along = |bounds: &DerivativeBounds| {
        if across == 0 {
            [bounds.first[1], bounds.second[2], bounds.third[3]]
        } else {
            [bounds.first[0], bounds.second[0], bounds.third[0]]
        }
    };
    for (far, close) in along(&far).into_iter().zip(along(&close)) {
        assert!(close < far / 128.0, "{close} {far}");
    }
}

#[test]
fn controls_followed_beyond_a_cut_tell_the_patch() {
    let mut followed = 0;
    for_each_piece("controls_followed_beyond_a_cut_tell_the_patch", |piece| {
        for axis in 0..2 {
            for (start, end) in [(piece.extension[axis][0], 0.0), (1.0, piece.extension[axis][1])] {
                if start == end {
                    continue;
                }
                followed += 1;
                let mut ring = [[0.0, 1.0]; 2];
                ring[axis] = [start, end];
                let controls = piece.piece.restricted(ring[0], ring[1]);
                let beyond = Patch { controls: &controls, ..piece.piece };
                for at in [[0.0, 0.0], [0.3, 0.7], [1.0, 0.2], [0.5, 1.0], [1.0, 1.0]] {
                    let inside = [0, 1].map(|k| ring[k][0] + at[k] * (ring[k][1] - ring[k][0]));
                    let on_patch = piece.on_patch(inside);
                    assert!(on_patch.iter().all(|x| (-1e-12..=1.0 + 1e-12).contains(x)), "{}", piece.name);
                    let expected = piece.patch.point(on_patch);
                    let error = (beyond.point(at) - expected).length() / piece.diagonal;
                    assert!(error <= TOLERANCE, "{}: off by {error:e}", piece.name);
                }
            }
        }
    });
    assert!(followed > 100, "{followed}");
}
