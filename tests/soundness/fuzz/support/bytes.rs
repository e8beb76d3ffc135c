//! Numbers and choices from a sequence of bytes.

/// Values at which float64 arithmetic overflows, underflows or loses digits.
const EXTREME: [f64; 24] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::MAX,
    f64::MIN,
    f64::MIN_POSITIVE,
    5e-324,
    f64::EPSILON,
    1.0 + f64::EPSILON,
    1.0 - f64::EPSILON,
    1e100,
    -1e100,
    1.000_000_000_000_001e100,
    1e-100,
    9.9e-101,
    1e50,
    1e-50,
    1e16,
    -1e9,
    1e-9,
];

/// A reader of bytes, which continues with zeros after their end.
pub struct Bytes<'a>(&'a [u8]);

impl<'a> Bytes<'a> {
    pub fn new(bytes: &'a [u8]) -> Self {
        Self(bytes)
    }

    pub fn byte(&mut self) -> u8 {
        let Some((&first, rest)) = self.0.split_first() else { return 0 };
        self.0 = rest;
        first
    }

    pub fn flag(&mut self) -> bool {
        self.byte() & 1 == 1
    }

    /// A number below `count`, which is at most 256.
    pub fn below(&mut self, count: usize) -> usize {
        usize::from(self.byte()) % count
    }

    pub fn choose<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[self.below(choices.len())]
    }

    /// A multiple of 1/16 in [-8, 8).
    pub fn coordinate(&mut self) -> f64 {
        f64::from(self.byte().cast_signed()) / 16.0
    }

    /// A number in [0, 1], at either end too.
    pub fn unit(&mut self) -> f64 {
        f64::from(self.byte()) / 255.0
    }

    /// Any float64: an extreme one, a small one or eight bytes as they are.
    pub fn number(&mut self) -> f64 {
        match self.byte() {
            kind @ 0..=95 => EXTREME[usize::from(kind) % EXTREME.len()],
            96..=223 => self.coordinate(),
            _ => f64::from_le_bytes([(); 8].map(|()| self.byte())),
        }
    }
}
