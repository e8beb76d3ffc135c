//! Files of meshes and points as strangers write them: their distances, and what is said of them.

use crate::commands::{file, printed, run, status};
use crate::support::root::root;
use serde_json::Value;
use std::io::Write;
use std::path::PathBuf;

/// A folder beside the project, if it is there. If not, says so on a line that begins with SKIPPED, past
/// libtest's capturing.
fn shared(folder: &str, test: &str) -> Option<PathBuf> {
    let path = root().join("../shared").join(folder);
    if path.is_dir() {
        return Some(path);
    }
    let line = format!("\nSKIPPED {test}: there is no ../shared/{folder}\n");
    std::io::stderr().write_all(line.as_bytes()).unwrap();
    None
}

/// The largest width of an interval at the default tolerance, for models of a few units.
const WIDTH: f64 = 1e-4;

fn distance(a: &str, b: &str) -> Value {
    printed(&run(&["distance", a, b, "--symmetric", "--json"]))
}

fn is_distance(result: &Value, expected: f64) -> bool {
    let end = |name: &str| result[name].as_f64().unwrap();
    end("lower") <= expected && expected <= end("upper") && end("upper") - end("lower") < WIDTH
}

#[test]
fn the_faults_of_mesh_files_are_mended() {
    let Some(folder) = shared("faults/mesh", "faults of mesh files") else { return };
    let path = |name: &str| folder.join(name).to_str().unwrap().to_owned();
    let points = |name: &str, text: &str| file(&format!("fault-{name}.xyz"), text);
    let triangle = file("fault-triangle.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let square = file("fault-square.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
    for (name, expected) in [
        ("decimal_comma.csv", path("origin.xyz")),
        ("empty_cell.csv", points("empty", "10 20 30\n11 21 31\n")),
        ("header_comment.xyz", points("header", "10 20 30\n11 21 31\n")),
        ("bom.csv", points("bom", "1 2 3\n")),
        ("two_scans.pts", points("scans", "0 0 0\n1 0 0\n0 1 0\n0 0 1\n")),
        ("polyline.obj", triangle.clone()),
        ("UPPER.stl", triangle),
        ("tristrips.ply", square),
        ("concave.obj", path("concave_other_start.obj")),
    ] {
        let result = distance(&path(name), &expected);
        assert!(is_distance(&result, 0.0), "{name}: {result}");
    }
}

#[test]
fn what_is_no_triangle_of_a_3mf_is_said() {
    let Some(folder) = shared("models/meshes", "3MF of the consortium") else { return };
    let path = |name: &str| folder.join(name).to_str().unwrap().to_owned();
    let point = file("3mf-point.xyz", "0 0 0\n");
    let said = |name: &str| {
        let output = run(&["distance", &path(name), &point, "--max-cells", "10"]);
        (status(&output), String::from_utf8_lossy(&output.stderr).into_owned())
    };
    for (name, found) in [("sphere_sliced.3mf", "slices"), ("beam_pyramid.3mf", "beamlattice/2017/02")] {
        let (status, said) = said(name);
        assert!(status == 2 && said.contains("MESH_SYNTAX") && said.contains(found), "{said}");
    }
    let (status, said) = said("MUSTPASS_Chapter4.1_ExplicitSupport.3mf");
    assert!(status == 0 && said.contains("note: ") && said.contains("support"), "{said}");
}

/// The hash of a glTF has its buffer, which is in its folder or below.
#[test]
fn buffers_beside_a_gltf_are_read() {
    let gltf = |uri: &str| {
        format!(
            r#"{{"asset": {{"version": "2.0"}}, "nodes": [{{"mesh": 0}}], "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}}}]}}],
            "accessors": [{{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}}],
            "bufferViews": [{{"buffer": 0, "byteLength": 36}}], "buffers": [{{"byteLength": 36, "uri": "{uri}"}}]}}"#
        )
    };
    let buffer = |height: f32| -> Vec<u8> {
        [0.0, 0.0, height, 1.0, 0.0, height, 0.0, 1.0, height]
            .iter()
            .flat_map(|number| number.to_le_bytes())
            .collect()
    };
    let model = file("beside.gltf", &gltf("beside%20it.bin"));
    let beside = PathBuf::from(&model).with_file_name("beside it.bin");
    let ground = file("beside.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let [low, high] = [1.0, 2.0].map(|height| {
        std::fs::write(&beside, buffer(height)).unwrap();
        printed(&run(&["distance", &model, &ground, "--json"]))
    });
    assert!(is_distance(&low, 1.0) && is_distance(&high, 2.0), "{low} {high}");
    assert_ne!(low["files"]["a"]["sha256"], high["files"]["a"]["sha256"]);
    std::fs::remove_file(&beside).unwrap();
    let refused = |path: &str| {
        let output = run(&["distance", path, &ground]);
        assert_eq!(status(&output), 2);
        String::from_utf8_lossy(&output.stderr).into_owned()
    };
    assert!(refused(&model).contains("FILE_UNREADABLE"));
    let outside = file("outside.gltf", &gltf("../outside.bin"));
    std::fs::write(PathBuf::from(&outside).parent().unwrap().join("../outside.bin"), buffer(0.0)).unwrap();
    assert!(refused(&outside).contains("\"../outside.bin\" is missing"));
}

#[test]
fn files_are_known_by_their_content() {
    let ground = file("known.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let off = "OFF\n3 1 0\n0 0 1\n1 0 1\n0 1 1\n3 0 1 2\n";
    for name in ["known.off", "known", "known.stl"] {
        assert!(is_distance(&distance(&file(name, off), &ground), 1.0), "{name}");
    }
    let gmsh = file("known.msh", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n");
    let output = run(&["distance", &gmsh, &ground]);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(status(&output) == 2 && said.contains("FORMAT_UNSUPPORTED") && said.contains("Gmsh"), "{said}");
}

/// Surfaces that are left out may be anywhere, and polygons are as far from the file's as their gap.
#[test]
fn verdicts_know_what_is_not_measured() {
    let triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    let plain = file("judged.obj", triangle);
    let formula = file("formula.obj", &format!("{triangle}surf 0 1 0 1 1 2 3\n"));
    assert_eq!(status(&run(&["distance", &plain, &plain, "--limit", "0.1"])), 0);
    let output = run(&["distance", &formula, &plain, "--limit", "0.1"]);
    assert_eq!(status(&output), 3, "{}", String::from_utf8_lossy(&output.stderr));
    let raised = file("raised.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0.4\nv 0 1 0\nf 1 2 3 4\n");
    let result = distance(&raised, &raised);
    assert!((result["gap"].as_f64().unwrap() - 0.2).abs() < 0.02, "{result}");
    assert_eq!(status(&run(&["distance", &raised, &raised, "--limit", "0.1"])), 0);
    assert_eq!(status(&run(&["distance", &raised, &raised, "--limit", "0.1", "--strict-gaps"])), 3);
}
