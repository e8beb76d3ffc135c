// Lower bounds in float32 on the squared distance from a point to a patch:
// lemmas P2 and P3 of `docs/points.md`. CPU twins, in float64:
// `src/closest/separating_plane.rs` and `distance_polynomial.rs`. The host
// generates UNIT, the binomial coefficients of P and Q with `binomial_s` and
// `binomial_t`, and the inverses of those of 2P and 2Q with `inverse_s` and
// `inverse_t`.

const FORM_COLUMNS: u32 = 2u * Q + 1u;
const FORM_SIZE: u32 = (2u * P + 1u) * FORM_COLUMNS;

// Roundings of a height along a vector, of its square, of a coefficient besides
// two for each term of its sum, of a squared length, and of the least value of a
// form: the table in `docs/points.md`.
const HEIGHT_ROUNDINGS: f32 = 20.0;
const SQUARE_ROUNDINGS: f32 = 4.0;
const FORM_ROUNDINGS: f32 = f32(PATCH_SIZE) + 20.0;
const LENGTH_ROUNDINGS: f32 = 8.0;
const LEAST_ROUNDINGS: f32 = 32.0;
const CURVATURE_ROUNDINGS: f32 = 16.0;

// Roundings of a point and of a derivative by the basis functions, relative to
// the sizes of their terms.
const BASIS_ROUNDINGS: f32 = 4.0 * f32(P + Q) + 4.0;

// What numbers that are flushed to 0 may add to a squared distance.
const FLUSHED: f32 = 1e-28;

// No direction is taken from a shorter vector.
const LEAST_LENGTH: f32 = 1e-12;

// The controls relative to a point of the patch, times the binomial coefficients
// of their indices.
var<private> net: array<vec4<f32>, PATCH_SIZE>;
// The coefficients of the squared distance less that of the point, t fastest.
var<private> form: array<f32, FORM_SIZE>;

// Lemma P2: by the height of all controls below `local` along `towards`.
fn bound_behind(first: u32, local: vec3<f32>, towards: vec3<f32>) -> f32 {
    let size = length(towards);
    if !(size > LEAST_LENGTH) {
        return 0.0;
    }
    var highest = -UNKNOWN_DISTANCE;
    var reach = 0.0;
    for (var k = 0u; k < PATCH_SIZE; k++) {
        let control = controls[first + k];
        let at = (1.0 / control.w) * control.xyz;
        highest = max(highest, dot(at, towards));
        reach = max(reach, dot(at, at));
    }
    let rounding = HEIGHT_ROUNDINGS * UNIT * (length(local) + sqrt(reach));
    let height = max((dot(local, towards) - highest) / size - rounding, 0.0);
    return height * height * (1.0 - SQUARE_ROUNDINGS * UNIT);
}

// The least value of `slope x + curvature x² / 2` for x in [0, room], where the
// slope is 0 or less and the room at most 1.
fn least_ahead(slope: f32, curvature: f32, room: f32) -> f32 {
    if curvature > 0.0 && -slope < curvature * room {
        return -0.5 * slope * (slope / curvature);
    }
    return room * (slope + 0.5 * curvature * room);
}

// The same on both sides of a parameter, with a slope that is known up to an error.
fn least_about(slope: f32, error: f32, curvature: f32, at: f32) -> f32 {
    let forward = least_ahead(min(slope - error, 0.0), curvature, 1.0 - at);
    let backward = least_ahead(min(-slope - error, 0.0), curvature, at);
    return min(forward, backward);
}

// Fills `form` from `net`: |Z|² + 2 w Z·r, with the residual r.
fn fill_form(residual: vec3<f32>) {
    for (var a = 0u; a <= 2u * P; a++) {
        for (var b = 0u; b <= 2u * Q; b++) {
            var sum = 0.0;
            for (var i = max(a, P) - P; i <= min(a, P); i++) {
                for (var j = max(b, Q) - Q; j <= min(b, Q); j++) {
                    let one = net[i * (Q + 1u) + j];
                    let other = net[(a - i) * (Q + 1u) + (b - j)];
                    sum += dot(one.xyz + 2.0 * one.w * residual, other.xyz);
                }
            }
            form[a * FORM_COLUMNS + b] = sum * inverse_s[a] * inverse_t[b];
        }
    }
}

