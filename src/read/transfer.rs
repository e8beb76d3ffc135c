//! Bytes by which one wasm module gives another what it read.

#![cfg_attr(
    not(all(feature = "wasm", target_arch = "wasm32")),
    allow(dead_code, reason = "each of the modules either writes or reads, and native code does neither")
)]

use super::assembled::Assembled;
use super::report::{FaceCounts, FaceId, Note, Skipped, interned};
use crate::error::{Error, Result};
use crate::model::ModelArrays;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// The version of the crate, which writer and reader have in common.
const VERSION: &str = env!("CARGO_PKG_VERSION");

#[derive(Serialize, Deserialize)]
struct Transfer<'a> {
    version: Cow<'a, str>,
    model: Cow<'a, ModelArrays>,
    counts: Cow<'a, [FaceCounts]>,
    skipped: Vec<Account>,
    notes: Vec<Account>,
}

/// The account of a face, skipped or with a remark.
#[derive(Serialize, Deserialize)]
struct Account {
    face: usize,
    entity: Option<u64>,
    code: String,
    why: String,
}

impl Assembled {
    /// Returns the faces as bytes, in which every float keeps its bits. O(size).
    ///
    /// # Errors
    /// [`Error::TransferInvalid`] for the faces of a document, which this module does not read; else if
    /// the writer fails, which it does not for these types.
    pub fn to_bytes(&self) -> Result<Vec<u8>> {
        let account = |face: &FaceId, entity, code: &str, why: &str| {
            let FaceId::Number(face) = *face else {
                return Err(Error::TransferInvalid { found: format!("the face {face} has no number") });
            };
            let [code, why] = [code, why].map(str::to_owned);
            Ok(Account { face, entity, code, why })
        };
        let Self { model, counts, skipped, notes, .. } = self;
        let left_out = skipped.iter().map(|one| account(&one.face, one.entity, one.code, &one.why));
        let remarks = notes.iter().map(|note| account(&note.face, None, note.code, &note.why));
        let transfer = Transfer {
            version: VERSION.into(),
            model: Cow::Borrowed(model),
            counts: counts.into(),
            skipped: left_out.collect::<Result<_>>()?,
            notes: remarks.collect::<Result<_>>()?,
        };
        postcard::to_extend(&transfer, Vec::new()).map_err(invalid)
    }

    /// Returns the faces that [`Assembled::to_bytes`] wrote. O(size).
    ///
    /// # Errors
    /// [`Error::TransferInvalid`] for other bytes, and for those of another version.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self> {
        // The version comes first, since another one may have written the rest differently.
        let (version, _) = postcard::take_from_bytes::<String>(bytes).map_err(invalid)?;
        if version != VERSION {
            let found = format!("they are of version {version}, expected {VERSION}");
            return Err(Error::TransferInvalid { found });
        }
        let Transfer { model, counts, skipped, notes, .. } = postcard::from_bytes(bytes).map_err(invalid)?;
        let skipped = skipped.into_iter().map(|Account { face, entity, code, why }| {
            let (face, code) = (face.into(), interned(code));
            Skipped { face, entity, code, why }
        });
        let notes = notes.into_iter().map(|Account { face, code, why, .. }| {
            let (face, code) = (face.into(), interned(code));
            Note { face, code, why }
        });
        Ok(Self {
            model: model.into_owned(),
            counts: counts.into_owned(),
            skipped: skipped.collect(),
            notes: notes.collect(),
            ..Self::default()
        })
    }
}

fn invalid(error: postcard::Error) -> Error {
    Error::TransferInvalid { found: error.to_string() }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::model::trim::{FaceArrays, TrimCurveArrays};
    use crate::model::{InstanceArrays, SurfaceArrays};

    /// Floats that a way through text or float32 changes.
    const FLOATS: [f64; 4] = [-0.0, 5e-324, 0.1, f64::MAX];

    fn read() -> Assembled {
        let curve = TrimCurveArrays {
            degree: 2,
            knots: FLOATS.to_vec(),
            control_points: vec![[-0.0, 1.0 / 3.0, 5e-324]],
            gap: 1e-7,
            edge: Some(u32::MAX),
        };
        let surface = SurfaceArrays {
            degree: [3, 1],
            knots: [FLOATS.to_vec(), vec![]],
            counts: [1, 1],
            control_points: vec![FLOATS],
        };
        let face = FaceArrays {
            surface,
            trim: Some(vec![vec![curve], vec![]]),
            reversed: true,
            face_name: Some("Fläche".to_owned()),
            kind: None,
            gap: -0.0,
            gap_measured: true,
            color: Some([0.1, 0.0, 1.0]),
            shell: Some(7),
            solid: Some(8),
        };
        let instance = InstanceArrays {
            surfaces: vec![0, 0],
            transform: [0.1; 12],
            name: Some("part".to_owned()),
            solid: Some(9),
        };
        Assembled {
            model: ModelArrays {
                name: None,
                unit: Some(0.0254),
                faces: vec![face],
                instances: vec![instance],
            },
            counts: vec![FaceCounts { number: 7, entity: Some(u64::MAX), exact: 1, fitted: 2 }],
            skipped: vec![Skipped { face: 1.into(), entity: Some(77), code: "CODE", why: "why".to_owned() }],
            notes: vec![Note { face: 2.into(), code: "NOTE", why: "ambiguous".to_owned() }],
            shapes: Vec::new(),
        }
    }

    #[test]
    fn bytes_keep_every_bit() {
        let bytes = read().to_bytes().unwrap();
        let (given, taken) = (read(), Assembled::from_bytes(&bytes).unwrap());
        // Equality takes zeros of both signs for equal, their text does not.
        assert_eq!(format!("{:?}", given.model), format!("{:?}", taken.model));
        assert_eq!((given.model, given.counts), (taken.model, taken.counts));
        assert_eq!((given.skipped, given.notes), (taken.skipped, taken.notes));
    }

    #[test]
    fn bytes_that_are_cut_off_or_of_another_version_are_refused() {
        let mut bytes = read().to_bytes().unwrap();
        for length in 0..bytes.len() {
            assert!(Assembled::from_bytes(&bytes[..length]).is_err(), "{length}");
        }
        // The first byte is the length of the version.
        bytes[1] ^= 1;
        let error = Assembled::from_bytes(&bytes).err().unwrap();
        assert_eq!(error.code(), "TRANSFER_INVALID");
        assert!(error.to_string().contains("of version"), "{error}");
    }
}
