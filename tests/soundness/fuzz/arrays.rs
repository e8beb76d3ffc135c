//! Arrays of any numbers are either refused or give a model without NaN, whose
//! distances are intervals.

use super::support::bytes::Bytes;
use super::support::results::{assert_numbers, distance};
use super::support::surfaces::{any_arrays, plane};
use nurbs_hausdorff::internals::bezier::extract;
use nurbs_hausdorff::{CertifiedOptions, DistanceOptions, HierarchyOptions, Method, MethodName, Model};

pub fn check(bytes: &[u8]) {
    let mut bytes = Bytes::new(bytes);
    let count = bytes.below(3);
    let method = bytes.choose(&[MethodName::Certified, MethodName::Iteration, MethodName::Hierarchy]);
    let other = Model::from_arrays(None, vec![plane(&mut bytes, 4.0)]).unwrap();
    let Ok(model) = Model::from_arrays(None, (0..count).map(|_| any_arrays(&mut bytes)).collect()) else {
        return;
    };
    for patch in extract(&model).patches.iter() {
        assert!(patch.controls.iter().all(|control| !control.is_nan()), "{patch:?}");
    }
    let method = match method {
        MethodName::Certified => {
            Method::Certified(CertifiedOptions { max_cells: Some(32), ..Default::default() })
        }
        MethodName::Hierarchy => Method::Hierarchy(HierarchyOptions { grid: 4, ..Default::default() }),
        other => other.into(),
    };
    let options = DistanceOptions { method, samples: 4, symmetric: true, ..DistanceOptions::default() };
    let result = distance(&model, &other, &options);
    assert_numbers(&result.unwrap_or_else(|error| panic!("{error}")));
}
