//! The views: two overviews of a map from opposite corners, which together see every side, and one of
//! the worst place.

use super::camera::Camera;
use super::numbers::{distance_text, signed_text};
use super::raster::{Corner, Raster};

use super::{Figure, Picture, mark, png};
use glam::DVec3;
use nurbs_hausdorff::Signs;
use nurbs_hausdorff::workspace::{Map, Vertex};
use nurbs_hausdorff_colors::Scale;

/// The width and height of a picture, in pixels: 220 to the inch where two are beside each other on A4.
pub(super) const SIZE: [usize; 2] = [640, 560];

/// The directions from the model to the eye, with their names: the page's oblique view and its opposite. z
/// is up; the front faces −y.
pub(super) const OVERVIEWS: [(DVec3, &str); 2] = [
    (DVec3::new(0.75, -1.25, 0.8), "from the front, the right and above"),
    (DVec3::new(-0.75, 1.25, -0.8), "from the back, the left and below"),
];

/// The least radius of the view of the worst place, in diagonals, and in lengths of the deviation: those of
/// the page.
const PLACE_RADIUS: f64 = 0.12;
const APPROACH_RADIUS: f64 = 2.0;

/// Fractions of that radius, tried in order until the worst place is seen: surfaces farther in front of it are
/// not drawn.
const NEAR_PARTS: [f64; 3] = [1.0, 0.25, 0.05];

/// How far the normal at the worst place is turned towards an overview's direction, so that depths are seen.
const TURN: f64 = 0.5;

/// The number of colours that are computed once, from one end of the scale to the other.
const COLORS: usize = 1024;

/// The size of the points of a cloud, in pixels, as on the page.
const POINT_SIZE: f64 = 3.0;

/// What may be in front of the worst place and not hide it, in pixels: rounding, and the triangles'
/// distance from the model.
const SLACK: f64 = 3.0;

/// A map with what its pictures say.
pub(super) struct Scene<'a> {
    /// Those of its model, and of the other one.
    pub(super) names: [&'a str; 2],
    pub(super) map: &'a Map,
    pub(super) signs: Signs,
    pub(super) scale: &'a Scale,
    pub(super) diagonal: f64,
    pub(super) unit: Option<&'a str>,
    /// Whether the worst place of all maps is one of this map.
    pub(super) is_worst: bool,
}

