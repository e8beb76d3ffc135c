//! Uses of products in others: each stands somewhere, and has a shape.

use super::assembly::{Assembly, Group, Placement};
use super::exchange::{Exchange, reference};
use super::relations::{Relations, items, product_name, referred};
use crate::report::FaceFault;
use std::collections::{HashMap, HashSet};

/// A use of a product in another one, by their definitions.
pub(super) struct Usage {
    number: u64,
    assembly: u64,
    part: u64,
}

/// The entity of such a use.
const USAGE: &str = "NEXT_ASSEMBLY_USAGE_OCCURRENCE";

/// Returns the uses that a file states, in its order.
pub(super) fn usages(file: &Exchange<'_>) -> Vec<Usage> {
    // A complex instance begins with a more general entity.
    let concerned = |&&number: &&u64| {
        let keyword = file.keyword(number);
        keyword == USAGE || keyword == "ASSEMBLY_COMPONENT_USAGE"
    };
    let usage = |&number: &u64| {
        let record = file.record(number).ok()?;
        let own = record.part(USAGE)?;
        let attributes = if own.is_empty() { record.part("PRODUCT_DEFINITION_RELATIONSHIP")? } else { own };
        match attributes {
            [_, _, _, assembly, part, ..] => {
                Some(Usage { number, assembly: reference(assembly)?, part: reference(part)? })
            }
            _ => None,
        }
    };
    file.numbers.iter().filter(concerned).filter_map(usage).collect()
}

impl Assembly<'_> {
    /// Adds the uses that nothing places: their parts stand at an unknown place, and nowhere else.
    pub(super) fn find_unplaced(&mut self, relations: &Relations<'_>) {
        let placed: HashSet<u64> = relations
            .related
            .iter()
            .filter_map(|record| relations.occurrences.get(&record.number).copied())
            .collect();
        let mut others = self.placed_otherwise(relations);
        for usage in usages(self.shapes.file) {
            if placed.contains(&usage.number) {
                continue;
            }
            let [assemblies, parts] =
                [usage.assembly, usage.part].map(|product| self.groups_of(relations, product));
            let mut pairs =
                assemblies.iter().flat_map(|&assembly| parts.iter().map(move |&part| [assembly, part]));
            let is_placed = pairs.any(|pair| {
                let left = others.get_mut(&pair).filter(|count| **count > 0);
                pair[0] == pair[1] || left.map(|count| *count -= 1).is_some()
            });
            if !is_placed {
                self.leave_out(&usage, assemblies.first().copied(), &parts);
            }
        }
    }

    /// Names a use that nothing places, in its assembly if that has a representation.
    fn leave_out(&mut self, usage: &Usage, assembly: Option<Group>, parts: &[Group]) {
        let Usage { number, part, .. } = *usage;
        let why = if parts.is_empty() {
            format!("#{number} uses the product of #{part}, of whose shape the file has no representation")
        } else {
            format!("#{number} uses the product of #{part}, and no relationship or mapped item places it")
        };
        let fault = FaceFault::new("STEP_PLACE", why);
        match (assembly, parts) {
            (Some(assembly), &[child, ..]) => {
                let placement = Placement {
                    entity: number,
                    name: None,
                    child,
                    is_occurrence: false,
                    transform: Err(fault),
                };
                self.placements.entry(assembly).or_default().push(placement);
            }
            _ => self.faults.push((number, fault)),
        }
        self.unplaced.extend(parts);
    }

    /// Returns how often groups are placed in others by what names no use: mapped items, and relationships.
    fn placed_otherwise(&self, relations: &Relations<'_>) -> HashMap<[Group; 2], usize> {
        let file = self.shapes.file;
        let mut counts: HashMap<[Group; 2], usize> = HashMap::new();
        for record in &relations.representations {
            let Some(&parent) = self.group_of.get(&record.number) else { continue };
            for item in items(record).map(|(items, _)| items).unwrap_or_default() {
                let map = referred(file, item, "MAPPED_ITEM", 1);
                let source = map.and_then(|map| referred(file, map, "REPRESENTATION_MAP", 1));
                if let Some(&child) = source.and_then(|source| self.group_of.get(&source)) {
                    *counts.entry([parent, child]).or_default() += 1;
                }
            }
        }
        for (&parent, placements) in &self.placements {
            let unnamed =
                placements.iter().filter(|placement| !relations.occurrences.contains_key(&placement.entity));
            for placement in unnamed {
                *counts.entry([parent, placement.child]).or_default() += 1;
            }
        }
        counts
    }

    /// Returns the groups of the representations of a product.
    fn groups_of(&self, relations: &Relations<'_>, product: u64) -> Vec<Group> {
        let of_product = relations.definitions.iter().filter(|&&(_, definition)| definition == product);
        of_product.filter_map(|(representation, _)| self.group_of.get(representation).copied()).collect()
    }

    /// Returns the reason for which a part that is placed has no shape: its representations hold placements
    /// alone, as those of parts in other files do. `None` for a part of curves or points.
    pub(super) fn blank(&self, child: Group, entity: u64) -> Option<String> {
        let file = self.shapes.file;
        let is_placement = |&item: &u64| file.keyword(item).contains("PLACEMENT");
        let holds_placements = |representation: &u64| {
            let record = file.record(*representation).ok();
            record.and_then(|record| items(&record)).is_some_and(|(items, _)| items.iter().all(is_placement))
        };
        let representations = self.groups.get(&child)?;
        let is_blank = !self.assemblies.contains(&child) && representations.iter().all(holds_placements);
        let name = self.names.get(&child).map(|name| format!(" {name:?}")).unwrap_or_default();
        is_blank.then(|| format!("#{entity} places the part{name}, of whose shape the file has nothing"))
    }
}

