// Stage `certify`: an upper bound of the distance from every cell to B, as
// `src/certified/certify.rs`, with what float32 may have lost added. One
// thread a cell.

@group(0) @binding(0) var<uniform> params: LevelParams;
@group(0) @binding(1) var<storage, read> batch: Batch;
@group(0) @binding(2) var<storage, read_write> cells: array<Cell>;
@group(0) @binding(3) var<storage, read> jets: array<Jet>;
@group(0) @binding(4) var<storage, read> best: array<Best>;
@group(0) @binding(5) var<storage, read> from_pieces: array<Piece>;
@group(0) @binding(6) var<storage, read> to_pieces: array<Piece>;
@group(0) @binding(7) var<storage, read> coefficients: array<vec4<f32>>;

// A rounding: WGSL promises no mode.
const UNIT: f32 = 1.1920929e-7;
// Roundings of the difference of two points, each of at most their sizes.
const DIFFERENCE_ROUNDINGS: f32 = 4.0 * UNIT;
// Roundings of a length: three products, two sums, a root of up to 5 units, and those it is summed by.
const LENGTH_ROUNDINGS: f32 = 16.0 * UNIT;
// Roundings of the quadratic's coefficients and net, relative to the sum of the sizes.
const QUADRATIC_ROUNDINGS: f32 = 32.0 * UNIT;
// Roundings of a Bernstein coefficient of the squared length, of which there
// are at most 16: three of a dot product, two where `products` sums, three
// where two rows are mixed, four where a row's are, and four of this bound.
const PRODUCT_ROUNDINGS: f32 = 64.0 * UNIT;
// In these units nothing is of this size; what is, was no number.
const ABSURD: f32 = 1e15;
// Bits of infinity.
const INFINITE: u32 = 0x7f800000u;
// Half-widths of a cell that is not halved further in float32.
const MIN_HALF: f32 = 1e-3;
// How much longer one side may be before only the longer is halved.
const MAX_ASPECT: f32 = 2.0;
// A squared length changes little over a cell if by less than this part.
const LITTLE: f32 = 0.125;
// Distance, in radii of the cell, up to which A lies on B and a bent map helps.
const ON_B: f32 = 0.01;

// φ(σ, τ) = β + σ p + τ q + ½σ² m_0 + στ m_1 + ½τ² m_2.
struct FootMap {
    p: vec2<f32>,
    q: vec2<f32>,
    bend: array<vec2<f32>, 3>,
}

// The Taylor quadratic of A - B∘φ without its value.
struct Quadratic {
    s: vec3<f32>,
    t: vec3<f32>,
    ss: vec3<f32>,
    st: vec3<f32>,
    tt: vec3<f32>,
}

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

fn curvature(b: Jet, p: vec2<f32>, q: vec2<f32>, bend: vec2<f32>) -> vec3<f32> {
    return p.x * q.x * b.ss + (p.x * q.y + p.y * q.x) * b.st + p.y * q.y * b.tt + bend.x * b.s + bend.y * b.t;
}

fn difference(a: Jet, b: Jet, map: FootMap) -> Quadratic {
    return Quadratic(
        a.s - (map.p.x * b.s + map.p.y * b.t),
        a.t - (map.q.x * b.s + map.q.y * b.t),
        a.ss - curvature(b, map.p, map.p, map.bend[0]),
        a.st - curvature(b, map.p, map.q, map.bend[1]),
        a.tt - curvature(b, map.q, map.q, map.bend[2]),
    );
}

// The quadratic's controls in τ, as columns, at one of its controls in σ,
// where σ is `place` and ½σ² is `square`; in τ as in σ -1, 0, 1 and ½, -½, ½.
fn row(change: Quadratic, place: f32, square: f32) -> mat3x3<f32> {
    let middle = place * change.s + square * change.ss;
    let slope = change.t + place * change.st;
    let bend = 0.5 * change.tt;
    return mat3x3<f32>(middle - slope + bend, middle - bend, middle + slope + bend);
}

// (v + a_i)·(v + b_k) - v·v of all controls of two rows.
fn products(a: mat3x3<f32>, b: mat3x3<f32>, va: vec3<f32>, vb: vec3<f32>) -> mat3x3<f32> {
    return transpose(a) * b + mat3x3<f32>(va + vb.x, va + vb.y, va + vb.z);
}

