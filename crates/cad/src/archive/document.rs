//! The objects of a FreeCAD document, as its XML states them.

use super::unreadable;
use nurbs_hausdorff::Result;
use quick_xml::events::attributes::Attribute;
use quick_xml::events::{BytesStart, Event};
use quick_xml::{Reader, XmlVersion};
use std::collections::HashSet;

/// An object of a document.
#[derive(Default)]
pub(super) struct Object {
    pub(super) name: String,
    /// The file of the archive with its shape.
    pub(super) file: Option<String>,
    /// The names of its properties that decide how it is read.
    properties: HashSet<Known>,
    /// What it has in place of a shape.
    pub(super) kernel: Option<Kernel>,
    /// The names of its group's members.
    pub(super) members: Vec<String>,
    /// Whether it shows other objects as its elements, as groups of links do.
    has_elements: bool,
    placement: Option<Placement>,
    link_placement: Option<Placement>,
    is_visible: Option<bool>,
}

/// What objects other than shapes consist of.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Kernel {
    /// Triangles.
    Mesh,
    /// Points without a surface.
    Points,
    /// The elements of an analysis.
    Elements,
}

impl Kernel {
    fn of_element(name: &str) -> Option<Self> {
        Some(match name {
            "Mesh" => Self::Mesh,
            "Points" => Self::Points,
            "FemMesh" => Self::Elements,
            _ => return None,
        })
    }
}

/// The properties that are read.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
enum Known {
    ElementList,
    Group,
    LinkPlacement,
    LinkedObject,
    Origin,
    Placement,
    Shape,
    Tip,
    Visibility,
}

impl Known {
    fn of_name(name: &str) -> Option<Self> {
        Some(match name {
            "ElementList" => Self::ElementList,
            "Group" => Self::Group,
            "LinkPlacement" => Self::LinkPlacement,
            "LinkedObject" => Self::LinkedObject,
            // The older name first.
            "OriginFeatures" | "Origin" => Self::Origin,
            "Placement" => Self::Placement,
            "Shape" => Self::Shape,
            "Tip" => Self::Tip,
            "Visibility" => Self::Visibility,
            _ => return None,
        })
    }
}

/// Whether a placement moves nothing.
struct Placement {
    is_identity: bool,
}

impl Object {
    /// Returns whether the object is a body of PartDesign, which alone has a tip.
    pub(super) fn is_body(&self) -> bool {
        self.properties.contains(&Known::Tip)
    }

    /// Returns whether the object is not shown; those without a statement are.
    pub(super) fn is_hidden(&self) -> bool {
        self.is_visible == Some(false)
    }

    /// Returns whether the members of the object are shown only if it is: those of parts, not of plain groups.
    pub(super) fn is_part(&self) -> bool {
        self.properties.contains(&Known::Origin)
    }

    /// Returns whether the object shows others at other places: a link, a group of links, or a part whose placement
    /// is not the identity.
    pub(super) fn is_container(&self) -> bool {
        let is_link = self.properties.contains(&Known::LinkedObject) || self.has_elements;
        let placement = self.link_placement.as_ref().or(self.placement.as_ref());
        let is_moved = || placement.is_some_and(|placement| !placement.is_identity);
        !self.is_body() && (is_link || self.is_part() && is_moved())
    }

    /// Takes over what an element within a property states.
    fn read(&mut self, property: Option<Known>, element: &BytesStart<'_>) -> Result<()> {
        match (property, element.local_name().as_ref()) {
            // Features of PartDesign and sketches have other shapes beside their own.
            (Some(Known::Shape), "Part") => self.file = attribute(element, "file")?,
            (Some(Known::Group), "Link") => self.members.extend(attribute(element, "value")?),
            (Some(Known::ElementList), "Link") => self.has_elements = true,
            (Some(Known::Visibility), "Bool") => {
                self.is_visible = attribute(element, "value")?.map(|value| value == "true");
            }
            (Some(Known::LinkPlacement), "PropertyPlacement") => {
                self.link_placement = Some(placement(element)?);
            }
            (Some(Known::Placement), "PropertyPlacement") => self.placement = Some(placement(element)?),
            (_, name) => self.kernel = self.kernel.or(Kernel::of_element(name)),
        }
        Ok(())
    }
}

/// Reads the elements `tag` within `group`: objects of a document, or their views.
pub(super) fn objects(xml: &[u8], group: &str, tag: &str) -> Result<Vec<Object>> {
    let mut reader = Reader::from_reader(xml);
    let mut objects = Vec::new();
    let (mut is_within, mut current, mut property) = (false, None::<Object>, None);
    loop {
        match reader.read_event().map_err(unreadable)? {
            Event::Start(element) if element.local_name().as_ref() == group => is_within = true,
            Event::Start(element) if is_within && element.local_name().as_ref() == tag => {
                let name = attribute(&element, "name")?.unwrap_or_default();
                current = Some(Object { name, ..Object::default() });
            }
            event @ (Event::Start(_) | Event::Empty(_)) => {
                let (Event::Start(element) | Event::Empty(element), Some(object)) = (&event, &mut current)
                else {
                    continue;
                };
                if element.local_name().as_ref() == "Property" {
                    property = attribute(element, "name")?.as_deref().and_then(Known::of_name);
                    object.properties.extend(property);
                } else {
                    object.read(property, element)?;
                }
            }
            Event::End(element) if element.local_name().as_ref() == tag => objects.extend(current.take()),
            Event::End(element) if element.local_name().as_ref() == group => is_within = false,
            Event::Eof => return Ok(objects),
            _ => {}
        }
    }
}

fn placement(element: &BytesStart<'_>) -> Result<Placement> {
    let mut is_identity = true;
    // The fourth of the quaternion is 1 or -1 where the others are 0.
    for name in ["Px", "Py", "Pz", "Q0", "Q1", "Q2"] {
        let number = attribute(element, name)?.map_or(Ok(0.0), |text| text.trim().parse::<f64>());
        is_identity &= number.map_err(unreadable)? == 0.0;
    }
    Ok(Placement { is_identity })
}

fn attribute(element: &BytesStart<'_>, name: &str) -> Result<Option<String>> {
    let found = element.try_get_attribute(name).map_err(unreadable)?;
    let value = |found: Attribute<'_>| found.normalized_value(XmlVersion::Implicit1_0).map(Into::into);
    found.map(value).transpose().map_err(unreadable)
}
