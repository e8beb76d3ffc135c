//! Files of meshes and points.

use crate::commands::{file, plane, printed, run, status};

/// The square of side 2 about the z-axis, as [`plane`] is, at a height, as text of STL.
fn stl(height: f64) -> String {
    let corners = |list: [[f64; 2]; 3]| {
        let vertices = list.map(|[x, y]| format!("vertex {x} {y} {height}\n")).concat();
        format!("facet normal 0 0 1\nouter loop\n{vertices}endloop\nendfacet\n")
    };
    let [first, second] = [[[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0]], [[-1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]];
    format!("solid square\n{}{}endsolid square\n", corners(first), corners(second))
}

#[test]
fn meshes_and_points_are_read_by_the_ending_of_their_names() {
    let mesh = file("mesh.STL", &stl(3.0));
    let surface = file("mesh-plane.json", &plane(0.0).to_string());
    let points = file("mesh-points.xyz", "0.5 0.5 -1\n0.25 0.5 1\n");
    for (a, b, distance) in
        [(&mesh, &surface, 3.0), (&surface, &mesh, 3.0), (&points, &mesh, 4.0), (&points, &surface, 1.0)]
    {
        let result = printed(&run(&["distance", a, b, "--json"]));
        let end = |name: &str| result[name].as_f64().unwrap();
        assert!(end("lower") <= distance && distance <= end("upper"), "{result}");
        assert_eq!(result["converged"], true);
        assert_eq!(status(&run(&["distance", a, b, "--limit", "0.5"])), 1);
        assert_eq!(status(&run(&["distance", a, b, "--limit", "4.5"])), 0);
    }
    let text = String::from_utf8_lossy(&run(&["distance", &points, &mesh]).stdout).into_owned();
    assert!(text.contains("on A       point 0") && text.contains("on B       triangle "), "{text}");
}

/// A file of triangles and one of points, in text and in JSON.
#[test]
fn info_has_the_facts_of_meshes_and_clouds() {
    let mesh = file("mesh-info.stl", &stl(0.0));
    let points = file("mesh-info.xyz", "0 0 0\n1 2 3\n");
    let text = String::from_utf8_lossy(&run(&["info", &mesh]).stdout).into_owned();
    assert!(text.contains("extents") && text.contains("edges of faces have no partner"), "{text}");
    let info: serde_json::Value = serde_json::from_slice(&run(&["info", &points, "--json"]).stdout).unwrap();
    assert_eq!(info["counts"]["points"], 2);
    assert_eq!(info["facts"]["volumeUnknown"], "points");
    assert_eq!(info["bodies"][0]["kind"], "points");
    for (axis, expected) in [1.0, 2.0, 3.0].into_iter().enumerate() {
        let extent = &info["facts"]["extents"][axis];
        let [lower, upper] = ["lower", "upper"].map(|end| extent[end].as_f64().unwrap());
        assert!(lower <= expected && expected <= upper && upper - lower < 1e-12, "{extent}");
    }
}

#[test]
fn what_needs_surfaces_refuses_meshes_by_code() {
    let mesh = file("mesh-refused.stl", &stl(0.0));
    let points = file("mesh-refused.xyz", "0 0 0\n1 2 3\n");
    for arguments in [vec!["convert", &mesh, "unwritten.json"], vec!["clearance", &mesh, &points]] {
        let output = run(&arguments);
        let error = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(status(&output) == 2 && error.contains("FACETS_UNSUPPORTED"), "{arguments:?}: {error}");
    }
    let damaged = file("mesh-damaged.stl", &stl(0.0)[..120]);
    let error = String::from_utf8_lossy(&run(&["distance", &damaged, &mesh]).stderr).into_owned();
    assert!(error.contains("MESH_SYNTAX") && error.contains("mesh-damaged.stl"), "{error}");
}

#[test]
fn groups_of_a_mesh_are_compared_by_their_names() {
    let square = |z: f64| format!("v -1 -1 {z}\nv 1 -1 {z}\nv 1 1 {z}\nv -1 1 {z}\n");
    let faces = "o low\nf 1 2 3 4\no high\nf 5 6 7 8\n";
    let [a, b] = [1.0, 1.5].map(|top| {
        file(&format!("mesh-groups-{top}.obj"), &format!("{}{}{faces}", square(0.0), square(top)))
    });
    let output = run(&["diff", &a, &b, "--limit", "0.1", "--json"]);
    assert_eq!(status(&output), 1);
    let result: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let states = |name: &str| [0, 1].map(|face| result[name][face]["state"].clone());
    assert_eq!(states("facesOfA"), ["unchanged", "changed"]);
    assert_eq!(result["facesOfA"][1]["witness"]["a"]["faceName"], "high");
    assert!((result["facesOfB"][1]["lower"].as_f64().unwrap() - 0.5).abs() < 1e-3);
    let mesh = file("mesh-deviations.stl", &stl(0.0));
    let result = printed(&run(&["distance", &mesh, &a, "--deviations", "--json"]));
    assert!(result["statistics"]["mean"].as_f64().unwrap() < 1e-12, "{result}");
}

/// A sheet from height 1 to 3 over a plane, whose distances are uniform.
#[test]
fn statistics_are_intervals() {
    let slope = "v -1 -1 1\nv 1 -1 3\nv 1 1 3\nv -1 1 1\nf 1 2 3 4\n";
    let (slope, ground) =
        (file("statistics.obj", slope), file("statistics-plane.json", &plane(0.0).to_string()));
    let result = printed(&run(&["statistics", &slope, &ground, "--limit", "1.5", "--json"]));
    let holds = |interval: &serde_json::Value, expected: f64| {
        let end = |name: &str| interval[name].as_f64().unwrap();
        assert!(end("lower") <= expected && expected <= end("upper"), "{expected} {interval}");
    };
    assert_eq!((&result["over"], &result["converged"]), (&"area".into(), &true.into()));
    holds(&result["mean"], 2.0);
    holds(&result["rms"], (13.0_f64 / 3.0).sqrt());
    holds(&result["percentiles"][1]["distance"], 2.9);
    holds(&result["beyond"]["part"], 0.75);
    let text = String::from_utf8_lossy(&run(&["statistics", &slope, &ground]).stdout).into_owned();
    assert!(text.contains("mean       between") && text.contains("part 0.95  within"), "{text}");
    assert_eq!(status(&run(&["statistics", &slope, &ground, "--part-tolerance", "0"])), 2);
}
