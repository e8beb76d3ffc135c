//! Surfaces that rotations about an axis map onto themselves.

mod axis;
mod revolution;
mod sphere;
mod winding_number;

pub(crate) use revolution::{Revolution, revolutions};
pub(crate) use sphere::Sphere;

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::revolutions;
    use crate::axis::Axis;
    use crate::bezier::extract;
    use crate::model::{Model, RigidTransform};
    use crate::shapes::operations::{cut_surface, transformed};
    use crate::shapes::{shape, sphere};
    use glam::{DQuat, DVec3};

    /// The rounding error of surfaces of size 1 to 10, about a hundred away from the
    /// origin, with the allowance of lemma R13 of docs/rounding.md.
    const ROUNDING: f64 = 1e-11;

    fn away(model: &Model) -> Model {
        let turn = DQuat::from_axis_angle(DVec3::new(1.0, 2.0, 3.0).normalize(), 0.8);
        transformed(model, &RigidTransform::new(turn, DVec3::new(-100.0, 20.0, 50.0)).unwrap()).unwrap()
    }

    #[test]
    fn surfaces_of_revolution_are_detected_in_any_position() {
        for name in ["torus", "bottle", "glass"] {
            for model in [shape(name).unwrap(), away(&shape(name).unwrap())] {
                let [Some(found)] = revolutions(&extract(&model))[..] else { panic!("{name}") };
                assert!(
                    found.full && found.deviation < ROUNDING && found.sphere.is_none(),
                    "{name}: {found:?}"
                );
            }
        }
        let ball = away(&sphere(DVec3::ONE, 2.0).unwrap());
        let [Some(found)] = revolutions(&extract(&ball))[..] else { panic!("a sphere") };
        let sphere = found.sphere.unwrap();
        assert!((sphere.radius - 2.0).abs() < ROUNDING && sphere.deviation < ROUNDING, "{sphere:?}");
        assert!(sphere.center.distance(ball.bounding_box().center()) < 1e-9, "{sphere:?}");
    }

    #[test]
    fn other_surfaces_are_not_detected() {
        for name in ["wavy-sheet", "wigley-hull", "fig5-plane"] {
            for found in revolutions(&extract(&shape(name).unwrap())) {
                assert!(found.is_none(), "{name}: {found:?}");
            }
        }
        // Parts of a surface of revolution turn, but not fully.
        for fraction in [0.2, 0.5, 0.75, 0.9] {
            let part = cut_surface(&shape("torus").unwrap().surfaces()[0], Axis::U, fraction).unwrap();
            for part in part {
                let part = Model::new(None, vec![part]).unwrap();
                let [Some(found)] = revolutions(&extract(&part))[..] else { panic!("{fraction}") };
                assert!(!found.full, "{fraction}");
            }
        }
    }
}
