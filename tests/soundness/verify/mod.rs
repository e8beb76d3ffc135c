//! The independent checker: right results are proved, wrong ones refuted.

mod cuts;
mod exact;
mod intervals;
mod least;
mod remainders;

use crate::proof::{self, Claim, Motion, Report, Settings, Verdict, Witness};
use glam::{DQuat, DVec3};
use nurbs_hausdorff::internals::engine::{DistanceOptions, Engine, PreparedModel};
use nurbs_hausdorff::shapes::{cylinder, shape, sphere};
use nurbs_hausdorff::{Model, RigidTransform, SurfaceArrays};
use std::path::Path;
use std::time::Duration;

/// How far ends are moved from the truth in what must be refuted, in model units.
const SHIFT: f64 = 0.01;

/// Proofs end when they are found, after seconds; the time is for machines that do other things, too.
const SETTINGS: Settings = Settings { time: Duration::from_secs(1200), slack: 1e-4 };

/// A pair whose distance is known, attained at a point of surface 0 of A.
struct Known {
    name: &'static str,
    a: Model,
    b: Model,
    distance: f64,
    at: [f64; 2],
}

/// The parallelogram with a corner and two edges, of degrees (1, 1).
fn parallelogram(corner: DVec3, edges: [DVec3; 2]) -> Model {
    let [u, v] = edges;
    let corners = [corner, corner + v, corner + u, corner + u + v];
    let knots = vec![0.0, 0.0, 1.0, 1.0];
    let surface = SurfaceArrays {
        degree: [1, 1],
        knots: [knots.clone(), knots],
        counts: [2, 2],
        control_points: corners.map(|point| [point.x, point.y, point.z, 1.0]).to_vec(),
    };
    Model::from_arrays(None, vec![surface]).unwrap()
}

fn known() -> [Known; 3] {
    let ball = |radius| sphere(DVec3::ZERO, radius).unwrap();
    let square = |height| parallelogram(DVec3::new(-1.0, -1.0, height), [2.0 * DVec3::X, 2.0 * DVec3::Y]);
    [
        Known { name: "concentric spheres", a: ball(2.0), b: ball(2.2), distance: 0.2, at: [0.1, 0.2] },
        Known { name: "parallel planes", a: square(0.25), b: square(1.0), distance: 0.75, at: [0.3, 0.6] },
        // From (2, y, z) it is sqrt(4 + y²) - 1 to the cylinder of radius 1 about the z axis.
        Known {
            name: "plane against cylinder",
            a: parallelogram(DVec3::new(2.0, -1.0, -0.5), [2.0 * DVec3::Y, DVec3::Z]),
            b: cylinder(1.0, 4.0).unwrap(),
            distance: 5.0_f64.sqrt() - 1.0,
            at: [0.0, 0.5],
        },
    ]
}

fn parsed(model: &Model) -> proof::Model {
    proof::Model::from_json(&model.to_json().unwrap()).unwrap()
}

impl Known {
    fn check(&self, [lower, upper]: [f64; 2], settings: &Settings) -> Report {
        let [u, v] = self.at;
        let claim = Claim { lower, upper, witness: Witness { surface: 0, u, v } };
        proof::check(&parsed(&self.a), &Motion::IDENTITY, &parsed(&self.b), &claim, settings)
    }
}

#[test]
fn right_results_are_proved() {
    for pair in known() {
        let report = pair.check([pair.distance; 2], &SETTINGS);
        assert_eq!(report.verdict(), Verdict::Proved, "{}: {report:?}", pair.name);
        assert!(report.notes.is_empty(), "{}: {report:?}", pair.name);
    }
}

#[test]
fn an_upper_end_below_the_truth_is_refuted() {
    for pair in known() {
        let report = pair.check([0.0, pair.distance - SHIFT], &SETTINGS);
        assert_eq!(report.upper, Verdict::Refuted, "{}: {report:?}", pair.name);
        assert_eq!(report.verdict(), Verdict::Refuted, "{}: {report:?}", pair.name);
    }
}

#[test]
fn a_lower_end_above_the_truth_is_refuted() {
    for pair in known() {
        let report = pair.check([pair.distance + SHIFT, pair.distance + 2.0 * SHIFT], &SETTINGS);
        assert_eq!(report.lower, Verdict::Refuted, "{}: {report:?}", pair.name);
        assert_eq!(report.verdict(), Verdict::Refuted, "{}: {report:?}", pair.name);
    }
}

/// Without slack, ends that are wrong by a hundred-millionth are not proved, and right ones not refuted.
#[test]
fn nothing_wrong_is_proved_without_slack() {
    let settings = Settings { time: Duration::from_secs(2), slack: 0.0 };
    let off = 1e-8;
    for pair in known() {
        let low = pair.check([0.0, pair.distance - off], &settings);
        assert_eq!(low.upper, Verdict::Refuted, "{}: {low:?}", pair.name);
        let high = pair.check([pair.distance + off, pair.distance + 1.0], &settings);
        assert_ne!(high.lower, Verdict::Proved, "{}: {high:?}", pair.name);
        let right = pair.check([pair.distance - off, pair.distance + off], &settings);
        assert_eq!(right.lower, Verdict::Proved, "{}: {right:?}", pair.name);
        assert_ne!(right.upper, Verdict::Refuted, "{}: {right:?}", pair.name);
    }
}

