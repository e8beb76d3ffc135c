//! One tetrahedron in every format, and damage.

mod faults;
mod polygons;
mod recognition;
mod scenes;
mod small;
mod vtp;

use super::*;
use glam::DVec3;
use nurbs_hausdorff::MeshGroup;
use std::io::Write;

const VERTICES: [[f64; 3]; 4] = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 0.625]];
const TRIANGLES: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];

/// The corners of all triangles, which do not depend on the order of the vertices.
fn corners(mesh: &TriangleMesh) -> Vec<[[f64; 3]; 3]> {
    (0..mesh.triangles().len())
        .map(|triangle| mesh.corners(triangle).map(|corner| corner.to_array()))
        .collect()
}

fn read_mesh(bytes: &[u8], format: MeshFormat) -> (Vec<[[f64; 3]; 3]>, Option<f64>) {
    let MeshFile { facets, unit, .. } = MeshFile::read(bytes, format).unwrap();
    let Facets::Mesh(mesh) = facets else { panic!("a mesh") };
    assert_eq!(mesh.vertices().len(), 4, "equal vertices are joined");
    (corners(&mesh), unit)
}

/// The names of the parts that are noted.
fn noted(file: &MeshFile) -> Vec<String> {
    file.notes.iter().map(|note| note.face.to_string()).collect()
}

/// The numbers of triangles of the groups.
fn groups_of(file: &MeshFile) -> Vec<usize> {
    match &file.facets {
        Facets::Mesh(mesh) => mesh.groups().iter().map(|group| group.triangles).collect(),
        Facets::Cloud(_) => panic!("a mesh"),
    }
}

fn tetrahedron() -> Vec<[[f64; 3]; 3]> {
    TRIANGLES.map(|triangle| triangle.map(|vertex| VERTICES[vertex as usize])).to_vec()
}

