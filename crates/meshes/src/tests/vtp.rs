//! XML of VTK in each coding of its arrays.

use super::*;
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;

/// The bytes between the arrays of appended data.
const OFFSET: usize = 200;

/// The arrays of a square of side 2: points, corners and ends, with their types.
const TYPES: [&str; 3] = ["Float64", "Int64", "Int64"];
const TEXTS: [&str; 3] = ["0 0 0 2 0 0 2 2 0 0 2 0", "0 1 2 3", "4"];

fn contents() -> [Vec<u8>; 3] {
    let bytes = |(text, kind): (&str, &str)| -> Vec<u8> {
        let number = |word: &str| match kind {
            "Int64" => word.parse::<i64>().unwrap().to_le_bytes(),
            _ => word.parse::<f64>().unwrap().to_le_bytes(),
        };
        text.split(' ').flat_map(number).collect()
    };
    [0, 1, 2].map(|at: usize| bytes((TEXTS[at], TYPES[at])))
}

/// Bytes after their number.
fn sized(bytes: &[u8]) -> Vec<u8> {
    [(bytes.len() as u32).to_le_bytes().as_slice(), bytes].concat()
}

/// Bytes in two blocks, the first of 8, with their sizes before them, each coded on its own.
fn compressed(bytes: &[u8]) -> String {
    let zlib = |bytes: &[u8]| {
        let mut encoder = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::default());
        encoder.write_all(bytes).unwrap();
        encoder.finish().unwrap()
    };
    let (first, last) = bytes.split_at(8.min(bytes.len()));
    let blocks: Vec<Vec<u8>> =
        [first, last].into_iter().filter(|block| !block.is_empty()).map(zlib).collect();
    let sizes = [blocks.len(), 8, last.len()].into_iter().chain(blocks.iter().map(Vec::len));
    let sizes: Vec<u8> = sizes.flat_map(|size| (size as u32).to_le_bytes()).collect();
    STANDARD.encode(sizes) + &STANDARD.encode(blocks.concat())
}

/// A file up to its last element.
fn xml(attributes: &str, format: &str, content: [String; 3]) -> String {
    let array = |at: usize, name: &str| {
        let (kind, content, offset) = (TYPES[at], &content[at], OFFSET * at);
        let offset = if format == "appended" { format!(" offset=\"{offset}\"") } else { String::new() };
        format!(r#"<DataArray type="{kind}" Name="{name}" format="{format}"{offset}>{content}</DataArray>"#)
    };
    let [points, corners, ends] = [array(0, "Points"), array(1, "connectivity"), array(2, "offsets")];
    format!(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" byte_order=\"LittleEndian\"{attributes}>\n<PolyData>\
         <Piece NumberOfPoints=\"4\" NumberOfPolys=\"1\"><Points>{points}</Points><Polys>{corners}{ends}</Polys></Piece>\
         </PolyData>"
    )
}

fn read(text: impl AsRef<[u8]>) -> Result<MeshFile> {
    MeshFile::read(text.as_ref(), MeshFormat::Vtk)
}

#[test]
fn vtp_is_read_in_all_its_codings() {
    let expected = read(xml("", "ascii", TEXTS.map(str::to_owned)) + "</VTKFile>").unwrap();
    assert_eq!(groups_of(&expected), [2]);
    let contents = contents();
    let in_line = [0, 1, 2].map(|at: usize| STANDARD.encode(sized(&contents[at])));
    assert_eq!(read(xml("", "binary", in_line) + "</VTKFile>").unwrap(), expected);
    let packed = [0, 1, 2].map(|at: usize| compressed(&contents[at]));
    let by_zlib = xml(" compressor=\"vtkZLibDataCompressor\"", "binary", packed) + "</VTKFile>";
    assert_eq!(read(by_zlib).unwrap(), expected);
    for (coding, is_text) in [("raw", false), ("base64", true)] {
        let text = xml("", "appended", Default::default()) + "<AppendedData encoding=\"" + coding + "\">\n _";
        let mut bytes = text.into_bytes();
        for content in &contents {
            let content = sized(content);
            let mut coded = if is_text { STANDARD.encode(&content).into_bytes() } else { content };
            coded.resize(OFFSET, b' ');
            bytes.extend(coded);
        }
        bytes.extend(b"</AppendedData></VTKFile>");
        assert_eq!(read(&bytes).unwrap(), expected, "{coding}");
    }
}

#[test]
fn vtp_of_other_codings_is_refused() {
    let refusal = |text: String| read(text).unwrap_err().to_string();
    let lz4 = xml(" compressor=\"vtkLZ4DataCompressor\"", "ascii", TEXTS.map(str::to_owned));
    assert!(refusal(lz4).contains("vtkLZ4DataCompressor"));
    let cut = ["AAAA", "", ""].map(str::to_owned);
    assert!(refusal(xml("", "binary", cut)).contains("ends early"));
    let beyond = [TEXTS[0], "0 1 2", "9"].map(str::to_owned);
    assert!(refusal(xml("", "ascii", beyond)).contains("a cell of the corners 0 to 9"));
}

/// Fewer ends than cells would leave faces out without a word.
#[test]
fn vtp_of_other_numbers_than_stated_is_refused() {
    let refusal = |points: &str, corners: &str, ends: &str| {
        let text = xml("", "ascii", [points, corners, ends].map(str::to_owned));
        read(text + "</VTKFile>").unwrap_err().to_string()
    };
    assert!(refusal(TEXTS[0], TEXTS[1], "").contains("0 by the arrays, expected 1 by NumberOfPolys"));
    assert!(refusal(TEXTS[0], TEXTS[1], "3").contains("cells of 3 corners, of which 4"));
    assert!(refusal("0 0 0 2 0 0 2 2 0", "0 1 2", "3").contains("expected 4 by NumberOfPoints"));
}
