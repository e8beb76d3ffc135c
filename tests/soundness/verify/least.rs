//! The least distance: right intervals are proved, wrong ones refuted.

use super::{SETTINGS, SHIFT, parallelogram, parsed};
use crate::proof::{self, LeastClaim, Motion, Report, Verdict, Witness};
use glam::{DQuat, DVec3};
use nurbs_hausdorff::shapes::{cylinder, sphere, torus};
use nurbs_hausdorff::{ClearanceOptions, Model, RigidTransform};
use nurbs_hausdorff::{Engine, PreparedModel, SurfacePoint};

/// A pair of models, A moved, whose least distance is known.
struct Known {
    name: &'static str,
    a: Model,
    b: Model,
    transform: RigidTransform,
    distance: f64,
}

fn known() -> Vec<Known> {
    let ball = |radius| sphere(DVec3::ZERO, radius).unwrap();
    let square = |height| parallelogram(DVec3::new(-1.0, -1.0, height), [2.0 * DVec3::X, 2.0 * DVec3::Y]);
    let moved = |offset: DVec3| {
        RigidTransform::new(DQuat::from_axis_angle(DVec3::new(2.0, 1.0, 2.0) / 3.0, 0.8), offset).unwrap()
    };
    let apart = 3.0 * DVec3::new(1.0, -2.0, 2.0) / 3.0;
    vec![
        Known { name: "balls", a: ball(1.0), b: ball(0.5), transform: moved(apart), distance: 1.5 },
        Known { name: "nested", a: ball(0.5), b: ball(1.0), transform: moved(apart / 10.0), distance: 0.2 },
        Known { name: "crossing", a: ball(1.0), b: ball(2.5), transform: moved(apart), distance: 0.0 },
        Known {
            name: "parallel squares",
            a: square(0.25),
            b: square(1.0),
            transform: RigidTransform::IDENTITY,
            distance: 0.75,
        },
        Known {
            name: "a pin through a ring",
            a: cylinder(1.0, 8.0).unwrap(),
            b: torus(2.0, 0.5).unwrap(),
            transform: RigidTransform::IDENTITY,
            distance: 0.5,
        },
    ]
}

impl Known {
    fn check(&self, [lower, upper]: [f64; 2]) -> Report {
        let [a, b] = [&self.a, &self.b].map(|model| PreparedModel::new(model).unwrap());
        let options = ClearanceOptions { transform: self.transform, ..ClearanceOptions::default() };
        let found = Engine::cpu().clearance(&a, &b, &options).wait().unwrap().witness;
        let at = |point: &SurfacePoint| Witness { surface: point.face, u: point.u, v: point.v };
        let claim = LeastClaim { lower, upper, witness: [at(&found.a), at(&found.b)] };
        let motion = Motion {
            rotation: self.transform.rotation().to_array(),
            translation: self.transform.offset().to_array(),
        };
        proof::check_least(&parsed(&self.a), &motion, &parsed(&self.b), &claim, &SETTINGS)
    }
}

#[test]
fn right_intervals_are_proved() {
    for pair in known() {
        let report = pair.check([pair.distance; 2]);
        assert_eq!(report.verdict(), Verdict::Proved, "{}: {report:?}", pair.name);
    }
}

#[test]
fn wrong_ends_are_refuted() {
    for pair in known() {
        let above = pair.check([pair.distance + SHIFT, pair.distance + 2.0 * SHIFT]);
        assert_eq!([above.lower, above.upper], [Verdict::Refuted, Verdict::Proved], "{}", pair.name);
        if pair.distance > 0.0 {
            let below = pair.check([pair.distance - 2.0 * SHIFT, pair.distance - SHIFT]);
            assert_eq!([below.lower, below.upper], [Verdict::Proved, Verdict::Refuted], "{}", pair.name);
        }
    }
}

/// The checker reads surfaces without their loops. It must recognise a model with trimmed faces.
#[test]
fn trimmed_faces_are_told() {
    let text = |trim: &str| {
        format!(
            r#"{{"surfaces":[{{"degree":[1,1],"knots_u":[0,0,1,1],"knots_v":[0,0,1,1],
            "ctrl":[[[0,0,0,1],[0,1,0,1]],[[1,0,0,1],[1,1,0,1]]]{trim}}}]}}"#
        )
    };
    let is_trimmed = |trim: &str| proof::Model::from_json(&text(trim)).unwrap().is_trimmed();
    assert!(!is_trimmed("") && is_trimmed(r#","trim":[[]]"#));
}
