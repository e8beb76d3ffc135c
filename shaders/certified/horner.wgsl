// Points and derivatives of subpatches in the power form in (σ, τ), by Horner's
// rule. CPU twin: `Patch::jet` of `src/bezier/patch/evaluate.rs`. The host generates
// the degrees P and Q.

const ROWS: u32 = P + 1u;
const COLUMNS: u32 = Q + 1u;
const SUBPATCH_SIZE: u32 = ROWS * COLUMNS;

// The jet relative to the subpatch's centre, whose homogeneous coefficients
// start at `first`: Horner's rule in τ along each row, then in σ.
// `src/gpu/certified/float32_error.rs` bounds its error.
fn subpatch_jet(first: u32, at: vec2<f32>) -> Jet {
    var h = vec4<f32>(0.0);
    var s = vec4<f32>(0.0);
    var t = vec4<f32>(0.0);
    var half_ss = vec4<f32>(0.0);
    var st = vec4<f32>(0.0);
    var half_tt = vec4<f32>(0.0);
    for (var row = ROWS; row > 0u; row--) {
        var value = vec4<f32>(0.0);
        var derivative = vec4<f32>(0.0);
        var half_second = vec4<f32>(0.0);
        for (var column = COLUMNS; column > 0u; column--) {
            half_second = half_second * at.y + derivative;
            derivative = derivative * at.y + value;
            value = value * at.y + coefficients[first + (row - 1u) * COLUMNS + column - 1u];
        }
        half_ss = half_ss * at.x + s;
        s = s * at.x + h;
        h = h * at.x + value;
        st = st * at.x + t;
        t = t * at.x + derivative;
        half_tt = half_tt * at.x + half_second;
    }
    let inverse = 1.0 / h.w;
    var jet: Jet;
    jet.point = h.xyz * inverse;
    jet.s = (s.xyz - s.w * jet.point) * inverse;
    jet.t = (t.xyz - t.w * jet.point) * inverse;
    jet.ss = (2.0 * half_ss.xyz - 2.0 * s.w * jet.s - 2.0 * half_ss.w * jet.point) * inverse;
    jet.st = (st.xyz - s.w * jet.t - t.w * jet.s - st.w * jet.point) * inverse;
    jet.tt = (2.0 * half_tt.xyz - 2.0 * t.w * jet.t - 2.0 * half_tt.w * jet.point) * inverse;
    return jet;
}
