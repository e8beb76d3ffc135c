//! The map from a parameter of the file to that of the exact NURBS.

/// A monotone map of one parameter.
///
/// On the piece [b - a, b + a] with middle m = b, the quadratic arc of a circle has
/// at the angle u the parameter `m + a tan((u - m) / 2) / tan(a / 2)`, and that of a
/// hyperbola the same with tanh.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum ParameterMap {
    Identity,
    /// Between these breaks, which the map leaves as they are.
    Circular(Vec<f64>),
    Hyperbolic(Vec<f64>),
}

impl ParameterMap {
    /// Returns the piece of a parameter as its middle and half range; `None` for the identity.
    pub(crate) fn piece(&self, parameter: f64) -> Option<[f64; 2]> {
        let (Self::Circular(breaks) | Self::Hyperbolic(breaks)) = self else { return None };
        let last = breaks.len() - 2;
        let index = breaks.partition_point(|&end| end <= parameter).saturating_sub(1).min(last);
        Some([0.5 * (breaks[index] + breaks[index + 1]), 0.5 * (breaks[index + 1] - breaks[index])])
    }

    /// Returns the breaks inside of the range.
    pub(crate) fn breaks(&self) -> &[f64] {
        match self {
            Self::Identity => &[],
            Self::Circular(breaks) | Self::Hyperbolic(breaks) => breaks,
        }
    }

    /// Returns the image of a parameter. Breaks are mapped to themselves exactly.
    pub(crate) fn apply(&self, parameter: f64) -> f64 {
        let Some([middle, half]) = self.piece(parameter) else { return parameter };
        if self.breaks().contains(&parameter) {
            return parameter;
        }
        match self {
            Self::Hyperbolic(_) => middle + half * (0.5 * (parameter - middle)).tanh() / (0.5 * half).tanh(),
            _ => middle + half * (0.5 * (parameter - middle)).tan() / (0.5 * half).tan(),
        }
    }
}
