//! Representations, and the instances that relate them to each other and to products.

use super::exchange::{Entity, Exchange, Record, Value, decoded, reference};
use crate::report::FaceFault;
use std::collections::{HashMap, HashSet};

/// The instances that say what stands where.
#[derive(Default)]
pub(super) struct Relations<'a> {
    pub(super) representations: Vec<Record<'a>>,
    /// Relationships of two representations.
    pub(super) related: Vec<Record<'a>>,
    /// The instances of uses of products in others, by those of the relationships that place them.
    pub(super) occurrences: HashMap<u64, u64>,
    /// The representations of definitions of products.
    pub(super) definitions: Vec<(u64, u64)>,
    /// Representations of aspects of shapes, to which properties belong. They may name bodies of other
    /// representations.
    pub(super) of_aspects: HashSet<u64>,
    /// Relationships that cannot be read, so that parts may not be where they are.
    pub(super) faults: Vec<(u64, FaceFault)>,
}

impl<'a> Relations<'a> {
    pub(super) fn of(file: &Exchange<'a>) -> Self {
        let mut relations = Self::default();
        for &number in &file.numbers {
            let keyword = file.keyword(number);
            let concerned =
                keyword.contains("REPRESENTATION") && !keyword.starts_with("GEOMETRIC_REPRESENTATION");
            if !concerned {
                continue;
            }
            match file.record(number) {
                Ok(record) => relations.add(file, record),
                // The shells of a representation that is not read are reported themselves.
                Err(fault) if keyword.contains("RELATIONSHIP") => relations.faults.push((number, fault)),
                Err(_) => {}
            }
        }
        relations
    }

    fn add(&mut self, file: &Exchange<'a>, record: Record<'a>) {
        if let Some([relationship, product, ..]) = record.part("CONTEXT_DEPENDENT_SHAPE_REPRESENTATION") {
            if let (Some(relationship), Some(product)) = (reference(relationship), reference(product))
                && let Some(occurrence) = referred(file, product, "PRODUCT_DEFINITION_SHAPE", 2)
            {
                self.occurrences.insert(relationship, occurrence);
            }
        } else if let Some([definition, representation, ..]) = record.part("SHAPE_DEFINITION_REPRESENTATION")
        {
            if let (Some(definition), Some(representation)) =
                (reference(definition), reference(representation))
            {
                let shape = referred(file, definition, "PRODUCT_DEFINITION_SHAPE", 2);
                let defined = shape.or_else(|| referred(file, definition, "PROPERTY_DEFINITION", 2));
                if defined.is_some_and(|defined| file.keyword(defined).ends_with("SHAPE_ASPECT")) {
                    self.of_aspects.insert(representation);
                } else if let Some(product) = shape {
                    self.definitions.push((representation, product));
                }
            }
        } else if relationship(&record).is_some() {
            self.related.push(record);
        } else if items(&record).is_some() {
            self.representations.push(record);
        }
    }
}

/// Returns the two representations that a relationship of shapes relates.
pub(super) fn relationship(record: &Record<'_>) -> Option<[u64; 2]> {
    const KINDS: [&str; 3] = [
        "REPRESENTATION_RELATIONSHIP",
        "SHAPE_REPRESENTATION_RELATIONSHIP",
        "REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION",
    ];
    KINDS.iter().filter_map(|kind| record.part(kind)).find_map(|attributes| match attributes {
        [_, _, first, second, ..] => Some([reference(first)?, reference(second)?]),
        _ => None,
    })
}

/// Returns the transformation of a relationship.
pub(super) fn transformation(record: &Record<'_>) -> Option<u64> {
    reference(record.part("REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION")?.last()?)
}

/// Returns the items and the context of a representation of a shape.
pub(super) fn items(record: &Record<'_>) -> Option<(Vec<u64>, u64)> {
    let attributes = record.part("REPRESENTATION").or_else(|| {
        let kind = record.kind();
        record.part(&kind).filter(|_| kind.contains("SHAPE_REPRESENTATION"))
    });
    match attributes? {
        [_, Value::List(items), Value::Reference(context), ..] => {
            Some((items.iter().filter_map(reference).collect(), *context))
        }
        _ => None,
    }
}

/// Returns the reference that is an attribute of an instance of this kind.
pub(super) fn referred(file: &Exchange<'_>, instance: u64, kind: &str, attribute: usize) -> Option<u64> {
    if !file.keyword(instance).starts_with(kind) {
        return None;
    }
    file.entity(instance).ok()?.reference(attribute).ok()
}

/// Returns the name of the product that a definition defines.
pub(super) fn product_name(file: &Exchange<'_>, definition: u64) -> Option<String> {
    let formation = referred(file, definition, "PRODUCT_DEFINITION", 2)?;
    let product = file.entity(referred(file, formation, "PRODUCT_DEFINITION_FORMATION", 2)?).ok()?;
    // The name, else the identifier.
    text(&product, 1).or_else(|| text(&product, 0))
}

/// The name that Creo gives to every use of a product in another one.
const OF_ALL_USES: &str = "Next assembly relationship";

/// Returns the name of a use of a product in another one, else its designator; none for numbers that
/// writers give to all, as `NAUO12`, for the labels of OpenCASCADE's documents, as `=>[0:1:1:2]`, and for what Creo
/// calls every use.
pub(super) fn occurrence_name(file: &Exchange<'_>, occurrence: u64) -> Option<String> {
    let entity = file.entity(occurrence).ok()?;
    let is_telling = |name: &String| {
        let number = name.strip_prefix("NAUO").unwrap_or(name).trim();
        let is_of_all = name.eq_ignore_ascii_case(OF_ALL_USES) || name.starts_with("=>[");
        !is_of_all && !number.bytes().all(|byte| byte.is_ascii_digit())
    };
    text(&entity, 1).filter(is_telling).or_else(|| text(&entity, 5).filter(is_telling))
}

/// Returns a text that is not blank.
fn text(entity: &Entity<'_>, attribute: usize) -> Option<String> {
    match entity.value(attribute) {
        Value::Text(bytes) => Some(decoded(bytes)).filter(|text| !text.trim().is_empty()),
        _ => None,
    }
}
