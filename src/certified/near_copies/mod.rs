//! Bounds for near copies: models that were refitted, refined, split, degree-elevated or offset by little, whose
//! parameters correspond to those of B. A tolerance below their distance is out of reach of bounds by size
//! alone, as every cell lies near B. There are four ideas:
//!
//! 1. **The difference over knot lines** ([`difference`], 3.8 and 3.13 of `docs/method.md`): where parameters
//!    correspond along parameter lines, `A - B∘φ` has Bernstein coefficients on each piece between the knot
//!    lines of both, and the largest bounds it.
//! 2. **Blocks** ([`blocks`], 3.14): one map serves a rectangle of A's patches, which are decided together.
//! 3. **One spline** ([`spline`], 3.16): under an affine map the difference of a whole block is one B-spline
//!    over the union of both knot sequences.
//! 4. **Sliding feet** ([`sliding`], 3.15): feet move along B by the tangential part of the difference, which
//!    counts no longer.
//!
//! Surfaces of B are walked by the charts of [`super::sheets`]. Knots that do not change a surface are gone
//! before: [`crate::bezier`] removes them as it extracts patches. Which bounds are tried, and in which order,
//! stands in [`super::bounds`].

pub(super) mod blocks;
pub(super) mod difference;
mod orientation;
mod sliding;
mod spline;
