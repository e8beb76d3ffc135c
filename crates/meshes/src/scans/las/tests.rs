//! LAS by its specification, and LAZ as LASzip writes it.

use super::*;
use crate::MeshFile;
use ::laz::{LasZipCompressor, LazVlr, LazVlrBuilder};
use nurbs_hausdorff::{Facets, PointCloud};
use std::io::{Cursor, Seek, SeekFrom, Write};

const COUNT: i32 = 40;
const SCALE: [f64; 3] = [0.001, 0.01, 0.5];
const OFFSET: [f64; 3] = [100.0, -20.0, 0.25];

/// The files that `benches/trimmed/scan_samples.py` writes by LASzip, with a byte before them.
const POINTS: &[u8] = include_bytes!("../../../../../tests/soundness/fuzz/seeds/mesh_file/scans/points-laz");
const LAYERS: &[u8] = include_bytes!("../../../../../tests/soundness/fuzz/seeds/mesh_file/scans/layers-laz");

/// The integers of point k, which `scan_samples.py` has too.
fn integers(k: i32) -> [i32; 3] {
    [k * k * 37 % 2003 - 900, 31 * k % 83, k % 7 - 3]
}

fn expected() -> Vec<DVec3> {
    let scaled = |k| DVec3::from_array(integers(k).map(f64::from)) * DVec3::from(SCALE) + DVec3::from(OFFSET);
    (0..COUNT).map(scaled).collect()
}

/// A record of a user and number.
fn record(user: &[u8], id: u16, content: &[u8]) -> Vec<u8> {
    let mut bytes = vec![0; 54];
    bytes[2..2 + user.len()].copy_from_slice(user);
    bytes[18..20].copy_from_slice(&id.to_le_bytes());
    bytes[20..22].copy_from_slice(&(content.len() as u16).to_le_bytes());
    bytes.extend(content);
    bytes
}

/// The header of a file, and its records; points follow.
fn head(format: u8, point_bytes: u16, records: &[Vec<u8>]) -> Vec<u8> {
    let mut bytes = vec![0; 375];
    bytes[..4].copy_from_slice(b"LASF");
    bytes[24..26].copy_from_slice(&[1, 4]);
    bytes[94..96].copy_from_slice(&375_u16.to_le_bytes());
    let start = 375 + records.iter().map(Vec::len).sum::<usize>();
    bytes[96..100].copy_from_slice(&(start as u32).to_le_bytes());
    bytes[100..104].copy_from_slice(&(records.len() as u32).to_le_bytes());
    bytes[104] = format;
    bytes[105..107].copy_from_slice(&point_bytes.to_le_bytes());
    for (place, number) in [131, 139, 147, 155, 163, 171].into_iter().zip([SCALE, OFFSET].concat()) {
        bytes[place..place + 8].copy_from_slice(&number.to_le_bytes());
    }
    bytes[247..255].copy_from_slice(&(COUNT as u64).to_le_bytes());
    bytes.extend(records.concat());
    bytes
}

/// Returns points of this length in bytes that differ in the bytes after the coordinates.
fn points(point_bytes: usize) -> Vec<u8> {
    let mut bytes = Vec::new();
    for k in 0..COUNT {
        bytes.extend(integers(k).into_iter().flat_map(i32::to_le_bytes));
        bytes.resize(bytes.len() + point_bytes - 12, k as u8);
    }
    bytes
}

fn las(records: &[Vec<u8>]) -> Vec<u8> {
    [head(6, 30, records), points(30)].concat()
}

/// A file in chunks of seven points, or of five and six in turn.
fn laz(format: u8, point_bytes: u16, is_variable: bool) -> Vec<u8> {
    let builder = LazVlrBuilder::default().with_point_format(format, 0).unwrap();
    let vlr = match is_variable {
        true => builder.with_variable_chunk_size().build(),
        false => builder.with_fixed_chunk_size(7).build(),
    };
    let mut content = Vec::new();
    vlr.write_to(&mut content).unwrap();
    let records = [record(LazVlr::USER_ID.as_bytes(), LazVlr::RECORD_ID, &content)];
    let mut file = Cursor::new(Vec::new());
    file.write_all(&head(format | 1 << 7, point_bytes, &records)).unwrap();
    file.seek(SeekFrom::End(0)).unwrap();
    let mut compressor = LasZipCompressor::new(file, vlr).unwrap();
    for (k, point) in points(point_bytes.into()).chunks(point_bytes.into()).enumerate() {
        if is_variable && k > 0 && matches!(k % 11, 0 | 5) {
            compressor.finish_current_chunk().unwrap();
        }
        compressor.compress_one(point).unwrap();
    }
    compressor.done().unwrap();
    compressor.into_inner().into_inner()
}

fn read(bytes: &[u8]) -> Result<(Vec<DVec3>, Option<f64>)> {
    MeshFile::read(bytes, FORMAT).map(|MeshFile { facets, unit, .. }| match facets {
        Facets::Cloud(cloud) => (PointCloud::points(&cloud).to_vec(), unit),
        Facets::Mesh(mesh) => panic!("{mesh:?}"),
    })
}

