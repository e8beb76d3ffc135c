//! The one error type of the crate, with codes that stay stable across releases.

mod trim_fault;

use crate::axis::Axis;
use thiserror::Error as ThisError;
pub use trim_fault::TrimFault;

/// The result of functions of this crate that fail on invalid input or a failing machine.
pub type Result<T> = std::result::Result<T, Error>;

/// The errors of this crate. Messages name the surface, the index, the value found
/// and the value expected; programs should match on [`Error::code`].
#[non_exhaustive]
#[derive(Debug, Clone, PartialEq, ThisError)]
pub enum Error {
    /// A coordinate, weight or knot is infinite or NaN.
    #[error("surface {surface}: {what} {index} is {found:?}, expected a finite number")]
    NonFinite {
        /// The index of the surface in its model.
        surface: usize,
        /// The list that contains the value.
        what: &'static str,
        /// Its index in that list.
        index: usize,
        /// The value.
        found: f64,
    },
    /// A coordinate, weight or knot is so large that products of it may overflow.
    #[error("surface {surface}: {what} {index} is {found:?}, expected at most 1e100 in size")]
    NumberTooLarge {
        /// The index of the surface in its model.
        surface: usize,
        /// The list that contains the value.
        what: &'static str,
        /// Its index in that list.
        index: usize,
        /// The value.
        found: f64,
    },
    /// A weight is negative, zero or less than 1e-100.
    #[error("surface {surface}: weight of control point {index} is {found:?}, expected at least 1e-100")]
    WeightNotPositive {
        /// The index of the surface in its model.
        surface: usize,
        /// The index of the control point, v fastest.
        index: usize,
        /// The weight.
        found: f64,
    },
    /// A weight is less than 1e-30 of the largest weight of its surface.
    #[error(
        "surface {surface}: weight of control point {index} is {found:?}, expected at least 1e-30 of the surface's largest weight, {largest:?}"
    )]
    WeightRatioTooLarge {
        /// The index of the surface in its model.
        surface: usize,
        /// The index of the control point, v fastest.
        index: usize,
        /// The weight.
        found: f64,
        /// The largest weight of the surface.
        largest: f64,
    },
    /// A knot is smaller than the one before it.
    #[error("surface {surface}: knot {index} in {axis} is {found:?}, expected at least {expected:?}")]
    KnotsDecreasing {
        /// The index of the surface in its model.
        surface: usize,
        /// The axis of the knot vector.
        axis: Axis,
        /// The index of the knot.
        index: usize,
        /// The knot.
        found: f64,
        /// The knot before it.
        expected: f64,
    },
    /// A knot vector is not of length count + degree + 1.
    #[error("surface {surface}: {found} knots in {axis}, expected {expected} (control points + degree + 1)")]
    KnotsLength {
        /// The index of the surface in its model.
        surface: usize,
        /// The axis of the knot vector.
        axis: Axis,
        /// Its length.
        found: usize,
        /// The length that fits degree and net.
        expected: usize,
    },
    /// A knot is repeated more than degree + 1 times.
    #[error(
        "surface {surface}: knot {index} in {axis} is repeated {found} times, expected at most {expected} (degree + 1)"
    )]
    KnotsMultiplicity {
        /// The index of the surface in its model.
        surface: usize,
        /// The axis of the knot vector.
        axis: Axis,
        /// The index of the first of the equal knots.
        index: usize,
        /// Its multiplicity.
        found: usize,
        /// The largest multiplicity allowed.
        expected: usize,
    },
    /// The knots `[degree]` and `[count]`, which bound the domain, are equal.
    #[error("surface {surface}: the domain in {axis} is [{start:?}, {end:?}], expected a positive length")]
    KnotsEmptyDomain {
        /// The index of the surface in its model.
        surface: usize,
        /// The axis of the knot vector.
        axis: Axis,
        /// The first knot of the domain.
        start: f64,
        /// The last knot of the domain.
        end: f64,
    },
    /// A row of control points differs in length from the first, or the list from the product of the counts.
    #[error("surface {surface}: row {index} of the net has {found} control points, expected {expected}")]
    RaggedNet {
        /// The index of the surface in its model.
        surface: usize,
        /// The index of the row along u, 0 where the net is one list.
        index: usize,
        /// Its number of control points.
        found: usize,
        /// The number expected.
        expected: usize,
    },
    /// Fewer control points than degree + 1.
    #[error("surface {surface}: {found} control points in {axis}, expected at least {expected} (degree + 1)")]
    TooFewControlPoints {
        /// The index of the surface in its model.
        surface: usize,
        /// The axis.
        axis: Axis,
        /// The number of control points.
        found: usize,
        /// The smallest number allowed.
        expected: usize,
    },
    /// A degree outside 1 to 15.
    #[error("surface {surface}: degree {found} in {axis}, expected 1 to {}", crate::limits::MAX_DEGREE)]
    DegreeOutOfRange {
        /// The index of the surface in its model.
        surface: usize,
        /// The axis.
        axis: Axis,
        /// The degree.
        found: usize,
    },
    /// A trimmed face that cannot be cut into patches.
    #[error("surface {surface}: the trimmed face cannot be cut into patches: {found}")]
    FaceNotCut {
        /// The index of the surface in its model.
        surface: usize,
        /// The reason.
        found: String,
    },
    /// A model without surfaces.
    #[error("the model has 0 surfaces, expected at least 1")]
    EmptyModel,
    /// A document without a visible shape that has faces and can be read.
    #[error("no visible shape of the document has faces{left_out}")]
    EmptyDocument {
        /// The objects left out, each with its reason and a semicolon before it.
        left_out: String,
    },
    /// The trimming loops of a surface are invalid.
    #[error("surface {surface}, {fault}")]
    Trim {
        /// The index of the surface in its model.
        surface: usize,
        /// The violation.
        fault: TrimFault,
    },
    /// An operation on whole surfaces was given a trimmed face.
    #[error("surface {surface} is trimmed, expected whole surfaces")]
    ModelTrimmed {
        /// The index of the surface in its model.
        surface: usize,
    },
    /// The gap of a surface is negative or not finite.
    #[error("surface {surface}: gap is {found:?}, expected a finite number of at least 0")]
    GapInvalid {
        /// The index of the surface in its model.
        surface: usize,
        /// The gap.
        found: f64,
    },
    /// An instance places a surface that the model does not have.
    #[error(
        "instance {instance} places surface {found}, expected less than {expected}, the number of surfaces"
    )]
    InstanceSurface {
        /// The index of the instance.
        instance: usize,
        /// The index of the surface.
        found: usize,
        /// The number of surfaces.
        expected: usize,
    },
    /// The transform of an instance is singular or not finite.
    #[error(
        "instance {instance}: the transform {found}, expected an invertible affine map of finite numbers"
    )]
    InstanceTransform {
        /// The index of the instance.
        instance: usize,
        /// The property that is invalid.
        found: String,
    },
    /// The instances of a model place too many faces, or an assembly faces and groups of these.
    #[error("the instances place {found} faces, or faces and their groups, expected at most {expected}")]
    TooManyFaces {
        /// The number of faces placed, or of these and their groups.
        found: usize,
        /// The largest number allowed.
        expected: usize,
    },
    /// The index of a triangle's corner is that of no vertex.
    #[error(
        "triangle {triangle}: found vertex {found}, expected less than {expected}, the number of vertices"
    )]
    TriangleIndex {
        /// The index of the triangle.
        triangle: usize,
        /// The index of the vertex.
        found: usize,
        /// The number of vertices.
        expected: usize,
    },
    /// A model whose faces do not close, where inside and outside are asked for.
    #[error(
        "the model has no inside: {found} free edges, expected faces that close, or a mesh of at most 250,000 triangles that does"
    )]
    NotClosed {
        /// The number of free edges; 0 of meshes that are too large to be joined, and of clouds.
        found: usize,
    },
    /// Statistics over an area that may be 0.
    #[error("the model has no area, expected one that statistics can be over")]
    NoArea,
    /// Groups of a mesh that are not its triangles, each once.
    #[error("the mesh has groups of {found} triangles, expected {expected} with at least 1 in each group")]
    MeshGroups {
        /// The number of triangles in all groups.
        found: usize,
        /// The number of triangles of the mesh.
        expected: usize,
    },
    /// Bytes that are not of a format of meshes, or parts of it that are not read.
    #[error("the {format} file cannot be read: {found}")]
    MeshSyntax {
        /// The format.
        format: &'static str,
        /// The violation, with its line where there is one.
        found: String,
    },
    /// A computation that meshes and clouds of points do not have.
    #[error("{found}, which is not computed for this mesh or cloud of points")]
    FacetsUnsupported {
        /// The computation.
        found: &'static str,
    },
    /// A mesh without triangles, or a cloud without points.
    #[error("found no {expected}, expected at least 1")]
    NoFacets {
        /// What is missing.
        expected: &'static str,
    },
    /// A mesh or a cloud of too many triangles, vertices or points.
    #[error("found {found} triangles, vertices or points, expected at most {expected}")]
    TooManyFacets {
        /// Their number.
        found: usize,
        /// The largest number allowed.
        expected: usize,
    },
    /// The unit of a model is not a positive length.
    #[error("the unit is {found:?} m, expected a length from 1e-30 m to 1e30 m")]
    UnitInvalid {
        /// The unit in metres.
        found: f64,
    },
    /// Two models have different units.
    #[error("the units are {a:?} m and {b:?} m, expected equal units, or the option to scale B to A's unit")]
    UnitsDiffer {
        /// Metres per unit of A.
        a: f64,
        /// Metres per unit of B.
        b: f64,
    },
    /// Text that is no JSON, or not of the interchange shape.
    #[error("the model is not interchange JSON: {found}")]
    JsonShape {
        /// The parser's message, with the position.
        found: String,
    },
    /// Text that is not in the format of OpenCASCADE's BREP files.
    #[error("line {line}: found {found:?}, expected {expected}")]
    BrepSyntax {
        /// The line, from 1.
        line: usize,
        /// The word found.
        found: String,
        /// The word or number that the format requires there.
        expected: String,
    },
    /// Text that is not in the format of ISO 10303-21, or a file that ends early.
    #[error("line {line}: found {found:?}, expected {expected}")]
    StepSyntax {
        /// The line, from 1.
        line: usize,
        /// The token found.
        found: String,
        /// The token that the format requires there.
        expected: String,
    },
    /// A STEP file over the limits of the reader.
    #[error("the STEP file cannot be read: {found}")]
    StepUnreadable {
        /// The reason.
        found: String,
    },
    /// A STEP file of triangles alone.
    #[error(
        "the STEP file has {found} triangles and no faces, expected faces: the native command and Python read it as a \
         mesh, and in Rust `MeshFile` does"
    )]
    StepTriangles {
        /// The number of triangles.
        found: usize,
    },
    /// A STEP file without faces in what it represents.
    #[error(
        "the STEP file represents no faces, expected at least 1: {found}; export solids or surfaces from the \
         program that made it"
    )]
    StepEmpty {
        /// What the file has instead.
        found: String,
    },
    /// Text that is not in the format of IGES, or a file that ends early.
    #[error("line {line}: found {found:?}, expected {expected}")]
    IgesSyntax {
        /// The line, from 1.
        line: usize,
        /// The line's content.
        found: String,
        /// The content that the format requires there.
        expected: String,
    },
    /// An IGES file without a known unit, or over the limits of the reader.
    #[error("the IGES file cannot be read: {found}")]
    IgesUnreadable {
        /// The reason.
        found: String,
    },
    /// Bytes that are not what the readers' wasm module of this version gave.
    #[error("the faces that were read cannot be taken over: {found}")]
    TransferInvalid {
        /// The reason.
        found: String,
    },
    /// A BREP file without a face that can be read.
    #[error("none of the {faces} faces can be read; face {face}: {found}")]
    BrepUnreadable {
        /// The number of the first face.
        face: usize,
        /// The reason for which it cannot be read.
        found: String,
        /// The number of faces.
        faces: usize,
    },
    /// A file or text over the size limit.
    #[error("the model is {found} bytes, expected at most {expected}")]
    FileTooLarge {
        /// Its size in bytes.
        found: u64,
        /// The limit in bytes.
        expected: u64,
    },
    /// A file that cannot be read.
    #[error("{path}: {found}")]
    FileUnreadable {
        /// The path as given.
        path: String,
        /// The message of the operating system.
        found: String,
    },
    /// Compressed content that is damaged, or an archive without what its format requires.
    #[error("the file cannot be unpacked: {found}")]
    CadUnreadable {
        /// The violation.
        found: String,
    },
    /// A file of a format that is recognised and not read.
    #[error(
        "found {found}; read are interchange JSON, STEP, IGES, OpenCASCADE's BREP text and FreeCAD's FCStd: \
         {advice}"
    )]
    FormatUnsupported {
        /// The format, with its article.
        found: &'static str,
        /// The way to a file that is read.
        advice: String,
    },
    /// An option outside its range.
    #[error("option {option} is {found}, expected {expected}")]
    OptionOutOfRange {
        /// The option's name.
        option: &'static str,
        /// Its value.
        found: String,
        /// The range.
        expected: &'static str,
    },
    /// An option of an unknown name or of a wrong type.
    #[error("options: {found}")]
    OptionInvalid {
        /// The value found and the value expected, in words.
        found: String,
    },
    /// A transform that is not a rotation and a translation of at most 1e100.
    #[error("the transform's {found}, expected a translation of at most 1e100 and a rotation of unit length")]
    TransformNotRigid {
        /// The part of the transform that is invalid.
        found: String,
    },
    /// A point to be measured with a coordinate that is missing, not finite or too large.
    #[error("point {index} has a coordinate {found}, expected three finite numbers of at most 1e100 in size")]
    PointOutOfRange {
        /// The index of the point.
        index: usize,
        /// The coordinate, NaN where it is missing.
        found: f64,
    },
    /// A shape that is not in the catalogue.
    #[error("there is no shape \"{found}\", expected one of {expected}")]
    UnknownShape {
        /// The name requested.
        found: String,
        /// The names in the catalogue.
        expected: String,
    },
    /// A GPU was required and none is available.
    #[error("no GPU adapter: {found}")]
    NoAdapter {
        /// The message of the platform.
        found: String,
    },
    /// The GPU device was lost during the computation.
    #[error("the GPU device was lost: {found}")]
    DeviceLost {
        /// The message of the platform.
        found: String,
    },
    /// The GPU rejected a buffer, shader or read-back.
    #[error("the GPU failed: {found}")]
    GpuFailed {
        /// The message of the platform.
        found: String,
    },
    /// Method `hierarchy` requires more pairs of boxes than its memory budget holds.
    #[error(
        "level {level} of the hierarchy requires {found} pairs of boxes, expected at most {expected}, which fit the memory budget of {mebibytes} MiB"
    )]
    PairBudgetExceeded {
        /// The level, where the root's is 0.
        level: usize,
        /// The pairs left after culling.
        found: u64,
        /// The pairs that fit.
        expected: u64,
        /// The budget in MiB.
        mebibytes: usize,
    },
    /// The caller cancelled the computation.
    #[error("cancelled")]
    Cancelled,
}

