//! Whatever is handed over, it is parsed or refused, and never a panic; and
//! every valid surface is accepted and survives being written.

use nurbs_hausdorff::{Model, NurbsSurface, SurfaceArrays};
use proptest::collection::vec;
use proptest::prelude::*;

/// Numbers of all kinds: infinite, not a number, huge, tiny, and small integers.
fn any_number() -> impl Strategy<Value = f64> {
    prop_oneof![any::<f64>(), (-3_i8..4).prop_map(f64::from), Just(f64::NAN), Just(f64::INFINITY)]
}

fn any_arrays() -> impl Strategy<Value = SurfaceArrays> {
    let knots = || vec(any_number(), 0..9);
    let count = || prop_oneof![4 => 0_usize..6, 1 => any::<usize>()];
    let degree = || prop_oneof![4 => 0_usize..5, 1 => any::<usize>()];
    let points = vec([any_number(), any_number(), any_number(), any_number()], 0..12);
    ([degree(), degree()], [knots(), knots()], [count(), count()], points).prop_map(
        |(degree, knots, counts, control_points)| SurfaceArrays { degree, knots, counts, control_points },
    )
}

/// A degree, and knots that do not fall, with multiplicities up to full ones
/// and steps down to 1e-12, clamped or not.
fn valid_direction() -> impl Strategy<Value = (usize, Vec<f64>)> {
    (1_usize..=15, any::<bool>(), -100.0..100.0).prop_flat_map(|(degree, clamped, start)| {
        let steps = vec((prop_oneof![0.01..10.0, Just(1e-12)], 1..=degree + 1), 2..6);
        steps.prop_map(move |steps| {
            let last = steps.len() - 1;
            let mut knot: f64 = start;
            let mut knots: Vec<f64> = Vec::new();
            for (index, (step, multiplicity)) in steps.into_iter().enumerate() {
                let end = index == 0 || index == last;
                let times = if clamped && end { degree + 1 } else { multiplicity };
                knots.extend(std::iter::repeat_n(knot, times));
                knot += step;
            }
            // Unclamped knots need degree more on either side of the domain.
            if !clamped {
                for outside in 1..=degree {
                    knots.insert(0, start - outside as f64);
                    knots.push(knot + outside as f64);
                }
            }
            (degree, knots)
        })
    })
}

fn valid_arrays() -> impl Strategy<Value = SurfaceArrays> {
    (valid_direction(), valid_direction()).prop_flat_map(|((p, knots_u), (q, knots_v))| {
        let counts = [knots_u.len() - p - 1, knots_v.len() - q - 1];
        let coordinate = || -1e6..1e6;
        let point = (coordinate(), coordinate(), coordinate(), 1e-3..1e3)
            .prop_map(|(x, y, z, w): (f64, f64, f64, f64)| [x, y, z, w]);
        vec(point, counts[0] * counts[1]).prop_map(move |control_points| SurfaceArrays {
            degree: [p, q],
            knots: [knots_u.clone(), knots_v.clone()],
            counts,
            control_points,
        })
    })
}

/// JSON values of any shape, with the interchange's keys more likely than others.
fn any_json() -> impl Strategy<Value = serde_json::Value> {
    let leaf = prop_oneof![
        Just(serde_json::Value::Null),
        any::<bool>().prop_map(Into::into),
        any::<i64>().prop_map(Into::into),
        any::<f64>().prop_map(Into::into),
        ".*".prop_map(Into::<serde_json::Value>::into),
    ];
    let key = prop_oneof![
        Just("surfaces".to_owned()),
        Just("degree".to_owned()),
        Just("knots_u".to_owned()),
        Just("knots_v".to_owned()),
        Just("ctrl".to_owned()),
        Just("name".to_owned()),
        ".{0,4}",
    ];
    leaf.prop_recursive(6, 64, 6, move |inner| {
        prop_oneof![
            vec(inner.clone(), 0..6).prop_map(Into::into),
            vec((key.clone(), inner), 0..6)
                .prop_map(|entries| serde_json::Value::Object(entries.into_iter().collect())),
        ]
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 512, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_arrays_are_parsed_or_refused(arrays in any_arrays()) {
        if let Err(error) = NurbsSurface::new(5, arrays) {
            prop_assert!(error.to_string().starts_with("surface 5: "), "{error}");
        }
    }

    #[test]
    fn any_text_is_parsed_or_refused(text in ".*") {
        prop_assert!(Model::from_json(&text).is_err());
    }

    #[test]
    fn any_json_is_parsed_or_refused(value in any_json()) {
        let _ = Model::from_json(&value.to_string());
    }

    #[test]
    fn damaged_json_is_parsed_or_refused(arrays in valid_arrays(), place: prop::sample::Index, byte: u8) {
        let model = Model::from_arrays(None, vec![arrays]).unwrap();
        let mut bytes = model.to_json().unwrap().into_bytes();
        let place = place.index(bytes.len());
        bytes[place] = byte;
        if let Ok(text) = String::from_utf8(bytes) {
            let _ = Model::from_json(&text);
        }
    }

    #[test]
    fn valid_arrays_are_accepted_and_survive_writing(arrays in valid_arrays()) {
        let model = Model::from_arrays(Some("a model".to_owned()), vec![arrays.clone()]);
        prop_assert!(model.is_ok(), "{model:?}");
        let model = model.unwrap();
        let written = Model::from_json(&model.to_json().unwrap()).unwrap();
        prop_assert_eq!(&written, &model);
        prop_assert_eq!(written.surfaces()[0].clone().into_arrays(), arrays);
    }
}
