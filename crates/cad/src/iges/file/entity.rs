//! An entity and its parameters.

use super::Found;
use super::directory::Entry;
use super::values::Value;
use crate::report::FaceFault;
use glam::DVec3;

/// The largest coordinate and length: squares and products of a few of them are finite.
const LARGEST: f64 = 1e100;

/// An entity. Parameters are numbered from 1, as in the standard.
#[derive(Debug)]
pub(in crate::iges) struct Entity {
    pub(in crate::iges) entry: Entry,
    /// The type, and the parameters behind it.
    values: Vec<Value>,
}

impl Entity {
    pub(super) fn new(entry: Entry, values: Vec<Value>) -> Self {
        Self { entry, values }
    }

    pub(in crate::iges) fn number(&self) -> u64 {
        self.entry.number
    }

    /// Returns the fault of a parameter that is not `expected`.
    pub(in crate::iges) fn fault(&self, index: usize, expected: &str) -> FaceFault {
        let why = format!(
            "parameter {index} of entity {}, type {}, is not {expected}",
            self.entry.number, self.entry.kind
        );
        FaceFault::new("IGES_PARAMETER", why)
    }

    /// Returns the fault of an entity that stands where `expected` is needed.
    pub(in crate::iges) fn unknown(&self, expected: &str) -> FaceFault {
        let Entry { number, kind, form, .. } = self.entry;
        let why = format!("entity {number} is of type {kind}, form {form}, expected {expected}");
        FaceFault::new("IGES_ENTITY", why)
    }

    /// Returns a parameter; one that is not there is left out.
    fn value(&self, index: usize) -> &Value {
        self.values.get(index).unwrap_or(&Value::Omitted)
    }

    /// Returns the text of a parameter that is one.
    pub(in crate::iges) fn text(&self, index: usize) -> Option<&str> {
        match self.value(index) {
            Value::Text(text) => Some(text),
            _ => None,
        }
    }

    /// Returns a number of at most 1e100; 0 if it is left out.
    pub(in crate::iges) fn real(&self, index: usize) -> Found<f64> {
        match *self.value(index) {
            Value::Number(number) if number.abs() <= LARGEST => Ok(number),
            Value::Omitted if index < self.values.len() => Ok(0.0),
            _ => Err(self.fault(index, "a number of at most 1e100")),
        }
    }

    /// Returns a number, or nothing where the parameter is left out.
    pub(in crate::iges) fn optional_real(&self, index: usize) -> Found<Option<f64>> {
        if *self.value(index) == Value::Omitted { Ok(None) } else { self.real(index).map(Some) }
    }

    /// Returns numbers that follow each other.
    ///
    /// # Errors
    /// `IGES_PARAMETER` if there are fewer, before memory is taken for them.
    pub(in crate::iges) fn reals(&self, start: usize, count: usize) -> Found<Vec<f64>> {
        if start.checked_add(count).is_none_or(|end| end > self.values.len()) {
            return Err(self.fault(self.values.len(), &format!("followed by {count} numbers from {start}")));
        }
        (start..start + count).map(|index| self.real(index)).collect()
    }

    /// Returns three coordinates.
    pub(in crate::iges) fn point(&self, start: usize) -> Found<DVec3> {
        Ok(DVec3::new(self.real(start)?, self.real(start + 1)?, self.real(start + 2)?))
    }

    /// Returns an integer from 0 to `largest`.
    pub(in crate::iges) fn count(&self, index: usize, largest: usize) -> Found<usize> {
        let number = self.real(index)?;
        if number >= 0.0 && number <= largest as f64 && number.fract() == 0.0 {
            Ok(number as usize)
        } else {
            Err(self.fault(index, &format!("an integer, 0 to {largest}")))
        }
    }

    /// Returns the number of an entity, or 0 for none.
    pub(in crate::iges) fn pointer(&self, index: usize) -> Found<u64> {
        Ok(self.count(index, u32::MAX as usize)? as u64)
    }

    /// Returns the number of an entity, or 0 where the parameter is left out.
    pub(in crate::iges) fn optional(&self, index: usize) -> Found<u64> {
        if index < self.values.len() { self.pointer(index) } else { Ok(0) }
    }

    /// Returns the number of an entity.
    pub(in crate::iges) fn reference(&self, index: usize) -> Found<u64> {
        match self.pointer(index)? {
            0 => Err(self.fault(index, "a reference")),
            number => Ok(number),
        }
    }

    /// Returns the count at an index, of items that have `size` parameters each behind it.
    pub(in crate::iges) fn items(&self, index: usize, size: usize) -> Found<usize> {
        let room = self.values.len().saturating_sub(index + 1) / size;
        self.count(index, room)
    }

    /// Returns the references whose number stands at an index.
    pub(in crate::iges) fn references(&self, index: usize) -> Found<Vec<u64>> {
        let count = self.items(index, 1)?;
        (index + 1..=index + count).map(|at| self.reference(at)).collect()
    }
}