impl Assembly<'_> {
    /// Names the products whose shape is in another file, of which this one has none, and which no use names.
    pub(super) fn find_external(&mut self, relations: &Relations<'_>) {
        let file = self.shapes.file;
        let documented = documented(file);
        let used: HashSet<u64> = usages(file).iter().flat_map(|usage| [usage.assembly, usage.part]).collect();
        let represented: HashSet<u64> =
            relations.definitions.iter().map(|&(_, definition)| definition).collect();
        for &number in file.numbers.iter().filter(|&&number| is_definition(file, number)) {
            let is_external = chain(file, number).iter().any(|one| documented.contains(one));
            if !is_external
                || used.contains(&number)
                || represented.contains(&number)
                || is_document(file, number)
            {
                continue;
            }
            let name = product_name(file, number).map(|name| format!(" {name:?}")).unwrap_or_default();
            let why = format!("the shape of the product{name} of #{number} is in another file");
            self.faults.push((number, FaceFault::new("STEP_EXTERNAL", why)));
        }
    }
}

/// Returns whether an instance defines a product.
fn is_definition(file: &Exchange<'_>, instance: u64) -> bool {
    matches!(file.keyword(instance), "PRODUCT_DEFINITION" | "PRODUCT_DEFINITION_WITH_ASSOCIATED_DOCUMENTS")
}

/// Returns whether a definition is that of a document, by its context: documents are managed as products.
fn is_document(file: &Exchange<'_>, definition: u64) -> bool {
    let context = file.entity(definition).and_then(|entity| file.entity(entity.reference(3)?));
    context.is_ok_and(|context| context.name().is_some_and(|name| name.to_lowercase().contains("document")))
}

/// Returns the instances to which documents are assigned, as products whose shape is in another file.
pub(super) fn documented(file: &Exchange<'_>) -> HashSet<u64> {
    let mut found = HashSet::new();
    for &number in &file.numbers {
        let keyword = file.keyword(number);
        if keyword == "PRODUCT_DEFINITION_WITH_ASSOCIATED_DOCUMENTS" {
            found.insert(number);
        }
        let assigns = keyword.ends_with("DOCUMENT_REFERENCE")
            || keyword.ends_with("EXTERNAL_IDENTIFICATION_ASSIGNMENT");
        if let Some(entity) = assigns.then(|| file.entity(number).ok()).flatten() {
            found.extend(entity.all_references());
        }
    }
    found
}

/// Returns a definition of a product, its formation and its product.
pub(super) fn chain(file: &Exchange<'_>, definition: u64) -> Vec<u64> {
    let formation = referred(file, definition, "PRODUCT_DEFINITION", 2);
    let product =
        formation.and_then(|formation| referred(file, formation, "PRODUCT_DEFINITION_FORMATION", 2));
    std::iter::once(definition).chain(formation).chain(product).collect()
}
