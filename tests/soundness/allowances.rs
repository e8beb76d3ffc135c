//! The allowances for rounding of docs/rounding.md, section 6, against exact rational
//! arithmetic: an error never exceeds its allowance, and inputs found by a search
//! bring it to a tenth of it or more.

use fastrand::Rng;
use glam::{DVec3, DVec4};
use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive, Zero};
use nurbs_hausdorff::internals::bezier::{Patch, extract};
use nurbs_hausdorff::internals::closest::{CriticalPoint, SquaredDistance};
use nurbs_hausdorff::{Model, ParamBox, SurfaceArrays};

/// 1.01 · 2^-53: the factor of the number of roundings in every allowance.
const UNIT: f64 = 1.01 * 0.5 * f64::EPSILON;

/// The part of an allowance that the inputs found bring the error to.
const ATTAINED: f64 = 0.1;

/// Random inputs for every allowance.
const INPUTS: usize = 150;

/// A homogeneous coordinate and its weight, exactly.
type Exact = [BigRational; 2];

fn exact(number: f64) -> BigRational {
    BigRational::from_float(number).unwrap()
}

fn one() -> BigRational {
    exact(1.0)
}

/// A patch whose points lie on the x-axis, with these homogeneous controls (x, w).
fn on_axis(degree: [usize; 2], controls: &[[f64; 2]]) -> Vec<DVec4> {
    assert_eq!(controls.len(), (degree[0] + 1) * (degree[1] + 1));
    controls.iter().map(|&[x, w]| DVec4::new(x, 0.0, 0.0, w)).collect()
}

fn patch(degree: [usize; 2], controls: &[DVec4]) -> Patch<'_> {
    Patch { surface: 0, degree, domain: ParamBox::UNIT, center: DVec3::ZERO, controls, rational: true }
}

/// The point of exact controls at exact parameters, by de Casteljau's algorithm.
fn point([p, q]: [usize; 2], controls: &[Exact], [s, t]: &[BigRational; 2]) -> BigRational {
    let rows: Vec<Exact> = (0..=p).map(|i| casteljau(&controls[i * (q + 1)..][..=q], t)).collect();
    let [x, w] = casteljau(&rows, s);
    x / w
}

fn casteljau(controls: &[Exact], t: &BigRational) -> Exact {
    let mut line = controls.to_vec();
    for level in 1..line.len() {
        for index in 0..line.len() - level {
            line[index] = [0, 1].map(|k| (one() - t) * &line[index][k] + t * &line[index + 1][k]);
        }
    }
    line.swap_remove(0)
}

fn exact_controls(controls: &[DVec4]) -> Vec<Exact> {
    controls.iter().map(|control| [exact(control.x), exact(control.w)]).collect()
}

/// The largest distance of a control point from the origin.
fn radius(controls: &[DVec4]) -> BigRational {
    controls.iter().map(|control| (exact(control.x) / exact(control.w)).abs()).max().unwrap()
}

/// The part of the allowance that an error takes; +∞ for an error where none is allowed.
fn part(error: &BigRational, allowance: &BigRational) -> f64 {
    if error.is_zero() { 0.0 } else { (error.abs() / allowance).to_f64().unwrap_or(f64::INFINITY) }
}

/// Asserts that no part of an allowance exceeds 1, and that the largest attains it.
fn assert_met(parts: impl Iterator<Item = f64>, name: &str) {
    let largest = parts.fold(0.0, f64::max);
    assert!(largest <= 1.0, "{name}: {largest} of the allowance");
    assert!(largest >= ATTAINED, "{name}: only {largest} of the allowance");
}

/// Random controls of weights up to 2^-`spread` apart.
fn random_controls(random: &mut Rng, degree: [usize; 2], spread: f64) -> Vec<DVec4> {
    let mut control = |_| {
        let weight = (-spread * random.f64()).exp2();
        DVec4::new(weight * (2.0 * random.f64() - 1.0), 0.0, 0.0, weight)
    };
    (0..(degree[0] + 1) * (degree[1] + 1)).map(&mut control).collect()
}

const BILINEAR: [usize; 2] = [1, 1];

const DEGREES: [[usize; 2]; 5] = [BILINEAR, [2, 1], [3, 3], [2, 5], [9, 4]];

