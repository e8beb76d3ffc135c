//! Numbers of VTK's types, in bytes.

/// A type of numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Float,
    Signed,
    Unsigned,
}

/// A type of numbers with its size in bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Type {
    pub(super) kind: Kind,
    pub(super) size: usize,
}

impl Type {
    /// Returns the type of a name, of the legacy format or of XML.
    pub(super) fn named(name: &str) -> Option<Self> {
        let name = name.to_ascii_lowercase();
        let (kind, size) = match name.as_str() {
            "float" | "float32" => (Kind::Float, 4),
            "double" | "float64" => (Kind::Float, 8),
            "char" | "signed_char" | "int8" | "vtktypeint8" => (Kind::Signed, 1),
            "short" | "int16" | "vtktypeint16" => (Kind::Signed, 2),
            // The identifiers of legacy files are written in four bytes.
            "int" | "int32" | "vtktypeint32" | "vtkidtype" => (Kind::Signed, 4),
            "long" | "int64" | "vtktypeint64" => (Kind::Signed, 8),
            "unsigned_char" | "uint8" | "vtktypeuint8" => (Kind::Unsigned, 1),
            "unsigned_short" | "uint16" | "vtktypeuint16" => (Kind::Unsigned, 2),
            "unsigned_int" | "uint32" | "vtktypeuint32" => (Kind::Unsigned, 4),
            "unsigned_long" | "uint64" | "vtktypeuint64" => (Kind::Unsigned, 8),
            _ => return None,
        };
        Some(Self { kind, size })
    }

    /// Returns the numbers of bytes, the most significant byte first if `is_big`.
    pub(super) fn numbers(self, bytes: &[u8], is_big: bool) -> Vec<f64> {
        bytes.chunks_exact(self.size).map(|number| self.number(number, is_big)).collect()
    }

    fn number(self, bytes: &[u8], is_big: bool) -> f64 {
        let bits = bytes.iter().enumerate().fold(0_u64, |bits, (at, &byte)| {
            let place = if is_big { bytes.len() - 1 - at } else { at };
            bits | u64::from(byte) << (8 * place)
        });
        match (self.kind, self.size) {
            (Kind::Float, 4) => f64::from(f32::from_bits(bits as u32)),
            (Kind::Float, _) => f64::from_bits(bits),
            (Kind::Unsigned, _) => bits as f64,
            (Kind::Signed, size) => {
                // The sign is that of the highest bit of the number.
                let unused = 64 - 8 * size as u32;
                ((bits << unused) as i64 >> unused) as f64
            }
        }
    }
}
