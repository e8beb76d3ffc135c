// Points with tangents of a bicubic polynomial surface, from its Bézier patches
// and from its own knots and control points. Only to compare their costs.

const EVALUATIONS = 64u;

struct Size {
    counts: vec2u,
    patches: vec2u,
}

@group(0) @binding(0) var<uniform> size: Size;
@group(0) @binding(1) var<storage, read> controls: array<vec4f>;
@group(0) @binding(2) var<storage, read> bezier_controls: array<vec4f>;
// The knots in u, then those in v.
@group(0) @binding(3) var<storage, read> knots: array<f32>;
@group(0) @binding(4) var<storage, read_write> sums: array<vec4f>;

// A number in [0, 1): the fractional parts of multiples of the golden ratio spread evenly.
fn spread(index: u32, ratio: f32) -> f32 {
    return fract(f32(index & 0xffffu) * ratio);
}

// Parameters in [0, 1)^2 of the whole surface. An invocation stays near one
// place, as an iteration does.
fn parameters(invocation: u32, evaluation: u32) -> vec2f {
    let near = vec2f(spread(invocation, 0.6180340), spread(invocation, 0.7548777));
    let step = 0.002 * vec2f(spread(evaluation, 0.5698403), spread(evaluation, 0.6180340));
    return min(near + step, vec2f(0.999999));
}

// The sum that stands for a result, so that no part of it is left out.
fn folded(point: vec4f, u: vec4f, v: vec4f) -> vec4f {
    let place = point.xyz / point.w;
    let tangents = (u.xyz - u.w * place) / point.w + (v.xyz - v.w * place) / point.w;
    return vec4f(place + tangents, 1.0);
}

@compute @workgroup_size(64)
fn bezier(@builtin(global_invocation_id) id: vec3u) {
    var sum = vec4f();
    for (var k = 0u; k < EVALUATIONS; k++) {
        let scaled = parameters(id.x, k) * vec2f(size.patches);
        let cell = vec2u(scaled);
        let t = scaled - vec2f(cell);
        let first = 16u * (cell.x * size.patches.y + cell.y);
        var columns: array<vec4f, 4>;
        var slopes: array<vec4f, 4>;
        for (var j = 0u; j < 4u; j++) {
            let a = bezier_controls[first + j];
            let b = bezier_controls[first + 4u + j];
            let c = bezier_controls[first + 8u + j];
            let d = bezier_controls[first + 12u + j];
            let ab = mix(mix(a, b, t.x), mix(b, c, t.x), t.x);
            let bc = mix(mix(b, c, t.x), mix(c, d, t.x), t.x);
            columns[j] = mix(ab, bc, t.x);
            slopes[j] = 3.0 * (bc - ab);
        }
        let ab = mix(mix(columns[0], columns[1], t.y), mix(columns[1], columns[2], t.y), t.y);
        let bc = mix(mix(columns[1], columns[2], t.y), mix(columns[2], columns[3], t.y), t.y);
        let slope_ab = mix(mix(slopes[0], slopes[1], t.y), mix(slopes[1], slopes[2], t.y), t.y);
        let slope_bc = mix(mix(slopes[1], slopes[2], t.y), mix(slopes[2], slopes[3], t.y), t.y);
        sum += folded(mix(ab, bc, t.y), mix(slope_ab, slope_bc, t.y), 3.0 * (bc - ab));
    }
    sums[id.x] = sum;
}

struct Basis {
    first: u32,
    values: vec4f,
    slopes: vec4f,
}

// The four cubic basis functions that do not vanish at t of the knots from
// `offset` on (Piegl and Tiller, The NURBS Book, algorithms A2.1 and A2.3).
fn basis(offset: u32, count: u32, t: f32) -> Basis {
    var low = 3u;
    var high = count;
    while (high - low > 1u) {
        let middle = (low + high) / 2u;
        if (knots[offset + middle] <= t) { low = middle; } else { high = middle; }
    }
    var values = array<f32, 4>(1.0, 0.0, 0.0, 0.0);
    var below = values;
    for (var order = 1u; order <= 3u; order++) {
        below = values;
        var saved = 0.0;
        for (var i = 0u; i < order; i++) {
            let left = knots[offset + low + 1u + i - order];
            let right = knots[offset + low + 1u + i];
            let part = below[i] / (right - left);
            values[i] = saved + (right - t) * part;
            saved = (t - left) * part;
        }
        values[order] = saved;
    }
    var slopes = array<f32, 4>(0.0, 0.0, 0.0, 0.0);
    for (var i = 0u; i < 3u; i++) {
        let part = 3.0 * below[i] / (knots[offset + low + 1u + i] - knots[offset + low + i - 2u]);
        slopes[i] -= part;
        slopes[i + 1u] += part;
    }
    return Basis(
        low - 3u,
        vec4f(values[0], values[1], values[2], values[3]),
        vec4f(slopes[0], slopes[1], slopes[2], slopes[3]),
    );
}

@compute @workgroup_size(64)
fn nurbs(@builtin(global_invocation_id) id: vec3u) {
    var sum = vec4f();
    for (var k = 0u; k < EVALUATIONS; k++) {
        let t = parameters(id.x, k);
        let in_u = basis(0u, size.counts.x, t.x);
        let in_v = basis(size.counts.x + 4u, size.counts.y, t.y);
        var point = vec4f();
        var u = vec4f();
        var v = vec4f();
        for (var i = 0u; i < 4u; i++) {
            let first = (in_u.first + i) * size.counts.y + in_v.first;
            var value = vec4f();
            var slope = vec4f();
            for (var j = 0u; j < 4u; j++) {
                let control = controls[first + j];
                value += in_v.values[j] * control;
                slope += in_v.slopes[j] * control;
            }
            point += in_u.values[i] * value;
            u += in_u.slopes[i] * value;
            v += in_u.values[i] * slope;
        }
        sum += folded(point, u / f32(size.patches.x), v / f32(size.patches.y));
    }
    sums[id.x] = sum;
}
