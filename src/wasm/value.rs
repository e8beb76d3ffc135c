//! Small JavaScript values as data for serde.
//!
//! Unlike `serde-wasm-bindgen`, which carries every kind of value, this knows
//! numbers, texts, flags and short arrays, and it sees unknown names.

use js_sys::{Array, ArrayBuffer, Object};
use serde::de::value::SeqDeserializer;
use serde::de::{DeserializeSeed, Deserializer, Expected, IntoDeserializer, MapAccess, Unexpected, Visitor};
use serde::forward_to_deserialize_any;
use std::fmt::Display;
use wasm_bindgen::{JsCast, JsValue};

/// Whole numbers below this, 2^53, are exact in float64.
const LEAST_INEXACT: f64 = 9_007_199_254_740_992.0;

/// What was expected, or what else is wrong.
#[derive(Debug)]
pub(super) struct Mismatch(pub(super) String);

impl Display for Mismatch {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(&self.0)
    }
}

impl std::error::Error for Mismatch {}

impl serde::de::Error for Mismatch {
    fn custom<T: Display>(message: T) -> Self {
        Self(message.to_string())
    }

    fn invalid_type(_found: Unexpected<'_>, expected: &dyn Expected) -> Self {
        Self(format!("expected {expected}"))
    }

    fn invalid_value(_found: Unexpected<'_>, expected: &dyn Expected) -> Self {
        Self(format!("expected {expected}"))
    }
}

/// A number, text, flag or tuple.
pub(super) struct Value(pub(super) JsValue);

impl Value {
    /// A whole number of at least 0 that float64 tells from its neighbours.
    fn whole(&self) -> Option<u64> {
        let number = self.0.as_f64()?;
        let whole = number.fract() == 0.0 && (0.0..LEAST_INEXACT).contains(&number);
        whole.then_some(number as u64)
    }

    fn items(&self) -> Option<Vec<JsValue>> {
        let value = &self.0;
        (Array::is_array(value) || ArrayBuffer::is_view(value)).then(|| Array::from(value).to_vec())
    }
}

fn expected<T>(what: &dyn Expected) -> Result<T, Mismatch> {
    Err(Mismatch(format!("expected {what}")))
}

/// Each method reads one kind of value and nothing else, so that no option
/// carries the code of all kinds.
macro_rules! read {
    ($read:expr, $visit:ident: $($method:ident)+) => {
        $(fn $method<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Mismatch> {
            match $read(&self) {
                Some(value) => visitor.$visit(value),
                None => expected(&visitor),
            }
        })+
    };
}

impl<'de> IntoDeserializer<'de, Mismatch> for Value {
    type Deserializer = Self;

    fn into_deserializer(self) -> Self {
        self
    }
}

impl<'de> Deserializer<'de> for Value {
    type Error = Mismatch;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Mismatch> {
        expected(&visitor)
    }

    read!(Self::whole, visit_u64:
        deserialize_u8 deserialize_u16 deserialize_u32 deserialize_u64);
    read!(|value: &Self| value.0.as_f64(), visit_f64: deserialize_f32 deserialize_f64);
    read!(|value: &Self| value.0.as_bool(), visit_bool: deserialize_bool);

    fn deserialize_tuple<V: Visitor<'de>>(self, _: usize, visitor: V) -> Result<V::Value, Mismatch> {
        let Some(items) = self.items() else { return expected(&visitor) };
        let mut items = SeqDeserializer::new(items.into_iter().map(Value));
        let value = visitor.visit_seq(&mut items)?;
        items.end()?;
        Ok(value)
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Mismatch> {
        if self.0.is_null() { visitor.visit_none() } else { visitor.visit_some(self) }
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _name: &'static str,
        _variants: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Mismatch> {
        match self.0.as_string() {
            Some(text) => visitor.visit_enum(text.into_deserializer()),
            None => expected(&"a text"),
        }
    }

    forward_to_deserialize_any! {
        i8 i16 i32 i64 i128 u128 char str string bytes byte_buf unit unit_struct newtype_struct seq
        tuple_struct map struct identifier ignored_any
    }
}

/// The properties of an object that are not undefined.
pub(super) struct Properties {
    rest: std::vec::IntoIter<(String, JsValue)>,
    current: Option<(String, JsValue)>,
}

impl Properties {
    /// # Errors
    /// [`Mismatch`] for what is no object.
    pub(super) fn of(value: &JsValue) -> Result<Self, Mismatch> {
        let Some(object) = value.dyn_ref::<Object>() else {
            return Err(Mismatch(format!("found {}, expected an object", described(value))));
        };
        let property = |entry: JsValue| {
            let entry: Array = entry.unchecked_into();
            let value = entry.get(1);
            (!value.is_undefined()).then(|| (entry.get(0).as_string().unwrap_or_default(), value))
        };
        let all: Vec<_> = Object::entries(object).iter().filter_map(property).collect();
        Ok(Self { rest: all.into_iter(), current: None })
    }

    fn value(&self) -> Value {
        Value(self.current.as_ref().map_or(JsValue::UNDEFINED, |(_, value)| value.clone()))
    }

    fn at_current(&self, error: &Mismatch) -> Mismatch {
        let (name, value) = self.current.clone().unwrap_or_default();
        Mismatch(format!("{name} is {}, {error}", described(&value)))
    }

    /// These without the one of that name, and its value.
    pub(super) fn without(self, name: &str) -> (Self, Option<JsValue>) {
        let (named, others): (Vec<_>, Vec<_>) = self.rest.partition(|(of, _)| of == name);
        let value = named.into_iter().next().map(|(_, value)| value);
        (Self { rest: others.into_iter(), current: None }, value)
    }
}

impl<'de> MapAccess<'de> for Properties {
    type Error = Mismatch;

    fn next_key_seed<K: DeserializeSeed<'de>>(&mut self, seed: K) -> Result<Option<K::Value>, Mismatch> {
        self.current = self.rest.next();
        let Some((name, _)) = &self.current else { return Ok(None) };
        seed.deserialize(name.as_str().into_deserializer()).map(Some)
    }

    fn next_value_seed<T: DeserializeSeed<'de>>(&mut self, seed: T) -> Result<T::Value, Mismatch> {
        seed.deserialize(self.value()).map_err(|error| self.at_current(&error))
    }
}

impl<'de> Deserializer<'de> for Properties {
    type Error = Mismatch;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Mismatch> {
        visitor.visit_map(self)
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf unit
        unit_struct newtype_struct seq tuple tuple_struct map struct identifier ignored_any option enum
    }
}

/// A number or text itself, else the value's type.
pub(super) fn described(value: &JsValue) -> String {
    match (value.as_f64(), value.as_string()) {
        (Some(number), _) => crate::shown::Shown(number).to_string(),
        (None, Some(text)) => format!("\"{text}\""),
        (None, None) if value.is_null() => "null".to_owned(),
        (None, None) => value.js_typeof().as_string().unwrap_or_default(),
    }
}
