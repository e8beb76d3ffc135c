//! A writer of IGES files, entity by entity.

/// The number of an entity in the directory.
pub type Id = usize;

/// An entity: its type, form and matrix, whether it depends on another one, and its parameters.
#[derive(Debug, Clone)]
pub struct Entry {
    pub kind: u32,
    pub form: i32,
    pub matrix: Id,
    pub dependent: bool,
    /// A numbered colour, or the entity that defines one with a minus sign.
    pub color: i64,
    pub label: String,
    pub parameters: String,
}

/// A file under construction.
#[derive(Debug, Clone)]
pub struct IgesText {
    pub entries: Vec<Entry>,
    /// The flag of the unit and its name.
    pub unit: (u32, &'static str),
}

/// The curves of a boundary, in the parameters and in space.
pub type Boundary = (Id, Id);

impl IgesText {
    pub fn new() -> Self {
        Self { entries: Vec::new(), unit: (2, "MM") }
    }

    /// Adds an entity.
    pub fn add(&mut self, kind: u32, form: i32, parameters: impl Into<String>) -> Id {
        let parameters = parameters.into();
        let entry =
            Entry { kind, form, matrix: 0, dependent: false, color: 0, label: String::new(), parameters };
        self.entries.push(entry);
        2 * self.entries.len() - 1
    }

    /// Places an entity by a matrix.
    pub fn place(&mut self, entity: Id, matrix: Id) {
        self.entries[entity / 2].matrix = matrix;
    }

    /// A matrix of three rows.
    pub fn matrix(&mut self, rows: [[f64; 4]; 3]) -> Id {
        self.add(124, 0, numbers(&rows.concat()))
    }

    pub fn line(&mut self, from: [f64; 3], to: [f64; 3]) -> Id {
        self.add(110, 0, numbers(&[from, to].concat()))
    }

    /// An arc about z from one point counter-clockwise to another.
    pub fn arc(&mut self, height: f64, [from, to]: [[f64; 2]; 2]) -> Id {
        self.add(100, 0, numbers(&[height, 0.0, 0.0, from[0], from[1], to[0], to[1]]))
    }

    pub fn composite(&mut self, parts: &[Id]) -> Id {
        self.add(102, 0, list(parts))
    }

    /// The closed polygon of some points, as a composite of lines.
    pub fn polygon(&mut self, corners: &[[f64; 3]]) -> Id {
        let next = corners.iter().cycle().skip(1);
        let sides: Vec<Id> = corners.iter().zip(next).map(|(&a, &b)| self.line(a, b)).collect();
        self.composite(&sides)
    }

    /// A rational B-spline curve, of points with weights.
    pub fn spline(&mut self, degree: usize, knots: &[f64], points: &[([f64; 3], f64)]) -> Id {
        let mut values = knots.to_vec();
        values.extend(points.iter().map(|(_, weight)| weight));
        values.extend(points.iter().flat_map(|(point, _)| point));
        values.extend([knots[degree], knots[points.len()], 0.0, 0.0, 1.0]);
        self.add(126, 0, format!("{},{degree},0,0,0,0,{}", points.len() - 1, numbers(&values)))
    }

    /// The bilinear surface with these corners (u fastest), over the unit square.
    pub fn bilinear(&mut self, corners: [[f64; 3]; 4]) -> Id {
        let mut values = vec![0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0];
        values.extend(corners.concat());
        values.extend([0.0, 1.0, 0.0, 1.0]);
        self.add(128, 0, format!("1,1,1,1,0,0,1,0,0,{}", numbers(&values)))
    }

    /// The surface of a curve turned about the axis z.
    pub fn revolution(&mut self, generatrix: Id, [start, end]: [f64; 2]) -> Id {
        let axis = self.line([0.0; 3], [0.0, 0.0, 1.0]);
        self.add(120, 0, format!("{axis},{generatrix},{}", numbers(&[start, end])))
    }