/// Random controls with the degrees of each entry of [`DEGREES`] in turn.
fn random_patches(seed: u64) -> impl Iterator<Item = ([usize; 2], Vec<DVec4>, Rng)> {
    (0..INPUTS as u64).map(move |index| {
        let mut random = Rng::with_seed(seed + index);
        let degree = DEGREES[index as usize % DEGREES.len()];
        let spread = 30.0 * random.f64();
        let controls = random_controls(&mut random, degree, spread);
        (degree, controls, random)
    })
}

fn degrees([p, q]: [usize; 2]) -> f64 {
    (p + q) as f64
}

/// Lemma R5, (8 (p + q) + 8) u ρ.
#[test]
fn evaluation() {
    let error = |degree: [usize; 2], controls: &[DVec4], at: [f64; 2]| {
        let computed = exact(patch(degree, controls).point(at).x);
        let error = computed - point(degree, &exact_controls(controls), &at.map(exact));
        part(&error, &(exact(UNIT * (8.0 * degrees(degree) + 8.0)) * radius(controls)))
    };
    let worst = error(BILINEAR, &on_axis(BILINEAR, &EVALUATED), EVALUATED_AT);
    let others = random_patches(1)
        .map(|(degree, controls, mut random)| error(degree, &controls, [random.f64(), random.f64()]));
    assert_met(others.chain([worst]), "evaluation");
}

/// Found by a search.
const EVALUATED: [[f64; 2]; 4] = [
    [0.287_485_235_637_467_03, 0.368_731_533_278_106_2],
    [-0.114_323_646_182_367_69, 0.126_672_223_903_564_28],
    [0.951_894_272_324_314, 0.985_512_417_509_756_8],
    [0.138_118_063_963_987_9, 0.141_959_318_327_837_57],
];
const EVALUATED_AT: [f64; 2] = [0.916_089_678_953_927_9, 0.491_506_479_386_823_3];

/// Lemma R6, 16 (p + q) u ρ inside [0, 1]: the piece is that of exactly the interval.
#[test]
fn restriction() {
    let error = |degree: [usize; 2], controls: &[DVec4], s: [f64; 2], t: [f64; 2]| {
        let piece = exact_controls(&patch(degree, controls).restricted(s, t));
        let whole = exact_controls(controls);
        let allowance = exact(UNIT * 16.0 * degrees(degree)) * radius(controls);
        let fractions = [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, 1.0], [0.5, 0.25]];
        let errors = fractions.map(|fractions| {
            let inside = |[start, end]: [f64; 2], fraction: f64| {
                exact(start) + exact(fraction) * (exact(end) - exact(start))
            };
            let on_whole = [inside(s, fractions[0]), inside(t, fractions[1])];
            let error = point(degree, &piece, &fractions.map(exact)) - point(degree, &whole, &on_whole);
            part(&error, &allowance)
        });
        errors.into_iter().fold(0.0, f64::max)
    };
    let found = on_axis(
        BILINEAR,
        &[
            [-0.289_361_696_507_536_5, 0.326_124_904_492_729_1],
            [-0.176_835_810_680_974_34, 0.383_253_592_824_273_96],
            [0.409_846_612_593_832_5, 0.484_277_706_577_387_83],
            [-0.130_592_472_159_068_52, 0.175_031_536_299_245_2],
        ],
    );
    let [s, t] = [
        [0.003_818_947_311_996_716_7, 0.005_692_113_848_820_346],
        [1.334_008_450_466_736_3e-10, 0.999_999_999_955_183_1],
    ];
    let worst = error(BILINEAR, &found, s, t);
    let others = random_patches(1001).map(|(degree, controls, mut random)| {
        let mut interval = || {
            let (a, b) = (random.f64(), random.f64());
            // Half of the pieces are next to an edge, where a rounded complement leaves gaps.
            if random.bool() { [1.0 - a * 1e-6, 1.0] } else { [a.min(b), a.max(b)] }
        };
        let (s, t) = (interval(), interval());
        error(degree, &controls, s, t)
    });
    assert_met(others.chain([worst]), "restriction");
}

