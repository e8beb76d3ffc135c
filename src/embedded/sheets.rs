//! The surfaces that the pieces of trimmed faces lie on, beyond their ends.

mod plane;

pub(super) use self::plane::Plane;

use super::audit::{Grid, Ways};
use super::complex::pinch_of;
use super::directions::{Direction, Net, common_side};
use super::piece::{Piece, Side};
use crate::axis::Axis;
use crate::bezier::{BezierModel, Patch, PatchSet};
use crate::certified::OnSheet;
use crate::param_box::ParamBox;
use crate::rounding::{lower_min, upper_max};
use glam::DVec3;
use std::borrow::Cow;
use std::cell::{Cell, OnceCell, RefCell};
use std::collections::HashMap;
use std::rc::Rc;

/// The part of a patch's parameters by which a rectangle of it is enlarged, because parameters are rounded.
const PART_ROUNDING: f64 = 1e-9;

/// The largest number of rectangles whose directions are kept, some megabytes: a body of 20 faces has about 250.
const MAX_KNOWN: usize = 4096;

/// The surfaces of trimmed faces.
pub(crate) struct Sheets<'a> {
    /// Their patches.
    pub(crate) model: &'a BezierModel,
    /// The surface of each surface of the body, if that is a piece of a trimmed face, and the way to its parameters.
    pub(crate) of_pieces: Vec<OnSheet<'a>>,
    /// The distance of points of pieces from those of the surfaces, at most.
    pub(crate) off: f64,
}

/// The directions of a surface over a rectangle of its parameters.
#[derive(Debug, Default)]
pub(super) struct SheetDirections {
    along: [Vec<Direction>; 2],
    /// The margin of both together, computed at first use.
    margin: OnceCell<Option<f64>>,
    /// An upper bound on what has no direction along both parameters together.
    rest: f64,
}

/// A surface, and the bits of a rectangle of its parameters.
type Rectangle = (usize, [u64; 4]);

/// What the search asks of surfaces.
pub(super) struct SheetSearch<'a> {
    sheets: &'a Sheets<'a>,
    patches: &'a PatchSet,
    /// Of each surface, over all pieces of its face.
    whole: Vec<OnceCell<Option<Together>>>,
    boxes: Vec<Option<ParamBox>>,
    planes: Vec<OnceCell<Option<Plane>>>,
    /// For each patch of a surface, whether its last side along either axis is a point.
    pinched: Vec<OnceCell<Vec<[bool; 2]>>>,
    /// What [`Self::directions`] has returned: pieces have several neighbours beside one rectangle.
    known: RefCell<HashMap<Rectangle, Option<Rc<SheetDirections>>>>,
}

/// What is stated of the points of a surface over a rectangle.
#[derive(Debug, Clone)]
pub(super) struct Together {
    pub(super) ways: Ways,
    /// Points of it.
    grid: Grid,
    /// Whether these are known not to contradict the bound.
    is_audited: Cell<bool>,
}

impl Together {
    /// Returns whether points do not contradict a bound, the same each time. What is stated of a whole surface is compared once, and not for
    /// every two pieces of it.
    pub(super) fn holds(&self, ways: Ways, slack: f64) -> bool {
        self.is_audited.get() || {
            let holds = ways.hold_on(&self.grid, slack);
            self.is_audited.set(holds);
            holds
        }
    }
}

impl<'a> SheetSearch<'a> {
    pub(super) fn new(sheets: &'a Sheets<'a>, patches: &'a PatchSet) -> Self {
        let count = sheets.model.grids.len();
        let mut found = Self {
            sheets,
            patches,
            whole: vec![OnceCell::new(); count],
            boxes: vec![None; count],
            planes: vec![OnceCell::new(); count],
            pinched: vec![OnceCell::new(); count],
            known: RefCell::default(),
        };
        for patch in 0..patches.len() as u32 {
            if let Some((sheet, image)) = found.sheet(patch).zip(found.image(patch, &ParamBox::UNIT)) {
                let known = &mut found.boxes[sheet];
                *known = Some(known.map_or(image, |known| known.union(&image)));
            }
        }
        found
    }

    /// Returns the surface of a patch, if it is of a trimmed face.
    pub(super) fn sheet(&self, patch: u32) -> Option<usize> {
        let surface = self.patches.patch(patch as usize).surface;
        self.sheets.of_pieces.get(surface)?.map(|(sheet, _)| sheet)
    }

