//! Options from the properties of plain JavaScript objects.
//!
//! Unlike serde's derived code, which is large for every field, one loop goes
//! through a list of places, and it sees unknown names.

use crate::closest::Projection;
use crate::engine::{Backend, Method};
use crate::flatness::Flatness;
use crate::iteration::{Culling, SamplingRule};
use js_sys::{Array, ArrayBuffer, Object};
use wasm_bindgen::{JsCast, JsValue};

/// Values by their names, in the order told.
pub(super) type Names<T> = &'static [(&'static str, T)];

pub(super) const BACKENDS: Names<Backend> =
    &[("auto", Backend::Auto), ("gpu", Backend::Gpu), ("cpu", Backend::Cpu)];
const METHODS: Names<Method> =
    &[("certified", Method::Certified), ("iteration", Method::Iteration), ("hierarchy", Method::Hierarchy)];
const SAMPLINGS: Names<SamplingRule> =
    &[("uniform", SamplingRule::Uniform), ("arc-length", SamplingRule::ArcLength)];
const FLATNESSES: Names<Flatness> = &[
    ("none", Flatness::None),
    ("loose", Flatness::Loose),
    ("tight", Flatness::Tight),
    ("curvature", Flatness::Curvature),
];
const PROJECTIONS: Names<Projection> =
    &[("newton", Projection::Newton), ("tangent-plane", Projection::TangentPlane)];
const CULLINGS: Names<Culling> = &[("tree", Culling::Tree), ("none", Culling::None)];

/// Where the value of a property goes, by its type.
pub(super) enum Place<'a> {
    Flag(&'a mut bool),
    Number(&'a mut f64),
    /// Null is none.
    OptionalNumber(&'a mut Option<f64>),
    Count(&'a mut usize),
    /// Null is none.
    OptionalCount(&'a mut Option<usize>),
    Steps(&'a mut u32),
    /// As many numbers as there are; null leaves them.
    Numbers(&'a mut [f64]),
    /// To be read on its own.
    Object(&'a mut JsValue),
    Backend(&'a mut Backend),
    Method(&'a mut Method),
    Sampling(&'a mut SamplingRule),
    Flatness(&'a mut Flatness),
    Projection(&'a mut Projection),
    Culling(&'a mut Culling),
}

impl Place<'_> {
    /// # Errors
    /// What is expected.
    fn take(&mut self, value: &JsValue) -> Result<(), String> {
        match self {
            Self::Flag(flag) => **flag = value.as_bool().ok_or("a boolean")?,
            Self::Number(to) => **to = number(value)?,
            Self::Count(count) => **count = whole(value)? as usize,
            Self::Steps(steps) => **steps = whole(value)?,
            Self::Object(object) => **object = value.clone(),
            Self::Backend(backend) => **backend = named(value, BACKENDS)?,
            Self::Method(method) => **method = named(value, METHODS)?,
            Self::Sampling(sampling) => **sampling = named(value, SAMPLINGS)?,
            Self::Flatness(flatness) => **flatness = named(value, FLATNESSES)?,
            Self::Projection(projection) => **projection = named(value, PROJECTIONS)?,
            Self::Culling(culling) => **culling = named(value, CULLINGS)?,
            _ if value.is_null() => {}
            Self::OptionalNumber(to) => **to = Some(number(value)?),
            Self::OptionalCount(count) => **count = Some(whole(value)? as usize),
            Self::Numbers(numbers) => {
                let listed = Array::is_array(value) || ArrayBuffer::is_view(value);
                let items = if listed { Array::from(value) } else { Array::new() };
                if !listed || items.length() as usize != numbers.len() {
                    return Err(format!("an array of length {}", numbers.len()));
                }
                for (index, to) in numbers.iter_mut().enumerate() {
                    *to = number(&items.get(index as u32))?;
                }
            }
        }
        Ok(())
    }
}

fn number(value: &JsValue) -> Result<f64, String> {
    value.as_f64().ok_or_else(|| "a number".to_owned())
}

/// A whole number of at least 0 that `usize` holds.
fn whole(value: &JsValue) -> Result<u32, String> {
    let number = value.as_f64().unwrap_or(f64::NAN);
    let whole = number as u32;
    if f64::from(whole) == number { Ok(whole) } else { Err("a whole number".to_owned()) }
}

/// # Errors
/// The names that there are.
pub(super) fn named<T: Copy>(value: &JsValue, names: Names<T>) -> Result<T, String> {
    let text = value.as_string();
    match names.iter().find(|(name, _)| text.as_deref() == Some(name)) {
        Some(&(_, found)) => Ok(found),
        None => Err(one_of(names.iter().map(|&(name, _)| name))),
    }
}

fn one_of<'a>(names: impl Iterator<Item = &'a str>) -> String {
    let mut text = "one of".to_owned();
    for name in names {
        text.push_str(if text.ends_with('`') { ", `" } else { " `" });
        text.push_str(name);
        text.push('`');
    }
    text
}

/// Takes the object's properties that are not undefined to their places, each
/// read once.
///
/// # Errors
/// What is wrong: no object, a name without a place, a value of another type.
pub(super) fn take(value: &JsValue, places: &mut [(&str, Place<'_>)]) -> Result<(), String> {
    let Some(object) = value.dyn_ref::<Object>() else {
        return Err(format!("found {}, expected an object", described(value)));
    };
    for entry in Object::entries(object).iter() {
        let entry: Array = entry.unchecked_into();
        let (name, value) = (entry.get(0).as_string().unwrap_or_default(), entry.get(1));
        if value.is_undefined() {
            continue;
        }
        let Some((_, place)) = places.iter_mut().find(|(of, _)| *of == name) else {
            let expected = one_of(places.iter().map(|&(name, _)| name));
            return Err(format!("unknown field `{name}`, expected {expected}"));
        };
        place.take(&value).map_err(|expected| mismatch(&name, &value, &expected))?;
    }
    Ok(())
}

pub(super) fn mismatch(name: &str, value: &JsValue, expected: &str) -> String {
    format!("{name} is {}, expected {expected}", described(value))
}

/// A number or text itself, else the value's type.
fn described(value: &JsValue) -> String {
    match (value.as_f64(), value.as_string()) {
        (Some(number), _) => crate::shown::Shown(number).to_string(),
        (None, Some(text)) => format!("\"{text}\""),
        (None, None) if value.is_null() => "null".to_owned(),
        (None, None) => value.js_typeof().as_string().unwrap_or_default(),
    }
}