fn refusal(bytes: &[u8]) -> String {
    read(bytes).map_or_else(|error| error.to_string(), |(points, _)| panic!("{} points", points.len()))
}

#[test]
fn points_are_scaled_and_moved() {
    assert_eq!(read(&las(&[])).unwrap(), (expected(), None));
}

#[test]
fn files_of_laszip_are_read() {
    for file in [POINTS, LAYERS] {
        assert_eq!(read(&file[1..]).unwrap().0, expected());
    }
}

#[test]
fn chunks_of_any_size_are_read() {
    for (format, point_bytes) in [(0, 20), (3, 34), (6, 30), (8, 38)] {
        for is_variable in [false, true] {
            let points = read(&laz(format, point_bytes, is_variable)).unwrap().0;
            assert_eq!(points, expected(), "{format}, {is_variable}");
        }
    }
}

/// Each field that states a number of bytes, points, chunks or layers, with too large a number: the
/// crate would take memory for it.
#[test]
fn sizes_beyond_the_file_are_refused() {
    let put = |file: &[u8], place: usize, bytes: &[u8]| {
        let mut file = file.to_vec();
        file[place..place + bytes.len()].copy_from_slice(bytes);
        file
    };
    let [plain, chunked, layered] = [las(&[]), laz(0, 20, false), laz(6, 30, false)];
    let word = |file: &[u8], place: usize| u32::from_le_bytes(file[place..place + 4].try_into().unwrap());
    let start = word(&chunked, 96) as usize;
    let table = word(&chunked, start) as usize;
    let layers = word(&layered, 96) as usize + 8 + 30 + 4;
    for (file, place, found) in [
        (&plain, 247, "bytes"),
        (&plain, 100, " at "),
        (&plain, 243, " at "),
        (&chunked, 247, "points in all chunks"),
        (&chunked, start, " at "),
        (&chunked, table + 4, "chunks in"),
        (&layered, layers, "beyond its chunk"),
        (&layered, layers - 4, "a chunk of"),
    ] {
        let found_instead = refusal(&put(file, place, &0x00ff_ffff_u32.to_le_bytes()));
        assert!(found_instead.contains(found), "{place}: {found_instead}");
    }
    assert!(refusal(&put(&plain, 247, &[0xff; 8])).contains("1073741824"));
    // The decoder's first number: it indexes its tables by it.
    assert!(refusal(&put(&chunked, start + 8 + 20, &[0xff; 4])).contains("beyond its range"));
}

#[test]
fn units_are_those_of_the_reference_system() {
    let projection = |id, content: &[u8]| las(&[record(b"LASF_Projection", id, content)]);
    let keys = |keys: &[[u16; 4]]| {
        let all = [&[[1, 1, 0, keys.len() as u16]], keys].concat();
        projection(
            34735,
            &all.as_flattened().iter().flat_map(|number| number.to_le_bytes()).collect::<Vec<_>>(),
        )
    };
    let text = |text: &str| projection(2112, text.as_bytes());
    let foot = 1200.0 / 3937.0;
    let plane = |unit: &str| {
        format!(
            r#"PROJCS["a (b) UNIT[",GEOGCS["WGS 84",DATUM["D",SPHEROID["S",6378137,298.257]],PRIMEM["G",0],UNIT["degree",0.0174532925199433]],PROJECTION["Transverse_Mercator"],PARAMETER["false_easting",500000],UNIT["u",{unit}]]"#
        )
    };
    let heights = |unit: &str| {
        format!(r#"COMPD_CS["c",{},VERT_CS["h",VERT_DATUM["d",2005],UNIT["v",{unit}]]]"#, plane("1"))
    };
    let new = r#"PROJCRS["p",BASEGEOGCRS["b",DATUM["d",ELLIPSOID["e",6378137,298.25,LENGTHUNIT["metre",1]]]],CONVERSION["c",METHOD["m"]],CS[Cartesian,2],AXIS["e",east],AXIS["n",north],LENGTHUNIT["foot",0.3048]]"#;
    for (file, unit) in [
        (las(&[]), None),
        (keys(&[[1024, 0, 1, 1], [3076, 0, 1, 9001]]), Some(1.0)),
        (keys(&[[1024, 0, 1, 1], [3076, 0, 1, 9003], [4099, 0, 1, 9003]]), Some(foot)),
        (keys(&[[1024, 0, 1, 1], [3072, 0, 1, 32632]]), None),
        (text(&plane("0.3048")), Some(0.3048)),
        (text(&heights("1")), Some(1.0)),
        (text(new), Some(0.3048)),
        (text("no text of a system ]]"), None),
    ] {
        assert_eq!(read(&file).unwrap().1, unit);
    }
    let degrees =
        r#"GEOGCS["WGS 84",DATUM["D",SPHEROID["S",6378137,298.257]],UNIT["degree",0.0174532925199433]]"#;
    for file in [text(degrees), keys(&[[1024, 0, 1, 2]])] {
        assert!(refusal(&file).contains("degrees"));
    }
    for file in [text(&heights("0.3048")), keys(&[[3076, 0, 1, 9002], [4099, 0, 1, 9001]])] {
        assert!(refusal(&file).contains("one unit"));
    }
}
