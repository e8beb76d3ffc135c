//! Files of one fault each, as strangers write them.

use super::*;
use nurbs_hausdorff::{FaceId, Facets};

fn points(text: impl AsRef<[u8]>) -> Vec<[f64; 3]> {
    match MeshFile::read(text.as_ref(), MeshFormat::Text).unwrap().facets {
        Facets::Cloud(cloud) => cloud.points().iter().map(|point| point.to_array()).collect(),
        Facets::Mesh(mesh) => panic!("{mesh:?}"),
    }
}

fn refusal(bytes: impl AsRef<[u8]>, format: MeshFormat) -> String {
    MeshFile::read(bytes.as_ref(), format).unwrap_err().to_string()
}

#[test]
fn a_file_has_one_separator_and_one_decimal_mark() {
    assert_eq!(points("x;y;z\n0,5;0;0\n1,5;0;0\n"), [[0.5, 0.0, 0.0], [1.5, 0.0, 0.0]]);
    assert_eq!(points("0,5 0,25 -1\n1 2,5 3\n"), [[0.5, 0.25, -1.0], [1.0, 2.5, 3.0]]);
    assert_eq!(points("0,5\t0\t1\n1,5\t0\t1\n"), [[0.5, 0.0, 1.0], [1.5, 0.0, 1.0]]);
    assert_eq!(points("\"0,5\",\"1,5\",\"2,5\"\n"), [[0.5, 1.5, 2.5]]);
    assert_eq!(points("1, 2, 3\n4, 5, 6\n"), [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]);
    assert_eq!(points("1;2;3;\"a, b\"\n"), [[1.0, 2.0, 3.0]]);
    for (text, found) in [
        ("1;2;3\n4,5,6\n", "line 2"),
        ("0,5;1.5;2\n", "line 1"),
        ("1.234,5;1;1\n", "line 1"),
        ("x,y,z\n0,5,1,5,2,5\n", "6 values, expected 3"),
        ("1,2,3\n1,2,3,4\n", "line 2: 4 values, expected 3"),
        ("\"x\" \"y\" \"z\"\n\"1\" 5 6 7\n", "line 2: 4 values, expected 3"),
        ("1 2 3\n1,5 2 3\n4.5 1 1\n", "line 3"),
    ] {
        let refusal = refusal(text, MeshFormat::Text);
        assert!(refusal.contains(found), "{text:?}: {refusal}");
    }
}

#[test]
fn empty_cells_keep_their_columns() {
    let text = "id,x,y,z,intensity\n1,10,20,30,99\n,11,21,31,98\n";
    assert_eq!(points(text), [[10.0, 20.0, 30.0], [11.0, 21.0, 31.0]]);
    assert!(refusal("x,y,z\n1,2,3\n1,,3\n", MeshFormat::Text).contains("line 3"));
}

#[test]
fn names_of_columns_count_in_all_their_spellings() {
    for names in [
        "# id x y z",
        "//id,X,Y,Z",
        "# columns: id x y z",
        "id;Easting;Northing;Elevation",
        "id,X [m],Y [m],Z [m]",
        "id,\"Points:0\",\"Points:1\",\"Points:2\"",
        "id\tpos_x\tpos_y\tpos_z",
    ] {
        let mark = [';', ',', '\t'].into_iter().find(|mark| names.contains(*mark)).unwrap_or(' ');
        let rows = "7 10 20 30\n8 11 21 31\n".replace(' ', &mark.to_string());
        let expected = [[10.0, 20.0, 30.0], [11.0, 21.0, 31.0]];
        assert_eq!(points(format!("{names}\n{rows}")), expected, "{names}");
    }
    assert_eq!(points("x,y,z,height\n1,2,3,4\n"), [[1.0, 2.0, 3.0]], "plain names come first");
    // Prose of more words than columns, and names that are none.
    assert_eq!(points("# a file with x y z of a scan\n1 2 3\n"), [[1.0, 2.0, 3.0]]);
    assert!(refusal("lat,lon,depth\n1,2,3\n", MeshFormat::Text).contains("found the columns \"lat\""));
    assert!(refusal("x,x,y,z\n1,2,3,4\n", MeshFormat::Text).contains("one each"));
}