/// Lemma R10, (2 T + 21) u max |Y|² of the least quotient of coefficients, with T =
/// (⌊p/2⌋ + 1) (q + 1). The lower bound is at most the exact least quotient, and at
/// least that less twice the allowance.
#[test]
fn squared_distance() {
    let error = |degree: [usize; 2], controls: &[DVec4]| {
        let lower = exact(SquaredDistance::new(degree, controls, DVec3::ZERO).lower_bound());
        let quotients = exact_square(degree, controls);
        let least = quotients.iter().map(|[n, d]| n / d).min().unwrap();
        let lightest = quotients.iter().map(|[_, d]| d).min().unwrap();
        let products = (degree[0] / 2 + 1) * (degree[1] + 1);
        let longest = controls.iter().map(|control| dot(control, control)).max().unwrap();
        let allowance = exact(UNIT * (2 * products + 21) as f64) * longest / lightest;
        // The bound is the computed quotient less at most the allowance.
        assert!(lower <= least.clone().max(exact(0.0)), "a false lower bound");
        ((&lower - &least) / allowance).to_f64().unwrap()
    };
    let worst = error(BILINEAR, &SQUARE.map(DVec4::from_array)) + 1.0;
    assert!((ATTAINED..=1.0).contains(&worst), "{worst} of the allowance");
    for (degree, controls, _) in random_patches(2001) {
        // Away from the origin, where the quotients are positive.
        let away: Vec<DVec4> = controls.iter().map(|control| control + 3.0 * control.w * DVec4::X).collect();
        assert!(error(degree, &away) >= -2.0 - f64::EPSILON);
    }
}

/// Found by a search.
const SQUARE: [[f64; 4]; 4] = [
    [0.7393033815278099, 0.45564815180146784, 0.5069530930653265, 1.0043377017971875],
    [0.7177500337266678, 0.48138655454504775, 0.5168214098889736, 1.0050236103629946],
    [0.7124276071282922, 0.43544339623689915, 0.5636796335038992, 1.0040219396523447],
    [0.7333001170684975, 0.464272911407264, 0.50962445930605, 1.0049352178382087],
];

fn dot(a: &DVec4, b: &DVec4) -> BigRational {
    (0..3).map(|axis| exact(a[axis]) * exact(b[axis])).fold(exact(0.0), |sum, term| sum + term)
}

/// The Bernstein coefficients of the squares of numerator and denominator.
fn exact_square([p, q]: [usize; 2], controls: &[DVec4]) -> Vec<Exact> {
    let binomial = |n: usize, k: usize| {
        (0..k).fold(one(), |product, i| product * exact((n - i) as f64) / exact((i + 1) as f64))
    };
    let mut sums = vec![[exact(0.0), exact(0.0)]; (2 * p + 1) * (2 * q + 1)];
    for (a, left) in controls.iter().enumerate() {
        for (b, right) in controls.iter().enumerate() {
            let ([i, j], [k, l]) = ([a / (q + 1), a % (q + 1)], [b / (q + 1), b % (q + 1)]);
            let factor = binomial(p, i) * binomial(q, j) * binomial(p, k) * binomial(q, l)
                / (binomial(2 * p, i + k) * binomial(2 * q, j + l));
            let sum = &mut sums[(i + k) * (2 * q + 1) + j + l];
            sum[0] += &factor * dot(left, right);
            sum[1] += &factor * exact(left.w) * exact(right.w);
        }
    }
    sums
}

/// Section 6.6, about a critical point: the computed squared distance and its gradient
/// are within their errors of the exact ones; that of the distance is attained
/// to a tenth. The bound at the point itself is at most the exact squared distance.
#[test]
fn critical_point() {
    let error = |degree: [usize; 2], controls: &[DVec4], at: [f64; 2]| {
        let known = CriticalPoint::new(&patch(degree, controls), DVec3::ZERO, at);
        let bound = SquaredDistance::new(degree, controls, DVec3::ZERO).lower_bound_about(&known);
        let (net, exact_at) = (exact_controls(controls), at.map(exact));
        let point = point(degree, &net, &exact_at);
        let squared = &point * &point;
        assert!(exact(bound) <= squared, "{degree:?}: {bound} at {at:?}");
        for (axis, derivative) in derivatives(degree, &net, &exact_at).iter().enumerate() {
            let gradient = exact(2.0) * &point * derivative;
            let part = part(&(exact(known.gradient[axis]) - gradient), &exact(known.gradient_error[axis]));
            assert!(part <= 1.0, "{degree:?}: {part} of the gradient's error");
        }
        let excess = exact(known.distance_squared) - &squared;
        (part(&excess, &exact(known.distance_error)), excess.is_positive())
    };
    let (worst, _) = error(BILINEAR, &on_axis(BILINEAR, &EVALUATED), EVALUATED_AT);
    let others: Vec<_> = random_patches(3001)
        .map(|(degree, mut controls, mut random)| {
            // Of any size: an error is proportional to the size, or to its square.
            let scale = 2.0_f64.powi(random.i32(-10..=10));
            for control in &mut controls {
                control.x *= scale;
            }
            error(degree, &controls, [random.f64(), random.f64()])
        })
        .collect();
    // The computed squared distance itself would be no lower bound.
    let exceeded = others.iter().filter(|(_, exceeds)| *exceeds).count();
    assert!(exceeded > INPUTS / 4, "{exceeded}");
    assert_met(others.into_iter().map(|(part, _)| part).chain([worst]), "critical point");
}

