//! Representations, the products that they are of, and their placements.

use super::exchange::Exchange;
use super::geometry::{Scale, operator};
use super::relations::{
    Relations, items, occurrence_name, product_name, referred, relationship, transformation,
};
use super::shapes::{Shapes, used};
use super::units::{METRES, Units};
use super::usages::{chain, documented};
use crate::report::{FaceFault, Remark};
use crate::topology::{ShapeKind, Topology, Use};
use glam::DAffine3;
use std::collections::{BTreeMap, HashMap, HashSet};

/// The deepest nesting of assemblies: each level takes stack, and is part of the name of every face in it. A file of
/// more is refused, as its parts would stand nowhere.
const MAX_NESTING: usize = 64;

/// A group of representations in one coordinate system, by the first of them.
pub(super) type Group = u64;

/// A group placed in another one.
pub(super) struct Placement {
    /// The relationship that places it, or the use that nothing places.
    pub(super) entity: u64,
    /// The name of the place, if the file gives it a telling one.
    pub(super) name: Option<String>,
    pub(super) child: Group,
    /// Whether it is an occurrence of a product in another one.
    pub(super) is_occurrence: bool,
    pub(super) transform: Result<DAffine3, FaceFault>,
}

/// The representations of a file and how they refer to each other.
pub(super) struct Assembly<'a> {
    pub(super) shapes: Shapes<'a>,
    /// The units of each representation.
    units: HashMap<u64, Result<Units, FaceFault>>,
    /// The representations of each group, in the order of the file.
    pub(super) groups: BTreeMap<Group, Vec<u64>>,
    pub(super) group_of: HashMap<u64, Group>,
    /// For each item, the groups that contain it.
    members: HashMap<u64, Vec<Group>>,
    pub(super) placements: HashMap<Group, Vec<Placement>>,
    /// The groups in which others are placed.
    pub(super) assemblies: HashSet<Group>,
    /// Groups of parts with a use that nothing places.
    pub(super) unplaced: HashSet<Group>,
    /// Groups of products that refer to other files.
    external: HashSet<Group>,
    pub(super) names: HashMap<Group, String>,
    pub(super) built: HashMap<Group, Option<usize>>,
    /// Groups under construction, in which they cannot stand again.
    open: HashSet<Group>,
    /// The mapped items of representations.
    pub(super) met: HashSet<u64>,
    /// Representations of aspects of shapes. Their items are read only if no other representation has them.
    of_aspects: HashSet<u64>,
    pub(super) unit_missing: bool,
    /// Relationships that place nothing.
    pub(super) faults: Vec<(u64, FaceFault)>,
}

/// Reads the bodies of all representations where their assemblies place them.
///
/// # Errors
/// `STEP_TOO_MANY_SHAPES`, and `STEP_NESTING` for assemblies of too many levels.
pub(super) fn read(file: &Exchange<'_>) -> Result<Topology, FaceFault> {
    let relations = Relations::of(file);
    let mut assembly = Assembly::new(file, &relations);
    assembly.place(&relations);
    assembly.find_unplaced(&relations);
    assembly.find_external(&relations);
    assembly.assemblies = assembly.placements.keys().copied().collect();
    let children: HashSet<Group> =
        assembly.placements.values().flatten().map(|placement| placement.child).collect();
    let mapped = assembly.mapped(file);
    let all: Vec<Group> = assembly.groups.keys().copied().collect();
    let of_aspects = assembly.groups_of_aspects();
    let unplaced = std::mem::take(&mut assembly.unplaced);
    let is_root = |group: &&Group| {
        ![&children, &mapped, &of_aspects, &unplaced].iter().any(|groups| groups.contains(*group))
    };
    let mut uses = Vec::new();
    for &root in all.iter().filter(is_root) {
        uses.extend(assembly.group(root, 0)?);
    }
    // Groups that only stand in each other have no root, and those of aspects come last.
    for group in all {
        if !assembly.built.contains_key(&group) {
            let shape = assembly.group(group, 0)?;
            uses.extend(shape.filter(|_| !unplaced.contains(&group)));
        }
    }
    uses.extend(assembly.left_over()?);
    assembly.shapes.mark_pictures();
    let root = assembly.shapes.push(ShapeKind::Group(None), uses)?;
    let mut topology = assembly.shapes.topology;
    topology.root = used(root, true);
    topology.unit = (!assembly.unit_missing).then_some(METRES);
    Ok(topology)
}

