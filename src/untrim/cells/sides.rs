//! The sides of a cell: parts of arcs, whose distance from the arcs is proven from values.

use crate::approximation::bernstein::elevated;
use crate::approximation::chebyshev::{coefficients, node_factor, nodes, to_bernstein};
use crate::rounding::upper_max;
use crate::untrim::boundary::Side;
use crate::untrim::boundary::graph::{Graph, residual};
use crate::untrim::curve::{Curve, casteljau, divided};
use glam::{DVec2, DVec3};

/// A part of an arc as a curve.
#[derive(Debug)]
pub(super) struct ArcPart {
    pub(super) curve: Curve,
    /// Upper bounds on the distances in u and v between the curve and the arc (lemma T3).
    pub(super) moved: [f64; 2],
}

/// The degrees tried for the composition of a graph with a height function, increasing.
const COMPOSITE_DEGREES: [usize; 9] = [1, 2, 3, 4, 5, 7, 9, 12, 15];

/// Returns the part of an arc between two levels; `None` where the curve cannot be solved for
/// them.
pub(super) fn part(side: &Side, levels: [f64; 2]) -> Option<ArcPart> {
    match side {
        Side::Graph(graph) => {
            let curve = graph.restricted(levels);
            Some(ArcPart { moved: moves(graph, &curve), curve })
        }
        Side::Own(own) => {
            let [from, to] = levels.map(|v| own.solve(v));
            if from >= to {
                return None;
            }
            let curve = own.restricted(from, to);
            let missed = [curve.start().y - levels[0], curve.end().y - levels[1]].map(f64::abs);
            Some(ArcPart { curve, moved: [0.0, upper_max(missed[0], missed[1])] })
        }
    }
}

/// Returns upper bounds on the distances in u and v between a curve and a graph.
fn moves(graph: &Graph, curve: &Curve) -> [f64; 2] {
    if graph.degree() > 1 {
        return [residual(graph, curve), 0.0];
    }
    let (from, to) = (graph.coefficients[0], graph.coefficients[graph.degree()]);
    let slope = if graph.degree() == 0 { 0.0 } else { (to - from) / (graph.v[1] - graph.v[0]) };
    // The distance along an axis from a straight line is affine, so that it is largest at a control
    // point. On a steep line a rounding of v is a visible step in u, and is measured in v.
    let largest = |distance: &dyn Fn(DVec2) -> f64| {
        curve.controls.iter().map(|&control| distance(divided(control)).abs()).fold(0.0, upper_max)
    };
    if slope.abs() <= 1.0 {
        [largest(&|point| point.x - from - slope * (point.y - graph.v[0])), 0.0]
    } else {
        [0.0, largest(&|point| point.y - graph.v[0] - (point.x - from) / slope)]
    }
}

/// Returns the graph as a curve with the same v and weight as `height` at equal
/// parameters, within `tolerance` of the graph in u.
pub(super) fn follow(graph: &Graph, height: &Curve, tolerance: f64) -> Option<ArcPart> {
    if graph.degree() <= 1 {
        let curve = line(graph, height);
        return Some(ArcPart { moved: moves(graph, &curve), curve });
    }
    let degree = height.degree();
    let value = |t: f64| {
        let homogeneous = height.at(t);
        (homogeneous, graph.at(divided(homogeneous).y))
    };
    let least = height.controls.iter().map(|control| control.z).fold(f64::INFINITY, f64::min);
    let ends = [value(0.0).1, value(1.0).1];
    for own in COMPOSITE_DEGREES {
        let samples: Vec<f64> = nodes(own + 1).map(value).map(|(homogeneous, u)| homogeneous.z * u).collect();
        let mut x = to_bernstein(&coefficients(&samples), own);
        let weights = [height.controls[0].z, height.controls[degree].z];
        let shifts = [ends[0] * weights[0] - x[0], ends[1] * weights[1] - x[own]];
        for (k, x) in x.iter_mut().enumerate() {
            let share = k as f64 / own as f64;
            *x += (1.0 - share) * shifts[0] + share * shifts[1];
        }
        // (x - w g(y / w)) w^(m - 1) is a polynomial, m the degree of g.
        let power = graph.degree() - 1;
        let total = (own + degree * power).max(degree * graph.degree());
        let count = 2 * total;
        let mut largest = 0.0_f64;
        for t in nodes(count) {
            let (homogeneous, u) = value(t);
            let difference = (casteljau(&x, t) - homogeneous.z * u).abs() / least;
            largest = upper_max(largest, difference * (homogeneous.z / least).powi(power as i32));
        }
        let error = largest * node_factor(total, count);
        if error <= tolerance {
            let raised = own.max(degree);
            let x = x.iter().map(|&x| DVec3::new(x, 0.0, 0.0)).collect::<Vec<_>>();
            let (x, height) = (elevated(x, raised), elevated(height.controls.clone(), raised));
            let controls = x.iter().zip(&height).map(|(x, h)| DVec3::new(x.x, h.y, h.z)).collect();
            return Some(ArcPart { curve: Curve { controls }, moved: [error, 0.0] });
        }
    }
    None
}