    /// A trimmed surface; without an outer boundary, within that of the surface.
    pub fn trimmed(&mut self, surface: Id, outer: Option<Boundary>, holes: &[Boundary]) -> Id {
        let mut boundary =
            |(parameters, space): Boundary| self.add(142, 0, format!("1,{surface},{parameters},{space},1"));
        let outer = outer.map(&mut boundary);
        let holes: Vec<String> = holes.iter().map(|&hole| boundary(hole).to_string()).collect();
        let [flag, outer] = [usize::from(outer.is_some()), outer.unwrap_or(0)];
        let parameters = format!("{surface},{flag},{},{outer},{}", holes.len(), holes.join(","));
        self.add(144, 0, parameters.trim_end_matches(','))
    }

    pub fn point(&mut self, at: [f64; 3]) -> Id {
        self.add(116, 0, format!("{},0", numbers(&at)))
    }

    pub fn direction(&mut self, along: [f64; 3]) -> Id {
        self.add(123, 0, numbers(&along))
    }

    /// The text with the sections of the format.
    pub fn text(&self) -> String {
        let (unit, name) = self.unit;
        let global = format!(
            "1H,,1H;,4Hpart,8Hpart.igs,4Htest,4Htest,32,38,6,308,15,4Hpart,1.,{unit},{}H{name},1,0.01,\
             15H20260101.000000,1.0E-7,100.,4Hname,4Hname,11,0,15H20260101.000000;",
            name.len()
        );
        let mut lines = vec![line("made by a test", 'S', 1)];
        let global = wrapped(&global, 72);
        lines.extend(global.iter().enumerate().map(|(index, text)| line(text, 'G', index + 1)));
        let (mut directory, mut parameters) = (Vec::new(), Vec::new());
        for (index, entry) in self.entries.iter().enumerate() {
            let number = 2 * index + 1;
            let own = wrapped(&format!("{},{};", entry.kind, entry.parameters), 64);
            let status = if entry.dependent { "00010000" } else { "00000000" };
            let first = parameters.len() + 1;
            let Entry { kind, form, matrix, color, label, .. } = entry;
            let fields = format!("{kind:8}{first:8}{0:8}{0:8}{0:8}{0:8}{matrix:8}{0:8}{status}", 0);
            directory.push(line(&fields, 'D', number));
            let fields = format!(
                "{kind:8}{0:8}{color:8}{count:8}{form:8}{0:8}{0:8}{label:>8}{0:8}",
                0,
                count = own.len()
            );
            directory.push(line(&fields, 'D', number + 1));
            for text in own {
                parameters.push(line(&format!("{text:64}{number:8}"), 'P', parameters.len() + 1));
            }
        }
        let totals = [('S', 1), ('G', global.len()), ('D', directory.len()), ('P', parameters.len())];
        let totals: String = totals.iter().map(|(letter, count)| format!("{letter}{count:7}")).collect();
        lines.extend(directory);
        lines.extend(parameters);
        lines.push(line(&totals, 'T', 1));
        lines.concat()
    }
}

fn line(content: &str, section: char, number: usize) -> String {
    format!("{content:72}{section}{number:7}\n")
}

/// Cuts values behind commas, so that no line is longer.
fn wrapped(text: &str, columns: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for value in text.split_inclusive(',') {
        if lines[lines.len() - 1].len() + value.len() > columns {
            lines.push(String::new());
        }
        let last = lines.len() - 1;
        lines[last].push_str(value);
    }
    lines
}

/// Numbers with every digit of float64.
pub fn numbers(values: &[f64]) -> String {
    let values: Vec<String> = values.iter().map(|value| format!("{value:?}")).collect();
    values.join(",")
}

/// A count and references.
pub fn list(ids: &[Id]) -> String {
    let ids: Vec<String> =
        std::iter::once(ids.len()).chain(ids.iter().copied()).map(|id| id.to_string()).collect();
    ids.join(",")
}
