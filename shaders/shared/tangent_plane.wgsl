// The tangent-plane iteration of the 2012 paper. CPU twin:
// `src/closest/tangent_plane.rs`.

// Projects `local` on the tangent plane and steps to that point's parameters,
// clamped to the patch, until two consecutive distances differ by less than
// `step_tolerance` or `iterations` steps are taken.
fn iterate(first: u32, local: vec3<f32>, iterations: u32, step_tolerance: f32) -> Foot {
    var at = nearest_control(first, local);
    var distance = UNKNOWN_DISTANCE;
    var is_clamped = false;
    var steps = 0u;
    var status = ITERATION_LIMIT;
    loop {
        let jet = evaluate_jet(first, at);
        let residual = local - jet.point;
        let next_distance = length(residual);
        let change = abs(next_distance - distance);
        distance = next_distance;
        if steps > 0u && change < step_tolerance {
            status = select(CONVERGED, ON_EDGE, is_clamped);
            break;
        }
        if steps == iterations {
            break;
        }
        let metric = vec3<f32>(dot(jet.s, jet.s), dot(jet.s, jet.t), dot(jet.t, jet.t));
        let gradient = vec2<f32>(dot(residual, jet.s), dot(residual, jet.t));
        let determinant = metric.x * metric.z - metric.y * metric.y;
        var next = at;
        if determinant > DEGENERATE_RATIO * metric.x * metric.z {
            next += vec2<f32>(
                metric.z * gradient.x - metric.y * gradient.y,
                metric.x * gradient.y - metric.y * gradient.x,
            ) / determinant;
        }
        at = clamp(next, vec2<f32>(0.0), vec2<f32>(1.0));
        is_clamped = any(at != next);
        steps++;
    }
    return Foot(at, distance * distance, status);
}
