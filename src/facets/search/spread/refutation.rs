//! The audit of bounds while the search runs, by points of a part and by a rule for their mean.

use super::Spread;
use super::parts::{Parts, WeightedPart, WeightedRegion};
use crate::facets::Facet;
use crate::facets::search::sampled;
use crate::facets::search::source::{Source, Start};
use glam::DVec3;

impl Parts<'_> {
    /// Looks at the corners of a part and `further` points of it: the distance of each, by the closest point, is in
    /// the range stated for all; and where `mean` is set, at the mean by a rule, whose error is estimated. Returns
    /// in words what refutes the bounds.
    pub(crate) fn refutation(&self, part: &WeightedPart, further: usize, mean: bool) -> Option<String> {
        let Spread { lower, upper, mean: stated, .. } = part.spread;
        let refuted = |what: &str, point: DVec3, stated: [f64; 2], found: [f64; 2]| {
            let is_apart = found[1] < stated[0] || stated[1] < found[0];
            is_apart.then(|| format!("{stated:?} at the {what} {point}, found {found:?}"))
        };
        let of_points = sampled::places(further).find_map(|weights| {
            let point = self.point_of(part, weights);
            refuted("point", point, [lower, upper], self.distance(point, part.start)?)
        });
        let of_mean = || {
            let [fine, coarse] = sampled::RULES.map(|count| self.mean_by_rule(part, count));
            let (fine, coarse) = (fine?, coarse?);
            let error = sampled::rule_error(fine, coarse, upper - lower) + self.rounding;
            refuted("mean about", self.point_of(part, [1.0 / 3.0; 3]), stated, [fine - error, fine + error])
        };
        of_points.or_else(|| if mean { of_mean() } else { None })
    }

    /// The point of a part at barycentric weights: of a cell of a patch that at the place of the same weights in one
    /// half of its rectangle.
    fn point_of(&self, part: &WeightedPart, weights: [f64; 3]) -> DVec3 {
        match (part.region, self.a) {
            (WeightedRegion::Cell(cell), Source::Patches { patches, .. }) => {
                let ([s0, t0], [s1, t1]) = (cell.range.low(), cell.range.high());
                let [_, along_s, along_t] = weights;
                let at = [s0 + along_s * (s1 - s0), t0 + along_t * (t1 - t0)];
                self.transform.apply(patches.patch(cell.patch as usize).point(at))
            }
            (WeightedRegion::Triangle(corners, ..), _) => Facet::Triangle(corners).point(weights),
            (WeightedRegion::Cell(_), _) => DVec3::NAN,
        }
    }

    /// Bounds on the distance of a point of A, moved, with what rounding may add.
    fn distance(&self, point: DVec3, start: u32) -> Option<[f64; 2]> {
        let start = Start { piece: start, ..Start::default() };
        let found = self.b.certified(point, start, 0.0, self.goal.length)?;
        Some([found.lower - self.rounding, found.upper + self.rounding])
    }

    /// The mean over the middles of equal parts of a triangle; `None` for a cell of a patch.
    fn mean_by_rule(&self, part: &WeightedPart, count: usize) -> Option<f64> {
        if matches!(part.region, WeightedRegion::Cell(_)) {
            return None;
        }
        let (mut sum, mut points) = (0.0, 0.0);
        for weights in sampled::middles(count) {
            let [lower, upper] = self.distance(self.point_of(part, weights), part.start)?;
            sum += 0.5 * (lower + upper);
            points += 1.0;
        }
        Some(sum / points)
    }
}
