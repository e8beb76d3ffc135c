//! The pictures of the report for browsers, decoded by a reader of PNG of its own.

use super::commands::{plane, run, status};
use crate::measures::check::faces;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::Crc;
use flate2::read::ZlibDecoder;
use serde_json::{Value, json};
use std::io::Read;
use std::path::PathBuf;

/// The pixels of a picture, red, green and blue each, the upper row first.
struct Decoded {
    size: [usize; 2],
    pixels: Vec<[u8; 3]>,
}

/// Decodes a file of ISO/IEC 15948 with 8 bits of red, green and blue, and checks its checksums.
fn decode(file: &[u8]) -> Decoded {
    assert_eq!(&file[..8], b"\x89PNG\r\n\x1a\n");
    let number = |bytes: &[u8]| u32::from_be_bytes(bytes.try_into().unwrap()) as usize;
    let (mut rest, mut size, mut data) = (&file[8..], [0; 2], Vec::new());
    while !rest.is_empty() {
        let length = number(&rest[..4]);
        let (name, content) = (&rest[4..8], &rest[8..8 + length]);
        let mut checksum = Crc::new();
        checksum.update(&rest[4..8 + length]);
        assert_eq!(checksum.sum() as usize, number(&rest[8 + length..12 + length]));
        match name {
            b"IHDR" => {
                size = [number(&content[..4]), number(&content[4..8])];
                assert_eq!(&content[8..], [8, 2, 0, 0, 0]);
            }
            b"IDAT" => data.extend(content),
            name => assert_eq!(name, b"IEND"),
        }
        rest = &rest[12 + length..];
    }
    let mut raw = Vec::new();
    ZlibDecoder::new(data.as_slice()).read_to_end(&mut raw).unwrap();
    let stride = 3 * size[0];
    assert_eq!(raw.len(), (stride + 1) * size[1]);
    let mut rows: Vec<Vec<u8>> = vec![vec![0; stride]];
    for line in raw.chunks(stride + 1) {
        let above = rows.last().unwrap().clone();
        let mut row = vec![0_u8; stride];
        for at in 0..stride {
            let of = |row: &[u8]| if at < 3 { 0 } else { i32::from(row[at - 3]) };
            let (left, corner, up) = (of(&row), of(&above), i32::from(above[at]));
            let predicted = match line[0] {
                0 => 0,
                1 => left,
                2 => up,
                3 => (left + up) / 2,
                _ => {
                    let estimate = left + up - corner;
                    [left, up, corner].into_iter().min_by_key(|value| (estimate - value).abs()).unwrap()
                }
            };
            row[at] = line[1 + at].wrapping_add(predicted as u8);
        }
        rows.push(row);
    }
    let pixels = rows[1..].concat().chunks(3).map(|pixel| pixel.try_into().unwrap()).collect();
    Decoded { size, pixels }
}

/// The alternative texts and the pictures of a report.
fn pictures(report: &str) -> Vec<(String, Decoded)> {
    let images = report.split("<img ").skip(1).map(|image| image.split('>').next().unwrap());
    let attribute = |image: &str, name: &str| {
        image.split(&format!("{name}=\"")).nth(1).unwrap().split('"').next().unwrap().to_owned()
    };
    images
        .map(|image| {
            let address = attribute(image, "src");
            let file = STANDARD.decode(address.strip_prefix("data:image/png;base64,").unwrap()).unwrap();
            let decoded = decode(&file);
            let size = ["width", "height"].map(|name| attribute(image, name).parse::<usize>().unwrap());
            assert_eq!(decoded.size, size);
            (attribute(image, "alt"), decoded)
        })
        .collect()
}

/// The surface z = x y over the unit square, which is 1 above the plane z = 0 at one corner alone.
fn saddle() -> Value {
    json!({ "surfaces": [{
        "degree": [1, 1],
        "knots_u": [0, 0, 1, 1],
        "knots_v": [0, 0, 1, 1],
        "ctrl": [[[0, 0, 0, 1], [0, 1, 0, 1]], [[1, 0, 0, 1], [1, 1, 1, 1]]],
    }]})
}

/// Paths of files with these models.
fn files(test: &str, models: [&Value; 2]) -> [String; 2] {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("pictures-{test}"));
    std::fs::create_dir_all(&folder).unwrap();
    [("a.json", models[0]), ("b.json", models[1])].map(|(name, model)| {
        let path = folder.join(name);
        std::fs::write(&path, model.to_string()).unwrap();
        path.to_str().unwrap().to_owned()
    })
}