impl Scene<'_> {
    /// Draws the overviews, and the worst place if it is on this map.
    pub(super) fn figures<E>(
        &self,
        deflate: &mut impl FnMut(&[u8]) -> Result<Vec<u8>, E>,
    ) -> Result<Vec<Figure>, E> {
        let positions: Vec<DVec3> = self.map.vertices.iter().map(|vertex| vertex.position).collect();
        let what = self.what();
        let (mut pictures, mut hidden) = (Vec::new(), Vec::new());
        for (toward, from) in OVERVIEWS {
            let camera = Camera::fitting(&positions, toward, SIZE);
            let raster = self.raster(&camera);
            let alt = format!("{what}, seen {from}");
            let (picture, is_hidden) = self.picture(&camera, &raster, alt, deflate)?;
            pictures.push(picture);
            if is_hidden {
                hidden.push(from);
            }
        }
        let [(_, one), (_, other)] = OVERVIEWS;
        let mut caption = format!("{what}{}, seen {one}, and {other}", self.sign_text());
        let worst = self.worst();
        if worst.is_some() {
            caption += ". The ring marks the worst place";
        }
        if !hidden.is_empty() {
            caption += &format!(", which is behind the surface seen {}", hidden.join(", and "));
        }
        let mut figures = vec![Figure { caption, pictures }];
        if let Some((worst, caption)) = worst {
            let (camera, raster) = self.approach(worst);
            let alt = format!("{what}, the worst place seen from near");
            let (picture, _) = self.picture(&camera, &raster, alt, deflate)?;
            figures.push(Figure { caption, pictures: vec![picture] });
        }
        Ok(figures)
    }

    /// Returns what is shown.
    fn what(&self) -> String {
        let what = if self.scale.is_absolute() { "Distance" } else { "Signed deviation" };
        let unit = self.unit.map_or_else(String::new, |unit| format!(", {unit}"));
        format!("{what} of {} from {}{unit}", self.names[0], self.names[1])
    }

    /// Returns what a sign stands for.
    fn sign_text(&self) -> String {
        match (self.scale.is_absolute(), self.signs) {
            (true, _) => String::new(),
            (_, Signs::Solid) => format!(" (negative inside the solid {})", self.names[1]),
            _ => format!(" (negative behind {}'s normals)", self.names[1]),
        }
    }

    /// Returns the vertex of the worst place with a sentence on it, if it is on this map and any colour.
    fn worst(&self) -> Option<(usize, String)> {
        let worst = self.map.worst().filter(|_| self.is_worst)?;
        let [signed, distance] = self.map.values[worst];
        if distance <= self.scale.floor() {
            return None;
        }
        let is_plain = self.scale.is_absolute() || signed.is_nan();
        let text = if is_plain {
            distance_text(distance, self.diagonal)
        } else {
            signed_text(signed, self.diagonal)
        };
        let at = self.map.vertices[worst].position.to_array();
        let at = at.map(|coordinate| distance_text(coordinate, self.diagonal)).join(", ");
        let unit = self.unit.map_or_else(String::new, |unit| format!(" {unit}"));
        Some((worst, format!("The worst place, from near: {text}{unit} at {at} of {}", self.names[0])))
    }

    /// Returns a camera near a vertex with what it sees: the first camera that sees the vertex from outside, from
    /// inside, or with less left in front of it.
    fn approach(&self, vertex: usize) -> (Camera, Raster) {
        let Vertex { position, .. } = self.map.vertices[vertex];
        let radius = (PLACE_RADIUS * self.diagonal).max(APPROACH_RADIUS * self.map.values[vertex][1]);
        let outwards = self.toward(vertex);
        let view = |(part, toward): (f64, DVec3)| {
            let mut camera = Camera::around(position, radius, toward, SIZE);
            camera.near *= part;
            let raster = self.raster(&camera);
            (camera, raster)
        };
        let views = NEAR_PARTS.into_iter().flat_map(|part| [(part, outwards), (part, -outwards)]);
        let mut shown = view((NEAR_PARTS[0], outwards));
        for next in views.skip(1) {
            let (camera, raster) = &shown;
            if raster.sees(camera, position, SLACK) {
                break;
            }
            shown = view(next);
        }
        shown
    }

    /// Returns the direction in which the surface at a vertex is seen: along its normal, outwards, and
    /// turned a little.
    fn toward(&self, vertex: usize) -> DVec3 {
        let Vertex { position, normal, .. } = self.map.vertices[vertex];
        let of_triangle = || {
            let corners =
                self.map.triangles.corners.iter().find(|corners| corners.contains(&(vertex as u32)));
            let [a, b, c] = corners?.map(|corner| self.map.vertices[corner as usize].position);
            (b - a).cross(c - a).try_normalize()
        };
        let normal = if normal == DVec3::ZERO { of_triangle().unwrap_or(DVec3::ZERO) } else { normal };
        let outwards = position - self.center();
        let normal = if normal.dot(outwards) < 0.0 { -normal } else { normal };
        let [(one, _), (other, _)] = OVERVIEWS;
        let turned = if normal.dot(one) >= 0.0 { one } else { other };
        normal + TURN * turned.normalize()
    }

    /// Returns the mean of the vertices.
    fn center(&self) -> DVec3 {
        let vertices = &self.map.vertices;
        vertices.iter().map(|vertex| vertex.position).sum::<DVec3>() / vertices.len().max(1) as f64
    }

    /// Returns a picture, with a ring around the worst place, and whether a surface hides that.
    fn picture<E>(
        &self,
        camera: &Camera,
        raster: &Raster,
        alt: String,
        deflate: &mut impl FnMut(&[u8]) -> Result<Vec<u8>, E>,
    ) -> Result<(Picture, bool), E> {
        let mut pixels = raster.pixels();
        let (mut place, mut is_hidden) = (None, false);
        if let Some((worst, _)) = self.worst() {
            let position = self.map.vertices[worst].position;
            let at = camera.project(position);
            mark::ring(&mut pixels, SIZE, [at.x, at.y]);
            is_hidden = !raster.sees(camera, position, SLACK);
            place = Some([at.x, at.y]);
        }
        let png = png::png(&pixels, SIZE, deflate)?;
        Ok((Picture { alt, size: SIZE, mark: place, png }, is_hidden))
    }

    /// Draws the map without the ring.
    fn raster(&self, camera: &Camera) -> Raster {
        let Map { vertices, values, triangles, .. } = self.map;
        let corner = |index: u32| {
            let Vertex { position, normal, .. } = vertices[index as usize];
            Corner { position, normal, value: values[index as usize] }
        };
        let table: Vec<[u8; 3]> = self.scale.stops(COLORS).collect();
        let color = |value: [f64; 2]| self.colored(&table, value);
        let mut raster = Raster::new(SIZE);
        for (corners, &face) in triangles.corners.iter().zip(&triangles.faces) {
            raster.triangle(camera, &corners.map(corner), face, &color);
        }
        if triangles.corners.is_empty() {
            for index in 0..vertices.len() as u32 {
                raster.point(camera, &corner(index), POINT_SIZE, &color);
            }
        }
        raster
    }

    /// Returns a colour of the scale by those of its parts.
    fn colored(&self, table: &[[u8; 3]], [signed, distance]: [f64; 2]) -> [u8; 3] {
        let (low, high, absolute) = (self.scale.low(), self.scale.high(), self.scale.is_absolute());
        if signed.is_nan() && !absolute {
            return self.scale.color(distance, false);
        }
        let value = if absolute { distance } else { signed };
        let index = ((value - low) / (high - low) * COLORS as f64) as usize;
        table[index.min(COLORS - 1)]
    }
}