// The least second differences of `form` along s and t, and the largest absolute
// value of the mixed ones.
fn second_differences() -> vec3<f32> {
    var least = vec2<f32>(UNKNOWN_DISTANCE);
    var mixed = 0.0;
    for (var a = 0u; a <= 2u * P; a++) {
        for (var b = 0u; b <= 2u * Q; b++) {
            let at = a * FORM_COLUMNS + b;
            if a + 2u <= 2u * P {
                let second = form[at + 2u * FORM_COLUMNS] - 2.0 * form[at + FORM_COLUMNS] + form[at];
                least.x = min(least.x, second);
            }
            if b + 2u <= 2u * Q {
                least.y = min(least.y, form[at + 2u] - 2.0 * form[at + 1u] + form[at]);
            }
            if a < 2u * P && b < 2u * Q {
                let next = form[at + FORM_COLUMNS + 1u] - form[at + FORM_COLUMNS];
                mixed = max(mixed, abs(next - form[at + 1u] + form[at]));
            }
        }
    }
    return vec3<f32>(least, mixed);
}

// Lemma P3: by the squared distance about the point of these parameters.
fn bound_about(first: u32, local: vec3<f32>, at: vec2<f32>) -> f32 {
    let sums = blend(first, basis_s(at.x), basis_t(at.y));
    let point = sums.h.xyz / sums.h.w;
    let residual = point - local;
    let distance_squared = dot(residual, residual);
    let distance = sqrt(distance_squared);
    var largest = 0.0;
    var lightest = controls[first].w;
    var heaviest = lightest;
    for (var i = 0u; i <= P; i++) {
        for (var j = 0u; j <= Q; j++) {
            let k = i * (Q + 1u) + j;
            let control = controls[first + k];
            let offset = control.xyz - control.w * point;
            largest = max(largest, dot(offset, offset));
            lightest = min(lightest, control.w);
            heaviest = max(heaviest, control.w);
            net[k] = binomial_s[i] * binomial_t[j] * vec4<f32>(offset, control.w);
        }
    }
    fill_form(residual);
    let radius = sqrt(largest);
    let pull = heaviest * distance;
    let span = radius + heaviest * length(point);
    let size = radius * (radius + 2.0 * pull);
    let of_form = UNIT * (FORM_ROUNDINGS * size + 2.0 * span * (radius + pull));
    let differences = second_differences();
    let degrees = 2.0 * vec2<f32>(f32(P), f32(Q));
    let second = degrees * (degrees - 1.0) * (differences.xy - 4.0 * of_form);
    let mixed = degrees.x * degrees.y * (differences.z + 4.0 * of_form);
    // The mixed term is shared out to both axes.
    let positive = max(second, vec2<f32>(FLUSHED));
    let share = select(1.0, sqrt(positive.x / positive.y), all(second > vec2<f32>(0.0)));
    let shares = mixed * vec2<f32>(share, 1.0 / share);
    let curvature = second - shares - CURVATURE_ROUNDINGS * UNIT * (abs(second) + shares);
    let slope_s = 2.0 * sums.h.w * dot(sums.s.xyz - sums.s.w * point, residual);
    let slope_t = 2.0 * sums.h.w * dot(sums.t.xyz - sums.t.w * point, residual);
    let of_slope = UNIT * span
        * ((8.0 * BASIS_ROUNDINGS + 20.0) * radius + (16.0 * BASIS_ROUNDINGS + 50.0) * pull);
    let of_value = UNIT * span * (4.0 * BASIS_ROUNDINGS + 10.0) * pull;
    let least = least_about(slope_s, f32(P) * of_slope, curvature.x, at.x)
        + least_about(slope_t, f32(Q) * of_slope, curvature.y, at.y) - of_value;
    let excess = (1.0 + LEAST_ROUNDINGS * UNIT) * least / (lightest * lightest);
    let bound = distance_squared * (1.0 - LENGTH_ROUNDINGS * UNIT) + excess - FLUSHED;
    return max(bound, 0.0);
}