#[test]
fn a_unit_in_the_names_of_columns_is_that_of_the_points() {
    let unit = |text: &str| MeshFile::read(text.as_bytes(), MeshFormat::Text).unwrap().unit;
    assert_eq!(unit("X [mm],Y [mm],Z [mm]\n1,2,3\n"), Some(1e-3));
    assert_eq!(unit("X [mm],Y [mm],Z\n1,2,3\n"), None);
    assert!(refusal("X [mm],Y [mm],Z [m]\n1,2,3\n", MeshFormat::Text).contains("units that differ"));
    assert_eq!(unit("x,y,z\n1,2,3\n"), None);
}

#[test]
fn labels_may_stand_in_the_first_column() {
    assert_eq!(points("P1 1 2 3\nP2 4 5 6\n"), [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]);
    assert_eq!(points("P1,1,2,3\n17,4,5,6\n"), [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]);
    assert!(refusal("P1 1 2 3\n4 5 6\n", MeshFormat::Text).contains("line 2"));
}

#[test]
fn marks_of_unicode_are_no_content() {
    assert_eq!(points("\u{feff}x,y,z\n1,2,3\n"), [[1.0, 2.0, 3.0]]);
    let utf16: Vec<u8> = "\u{feff}1\t2\t3\r\n".encode_utf16().flat_map(u16::to_le_bytes).collect();
    assert_eq!(points(utf16), [[1.0, 2.0, 3.0]]);
    let file = MeshFile::read(b"\xef\xbb\xbfv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", MeshFormat::Obj).unwrap();
    assert!(matches!(file.facets, Facets::Mesh(_)));
}

