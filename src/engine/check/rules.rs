//! Rules on pairs of bodies: contacts and clashes that are meant, and what must be.

use super::pattern::Pattern;
use super::{BodyPair, CheckedBody, PairState};
use crate::engine::options::at_least_zero;
use crate::error::{Error, Result};
use crate::interval::Interval;
use crate::rounding::upper_max;
use serde::{Deserialize, Serialize};

/// Rules by patterns of names; names in camelCase when deserialized. In a pattern, `*` is any text within one level,
/// `?` any character, and a level `**` any number of levels: `pump/*`, `**/bolt *`.
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "camelCase")]
pub struct CheckRules {
    /// Pairs whose clashes are meant, such as those of a thread or a press fit; they are listed and not judged.
    pub intended: Vec<NamesOfPair>,
    /// Each body whose name matches `a` must touch or clash with a body whose name matches `b`.
    pub must_touch: Vec<NamesOfPair>,
    /// Pairs that must be apart by a distance.
    pub at_least: Vec<RequiredDistance>,
}

/// Patterns of the two names of a pair, in either order.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NamesOfPair {
    /// The pattern of the one name.
    pub a: String,
    /// That of the other.
    pub b: String,
}

/// A distance that bodies must have at least.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RequiredDistance {
    /// The pattern of the one name.
    pub a: String,
    /// That of the other.
    pub b: String,
    /// The distance, in model units, 0 or more.
    pub distance: f64,
}

/// The kind of a rule.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub enum Rule {
    /// One of [`CheckRules::must_touch`].
    MustTouch,
    /// One of [`CheckRules::at_least`].
    AtLeast,
}

/// A rule that is not certainly kept.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct UnkeptRule {
    /// Its kind.
    pub rule: Rule,
    /// Whether it is certainly broken; else it is undecided.
    pub broken: bool,
    /// The body that it is about.
    pub a: String,
    /// The other body; of [`Rule::MustTouch`], the pattern of those that it may touch.
    pub b: String,
    /// The distance required.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub distance: Option<f64>,
    /// The least distance of both is in it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub clearance: Option<Interval>,
}

/// The rules as indices of bodies.
pub(super) struct Bound {
    intended: Vec<[Vec<bool>; 2]>,
    must_touch: Vec<([Vec<bool>; 2], String)>,
    at_least: Vec<([Vec<bool>; 2], f64)>,
}

/// Whether one body is of the one pattern and the other body of the other.
fn is_of([a, b]: &[Vec<bool>; 2], [i, j]: [usize; 2]) -> bool {
    (a[i] && b[j]) || (a[j] && b[i])
}

impl CheckRules {
    /// Finds the bodies of all patterns. O(patterns bodies).
    ///
    /// # Errors
    /// [`Error::OptionInvalid`] for a pattern of no body, or two of one, which would let everything pass;
    /// [`Error::OptionOutOfRange`] for a distance.
    pub(super) fn bound(&self, bodies: &[CheckedBody]) -> Result<Bound> {
        let of = |text: &str| {
            let pattern = Pattern::new(text)?;
            let found: Vec<bool> = bodies.iter().map(|body| pattern.is_of(&body.name)).collect();
            if found.contains(&true) {
                return Ok(found);
            }
            Err(Error::OptionInvalid { found: format!("the rules name {text}, which is no body") })
        };
        let both = |a: &str, b: &str| {
            let found = [of(a)?, of(b)?];
            let is_one = found[0] == found[1] && found[0].iter().filter(|is_of| **is_of).count() == 1;
            match is_one {
                true => Err(Error::OptionInvalid {
                    found: format!("the rules name {a} and {b}, which are one body"),
                }),
                false => Ok(found),
            }
        };
        let distance = |rule: &RequiredDistance| {
            at_least_zero("distance", rule.distance)?;
            Ok((both(&rule.a, &rule.b)?, rule.distance))
        };
        Ok(Bound {
            intended: self.intended.iter().map(|pair| both(&pair.a, &pair.b)).collect::<Result<_>>()?,
            must_touch: self
                .must_touch
                .iter()
                .map(|pair| Ok((both(&pair.a, &pair.b)?, pair.b.clone())))
                .collect::<Result<_>>()?,
            at_least: self.at_least.iter().map(distance).collect::<Result<_>>()?,
        })
    }
}

impl Bound {
    /// Returns whether what happens between two bodies is meant.
    pub(super) fn is_intended(&self, pair: [usize; 2]) -> bool {
        self.intended.iter().any(|names| is_of(names, pair))
    }

    /// Returns the largest distance that two bodies must have, 0 without any.
    pub(super) fn required(&self, pair: [usize; 2]) -> f64 {
        let required = self.at_least.iter().filter(|(names, _)| is_of(names, pair)).map(|&(_, least)| least);
        required.fold(0.0, upper_max)
    }

    /// Returns the largest distance that any two bodies must have.
    pub(super) fn largest(&self) -> f64 {
        self.at_least.iter().map(|&(_, least)| least).fold(0.0, upper_max)
    }

    /// Returns the rules that are not certainly kept. The bodies of a pair that is not in `judged` are farther apart
    /// than the tolerance, and at least as far apart as the rules require.
    pub(super) fn unkept(
        &self,
        bodies: &[CheckedBody],
        judged: &[([usize; 2], BodyPair)],
    ) -> Vec<UnkeptRule> {
        let apart = judged.iter().filter_map(|(of, pair)| {
            let required = self.required(*of);
            let keeps =
                required == 0.0 || (pair.state != PairState::Clash && pair.clearance.lower >= required);
            let is_known = pair.state != PairState::Undecided;
            if keeps && (is_known || required == 0.0) {
                return None;
            }
            Some(UnkeptRule {
                rule: Rule::AtLeast,
                broken: pair.clearance.upper < required,
                a: pair.a.clone(),
                b: pair.b.clone(),
                distance: Some(required),
                clearance: Some(pair.clearance),
            })
        });
        let touching = self.must_touch.iter().flat_map(|(names, pattern)| {
            let is_open = |&body: &usize| names[0][body];
            (0..bodies.len()).filter(is_open).filter_map(move |body| {
                let broken = is_untouched(body, &names[1], judged)?;
                let a = bodies[body].name.clone();
                let b = pattern.clone();
                Some(UnkeptRule { rule: Rule::MustTouch, broken, a, b, distance: None, clearance: None })
            })
        });
        apart.chain(touching).collect()
    }
}

/// Returns `None` of a body that touches one of others, else whether it certainly touches none.
fn is_untouched(body: usize, others: &[bool], judged: &[([usize; 2], BodyPair)]) -> Option<bool> {
    let mut is_certain = true;
    for ([i, j], pair) in judged {
        let of_rule = (*i == body && others[*j]) || (*j == body && others[*i]);
        match pair.state {
            PairState::Touching | PairState::Clash if of_rule => return None,
            // Between the tolerance and what the search resolves.
            PairState::Undecided if of_rule => is_certain = false,
            _ => {}
        }
    }
    Some(is_certain)
}
