//! The bodies of a model.

use super::PreparedModel;
use super::prepared::BodyParts;
use crate::facts::Orientation;
use crate::model::{face_path, level};
use serde::Serialize;
use std::collections::HashSet;

/// A body: an outer shell and its voids, a sheet, or a cloud of points.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct Body {
    /// The last name of its path, if it has one.
    pub name: Option<String>,
    /// The name that no other body of the model has, by which comparisons and checks call it: the names of its path,
    /// joined as those of a face are ([`crate::face_path`] splits them), else `body 1` by its number; equal names are
    /// numbered.
    pub full_name: String,
    /// The names of the levels that all its faces have, from the outermost; of a mesh, the name of the object.
    pub path: Vec<String>,
    /// What it is.
    pub kind: BodyKind,
    /// Whether every edge of its faces has a partner.
    pub closed: bool,
    /// How its faces are oriented; none of points.
    pub orientation: Option<Orientation>,
    /// The indices of its faces, in order: of a mesh, those of the objects that it has triangles of.
    pub faces: Vec<usize>,
    /// The number of its triangles, if it is one of a mesh.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub triangles: Option<usize>,
    /// The number of its points, if it is a cloud.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub points: Option<usize>,
    /// The number of its shells that are voids.
    pub voids: usize,
    /// The number of its edges without a partner.
    pub free_edges: usize,
}

/// The kind of a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum BodyKind {
    /// Its faces close, so that it has a volume.
    Solid,
    /// Its faces are open.
    Sheet,
    /// It consists of points.
    Points,
}

impl PreparedModel {
    /// Returns the bodies of the model, computed at first use.
    ///
    /// A body is a closed shell with its voids: of closed shells that are apart, one that lies within an odd
    /// number of others is a void of the innermost. Shells that meet are bodies that overlap. An open shell is a
    /// sheet, and a cloud one body of points. The triangles of a mesh that joined edges connect are one shell;
    /// of a mesh of more than 250,000 triangles only edges between the same two corners are joined.
    #[must_use]
    pub fn bodies(&self) -> Vec<Body> {
        if let Some(facets) = self.facets().filter(|facets| facets.target.is_cloud()) {
            return vec![Body {
                name: None,
                full_name: own_name(&[], 0),
                path: Vec::new(),
                kind: BodyKind::Points,
                closed: false,
                orientation: None,
                faces: vec![0],
                triangles: None,
                points: Some(facets.target.len()),
                voids: 0,
                free_edges: 0,
            }];
        }
        let mut taken = HashSet::new();
        let of_parts = |(index, parts)| {
            let body = self.body(index, parts);
            Body { full_name: unique_name(own_name(&body.path, index), &mut taken), ..body }
        };
        self.body_parts().iter().enumerate().map(of_parts).collect()
    }

    fn body(&self, index: usize, parts: &BodyParts) -> Body {
        let faces = self.faces_of(parts);
        let path = self.common_path(&faces);
        let free_edges = self.free_edges_of(parts);
        let closed = free_edges == 0;
        Body {
            name: path.last().cloned(),
            full_name: String::new(),
            path,
            kind: if closed { BodyKind::Solid } else { BodyKind::Sheet },
            closed,
            orientation: Some(self.measured_bodies()[index].orientation),
            faces,
            triangles: self.facets().map(|_| parts.shells.iter().map(|shell| shell.surfaces.len()).sum()),
            points: None,
            voids: parts.shells.len() - 1,
            free_edges,
        }
    }

    /// Returns the names of the levels that the names of all these faces begin with; the last level of a face of
    /// surfaces is its own.
    fn common_path(&self, faces: &[usize]) -> Vec<String> {
        let is_mesh = self.facets().is_some();
        let mut common: Option<Vec<String>> = None;
        for &face in faces {
            let mut path = self.face_name(face).map(face_path).unwrap_or_default();
            if !is_mesh {
                path.pop();
            }
            common = Some(match common {
                None => path,
                Some(known) => {
                    let same = known.iter().zip(&path).take_while(|(a, b)| a == b).count();
                    path.truncate(same);
                    path
                }
            });
            if common.as_ref().is_some_and(Vec::is_empty) {
                break;
            }
        }
        common.unwrap_or_default()
    }
}

/// Returns the joined names of the levels, or the number of a body without one.
fn own_name(path: &[String], index: usize) -> String {
    let levels: Vec<String> = path.iter().map(|name| level(name)).collect();
    if levels.is_empty() { format!("body {}", index + 1) } else { levels.join(" / ") }
}

/// Returns a name that no other body has: this one, with a number behind it where it is taken.
pub(in crate::engine) fn unique_name(name: String, taken: &mut HashSet<String>) -> String {
    let mut candidate = name.clone();
    let mut number = 1;
    while !taken.insert(candidate.clone()) {
        number += 1;
        candidate = format!("{name} ({number})");
    }
    candidate
}
