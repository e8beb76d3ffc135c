//! The models of the pairs: from a few numbers, or nets as they were found.

use nurbs_hausdorff::{Model, SurfaceArrays};

/// The models A and B of a pair whose nets are data.
macro_rules! nets {
    ($name:ident) => {
        [
            include_str!(concat!("../nets/", stringify!($name), "_a.json")),
            include_str!(concat!("../nets/", stringify!($name), "_b.json")),
        ]
        .map(|text| nurbs_hausdorff::Model::from_json(text).unwrap())
    };
}
pub(super) use nets;

/// A model of surfaces that are known to be valid.
pub(super) fn model(surfaces: Vec<SurfaceArrays>) -> Model {
    Model::from_arrays(None, surfaces).unwrap()
}

/// A surface with its control points in rows along u.
pub(super) fn surface(degree: [usize; 2], knots: [&[f64]; 2], control_points: &[[f64; 4]]) -> SurfaceArrays {
    let counts = [0, 1].map(|axis| knots[axis].len() - degree[axis] - 1);
    SurfaceArrays { degree, knots: knots.map(<[_]>::to_vec), counts, control_points: control_points.to_vec() }
}

/// The curve (x, z) with these control points, swept from y = 0 to y = 1.
pub(super) fn swept(degree: usize, knots: &[f64], curve: &[[f64; 2]]) -> SurfaceArrays {
    let ends = |&[x, z]: &[f64; 2]| [[x, 0.0, z, 1.0], [x, 1.0, z, 1.0]];
    let points: Vec<_> = curve.iter().flat_map(ends).collect();
    surface([degree, 1], [knots, &[0.0, 0.0, 1.0, 1.0]], &points)
}

/// A bilinear surface.
pub(super) fn bilinear(corners: [[f64; 4]; 4]) -> SurfaceArrays {
    surface([1, 1], [&[0.0, 0.0, 1.0, 1.0]; 2], &corners)
}

/// The rectangle from x = 10 to 11 at this height, swept as [`swept`] does.
pub(super) fn shelf(height: f64) -> SurfaceArrays {
    swept(1, &[0.0, 0.0, 1.0, 1.0], &[[10.0, height], [11.0, height]])
}

/// A knot vector of `degree` + 1 equal knots at each of these numbers.
pub(super) fn repeated(degree: usize, knots: &[f64]) -> Vec<f64> {
    knots.iter().flat_map(|&knot| vec![knot; degree + 1]).collect()
}
