//! Pieces for the stages of method `certified`: coefficients, centres, bounds.

use crate::bezier::{BEYOND, Patch};
use crate::certified::Operand;
use crate::error::{Error, Result};
use crate::gpu::Gpu;
use crate::gpu::certified::float32_error::{PieceError, normal_weight, scaled};
use crate::gpu::float32::{rounded, rounded_up};
use crate::gpu::iteration::layouts::Piece;
use crate::gpu::{Pieces, Place};
use glam::DVec3;

/// Where the kernels' coordinates lie.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PieceFrame {
    pub(crate) origin: DVec3,
    pub(crate) scale: f64,
    /// Unit of the centres, a power of two.
    pub(crate) grid: f64,
}

/// Pieces on the GPU, group by group.
#[derive(Debug)]
pub(crate) struct GpuPieces {
    pub(crate) pieces: wgpu::Buffer,
    pub(crate) groups: Vec<PieceGroup>,
    /// The piece of every piece on the GPU, and the other way round.
    order: Vec<u32>,
    places: Vec<u32>,
}

impl GpuPieces {
    /// Where a piece lies on the GPU.
    pub(crate) fn index_of(&self, piece: usize) -> u32 {
        self.places[piece]
    }

    /// The piece that a kernel wrote the index of.
    ///
    /// # Errors
    /// [`Error::GpuFailed`] if there is none.
    pub(crate) fn piece(&self, index: u32) -> Result<usize> {
        let found = || format!("a kernel wrote piece {index} of {}", self.order.len());
        let piece = self.order.get(index as usize).ok_or_else(|| Error::GpuFailed { found: found() })?;
        Ok(*piece as usize)
    }
}

/// Pieces of one pair of degrees.
#[derive(Debug)]
pub(crate) struct PieceGroup {
    pub(crate) degree: [usize; 2],
    pub(crate) first: usize,
    pub(crate) count: usize,
    pub(crate) coefficients: wgpu::Buffer,
}

/// What holds of a piece: over it alone, or a little beyond it too, as far as
/// its controls tell points of the side.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Reach<'a> {
    Piece,
    Beyond(&'a Operand<'a>),
}

impl Gpu {
    /// Uploads the pieces in the order of `groups`.
    pub(crate) fn upload_pieces(
        &self,
        pieces: &Pieces,
        groups: &[([usize; 2], Vec<u32>)],
        reach: Reach<'_>,
        frame: &PieceFrame,
    ) -> GpuPieces {
        let mut order: Vec<u32> = Vec::with_capacity(pieces.places.len());
        let mut records: Vec<Piece> = Vec::with_capacity(pieces.places.len());
        let mut uploaded = Vec::with_capacity(groups.len());
        for (degree, members) in groups {
            let mut coefficients: Vec<[f32; 4]> = Vec::new();
            for &member in members {
                let patch = pieces.patches.patch(member as usize);
                let lighter = normal_weight(&patch);
                for c in patch.monomials() {
                    coefficients.push(rounded(scaled(c, lighter, frame.scale)));
                }
                records.push(record(&patch, &pieces.places[member as usize], reach, frame));
            }
            uploaded.push(PieceGroup {
                degree: *degree,
                first: order.len(),
                count: members.len(),
                coefficients: self.upload("coefficients", &coefficients),
            });
            order.extend_from_slice(members);
        }
        let mut places = vec![0; order.len()];
        for (index, &piece) in order.iter().enumerate() {
            places[piece as usize] = index as u32;
        }
        GpuPieces { pieces: self.upload("pieces", &records), groups: uploaded, order, places }
    }
}

fn record(patch: &Patch<'_>, place: &Place, reach: Reach<'_>, frame: &PieceFrame) -> Piece {
    let error = PieceError::of(patch, frame.scale);
    let own = patch.derivative_bounds();
    // By (σ, τ): half the piece's parameters, a part of the patch's.
    let (bounds, [h, k], low, high) = match reach {
        Reach::Piece => (own, [0.5; 2], [-1.0; 2], [1.0; 2]),
        Reach::Beyond(side) => {
            let room = side.room(place.patch);
            let low = [0, 1].map(|axis| (place.low[axis] - BEYOND).max(room[axis][0]));
            let high = [0, 1].map(|axis| (place.low[axis] + place.width[axis] + BEYOND).min(room[axis][1]));
            (
                side.bounds(place.patch, low, high),
                place.width.map(|width| 0.5 * width),
                [0, 1].map(|axis| place.local(axis, low[axis])),
                [0, 1].map(|axis| place.local(axis, high[axis])),
            )
        }
    };
    let up = |value: f64| rounded_up(frame.scale * value);
    let [ss, st, tt] = bounds.second;
    let [sss, sst, stt, ttt] = bounds.third;
    let center = frame.scale / frame.grid * (patch.center - frame.origin);
    Piece {
        center: center.to_array().map(|x| x.round() as i32),
        value_error: rounded_up(error.value),
        first_error: error.first.map(rounded_up),
        first: [up(h * bounds.first[0]), up(k * bounds.first[1])],
        second_error: error.second.map(rounded_up),
        radius: up(own.radius),
        second: [up(h * h * ss), up(h * k * st), up(k * k * tt)],
        padding: 0.0,
        third: [up(h * h * h * sss), up(h * h * k * sst), up(h * k * k * stt), up(k * k * k * ttt)],
        // Dyadic numbers of few digits, so exact.
        low: low.map(|x| x as f32),
        high: high.map(|x| x as f32),
    }
}