// The largest quartic Bernstein coefficient of such a product.
fn largest_in_row(p: mat3x3<f32>) -> f32 {
    let inner = 0.5 * max(p[0].y + p[1].x, p[1].z + p[2].y);
    return max(max(p[0].x, p[2].z), max(inner, 0.16666667 * (p[0].z + p[2].x) + 0.6666667 * p[1].y));
}

fn longest(a: mat3x3<f32>) -> f32 {
    return max(dot(a[0], a[0]), max(dot(a[1], a[1]), dot(a[2], a[2])));
}

// At least the largest length of the quadratic, whose value is `value`. With
// the value's square taken out of every product, rounding counts by the change only.
fn largest_length(value: vec3<f32>, size: f32, change: Quadratic) -> f32 {
    let a = row(change, -1.0, 0.5);
    let b = row(change, 0.0, -0.5);
    let c = row(change, 1.0, 0.5);
    let va = value * a;
    let vb = value * b;
    let vc = value * c;
    let middle = 0.33333334 * products(a, c, va, vc) + 0.6666667 * products(b, b, vb, vb);
    let first = max(largest_in_row(products(a, a, va, va)), largest_in_row(products(a, b, va, vb)));
    let last = max(largest_in_row(products(b, c, vb, vc)), largest_in_row(products(c, c, vc, vc)));
    let largest_change = sqrt(max(longest(a), max(longest(b), longest(c))));
    let largest = max(max(first, 0.0), max(last, largest_in_row(middle)))
        + PRODUCT_ROUNDINGS * largest_change * (2.0 * size + largest_change);
    // The root's tangent where that loses little: it needs no root of a sum.
    if largest < LITTLE * size * size {
        return size + 0.5 * largest / size * ROOM;
    }
    return sqrt(size * size + largest);
}

// What second derivatives of at most `bounds` add up to along `width`.
fn second_order(bounds: vec3<f32>, width: vec2<f32>) -> f32 {
    return bounds.x * width.x * width.x + 2.0 * bounds.y * width.x * width.y + bounds.z * width.y * width.y;
}

// Taylor's remainder of third order along β + ℓ + ½m.
fn remainder(piece: Piece, width: vec2<f32>, turn: vec2<f32>) -> f32 {
    let w = width + turn;
    let third = w.x * w.x * w.x * piece.third.x + 3.0 * w.x * w.x * w.y * piece.third.y
        + 3.0 * w.x * w.y * w.y * piece.third.z + w.y * w.y * w.y * piece.third.w;
    let turning = w.x * turn.x * piece.second.x + (w.x * turn.y + w.y * turn.x) * piece.second.y
        + w.y * turn.y * piece.second.z;
    return third / 6.0 + 0.5 * turning;
}