impl Error {
    /// Returns the error for a number of a surface that is too large or not finite.
    pub(crate) fn number_out_of_range(surface: usize, what: &'static str, index: usize, found: f64) -> Self {
        if found.is_finite() {
            Self::NumberTooLarge { surface, what, index, found }
        } else {
            Self::NonFinite { surface, what, index, found }
        }
    }

    /// Returns [`Error::OptionOutOfRange`] with what was found as Rust prints it.
    pub(crate) fn out_of_range(
        option: &'static str,
        found: impl std::fmt::Debug,
        expected: &'static str,
    ) -> Self {
        Self::OptionOutOfRange { option, found: format!("{found:?}"), expected }
    }

    /// The stable code, the same in Rust, on the command line and in JavaScript.
    #[must_use]
    pub fn code(&self) -> &'static str {
        match self {
            Self::NonFinite { .. } => "NON_FINITE",
            Self::NumberTooLarge { .. } => "NUMBER_TOO_LARGE",
            Self::WeightNotPositive { .. } => "WEIGHT_NOT_POSITIVE",
            Self::WeightRatioTooLarge { .. } => "WEIGHT_RATIO_TOO_LARGE",
            Self::KnotsDecreasing { .. } => "KNOTS_DECREASING",
            Self::KnotsLength { .. } => "KNOTS_LENGTH",
            Self::KnotsMultiplicity { .. } => "KNOTS_MULTIPLICITY",
            Self::KnotsEmptyDomain { .. } => "KNOTS_EMPTY_DOMAIN",
            Self::RaggedNet { .. } => "RAGGED_NET",
            Self::TooFewControlPoints { .. } => "TOO_FEW_CONTROL_POINTS",
            Self::DegreeOutOfRange { .. } => "DEGREE_OUT_OF_RANGE",
            Self::FaceNotCut { .. } => "FACE_NOT_CUT",
            Self::EmptyModel | Self::EmptyDocument { .. } | Self::StepEmpty { .. } => "EMPTY_MODEL",
            Self::Trim { fault, .. } => fault.code(),
            Self::ModelTrimmed { .. } => "MODEL_TRIMMED",
            Self::GapInvalid { .. } => "GAP_INVALID",
            Self::InstanceSurface { .. } => "INSTANCE_SURFACE",
            Self::InstanceTransform { .. } => "INSTANCE_TRANSFORM",
            Self::TooManyFaces { .. } => "TOO_MANY_FACES",
            Self::TriangleIndex { .. } => "TRIANGLE_INDEX",
            Self::NotClosed { .. } => "NOT_CLOSED",
            Self::NoArea => "NO_AREA",
            Self::MeshGroups { .. } => "MESH_GROUPS",
            Self::MeshSyntax { .. } => "MESH_SYNTAX",
            Self::FacetsUnsupported { .. } => "FACETS_UNSUPPORTED",
            Self::NoFacets { .. } => "NO_FACETS",
            Self::TooManyFacets { .. } => "TOO_MANY_FACETS",
            Self::UnitInvalid { .. } => "UNIT_INVALID",
            Self::UnitsDiffer { .. } => "UNITS_DIFFER",
            Self::JsonShape { .. } => "JSON_SHAPE",
            Self::BrepSyntax { .. } => "BREP_SYNTAX",
            Self::StepSyntax { .. } => "STEP_SYNTAX",
            Self::StepUnreadable { .. } => "STEP_UNREADABLE",
            Self::StepTriangles { .. } => "STEP_TRIANGLES",
            Self::IgesSyntax { .. } => "IGES_SYNTAX",
            Self::IgesUnreadable { .. } => "IGES_UNREADABLE",
            Self::TransferInvalid { .. } => "TRANSFER_INVALID",
            Self::BrepUnreadable { .. } => "BREP_UNREADABLE",
            Self::FileTooLarge { .. } => "FILE_TOO_LARGE",
            Self::FileUnreadable { .. } => "FILE_UNREADABLE",
            Self::CadUnreadable { .. } => "CAD_UNREADABLE",
            Self::FormatUnsupported { .. } => "FORMAT_UNSUPPORTED",
            Self::OptionOutOfRange { .. } => "OPTION_OUT_OF_RANGE",
            Self::OptionInvalid { .. } => "OPTION_INVALID",
            Self::TransformNotRigid { .. } => "TRANSFORM_NOT_RIGID",
            Self::PointOutOfRange { .. } => "POINT_OUT_OF_RANGE",
            Self::UnknownShape { .. } => "UNKNOWN_SHAPE",
            Self::NoAdapter { .. } => "NO_ADAPTER",
            Self::DeviceLost { .. } => "DEVICE_LOST",
            Self::GpuFailed { .. } => "GPU_FAILED",
            Self::PairBudgetExceeded { .. } => "PAIR_BUDGET_EXCEEDED",
            Self::Cancelled => "CANCELLED",
        }
    }
}