impl<'a> Assembly<'a> {
    fn new(file: &'a Exchange<'a>, relations: &Relations<'a>) -> Self {
        let mut units = HashMap::new();
        let mut of_contexts: HashMap<u64, Result<Units, FaceFault>> = HashMap::new();
        let mut remarks = Vec::new();
        let mut parents: HashMap<u64, u64> = HashMap::new();
        for record in &relations.representations {
            if let Some((_, context)) = items(record) {
                let of_context = of_contexts.entry(context).or_insert_with(|| {
                    remarks.extend(Units::non_units(file, context));
                    let (units, remark) =
                        Units::of_context(file, context)?.with_believable_uncertainty(file, context);
                    remarks.extend(remark);
                    Ok(units)
                });
                units.insert(record.number, of_context.clone());
                parents.insert(record.number, record.number);
            }
        }
        for record in relations.related.iter().filter(|record| transformation(record).is_none()) {
            let Some([first, second]) = relationship(record) else { continue };
            if let (Some(first), Some(second)) = (root(&parents, first), root(&parents, second)) {
                parents.insert(first.max(second), first.min(second));
            }
        }
        let mut groups: BTreeMap<Group, Vec<u64>> = BTreeMap::new();
        let mut group_of = HashMap::new();
        for record in &relations.representations {
            if let Some(group) = root(&parents, record.number) {
                groups.entry(group).or_default().push(record.number);
                group_of.insert(record.number, group);
            }
        }
        let mut members: HashMap<u64, Vec<Group>> = HashMap::new();
        for record in &relations.representations {
            for item in items(record).map(|(items, _)| items).unwrap_or_default() {
                members.entry(item).or_default().extend(group_of.get(&record.number));
            }
        }
        for group in groups.values_mut() {
            group.sort_by_key(|representation| relations.of_aspects.contains(representation));
        }
        let documented = documented(file);
        let is_external = |(representation, definition): &(u64, u64)| {
            let is_documented = chain(file, *definition).into_iter().any(|one| documented.contains(&one));
            group_of.get(representation).copied().filter(|_| is_documented)
        };
        let external = relations.definitions.iter().filter_map(is_external).collect();
        let mut names = HashMap::new();
        for &(representation, definition) in &relations.definitions {
            if let (Some(&group), Some(name)) =
                (group_of.get(&representation), product_name(file, definition))
            {
                names.entry(group).or_insert(name);
            }
        }
        let mut shapes = Shapes::new(file);
        shapes.topology.remarks = remarks;
        Self {
            shapes,
            units,
            groups,
            group_of,
            members,
            placements: HashMap::new(),
            assemblies: HashSet::new(),
            unplaced: HashSet::new(),
            external,
            names,
            built: HashMap::new(),
            open: HashSet::new(),
            met: HashSet::new(),
            of_aspects: relations.of_aspects.clone(),
            unit_missing: false,
            faults: relations.faults.clone(),
        }
    }

    /// Finds the placements that relationships with a transformation state.
    fn place(&mut self, relations: &Relations<'_>) {
        for record in &relations.related {
            let (Some([first, second]), Some(operation)) = (relationship(record), transformation(record))
            else {
                continue;
            };
            let (Some(&a), Some(&b)) = (self.group_of.get(&first), self.group_of.get(&second)) else {
                let why = format!("#{} places a representation that is not read", record.number);
                self.faults.push((record.number, FaceFault::new("STEP_REFERENCE", why)));
                continue;
            };
            let swapped = self.is_swapped(relations, record.number, [a, b]);
            let transform = self.transform([first, second], operation, swapped);
            let (child, parent) = if swapped { (b, a) } else { (a, b) };
            let occurrence = relations.occurrences.get(&record.number);
            let name = occurrence.and_then(|&occurrence| occurrence_name(self.shapes.file, occurrence));
            let is_occurrence = occurrence.is_some();
            let placement = Placement { entity: record.number, name, child, is_occurrence, transform };
            self.placements.entry(parent).or_default().push(placement);
        }
    }

