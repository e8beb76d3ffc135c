//! Loops whose curves meet in equal floats, inside the domain.

use super::gap::Gap;
use super::mapping::Mapped;
use super::metric::Metric;
use crate::nurbs::{Spline, SurfaceNet, project};
use glam::DVec3;

/// Part of the domain within which constant parameters of lines are made equal, to each
/// other and to the ends of the domain.
const SAME_PARAMETER: f64 = 1e-9;

/// Makes every curve begin in the floats in which the one before it ends, keeps parameter
/// lines constant, and adds to the gaps what the ends are moved by.
///
/// Moving an end control point moves a clamped curve by at most as much in the parameters, and
/// the metric bounds the length of that in space.
pub(super) fn join(loops: &mut [Vec<Mapped>], net: &SurfaceNet, metric: &Metric) {
    let domain = net.domain();
    for axis in [0, 1] {
        align(loops, axis, domain[axis], metric);
    }
    for curves in loops.iter_mut() {
        let count = curves.len();
        for index in 0..count {
            let next = (index + 1) % count;
            let (end, start) = (curves[index].curve.end(), curves[next].curve.start());
            let mut joint = 0.5 * (end + start);
            for axis in [0, 1] {
                if curves[index].constant[axis] {
                    joint[axis] = end[axis];
                } else if curves[next].constant[axis] {
                    joint[axis] = start[axis];
                } else if end[axis] == start[axis] {
                    joint[axis] = end[axis];
                }
            }
            joint = clamped(joint, domain);
            move_end(&mut curves[index], true, joint, (net, metric));
            move_end(&mut curves[next], false, joint, (net, metric));
        }
        for mapped in curves {
            keep_inside(mapped, (net, metric));
        }
    }
}

/// Makes nearly equal constants of parameter lines equal.
fn align(loops: &mut [Vec<Mapped>], axis: usize, [start, end]: [f64; 2], metric: &Metric) {
    let lines = || loops.iter().flatten().filter(|mapped| mapped.constant[axis]);
    let mut values: Vec<f64> = lines().map(|mapped| mapped.curve.start()[axis]).collect();
    values.sort_by(f64::total_cmp);
    let margin = SAME_PARAMETER * (end - start);
    // Each value's representative: an end of the domain, or the first of its neighbours.
    let mut aligned: Vec<(f64, f64)> = Vec::new();
    for value in values {
        let representative = if (value - start).abs() <= margin {
            start
        } else if (value - end).abs() <= margin {
            end
        } else {
            match aligned.last() {
                Some(&(_, last)) if value - last <= margin => last,
                _ => value,
            }
        };
        aligned.push((value, representative));
    }
    for mapped in loops.iter_mut().flatten().filter(|mapped| mapped.constant[axis]) {
        let value = mapped.curve.start()[axis];
        let index = aligned.partition_point(|&(other, _)| other < value);
        if let Some(&(_, representative)) = aligned.get(index) {
            let mut moved = DVec3::ZERO;
            moved[axis] = representative - value;
            mapped.gap = mapped.gap.plus(Gap::proven(metric.length(moved)));
            for control in &mut mapped.curve.controls {
                control[axis] = representative * control.w;
            }
        }
    }
}

fn clamped(point: DVec3, [[u0, u1], [v0, v1]]: [[f64; 2]; 2]) -> DVec3 {
    DVec3::new(point.x.clamp(u0, u1), point.y.clamp(v0, v1), 0.0)
}

/// Returns the distance in space between two points of the parameters.
fn moved_by(net: &SurfaceNet, from: DVec3, to: DVec3) -> f64 {
    net.point(from.x, from.y).distance(net.point(to.x, to.y))
}

/// Moves the start or end of a curve.
fn move_end(mapped: &mut Mapped, at_end: bool, to: DVec3, (net, metric): (&SurfaceNet, &Metric)) {
    let controls = &mut mapped.curve.controls;
    let index = if at_end { controls.len() - 1 } else { 0 };
    let from = project(controls[index]);
    if from != to {
        let moved = Gap::bounded(metric.length(to - from), moved_by(net, from, to), metric);
        mapped.gap = mapped.gap.plus(moved);
        controls[index] = (controls[index].w * to).extend(controls[index].w);
    }
}

/// Moves control points that rounding or a fit placed outside of the domain into it.
fn keep_inside(mapped: &mut Mapped, (net, metric): (&SurfaceNet, &Metric)) {
    let domain = net.domain();
    let (mut bound, mut found) = (0.0_f64, 0.0_f64);
    let Spline { controls, .. } = &mut mapped.curve;
    let last = controls.len() - 1;
    for control in &mut controls[1..last.max(1)] {
        let from = project(*control);
        let to = clamped(from, domain);
        // Control points may lie farther out where the curve does not.
        let near = (0..2).all(|axis| {
            (from[axis] - to[axis]).abs() <= SAME_PARAMETER * (domain[axis][1] - domain[axis][0])
        });
        if !near {
            continue;
        }
        if from.x != to.x || from.y != to.y {
            bound = bound.max(metric.length(to - from));
            found = found.max(moved_by(net, from, to));
            *control = (control.w * to).extend(control.w);
        }
    }
    mapped.gap = mapped.gap.plus(Gap::bounded(bound, found, metric));
}
