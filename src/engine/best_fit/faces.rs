//! Datum features that are picked as faces: the carriers of planes, of surfaces of revolution and of balls.

use crate::alignment::{Datum, Feature};
use crate::carrier::plane_of;
use crate::engine::PreparedModel;
use crate::error::{Error, Result};
use crate::model::RigidTransform;
use glam::DVec3;

impl PreparedModel {
    /// Returns the datum feature of a face: the plane of a flat one, the centre of a ball, the axis of another
    /// surface of revolution, such as a bore. The direction is that of the surface, which may point either way.
    ///
    /// # Errors
    /// [`Error::OptionInvalid`] for the index of no face, and for a face of another kind.
    pub fn face_feature(&self, index: usize) -> Result<Feature> {
        let refused = |what: &str| Error::OptionInvalid {
            found: format!("face {index} {what}, expected a plane, a ball or a surface of revolution"),
        };
        let face = self.source().and_then(|source| source.faces().nth(index));
        let face = face.ok_or_else(|| refused("of a datum does not exist"))?;
        let points = face.surface().control_points().iter().map(|point| DVec3::from_slice(point));
        let points: Vec<DVec3> = points.collect();
        if let Some((point, normal)) = plane_of(&points) {
            return Ok(Feature::Plane { point: point.to_array(), normal: normal.to_array() });
        }
        let found = self.revolution_of(index).ok_or_else(|| refused("has no datum feature"))?;
        Ok(match found.sphere {
            Some(ball) => Feature::Point { point: ball.center.to_array() },
            None => Feature::Axis {
                point: found.axis.origin.to_array(),
                direction: found.axis.direction.to_array(),
            },
        })
    }
}

/// Returns datums whose faces are replaced by their features. Directions of faces point either way: that of B is
/// turned to the side to which that of A points in the pose given.
pub(super) fn resolved(
    datums: &[Datum],
    [a, b]: [&PreparedModel; 2],
    given: &RigidTransform,
) -> Result<Vec<Datum>> {
    let of = |model: &PreparedModel, feature: Feature| match feature {
        Feature::Face { index } => model.face_feature(index),
        other => Ok(other),
    };
    let resolve = |datum: &Datum| {
        let (from, to) = (of(a, datum.a)?, of(b, datum.b)?);
        let is_picked = matches!(datum.a, Feature::Face { .. }) || matches!(datum.b, Feature::Face { .. });
        Ok(Datum { a: from, b: if is_picked { towards(to, from, given) } else { to } })
    };
    datums.iter().map(resolve).collect()
}

/// Returns a feature of B whose direction points to the side of that of A.
fn towards(feature: Feature, of_a: Feature, given: &RigidTransform) -> Feature {
    let sign = |to: [f64; 3], from: [f64; 3]| {
        let cosine = given.rotate(DVec3::from_array(from)).dot(DVec3::from_array(to));
        to.map(|coordinate| if cosine < 0.0 { -coordinate } else { coordinate })
    };
    match (feature, of_a) {
        (Feature::Plane { point, normal }, Feature::Plane { normal: from, .. }) => {
            Feature::Plane { point, normal: sign(normal, from) }
        }
        (Feature::Axis { point, direction }, Feature::Axis { direction: from, .. }) => {
            Feature::Axis { point, direction: sign(direction, from) }
        }
        (other, _) => other,
    }
}

#[cfg(all(test, feature = "shapes", not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::shapes::shape;

    fn of(name: &str) -> Result<Feature> {
        PreparedModel::new(&shape(name)?)?.face_feature(0)
    }

    #[test]
    fn faces_are_planes_balls_axes_or_nothing() {
        assert!(matches!(of("fig5-plane").unwrap(), Feature::Plane { .. }));
        assert!(matches!(of("sphere").unwrap(), Feature::Point { .. }));
        assert!(matches!(of("cylinder").unwrap(), Feature::Axis { .. }));
        assert_eq!(of("wavy-sheet").map_err(|error| error.code()), Err("OPTION_INVALID"));
        let plane = PreparedModel::new(&shape("fig5-plane").unwrap()).unwrap();
        assert_eq!(plane.face_feature(7).map_err(|error| error.code()), Err("OPTION_INVALID"));
    }

    /// A part laid on itself by a face is laid as it was, although its surface may point away.
    #[test]
    fn directions_of_faces_follow_the_pose() {
        let part = PreparedModel::new(&shape("fig5-plane").unwrap()).unwrap();
        let Feature::Plane { point, normal } = part.face_feature(0).unwrap() else { unreachable!() };
        let away = Feature::Plane { point, normal: normal.map(|coordinate| -coordinate) };
        let datum = Datum { a: away, b: Feature::Face { index: 0 } };
        let found = resolved(&[datum], [&part, &part], &RigidTransform::IDENTITY).unwrap();
        assert_eq!(found, [Datum { a: away, b: away }]);
    }
}
