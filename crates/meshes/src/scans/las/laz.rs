//! Decompression of LAZ.
//!
//! The crate `laz` takes sizes from the file as they are: memory for as many chunks and for layers
//! as long as it says; and its decoder indexes tables by numbers that are in range only if it
//! starts below its range's length. All of that is checked here before.

use super::records::Records;
use super::{FORMAT, Header, field};
use laz::laszip::ChunkTable;
use laz::record::{LayeredPointRecordDecompressor, RecordDecompressor, SequentialPointRecordDecompressor};
use laz::{DecompressionSelection, LazItem, LazItemType, LazVlr};
use nurbs_hausdorff::{Error, Result};
use std::io::Cursor;

/// The compression of points: all in one chunk, in several chunks, or in several chunks with layers.
const IN_ONE_CHUNK: u16 = 1;
const IN_CHUNKS: u16 = 2;
const IN_LAYERS: u16 = 3;

/// The place and the bytes of the chunk table's place in a file, at the start of the points.
const TABLE_PLACE_BYTES: usize = 8;

/// The place of the number of chunks in the chunk table.
const CHUNK_COUNT: usize = 4;

/// The first bytes of a coded stream that are no number below the length of its range.
const BEYOND_RANGE: [u8; 4] = [0xff; 4];

/// A chunk of points: its bytes, and the number of its points.
struct Chunk<'a> {
    bytes: &'a [u8],
    count: u64,
}

/// Hands the uncompressed bytes of every point on.
pub(super) fn read(
    bytes: &[u8],
    header: &Header,
    records: &Records<'_>,
    push: &mut impl FnMut(&[u8]),
) -> Result<()> {
    if header.count == 0 {
        return Ok(());
    }
    let content = records
        .content(LazVlr::USER_ID.as_bytes(), LazVlr::RECORD_ID)
        .ok_or_else(|| FORMAT.syntax("compressed points without the record of their compression"))?;
    let kind = u16::from_le_bytes(field(content, 0)?);
    let vlr = LazVlr::from_buffer(content).map_err(damaged)?;
    check_items(vlr.items(), kind, header.point_bytes)?;
    let chunks = match kind {
        IN_ONE_CHUNK => {
            let chunk = bytes.get(header.start..).unwrap_or_default();
            vec![Chunk { bytes: chunk, count: header.count }]
        }
        _ => chunks(bytes, header, &vlr)?,
    };
    let mut point = vec![0; header.point_bytes];
    for Chunk { bytes: chunk, count } in chunks {
        if count == 0 {
            continue;
        }
        let mut source = decompressor(chunk, vlr.items(), kind, count, header.point_bytes)?;
        for _ in 0..count {
            source.decompress_next(&mut point).map_err(damaged)?;
            push(&point);
        }
    }
    Ok(())
}

/// Checks that points begin with their coordinates and have the bytes that the header says.
fn check_items(items: &[LazItem], kind: u16, point_bytes: usize) -> Result<()> {
    let is_known = matches!(
        (kind, items.first().map(LazItem::item_type)),
        (IN_ONE_CHUNK | IN_CHUNKS, Some(LazItemType::Point10)) | (IN_LAYERS, Some(LazItemType::Point14))
    );
    if !is_known {
        return Err(FORMAT.syntax(format!("compression of kind {kind}")));
    }
    let sizes = items.iter().map(|item| (usize::from(item.size()), bytes_of(item.item_type())));
    let has_sizes = sizes.clone().all(|(found, expected)| found == expected && found > 0);
    let whole: usize = sizes.map(|(found, _)| found).sum();
    if !has_sizes || whole != point_bytes {
        return Err(FORMAT.syntax(format!("compressed points of {whole} bytes, expected {point_bytes}")));
    }
    Ok(())
}

/// Returns the bytes of a part of a point.
fn bytes_of(item: LazItemType) -> usize {
    match item {
        LazItemType::Byte(count) | LazItemType::Byte14(count) => count.into(),
        LazItemType::Point10 => 20,
        LazItemType::GpsTime | LazItemType::RGBNIR14 => 8,
        LazItemType::RGB12 | LazItemType::RGB14 => 6,
        LazItemType::WavePacket13 | LazItemType::WavePacket14 => 29,
        LazItemType::Point14 => 30,
    }
}

/// Returns the number of layers of a part of a point.
fn layers_of(item: LazItemType) -> usize {
    match item {
        LazItemType::Point14 => 9,
        LazItemType::RGBNIR14 => 2,
        LazItemType::Byte14(count) => count.into(),
        _ => 1,
    }
}

