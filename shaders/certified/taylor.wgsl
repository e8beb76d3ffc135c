// Stage `taylor_bound`: an upper bound on the distance from every cell to B by
// Taylor expansion, including the error of float32. CPU twins:
// `src/certified/bounds/taylor/mod.rs`, `src/certified/reparametrization.rs` and
// `src/certified/bounds/taylor/quadratic.rs`. One thread per cell. The host generates
// MAX_ASPECT, UNIT_ROUNDOFF, DIFFERENCE_ROUNDINGS and LENGTH_ROUNDINGS.

@group(0) @binding(0) var<uniform> params: LevelParams;
@group(0) @binding(1) var<storage, read> batch: Batch;
@group(0) @binding(2) var<storage, read_write> cells: array<CellState>;
@group(0) @binding(3) var<storage, read> jets: array<Jet>;
@group(0) @binding(4) var<storage, read> projected: array<Projected>;
@group(0) @binding(5) var<storage, read> subpatches_a: array<Subpatch>;
@group(0) @binding(6) var<storage, read> subpatches_b: array<Subpatch>;
@group(0) @binding(7) var<storage, read> coefficients: array<vec4<f32>>;

// Roundings of the quadratic's coefficients and net, relative to the sum of
// the sizes of its terms.
const QUADRATIC_ROUNDINGS: f32 = 32.0 * UNIT_ROUNDOFF;
// Roundings of a Bernstein coefficient of the squared length, at most 16: three
// of a dot product, two where `length_products` sums, three where two rows are
// combined, four where a row's are, and four of this bound itself.
const PRODUCT_ROUNDINGS: f32 = 64.0 * UNIT_ROUNDOFF;
// Coordinates are about 1: a sum of sizes of this value or more contains an
// overflow or a NaN.
const MAX_PLAUSIBLE: f32 = 1e15;
// The bits of +∞.
const INFINITY_BITS: u32 = 0x7f800000u;
// Cells of smaller half-widths are not split further in float32.
const MIN_HALF: f32 = 1e-3;
// Below this fraction of the squared length, the tangent of the square root at
// it is a tight upper bound.
const SMALL_CHANGE: f32 = 0.125;

// A linear map from the cell into B's parameters: φ(σ, τ) = β + σ p + τ q.
struct Reparametrization {
    p: vec2<f32>,
    q: vec2<f32>,
}

// The derivatives of a Taylor quadratic of A - B∘φ at the cell's centre.
struct Quadratic {
    s: vec3<f32>,
    t: vec3<f32>,
    ss: vec3<f32>,
    st: vec3<f32>,
    tt: vec3<f32>,
}

// The solution of a symmetric system for the parameters that are not frozen.
fn solve(matrix: vec3<f32>, right: vec2<f32>, frozen: vec2<bool>) -> vec2<f32> {
    if all(frozen) {
        return vec2<f32>(0.0);
    }
    if frozen.x {
        return vec2<f32>(0.0, right.y / matrix.z);
    }
    if frozen.y {
        return vec2<f32>(right.x / matrix.x, 0.0);
    }
    let determinant = matrix.x * matrix.z - matrix.y * matrix.y;
    return vec2<f32>(matrix.z * right.x - matrix.y * right.y, matrix.x * right.y - matrix.y * right.x)
        / determinant;
}

// A second derivative of B∘φ, by the chain rule.
fn second_derivative(b: Jet, p: vec2<f32>, q: vec2<f32>) -> vec3<f32> {
    return p.x * q.x * b.ss + (p.x * q.y + p.y * q.x) * b.st + p.y * q.y * b.tt;
}

// The Taylor quadratic of A - B∘φ.
fn difference(a: Jet, b: Jet, map: Reparametrization) -> Quadratic {
    return Quadratic(
        a.s - (map.p.x * b.s + map.p.y * b.t),
        a.t - (map.q.x * b.s + map.q.y * b.t),
        a.ss - second_derivative(b, map.p, map.p),
        a.st - second_derivative(b, map.p, map.q),
        a.tt - second_derivative(b, map.q, map.q),
    );
}

// A row of the quadratic's Bernstein net without its value: the controls in τ,
// as columns, for one control in σ. Its coefficient of σ is `linear`, of ½σ²
// `square`: -1, ½ or 0, -½ or 1, ½; likewise in τ.
fn net_row(change: Quadratic, linear: f32, square: f32) -> mat3x3<f32> {
    let middle = linear * change.s + square * change.ss;
    let slope = change.t + linear * change.st;
    let half_tt = 0.5 * change.tt;
    return mat3x3<f32>(middle - slope + half_tt, middle - half_tt, middle + slope + half_tt);
}

