//! Facts of polyhedra against exact arithmetic.

use crate::models::mesh;
use num_rational::BigRational;
use num_traits::Zero;
use nurbs_hausdorff::{DVec3, Interval};

type Point = [BigRational; 3];

fn exact(number: f64) -> BigRational {
    BigRational::from_float(number).unwrap()
}

fn ratio(above: i64, below: i64) -> BigRational {
    BigRational::new(above.into(), below.into())
}

/// The volume and the integrals of x, y, z, of a closed mesh, by determinants about the world's origin.
fn moments(vertices: &[DVec3], triangles: &[[u32; 3]]) -> (BigRational, Point, [Point; 3]) {
    let points: Vec<Point> = vertices.iter().map(|point| point.to_array().map(exact)).collect();
    let mut volume = BigRational::zero();
    let mut first: Point = std::array::from_fn(|_| BigRational::zero());
    let mut second: [Point; 3] = std::array::from_fn(|_| std::array::from_fn(|_| BigRational::zero()));
    for triangle in triangles {
        let [a, b, c] = triangle.map(|corner| &points[corner as usize]);
        let minor = |i: usize, j: usize| &b[i] * &c[j] - &b[j] * &c[i];
        let cone = (&a[0] * minor(1, 2) + &a[1] * minor(2, 0) + &a[2] * minor(0, 1)) * ratio(1, 6);
        let sum: Point = std::array::from_fn(|axis| &a[axis] + &b[axis] + &c[axis]);
        for i in 0..3 {
            first[i] += &cone * &sum[i] * ratio(1, 4);
            for j in 0..3 {
                let corners = &a[i] * &a[j] + &b[i] * &b[j] + &c[i] * &c[j];
                second[i][j] += &cone * (corners + &sum[i] * &sum[j]) * ratio(1, 20);
            }
        }
        volume += cone;
    }
    (volume, first, second)
}

fn assert_contains(found: Interval, expected: &BigRational, what: &str) {
    assert!(exact(found.lower) <= *expected && *expected <= exact(found.upper), "{what}: {found:?}");
}

/// An octahedron divided into triangles, with random distances of its vertices from a point.
fn star(random: &mut fastrand::Rng, levels: usize, center: DVec3, size: f64) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let mut vertices = vec![DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z];
    let mut triangles: Vec<[u32; 3]> =
        vec![[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]];
    for _ in 0..levels {
        let mut middles = std::collections::HashMap::new();
        let mut middle = |a: u32, b: u32| {
            *middles.entry([a.min(b), a.max(b)]).or_insert_with(|| {
                vertices.push((vertices[a as usize] + vertices[b as usize]).normalize());
                vertices.len() as u32 - 1
            })
        };
        let mut divided = Vec::new();
        for [a, b, c] in triangles {
            let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
            divided.extend([[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]);
        }
        triangles = divided;
    }
    let vertices = vertices.into_iter().map(|point| center + size * (0.5 + random.f64()) * point).collect();
    (vertices, triangles)
}

#[test]
fn facts_of_polyhedra_hold_the_exact_ones() {
    let random = &mut fastrand::Rng::with_seed(49);
    for round in 0..60 {
        let size = [1.0, 1e-6, 1e6][round % 3];
        let distance = [0.0, 3.0, 1000.0][round / 3 % 3] * size;
        let center = distance * DVec3::new(random.f64(), random.f64() - 0.5, -random.f64());
        let (vertices, mut triangles) = star(random, round % 3, center, size);
        let (volume, first, second) = moments(&vertices, &triangles);
        if round % 2 == 0 {
            triangles.iter_mut().for_each(|triangle| triangle.swap(0, 2));
        }
        let model = mesh(&vertices, &triangles);
        let facts = model.facts();
        let found = facts.volume.unwrap();
        assert_contains(found, &volume, "volume");
        assert!(found.width() < 1e-11 * found.middle(), "{found:?} of {round}");
        let centroid: Point = std::array::from_fn(|axis| &first[axis] / &volume);
        let about: [Point; 3] = std::array::from_fn(|i| {
            std::array::from_fn(|j| &second[i][j] - &centroid[i] * &centroid[j] * &volume)
        });
        let inertia = facts.inertia.unwrap();
        let trace = &about[0][0] + &about[1][1] + &about[2][2];
        for i in 0..3 {
            assert_contains(facts.centroid.unwrap()[i], &centroid[i], "centroid");
            for j in 0..3 {
                let diagonal = if i == j { trace.clone() } else { BigRational::zero() };
                assert_contains(inertia[i][j], &(diagonal - &about[i][j]), "inertia");
            }
            let spread = vertices.iter().map(|point| exact(point[i]));
            let extent = spread.clone().max().unwrap() - spread.min().unwrap();
            assert_contains(facts.extents[i], &extent, "extent");
        }
        // The sum of the principal moments is the trace.
        let moments = facts.principal_moments.unwrap();
        let sum = moments.iter().map(|moment| moment.middle()).sum::<f64>();
        let expected = (0..3).map(|axis| inertia[axis][axis].middle()).sum::<f64>();
        assert!((sum - expected).abs() <= 1e-11 * expected, "{moments:?}");
    }
}
