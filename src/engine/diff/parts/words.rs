//! What became of the parts of assemblies, in words.

use super::{PartDifference, PartMotion, PartState};
use crate::engine::DiffResult;
use crate::model::face_path;
use crate::one_line::one_line;

/// The angle in degrees, and the part of a length, up to which nothing is said of a turn and of a direction.
const NO_TURN: f64 = 1e-6;

/// The last place behind the point at which the first digit of a length that is not 0 is shown: far below what files hold.
const MAX_FIRST_DECIMAL: f64 = 12.0;

/// The largest number of groups of parts in a summary, and of lines.
const MAX_GROUPS: usize = 12;
const MAX_LINES: usize = 100;

impl DiffResult {
    /// Returns `3 of 41 parts changed: bracket (2 faces, at most 0.350 mm), bolt ×4 moved by 5.000 mm along z, cover
    /// added`; `None` of two models of one part.
    #[must_use]
    pub fn parts_summary(&self) -> Option<String> {
        let parts = &self.parts;
        if parts.len() < 2 {
            return None;
        }
        let changed: Vec<&PartDifference> =
            parts.iter().filter(|part| part.state != PartState::Same).collect();
        if changed.is_empty() {
            return Some(format!("all {} parts are the same", parts.len()));
        }
        let mut groups: Vec<(&PartDifference, String, usize)> = Vec::new();
        for part in &changed {
            let what = what(part, self.unit);
            let is_alike = |other: &PartDifference| name_of_copies(other) == name_of_copies(part);
            match groups.iter_mut().find(|(other, of, _)| is_alike(other) && *of == what) {
                Some((_, _, count)) => *count += 1,
                None => groups.push((part, what, 1)),
            }
        }
        let text = |(part, what, count): &(&PartDifference, String, usize)| match count {
            1 => format!("{} {what}", one_line(&short_name(part))),
            _ => format!("{} ×{count} {what}", one_line(&name_of_copies(part))),
        };
        let mut texts: Vec<String> = groups.iter().take(MAX_GROUPS).map(text).collect();
        if groups.len() > MAX_GROUPS {
            texts.push(format!("and {} more", groups.len() - MAX_GROUPS));
        }
        let verb = if changed.iter().all(|part| part.state == PartState::Undecided) {
            "undecided"
        } else {
            "changed"
        };
        Some(format!("{} of {} parts {verb}: {}", changed.len(), parts.len(), texts.join(", ")))
    }

    /// Returns a line for each part that is not the same, of assemblies.
    #[must_use]
    pub fn part_lines(&self) -> Vec<String> {
        if self.parts.len() < 2 {
            return Vec::new();
        }
        let changed = self.parts.iter().filter(|part| part.state != PartState::Same);
        let line =
            |part: &PartDifference| one_line(&format!("{}: {}", full_name(part), what(part, self.unit)));
        let mut lines: Vec<String> = changed.map(line).collect();
        if lines.len() > MAX_LINES {
            let more = lines.len() - MAX_LINES;
            lines.truncate(MAX_LINES);
            lines.push(format!("and {more} more"));
        }
        lines
    }
}

fn full_name(part: &PartDifference) -> &str {
    part.name_of_a.as_deref().or(part.name_of_b.as_deref()).unwrap_or_default()
}

/// The last level of the name, without the name of the use in parentheses.
fn short_name(part: &PartDifference) -> String {
    let last = face_path(full_name(part)).pop().unwrap_or_default();
    let product = last.strip_suffix(')').and_then(|level| level.rsplit_once(" ("));
    product.map_or_else(|| last.to_string(), |(name, _)| name.to_owned())
}

/// The same without the number of a copy. A part that is alone keeps the number, which may distinguish M6 from M8.
fn name_of_copies(part: &PartDifference) -> String {
    let name = short_name(part);
    let base = name.trim_end_matches(|one: char| one.is_ascii_digit() || "():-_#. ".contains(one));
    if base.is_empty() { name } else { base.to_owned() }
}