fn binary_stl(header: &[u8]) -> Vec<u8> {
    let mut bytes = header.to_vec();
    bytes.resize(80, b' ');
    bytes.extend((TRIANGLES.len() as u32).to_le_bytes());
    for corners in tetrahedron() {
        bytes.extend([0; 12]);
        bytes.extend(corners.as_flattened().iter().flat_map(|&number| (number as f32).to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}

fn text_stl() -> Vec<u8> {
    let mut text = "solid a vertex of names\n".to_owned();
    for corners in tetrahedron() {
        text += "facet normal 0 0 0\n outer loop\n";
        for [x, y, z] in corners {
            text += &format!("  vertex {x} {y:e} {z}\n");
        }
        text += " endloop\nendfacet\n";
    }
    (text + "endsolid a vertex of names\n").into_bytes()
}

fn ply(encoding: &str) -> Vec<u8> {
    let mut bytes = format!(
        "ply\nformat {encoding} 1.0\nelement vertex 4\nproperty float confidence\nproperty double x\nproperty double y\n\
         property double z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n"
    )
    .into_bytes();
    let is_big = encoding == "binary_big_endian";
    if encoding == "ascii" {
        for [x, y, z] in VERTICES {
            writeln!(bytes, "0.5 {x} {y} {z}").unwrap();
        }
        for [a, b, c] in TRIANGLES {
            writeln!(bytes, "3 {a} {b} {c}").unwrap();
        }
        return bytes;
    }
    for vertex in VERTICES {
        bytes.extend(if is_big { 0.5_f32.to_be_bytes() } else { 0.5_f32.to_le_bytes() });
        for number in vertex {
            bytes.extend(if is_big { number.to_be_bytes() } else { number.to_le_bytes() });
        }
    }
    for triangle in TRIANGLES {
        bytes.push(3);
        bytes.extend(
            triangle.iter().flat_map(|index| if is_big { index.to_be_bytes() } else { index.to_le_bytes() }),
        );
    }
    bytes
}

fn obj() -> Vec<u8> {
    let mut text = "# comment\no first\n".to_owned();
    for [x, y, z] in VERTICES {
        text += &format!("v {x} {y} {z}\n");
    }
    text += "vn 0 0 1\n";
    for (index, [a, b, c]) in TRIANGLES.into_iter().enumerate() {
        let [a, b, c] = [a, b, c].map(|corner| i64::from(corner) + 1);
        text += &if index == 3 {
            format!("g second\nf {} {} {}\n", a - 5, b - 5, c - 5)
        } else {
            format!("f {a}//1 {b}//1 {c}//1\n")
        };
    }
    text.into_bytes()
}

/// The tetrahedron half as large and moved by (-1, 0, 0), in a scene that doubles it and moves it back.
fn gltf_json(uri: &str) -> String {
    format!(
        r#"{{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [1]}}],
        "nodes": [{{"mesh": 0, "name": "placed", "translation": [2, 0, 0]}}, {{"children": [0], "matrix": [2,0,0,0, 0,2,0,0, 0,0,2,0, -2,0,0,1]}}],
        "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}, "indices": 1}}]}}],
        "accessors": [{{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"}},
            {{"bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR"}}],
        "bufferViews": [{{"buffer": 0, "byteLength": 48}}, {{"buffer": 0, "byteOffset": 48, "byteLength": 24}}],
        "buffers": [{{"byteLength": 72{uri}}}]}}"#
    )
}

fn gltf_buffer() -> Vec<u8> {
    let moved = VERTICES.map(|[x, y, z]| [0.5 * x - 1.0, 0.5 * y, 0.5 * z]);
    let mut buffer: Vec<u8> =
        moved.as_flattened().iter().flat_map(|&number| (number as f32).to_le_bytes()).collect();
    buffer.extend(TRIANGLES.as_flattened().iter().flat_map(|&index| (index as u16).to_le_bytes()));
    buffer
}

fn gltf() -> Vec<u8> {
    use base64::Engine;
    let data = base64::engine::general_purpose::STANDARD.encode(gltf_buffer());
    gltf_json(&format!(r#", "uri": "data:application/octet-stream;base64,{data}""#)).into_bytes()
}

fn glb() -> Vec<u8> {
    let mut json = gltf_json("").into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let buffer = gltf_buffer();
    let mut bytes = b"glTF\x02\0\0\0".to_vec();
    bytes.extend((28 + json.len() as u32 + buffer.len() as u32).to_le_bytes());
    for (kind, chunk) in [(b"JSON", &json), (b"BIN\0", &buffer)] {
        bytes.extend((chunk.len() as u32).to_le_bytes());
        bytes.extend(kind);
        bytes.extend(chunk);
    }
    bytes
}

/// The tetrahedron moved by (0, 0, -1) in an object, which a component moves back by half and an
/// item by the rest.
fn three_mf_xml() -> String {
    let vertices: String =
        VERTICES.map(|[x, y, z]| format!(r#"<vertex x="{x}" y="{y}" z="{}"/>"#, z - 1.0)).concat();
    let triangles: String =
        TRIANGLES.map(|[a, b, c]| format!(r#"<triangle v1="{a}" v2="{b}" v3="{c}" pid="7"/>"#)).concat();
    format!(
        r#"<?xml version="1.0" encoding="UTF-8"?><model unit="inch" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02">
        <resources><object id="1" type="model" name="part"><mesh><vertices>{vertices}</vertices><triangles>{triangles}</triangles></mesh></object>
        <object id="2"><components><component objectid="1" transform="1 0 0 0 1 0 0 0 1 0 0 0.5"/></components></object></resources>
        <build><item objectid="2" transform="1 0 0 0 1 0 0 0 1 0 0 0.5"/></build></model>"#
    )
}

fn three_mf() -> Vec<u8> {
    zipped(&three_mf_xml())
}

/// An archive of this model.
fn zipped(xml: &str) -> Vec<u8> {
    packed(&[("3D/3dmodel.model", xml)])
}

/// An archive of files.
fn packed(files: &[(&str, &str)]) -> Vec<u8> {
    let mut writer = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    for (name, content) in files {
        writer.start_file(*name, zip::write::SimpleFileOptions::default()).unwrap();
        writer.write_all(content.as_bytes()).unwrap();
    }
    writer.finish().unwrap().into_inner()
}

/// Every file of the tetrahedron, with its format and unit.
fn files() -> Vec<(Vec<u8>, MeshFormat, Option<f64>)> {
    let mut files = vec![
        (binary_stl(b"exported"), MeshFormat::Stl, None),
        (binary_stl(b"solid of a binary file"), MeshFormat::Stl, None),
        (text_stl(), MeshFormat::Stl, None),
        (obj(), MeshFormat::Obj, None),
        (gltf(), MeshFormat::Gltf, Some(1.0)),
        (glb(), MeshFormat::Gltf, Some(1.0)),
        (three_mf(), MeshFormat::ThreeMf, Some(0.0254)),
    ];
    for encoding in ["ascii", "binary_little_endian", "binary_big_endian"] {
        files.push((ply(encoding), MeshFormat::Ply, None));
    }
    files
}

#[test]
fn every_format_gives_the_same_mesh() {
    for (bytes, format, unit) in files() {
        assert_eq!(read_mesh(&bytes, format), (tetrahedron(), unit), "{format:?}");
    }
}

/// Text has more digits than float32 holds.
#[test]
fn text_is_read_in_float64() {
    let number = 1.000_000_000_123;
    let text = String::from_utf8(text_stl()).unwrap().replace("0.625", &number.to_string());
    assert_eq!(read_mesh(text.as_bytes(), MeshFormat::Stl).0[1][2][2], number);
    let text = String::from_utf8(obj()).unwrap().replace("0.625", &number.to_string());
    assert_eq!(read_mesh(text.as_bytes(), MeshFormat::Obj).0[1][2][2], number);
}

#[test]
fn points_are_read_as_a_cloud() {
    let cloud = |text: &str, format| match MeshFile::read(text.as_bytes(), format).unwrap().facets {
        Facets::Cloud(cloud) => cloud.points().to_vec(),
        Facets::Mesh(mesh) => panic!("{mesh:?}"),
    };
    let expected = [DVec3::new(1.0, 2.0, 3.0), DVec3::new(-4.0, 5e-3, 6.0)];
    for text in [
        "1 2 3\n-4 5e-3 6\n",
        "# a comment\n1,2,3\r\n-4,0.005,6\r\n",
        "2\n1 2 3 17 255 0 0\n-4 0.005 6 17 255 0 0\n",
        "id;Z;\"x\";y\n7;3;1;2\n8;6;-4;0.005\n",
    ] {
        assert_eq!(cloud(text, MeshFormat::Text), expected, "{text}");
    }
    let ply = "ply\nformat ascii 1.0\nelement vertex 2\nproperty double x\nproperty double y\nproperty double z\nend_header\n1 2 3\n-4 0.005 6\n";
    assert_eq!(cloud(ply, MeshFormat::Ply), expected);
    for text in ["1 2\n", "3\n1 2 3\n", "", "1 2 3\nx y z\n"] {
        assert!(MeshFile::read(text.as_bytes(), MeshFormat::Text).is_err(), "{text}");
    }
}

#[test]
fn convex_polygons_are_cut_from_their_first_corner() {
    let obj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
    let MeshFile { facets: Facets::Mesh(mesh), .. } =
        MeshFile::read(obj.as_bytes(), MeshFormat::Obj).unwrap()
    else {
        panic!("a mesh")
    };
    assert_eq!(mesh.triangles(), [[0, 1, 2], [0, 2, 3]]);
}

/// A seed of the fuzzing, without the byte before it that names the format. The scans are of
/// `benches/trimmed/scan_samples.py`.
macro_rules! seed {
    ($name:literal) => {
        &include_bytes!(concat!("../../../../tests/soundness/fuzz/seeds/mesh_file/", $name))[1..]
    };
}

/// Two scans of libE57Format. The first is turned from x to y to z and moved, and every fifth point
/// of it is invalid.
#[test]
fn scans_are_placed_by_their_poses() {
    let MeshFile { facets: Facets::Cloud(cloud), unit, .. } =
        MeshFile::read(seed!("scans/scans-e57"), MeshFormat::E57).unwrap()
    else {
        panic!("a cloud")
    };
    let integers = |k: i32| [k * k * 37 % 2003 - 900, 31 * k % 83, k % 7 - 3].map(f64::from);
    let turned = (0..40).filter(|k| k % 5 != 0).map(integers).map(|[x, y, z]| [z + 10.0, x + 20.0, y + 30.0]);
    let expected: Vec<DVec3> = turned.chain((0..40).map(integers)).map(DVec3::from).collect();
    assert_eq!((cloud.points(), unit), (expected.as_slice(), Some(1.0)));
}

/// The bytes of an E57 file with parts of its XML replaced by others and blanks, and with checksums
/// (CRC-32C of RFC 3720) that fit.
fn e57_with(replaced: &[(&str, &str)]) -> Vec<u8> {
    let pages = seed!("scans/scans-e57").chunks(1024);
    let mut content: Vec<u8> = pages.flat_map(|page| &page[..1020]).copied().collect();
    for (part, other) in replaced {
        let place = content.windows(part.len()).position(|found| found == part.as_bytes()).unwrap();
        let other = format!("{other:0$}", part.len());
        content[place..place + part.len()].copy_from_slice(other.as_bytes());
    }
    let checksum = |page: &[u8]| {
        !page.iter().fold(u32::MAX, |sum, &byte| {
            (0..8).fold(sum ^ u32::from(byte), |sum, _| (sum >> 1) ^ ((sum & 1) * 0x82f6_3b78))
        })
    };
    content.chunks(1020).flat_map(|page| [page, &checksum(page).to_be_bytes()].concat()).collect()
}

/// The crate would take memory for XML as long as stated, and make values without end of fields that
/// take no bits.
#[test]
fn scans_of_endless_sizes_are_refused() {
    let refusal = |bytes: &[u8]| MeshFile::read(bytes, MeshFormat::E57).unwrap_err().to_string();
    assert!(MeshFile::read(&e57_with(&[]), MeshFormat::E57).is_ok());
    let mut long_xml = seed!("scans/scans-e57").to_vec();
    long_xml[32..40].copy_from_slice(&(1_u64 << 20).to_le_bytes());
    assert!(refusal(&long_xml).contains("bytes of XML"), "{}", refusal(&long_xml));
    let no_bits = r#"type="Integer" minimum="0" maximum="0""#;
    let file = e57_with(&[
        (r#"type="Float" precision="single" minimum="-8.63e+02" maximum="1.073e+03""#, no_bits),
        (r#"type="Float" precision="single" minimum="7" maximum="8.2e+01""#, no_bits),
        (r#"type="Float" precision="single" minimum="-3" maximum="3""#, no_bits),
        (r#"type="Integer" minimum="0" maximum="2""#, no_bits),
    ]);
    assert!(refusal(&file).contains("points of 4 fields"), "{}", refusal(&file));
    for count in ["41", "99"] {
        let more = e57_with(&[(r#"recordCount="40""#, &format!(r#"recordCount="{count}""#))]);
        assert!(refusal(&more).contains("E57"), "{}", refusal(&more));
    }
}

/// A thousand damaged files of every kind: what is read is valid, and nothing panics.
#[test]
fn damaged_files_are_refused_or_valid() {
    let random = &mut fastrand::Rng::with_seed(5);
    let mut refused = 0;
    let scans = [
        (seed!("scans/points-las").to_vec(), MeshFormat::Las, None),
        (seed!("scans/points-laz").to_vec(), MeshFormat::Las, None),
        (seed!("scans/layers-laz").to_vec(), MeshFormat::Las, None),
        (seed!("scans/scans-e57").to_vec(), MeshFormat::E57, None),
        (seed!("triangles/off").to_vec(), MeshFormat::Off, None),
        (seed!("triangles/vtk").to_vec(), MeshFormat::Vtk, None),
        (seed!("scenes/vtp").to_vec(), MeshFormat::Vtk, None),
        (seed!("points/pcd").to_vec(), MeshFormat::Pcd, None),
        (seed!("points/ptx").to_vec(), MeshFormat::Ptx, None),
        (seed!("points/csv").to_vec(), MeshFormat::Text, None),
        (seed!("triangles/l-obj").to_vec(), MeshFormat::Obj, None),
    ];
    for (bytes, format, _) in files().into_iter().chain(scans) {
        for _ in 0..1000 {
            let mut damaged = bytes.clone();
            match random.u32(0..4) {
                0 => damaged.truncate(random.usize(0..bytes.len())),
                1 => {
                    let place = random.usize(0..bytes.len());
                    damaged[place..].iter_mut().take(4).for_each(|byte| *byte = random.u8(..));
                }
                2 => {
                    let [start, end] = [random.usize(0..bytes.len()), random.usize(0..bytes.len())];
                    damaged.drain(start.min(end)..start.max(end));
                }
                _ => (0..random.usize(1..9)).for_each(|_| {
                    let place = random.usize(0..damaged.len());
                    damaged[place] = random.u8(..);
                }),
            }
            let _ = MeshFormat::of_file(&damaged, "file");
            match MeshFile::read(&damaged, format) {
                Ok(MeshFile { facets: Facets::Mesh(mesh), .. }) => {
                    assert!(mesh.vertices().iter().all(|vertex| vertex.is_finite()));
                }
                Ok(_) => {}
                Err(error) => {
                    refused += 1;
                    assert!(!error.code().is_empty() && error.to_string().len() < 2000);
                }
            }
        }
    }
    assert!(refused > 3000, "{refused}");
}

/// The objects and groups of OBJ, the nodes of glTF and the objects of 3MF are faces by their names.
#[test]
fn groups_have_the_names_of_their_file() {
    let groups = |bytes: &[u8], format| match MeshFile::read(bytes, format).unwrap().facets {
        Facets::Mesh(mesh) => mesh.groups().to_vec(),
        Facets::Cloud(_) => panic!("a mesh"),
    };
    let group = |name: &str, triangles| MeshGroup { name: Some(name.to_owned()), triangles };
    assert_eq!(groups(&obj(), MeshFormat::Obj), [group("first", 3), group("second", 1)]);
    assert_eq!(groups(&gltf(), MeshFormat::Gltf), [group("placed", 4)]);
    assert_eq!(groups(&three_mf(), MeshFormat::ThreeMf), [group("part", 4)]);
    assert_eq!(groups(&text_stl(), MeshFormat::Stl), [MeshGroup { name: None, triangles: 4 }]);
    let nameless = groups(b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", MeshFormat::Obj);
    assert_eq!(nameless, [MeshGroup { name: None, triangles: 1 }]);
}
