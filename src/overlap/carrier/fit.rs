//! The quadric of least squares that pieces lie on.

use super::form::MAX_PRODUCTS;
use crate::bezier::dot_products;
use crate::overlap::piece::{Piece, Whole};
use glam::{DMat3, DVec3, DVec4};

/// The largest height of control points over a plane, relative to the radius, at which that is the carrier.
const FLATNESS: f64 = 1e-12;

/// What keeps coefficients that pieces do not determine small, in units of the radius.
const DAMPING: f64 = 1e-12;

/// The number of coefficients that are sought: all but that of the height itself.
const COUNT: usize = 9;

/// A quadric in a frame whose third axis is the normal, for coordinates relative to the radius.
pub(super) struct Local {
    pub(super) frame: DMat3,
    pub(super) constant: f64,
    pub(super) gradient: DVec3,
    pub(super) matrix: DMat3,
}

impl Local {
    /// Returns z − q(u, v, z), with the polynomial q of degree 2 without the monomial z for which the squares of
    /// Bernstein coefficients on the pieces have the least sum.
    pub(super) fn new(
        pieces: &[(&Whole, &Piece)],
        middle: DVec3,
        normal: DVec3,
        radius: f64,
    ) -> Option<Self> {
        if normal == DVec3::ZERO || radius <= 0.0 {
            return None;
        }
        let (u, v) = normal.any_orthonormal_pair();
        let frame = DMat3::from_cols(u, v, normal);
        let height = |point: &DVec3| normal.dot(*point - middle).abs();
        let points = || pieces.iter().flat_map(|(_, piece)| &piece.points);
        if points().all(|point| height(point) <= FLATNESS * radius) {
            return Some(Self { frame, constant: 0.0, gradient: DVec3::Z, matrix: DMat3::ZERO });
        }
        let mut columns: [Vec<f64>; COUNT + 1] = std::array::from_fn(|_| Vec::new());
        for &(whole, piece) in pieces.iter().filter(|(whole, _)| !whole.is_strip) {
            add_rows(&mut columns, (whole, piece), (middle, frame.transpose() * (1.0 / radius)));
        }
        for (index, column) in columns.iter_mut().enumerate() {
            column.extend((0..COUNT).map(|row| if row == index { DAMPING } else { 0.0 }));
        }
        let [one, u, v, uu, uv, vv, uz, vz, zz] = least_squares(columns).map(|number| -number);
        let matrix = DMat3::from_cols(
            DVec3::new(uu, 0.5 * uv, 0.5 * uz),
            DVec3::new(0.5 * uv, vv, 0.5 * vz),
            DVec3::new(0.5 * uz, 0.5 * vz, zz),
        );
        Some(Self { frame, constant: one, gradient: DVec3::new(u, v, 1.0), matrix })
    }
}

/// Adds the Bernstein coefficients of each monomial on a piece, and of the height.
fn add_rows(
    columns: &mut [Vec<f64>; COUNT + 1],
    (whole, piece): (&Whole, &Piece),
    (middle, into): (DVec3, DMat3),
) {
    let local = |control: DVec4| (into * control.truncate()).extend(control.w);
    let controls: Vec<DVec4> = whole.around(piece, middle).into_iter().map(local).collect();
    let mut add = |[u, v, z, one, uu, uv, vv, uz, vz, zz]: [f64; 10]| {
        let row = [one, u, v, uu, uv, vv, uz, vz, zz, z];
        for (column, value) in columns.iter_mut().zip(row) {
            column.push(value / one);
        }
    };
    if controls.len() > MAX_PRODUCTS {
        for DVec4 { x: u, y: v, z, w } in controls {
            add([u * w, v * w, z * w, w * w, u * u, u * v, v * v, u * z, v * z, z * z]);
        }
        return;
    }
    // Two products at a time.
    let pick = |first: usize, second: usize| -> Vec<DVec4> {
        controls.iter().map(|control| DVec4::new(control[first], 0.0, 0.0, control[second])).collect()
    };
    let products = |left: [usize; 2], right: [usize; 2]| {
        dot_products(whole.degree(), &pick(left[0], left[1]), &pick(right[0], right[1]))
    };
    let (u_v, z_one, uu_uv) = (products([0, 1], [3, 3]), products([2, 3], [3, 3]), products([0, 0], [0, 1]));
    let (vv_uz, vz_zz) = (products([1, 0], [1, 2]), products([1, 2], [2, 2]));
    for (row, &(u, v)) in u_v.iter().enumerate() {
        let ((z, one), (uu, uv)) = (z_one[row], uu_uv[row]);
        let ((vv, uz), (vz, zz)) = (vv_uz[row], vz_zz[row]);
        add([u, v, z, one, uu, uv, vv, uz, vz, zz]);
    }
}

/// Returns the factors of all columns but the last one whose sum is nearest to that, by orthogonalization.
fn least_squares(mut columns: [Vec<f64>; COUNT + 1]) -> [f64; COUNT] {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let mut triangle = [[0.0; COUNT + 1]; COUNT];
    for step in 0..COUNT {
        let (done, rest) = columns.split_at_mut(step + 1);
        let column = &mut done[step];
        let length = dot(column, column).sqrt();
        column.iter_mut().for_each(|value| *value /= length);
        triangle[step][step] = length;
        for (other, place) in rest.iter_mut().zip(&mut triangle[step][step + 1..]) {
            *place = dot(column, other);
            for (value, own) in other.iter_mut().zip(column.iter()) {
                *value -= *place * own;
            }
        }
    }
    let mut factors = [0.0; COUNT];
    for step in (0..COUNT).rev() {
        let of_others: f64 = (step + 1..COUNT).map(|other| triangle[step][other] * factors[other]).sum();
        factors[step] = (triangle[step][COUNT] - of_others) / triangle[step][step];
    }
    factors
}
