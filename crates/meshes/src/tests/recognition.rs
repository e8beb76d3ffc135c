//! Formats by content, whatever the name says, and the refusal of others by name.

use super::*;

#[test]
fn content_decides_before_the_name() {
    for (bytes, format, _) in files() {
        for name in ["model", "a.txt", "b.stl", "c.CSV"] {
            // Text of OBJ has no signature.
            if format != MeshFormat::Obj || name == "model" {
                assert_eq!(MeshFormat::of_file(&bytes, name), Ok(Some(format)), "{format:?} {name}");
            }
        }
    }
    for (text, format) in [
        ("1 2 3\n4 5 6\n", Some(MeshFormat::Text)),
        ("# scan\nx,y,z\n4,5,6\n", Some(MeshFormat::Text)),
        ("OFF\n3 1 0\n", Some(MeshFormat::Off)),
        ("# vtk DataFile Version 3.0\n", Some(MeshFormat::Vtk)),
        ("# .PCD v.7\nFIELDS x y z\nDATA ascii\n", Some(MeshFormat::Pcd)),
        ("<?xml version=\"1.0\"?><VTKFile type=\"PolyData\">", Some(MeshFormat::Vtk)),
        ("2\n1\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n", Some(MeshFormat::Ptx)),
        ("{\"surfaces\": []}", None),
        ("words alone\n", None),
    ] {
        assert_eq!(MeshFormat::of_file(text.as_bytes(), "model"), Ok(format), "{text}");
    }
    let step = b"ISO-10303-21;\nHEADER;\n";
    assert_eq!(MeshFormat::of_file(step, "part.txt"), Ok(None), "CAD models are not meshes");
}

#[test]
fn endings_are_known_in_any_case() {
    for name in ["A.OFF", "a.Vtp", "a.vtk", "a.pcd", "a.PTX", "a.txt", "a.xyzn", "b.c.Stl"] {
        assert!(MeshFormat::of_name(name).is_some(), "{name}");
    }
    assert_eq!(MeshFormat::of_name("a.step"), None);
}

#[test]
fn other_formats_are_refused_by_name() {
    for (bytes, name) in [
        (b"$MeshFormat\n4.1 0 8\n".as_slice(), "Gmsh"),
        (b"<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\">", "VTU"),
        (b"Kaydara FBX Binary  \0", "FBX"),
        (b"<?xml version=\"1.0\"?><COLLADA xmlns=\"x\">", "COLLADA"),
        (b"#VRML V2.0 utf8", "VRML"),
        (b"\x89HDF\r\n\x1a\n", "HDF5"),
        (b"\x93NUMPY\x01\0", "NumPy"),
    ] {
        let error = MeshFormat::of_file(bytes, "model.stl").unwrap_err();
        assert!(error.code() == "FORMAT_UNSUPPORTED" && error.to_string().contains(name), "{error}");
    }
}

/// Carriage returns end lines where nothing else does, and lines of OBJ are no points whatever the name.
#[test]
fn text_of_points_has_lines_of_points_alone() {
    let read = |text: &str| MeshFile::read(text.as_bytes(), MeshFormat::Text);
    let points = |text: &str| match read(text).unwrap().facets {
        Facets::Cloud(cloud) => cloud.points().len(),
        Facets::Mesh(_) => 0,
    };
    for text in ["0 0 0\r1 0 0\r0 1 0\r", "0 0 0\r\n1 0 0\r\n0 1 0", "A 0 0 0\nB 1 0 0\nf 0 1 0"] {
        assert_eq!(points(text), 3, "{text:?}");
    }
    for (unit, notes) in [("x [furlong]", 1), ("x [mm]", 0), ("x", 0)] {
        let file = read(&format!("{unit},y,z\n0,0,0\n1,0,0\n")).unwrap();
        assert_eq!((file.notes.len(), file.unit), (notes, None), "{unit}");
    }
    for rest in ["f 1 2 3", "vn 0 0 1"] {
        let error = read(&format!("v 0 0 0\nv 1 0 0\nv 0 1 0\n{rest}\n")).unwrap_err();
        assert!(error.to_string().contains("an element of OBJ"), "{error}");
    }
    assert_eq!(MeshFormat::of_file(b" {\"surfaces\": []}", "part.stl").unwrap(), None);
}