/// Returns a straight graph as a curve with the v and the weights of `height`: u is affine in v,
/// and between the graph's ends where v is.
fn line(graph: &Graph, height: &Curve) -> Curve {
    let (from, to) = (graph.coefficients[0], graph.coefficients[graph.degree()]);
    let control = |control: &DVec3| {
        let share = (control.y / control.z - graph.v[0]) / (graph.v[1] - graph.v[0]);
        let u = if from == to { from } else { (1.0 - share) * from + share * to };
        DVec3::new(u * control.z, control.y, control.z)
    };
    Curve { controls: height.controls.iter().map(control).collect() }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;

    /// The right half of a circle of radius 1/2 about (0, 1/2) up to its extreme.
    fn quarter() -> Curve {
        let w = std::f64::consts::FRAC_1_SQRT_2;
        let points = [[0.0, 0.0, 1.0], [0.5, 0.0, w], [0.5, 0.5, 1.0]];
        Curve { controls: points.map(|[u, v, w]| DVec3::new(u * w, v * w, w)).to_vec() }
    }

    #[test]
    fn a_part_of_any_height_is_on_its_arc_or_there_is_none() {
        for low in [0.0, 1e-300, 1e-17, 0.1, 0.4807692307692307, 0.5_f64.next_down()] {
            for high in [low.next_up(), low + 1e-15, low + 1e-9, 0.5] {
                let Some(part) = part(&Side::Own(quarter()), [low, high.min(0.5)]) else { continue };
                assert!(part.moved[1] <= 4.0 * f64::EPSILON, "{low} {high}: {:?}", part.moved);
                for share in [0.0, 0.3, 1.0] {
                    let point = part.curve.point(share);
                    let radius = point.distance(DVec2::new(0.0, 0.5));
                    assert!((radius - 0.5).abs() < 1e-15, "{low} {high}: {point:?}");
                    let above = point.y - high.min(0.5);
                    assert!(above <= 1e-15 && low - point.y <= 1e-15, "{low} {high}: {point:?}");
                }
            }
        }
    }

    #[test]
    fn a_part_beyond_its_arc_states_what_it_misses_and_one_that_falls_is_none() {
        let missing = part(&Side::Own(quarter()), [-0.1, 0.3]).unwrap();
        assert_eq!(missing.moved, [0.0, 0.1]);
        let missing = part(&Side::Own(quarter()), [0.3, 0.75]).unwrap();
        assert_eq!(missing.moved, [0.0, 0.25]);
        assert!(part(&Side::Own(quarter()), [0.4, 0.2]).is_none());
        assert!(part(&Side::Own(quarter()), [0.3, 0.3]).is_none());
    }

    #[test]
    fn a_line_one_unit_high_is_followed_within_the_bound() {
        let v = [0.4807692307692307, 0.4807692307692307_f64.next_up()];
        let graph = Graph::line([0.2, 0.8], v);
        let height = Curve::line(DVec2::new(0.0, v[0]), DVec2::new(0.0, v[1]));
        let part = follow(&graph, &height, 1e-10).unwrap();
        assert_eq!([part.curve.start().x, part.curve.end().x], [0.2, 0.8]);
        assert!(part.moved[0] == 0.0 && part.moved[1] <= f64::EPSILON, "{:?}", part.moved);
        // A curve beside the line is as far from it as is said: in u on a line of slope 1 and less.
        let graph = Graph::line([0.2, 0.4], [0.0, 1.0]);
        let beside = Curve::line(DVec2::new(0.2, 0.0), DVec2::new(0.45, 1.0));
        assert!((moves(&graph, &beside)[0] - 0.05).abs() < 1e-15);
    }

    /// In v beside a steep line, and beside a curved graph in u with the factor of lemma T5.
    #[test]
    fn a_curve_beside_a_graph_is_as_far_from_it_as_is_said() {
        let steep = Graph::line([0.2, 0.8], [0.0, 0.1]);
        let beside = Curve::line(DVec2::new(0.2, 0.0), DVec2::new(0.8, 0.11));
        let [in_u, in_v] = moves(&steep, &beside);
        assert!(in_u == 0.0 && (in_v - 0.01).abs() < 1e-15, "{in_u} {in_v}");
        // u = v² and its chord are 1/4 apart.
        let parabola = Graph { v: [0.0, 1.0], coefficients: vec![0.0, 0.0, 1.0] };
        let [in_u, in_v] = moves(&parabola, &Curve::line(DVec2::ZERO, DVec2::ONE));
        assert!((0.25..=0.25 * std::f64::consts::SQRT_2).contains(&in_u) && in_v == 0.0, "{in_u}");
    }

    /// The error is the largest residual at the nodes, times the factor of lemma T5, over the least
    /// weight's power: the residual is a polynomial after multiplication with that.
    #[test]
    fn the_error_of_a_side_that_follows_a_graph_is_that_of_the_lemma() {
        let graph = Graph { v: [0.0, 1.0], coefficients: vec![0.0, 0.9, 0.1, 1.0] };
        for weights in [[1.0; 3], [0.5; 3], [0.5, 0.7, 0.4]] {
            let points = [0.0, 0.4, 1.0];
            let controls = points.iter().zip(weights).map(|(v, w)| DVec3::new(0.0, v * w, w));
            let height = Curve { controls: controls.collect() };
            let part = follow(&graph, &height, 0.05).unwrap();
            let (own, m) = (part.curve.degree(), graph.degree());
            assert!(own >= height.degree());
            let total = (own + height.degree() * (m - 1)).max(height.degree() * m);
            let least = weights.iter().copied().fold(f64::INFINITY, f64::min);
            let residual = |t: f64| {
                let point = part.curve.at(t);
                let distance = (point.x - point.z * graph.at(point.y / point.z)).abs();
                distance * point.z.powi(m as i32 - 1) / least.powi(m as i32)
            };
            let largest = nodes(2 * total).map(residual).fold(0.0, f64::max);
            let expected = largest * std::f64::consts::SQRT_2;
            assert!(
                largest > 1e-9 && (part.moved[0] - expected).abs() <= 1e-6 * expected,
                "{weights:?}: {part:?}"
            );
        }
    }
}