    /// Returns whether the first of two related groups is the assembly: by the rule it is the
    /// part, and some writers turn it round.
    fn is_swapped(&self, relations: &Relations<'_>, relationship: u64, [first, second]: [Group; 2]) -> bool {
        let Some(&occurrence) = relations.occurrences.get(&relationship) else { return false };
        let Ok(occurrence) = self.shapes.file.entity(occurrence) else { return false };
        let (Ok(assembly), Ok(part)) = (occurrence.reference(3), occurrence.reference(4)) else {
            return false;
        };
        let represents = |product: u64, group: Group| {
            let mut of_product =
                relations.definitions.iter().filter(|&&(_, definition)| definition == product);
            of_product.any(|(representation, _)| self.group_of.get(representation) == Some(&group))
        };
        represents(assembly, first) && represents(part, second) && !represents(part, first)
    }

    fn scale(&self, representation: u64) -> Result<Scale, FaceFault> {
        match self.units.get(&representation) {
            Some(units) => Ok(Scale::of_space(&units.clone()?)),
            None => Ok(Scale::of_space(&Units::NONE)),
        }
    }

    /// Returns the map from the coordinates of the part to those of the assembly.
    fn transform(&self, related: [u64; 2], operation: u64, swapped: bool) -> Result<DAffine3, FaceFault> {
        let file = self.shapes.file;
        let entity = file.entity(operation)?;
        let map = match entity.kind.as_str() {
            "ITEM_DEFINED_TRANSFORMATION" => {
                let items = self.in_order(related, [entity.reference(2)?, entity.reference(3)?]);
                let mut maps = [DAffine3::IDENTITY; 2];
                for side in [0, 1] {
                    maps[side] = operator(file, items[side], &self.scale(related[side])?)?;
                }
                maps[1] * maps[0].inverse()
            }
            // A placement in its place, as of a damaged number, is no transformation.
            kind if !kind.starts_with("CARTESIAN_TRANSFORMATION_OPERATOR") => {
                return Err(entity.unknown("a transformation"));
            }
            _ => operator(file, operation, &self.scale(related[1])?)?,
        };
        Ok(if swapped { map.inverse() } else { map })
    }

    /// Returns the items of a transformation in the order of the representations that they relate: some writers
    /// exchange them, which is seen where each is an item of the other representation alone.
    fn in_order(&self, [first, second]: [u64; 2], [a, b]: [u64; 2]) -> [u64; 2] {
        let is_in = |item: u64, representation: u64| match (
            self.members.get(&item),
            self.group_of.get(&representation),
        ) {
            (Some(groups), Some(group)) => groups.contains(group),
            _ => false,
        };
        let is_exchanged = is_in(a, second) && is_in(b, first) && !is_in(a, first) && !is_in(b, second);
        if is_exchanged { [b, a] } else { [a, b] }
    }

    /// Returns the groups that have representations of aspects alone.
    fn groups_of_aspects(&self) -> HashSet<Group> {
        let is_of_aspects = |representations: &[u64]| {
            representations.iter().all(|representation| self.of_aspects.contains(representation))
        };
        self.groups.iter().filter(|(_, group)| is_of_aspects(group)).map(|(&group, _)| group).collect()
    }

    /// Returns the groups that mapped items place.
    fn mapped(&self, file: &Exchange<'_>) -> HashSet<Group> {
        let items = file.numbers.iter().filter(|&&number| file.keyword(number) == "MAPPED_ITEM");
        let source = |&number: &u64| referred(file, number, "MAPPED_ITEM", 1);
        let sources = items.filter_map(source).filter_map(|map| referred(file, map, "REPRESENTATION_MAP", 1));
        sources.filter_map(|representation| self.group_of.get(&representation).copied()).collect()
    }

