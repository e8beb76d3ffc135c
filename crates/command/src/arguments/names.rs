//! Enums of the library by their names on the command line.

use clap::ValueEnum;
use nurbs_hausdorff::options::{Audit, Culling, Flatness, Projection, SamplingRule};
use nurbs_hausdorff::{Backend, MethodName, Precision};

/// A library enum by its names on the command line.
macro_rules! named {
    ($name:ident, $library:ident, $($variant:ident),+) => {
        #[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
        pub(crate) enum $name { $($variant),+ }
        impl From<$name> for $library {
            fn from(name: $name) -> Self {
                match name { $($name::$variant => Self::$variant),+ }
            }
        }
    };
}

pub(super) use named;

named!(MethodChoice, MethodName, Certified, Iteration, Hierarchy);
named!(SamplingName, SamplingRule, Uniform, ArcLength);
named!(FlatnessName, Flatness, None, Loose, Tight, Curvature);
named!(ProjectionName, Projection, Newton, TangentPlane);
named!(CullingName, Culling, Tree, None);
named!(PrecisionName, Precision, Float32, Float64);
named!(AuditName, Audit, Share, All);
named!(BackendName, Backend, Auto, Gpu, Cpu);
