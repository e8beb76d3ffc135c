//! Bodies of models.

use crate::models::{
    Quad, box_of_faces, cuboid, faces, mesh, moved, of, of_quads, placed_all, prepared, quads_of_box,
};
use nurbs_hausdorff::shapes;
use nurbs_hausdorff::{
    BodyKind, DVec3, Facets, MeshGroup, Orientation, PointCloud, PreparedModel, TriangleMesh, VolumeUnknown,
};

fn orientations(model: &PreparedModel) -> Vec<Option<Orientation>> {
    model.bodies().iter().map(|body| body.orientation).collect()
}

/// A cube on another one. Edges within each miss each other by more than those of the sides of both, and those of the
/// lower one's top and the upper one's bottom.
fn stacked(shell_of: impl Fn(usize) -> Option<u32>) -> PreparedModel {
    const HIGHER: f64 = 4e-6;
    let lower = |quad: Quad| {
        let is_top = quad.iter().all(|corner| corner.z > 0.5);
        quad.map(|corner| if corner.z > 0.5 && !is_top { corner + HIGHER * DVec3::Z } else { corner })
    };
    let upper = |quad: Quad| {
        let is_bottom = quad.iter().all(|corner| corner.z < 0.5);
        let height = if is_bottom { 1.0 + 0.01 * HIGHER } else { 1.0 + 0.99 * HIGHER };
        quad.map(|corner| if corner.z < 0.5 { corner + height * DVec3::Z } else { corner + DVec3::Z })
    };
    let sides = quads_of_box(DVec3::ZERO, DVec3::ONE);
    let quads: Vec<Quad> = sides.iter().flat_map(|&side| [lower(side), upper(side)]).collect();
    let mut arrays = nurbs_hausdorff::ModelArrays { faces: faces(&of_quads(&quads)), ..Default::default() };
    for (index, face) in arrays.faces.iter_mut().enumerate() {
        face.shell = shell_of(index);
    }
    prepared(&nurbs_hausdorff::Model::from_faces(arrays).unwrap())
}

/// Edges that coincide within the gap do not join bodies that the source tells apart. Where it has no shells, or one for
/// each face, the nearest ones are joined: the sides of both cubes, and what lies between them.
#[test]
fn bodies_that_stand_flush_are_those_of_the_source() {
    let bodies = stacked(|face| Some((face % 2) as u32)).bodies();
    let faces: Vec<&[usize]> = bodies.iter().map(|body| body.faces.as_slice()).collect();
    assert_eq!(faces, [[0, 2, 4, 6, 8, 10], [1, 3, 5, 7, 9, 11]]);
    for body in &bodies {
        assert_eq!((body.kind, body.free_edges), (BodyKind::Solid, 0));
    }
    for shell_of in [|_| None, |face| Some(face as u32)] as [fn(usize) -> Option<u32>; 2] {
        let bodies = stacked(shell_of).bodies();
        let faces: Vec<&[usize]> = bodies.iter().map(|body| body.faces.as_slice()).collect();
        assert_eq!(faces, [&[0, 3, 4, 5, 6, 7, 8, 9, 10, 11][..], &[1, 2]]);
    }
}

/// Every use of a shell is one of its own.
#[test]
fn placed_shells_are_numbered_by_their_uses() {
    let mut arrays = nurbs_hausdorff::ModelArrays {
        faces: faces(&box_of_faces(DVec3::ZERO, DVec3::ONE)),
        ..Default::default()
    };
    arrays.faces.iter_mut().for_each(|face| face.shell = Some(9));
    arrays.faces[5].shell = None;
    let uses = [moved([0.0; 3]), moved([1.0, 0.0, 0.0])];
    arrays.instances = uses
        .map(|transform| nurbs_hausdorff::InstanceArrays {
            surfaces: (0..6).collect(),
            transform,
            name: None,
            solid: None,
        })
        .to_vec();
    let model = nurbs_hausdorff::Model::from_faces(arrays).unwrap();
    let shells = |model: &nurbs_hausdorff::Model| -> Vec<Option<u32>> {
        model.faces().map(|face| face.shell()).collect()
    };
    let of_use = |number| [[Some(number); 5].as_slice(), &[None]].concat();
    assert_eq!(shells(&model), [of_use(0), of_use(1)].concat());
    let read = nurbs_hausdorff::Model::from_json(&model.to_json().unwrap()).unwrap();
    assert_eq!(shells(&read), shells(&model));
}