// (v + a_i)·(v + b_k) - v·v of all controls of two rows, given v·a_i and v·b_k.
fn length_products(a: mat3x3<f32>, b: mat3x3<f32>, va: vec3<f32>, vb: vec3<f32>) -> mat3x3<f32> {
    return transpose(a) * b + mat3x3<f32>(va + vb.x, va + vb.y, va + vb.z);
}

// The largest quartic Bernstein coefficient in τ of these products.
fn largest_coefficient(p: mat3x3<f32>) -> f32 {
    let inner = 0.5 * max(p[0].y + p[1].x, p[1].z + p[2].y);
    return max(max(p[0].x, p[2].z), max(inner, 0.16666667 * (p[0].z + p[2].x) + 0.6666667 * p[1].y));
}

fn largest_length_squared(row: mat3x3<f32>) -> f32 {
    return max(dot(row[0], row[0]), max(dot(row[1], row[1]), dot(row[2], row[2])));
}

// An upper bound on the length of the quadratic over the cell, whose value at
// the centre has length `size`. The value's square is subtracted from every
// product, so that rounding errors are proportional to the change only.
fn largest_length(value: vec3<f32>, size: f32, change: Quadratic) -> f32 {
    let a = net_row(change, -1.0, 0.5);
    let b = net_row(change, 0.0, -0.5);
    let c = net_row(change, 1.0, 0.5);
    let va = value * a;
    let vb = value * b;
    let vc = value * c;
    let middle = 0.33333334 * length_products(a, c, va, vc) + 0.6666667 * length_products(b, b, vb, vb);
    let first = max(
        largest_coefficient(length_products(a, a, va, va)),
        largest_coefficient(length_products(a, b, va, vb)),
    );
    let last = max(
        largest_coefficient(length_products(b, c, vb, vc)),
        largest_coefficient(length_products(c, c, vc, vc)),
    );
    let largest_change =
        sqrt(max(largest_length_squared(a), max(largest_length_squared(b), largest_length_squared(c))));
    let largest = max(max(first, 0.0), max(last, largest_coefficient(middle)))
        + PRODUCT_ROUNDINGS * largest_change * (2.0 * size + largest_change);
    // The tangent of the root is an upper bound that takes no root of a sum.
    if largest < SMALL_CHANGE * size * size {
        return size + 0.5 * largest / size * ROUNDED_UP;
    }
    return sqrt(size * size + largest);
}

// An upper bound on a second derivative along a vector of components of at most
// `extent`, for second derivatives of at most `bounds`.
fn second_order(bounds: vec3<f32>, extent: vec2<f32>) -> f32 {
    return bounds.x * extent.x * extent.x + 2.0 * bounds.y * extent.x * extent.y + bounds.z * extent.y * extent.y;
}

// Taylor's remainder of third order over a box of half-widths `extent`; derived
// in the CPU twin.
fn taylor_remainder(subpatch: Subpatch, extent: vec2<f32>) -> f32 {
    let third = extent.x * extent.x * extent.x * subpatch.third.x
        + 3.0 * extent.x * extent.x * extent.y * subpatch.third.y
        + 3.0 * extent.x * extent.y * extent.y * subpatch.third.z
        + extent.y * extent.y * extent.y * subpatch.third.w;
    return third / 6.0;
}