    /// Returns how far points are from the surface.
    pub(super) fn off(&self) -> f64 {
        self.sheets.off
    }

    /// Returns the patches of a surface, by their rows.
    fn patches_of(&self, sheet: usize) -> impl Iterator<Item = Patch<'_>> {
        let grid = &self.sheets.model.grids[sheet];
        let count: usize = grid.counts().iter().product();
        (grid.first..grid.first + count).map(|index| self.sheets.model.patches.patch(index))
    }

    /// Returns the plane of a surface, if it is plane.
    pub(super) fn plane(&self, sheet: usize) -> Option<Plane> {
        *self.planes[sheet].get_or_init(|| {
            let points: Vec<DVec3> = self
                .patches_of(sheet)
                .flat_map(|patch| patch.local_points().map(|point| patch.center + point).collect::<Vec<_>>())
                .collect();
            Plane::of(&points)
        })
    }

    /// Returns a rectangle of the surface's parameters that contains those of a part of a patch.
    pub(super) fn image(&self, patch: u32, range: &ParamBox) -> Option<ParamBox> {
        let of_patch = self.patches.patch(patch as usize);
        let (_, map) = (*self.sheets.of_pieces.get(of_patch.surface)?)?;
        let [low, high] = [range.low(), range.high()].map(|at| of_patch.domain.at(at));
        Some(map.image(&ParamBox::new([low[0], high[0]], [low[1], high[1]])))
    }

    /// As [`Self::image`], of a part of a side.
    pub(super) fn image_of_side(&self, patch: u32, side: Side, part: [f64; 2]) -> Option<ParamBox> {
        let end = [side.end as f64; 2];
        let range = if side.axis == Axis::U { ParamBox::new(end, part) } else { ParamBox::new(part, end) };
        self.image(patch, &range)
    }

    /// Returns the bound of lemma S8 (a) for two pieces of one surface together, over all of its face or over the rectangle
    /// of both, with points of the surface there.
    pub(super) fn together(&self, sheet: usize, pieces: [&Piece; 2]) -> Option<Cow<'_, Together>> {
        let over = |range: &ParamBox| {
            let ways = self.directions(sheet, range)?.alone()?;
            Some(Together { ways, grid: self.grid(sheet, range), is_audited: Cell::new(false) })
        };
        let whole = self.whole[sheet].get_or_init(|| over(self.boxes[sheet].as_ref()?));
        if let Some(whole) = whole {
            return Some(Cow::Borrowed(whole));
        }
        let [a, b] = pieces.map(|piece| self.image(piece.patch, &piece.range));
        over(&a?.union(&b?)).map(Cow::Owned)
    }

    /// Returns the points of a surface at the ends and the middles of a rectangle.
    fn grid(&self, sheet: usize, range: &ParamBox) -> Grid {
        let grid = &self.sheets.model.grids[sheet];
        let columns = grid.counts()[1];
        let shares = [0.0, 0.5, 1.0];
        shares.map(|u| {
            shares.map(|v| {
                let at = range.at([u, v]);
                let [(row, s), (column, t)] = Axis::BOTH.map(|axis| grid.locate(axis, at[axis.index()]));
                self.sheets.model.patches.patch(grid.first + row * columns + column).point([s, t])
            })
        })
    }

    /// Returns, for each patch of a surface, whether its last side along either axis is a point.
    fn pinched(&self, sheet: usize) -> &[[bool; 2]] {
        self.pinched[sheet].get_or_init(|| {
            let is_point = |patch: Patch<'_>| Axis::BOTH.map(|axis| pinch_of(&patch, axis).is_some());
            self.patches_of(sheet).map(is_point).collect()
        })
    }

    /// Returns the directions of a surface over a rectangle, computed at first use.
    pub(super) fn directions(&self, sheet: usize, range: &ParamBox) -> Option<Rc<SheetDirections>> {
        let [[a, b], [c, d]] = [range[0], range[1]];
        let key = (sheet, [a, b, c, d].map(f64::to_bits));
        if let Some(known) = self.known.borrow().get(&key) {
            return known.clone();
        }
        let found = self.found_directions(sheet, range).map(Rc::new);
        let mut known = self.known.borrow_mut();
        if known.len() >= MAX_KNOWN {
            known.clear();
        }
        known.insert(key, found.clone());
        found
    }

    /// Returns [`Self::directions`] of a rectangle that was not asked for.
    fn found_directions(&self, sheet: usize, range: &ParamBox) -> Option<SheetDirections> {
        let grid = &self.sheets.model.grids[sheet];
        let spans = Axis::BOTH.map(|axis| {
            let (breaks, [low, high]) = (&grid.breaks[axis], range[axis]);
            let first = breaks.partition_point(|&knot| knot < low).clamp(1, breaks.len() - 1) - 1;
            let last = breaks.partition_point(|&knot| knot <= high).clamp(first + 1, breaks.len() - 1);
            first..last
        });
        let degree = self.sheets.model.patches.patch(grid.first).degree;
        let is_torn = Axis::BOTH.iter().any(|&axis| {
            let inner = spans[axis].start + 1..spans[axis].end;
            grid.multiplicities[axis][inner].iter().any(|&count| usize::from(count) > degree[axis])
        });
        if is_torn {
            return None;
        }
        let columns = grid.counts()[1];
        let mut found = SheetDirections::default();
        // A way along a parameter has the rests of all its spans.
        let mut rests = [0, 1].map(|axis: usize| vec![0.0; spans[axis].len()]);
        for row in spans[0].clone() {
            for column in spans[1].clone() {
                let patch = self.sheets.model.patches.patch(grid.first + row * columns + column);
                let pinched = self.pinched(sheet)[row * columns + column];
                let has_inner_end = [0, 1].map(|axis: usize| [row, column][axis] + 1 < spans[axis].end);
                if (0..2).any(|axis| has_inner_end[axis] && pinched[axis]) {
                    return None;
                }
                let part = [(Axis::U, row), (Axis::V, column)].map(|(axis, span)| {
                    let [from, to] = [grid.breaks[axis][span], grid.breaks[axis][span + 1]];
                    let local = |at: f64| (at - from) / (to - from);
                    let [low, high] = range[axis].map(local);
                    // The part has positive length, also at an end of the patch.
                    let low = (low - PART_ROUNDING).clamp(0.0, 1.0 - PART_ROUNDING);
                    [low, (high + PART_ROUNDING).clamp(low + PART_ROUNDING, 1.0)]
                });
                let controls = patch.restricted(part[0], part[1]);
                let radius = patch.local_points().map(DVec3::length).fold(0.0, upper_max);
                let net = Net { controls: &controls, degree: patch.degree, rational: patch.rational, radius };
                for axis in Axis::BOTH {
                    let along = net.along(axis);
                    let span = [row, column][axis.index()] - spans[axis.index()].start;
                    let rest = &mut rests[axis.index()][span];
                    *rest = upper_max(*rest, along.rest);
                    found.along[axis.index()].extend(along.list);
                }
            }
        }
        found.rest = rests.iter().flatten().sum();
        Some(found)
    }
}

