//! A writer of STEP files, entity by entity.

/// The number of an instance.
pub type Id = usize;

/// A file under construction.
#[derive(Debug, Clone, Default)]
pub struct StepText {
    pub entities: Vec<String>,
}

/// The units of a file: how it states lengths and angles.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UnitsOf {
    Millimetres,
    InchesAndDegrees,
    Metres,
}

fn list(ids: &[Id]) -> String {
    let ids: Vec<String> = ids.iter().map(|id| format!("#{id}")).collect();
    format!("({})", ids.join(","))
}

fn logical(value: bool) -> &'static str {
    if value { ".T." } else { ".F." }
}

impl StepText {
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds an instance.
    pub fn add(&mut self, entity: impl Into<String>) -> Id {
        self.entities.push(entity.into());
        self.entities.len()
    }

    pub fn point(&mut self, [x, y, z]: [f64; 3]) -> Id {
        self.add(format!("CARTESIAN_POINT('',({x:?},{y:?},{z:?}))"))
    }

    pub fn direction(&mut self, [x, y, z]: [f64; 3]) -> Id {
        self.add(format!("DIRECTION('',({x:?},{y:?},{z:?}))"))
    }

    pub fn placement(&mut self, origin: [f64; 3], axis: [f64; 3], x: [f64; 3]) -> Id {
        let (origin, axis, x) = (self.point(origin), self.direction(axis), self.direction(x));
        self.add(format!("AXIS2_PLACEMENT_3D('',#{origin},#{axis},#{x})"))
    }

    /// A placement whose direction x is left out.
    pub fn axis(&mut self, origin: [f64; 3], axis: [f64; 3]) -> Id {
        let (origin, axis) = (self.point(origin), self.direction(axis));
        self.add(format!("AXIS2_PLACEMENT_3D('',#{origin},#{axis},$)"))
    }

    pub fn vertex(&mut self, point: [f64; 3]) -> Id {
        let point = self.point(point);
        self.add(format!("VERTEX_POINT('',#{point})"))
    }

    pub fn line(&mut self, point: [f64; 3], along: [f64; 3]) -> Id {
        let (point, along) = (self.point(point), self.direction(along));
        let vector = self.add(format!("VECTOR('',#{along},1.)"));
        self.add(format!("LINE('',#{point},#{vector})"))
    }

    pub fn circle(&mut self, placement: Id, radius: f64) -> Id {
        self.add(format!("CIRCLE('',#{placement},{radius:?})"))
    }

    pub fn edge(&mut self, curve: Id, [start, end]: [Id; 2], same_sense: bool) -> Id {
        self.add(format!("EDGE_CURVE('',#{start},#{end},#{curve},{})", logical(same_sense)))
    }

    /// A loop of edges, each used forward or in reverse.
    pub fn edge_loop(&mut self, edges: &[(Id, bool)]) -> Id {
        let oriented = |&(edge, forward): &(Id, bool)| {
            self.add(format!("ORIENTED_EDGE('',*,*,#{edge},{})", logical(forward)))
        };
        let edges: Vec<Id> = edges.iter().map(oriented).collect();
        self.add(format!("EDGE_LOOP('',{})", list(&edges)))
    }

    pub fn bound(&mut self, path: Id, orientation: bool) -> Id {
        self.add(format!("FACE_BOUND('',#{path},{})", logical(orientation)))
    }

    /// A face bounded by these loops, all used as they are.
    pub fn face(&mut self, loops: &[Id], surface: Id, same_sense: bool) -> Id {
        let bounds: Vec<Id> = loops.iter().map(|&path| self.bound(path, true)).collect();
        self.add(format!("ADVANCED_FACE('',{},#{surface},{})", list(&bounds), logical(same_sense)))
    }

    /// An item of a representation: a model of one open shell.
    pub fn open_shell(&mut self, faces: &[Id]) -> Id {
        let shell = self.add(format!("OPEN_SHELL('',{})", list(faces)));
        self.add(format!("SHELL_BASED_SURFACE_MODEL('',(#{shell}))"))
    }

    pub fn solid(&mut self, name: &str, faces: &[Id]) -> Id {
        let shell = self.add(format!("CLOSED_SHELL('',{})", list(faces)));
        self.add(format!("MANIFOLD_SOLID_BREP('{name}',#{shell})"))
    }

    /// The context of a representation, with an uncertainty of 1e-6 of its unit.
    pub fn context(&mut self, units: UnitsOf) -> Id {
        let metre = |prefix: &str| format!("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT({prefix},.METRE.))");
        let radian = self.add("(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.))");
        let (length, angle) = match units {
            UnitsOf::Millimetres => (self.add(metre(".MILLI.")), radian),
            UnitsOf::Metres => (self.add(metre("$")), radian),
            UnitsOf::InchesAndDegrees => {
                let millimetre = self.add(metre(".MILLI."));
                let inch = self.add(format!("LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),#{millimetre})"));
                let degree = self.add(format!(
                    "PLANE_ANGLE_MEASURE_WITH_UNIT(PLANE_ANGLE_MEASURE(0.0174532925),#{radian})"
                ));
                let exponents = self.add("DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.)");
                let inch =
                    format!("(CONVERSION_BASED_UNIT('INCH',#{inch})LENGTH_UNIT()NAMED_UNIT(#{exponents}))");
                let degree = format!(
                    "(CONVERSION_BASED_UNIT('DEGREE',#{degree})NAMED_UNIT(#{exponents})PLANE_ANGLE_UNIT())"
                );
                (self.add(inch), self.add(degree))
            }
        };
        let uncertainty = self.add(format!(
            "UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-6),#{length},'distance_accuracy_value','')"
        ));
        self.add(format!(
            "(GEOMETRIC_REPRESENTATION_CONTEXT(3)\nGLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#{uncertainty}))\n\
             GLOBAL_UNIT_ASSIGNED_CONTEXT((#{length},#{angle}))REPRESENTATION_CONTEXT('',''))"
        ))
    }

    /// A representation of these items.
    pub fn representation(&mut self, items: &[Id], context: Id) -> Id {
        self.add(format!("SHAPE_REPRESENTATION('',{},#{context})", list(items)))
    }

    /// The definition of a product of this name with a representation.
    pub fn product(&mut self, name: &str, representation: Id) -> Id {
        let product = self.add(format!("PRODUCT('id','{name}','',())"));
        let formation = self.add(format!("PRODUCT_DEFINITION_FORMATION('','',#{product})"));
        let definition = self.add(format!("PRODUCT_DEFINITION('','',#{formation},$)"));
        let shape = self.add(format!("PRODUCT_DEFINITION_SHAPE('','',#{definition})"));
        self.add(format!("SHAPE_DEFINITION_REPRESENTATION(#{shape},#{representation})"));
        definition
    }

    /// The text of a file of what was added.
    pub fn text(&self) -> String {
        let instance = |(index, entity): (usize, &String)| format!("#{}={entity};\n", index + 1);
        let data: String = self.entities.iter().enumerate().map(instance).collect();
        format!(
            "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('','',(''),(''),'','','');\n\
             FILE_SCHEMA(('AUTOMOTIVE_DESIGN'));\nENDSEC;\nDATA;\n{data}ENDSEC;\nEND-ISO-10303-21;\n"
        )
    }

    /// The text of a file of one product of these items.
    pub fn of(mut self, items: &[Id], units: UnitsOf) -> String {
        let context = self.context(units);
        let representation = self.representation(items, context);
        self.product("part", representation);
        self.text()
    }
}
