//! Distances to meshes and clouds one facet at a time, by an algorithm of its own.

use super::super::brute::Target;
use super::super::sheet::{Sheet, sheets};
use super::draw::Drawn;
use crate::support::evaluator::point;
use fastrand::Rng;
use glam::{DVec2, DVec3};
use nurbs_hausdorff::RigidTransform;

/// Points that are drawn on a model besides its corners.
const POINTS: usize = 160;

/// A model, moved, that distances are measured to.
pub(super) enum Brute {
    Triangles(Vec<[DVec3; 3]>),
    Points(Vec<DVec3>),
    Sheets { sheets: Vec<Sheet>, pose: RigidTransform, origin: DVec3 },
}

/// Whether a point is within a length of a model.
#[derive(PartialEq)]
pub(super) enum Within {
    Yes,
    No,
    /// No near point of surfaces was found, which proves nothing.
    Unknown,
}

impl Brute {
    pub(super) fn new(model: &Drawn, pose: RigidTransform) -> Self {
        match model {
            Drawn::Mesh(mesh) => {
                let corners = |triangle: &[u32; 3]| triangle.map(|k| pose.apply(mesh.vertices()[k as usize]));
                Self::Triangles(mesh.triangles().iter().map(corners).collect())
            }
            Drawn::Cloud(points) => Self::Points(points.iter().map(|&point| pose.apply(point)).collect()),
            Drawn::Surfaces(model) => {
                let origin = model.bounding_box().center();
                Self::Sheets { sheets: sheets(model, origin), pose, origin }
            }
        }
    }

    /// Returns a distance that the true one does not exceed, and which it is for facets.
    pub(super) fn distance(&self, point: DVec3) -> f64 {
        match self {
            Self::Triangles(triangles) => {
                triangles.iter().map(|corners| to_triangle(corners, point)).fold(f64::INFINITY, f64::min)
            }
            Self::Points(points) => {
                points.iter().map(|other| other.distance(point)).fold(f64::INFINITY, f64::min)
            }
            Self::Sheets { sheets, pose, origin } => {
                Target::new(sheets).least(pose.apply_inverse(point) - *origin).distance
            }
        }
    }

    pub(super) fn is_within(&self, point: DVec3, limit: f64) -> Within {
        match self {
            Self::Sheets { sheets, pose, origin } => {
                let local = pose.apply_inverse(point) - *origin;
                let found = Target::new(sheets).is_within(local, limit, (usize::MAX, DVec2::ZERO));
                if found { Within::Yes } else { Within::Unknown }
            }
            _ if self.distance(point) <= limit => Within::Yes,
            _ => Within::No,
        }
    }
}

/// Returns points of a model, moved.
pub(super) fn points(model: &Drawn, pose: RigidTransform, rng: &mut Rng) -> Vec<DVec3> {
    let mut found: Vec<DVec3> = Vec::new();
    match model {
        Drawn::Cloud(points) => found.extend(points),
        Drawn::Surfaces(model) => {
            for _ in 0..POINTS {
                let surface = &model.surfaces()[rng.usize(0..model.surfaces().len())];
                let rounded = |t: f64| {
                    if t < 0.1 {
                        0.0
                    } else if t > 0.9 {
                        1.0
                    } else {
                        t
                    }
                };
                let [u, v] = surface.domain().at([rounded(rng.f64()), rounded(rng.f64())]);
                found.push(DVec3::from_array(point(surface, u, v)));
            }
        }
        Drawn::Mesh(mesh) => {
            found.extend(mesh.vertices());
            for _ in 0..POINTS {
                let triangle = mesh.triangles()[rng.usize(0..mesh.triangles().len())];
                let [a, b, c] = triangle.map(|k| mesh.vertices()[k as usize]);
                let [s, t] = [rng.f64(), if rng.bool() { rng.f64() } else { 0.0 }];
                found.push(a.lerp(b.lerp(c, t), s));
            }
        }
    }
    found.into_iter().map(|point| pose.apply(point)).collect()
}

/// Returns the distance of a point from a triangle: from its plane where the foot lies on the inner
/// side of all edges, else from the nearest edge. The plane is taken through the nearest point of the
/// edges, as the normal of a sliver is inaccurate.
pub(in crate::fuzzer) fn to_triangle(corners: &[DVec3; 3], point: DVec3) -> f64 {
    let [a, b, c] = *corners;
    let edges = [(a, b), (b, c), (c, a)];
    let on_edge = |(p, q): (DVec3, DVec3)| {
        let along = q - p;
        let length = along.length();
        let at = if length > 0.0 { (along / length).dot(point - p) } else { 0.0 };
        if at <= 0.0 {
            p
        } else if at >= length {
            q
        } else {
            p + along * (at / length)
        }
    };
    let nearest =
        edges.map(on_edge).into_iter().min_by(|p, q| p.distance(point).total_cmp(&q.distance(point)));
    let nearest = nearest.unwrap();
    let normal = (b - a).cross(c - a).normalize_or_zero();
    let is_inside =
        normal != DVec3::ZERO && edges.iter().all(|(p, q)| (*q - *p).cross(point - *p).dot(normal) > 0.0);
    if is_inside { (point - nearest).dot(normal).abs() } else { nearest.distance(point) }
}