impl SheetDirections {
    /// Returns the bound of lemma S8 (a).
    fn alone(&self) -> Option<Ways> {
        Some(Ways { margin: self.margin()?, rest: 2.0 * self.rest })
    }

    /// Returns the least margin of the directions along both parameters as they are, and with one of both turned round.
    fn margin(&self) -> Option<f64> {
        *self.margin.get_or_init(|| self.signed(&[[1.0, 1.0], [1.0, -1.0]], &[]))
    }

    /// Returns the bound of lemma S8 (d) for directions that leave the surface.
    pub(super) fn leaving(&self, directions: &[Direction]) -> Option<Ways> {
        // What is on one side with others is so without them, and is asked for with many others.
        self.margin()?;
        let back: Vec<Direction> = directions.iter().map(|direction| direction.back()).collect();
        let signs = [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]];
        Some(Ways { margin: self.signed(&signs, &back)?, rest: 2.0 * self.rest })
    }

    /// Returns the least margin of the directions along both parameters with each of these signs and of others.
    fn signed(&self, signs: &[[f64; 2]], others: &[Direction]) -> Option<f64> {
        if self.along.iter().any(Vec::is_empty) {
            return None;
        }
        let mut least = f64::INFINITY;
        let mut all = others.to_vec();
        for sign in signs {
            all.truncate(others.len());
            for (along, sign) in self.along.iter().zip(sign) {
                all.extend(
                    along.iter().map(|&Direction { unit, error }| Direction { unit: *sign * unit, error }),
                );
            }
            let (_, margin) = common_side(&all)?;
            least = lower_min(least, margin);
        }
        Some(least)
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::bezier::extract;
    use crate::model::{Model, SurfaceArrays};
    use crate::shapes;

    fn exact(vectors: &[DVec3]) -> Vec<Direction> {
        vectors.iter().map(|vector| Direction { unit: vector.normalize(), error: 0.0 }).collect()
    }

    fn sheets_of(model: &BezierModel) -> Sheets<'_> {
        Sheets { model, of_pieces: Vec::new(), off: 0.0 }
    }

    /// A plane quadrilateral that lies on itself along a fold, with one parameter reversed and as it is: one of both choices of
    /// signs has its directions on one side.
    #[test]
    fn a_surface_that_folds_over_has_no_bound() {
        let quad = |corners: [[f64; 2]; 4]| {
            let control_points = corners.map(|[x, y]| [x, y, 0.0, 1.0]).to_vec();
            let knots = [0, 1].map(|_| vec![0.0, 0.0, 1.0, 1.0]);
            let surface = SurfaceArrays { degree: [1, 1], knots, counts: [2, 2], control_points };
            extract(&Model::from_arrays(None, vec![surface]).unwrap())
        };
        let is_bound = |corners: [[f64; 2]; 4]| {
            let (model, patches) = (quad(corners), PatchSet::default());
            let sheets = sheets_of(&model);
            SheetSearch::new(&sheets, &patches).directions(0, &ParamBox::UNIT).unwrap().alone().is_some()
        };
        for reach in [0.2, 0.5] {
            let [a, b, c, d] = [[0.0, 0.0], [1.0, 0.3], [1.0, 0.0], [2.0, reach + 0.3]];
            assert_eq!(is_bound([a, b, c, d]), reach < 0.3, "{reach}");
            assert_eq!(is_bound([c, d, a, b]), reach < 0.3, "{reach}, reversed");
        }
    }

    /// Of a quarter of a cylinder, the tangents turn by a quarter: alone, they are on both sides of no plane. What leaves it
    /// outwards at one end is along the tangent at the other one, so that it leaves half of it only.
    #[test]
    fn directions_leave_a_cylinder_if_they_are_off_all_its_tangents() {
        let model = extract(&shapes::cylinder(2.0, 3.0).unwrap());
        let sheets = sheets_of(&model);
        let patches = PatchSet::default();
        let search = SheetSearch::new(&sheets, &patches);
        // The lateral surface is the one that is not plane.
        let sheet = (0..model.grids.len()).find(|&sheet| search.plane(sheet).is_none()).unwrap();
        let grid = &model.grids[sheet];
        let [us, vs] =
            [0, 1].map(|axis: usize| [grid.breaks[axis][0], grid.breaks[axis][grid.counts()[axis]]]);
        let part = |share: f64| {
            let range = ParamBox::new([us[0], us[0] + share * (us[1] - us[0])], vs);
            search.directions(sheet, &range).unwrap()
        };
        // One that is good enough is not made better.
        let is_margin = |found: f64, largest: f64| 0.1 <= found && found <= largest + 1e-5;
        // Two directions at a right angle to each other are at half of one to the plane between them.
        let alone = part(1e-6).alone().unwrap();
        assert!(is_margin(alone.margin, 0.5_f64.sqrt()) && alone.rest == 0.0, "{alone:?}");
        assert!(part(0.25).alone().is_some() && part(0.49).alone().is_some());
        assert!(part(0.5).alone().is_none() && part(1.0).alone().is_none());
        // Outwards where the surface begins.
        let out = exact(&[DVec3::X]);
        let leaving = part(1e-6).leaving(&out).unwrap();
        assert!(is_margin(leaving.margin, 3.0_f64.sqrt().recip()), "{leaving:?}");
        assert!(part(0.24).leaving(&out).is_some());
        assert!(part(0.25).leaving(&out).is_none());
        assert!(part(1e-3).leaving(&exact(&[DVec3::Y])).is_none());
    }
}