fn dot(one: [f64; 3], other: [f64; 3]) -> f64 {
    one.iter().zip(other).map(|(one, other)| one * other).sum()
}

/// Where an orthographic camera in this direction sees the corner (1, 1, 1) of the saddle, if all of it
/// fills 94 % of the picture.
fn seen(toward: [f64; 3], size: [usize; 2]) -> [f64; 2] {
    let unit = |[x, y, z]: [f64; 3]| [x, y, z].map(|value| value / dot([x, y, z], [x, y, z]).sqrt());
    let toward = unit(toward);
    let right = unit([-toward[1], toward[0], 0.0]);
    let up = [
        toward[1] * right[2] - toward[2] * right[1],
        toward[2] * right[0] - toward[0] * right[2],
        toward[0] * right[1] - toward[1] * right[0],
    ];
    // A linear function is extreme over the surface at one of its corners.
    let corners = [[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 1.0]];
    let ranges = [right, up].map(|axis| {
        let all = corners.map(|corner| dot(axis, corner));
        (all.into_iter().fold(f64::INFINITY, f64::min), all.into_iter().fold(f64::NEG_INFINITY, f64::max))
    });
    let [width, height] = size.map(|size| size as f64);
    let lengths = ranges.map(|(low, high)| high - low);
    let scale = 0.94 * (width / lengths[0]).min(height / lengths[1]);
    let from_middle =
        |axis: [f64; 3], (low, high): (f64, f64)| scale * (dot(axis, [1.0; 3]) - (low + high) / 2.0);
    [width / 2.0 + from_middle(right, ranges[0]), height / 2.0 - from_middle(up, ranges[1])]
}

#[test]
fn the_worst_place_is_marked_where_it_is_seen() {
    let [a, b] = files("saddle", [&saddle(), &plane(0.0)]);
    let output = run(&["distance", &a, &b, "--limit", "0.25", "--format", "html"]);
    assert_eq!(status(&output), 1, "{}", String::from_utf8_lossy(&output.stderr));
    let report = String::from_utf8(output.stdout).unwrap();
    let shown = pictures(&report);
    let texts: Vec<_> = shown.iter().map(|(alt, _)| alt.as_str()).collect();
    let what = "Signed deviation of A from B";
    assert_eq!(
        texts,
        [
            format!("{what}, seen from the front, the right and above"),
            format!("{what}, seen from the back, the left and below"),
            format!("{what}, the worst place seen from near"),
        ]
    );
    let overviews = [[0.75, -1.25, 0.8], [-0.75, 1.25, -0.8]];
    for ((_, Decoded { size, pixels }), toward) in shown.iter().zip(overviews) {
        // The ring is the only part that is black.
        let places = pixels.iter().enumerate().filter(|&(_, &color)| color == [0; 3]).map(|(index, _)| index);
        let places: Vec<_> =
            places.map(|at| [at % size[0], at / size[0]].map(|at| at as f64 + 0.5)).collect();
        assert!(places.len() > 50, "{}", places.len());
        let middle = [0, 1].map(|axis| places.iter().map(|at| at[axis]).sum::<f64>() / places.len() as f64);
        let expected = seen(toward, *size);
        for axis in [0, 1] {
            assert!((middle[axis] - expected[axis]).abs() < 0.5, "{middle:?}, expected {expected:?}");
        }
    }
    // A deviation of the normals' side, 1 at that corner.
    assert!(report.contains("<figcaption>The worst place, from near: +1.0"), "{report}");
    assert!(report.contains(">allowed +0.25"));
    // The part of the surface that is within the limit is green: x y is at most a quarter.
    let (_, Decoded { pixels, .. }) = &shown[0];
    let is_green = |&[red, green, blue]: &[u8; 3]| green > red && green > blue;
    let is_red =
        |&[red, green, blue]: &[u8; 3]| red > green.saturating_add(9) && red > blue.saturating_add(9);
    let [greens, reds] = [
        pixels.iter().filter(|color| is_green(color)).count(),
        pixels.iter().filter(|color| is_red(color)).count(),
    ];
    assert!(greens > 10_000 && reds > 10_000, "{greens} {reds}");
}

