// Points and derivatives of Bézier patches of degrees P and Q, as
// `src/bezier/evaluate.rs`. After `jet.wgsl`; the host writes above, for these degrees:
// P, Q, `Basis` with `basis_s` and `basis_t`, and `contract`, the sum of a row
// of controls (`src/gpu/patch_text.rs`).

const ROWS: u32 = P + 1u;
const COLUMNS: u32 = Q + 1u;
const PATCH_SIZE: u32 = ROWS * COLUMNS;

// The homogeneous controls of a patch start at `first`; the result is
// relative to the patch's centre.
fn evaluate(first: u32, at: vec2<f32>) -> vec3<f32> {
    let in_s = basis_s(at.x);
    let in_t = basis_t(at.y);
    var sum = vec4<f32>(0.0);
    for (var i = 0u; i < ROWS; i++) {
        sum += in_s.value[i] * contract(first + i * COLUMNS, in_t.value);
    }
    return sum.xyz / sum.w;
}

fn evaluate_jet(first: u32, at: vec2<f32>) -> Jet {
    let in_s = basis_s(at.x);
    let in_t = basis_t(at.y);
    var h = vec4<f32>(0.0);
    var s = vec4<f32>(0.0);
    var t = vec4<f32>(0.0);
    var ss = vec4<f32>(0.0);
    var st = vec4<f32>(0.0);
    var tt = vec4<f32>(0.0);
    for (var i = 0u; i < ROWS; i++) {
        let value = contract(first + i * COLUMNS, in_t.value);
        let derivative = contract(first + i * COLUMNS, in_t.first);
        let second = contract(first + i * COLUMNS, in_t.second);
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

fn control_distance_squared(index: u32, local: vec3<f32>) -> f32 {
    let offset = controls[index].xyz / controls[index].w - local;
    return dot(offset, offset);
}
