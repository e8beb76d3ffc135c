// Points and derivatives of Bézier patches of degrees P and Q. CPU twin:
// `src/bezier/patch/evaluate.rs`. `src/gpu/kernel/patch_wgsl.rs` generates, for these
// degrees, P, Q, `Basis` with `basis_s` and `basis_t`, `blend` and
// `nearest_control`.

const PATCH_SIZE: u32 = (P + 1u) * (Q + 1u);

// Sums of the homogeneous controls: the numerators and weights of a point and
// its derivatives.
struct Blend {
    h: vec4<f32>,
    s: vec4<f32>,
    t: vec4<f32>,
    ss: vec4<f32>,
    st: vec4<f32>,
    tt: vec4<f32>,
}

// The point relative to the patch's centre. `first` is the index of the
// patch's first control.
fn evaluate(first: u32, parameters: vec2<f32>) -> vec3<f32> {
    let h = blend(first, basis_s(parameters.x), basis_t(parameters.y)).h;
    return h.xyz / h.w;
}

// The point relative to the patch's centre, and its derivatives.
fn evaluate_jet(first: u32, parameters: vec2<f32>) -> Jet {
    let sums = blend(first, basis_s(parameters.x), basis_t(parameters.y));
    let h = sums.h;
    let s = sums.s;
    let t = sums.t;
    let ss = sums.ss;
    let st = sums.st;
    let tt = sums.tt;
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

// The squared distance from `local` to the control's point.
fn distance_squared(control: vec4<f32>, local: vec3<f32>) -> f32 {
    let offset = (1.0 / control.w) * control.xyz - local;
    return dot(offset, offset);
}