// Error of a piece's quadratic along β + ℓ + ½m, of the jets and of the sums.
fn rounding(piece: Piece, width: vec2<f32>, turn: vec2<f32>) -> f32 {
    let w = width + 0.5 * turn;
    let jets = piece.value_error + dot(w, piece.first_error) + 0.5 * second_order(piece.second_error, width);
    let sizes = piece.radius + dot(w, piece.first) + 0.5 * second_order(piece.second, width);
    return jets + QUADRATIC_ROUNDINGS * sizes;
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn certify(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= batch.count {
        return;
    }
    let found = best[id.x];
    let foot = found.patch_and_status & PATCH_MASK;
    // Wraps around for pieces of degrees before these.
    let place = foot - params.first_piece;
    if place >= params.piece_count {
        return;
    }
    var own = cells[id.x];
    let source = from_pieces[own.piece];
    let target_piece = to_pieces[foot];
    let foot_at = clamp(vec2<f32>(found.s, found.t), vec2<f32>(0.0), vec2<f32>(1.0));
    let at = 2.0 * foot_at - 1.0;
    let a = jets[id.x];
    let b = piece_jet(place * PIECE_SIZE, at);
    let apart = params.grid * vec3<f32>(source.center - target_piece.center);
    let residual = (b.point - a.point) - apart;
    let distance = length(residual);
    let of_difference = DIFFERENCE_ROUNDINGS * length(apart) + params.slack;
    let of_cell = rounding(source, own.half, vec2<f32>(0.0)) + remainder(source, own.half, vec2<f32>(0.0));
    let at_foot = rounding(target_piece, vec2<f32>(0.0), vec2<f32>(0.0));
    let sides = own.half * source.first;
    // All of the cell on the centre's foot, by its largest tangents alone.
    var upper = distance * (1.0 + LENGTH_ROUNDINGS)
        + (sides.x + sides.y + source.value_error + at_foot + of_difference) * ROOM;
    var anywhere = upper;
    let gradient = vec2<f32>(dot(residual, b.s), dot(residual, b.t));
    let frozen = ((at <= target_piece.low) & (gradient > vec2<f32>(0.0))) | ((at >= target_piece.high) & (gradient < vec2<f32>(0.0)));
    let metric = vec3<f32>(dot(b.s, b.s), dot(b.s, b.t), dot(b.t, b.t));
    let hessian = metric + vec3<f32>(dot(residual, b.ss), dot(residual, b.st), dot(residual, b.tt));
    var map = FootMap(
        solve(hessian, vec2<f32>(dot(b.s, a.s), dot(b.t, a.s)), frozen),
        solve(hessian, vec2<f32>(dot(b.s, a.t), dot(b.t, a.t)), frozen),
        array<vec2<f32>, 3>(vec2<f32>(0.0), vec2<f32>(0.0), vec2<f32>(0.0)),
    );
    var sizes = dot(abs(a.point) + abs(b.point) + abs(apart), vec3<f32>(1.0));
    for (var bent = 0u; bent < 2u; bent++) {
        let rest = difference(a, b, map);
        if bent == 1u {
            map.bend[0] = solve(metric, vec2<f32>(dot(b.s, rest.ss), dot(b.t, rest.ss)), frozen);
            map.bend[1] = solve(metric, vec2<f32>(dot(b.s, rest.st), dot(b.t, rest.st)), frozen);
            map.bend[2] = solve(metric, vec2<f32>(dot(b.s, rest.tt), dot(b.t, rest.tt)), frozen);
        }
        let width = abs(map.p) + abs(map.q);
        let turn = abs(map.bend[0]) + 2.0 * abs(map.bend[1]) + abs(map.bend[2]);
        let quadratic = difference(a, b, map);
        let length = largest_length(-residual, distance, quadratic);
        let lost = rounding(target_piece, width, turn) + remainder(target_piece, width, turn) + of_cell + of_difference;
        let bound = length * (1.0 + LENGTH_ROUNDINGS) + lost * ROOM;
        let changes = abs(quadratic.s) + abs(quadratic.t) + abs(quadratic.ss) + abs(quadratic.st) + abs(quadratic.tt);
        sizes += dot(changes, vec3<f32>(1.0)) + width.x + width.y + turn.x + turn.y + lost;
        anywhere = min(anywhere, bound);
        let extent = (width + 0.5 * turn) * ROOM;
        if all(at - extent >= target_piece.low) && all(at + extent <= target_piece.high) {
            upper = min(upper, bound);
        }
        if bitcast<u32>(upper) <= bitcast<u32>(params.prune_threshold) || distance > ON_B * (sides.x + sides.y) {
            break;
        }
    }
    // Compared by bits, what is no number or negative is larger than any number.
    let sane = bitcast<u32>(sizes) < bitcast<u32>(ABSURD) && bitcast<u32>(upper) < INFINITE;
    own.foot = foot;
    own.foot_at = foot_at;
    own.reach = (distance + at_foot + of_difference) * ROOM;
    let small = max(own.half.x, own.half.y) < MIN_HALF;
    if sane {
        own.upper = min(own.upper, upper);
    } else {
        own.reach = FARTHEST;
        anywhere = ABSURD;
    }
    if bitcast<u32>(own.upper) <= bitcast<u32>(params.prune_threshold) {
        own.verdict = DROPPED;
    } else if anywhere <= params.prune_threshold || small {
        // Only a seam of B is in the way, or float32 is at its end.
        own.verdict = UNDECIDED;
    } else {
        own.verdict = select(0u, SPLIT_S, sides.x * MAX_ASPECT >= sides.y)
            | select(0u, SPLIT_T, sides.y * MAX_ASPECT >= sides.x);
    }
    cells[id.x] = own;
}