/// The derivatives of the exact point by s and t.
fn derivatives([p, q]: [usize; 2], controls: &[Exact], [s, t]: &[BigRational; 2]) -> [BigRational; 2] {
    let along = |line: &[Exact], t: &BigRational| {
        let differences: Vec<Exact> =
            line.windows(2).map(|pair| [0, 1].map(|k| &pair[1][k] - &pair[0][k])).collect();
        let scale = exact((line.len() - 1) as f64);
        let [x, w] = casteljau(line, t);
        let [dx, dw] = casteljau(&differences, t).map(|difference| &scale * difference);
        (dx * &w - &x * dw) / (&w * &w)
    };
    let rows: Vec<Exact> = (0..=p).map(|i| casteljau(&controls[i * (q + 1)..][..=q], t)).collect();
    let columns: Vec<Exact> = (0..=q)
        .map(|j| {
            let column: Vec<Exact> = (0..=p).map(|i| controls[i * (q + 1) + j].clone()).collect();
            casteljau(&column, s)
        })
        .collect();
    [along(&rows, s), along(&columns, t)]
}

/// Lemma R9, E_n = u m_n + 2 E_(n-1) of the differences of order n, where m_n is the
/// largest as computed: a bound without it can be below the exact largest derivative.
#[test]
fn differences() {
    const DEGREE: usize = 4;
    let mut parts = [const { Vec::new() }; 3];
    let mut random = Rng::with_seed(5);
    for _ in 0..INPUTS {
        // Nearly linear, so that the higher differences are of the size of rounding.
        let slope = 2.0 * random.f64() - 1.0;
        let line: Vec<f64> =
            (0..=DEGREE).map(|k| slope * k as f64 + 1e-15 * random.f64() + random.f64() / 1e12).collect();
        let points: Vec<[f64; 2]> = line.iter().flat_map(|&x| [[x, 1.0], [x, 1.0]]).collect();
        let controls = on_axis([DEGREE, 1], &points);
        let bounds = patch([DEGREE, 1], &controls).derivative_bounds();
        let (mut computed, mut exactly) = (line.clone(), line.iter().map(|&x| exact(x)).collect::<Vec<_>>());
        let (mut allowance, mut factor) = (0.0, 1.0);
        for (order, bound) in [bounds.first[0], bounds.second[0], bounds.third[0]].into_iter().enumerate() {
            computed = computed.windows(2).map(|pair| pair[1] - pair[0]).collect();
            exactly = exactly.windows(2).map(|pair| &pair[1] - &pair[0]).collect();
            factor *= (DEGREE - order) as f64;
            let largest = computed.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
            let truth = exactly.iter().map(Signed::abs).max().unwrap();
            allowance = UNIT * largest + 2.0 * allowance;
            assert!(exact(bound) >= exact(factor) * &truth, "order {}: {bound}", order + 1);
            // It is the computed difference with the allowance, and no more.
            let upper = factor * (largest + allowance) * (1.0 + 1e-11);
            assert!(bound <= upper, "order {}: {bound} > {upper}", order + 1);
            for (computed, exactly) in computed.iter().zip(&exactly) {
                parts[order].push(part(&(exact(*computed) - exactly), &exact(allowance)));
            }
        }
    }
    for (order, parts) in parts.into_iter().enumerate() {
        assert_met(parts.into_iter(), &format!("differences of order {}", order + 1));
    }
}

