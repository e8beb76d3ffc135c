//! The pictures of a clash: both bodies where they stand, and what of each is inside the other one.

use super::camera::Camera;
use super::raster::{Corner, Raster};
use super::views::{OVERVIEWS, SIZE};
use super::{Figure, KnownDeviation, Picture, mark, numbers::distance_text, png};
use glam::DVec3;
use nurbs_hausdorff::workspace::{Map, MapPair, Vertex};
use nurbs_hausdorff::{Error, PreparedModel, RigidTransform};

/// The colours of the bodies, with their names: told apart by those who see no red or no green.
const BODIES: [([u8; 3], &str); 2] = [([120, 170, 220], "blue"), ([225, 200, 120], "yellow")];

/// The colour of what is inside the other body.
const INSIDE: ([u8; 3], &str) = ([190, 25, 45], "red");

/// The radius of the view that is cut open, in diagonals of both bodies.
const CUT_RADIUS: f64 = 0.2;

/// Two bodies that clash, in one unit.
#[derive(Debug, Clone, Copy)]
pub struct Clash<'a> {
    /// The bodies.
    pub bodies: [&'a PreparedModel; 2],
    /// Their names.
    pub names: [&'a str; 2],
    /// A point inside both.
    pub point: [f64; 3],
}

/// Draws a clash from opposite corners, and from near, cut open where the point is. What is red is an estimate
/// between measured points. `deflate` makes a zlib stream of bytes.
///
/// # Errors
/// Those of [`nurbs_hausdorff::Engine::closest_points`] and of `deflate`.
pub fn clash_pictures<E: From<Error>>(
    clash: &Clash<'_>,
    mut deflate: impl FnMut(&[u8]) -> Result<Vec<u8>, E>,
) -> Result<Vec<Figure>, E> {
    let scene = Scene::new(clash)?;
    let [a, b] = clash.names;
    let ([(_, of_a), (_, of_b)], (_, inside)) = (BODIES, INSIDE);
    let what = format!("{a} in {of_a} and {b} in {of_b}; what is inside the other one in {inside}");
    let mut pictures = Vec::new();
    for (toward, from) in OVERVIEWS {
        let camera = Camera::fitting(&scene.positions(), toward, SIZE);
        pictures.push(scene.picture(&camera, format!("{what}, seen {from}"), &mut deflate)?);
    }
    let [(toward, one), (_, other)] = OVERVIEWS;
    let at = clash.point.map(|coordinate| distance_text(coordinate, scene.diagonal)).join(", ");
    let seen = format!("{what}, seen {one}, and {other}. The ring marks {at}, which is inside both");
    let mut camera = Camera::around(scene.point, CUT_RADIUS * scene.diagonal, toward, SIZE);
    camera.near = 0.0;
    let caption = format!("The same from near, {one}: all in front of that point is cut away");
    let near = scene.picture(&camera, format!("{what}, cut open"), &mut deflate)?;
    Ok(vec![Figure { caption: seen, pictures }, Figure { caption, pictures: vec![near] }])
}

/// Both bodies with the signed distances of their points from the other one.
struct Scene {
    maps: [Map; 2],
    point: DVec3,
    diagonal: f64,
}

impl Scene {
    fn new(clash: &Clash<'_>) -> nurbs_hausdorff::Result<Self> {
        let [a, b] = clash.bodies;
        let diagonal = a.bounding_box().union(b.bounding_box()).diagonal();
        let pair = MapPair::new(a, b, RigidTransform::IDENTITY, false)?;
        let of = |is_of_a| pair.drawn(is_of_a, &KnownDeviation::default()).map(|of_side| of_side.map);
        let maps = [of(true)?, of(false)?];
        Ok(Self { maps, point: DVec3::from_array(clash.point), diagonal })
    }

    fn positions(&self) -> Vec<DVec3> {
        self.maps.iter().flat_map(|map| map.vertices.iter().map(|vertex| vertex.position)).collect()
    }

    /// Returns what a camera sees, with a ring around the point inside both.
    fn picture<E>(
        &self,
        camera: &Camera,
        alt: String,
        deflate: &mut impl FnMut(&[u8]) -> Result<Vec<u8>, E>,
    ) -> Result<Picture, E> {
        let mut raster = Raster::new(SIZE);
        let mut first_face = 0;
        for (Map { vertices, values, triangles, .. }, (own, _)) in self.maps.iter().zip(BODIES) {
            // Without a sign it is NaN, and not below 0.
            let color = |[signed, _]: [f64; 2]| if signed < 0.0 { INSIDE.0 } else { own };
            let corner = |index: u32| {
                let Vertex { position, normal, .. } = vertices[index as usize];
                Corner { position, normal, value: values[index as usize] }
            };
            for (corners, &face) in triangles.corners.iter().zip(&triangles.faces) {
                raster.triangle(camera, &corners.map(corner), first_face + face, &color);
            }
            first_face += triangles.faces.iter().max().map_or(0, |&last| last + 1);
        }
        let mut pixels = raster.pixels();
        let at = camera.project(self.point);
        mark::ring(&mut pixels, SIZE, [at.x, at.y]);
        let png = png::png(&pixels, SIZE, deflate)?;
        Ok(Picture { alt, size: SIZE, mark: Some([at.x, at.y]), png })
    }
}