/// Bodies with names, and a sheet between them.
#[test]
fn bodies_have_the_names_that_their_faces_have_in_common() {
    let cylinder = shapes::cylinder(1.0, 2.0).unwrap();
    let apart = moved([5.0, 0.0, 0.0]);
    let mut model = nurbs_hausdorff::ModelArrays::default();
    let both = placed_all(&[(&cylinder, moved([0.0; 3])), (&cylinder, apart)]);
    for (index, mut face) in faces(&both).into_iter().enumerate() {
        let body = ["pump / left", "pump / right // lid"][index / 3];
        face.face_name = Some(format!("{body} / face {index}"));
        model.faces.push(face);
    }
    model.faces.remove(5);
    let model = prepared(&nurbs_hausdorff::Model::from_faces(model).unwrap());
    let bodies = model.bodies();
    assert_eq!(bodies.len(), 2);
    assert_eq!((bodies[0].name.as_deref(), &bodies[0].faces), (Some("left"), &vec![0, 1, 2]));
    assert_eq!(bodies[1].path, ["pump", "right / lid"]);
    assert_eq!([bodies[0].kind, bodies[1].kind], [BodyKind::Solid, BodyKind::Sheet]);
    assert_eq!((bodies[0].free_edges, bodies[1].closed), (0, false));
    assert!(bodies[1].free_edges > 0);
}

/// Five boxes: three of one name, one without, and one that has the name of the second of them.
#[test]
fn equal_names_of_bodies_are_numbered_and_a_body_without_one_has_its_number() {
    let cuboid = faces(&box_of_faces(DVec3::ZERO, DVec3::ONE));
    let named =
        [Some("pump / bolt"), None, Some("pump / bolt"), Some("pump / bolt (2)"), Some("in // out / b")];
    let mut model = nurbs_hausdorff::ModelArrays::default();
    for (index, name) in named.into_iter().enumerate() {
        model.faces.extend(cuboid.iter().cloned().map(|mut face| {
            face.face_name = name.map(|name| format!("{name} / face"));
            face.surface.control_points.iter_mut().for_each(|point| point[0] += 2.0 * index as f64);
            face
        }));
    }
    let bodies = prepared(&nurbs_hausdorff::Model::from_faces(model).unwrap()).bodies();
    let names: Vec<&str> = bodies.iter().map(|body| body.full_name.as_str()).collect();
    assert_eq!(names, ["pump / bolt", "body 2", "pump / bolt (2)", "pump / bolt (2) (2)", "in // out / b"]);
}

/// As the shape has them, all turned over, and one of them.
#[test]
fn orientations_are_those_of_the_source() {
    let cylinder = faces(&shapes::cylinder(1.0, 2.0).unwrap());
    for (reversed, expected) in [
        ([false; 3], Orientation::Consistent),
        ([true; 3], Orientation::InsideOut),
        ([true, false, false], Orientation::Mixed),
    ] {
        let mut faces = cylinder.clone();
        faces.iter_mut().zip(reversed).for_each(|(face, reversed)| face.reversed = reversed);
        assert_eq!(orientations(&prepared(&of(faces))), [Some(expected)]);
    }
    let (vertices, mut triangles) = cuboid(DVec3::ZERO, DVec3::ONE);
    assert_eq!(orientations(&mesh(&vertices, &triangles)), [Some(Orientation::Consistent)]);
    triangles.iter_mut().for_each(|[a, b, _]| std::mem::swap(a, b));
    assert_eq!(orientations(&mesh(&vertices, &triangles)), [Some(Orientation::InsideOut)]);
    triangles[7].swap(0, 1);
    assert_eq!(orientations(&mesh(&vertices, &triangles)), [Some(Orientation::Mixed)]);
}

