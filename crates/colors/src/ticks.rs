//! The ticks of the legend.

use crate::scale::{Allowed, Scale};

/// What a tick marks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TickKind {
    /// An end of the scale.
    End,
    /// Zero.
    Zero,
    /// The end of what is allowed.
    Allowed,
    /// The lowest deviation found.
    Least,
    /// The highest deviation found, or the largest distance.
    Most,
}

/// A place of the scale that has a label.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tick {
    /// The deviation there.
    pub value: f64,
    /// What it marks.
    pub kind: TickKind,
}

impl Scale {
    /// Returns the ticks, the important ones first, without those nearer to an important one than a label is high:
    /// `least_gap`, a fraction of the scale. What is allowed has ticks whether or not it has a colour.
    #[must_use]
    pub fn ticks(&self, least_gap: f64, allowed: Option<Allowed>) -> Vec<Tick> {
        let (extent, absolute) = (self.extent, self.options.absolute);
        let mut all = vec![(TickKind::End, self.high()), (TickKind::End, self.low())];
        if let Some(Allowed { above, below }) = allowed {
            all.push((TickKind::Allowed, above));
            if !absolute {
                all.push((TickKind::Allowed, -below));
            }
        }
        if !absolute {
            all.push((TickKind::Least, extent.lowest));
        }
        all.push((TickKind::Most, if absolute { extent.largest } else { extent.highest }));
        all.push((TickKind::Zero, 0.0));
        let gap = least_gap * (self.high() - self.low());
        let mut kept: Vec<Tick> = Vec::new();
        for (kind, value) in all {
            let is_inside = value >= self.low() && value <= self.high();
            if is_inside && kept.iter().all(|tick| (tick.value - value).abs() >= gap) {
                kept.push(Tick { value, kind });
            }
        }
        kept
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use crate::scale::{Extent, ScaleOptions};

    const GAP: f64 = 0.075;

    fn of(allowed: f64, absolute: bool) -> Vec<(TickKind, f64)> {
        let extent = Extent { lowest: -2.0, highest: 4.0, largest: 4.0, floor: 1e-3 };
        let allowed = Some(Allowed { above: allowed, below: allowed });
        let scale = Scale::new(extent, ScaleOptions { absolute, ..ScaleOptions::default() });
        scale.ticks(GAP, allowed).into_iter().map(|Tick { value, kind }| (kind, value)).collect()
    }

    #[test]
    fn ticks_are_at_the_ends_what_is_allowed_and_the_extremes_but_not_over_each_other() {
        use TickKind::{Allowed, End, Least, Zero};
        let ends = [(End, 4.0), (End, -4.0)];
        let others = [(Allowed, 1.0), (Allowed, -1.0), (Least, -2.0), (Zero, 0.0)];
        assert_eq!(of(1.0, false), [&ends[..], &others].concat());
        // What is allowed hides 0, from which it is less than 7.5 % of the scale away.
        let near = of(0.3, false);
        assert!(near.contains(&(Allowed, 0.3)), "{near:?}");
        assert!(near.iter().all(|&(_, value)| value != 0.0), "{near:?}");
        assert_eq!(of(1.0, true), [(End, 4.0), (End, 0.0), (Allowed, 1.0)]);
    }
}