    /// Returns the use of a group with all that stands in it; `None` if that is nothing.
    fn group(&mut self, group: Group, nesting: usize) -> Result<Option<Use>, FaceFault> {
        if let Some(&known) = self.built.get(&group) {
            return Ok(known.map(|shape| used(shape, true)));
        }
        if nesting == MAX_NESTING {
            let why = format!("#{group} stands in more than {MAX_NESTING} levels of assemblies");
            return Err(FaceFault::new("STEP_NESTING", why));
        }
        if !self.open.insert(group) {
            let why = format!("the assembly of #{group} contains itself");
            let shape = self.shapes.unreadable(group, FaceFault::new("STEP_NESTING", why))?;
            return Ok(Some(used(shape, true)));
        }
        let mut children = Vec::new();
        for representation in self.groups.get(&group).cloned().unwrap_or_default() {
            self.items(representation, nesting, &mut children)?;
        }
        for placement in self.placements.remove(&group).unwrap_or_default() {
            let Placement { entity, name, child, is_occurrence, transform } = placement;
            match transform {
                Ok(location) => {
                    let place = (location, is_occurrence);
                    self.place_group(child, (entity, name, place), nesting, &mut children)?;
                }
                Err(fault) => {
                    // The part is read and stands nowhere.
                    self.group(child, nesting + 1)?;
                    children.push(used(self.shapes.unreadable(entity, fault)?, true));
                }
            }
        }
        self.open.remove(&group);
        let name = self.names.get(&group).cloned();
        let empty = children.is_empty();
        let shape = if empty { None } else { Some(self.shapes.push(ShapeKind::Group(name), children)?) };
        self.built.insert(group, shape);
        Ok(shape.map(|shape| used(shape, true)))
    }

    /// Appends the use of a group at the place that an instance gives it; of a part of which the file has nothing
    /// and that refers to another file, a face with that reason.
    fn place_group(
        &mut self,
        group: Group,
        (instance, name, place): (u64, Option<String>, (DAffine3, bool)),
        nesting: usize,
        children: &mut Vec<Use>,
    ) -> Result<(), FaceFault> {
        match self.group(group, nesting + 1)? {
            Some(part) => children.push(self.shapes.place(instance, name, part, place)?),
            None => match self.blank(group, instance) {
                Some(why) if self.external.contains(&group) => {
                    let fault = FaceFault::new("STEP_PLACE", why);
                    children.push(used(self.shapes.unreadable(instance, fault)?, true));
                }
                // Systems write components without a body.
                Some(why) => self.shapes.topology.remarks.push(Remark::new("STEP_EMPTY_PART", why)),
                None => {}
            },
        }
        Ok(())
    }

    /// Appends the bodies and mapped items of a representation.
    fn items(
        &mut self,
        representation: u64,
        nesting: usize,
        children: &mut Vec<Use>,
    ) -> Result<(), FaceFault> {
        let record = self.shapes.file.record(representation)?;
        let Some((items, _)) = items(&record) else { return Ok(()) };
        let is_of_aspect = self.of_aspects.contains(&representation);
        for item in items {
            // What is listed in itself adds nothing.
            if item == representation || is_of_aspect && self.shapes.was_reached(item) {
                continue;
            }
            if self.shapes.file.keyword(item) == "MAPPED_ITEM" {
                self.met.insert(item);
                match self.mapping(item, representation) {
                    Ok((child, location)) => {
                        let name = self.shapes.file.entity(item).ok().and_then(|item| item.name());
                        self.place_group(child, (item, name, (location, false)), nesting, children)?;
                    }
                    Err(fault) => children.push(used(self.shapes.unreadable(item, fault)?, true)),
                }
                continue;
            }
            let units = match self.units.get(&representation) {
                Some(Ok(units)) => *units,
                Some(Err(fault)) => {
                    let fault = fault.clone();
                    children.push(used(self.shapes.unreadable(representation, fault)?, true));
                    return Ok(());
                }
                None => Units::NONE,
            };
            self.shapes.set_units(units);
            if let Some(body) = self.shapes.item(item)? {
                self.unit_missing |= units.length.is_none();
                children.push(body);
            }
        }
        Ok(())
    }

    /// Returns the group that an item maps, and the map.
    fn mapping(&self, item: u64, representation: u64) -> Result<(Group, DAffine3), FaceFault> {
        let file = self.shapes.file;
        let entity = file.entity(item)?;
        let map = file.entity(entity.reference(1)?)?;
        let source = map.reference(1)?;
        let group = self.group_of.get(&source).copied().ok_or_else(|| map.fault(1, "a representation"))?;
        let from = operator(file, map.reference(0)?, &self.scale(source)?)?;
        let to = operator(file, entity.reference(2)?, &self.scale(representation)?)?;
        Ok((group, to * from.inverse()))
    }
}

/// Returns the representative of an element of a forest; `None` if it is not in it.
fn root(parents: &HashMap<u64, u64>, mut element: u64) -> Option<u64> {
    loop {
        let parent = *parents.get(&element)?;
        if parent == element {
            return Some(element);
        }
        element = parent;
    }
}