/// A curve with these knots and control points (x, w), swept along y by 1.
fn swept(degree: usize, knots: &[f64], points: &[[f64; 2]]) -> Model {
    let control_points = points.iter().flat_map(|&[x, w]| [[x, 0.0, 0.0, w], [x, 0.0, 0.0, w]]).collect();
    let arrays = SurfaceArrays {
        degree: [degree, 1],
        knots: [knots.to_vec(), vec![0.0, 0.0, 1.0, 1.0]],
        counts: [points.len(), 2],
        control_points,
    };
    Model::from_arrays(None, vec![arrays]).unwrap()
}

/// The exact homogeneous blossom of a span, relative to a centre, at these arguments.
fn blossom(knots: &[f64], degree: usize, span: usize, net: &[Exact], arguments: &[BigRational]) -> Exact {
    let mut line = net[span - degree..=span].to_vec();
    for level in 1..=degree {
        for index in 0..=degree - level {
            let [low, high] = [knots[span - degree + level + index], knots[span + 1 + index]].map(exact);
            let fraction = (&arguments[level - 1] - &low) / (high - low);
            line[index] =
                [0, 1].map(|k| (one() - &fraction) * &line[index][k] + &fraction * &line[index + 1][k]);
        }
    }
    line.swap_remove(0)
}

/// Lemma R3, (12 (p + q) + 8) u ρ' with ρ' of the control points of the span.
#[test]
fn extraction() {
    let error = |degree: usize, knots: &[f64], points: &[[f64; 2]]| {
        let model = extract(&swept(degree, knots, points));
        let mut largest = 0.0_f64;
        for patch in model.patches.iter() {
            let center = exact(patch.center.x);
            let net: Vec<Exact> =
                points.iter().map(|&[x, w]| [exact(w) * (exact(x) - &center), exact(w)]).collect();
            let [start, end] = patch.domain[0];
            let span = knots.iter().rposition(|&knot| knot == start).unwrap();
            let radius = points[span - degree..=span].iter().map(|&[x, _]| (exact(x) - &center).abs()).max();
            let allowance = exact(UNIT * (12.0 * (degree + 1) as f64 + 8.0)) * radius.unwrap();
            for k in 0..=degree {
                let arguments: Vec<BigRational> =
                    (0..degree).map(|level| exact(if level < k { end } else { start })).collect();
                let [x, w] = blossom(knots, degree, span, &net, &arguments);
                let control = patch.controls[2 * k];
                let error = exact(control.x) / exact(control.w) - x / w;
                largest = largest.max(part(&error, &allowance));
            }
        }
        largest
    };
    let worst = error(2, &EXTRACTED_KNOTS, &EXTRACTED_POINTS);
    let mut random = Rng::with_seed(7);
    let others = (0..INPUTS).map(|index| {
        let degree = 1 + index % 5;
        let count = degree + 1 + random.usize(..4);
        let mut knots: Vec<f64> = (0..count + degree + 1).map(|_| random.f64()).collect();
        knots.sort_by(f64::total_cmp);
        // Some knots are a few units in the last place apart.
        for index in 1..knots.len() {
            if random.u8(..4) == 0 {
                knots[index] = knots[index].min(knots[index - 1].next_up());
            }
        }
        if knots[degree] >= knots[count] {
            let end = knots[degree] + 1.0;
            knots[count..].fill(end);
        }
        let spread = 40.0 * random.f64();
        let points: Vec<[f64; 2]> =
            (0..count).map(|_| [2.0 * random.f64() - 1.0, (-spread * random.f64()).exp2()]).collect();
        error(degree, &knots, &points)
    });
    assert_met(others.chain([worst]), "extraction");
}

/// Found by a search.
const EXTRACTED_KNOTS: [f64; 7] = [
    -0.45483509258752586,
    -0.04318106306823668,
    -0.02591501498221308,
    0.05290052284039884,
    0.6656226543781054,
    1.401268958404874,
    1.610293536481803,
];
const EXTRACTED_POINTS: [[f64; 2]; 4] = [
    [0.44726218772313026, 0.05569813049927458],
    [0.6903786567740857, 0.004903172880901827],
    [0.5065650061797823, 0.012992639977265352],
    [-0.33559076263054394, 0.30246912409817045],
];
