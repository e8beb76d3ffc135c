// The foot of a target on one patch, as `src/project`: damped Newton or the
// paper's tangent-plane step. The host writes NEWTON above this text.

struct Foot {
    at: vec2<f32>,
    distance_squared: f32,
    status: u32,
}

// As in `src/project/newton.rs`, for float32: the error of a distance is the
// cosine squared, so 1e-4 is below its rounding.
const STATIONARY_COSINE: f32 = 1e-4;
const RESIDUAL_ROUNDING: f32 = 1e-6;
const STALLED_COSINE: f32 = 1e-2;
const MOST_HALVINGS: u32 = 8u;
const DEGENERATE_RATIO: f32 = 1e-6;

fn nearest_control(first: u32, local: vec3<f32>) -> vec2<f32> {
    var nearest = 0u;
    var least = 3.0e38;
    for (var index = 0u; index < PATCH_SIZE; index++) {
        let control = controls[first + index];
        let offset = control.xyz / control.w - local;
        let distance_squared = dot(offset, offset);
        if distance_squared < least {
            least = distance_squared;
            nearest = index;
        }
    }
    return vec2<f32>(f32(nearest / COLUMNS) / f32(P), f32(nearest % COLUMNS) / f32(Q));
}

fn settled(free: vec2<bool>) -> u32 {
    return select(ON_EDGE, CONVERGED, all(free));
}

// The largest cosine between the residual and a free tangent, rounding taken off.
fn stationarity(jet: Jet, residual: vec3<f32>, gradient: vec2<f32>, free: vec2<bool>) -> f32 {
    let size = length(residual);
    let tangents = vec2<f32>(length(jet.s), length(jet.t));
    let rounding = RESIDUAL_ROUNDING * (tangents.x + tangents.y + size);
    let room = abs(gradient) - tangents * rounding;
    let cosines = select(vec2<f32>(0.0), room / (tangents * size), free & (room > vec2<f32>(0.0)));
    return max(cosines.x, cosines.y);
}

// The minimum of the quadratic model inside the patch, as far as one cut at an edge finds it.
fn newton_step(at: vec2<f32>, gradient: vec2<f32>, hessian: vec3<f32>, freed: vec2<bool>) -> vec2<f32> {
    let weight = vec2<f32>(hessian.x, hessian.z);
    let least = DEGENERATE_RATIO * max(weight.x, weight.y);
    let free = freed & (weight > vec2<f32>(least));
    let alone = select(vec2<f32>(0.0), -gradient / weight, free);
    if !all(free) {
        return alone;
    }
    let determinant = hessian.x * hessian.z - hessian.y * hessian.y;
    if determinant <= DEGENERATE_RATIO * hessian.x * hessian.z {
        return vec2<f32>(alone.x, 0.0);
    }
    var full = vec2<f32>(
        hessian.y * gradient.y - hessian.z * gradient.x,
        hessian.y * gradient.x - hessian.x * gradient.y,
    ) / determinant;
    let in_s = clamp(at.x + full.x, 0.0, 1.0) - at.x;
    if in_s != full.x {
        full = vec2<f32>(in_s, -(gradient.y + hessian.y * in_s) / weight.y);
    }
    let in_t = clamp(at.y + full.y, 0.0, 1.0) - at.y;
    if in_t != full.y {
        full = vec2<f32>(-(gradient.x + hessian.y * in_t) / weight.x, in_t);
    }
    return full;
}

fn newton(first: u32, local: vec3<f32>, start: vec2<f32>, iterations: u32) -> Foot {
    var at = start;
    var jet = evaluate_jet(first, at);
    var residual = jet.point - local;
    var value = dot(residual, residual);
    for (var iteration = 0u; iteration < iterations; iteration++) {
        let gradient = vec2<f32>(dot(residual, jet.s), dot(residual, jet.t));
        let pushed_below = (at <= vec2<f32>(0.0)) & (gradient > vec2<f32>(0.0));
        let pushed_above = (at >= vec2<f32>(1.0)) & (gradient < vec2<f32>(0.0));
        let free = !(pushed_below | pushed_above);
        let cosine = stationarity(jet, residual, gradient, free);
        if cosine <= STATIONARY_COSINE {
            return Foot(at, value, settled(free));
        }
        let flat = vec3<f32>(dot(jet.s, jet.s), dot(jet.s, jet.t), dot(jet.t, jet.t));
        let full = flat + vec3<f32>(dot(residual, jet.ss), dot(residual, jet.st), dot(residual, jet.tt));
        var definite = full.z > 0.0;
        if free.x {
            definite = full.x > 0.0 && (!free.y || full.x * full.z > full.y * full.y);
        }
        let step = newton_step(at, gradient, select(flat, full, definite), free);
        var scale = 1.0;
        var fell = false;
        for (var halving = 0u; halving <= MOST_HALVINGS; halving++) {
            let next = clamp(at + scale * step, vec2<f32>(0.0), vec2<f32>(1.0));
            let next_jet = evaluate_jet(first, next);
            let next_residual = next_jet.point - local;
            let next_value = dot(next_residual, next_residual);
            if next_value < value {
                at = next;
                jet = next_jet;
                residual = next_residual;
                value = next_value;
                fell = true;
                break;
            }
            scale *= 0.5;
        }
        if !fell {
            return Foot(at, value, select(ITERATION_LIMIT, settled(free), cosine <= STALLED_COSINE));
        }
    }
    return Foot(at, value, ITERATION_LIMIT);
}

fn tangent_plane(first: u32, local: vec3<f32>, start: vec2<f32>, iterations: u32, step_tolerance: f32) -> Foot {
    var at = start;
    var jet = evaluate_jet(first, at);
    var distance = length(jet.point - local);
    for (var iteration = 0u; iteration < iterations; iteration++) {
        let residual = local - jet.point;
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
        let inside = clamp(next, vec2<f32>(0.0), vec2<f32>(1.0));
        let cut = any(inside != next);
        at = inside;
        jet = evaluate_jet(first, at);
        let next_distance = length(jet.point - local);
        let change = abs(next_distance - distance);
        distance = next_distance;
        if change < step_tolerance {
            return Foot(at, distance * distance, select(CONVERGED, ON_EDGE, cut));
        }
    }
    return Foot(at, distance * distance, ITERATION_LIMIT);
}

fn foot(first: u32, local: vec3<f32>, iterations: u32, step_tolerance: f32) -> Foot {
    let start = nearest_control(first, local);
    if NEWTON {
        return newton(first, local, start, iterations);
    }
    return tangent_plane(first, local, start, iterations, step_tolerance);
}