#[test]
fn nothing_is_proved_without_time() {
    let settings = Settings { time: Duration::ZERO, ..SETTINGS };
    let [pair, ..] = known();
    let report = pair.check([pair.distance; 2], &settings);
    assert_eq!(report.verdict(), Verdict::NotProved, "{report:?}");
    let wrong = pair.check([0.5, 0.6], &settings);
    assert_eq!(wrong.verdict(), Verdict::NotProved, "{wrong:?}");
}

/// The lower end holds if any point of A is that far; that the witness is not is said.
#[test]
fn a_wrong_witness_of_a_right_lower_end_is_noted() {
    let [_, _, mut pair] = known();
    pair.at = [0.5, 0.5];
    let report = pair.check([pair.distance; 2], &SETTINGS);
    assert_eq!(report.lower, Verdict::Proved, "{report:?}");
    assert_eq!(report.notes.len(), 1, "{report:?}");
}

#[test]
fn results_of_the_search_are_proved_also_of_moved_models() {
    let engine = Engine::cpu();
    let turn = DQuat::from_axis_angle(DVec3::new(1.0, 2.0, 2.0) / 3.0, 0.7);
    let shift = DVec3::new(0.3, -0.2, 0.5);
    for [a, b] in [["cylinder", "cone"], ["glass", "bottle"], ["wavy-sheet", "torus"]] {
        let [a, b] = [a, b].map(|name| shape(name).unwrap());
        let transform = RigidTransform::new(turn, shift).unwrap();
        let options = DistanceOptions { transform, ..DistanceOptions::default() };
        let (prepared_a, prepared_b) = (PreparedModel::new(&a).unwrap(), PreparedModel::new(&b).unwrap());
        let result = engine.distance(&prepared_a, &prepared_b, &options).wait().unwrap();
        let motion =
            Motion { rotation: transform.rotation().to_array(), translation: transform.offset().to_array() };
        let found = result.witness.a;
        let witness = Witness { surface: found.face, u: found.u, v: found.v };
        let claim = Claim { lower: result.lower, upper: result.upper, witness };
        let settings = Settings { slack: 1e-3, ..SETTINGS };
        let report = proof::check(&parsed(&a), &motion, &parsed(&b), &claim, &settings);
        assert_eq!(report.verdict(), Verdict::Proved, "{report:?}");
        // Of the models as they are, the same interval is wrong.
        let still = proof::check(&parsed(&a), &Motion::IDENTITY, &parsed(&b), &claim, &settings);
        assert_eq!(still.verdict(), Verdict::Refuted, "{still:?}");
    }
}

/// Four pairs whose knots are a few units in the last place apart, on which a search once printed
/// upper ends below the truth: the false ends are refuted, the true distances proved.
#[test]
fn false_upper_ends_at_knots_next_to_each_other_are_refuted() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/soundness");
    if !folder.is_dir() {
        eprintln!("SKIPPED: there is no ../shared/soundness");
        return;
    }
    // The truth of ulp_spiral is published to three digits only.
    let pairs = [
        ("ulp_gap", 0.02, Some(0.06090664988), [0.0, 0.75]),
        ("ulp_gap_1e5", 0.02, Some(0.06090664988), [0.0, 0.75]),
        ("ulp_crease", 0.02, None, [0.0, 0.75]),
        ("ulp_spiral", 0.0205643641, None, [0.0, 0.0]),
    ];
    for (name, stated, truth, [u, v]) in pairs {
        let [a, b] = ["A", "B"].map(|side| {
            let text = std::fs::read_to_string(folder.join(format!("{name}_{side}.json"))).unwrap();
            proof::Model::from_json(&text).unwrap()
        });
        let check = |lower, upper, slack| {
            let claim = Claim { lower, upper, witness: Witness { surface: 0, u, v } };
            proof::check(&a, &Motion::IDENTITY, &b, &claim, &Settings { slack, ..SETTINGS })
        };
        let report = check(stated, stated, 1e-3);
        assert_eq!(report.upper, Verdict::Refuted, "{name}: {report:?}");
        if let Some(truth) = truth {
            let report = check(truth, truth, 1e-5);
            assert_eq!(report.verdict(), Verdict::Proved, "{name}: {report:?}");
        }
    }
}

#[test]
fn what_is_no_model_is_refused() {
    for text in [
        "{}",
        r#"{"surfaces": []}"#,
        r#"{"surfaces": [{"degree": [1, 1], "knots_u": [0, 0, 1], "knots_v": [0, 0, 1, 1], "ctrl": [[[0, 0, 0, 1], [0, 1, 0, 1]], [[1, 0, 0, 1], [1, 1, 0, 1]]]}]}"#,
        r#"{"surfaces": [{"degree": [1, 1], "knots_u": [0, 0, 1, 1], "knots_v": [0, 0, 1, 1], "ctrl": [[[0, 0, 0, 1], [0, 1, 0, 0]], [[1, 0, 0, 1], [1, 1, 0, 1]]]}]}"#,
    ] {
        assert!(proof::Model::from_json(text).is_err(), "{text}");
    }
}
