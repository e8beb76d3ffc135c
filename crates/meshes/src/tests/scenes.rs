//! What scenes hold beside triangles: files beside them, poses, supports, extensions.

use super::*;

/// The 3MF of the tetrahedron with parts of its XML replaced.
fn three_mf_with(replaced: &[(&str, &str)]) -> Result<MeshFile> {
    let mut xml = three_mf_xml();
    for (part, other) in replaced {
        assert!(xml.contains(part), "{part}");
        xml = xml.replacen(part, other, 1);
    }
    MeshFile::read(&zipped(&xml), MeshFormat::ThreeMf)
}

fn gltf_with(uri: &str, replaced: &[(&str, &str)], beside: &Beside) -> Result<MeshFile> {
    let mut json = gltf_json(&format!(r#", "uri": "{uri}""#));
    for (part, other) in replaced {
        assert!(json.contains(part), "{part}");
        json = json.replacen(part, other, 1);
    }
    MeshFile::read_with(json.as_bytes(), MeshFormat::Gltf, beside)
}

#[test]
fn buffers_of_gltf_may_stand_beside_it() {
    let json = gltf_json(r#", "uri": "a%20b/buffer.bin""#);
    assert_eq!(MeshFile::names_beside(json.as_bytes(), MeshFormat::Gltf), ["a b/buffer.bin"]);
    let beside = Beside::from([("a b/buffer.bin".to_owned(), gltf_buffer())]);
    let file = gltf_with("a%20b/buffer.bin", &[], &beside).unwrap();
    let Facets::Mesh(mesh) = &file.facets else { panic!("a mesh") };
    assert_eq!(corners(mesh), tetrahedron());
    assert!(gltf_with("./a%20b/buffer.bin", &[], &beside).is_ok());
    let error = gltf_with("other.bin", &[], &beside).unwrap_err().to_string();
    assert!(error.contains("\"other.bin\" is missing"), "{error}");
    assert!(MeshFile::names_beside(&glb(), MeshFormat::Gltf).is_empty());
    assert!(MeshFile::names_beside(&gltf(), MeshFormat::Gltf).is_empty());
}

#[test]
fn data_uris_need_no_kind_and_no_base64() {
    let escaped: String = gltf_buffer().iter().map(|byte| format!("%{byte:02x}")).collect();
    for uri in [format!("data:,{escaped}"), format!("data:application/octet-stream,{escaped}")] {
        assert!(gltf_with(&uri, &[], &Beside::new()).is_ok());
    }
    assert!(gltf_with("data:nothing", &[], &Beside::new()).is_err());
}

#[test]
fn skins_morphs_and_instances_are_named() {
    let beside = Beside::from([("b.bin".to_owned(), gltf_buffer())]);
    let notes = |replaced: &[(&str, &str)]| gltf_with("b.bin", replaced, &beside).unwrap().notes;
    assert!(notes(&[]).is_empty());
    let skinned = notes(&[("\"mesh\": 0", "\"mesh\": 0, \"skin\": 0")]);
    assert!(skinned[0].face.to_string() == "placed" && skinned[0].why.contains("skin"), "{skinned:?}");
    let morphed = notes(&[("\"mesh\": 0", "\"mesh\": 0, \"weights\": [0.0, 0.5]")]);
    assert!(morphed[0].why.contains("morph"), "{morphed:?}");
    assert!(notes(&[("\"mesh\": 0", "\"mesh\": 0, \"weights\": [0.0]")]).is_empty());
    let used = ("\"scene\": 0", "\"scene\": 0, \"extensionsUsed\": [\"EXT_mesh_gpu_instancing\"]");
    assert_eq!(gltf_with("b.bin", &[used], &beside).unwrap().skipped.len(), 1);
    let required = ("\"scene\": 0", "\"scene\": 0, \"extensionsRequired\": [\"KHR_draco_mesh_compression\"]");
    let error = gltf_with("b.bin", &[required], &beside).unwrap_err().to_string();
    assert!(error.contains("KHR_draco_mesh_compression"), "{error}");
}

#[test]
fn what_no_scene_and_no_item_places_is_named() {
    let beside = Beside::from([("b.bin".to_owned(), gltf_buffer())]);
    let meshes = ("\"meshes\": [", "\"meshes\": [{\"primitives\": []}, ");
    let more = gltf_with("b.bin", &[meshes, ("\"mesh\": 0", "\"mesh\": 1")], &beside).unwrap();
    assert_eq!((groups_of(&more), noted(&more)), (vec![4], vec!["meshes".to_owned()]));
    assert!(more.notes[0].why.starts_with("1 meshes"), "{:?}", more.notes);
    let object = r#"<object id="3"><mesh><vertices><vertex x="0" y="0" z="-9"/><vertex x="1" y="0" z="-9"/>
        <vertex x="0" y="1" z="-9"/></vertices><triangles><triangle v1="0" v2="1" v3="2"/></triangles></mesh></object></resources>"#;
    let file = three_mf_with(&[("</resources>", object)]).unwrap();
    assert_eq!((groups_of(&file), noted(&file)), (vec![4], vec!["objects".to_owned()]));
}

#[test]
fn what_a_gltf_leaves_out_is_named_or_refused() {
    let beside = Beside::from([("b.bin".to_owned(), gltf_buffer())]);
    let read = |part: &str, other: &str| gltf_with("b.bin", &[(part, other)], &beside);
    let unplaced = ("-2,0,0,1]}]", r#"-2,0,0,1]}, {"mesh": 0}]"#);
    let file = read(unplaced.0, unplaced.1).unwrap();
    assert_eq!((groups_of(&file), noted(&file)), (vec![4], vec!["nodes".to_owned()]));
    let scenes = (r#""scenes": ["#, r#""scenes": [{"nodes": [1]}, "#);
    let two = gltf_with("b.bin", &[scenes, unplaced], &beside).unwrap();
    assert_eq!(noted(&two), ["scenes", "nodes"]);
    let primitive = r#""primitives": [{"attributes": {"#;
    let empty = read(primitive, r#""primitives": [{"attributes": {}}, {"attributes": {"#).unwrap();
    assert_eq!((groups_of(&empty), noted(&empty)), (vec![4], vec!["placed".to_owned()]));
    let extended = r#""primitives": [{"attributes": {}, "extensions": {"X_foo": {}}}, {"attributes": {"#;
    let extended = read(primitive, extended).unwrap();
    assert_eq!((extended.notes.len(), extended.skipped[0].face.to_string().as_str()), (0, "placed"));
    for (part, other, found) in [
        (r#""scene": 0"#, r#""scene": 9"#, "there is no scene 9"),
        (r#""count": 12"#, r#""count": 11"#, "triangles of 11 indices"),
    ] {
        let error = read(part, other).unwrap_err().to_string();
        assert!(error.contains(found), "{error}");
    }
}

/// Six times the volume that the triangles enclose, seen from outside.
fn volume(file: &MeshFile) -> f64 {
    let Facets::Mesh(mesh) = &file.facets else { panic!("a mesh") };
    let corners = (0..mesh.triangles().len()).map(|triangle| mesh.corners(triangle));
    corners.map(|[a, b, c]| a.dot(b.cross(c))).sum()
}

#[test]
fn mirrored_bodies_keep_their_outside() {
    let beside = Beside::from([("b.bin".to_owned(), gltf_buffer())]);
    let of_scale = |scale: &str| {
        let placed = format!(r#""scale": [{scale}], "translation": [2, 0, 0]"#);
        volume(&gltf_with("b.bin", &[(r#""translation": [2, 0, 0]"#, &placed)], &beside).unwrap())
    };
    let mirrors = ["-1, 1, 1", "1, -1, 1", "1, 1, -1", "-1, -1, -1"];
    for scale in ["1, 1, 1", "-1, -1, 1"].into_iter().chain(mirrors) {
        assert_eq!(of_scale(scale), 3.75, "{scale}");
    }
    let mirrored = three_mf_with(&[("1 0 0 0 1 0 0 0 1 0 0 0.5", "-1 0 0 0 1 0 0 0 1 0 0 0.5")]).unwrap();
    assert_eq!(volume(&mirrored), 3.75);
}

/// A node of two equal children, and so on: without a mesh there is nothing that else would end it.
#[test]
fn scenes_of_endless_places_are_refused() {
    let nodes: Vec<String> = (1..60).map(|child| format!("{{\"children\": [{child}, {child}]}}")).collect();
    let json = format!(
        r#"{{"asset": {{"version": "2.0"}}, "scenes": [{{"nodes": [0]}}], "nodes": [{}, {{}}]}}"#,
        nodes.join(", ")
    );
    let error = MeshFile::read(json.as_bytes(), MeshFormat::Gltf).unwrap_err().to_string();
    assert!(error.contains("places"), "{error}");
}

/// Relationships of a package to models at these paths.
fn relationships(paths: &[&str]) -> String {
    let one = |path: &&str| {
        format!(
            r#"<Relationship Target="{path}" Id="r" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>"#
        )
    };
    let all: String = paths.iter().map(one).collect();
    format!(r#"<Relationships><Relationship Target="/a.png" Type="thumbnail"/>{all}</Relationships>"#)
}

/// The hash of a name decides nothing: the models are read often, in tables with other seeds.
#[test]
fn the_model_of_a_3mf_is_that_of_its_relationships() {
    let (inch, metre) = (three_mf_xml(), three_mf_xml().replace("inch", "meter"));
    let read = |paths: &[&str], names: [&str; 2]| {
        let stated = relationships(paths);
        let bytes = packed(&[("_rels/.rels", &stated), (names[0], &inch), (names[1], &metre)]);
        MeshFile::read(&bytes, MeshFormat::ThreeMf)
    };
    for _ in 0..20 {
        let unit_of = |paths: &[&str], names| {
            let file = read(paths, names).unwrap();
            (file.unit, noted(&file))
        };
        let others = || vec!["objects".to_owned()];
        for path in ["/3D/main.model", "3D/main.model", "/3d/Main.model", "./3D/m%61in.model"] {
            assert_eq!(unit_of(&[path], ["3D/main.model", "3D/other.model"]), (Some(0.0254), others()));
            assert_eq!(unit_of(&[path], ["3D/3dmodel.model", "3D/main.model"]), (Some(1.0), others()));
        }
        assert_eq!(unit_of(&["/a.xml"], ["3D/3dmodel.model", "a.xml"]).0, Some(1.0));
        assert_eq!(unit_of(&[], ["3D/a.model", "3D/3dmodel.model"]), (Some(1.0), others()));
        let named = |name: &str| vec![name.to_owned(), "objects".to_owned()];
        assert_eq!(unit_of(&[], ["3D/b.model", "3D/a.model"]), (Some(1.0), named("3d/b.model")));
        let two = ["/3D/b.model", "/3D/a.model"];
        assert_eq!(unit_of(&two, ["3D/b.model", "3D/a.model"]), (Some(0.0254), named("/3D/a.model")));
    }
    let error = read(&["/3D/lost.model"], ["3D/3dmodel.model", "3D/a.model"]).unwrap_err().to_string();
    assert!(error.contains("there is no part \"/3D/lost.model\""), "{error}");
    let error = read(&[], ["3D/a.model", "3D/A.model"]).unwrap_err().to_string();
    assert!(error.contains("two parts of the name"), "{error}");
}

#[test]
fn entities_in_attributes_of_3mf_are_decoded() {
    let name = ("name=\"part\"", "name=\"Nut &amp; Bolt &#60;M3&gt;\"");
    let named = three_mf_with(&[name]).unwrap();
    let Facets::Mesh(mesh) = &named.facets else { panic!("a mesh") };
    assert_eq!(mesh.groups()[0].name.as_deref(), Some("Nut & Bolt <M3>"));
    let other = "<component path=\"/3D/a&amp;b.model\" objectid=\"1\"";
    let root = three_mf_xml().replace("<component objectid=\"1\"", other);
    let bytes = packed(&[("3D/3dmodel.model", &root), ("3D/a&b.model", &three_mf_xml())]);
    assert_eq!(groups_of(&MeshFile::read(&bytes, MeshFormat::ThreeMf).unwrap()), [4]);
    let error = three_mf_with(&[("name=\"part\"", "name=\"&part;\"")]).unwrap_err().to_string();
    assert!(error.contains("part"), "{error}");
}

/// An object of something unknown, an empty one, and one whose id another has.
#[test]
fn objects_of_3mf_that_are_not_read_are_named() {
    let item = ("<build>", "<build><item objectid=\"3\"/>");
    for object in [
        r#"<object id="3" name="blob"><q:blob/></object></resources>"#,
        r#"<object id="3" name="blob"/></resources>"#,
        r#"<object id="3" name="blob"></object></resources>"#,
    ] {
        let file = three_mf_with(&[("</resources>", object), item]).unwrap();
        let [left] = file.skipped.as_slice() else { panic!("{:?}", file.skipped) };
        assert_eq!((groups_of(&file), left.face.to_string().as_str()), (vec![4], "blob"), "{object}");
        assert!(left.why.contains("neither triangles nor components"), "{left:?}");
    }
    for double in [r#"<object id="1"></object></resources>"#, r#"<object id="1"/></resources>"#] {
        let error = three_mf_with(&[("</resources>", double)]).unwrap_err().to_string();
        assert!(error.contains("two objects with the id \"1\""), "{error}");
    }
}

#[test]
fn supports_of_3mf_are_no_part_of_the_model() {
    let support = r#"<object id="3" type="support" name="foot"><mesh><vertices><vertex x="0" y="0" z="-9"/><vertex x="1" y="0" z="-9"/>
        <vertex x="0" y="1" z="-9"/></vertices><triangles><triangle v1="0" v2="1" v3="2"/></triangles></mesh></object></resources>"#;
    let with = |kind: &str| {
        let support = support.replace("support", kind);
        three_mf_with(&[("</resources>", &support), ("<build>", "<build><item objectid=\"3\"/>")]).unwrap()
    };
    for kind in ["support", "solidsupport", "other"] {
        let file = with(kind);
        assert_eq!((groups_of(&file), file.notes.len()), (vec![4], 1), "{kind}");
        assert!(
            file.notes[0].face.to_string() == "foot" && file.notes[0].why.contains(kind),
            "{:?}",
            file.notes
        );
    }
    assert_eq!((groups_of(&with("surface")), with("surface").notes.len()), (vec![1, 4], 0));
}

#[test]
fn extensions_of_3mf_that_are_not_read_are_refused_by_name() {
    let with = |required: &str, uri: &str| {
        let model = format!("<model requiredextensions=\"{required}\" xmlns:e=\"{uri}\" unit=\"inch\"");
        three_mf_with(&[("<model unit=\"inch\"", &model)])
    };
    let unknown = "http://example.org/unknown/2026/11";
    assert!(with("e", unknown).unwrap_err().to_string().contains(unknown));
    assert!(with("", unknown).is_ok());
    assert!(with("e", "http://schemas.microsoft.com/3dmanufacturing/production/2015/06").is_ok());
    for (part, other, name) in [
        ("<vertices>", "<b:beamlattice/><vertices>", "a beam lattice"),
        ("type=\"model\"", "type=\"model\" s:slicestackid=\"9\"", "slices"),
    ] {
        let error = three_mf_with(&[(part, other)]).unwrap_err().to_string();
        assert!(error.contains("\"part\"") && error.contains(name), "{error}");
    }
}
