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
// Roundings of a Bernstein coefficient of the squared length.
const PRODUCT_ROUNDINGS: f32 = 64.0 * UNIT;
// In these units nothing is of this size; what is, was no number.
const ABSURD: f32 = 1e15;
// Bits of infinity.
const INFINITE: u32 = 0x7f800000u;
// Half-widths of a cell that is not halved further in float32.
const SMALLEST_HALF: f32 = 1e-3;
// How much longer one side may be before only the longer is halved.
const LONGEST_ASPECT: f32 = 2.0;
// A squared length changes little over a cell if by less than this part.
const LITTLE: f32 = 0.125;

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

// Quadratic Bernstein coefficients of σ on [-1, 1], and of σ².
const LINEAR = array<f32, 3>(-1.0, 0.0, 1.0);
const SQUARE = array<f32, 3>(1.0, -1.0, 1.0);
// C(2,i) C(2,k) / C(4,i+k).
const PRODUCT = array<f32, 9>(1.0, 0.5, 0.1666667, 0.5, 0.6666667, 0.5, 0.1666667, 0.5, 1.0);

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

// At least the largest length of the quadratic, whose value is `value`. With
// the value taken out of every product, rounding counts by the change only.
fn largest_length(value: vec3<f32>, size: f32, change: Quadratic) -> f32 {
    var net: array<vec3<f32>, 9>;
    var largest_change = 0.0;
    for (var i = 0u; i < 3u; i++) {
        for (var j = 0u; j < 3u; j++) {
            let control = LINEAR[i] * change.s + LINEAR[j] * change.t + 0.5 * SQUARE[i] * change.ss
                + LINEAR[i] * LINEAR[j] * change.st + 0.5 * SQUARE[j] * change.tt;
            net[3u * i + j] = control;
            largest_change = max(largest_change, length(control));
        }
    }
    var largest = 0.0;
    for (var row = 0u; row < 5u; row++) {
        for (var column = 0u; column < 5u; column++) {
            var coefficient = 0.0;
            for (var i = max(row, 2u) - 2u; i <= min(row, 2u); i++) {
                for (var j = max(column, 2u) - 2u; j <= min(column, 2u); j++) {
                    let k = row - i;
                    let l = column - j;
                    let one = net[3u * i + j];
                    let two = net[3u * k + l];
                    let product = dot(value, one + two) + dot(one, two);
                    coefficient += PRODUCT[3u * i + k] * PRODUCT[3u * j + l] * product;
                }
            }
            largest = max(largest, coefficient);
        }
    }
    largest += PRODUCT_ROUNDINGS * largest_change * (2.0 * size + largest_change);
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
        if bitcast<u32>(upper) <= bitcast<u32>(params.enough) {
            break;
        }
    }
    // Compared by bits, what is no number or negative is larger than any number.
    let sane = bitcast<u32>(sizes) < bitcast<u32>(ABSURD) && bitcast<u32>(upper) < INFINITE;
    own.foot = foot;
    own.foot_at = foot_at;
    own.reach = (distance + at_foot + of_difference) * ROOM;
    let small = max(own.half.x, own.half.y) < SMALLEST_HALF;
    if sane {
        own.upper = min(own.upper, upper);
    } else {
        own.reach = FARTHEST;
        anywhere = ABSURD;
    }
    if bitcast<u32>(own.upper) <= bitcast<u32>(params.enough) {
        own.verdict = DROPPED;
    } else if anywhere <= params.enough || small {
        // Only a seam of B is in the way, or float32 is at its end.
        own.verdict = UNDECIDED;
    } else {
        own.verdict = select(0u, SPLIT_S, sides.x * LONGEST_ASPECT >= sides.y)
            | select(0u, SPLIT_T, sides.y * LONGEST_ASPECT >= sides.x);
    }
    cells[id.x] = own;
}
