// Points and derivatives of Bézier patches of degrees P and Q, as
// `src/bezier/evaluate.rs`. After `jet.wgsl`; the host writes above, for these degrees:
// P, Q, `Basis` with `basis_s` and `basis_t`, `blend`, and what loads the
// controls (`src/gpu/patch_text.rs`).

const PATCH_SIZE: u32 = (P + 1u) * (Q + 1u);

// Sums of the homogeneous controls: point and derivatives before the division.
struct Blend {
    h: vec4<f32>,
    s: vec4<f32>,
    t: vec4<f32>,
    ss: vec4<f32>,
    st: vec4<f32>,
    tt: vec4<f32>,
}

// The homogeneous controls of a patch start at `first`; the result is
// relative to the patch's centre.
fn evaluate(first: u32, at: vec2<f32>) -> vec3<f32> {
    let h = blend(first, basis_s(at.x), basis_t(at.y)).h;
    return h.xyz / h.w;
}

fn evaluate_jet(first: u32, at: vec2<f32>) -> Jet {
    let sums = blend(first, basis_s(at.x), basis_t(at.y));
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

fn distance_squared(control: vec4<f32>, local: vec3<f32>) -> f32 {
    let offset = (1.0 / control.w) * control.xyz - local;
    return dot(offset, offset);
}
