//! The arguments that move A.

use glam::{DQuat, DVec3};
use std::str::FromStr;

/// `x,y,z`, in model units.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Translation(pub(crate) DVec3);

/// `x,y,z,degrees`: an axis through the origin, of any length, and the angle
/// about it, counter-clockwise seen against the axis.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Rotation(pub(crate) DQuat);

impl FromStr for Translation {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        numbers(text).map(|numbers| Self(DVec3::from_array(numbers)))
    }
}

impl FromStr for Rotation {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let [x, y, z, degrees] = numbers(text)?;
        let axis = DVec3::new(x, y, z);
        let largest = axis.abs().max_element();
        if largest == 0.0 {
            return Err("the axis has length 0".to_owned());
        }
        // Scaled first, so that no square overflows or vanishes.
        Ok(Self(DQuat::from_axis_angle((axis / largest).normalize(), degrees.to_radians())))
    }
}

/// N finite numbers, separated by commas.
pub(crate) fn numbers<const N: usize>(text: &str) -> Result<[f64; N], String> {
    let numbers: Vec<f64> = text.split(',').map(number).collect::<Result<_, _>>()?;
    let found = numbers.len();
    numbers.try_into().map_err(|_| format!("found {found} numbers, expected {N}"))
}

fn number(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(number) if number.is_finite() => Ok(number),
        _ => Err(format!("found {text:?}, expected a finite number")),
    }
}