/// Reads the table of chunks: each is a range of bytes and has a number of points, the last what
/// is left.
fn chunks<'a>(bytes: &'a [u8], header: &Header, vlr: &LazVlr) -> Result<Vec<Chunk<'a>>> {
    let beyond = || FORMAT.syntax("a chunk or the table of chunks beyond the file");
    let data = header.start.saturating_add(TABLE_PLACE_BYTES);
    let table = |place: usize| -> Result<Option<usize>> {
        let table = i64::from_le_bytes(field(bytes, place)?);
        Ok(usize::try_from(table).ok().filter(|&table| table >= data))
    };
    // A writer that cannot go back puts the place at the end.
    let at = match table(header.start)? {
        Some(at) => at,
        None => table(bytes.len().saturating_sub(TABLE_PLACE_BYTES))?.ok_or_else(beyond)?,
    };
    let count = u32::from_le_bytes(field(bytes, at.saturating_add(CHUNK_COUNT))?) as usize;
    // Each chunk has its first point as it is.
    if count.saturating_mul(header.point_bytes) > at - data {
        return Err(FORMAT.syntax(format!("{count} chunks in {} bytes", at - data)));
    }
    let mut source = Cursor::new(bytes);
    source.set_position(header.start as u64);
    let table = ChunkTable::read_from(source, vlr).map_err(damaged)?;
    let mut chunks = Vec::with_capacity(count);
    let (mut start, mut left) = (data, header.count);
    for entry in &table {
        let end = usize::try_from(entry.byte_count).ok().and_then(|length| start.checked_add(length));
        let end = end.filter(|&end| end <= at).ok_or_else(beyond)?;
        let count = entry.point_count.min(left);
        chunks.push(Chunk { bytes: &bytes[start..end], count });
        start = end;
        left -= count;
    }
    match left {
        0 => Ok(chunks),
        _ => Err(FORMAT.syntax(format!(
            "{} points in all chunks, expected {}",
            header.count - left,
            header.count
        ))),
    }
}

/// Returns the decompressor of a chunk whose sizes and first numbers are checked.
fn decompressor<'a>(
    chunk: &'a [u8],
    items: &Vec<LazItem>,
    kind: u16,
    count: u64,
    point_bytes: usize,
) -> Result<Box<dyn RecordDecompressor<Cursor<&'a [u8]>> + 'a>> {
    let source = Cursor::new(chunk);
    let mut decompressor: Box<dyn RecordDecompressor<Cursor<&'a [u8]>> + 'a> = match kind {
        IN_LAYERS => {
            check_layers(chunk, items, count, point_bytes)?;
            Box::new(LayeredPointRecordDecompressor::new(source))
        }
        _ => {
            check_start(chunk, point_bytes)?;
            Box::new(SequentialPointRecordDecompressor::new(source))
        }
    };
    decompressor.set_fields_from(items).map_err(damaged)?;
    decompressor.set_selection(DecompressionSelection::base().decompress_z());
    Ok(decompressor)
}

/// Checks the layers of a chunk: the first point as it is, the number of points, the lengths of the
/// layers, the layers.
fn check_layers(chunk: &[u8], items: &[LazItem], count: u64, point_bytes: usize) -> Result<()> {
    let found = u64::from(u32::from_le_bytes(field(chunk, point_bytes)?));
    if found != count {
        return Err(FORMAT.syntax(format!("a chunk of {found} points, expected {count}")));
    }
    let lengths = point_bytes + 4;
    let layers: usize = items.iter().map(|item| layers_of(item.item_type())).sum();
    let mut start = lengths + 4 * layers;
    for layer in 0..layers {
        let length = u32::from_le_bytes(field(chunk, lengths + 4 * layer)?) as usize;
        let end = start.saturating_add(length);
        if end > chunk.len() {
            return Err(FORMAT.syntax(format!("a layer of {length} bytes beyond its chunk")));
        }
        if length > 0 {
            check_start(&chunk[..end], start)?;
        }
        start = end;
    }
    Ok(())
}

/// Checks the first number of a coded stream.
fn check_start(bytes: &[u8], place: usize) -> Result<()> {
    match bytes.get(place..).is_some_and(|stream| stream.starts_with(&BEYOND_RANGE)) {
        true => Err(FORMAT.syntax("a coded stream beyond its range")),
        false => Ok(()),
    }
}

fn damaged(error: impl std::fmt::Display) -> Error {
    FORMAT.syntax(error.to_string())
}
