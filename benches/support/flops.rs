//! Counts a kernel's floating-point operations by instrumenting its WGSL.
//!
//! Every block of the kernel, as naga parses it, adds the operations that it
//! evaluates to a counter of the thread, so branches not taken and loop turns
//! not made do not count. Addition, subtraction, multiplication, division and
//! square root count as one per component, `fma` as two, a dot product of n
//! components as 2n - 1; comparisons, selections, minima and maxima, signs and
//! conversions as zero.

use naga::valid::{Capabilities, FunctionInfo, ValidationFlags, Validator};
use naga::{
    BinaryOperator, Block, Expression, Function, GlobalVariable, Handle, Literal, MathFunction, Module,
    Range, ScalarKind, Span, Statement, TypeInner,
};

/// The statement that ends a kernel, and its replacement that writes the
/// counter `flops` in place of a float.
#[derive(Clone, Copy)]
pub(crate) struct End([&'static str; 2]);

/// `project` adds to `Projected.s`, over the groups of patches. What is there
/// before is 0, or a parameter, so less than one operation.
pub(crate) const PROJECT: End = End([
    "projected[sample] = best;",
    "let flops_before = projected[sample].s;
    projected[sample] = best;
    projected[sample].s = flops_before + f32(flops);",
]);

/// `cell_jet` writes `Projected.s`.
pub(crate) const CELL_JET: End = End(["cell.foot_parameters.x,", "f32(flops),"]);

/// `taylor_bound` writes `CellState.foot_distance`.
pub(crate) const TAYLOR_BOUND: End = End([
    "cells[id.x] = cell;",
    "cell.foot_distance = f32(flops);
    cells[id.x] = cell;",
]);

/// The kernel's text instrumented to write its number of operations at its
/// end. The count is exact below 2^24 per thread.
pub(crate) fn counting(text: &str, End([end, counted]): End) -> String {
    assert!(text.contains(end), "the kernel ends in another way: {text}");
    let counted = format!("{}\nvar<private> flops: u32 = 0u;\n", text.replace(end, counted));
    let mut module = naga::front::wgsl::parse_str(&counted).expect("valid WGSL");
    let info = validated(&module);
    let (flops, _) = module
        .global_variables
        .iter()
        .find(|(_, variable)| variable.name.as_deref() == Some("flops"))
        .expect("the counter");
    let original = module.clone();
    for (handle, function) in module.functions.iter_mut() {
        Counter { module: &original, info: &info[handle], flops }.count(function);
    }
    for (index, entry) in module.entry_points.iter_mut().enumerate() {
        Counter { module: &original, info: info.get_entry_point(index), flops }.count(&mut entry.function);
    }
    let info = validated(&module);
    naga::back::wgsl::write_string(&module, &info, naga::back::wgsl::WriterFlags::empty()).expect("WGSL")
}

fn validated(module: &Module) -> naga::valid::ModuleInfo {
    Validator::new(ValidationFlags::all(), Capabilities::empty()).validate(module).expect("a valid module")
}

struct Counter<'a> {
    module: &'a Module,
    info: &'a FunctionInfo,
    flops: Handle<GlobalVariable>,
}

impl Counter<'_> {
    fn count(&self, function: &mut Function) {
        let body = std::mem::take(&mut function.body);
        function.body = self.block(function, body);
    }

    /// The block, with its operations added to the counter before any statement
    /// that could leave it.
    fn block(&self, function: &mut Function, block: Block) -> Block {
        let mut operations = 0;
        let mut statements = Vec::new();
        for (mut statement, _) in block.span_into_iter() {
            if let Statement::Emit(range) = &statement {
                operations += range.clone().map(|handle| self.operations(function, handle)).sum::<u32>();
            } else if operations > 0 {
                statements.extend(self.addition(function, operations));
                operations = 0;
            }
            match &mut statement {
                Statement::Block(inner) => *inner = self.block(function, std::mem::take(inner)),
                Statement::If { accept, reject, .. } => {
                    *accept = self.block(function, std::mem::take(accept));
                    *reject = self.block(function, std::mem::take(reject));
                }
                Statement::Loop { body, continuing, .. } => {
                    *body = self.block(function, std::mem::take(body));
                    *continuing = self.block(function, std::mem::take(continuing));
                }
                Statement::Switch { .. } => panic!("a switch is not counted"),
                _ => {}
            }
            statements.push(statement);
        }
        if operations > 0 {
            statements.extend(self.addition(function, operations));
        }
        Block::from_vec(statements)
    }

    fn addition(&self, function: &mut Function, operations: u32) -> [Statement; 2] {
        let mut append = |expression| function.expressions.append(expression, Span::UNDEFINED);
        let pointer = append(Expression::GlobalVariable(self.flops));
        let right = append(Expression::Literal(Literal::U32(operations)));
        let left = append(Expression::Load { pointer });
        let value = append(Expression::Binary { op: BinaryOperator::Add, left, right });
        [Statement::Emit(Range::new_from_bounds(left, value)), Statement::Store { pointer, value }]
    }

    fn operations(&self, function: &Function, handle: Handle<Expression>) -> u32 {
        match function.expressions[handle] {
            Expression::Binary { op: BinaryOperator::Multiply, left, right }
                if self.is_matrix(left) || self.is_matrix(right) =>
            {
                self.products(left, right) * self.floats(handle)
            }
            Expression::Binary {
                op:
                    BinaryOperator::Add
                    | BinaryOperator::Subtract
                    | BinaryOperator::Multiply
                    | BinaryOperator::Divide,
                ..
            } => self.floats(handle),
            Expression::Math { fun, arg, .. } => match fun {
                MathFunction::Dot => 2 * self.floats(arg) - 1,
                MathFunction::Length => 2 * self.floats(arg),
                MathFunction::Sqrt => self.floats(arg),
                MathFunction::Fma => 2 * self.floats(arg),
                MathFunction::Abs
                | MathFunction::Min
                | MathFunction::Max
                | MathFunction::Clamp
                | MathFunction::Transpose => 0,
                other => panic!("{other:?} is not counted"),
            },
            _ => 0,
        }
    }

    /// Floating-point components of an expression's value.
    fn floats(&self, handle: Handle<Expression>) -> u32 {
        match *self.info[handle].ty.inner_with(&self.module.types) {
            TypeInner::Scalar(scalar) if scalar.kind == ScalarKind::Float => 1,
            TypeInner::Vector { size, scalar } if scalar.kind == ScalarKind::Float => size as u32,
            TypeInner::Matrix { columns, rows, .. } => columns as u32 * rows as u32,
            _ => 0,
        }
    }

    fn is_matrix(&self, handle: Handle<Expression>) -> bool {
        matches!(self.info[handle].ty.inner_with(&self.module.types), TypeInner::Matrix { .. })
    }

    /// Operations per component of a product with a matrix.
    fn products(&self, left: Handle<Expression>, right: Handle<Expression>) -> u32 {
        let terms = match *self.info[left].ty.inner_with(&self.module.types) {
            TypeInner::Matrix { columns, .. } if self.floats(right) > 1 => columns as u32,
            TypeInner::Vector { size, .. } => size as u32,
            // A scalar multiple.
            _ => 1,
        };
        2 * terms - 1
    }
}