#[test]
fn scans_follow_each_other_in_pts() {
    let text = "2\n0 0 0\n1 0 0\n2\n0 1 0\n0 0 1\n";
    assert_eq!(points(text), [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    for (text, found) in [
        ("2\n0 0 0\n1 0 0\n2\n0 1 0\n", "1 points, expected 2"),
        ("1\n0 0 0\n1 0 0\n", "more points than the 1"),
        ("0 0 0\n1\n0 0 0\n", "expected three coordinates"),
    ] {
        assert!(refusal(text, MeshFormat::Text).contains(found), "{text:?}");
    }
}

#[test]
fn words_of_stl_are_known_in_any_case() {
    let text = String::from_utf8(text_stl()).unwrap().to_ascii_uppercase();
    assert_eq!(read_mesh(text.as_bytes(), MeshFormat::Stl).0, tetrahedron());
}

#[test]
fn bytes_after_the_last_triangle_are_noted() {
    for header in [b"exported".as_slice(), b"solid of a binary file"] {
        let bytes = [binary_stl(header), b"\n\n".to_vec()].concat();
        assert_eq!(read_mesh(&bytes, MeshFormat::Stl).0, tetrahedron());
        let file = MeshFile::read(&bytes, MeshFormat::Stl).unwrap();
        assert!(file.notes[0].why.contains("2 bytes"), "{:?}", file.notes);
    }
    let short = &binary_stl(b"exported")[..200];
    assert!(refusal(short, MeshFormat::Stl).contains("200 bytes, expected 284"));
}

#[test]
fn lines_and_points_of_obj_are_no_surface() {
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 5 5 5\nv 9 9 0\nf 1 2 3\nl 3 4 5\np 4 5 1\n";
    let file = MeshFile::read(obj.as_bytes(), MeshFormat::Obj).unwrap();
    assert_eq!((groups_of(&file), noted(&file)), (vec![1], vec!["l".to_owned(), "p".to_owned()]));
    let formula = MeshFile::read(format!("{obj}surf 0 1 0 1 1 2 3 4\n").as_bytes(), MeshFormat::Obj).unwrap();
    assert_eq!(formula.skipped[0].face, FaceId::Name("surf".to_owned()));
    assert!(MeshFile::read(b"v 0 0 0\nv 1 0 0\nl 1 2\n", MeshFormat::Obj).is_err());
}

/// `fo` is the older word for a face; patches and other files are named as left out.
#[test]
fn older_statements_of_obj_are_read_or_named() {
    let obj = "v 0 0 0 # a corner\nv 1 0 0\nv 1 1 0# and\nv 0 1 0\nfo 1 2 3\nf 1 3 4 # the rest\n";
    let file = MeshFile::read(obj.as_bytes(), MeshFormat::Obj).unwrap();
    assert_eq!((groups_of(&file), file.skipped.len()), (vec![2], 0));
    for (word, statement) in [("surf", "bzp 1 2 3 4"), ("surf", "cdp 1 2 3 4"), ("call", "call other.obj")] {
        let file = MeshFile::read(format!("{obj}{statement}\n").as_bytes(), MeshFormat::Obj).unwrap();
        assert_eq!(file.skipped[0].face, FaceId::Name(word.to_owned()));
    }
}

/// Any white space parts the words of STL as text; a name is the rest of its line.
#[test]
fn lines_of_stl_as_text_may_be_parted_anywhere() {
    let loop_ = |x: f64| format!("outer loop vertex 0 0 0 vertex {x} 0 0\nvertex 0\n1 0 endloop endfacet");
    let facets = [1.0, 2.0].map(|x| format!("facet normal 0 0\n1 {}", loop_(x))).join(" ");
    for text in [
        format!("solid {facets} endsolid"),
        format!("solid of a facet 12\n{facets}\nendsolid of a facet 12\n"),
        format!("SOLID\n{}\nEndSolid a solid b\n", facets.replace("0 0\n1", "-nan(ind) 0 1 ")),
        format!("solid one {facets} endsolid one solid two endsolid"),
        format!("solid {} endsolid", facets.replacen("endfacet ", "endfacet endsolid ", 1)),
    ] {
        let file = MeshFile::read(text.as_bytes(), MeshFormat::Stl).unwrap();
        assert_eq!(groups_of(&file), [2], "{text}");
    }
    let without_loops = "solid facet normal 0 0 1 vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endfacet endsolid";
    assert!(MeshFile::read(without_loops.as_bytes(), MeshFormat::Stl).is_err());
}

#[test]
fn a_backslash_continues_a_line_of_obj() {
    let obj = "# C:\\models\\\nv 0 0 \\\n 0\nv 2 0 0 # C:\\\r\nv 0 2 0\nf 1 \\\r\n2 3\n";
    let file = MeshFile::read(obj.as_bytes(), MeshFormat::Obj).unwrap();
    assert_eq!(groups_of(&file), [1]);
}

#[test]
fn strips_of_ply_are_triangles() {
    let head = "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n\
                element tristrips 1\nproperty list int int vertex_indices\nend_header\n";
    let vertices = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 0 1\n";
    let read =
        |strip: &str| match MeshFile::read(format!("{head}{vertices}{strip}\n").as_bytes(), MeshFormat::Ply)
            .unwrap()
            .facets
        {
            Facets::Mesh(mesh) => mesh.triangles().to_vec(),
            Facets::Cloud(_) => panic!("a mesh"),
        };
    assert_eq!(read("4 0 1 2 3"), [[0, 1, 2], [2, 1, 3]]);
    assert_eq!(read("8 0 1 2 3 -1 0 1 4"), [[0, 1, 2], [2, 1, 3], [0, 1, 4]]);
}

/// Faces may stand before their vertices.
#[test]
fn faces_of_ply_may_come_first() {
    let ply = "ply\nformat ascii 1.0\nelement face 1\nproperty list int int vertex_indices\nelement vertex 4\n\
               property float x\nproperty float y\nproperty float z\nend_header\n4 0 1 2 3\n0 0 0\n3 0 0\n1 1 0\n0 3 0\n";
    let file = MeshFile::read(ply.as_bytes(), MeshFormat::Ply).unwrap();
    let Facets::Mesh(mesh) = file.facets else { panic!("a mesh") };
    assert_eq!(mesh.triangles().len(), 2);
}

/// A reader may not know an element, but faces by another name are no cloud of their vertices.
#[test]
fn vertex_indices_of_other_elements_of_ply_are_named() {
    let vertices = "0 0 0\n1 0 0\n0 1 0\n";
    let head =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
    let list = |element: &str, name: &str| format!("element {element} 1\nproperty list uchar int {name}\n");
    for name in ["vertex_indices", "vertex_index"] {
        let alone = format!("{head}{}end_header\n{vertices}3 0 1 2\n", list("triangle", name));
        assert!(refusal(alone, MeshFormat::Ply).contains("1 elements \"triangle\""));
        let both = list("face", name) + &list("triangle", name);
        let both = format!("{head}{both}end_header\n{vertices}3 0 1 2\n3 0 1 2\n");
        let file = MeshFile::read(both.as_bytes(), MeshFormat::Ply).unwrap();
        assert_eq!((groups_of(&file), file.skipped[0].face.to_string().as_str()), (vec![1], "triangle"));
    }
}

/// Comments have the code page of whoever wrote them, in every format of text.
#[test]
fn comments_may_be_no_unicode() {
    let obj = [b"# caf\xe9\ng caf\xe9\n".as_slice(), &obj()].concat();
    assert_eq!(read_mesh(&obj, MeshFormat::Obj).0, tetrahedron());
    for encoding in ["ascii", "binary_little_endian"] {
        let ply = ply(encoding);
        let comment = b"comment caf\xe9\n";
        let at = ply.iter().position(|&byte| byte == b'\n').unwrap() + 1;
        let commented = [&ply[..at], comment, &ply[at..]].concat();
        assert_eq!(read_mesh(&commented, MeshFormat::Ply).0, tetrahedron());
    }
    let marked = [b"\xef\xbb\xbf".as_slice(), &text_stl()].concat();
    assert_eq!(read_mesh(&marked, MeshFormat::Stl).0, tetrahedron());
    assert_eq!(MeshFormat::of_file(&marked, "model"), Ok(Some(MeshFormat::Stl)));
}

/// The number of a message is the one in the file.
#[test]
fn indices_of_no_vertex_are_refused_as_they_are() {
    let ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
               element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -7\n";
    assert!(refusal(ply, MeshFormat::Ply).contains("the vertex -7"));
    let xml = three_mf_xml().replacen("v1=\"0\"", "v1=\"99\"", 1);
    assert!(refusal(zipped(&xml), MeshFormat::ThreeMf).contains("found vertex 99, expected less than 4"));
    let vtk = |corner: &str| {
        format!(
            "# vtk DataFile Version 3.0\n\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n0 0 0 1 0 0 0 1 0\n\
             POLYGONS 1 4\n3 0 1 {corner}\n"
        )
    };
    assert!(refusal(vtk("99"), MeshFormat::Vtk).contains("the point 99 of 3"));
    assert!(refusal(vtk("-1"), MeshFormat::Vtk).contains("a point of no number"));
}

/// Also those of vertices that no face has.
#[test]
fn coordinates_of_obj_that_are_not_finite_are_refused() {
    let with = |vertex: &str| format!("v 0 0 0\nv 1 0 0\nv 0 1 0\n{vertex}\nf 1 2 3\n");
    let long = format!("v 0 1{} 0", "0".repeat(400));
    for vertex in ["v nan 0 0", "v 0 inf 0", "v 0 0 -Infinity", "v 1e999 0 0 # far", long.as_str()] {
        assert!(refusal(with(vertex), MeshFormat::Obj).contains("finite"), "{vertex}");
    }
    // A texture's third coordinate and a colour are no place.
    let others = with("v 1e5 2E-3 0 nan\nvt 0 0 nan");
    assert!(MeshFile::read(others.as_bytes(), MeshFormat::Obj).is_ok());
}