/// What became of a part, after its name.
fn what(part: &PartDifference, unit: Option<f64>) -> String {
    let unit = unit_name(unit);
    let moved = || part.motion.as_ref().map_or("moved".to_owned(), |motion| moved(motion, unit));
    let changed = || {
        let count = part.faces.of_a.len().max(part.faces.of_b.len());
        let faces = if count == 1 { "face" } else { "faces" };
        format!("({count} {faces}, at most {}{unit})", rounded_up(part.upper.unwrap_or_default()))
    };
    match part.state {
        PartState::Same => "is the same".to_owned(),
        PartState::Renamed => format!("renamed {}", one_line(part.name_of_b.as_deref().unwrap_or_default())),
        PartState::Moved => moved(),
        PartState::Mirrored => "mirrored".to_owned(),
        PartState::Changed => changed(),
        PartState::MovedAndChanged => format!("{} {}", moved(), changed()),
        PartState::Added => "added".to_owned(),
        PartState::Removed => "removed".to_owned(),
        _ => "undecided".to_owned(),
    }
}

fn moved(motion: &PartMotion, unit: &str) -> String {
    let length = motion.shift.iter().map(|x| x * x).sum::<f64>().sqrt();
    let way = format!("moved by {length:.*}{unit} along {}", decimals(length), direction(motion.shift));
    if motion.angle <= NO_TURN {
        return way;
    }
    let turn = format!("turned by {:.3}° about {}", motion.angle, direction(motion.axis));
    if length < 5e-4 { turn } else { format!("{turn} and {way}") }
}

/// The name of an axis, or three digits of each coordinate.
fn direction(of: [f64; 3]) -> String {
    let length = of.iter().map(|x| x * x).sum::<f64>().sqrt();
    let unit = of.map(|x| x / length);
    for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
        if 1.0 - unit[axis].abs() <= NO_TURN * NO_TURN {
            return format!("{}{name}", if unit[axis] < 0.0 { "-" } else { "" });
        }
    }
    let [x, y, z] = unit.map(|x| format!("{:.3}", if x.abs() < 5e-4 { 0.0 } else { x }));
    format!("{x} {y} {z}")
}

/// The digits behind the point of a length: three, and more of a shorter one than 1, so that it has three that are not 0.
fn decimals(length: f64) -> usize {
    let of_first = if length > 0.0 { -length.log10().floor() } else { 0.0 };
    (of_first.clamp(1.0, MAX_FIRST_DECIMAL) as usize) + 2
}

/// A length with these digits, not below it.
fn rounded_up(length: f64) -> String {
    let digits = decimals(length);
    let scale = 10_f64.powi(digits as i32);
    format!("{:.digits$}", (length * scale).ceil() / scale)
}

fn unit_name(metres: Option<f64>) -> &'static str {
    let named = [(1e-3, " mm"), (1e-2, " cm"), (1.0, " m"), (0.0254, " in"), (0.3048, " ft"), (1e-6, " µm")];
    let is_it = |own: f64| metres.is_some_and(|metres| (metres - own).abs() <= 1e-9 * own);
    named.into_iter().find(|&(own, _)| is_it(own)).map_or("", |(_, name)| name)
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    #[test]
    fn lengths_have_three_digits_and_are_never_shown_as_less() {
        let expected = [
            (123.456_78, "123.457"),
            (0.1, "0.100"),
            (0.350_000_1, "0.351"),
            (0.000_1, "0.000100"),
            (1.234_5e-6, "0.00000124"),
            (0.0, "0.000"),
        ];
        for (length, shown) in expected {
            assert_eq!(rounded_up(length), shown);
        }
    }

    #[test]
    fn a_short_motion_is_not_shown_as_none() {
        let motion = PartMotion {
            translation: [1e-4, 0.0, 0.0],
            shift: [1e-4, 0.0, 0.0],
            axis: [0.0, 0.0, 1.0],
            angle: 0.0,
        };
        assert_eq!(moved(&motion, " mm"), "moved by 0.000100 mm along x");
    }
}
