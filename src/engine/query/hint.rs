//! What the units of two models may have to do with their result.

use super::PreparedModel;

/// The ratios of sizes that units make of each other, with the larger and the smaller one.
const RATIOS: [(f64, &str, &str); 6] = [
    (25.4, "inches", "millimetres"),
    (1000.0, "metres", "millimetres"),
    (1000.0 / 25.4, "metres", "inches"),
    (10.0, "centimetres", "millimetres"),
    (100.0, "metres", "centimetres"),
    (304.8, "feet", "millimetres"),
];

/// The difference of extents up to which they agree, relative to the largest one.
const RELATIVE_REACH: f64 = 1e-3;

/// The difference of the boxes of control points up to which the extents of the faces are compared, relative to them:
/// those of a part cut or fitted in another way.
const RELATIVE_BOXES: f64 = 0.5;

/// Units that models state, in metres, with their names.
const NAMES: [(f64, &str); 6] = [
    (1e-3, "millimetres"),
    (1e-2, "centimetres"),
    (1.0, "metres"),
    (0.0254, "inches"),
    (0.3048, "feet"),
    (1e-6, "micrometres"),
];

/// Returns one line on what may be wrong with the units of two models: that one states none, and that the extents agree
/// after a factor that two units have. Nothing is scaled for it.
pub(super) fn hint(a: &PreparedModel, b: &PreparedModel) -> Option<String> {
    let unstated = match (a.unit(), b.unit()) {
        (Some(unit), None) => {
            Some(format!("A is in {}, and B states no unit: it is taken in A's", name(unit)))
        }
        (None, Some(unit)) => {
            Some(format!("B is in {}, and A states no unit: it is taken in B's", name(unit)))
        }
        _ => None,
    };
    let factor = factor(a, b);
    let lines: Vec<String> = unstated.into_iter().chain(factor).collect();
    (!lines.is_empty()).then(|| lines.join("; "))
}

/// Returns the name of a unit, or its metres.
fn name(metres: f64) -> String {
    let named = NAMES.iter().find(|(unit, _)| *unit == metres);
    named.map_or_else(|| format!("units of {metres:?} m"), |(_, name)| (*name).to_owned())
}

/// Returns which ratio of units the extents of B have to those of A, if they have one.
fn factor(a: &PreparedModel, b: &PreparedModel) -> Option<String> {
    // Of models that both state their unit the sizes are compared, of others the numbers.
    let scale = a.unit().zip(b.unit()).map_or(1.0, |(a, b)| b / a);
    let boxes = [a, b].map(|model| sorted(model.bounding_box().extent().to_array()));
    // The extents of faces take a search, which few pairs need.
    ratio(boxes[0], boxes[1].map(|extent| scale * extent), RELATIVE_BOXES)?;
    let extents = [a, b].map(|model| sorted(model.lengths()));
    let (ratio, larger, smaller) =
        ratio(extents[0], extents[1].map(|extent| scale * extent), RELATIVE_REACH)?;
    let ([of_larger, of_smaller], factor) =
        if ratio > 1.0 { (["A", "B"], ratio) } else { (["B", "A"], 1.0 / ratio) };
    Some(format!(
        "the extents of {of_smaller} are {factor:.4} times those of {of_larger}, as if {of_larger} was in {larger} and {of_smaller} in {smaller}"
    ))
}

/// Returns the ratio of units that the second extents have to the first ones, or they to these: below 1.
fn ratio(a: [f64; 3], b: [f64; 3], reach: f64) -> Option<(f64, &'static str, &'static str)> {
    let agree = |factor: f64| {
        let size = b[2];
        size > 0.0 && a.iter().zip(b).all(|(a, b)| (factor * a - b).abs() <= reach * size)
    };
    let nearest = RATIOS
        .iter()
        .flat_map(|&(factor, larger, smaller)| [(factor, larger, smaller), (1.0 / factor, larger, smaller)]);
    let of_sizes = b[2] / a[2];
    let off = |factor: f64| (factor / of_sizes).ln().abs();
    nearest.filter(|&(factor, ..)| agree(factor)).min_by(|one, other| off(one.0).total_cmp(&off(other.0)))
}

fn sorted(mut extents: [f64; 3]) -> [f64; 3] {
    extents.sort_by(f64::total_cmp);
    extents
}