/// The numbers of pixels in the colours of the first body, of the second one, and of what is inside the other one.
fn bodies_seen(pixels: &[[u8; 3]]) -> [usize; 3] {
    let exceeds = |one: u8, other: u8| one > other.saturating_add(40);
    let count = |is: &dyn Fn(&[u8; 3]) -> bool| pixels.iter().filter(|pixel| is(pixel)).count();
    [
        count(&|&[red, _, blue]| exceeds(blue, red)),
        count(&|&[red, green, blue]| exceeds(red, blue) && exceeds(green, blue)),
        count(&|&[red, green, _]| exceeds(red, green)),
    ]
}

/// From outside nothing is seen of what is inside the other body; cut open, of a box within another one all is.
#[test]
fn clashes_are_cut_open_and_red_is_what_is_inside() {
    let clash = |test: &str, min: f64, max: f64| {
        let [shaft, hub] = [("shaft", 0.0, 1.0), ("hub", min, max)]
            .map(|(name, min, max)| json!({ "surfaces": faces(name, [min; 3], [max; 3]) }));
        // Of one file a box within another one would be a void.
        let [a, b] = files(test, [&shaft, &hub]);
        let output = run(&["check", &a, &b, "--format", "html"]);
        assert_eq!(status(&output), 1, "{}", String::from_utf8_lossy(&output.stderr));
        let page = String::from_utf8(output.stdout).unwrap();
        let shown = pictures(&page);
        assert!(
            shown[0].0.starts_with("a / shaft in blue and b / hub in yellow; what is inside"),
            "{}",
            shown[0].0
        );
        let counts = shown.iter().map(|(_, decoded)| bodies_seen(&decoded.pixels));
        let rings =
            shown.iter().map(|(_, decoded)| decoded.pixels.iter().filter(|color| **color == [0; 3]).count());
        assert!(rings.into_iter().all(|black| black > 50));
        counts.collect::<Vec<_>>()
    };
    let [front, back, cut] = clash("clash", 0.5, 2.0)[..] else { panic!() };
    for [blue, yellow, red] in [front, back] {
        assert!(blue > 5_000 && yellow > 5_000 && red < 500, "{blue} {yellow} {red}");
    }
    assert!(cut.into_iter().all(|count| count > 5_000), "{cut:?}");
    let [front, back, cut] = clash("within", -1.0, 2.0)[..] else { panic!() };
    for [blue, yellow, red] in [front, back] {
        assert!(blue == 0 && yellow > 50_000 && red == 0, "{blue} {yellow} {red}");
    }
    assert!(cut[0] == 0 && cut[1] > 5_000 && cut[2] > 5_000, "{cut:?}");
}

#[test]
fn both_models_are_shown_where_both_are_measured_and_none_where_none_differs() {
    let [a, b] = files("both", [&saddle(), &plane(0.0)]);
    let report = |arguments: &[&str]| {
        let output = run(&[arguments, &["--format", "html"]].concat());
        String::from_utf8(output.stdout).unwrap()
    };
    // Two of each model, and one from near.
    assert_eq!(pictures(&report(&["distance", &a, &b, "--symmetric"])).len(), 5);
    assert_eq!(pictures(&report(&["diff", &a, &b])).len(), 5);
    let same = report(&["distance", &a, &a]);
    let shown = pictures(&same);
    assert_eq!(shown.len(), 2);
    // Nothing is marked: rounding has no worst place.
    assert!(shown.iter().all(|(_, decoded)| decoded.pixels.iter().all(|&color| color != [0; 3])));
    assert!(!same.contains("worst"));
}

#[test]
fn units_and_motions_are_those_of_the_result() {
    let with_unit = |unit: f64| {
        let mut model = saddle();
        model["unit"] = json!(unit);
        model
    };
    // B in metres is a thousand times as large as A in millimetres, unless it is scaled.
    let mut plane = plane(0.0);
    plane["unit"] = json!(1.0);
    let [a, b] = files("units", [&with_unit(0.001), &plane]);
    let options = ["--scale-units", "--translate", "100,0,0.5", "--format", "html"];
    let output = run(&[&["distance", a.as_str(), b.as_str()][..], &options].concat());
    let report = String::from_utf8(output.stdout).unwrap();
    // The corner (1, 1, 1) moves to (101, 1, 1.5); the plane, 2000 mm wide, lies below it.
    assert!(report.contains("Signed deviation of A from B, mm"), "{report}");
    let place = report.split("The worst place, from near: +").nth(1).unwrap();
    assert!(place.starts_with("1.50 mm at 101.00, 1.00, 1.50 of A"), "{}", &place[..80]);
    assert_eq!(pictures(&report).len(), 3);
}