// An upper bound on the float32 error of a subpatch's quadratic along the same
// map: of its jet and of the sums.
fn rounding_error(subpatch: Subpatch, extent: vec2<f32>) -> f32 {
    let jet = subpatch.value_error + dot(extent, subpatch.first_error)
        + 0.5 * second_order(subpatch.second_error, extent);
    let sizes = subpatch.radius + dot(extent, subpatch.first) + 0.5 * second_order(subpatch.second, extent);
    return jet + QUADRATIC_ROUNDINGS * sizes;
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn taylor_bound(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= batch.count {
        return;
    }
    let foot = projected[id.x];
    let foot_subpatch = foot.patch_and_status & PATCH_MASK;
    // Wraps around for subpatches before the first.
    let index = foot_subpatch - params.first_subpatch;
    if index >= params.subpatch_count {
        return;
    }
    var cell = cells[id.x];
    let subpatch_a = subpatches_a[cell.subpatch];
    let subpatch_b = subpatches_b[foot_subpatch];
    let foot_parameters = clamp(vec2<f32>(foot.s, foot.t), vec2<f32>(0.0), vec2<f32>(1.0));
    let at = 2.0 * foot_parameters - 1.0;
    let a = jets[id.x];
    let b = subpatch_jet(index * SUBPATCH_SIZE, at);
    let between_centers = params.center_unit * vec3<f32>(subpatch_a.center - subpatch_b.center);
    let residual = (b.point - a.point) - between_centers;
    let distance = length(residual);
    let difference_error = DIFFERENCE_ROUNDINGS * length(between_centers) + params.center_error;
    let none = vec2<f32>(0.0);
    let cell_error = rounding_error(subpatch_a, cell.half) + taylor_remainder(subpatch_a, cell.half);
    let foot_error = rounding_error(subpatch_b, none);
    let sides = cell.half * subpatch_a.first;
    // The Lipschitz bound: the centre's distance and the cell's radius.
    var upper = distance * (1.0 + LENGTH_ROUNDINGS)
        + (sides.x + sides.y + subpatch_a.value_error + foot_error + difference_error) * ROUNDED_UP;
    // The bound if φ did not leave the extension of B's subpatch.
    var unrestricted = upper;
    let gradient = vec2<f32>(dot(residual, b.s), dot(residual, b.t));
    let frozen = ((at <= subpatch_b.low) & (gradient > none)) | ((at >= subpatch_b.high) & (gradient < none));
    let hessian = vec3<f32>(dot(b.s, b.s), dot(b.s, b.t), dot(b.t, b.t))
        + vec3<f32>(dot(residual, b.ss), dot(residual, b.st), dot(residual, b.tt));
    // The linearization of the foot, by the implicit function theorem.
    let map = Reparametrization(
        solve(hessian, vec2<f32>(dot(b.s, a.s), dot(b.t, a.s)), frozen),
        solve(hessian, vec2<f32>(dot(b.s, a.t), dot(b.t, a.t)), frozen),
    );
    let map_extent = abs(map.p) + abs(map.q);
    let quadratic = difference(a, b, map);
    let length = largest_length(-residual, distance, quadratic);
    let error = rounding_error(subpatch_b, map_extent) + taylor_remainder(subpatch_b, map_extent)
        + cell_error + difference_error;
    let bound = length * (1.0 + LENGTH_ROUNDINGS) + error * ROUNDED_UP;
    unrestricted = min(unrestricted, bound);
    let extent = map_extent * ROUNDED_UP;
    if all(at - extent >= subpatch_b.low) && all(at + extent <= subpatch_b.high) {
        upper = min(upper, bound);
    }
    let changes = abs(quadratic.s) + abs(quadratic.t) + abs(quadratic.ss) + abs(quadratic.st) + abs(quadratic.tt);
    let sizes = dot(abs(a.point) + abs(b.point) + abs(between_centers) + changes, vec3<f32>(1.0))
        + map_extent.x + map_extent.y + error;
    // Bits of a NaN or a negative number are larger than those of any plausible number.
    let is_plausible =
        bitcast<u32>(sizes) < bitcast<u32>(MAX_PLAUSIBLE) && bitcast<u32>(upper) < INFINITY_BITS;
    cell.foot_subpatch = foot_subpatch;
    cell.foot_parameters = foot_parameters;
    cell.foot_distance = (distance + foot_error + difference_error) * ROUNDED_UP;
    if is_plausible {
        cell.upper = min(cell.upper, upper);
    } else {
        cell.foot_distance = UNKNOWN_DISTANCE;
        unrestricted = MAX_PLAUSIBLE;
    }
    let is_small = max(cell.half.x, cell.half.y) < MIN_HALF;
    // No part around the centre can be pruned: float64 raises the incumbent, or
    // replaces a foot that is not the nearest.
    let is_beyond = distance > params.prune_threshold;
    if bitcast<u32>(cell.upper) <= bitcast<u32>(params.prune_threshold) {
        cell.verdict = PRUNED;
    } else if unrestricted <= params.prune_threshold || is_small || is_beyond {
        // Only the subpatch's extension is too small, float32 too coarse, or the
        // foot too far.
        cell.verdict = FLOAT64_ONLY;
    } else {
        cell.verdict = select(0u, SPLIT_S, sides.x * MAX_ASPECT >= sides.y)
            | select(0u, SPLIT_T, sides.y * MAX_ASPECT >= sides.x);
    }
    cells[id.x] = cell;
}
