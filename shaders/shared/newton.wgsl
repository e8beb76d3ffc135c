// Damped Newton iteration with an active set at the patch's edges. CPU twin:
// `src/closest/newton.rs`, with tolerances for float64. The host generates
// MAX_HALVINGS.

// The relative error of the distance is half the square of this cosine, below
// float32's rounding.
const STATIONARY_COSINE: f32 = 1e-4;
// Relative rounding error of a residual.
const RESIDUAL_ROUNDING: f32 = 1e-6;
// A predicted decrease below this fraction of the squared distance is lost in
// its rounding.
const STALLED_DECREASE: f32 = 1e-6;

// Whether the cosines between the residual and the free tangents are small,
// beyond the rounding error.
fn is_stationary(jet: Jet, residual: vec3<f32>, gradient: vec2<f32>, free: vec2<bool>) -> bool {
    let size = length(residual);
    let tangents = vec2<f32>(length(jet.s), length(jet.t));
    let rounding = RESIDUAL_ROUNDING * (tangents.x + tangents.y + size);
    return !any(free & (abs(gradient) > tangents * (rounding + STATIONARY_COSINE * size)));
}

// The step to the minimum of the quadratic model over the patch. A step that
// leaves it is cut at the edge and the other parameter solved again.
fn newton_step(at: vec2<f32>, gradient: vec2<f32>, hessian: vec3<f32>, not_frozen: vec2<bool>) -> vec2<f32> {
    let weight = vec2<f32>(hessian.x, hessian.z);
    let min_weight = DEGENERATE_RATIO * max(weight.x, weight.y);
    let free = not_frozen & (weight > vec2<f32>(min_weight));
    let inverse = 1.0 / weight;
    let separate = select(vec2<f32>(0.0), -gradient * inverse, free);
    if !all(free) {
        return separate;
    }
    let determinant = hessian.x * hessian.z - hessian.y * hessian.y;
    if determinant <= DEGENERATE_RATIO * hessian.x * hessian.z {
        return vec2<f32>(separate.x, 0.0);
    }
    var full = vec2<f32>(
        hessian.y * gradient.y - hessian.z * gradient.x,
        hessian.y * gradient.x - hessian.x * gradient.y,
    ) * (1.0 / determinant);
    let inside_s = clamp(at.x + full.x, 0.0, 1.0) - at.x;
    if inside_s != full.x {
        full = vec2<f32>(inside_s, -(gradient.y + hessian.y * inside_s) * inverse.y);
    }
    let inside_t = clamp(at.y + full.y, 0.0, 1.0) - at.y;
    if inside_t != full.y {
        full = vec2<f32>(-(gradient.x + hessian.y * inside_t) * inverse.x, inside_t);
    }
    return full;
}

// The nearest point to `local` that Newton's method finds from the nearest
// control. The start, every step and every halving share one evaluation, so
// that the compiler inlines it once and threads at different stages of the
// iteration run it together.
fn iterate(first: u32, local: vec3<f32>, iterations: u32, step_tolerance: f32) -> Foot {
    var at = nearest_control(first, local);
    var step = vec2<f32>(0.0);
    var scale = 1.0;
    var value = UNKNOWN_DISTANCE;
    var decrease = 0.0;
    var free = vec2<bool>(true);
    var steps = 0u;
    var halvings = 0u;
    var status = ITERATION_LIMIT;
    loop {
        let next = clamp(at + scale * step, vec2<f32>(0.0), vec2<f32>(1.0));
        let jet = evaluate_jet(first, next);
        let residual = jet.point - local;
        let next_value = dot(residual, residual);
        if !(next_value < value) {
            halvings++;
            // No shorter step decreases it beyond rounding either.
            let stalled = decrease <= STALLED_DECREASE * value;
            if stalled || halvings > MAX_HALVINGS {
                status = select(ITERATION_LIMIT, settled(free), stalled);
                break;
            }
            scale *= 0.5;
            continue;
        }
        at = next;
        value = next_value;
        let gradient = vec2<f32>(dot(residual, jet.s), dot(residual, jet.t));
        let leaves_below = (at <= vec2<f32>(0.0)) & (gradient > vec2<f32>(0.0));
        let leaves_above = (at >= vec2<f32>(1.0)) & (gradient < vec2<f32>(0.0));
        free = !(leaves_below | leaves_above);
        if is_stationary(jet, residual, gradient, free) {
            status = settled(free);
            break;
        }
        if steps == iterations {
            break;
        }
        let ss = dot(jet.s, jet.s) + dot(residual, jet.ss);
        let st = dot(jet.s, jet.t) + dot(residual, jet.st);
        let tt = dot(jet.t, jet.t) + dot(residual, jet.tt);
        let sizes = vec3<f32>(abs(ss), 0.0, abs(tt));
        let hessian = select(sizes, vec3<f32>(ss, st, tt), ss > 0.0 && ss * tt > st * st);
        step = newton_step(at, gradient, hessian, free);
        decrease = abs(dot(gradient, step));
        steps++;
        scale = 1.0;
        halvings = 0u;
    }
    return Foot(at, value, status);
}

fn settled(free: vec2<bool>) -> u32 {
    return select(ON_EDGE, CONVERGED, all(free));
}
