//! Vertices and triangles as a reader finds them.

use super::MeshFormat;
use super::polygons::{Cuts, MAX_CORNERS};
use glam::DVec3;
use nurbs_hausdorff::{FaceId, MeshGroup, Note, Result, Skipped, one_line};

/// The largest number of remarks on a file: more say nothing new.
const MAX_REMARKS: usize = 100;

/// The code of remarks on parts of a file that are not measured.
const NOT_MEASURED: &str = "NOT_MEASURED";

/// The code of remarks on polygons whose edges cross.
const POLYGON_CROSSES: &str = "POLYGON_CROSSES";

/// Vertices and triangles as they were read.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Soup {
    pub(super) vertices: Vec<DVec3>,
    pub(super) triangles: Vec<[u32; 3]>,
    /// The names of the groups, each with the number of triangles before it.
    groups: Vec<(Option<String>, usize)>,
    pub(super) unit: Option<f64>,
    cuts: Cuts,
    notes: Vec<Note>,
    skipped: Vec<Skipped>,
}

impl Soup {
    /// Returns one without content, in this unit.
    pub(super) fn in_unit(unit: Option<f64>) -> Self {
        Self { unit, ..Self::default() }
    }

    /// Begins a group; the triangles before the first one have no name.
    pub(super) fn begin_group(&mut self, name: Option<String>) {
        self.groups.push((name, self.triangles.len()));
    }

    /// Returns the groups that have triangles.
    pub(super) fn groups(&mut self) -> Vec<MeshGroup> {
        let begun = std::mem::take(&mut self.groups);
        let starts = std::iter::once((None, 0)).chain(begun);
        let mut groups: Vec<MeshGroup> = Vec::new();
        let mut before = (None, 0);
        for (name, start) in starts.chain([(None, self.triangles.len())]) {
            let (of, first) = std::mem::replace(&mut before, (name, start));
            if start > first {
                groups.push(MeshGroup { name: of, triangles: start - first });
            }
        }
        groups
    }

    /// Appends the triangles of a polygon, whose vertices must have been read.
    ///
    /// # Errors
    /// [`nurbs_hausdorff::Error::MeshSyntax`] for fewer than three corners, and for more than [`MAX_CORNERS`] of a polygon
    /// that its first corner does not see as a whole.
    pub(super) fn push_polygon(&mut self, corners: &[u32], format: MeshFormat) -> Result<()> {
        match *corners {
            [] | [_] | [_, _] => {
                return Err(format.syntax(format!("a face of {} corners, expected 3", corners.len())));
            }
            [a, b, c] => self.triangles.push([a, b, c]),
            _ if self.cuts.cut(corners, &self.vertices, &mut self.triangles) => {}
            _ => {
                let found = corners.len();
                return Err(
                    format.syntax(format!("a face of {found} corners, expected at most {MAX_CORNERS}"))
                );
            }
        }
        Ok(())
    }

    /// Says of a part of the file that it is none of the model, or how it was read.
    pub(super) fn note(&mut self, part: &str, why: impl Into<String>) {
        self.push_note(Note::new(FaceId::Name(one_line(part)), NOT_MEASURED, why.into()));
    }

    /// Says of so many bytes behind the elements that a file counts that they are not read: the count may be damaged.
    pub(super) fn note_rest(&mut self, bytes: usize) {
        if bytes > 0 {
            self.note("end", format!("{bytes} bytes after the last element that is counted are not read"));
        }
    }

    /// Appends a note.
    pub(super) fn push_note(&mut self, note: Note) {
        push_remark(&mut self.notes, note);
    }

    /// Says of a part of the model that it is not measured.
    pub(super) fn skip(&mut self, part: &str, why: impl Into<String>) {
        let face = FaceId::Name(one_line(part));
        self.push_skipped(Skipped::new(face, None, NOT_MEASURED, why.into()));
    }

    /// Appends a part that is not measured.
    pub(super) fn push_skipped(&mut self, part: Skipped) {
        push_remark(&mut self.skipped, part);
    }

    /// Returns the largest distance of a polygon's corner from its plane, the notes and the parts left out.
    pub(super) fn remarks(&mut self) -> (f64, Vec<Note>, Vec<Skipped>) {
        let Cuts { deviation, crossing } = self.cuts;
        if crossing > 0 {
            let why = format!("the edges of {crossing} cross: these are cut from their first corner");
            let face = FaceId::Name("polygons".to_owned());
            self.notes.push(Note::new(face, POLYGON_CROSSES, why));
        }
        (deviation, std::mem::take(&mut self.notes), std::mem::take(&mut self.skipped))
    }
}

/// Returns the triangles of a strip: each corner after the second one makes one with the two before it.
/// Every other one is turned over, as strips are.
pub(super) fn strip(corners: &[u32]) -> impl Iterator<Item = [u32; 3]> + '_ {
    corners.windows(3).enumerate().map(|(index, corner)| match index % 2 {
        0 => [corner[0], corner[1], corner[2]],
        _ => [corner[1], corner[0], corner[2]],
    })
}

fn push_remark<T: PartialEq>(remarks: &mut Vec<T>, remark: T) {
    if remarks.len() < MAX_REMARKS && !remarks.contains(&remark) {
        remarks.push(remark);
    }
}
