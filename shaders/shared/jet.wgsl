// A point of a surface with its first and second derivatives. CPU twin: `Jet`
// of `src/bezier/patch/evaluate.rs`.

struct Jet {
    point: vec3<f32>,
    s: vec3<f32>,
    t: vec3<f32>,
    ss: vec3<f32>,
    st: vec3<f32>,
    tt: vec3<f32>,
}
