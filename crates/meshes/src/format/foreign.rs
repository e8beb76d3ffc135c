//! Formats of meshes that are recognised and not read.

use nurbs_hausdorff::{Error, Result};

/// The bytes in which a signature is searched that comments or blanks may precede.
const HEAD_LENGTH: usize = 1024;

const EXPORT: &str = "export the mesh as STL, PLY, OBJ, 3MF, OFF or VTP from the program that made it";
const SURFACE: &str =
    "write its surface as VTP, PLY or STL: pyvista's extract_surface and ParaView's Extract Surface make it";

/// The bytes with which a file of a format begins, its name, and the way to a file that is read.
const BY_BEGINNING: [(&[u8], &str, &str); 17] = [
    (b"$MeshFormat", "a mesh of Gmsh (MSH)", SURFACE),
    (b"MeshVersionFormatted", "a mesh of Medit (MESH)", SURFACE),
    (b"Kaydara FBX Binary", "an FBX file", EXPORT),
    (b"; FBX", "an FBX file", EXPORT),
    (b"#VRML", "a VRML file", EXPORT),
    (b"#X3D", "an X3D file", EXPORT),
    (b"PXR-USDC", "a USD file", EXPORT),
    (b"#usda", "a USD file", EXPORT),
    (b"DRACO", "a mesh compressed by Draco", EXPORT),
    (b"BLENDER", "a Blender file", EXPORT),
    (b"\x89HDF", "an HDF5 file", SURFACE),
    (b"CDF\x01", "a NetCDF file, as Exodus meshes are", SURFACE),
    (b"CDF\x02", "a NetCDF file, as Exodus meshes are", SURFACE),
    (b"\x93NUMPY", "a NumPy array (NPY)", "write its rows as text: numpy.savetxt makes it"),
    (b"AC10", "a DWG file", EXPORT),
    (b"*HEADING", "an input file of Abaqus", SURFACE),
    (b"*Heading", "an input file of Abaqus", SURFACE),
];

/// The elements by which XML of a format is known.
const BY_ELEMENT: [(&[u8], &str, &str); 8] = [
    (b"<COLLADA", "a COLLADA file", EXPORT),
    (b"<X3D", "an X3D file", EXPORT),
    (b"<amf", "an AMF file", EXPORT),
    (b"\"UnstructuredGrid\"", "an unstructured grid of VTK (VTU)", SURFACE),
    (b"\"StructuredGrid\"", "a structured grid of VTK (VTS)", SURFACE),
    (b"\"RectilinearGrid\"", "a rectilinear grid of VTK (VTR)", SURFACE),
    (b"\"ImageData\"", "an image of VTK (VTI)", SURFACE),
    (b"MultiBlock", "a collection of VTK files (VTM)", "read its files one by one"),
];

/// Refuses bytes that are a mesh of a format that is not read, by its name.
///
/// # Errors
/// [`Error::FormatUnsupported`].
pub(super) fn refuse(bytes: &[u8]) -> Result<()> {
    let bytes = bytes.trim_ascii_start();
    let head = &bytes[..bytes.len().min(HEAD_LENGTH)];
    let is_xml = head.starts_with(b"<");
    let has = |part: &[u8]| head.windows(part.len()).any(|window| window == part);
    let begun = BY_BEGINNING.iter().find(|(beginning, ..)| head.starts_with(beginning));
    match begun.or_else(|| BY_ELEMENT.iter().find(|(element, ..)| is_xml && has(element))) {
        Some(&(_, found, advice)) => Err(Error::FormatUnsupported { found, advice: advice.to_owned() }),
        None => Ok(()),
    }
}