/// A strip of triangles that is turned by half and closed to a ring.
#[test]
fn a_strip_of_moebius_has_no_orientation() {
    let count = 24;
    let point = |index: u32, side: f64| {
        let angle = f64::from(index) / f64::from(count) * std::f64::consts::TAU;
        let reach = 3.0 + side * (0.5 * angle).cos();
        DVec3::new(reach * angle.cos(), reach * angle.sin(), side * (0.5 * angle).sin())
    };
    let vertices: Vec<DVec3> = (0..count).flat_map(|index| [point(index, -1.0), point(index, 1.0)]).collect();
    let quad = |index: u32| {
        let [a, b] = [2 * index, 2 * index + 1];
        let [c, d] = if index + 1 == count { [1, 0] } else { [a + 2, b + 2] };
        [[a, c, b], [b, c, d]]
    };
    let triangles: Vec<[u32; 3]> = (0..count).flat_map(quad).collect();
    let model = mesh(&vertices, &triangles);
    assert_eq!(orientations(&model), [Some(Orientation::NotOrientable)]);
    assert_eq!(model.facts().volume, None);
}

/// Two objects of a mesh, and a triangle of two corners, which is no body.
#[test]
fn bodies_of_a_mesh_are_its_connected_triangles() {
    let (mut vertices, mut triangles) = cuboid(DVec3::ZERO, DVec3::ONE);
    let (more, others) = cuboid(DVec3::splat(2.0), DVec3::splat(3.0));
    vertices.extend(more);
    triangles.extend(others.iter().map(|triangle| triangle.map(|corner| corner + 8)));
    triangles.push([0, 0, 15]);
    let mesh = TriangleMesh::new(&vertices, &triangles).unwrap();
    let group = |name: &str, triangles| MeshGroup { name: Some(name.to_owned()), triangles };
    let mesh = mesh.with_groups(vec![group("one", 12), group("other", 13)]).unwrap();
    let model = PreparedModel::of_facets(&Facets::Mesh(mesh), None).unwrap();
    let bodies = model.bodies();
    let names: Vec<_> = bodies.iter().map(|body| body.name.clone().unwrap()).collect();
    assert_eq!(
        (names.as_slice(), bodies[0].triangles),
        (&["one".to_owned(), "other".to_owned()][..], Some(12))
    );
    assert!((model.facts().volume.unwrap().middle() - 2.0).abs() < 1e-12);
}

#[test]
fn a_cloud_is_one_body_of_points() {
    let points = vec![DVec3::ZERO, DVec3::new(1.0, -2.0, 4.0), DVec3::new(0.5, 3.0, 0.0)];
    let model = PreparedModel::of_facets(&Facets::Cloud(PointCloud::new(points).unwrap()), None).unwrap();
    let body = &model.bodies()[0];
    assert_eq!((body.kind, body.points, body.orientation), (BodyKind::Points, Some(3), None));
    let facts = model.facts();
    assert_eq!(facts.volume_unknown, Some(VolumeUnknown::Points));
    for (extent, expected) in facts.extents.iter().zip([1.0, 5.0, 4.0]) {
        assert!(extent.contains(expected) && extent.width() < 1e-13);
    }
    assert_eq!(model.body_facts().len(), 1);
}

/// Boxes that meet are bodies of their own.
#[test]
fn bodies_that_overlap_are_no_voids() {
    let unit = box_of_faces(DVec3::ZERO, DVec3::ONE);
    let shifted = moved([0.25, 0.25, 0.25]);
    let half = [0.5, 0.0, 0.0, 0.0, 0.0, 0.5, 0.0, 0.0, 0.0, 0.0, 0.5, 0.0];
    let model = prepared(&placed_all(&[(&unit, moved([0.0; 3])), (&unit, shifted)]));
    assert_eq!(model.bodies().iter().map(|body| body.voids).collect::<Vec<_>>(), [0, 0]);
    // In a corner, the faces of the smaller one lie on those of the larger one.
    let model = prepared(&placed_all(&[(&unit, moved([0.0; 3])), (&unit, half)]));
    assert_eq!(model.bodies().iter().map(|body| body.voids).collect::<Vec<_>>(), [0, 0]);
}
