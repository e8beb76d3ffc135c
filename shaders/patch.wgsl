// Points and derivatives of Bézier patches of degrees P and Q, as
// `src/bezier/evaluate.rs`. The host writes P, Q and ORDER = max(P, Q) + 1
// above this text.

const ROWS: u32 = P + 1u;
const COLUMNS: u32 = Q + 1u;
const PATCH_SIZE: u32 = ROWS * COLUMNS;

struct Basis {
    value: array<f32, ORDER>,
    first: array<f32, ORDER>,
    second: array<f32, ORDER>,
}

struct Jet {
    point: vec3<f32>,
    s: vec3<f32>,
    t: vec3<f32>,
    ss: vec3<f32>,
    st: vec3<f32>,
    tt: vec3<f32>,
}

// Bernstein polynomials of degree `degree` with two derivatives: raised one
// degree at a time, derivatives as differences of the lower degrees.
fn basis(degree: u32, t: f32) -> Basis {
    var result: Basis;
    var values: array<f32, ORDER>;
    values[0] = 1.0;
    let complement = 1.0 - t;
    for (var current = 0u; current < degree; current++) {
        if current + 1u == degree {
            result.first = values;
        }
        if current + 2u == degree {
            result.second = values;
        }
        for (var index = current + 1u; index > 0u; index--) {
            values[index] = t * values[index - 1u] + complement * values[index];
        }
        values[0] *= complement;
    }
    result.value = values;
    let scale = f32(degree);
    for (var index = degree; index > 0u; index--) {
        result.first[index] = scale * (result.first[index - 1u] - result.first[index]);
        result.second[index] = (scale - 1.0) * (result.second[index - 1u] - result.second[index]);
    }
    result.first[0] *= -scale;
    result.second[0] *= 1.0 - scale;
    for (var index = degree; index > 0u; index--) {
        result.second[index] = scale * (result.second[index - 1u] - result.second[index]);
    }
    result.second[0] *= -scale;
    return result;
}

// The homogeneous controls of a patch start at `first`; the result is
// relative to the patch's centre.
fn evaluate(first: u32, at: vec2<f32>) -> vec3<f32> {
    let in_s = basis(P, at.x);
    let in_t = basis(Q, at.y);
    var sum = vec4<f32>(0.0);
    for (var i = 0u; i < ROWS; i++) {
        var row = vec4<f32>(0.0);
        for (var j = 0u; j < COLUMNS; j++) {
            row += in_t.value[j] * controls[first + i * COLUMNS + j];
        }
        sum += in_s.value[i] * row;
    }
    return sum.xyz / sum.w;
}

fn evaluate_jet(first: u32, at: vec2<f32>) -> Jet {
    let in_s = basis(P, at.x);
    let in_t = basis(Q, at.y);
    var h = vec4<f32>(0.0);
    var s = vec4<f32>(0.0);
    var t = vec4<f32>(0.0);
    var ss = vec4<f32>(0.0);
    var st = vec4<f32>(0.0);
    var tt = vec4<f32>(0.0);
    for (var i = 0u; i < ROWS; i++) {
        var value = vec4<f32>(0.0);
        var derivative = vec4<f32>(0.0);
        var second = vec4<f32>(0.0);
        for (var j = 0u; j < COLUMNS; j++) {
            let control = controls[first + i * COLUMNS + j];
            value += in_t.value[j] * control;
            derivative += in_t.first[j] * control;
            second += in_t.second[j] * control;
        }
        h += in_s.value[i] * value;
        s += in_s.first[i] * value;
        ss += in_s.second[i] * value;
        t += in_s.value[i] * derivative;
        st += in_s.first[i] * derivative;
        tt += in_s.value[i] * second;
    }
    let inverse = 1.0 / h.w;
    var jet: Jet;
    jet.point = h.xyz * inverse;
    jet.s = (s.xyz - s.w * jet.point) * inverse;
    jet.t = (t.xyz - t.w * jet.point) * inverse;
    jet.ss = (ss.xyz - 2.0 * s.w * jet.s - ss.w * jet.point) * inverse;
    jet.st = (st.xyz - s.w * jet.t - t.w * jet.s - st.w * jet.point) * inverse;
    jet.tt = (tt.xyz - 2.0 * t.w * jet.t - tt.w * jet.point) * inverse;
    return jet;
}
