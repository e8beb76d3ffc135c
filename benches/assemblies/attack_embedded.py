"""Attack what `check` says of bodies by themselves: `embedded`, where it is known from how a body is made.

    python benches/assemblies/attack_embedded.py COMMAND [COUNT [SEED [FAMILY]]]

Makes COUNT bodies of each family below (100; seed 1), near the border between both answers: depths of 1e-7 to 0.1 on either side of
it, in a random place, turned, mirrored, scaled by 1e-6 to 1e6 and moved far from the origin. Prints for each family how many
are said to be embedded, not to be, and undecided, and every wrong answer: `true` of a body that meets or touches itself, `false`
of one that does not. Bodies that are wrong are kept in the folder `attack` of the working folder. Needs no packages.

| family | truth |
|---|---|
| `mesh`, `facets`, `trims` | closed surfaces of triangles with whole coordinates, some pushed through others, or joined at corners and edges: exact tests of all pairs of triangles. As OFF; as patches with a side that is a point; as trimmed planes |
| `torus`, `revolved` | a radius less than the one it turns about; a profile that crosses the axis or itself |
| `fingers`, `flush` | a cut frame whose two ends are apart, touch or lie in each other; with faces of its own at each end, or with one on both |
| `pinched` | bodies that touch themselves at a corner or the apex of two cones, all of whose faces there go through the point |
| `loop` | the extrusion of a cubic that crosses itself from a parameter of 1 on |
| `folded` | a face that goes back on itself by steps that are each shorter than a direction may be |
| `gaps` | fingers apart by more or less than the gap that the file states |
| `rims` | sheets whose rims touch |
"""

from __future__ import annotations

import json
import math
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Callable, Iterator
from itertools import combinations
from pathlib import Path
from random import Random
from typing import Any, NamedTuple

Point = tuple[float, float, float]
Surface = dict[str, Any]
Triangles = list[tuple[tuple[int, int, int], tuple[int, int, int], tuple[int, int, int]]]


class Body(NamedTuple):
    """A body as a file's text with its ending, and whether it meets or touches itself; None where either may be said.

    `way` is the length of the shortest way along it between points that are one: a larger number that is stated is right.
    """

    text: str
    ending: str
    meets: bool | None
    way: float = math.inf


HALF_ROOT = math.sqrt(0.5)


def main() -> None:
    command = sys.argv[1]
    count, seed = (int(value) for value in [*sys.argv[2:4], *["100", "1"][len(sys.argv) - 2 :]])
    names = sys.argv[4:] or list(FAMILIES)
    totals: Counter[str] = Counter()
    with tempfile.TemporaryDirectory() as folder:
        for name in names:
            rng = Random(f"{name} {seed}")
            found: Counter[str] = Counter()
            for number in range(count):
                body = FAMILIES[name](rng, number)
                path = Path(folder, f"{name}-{seed}-{number}.{body.ending}")
                path.write_text(body.text)
                found.update(judged(command, path, body))
                path.unlink()
            print(f"{name}: {dict(sorted(found.items()))}", flush=True)
            totals.update(found)
    print(f"all: {dict(sorted(totals.items()))}")


def judged(command: str, path: Path, made: Body) -> Iterator[str]:
    """Yield the words for what the command says of a body."""
    arguments = [command, "check", str(path), "--json", "--max-seconds", "20"]
    answer = subprocess.run(arguments, capture_output=True, text=True, check=False)
    result = json.loads(answer.stdout or "{}")
    if "bodies" not in result:
        yield f"refused {result.get('error', {}).get('code', answer.stderr[:60])}"
        return
    said = [body["embedded"] for body in result["bodies"]]
    one = said[0] if len(said) == 1 else (False if False in said else None if None in said else True)
    within = result["bodies"][0]["embeddedWithin"] or 0.0
    meets = None if one is True and within >= made.way else made.meets
    truth = {None: "either", True: "meets", False: "embedded"}[meets]
    yield f"{truth}: {one}" + (f" ({len(said)} bodies)" if len(said) != 1 else "")
    if any((body["embeddedUnknown"] or {}).get("why") == "refuted" for body in result["bodies"]):
        yield "REFUTED"
        keep(path, "refuted")
    # Of several bodies, each may be embedded although all together meet.
    if meets is not None and one is meets and len(said) == 1:
        yield "WRONG"
        keep(path, f"said {one}, meets {meets}, within {within}")


def keep(path: Path, why: str) -> None:
    Path("attack").mkdir(exist_ok=True)
    Path("attack", path.name).write_text(path.read_text())
    print(f"  {path.name}: {why}", flush=True)


# Placement


def drawn_map(rng: Random) -> Callable[[Point], Point]:
    """Return a motion with a scale, a mirror and a place far away, each in some of the draws."""
    axis = unit([rng.gauss(0, 1) for _ in range(3)])
    angle = rng.choice([0.0, rng.uniform(0, 6)])
    scale = 10.0 ** rng.choice([0, 0, 0, rng.uniform(-6, 6)])
    mirror = rng.choice([1, 1, -1])
    far = rng.choice([0.0, 0.0, 1.0, 1e3, 1e6]) * scale
    place = [far * rng.uniform(-1, 1) for _ in range(3)]
    cos, sin = math.cos(angle), math.sin(angle)

    def mapped(point: Point) -> Point:
        x, y, z = point[0] * mirror, point[1], point[2]
        along = sum(a * b for a, b in zip(axis, (x, y, z), strict=True)) * (1 - cos)
        across = (axis[1] * z - axis[2] * y, axis[2] * x - axis[0] * z, axis[0] * y - axis[1] * x)
        turned = [c * cos + k * sin + a * along for c, k, a in zip((x, y, z), across, axis, strict=True)]
        return tuple(scale * c + p for c, p in zip(turned, place, strict=True))

    mapped.off = abs(far) / scale  # the distance from the origin, in sizes of the body
    return mapped


def unit(vector: list[float]) -> list[float]:
    length = math.hypot(*vector)
    return [c / length for c in vector]


def model(surfaces: list[Surface], at: Callable[[Point], Point]) -> str:
    for surface in surfaces:
        surface["ctrl"] = [[[*at((x, y, z)), w] for x, y, z, w in row] for row in surface["ctrl"]]
        surface.setdefault("shell", 0)
    return json.dumps({"name": "attack", "surfaces": surfaces})


def identity(point: Point) -> Point:
    return point


identity.off = 0.0


# Surfaces


def plane(start: Point, u: Point, v: Point, domain: list[list[float]], loops: list[list[tuple[float, float]]]) -> Surface:
    """Return the face of start + a u + b v within loops of (a, b)."""
    at = lambda a, b: [*(s + a * x + b * y for s, x, y in zip(start, u, v, strict=True)), 1]  # noqa: E731
    (a, b), (c, d) = domain
    corners = [[at(a, c), at(a, d)], [at(b, c), at(b, d)]]
    knots = {"knots_u": [a, a, b, b], "knots_v": [c, c, d, d]}
    return {"degree": [1, 1], **knots, "ctrl": corners, "trim": [lines(loop) for loop in loops]}


def lines(loop: list[tuple[float, float]]) -> list[dict[str, Any]]:
    ends = zip(loop, [*loop[1:], loop[0]], strict=True)
    return [{"degree": 1, "knots": [0, 0, 1, 1], "ctrl": [[*a, 1], [*b, 1]]} for a, b in ends]


def quad(a: Point, b: Point, c: Point, d: Point) -> Surface:
    knots = [0, 0, 1, 1]
    return {"degree": [1, 1], "knots_u": knots, "knots_v": knots, "ctrl": [[[*a, 1], [*d, 1]], [[*b, 1], [*c, 1]]]}


def circle(radius: float, z: float, whole: bool = True) -> list[list[float]]:
    """Return the control points of a circle about the z axis, or of a quarter of it."""
    count = 9 if whole else 3
    found = []
    for k in range(count):
        weight = HALF_ROOT if k % 2 else 1.0
        x, y = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1), (1, 0)][k]
        found.append([radius * x, radius * y, z, weight])
    return found


def turned(rows: list[tuple[list[list[float]], float]], degree: int, knots: list[float], whole: bool = True) -> Surface:
    """Return a surface of revolution from circles, each with the weight of its point of the profile."""
    around = [0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4] if whole else [0, 0, 0, 1, 1, 1]
    columns = [[[x, y, z, w * weight] for x, y, z, w in row] for row, weight in rows]
    return {
        "degree": [2, degree],
        "knots_u": around,
        "knots_v": knots,
        "ctrl": [[row[k] for row in columns] for k in range(len(columns[0]))],
    }


def depth_of(rng: Random, at: Callable[[Point], Point], floor: float = 1e-7) -> float:
    """Return a distance to the border on either side, far more than the rounding of the placement."""
    least = max(floor, 1e-9 * at.off)
    return rng.choice([-1, 1]) * math.exp(rng.uniform(math.log(least), math.log(0.1)))


# Families


def torus(rng: Random, _: int) -> Body:
    at = drawn_map(rng)
    depth = depth_of(rng, at)
    major, minor = 1.0, 1.0 + depth
    rows = [
        (circle(major + minor * x, minor * y), weight)
        for x, y, weight in zip(
            [1, 1, 0, -1, -1, -1, 0, 1, 1], [0, 1, 1, 1, 0, -1, -1, -1, 0], [1, HALF_ROOT] * 4 + [1], strict=True
        )
    ]
    return Body(model([turned(rows, 2, [0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4])], at), "json", depth >= 0)


def revolved(rng: Random, _: int) -> Body:
    """A polygon turned about the axis: one corner of it across the axis, or across its opposite side."""
    at = drawn_map(rng)
    depth = depth_of(rng, at)
    if rng.random() < 0.5:
        profile = [(-depth, 0.0), (1.0, rng.uniform(-0.9, -0.4)), (1.2, 0.9), (0.5, 1.0)]
    else:
        # The third corner comes near the side from the last one to the first one, x = 1.
        profile = [(1.0, -1.0), (2.0, -1.2), (1.0 - depth, rng.uniform(-0.3, 0.3)), (2.2, 1.3), (1.0, 1.0)]
    ends = zip(profile, [*profile[1:], profile[0]], strict=True)
    faces = [turned([(circle(r, z), 1.0) for r, z in pair], 1, [0, 0, 1, 1]) for pair in ends]
    return Body(model(faces, at), "json", depth >= 0)


def loop(rng: Random, _: int) -> Body:
    at = drawn_map(rng)
    depth = depth_of(rng, at, 1e-5)
    reach = 1 + depth
    rows = [[[x, y, z, 1] for y in (0, 1)] for x, z in [(0, 0), (reach, 1), (1 - reach, 1), (1, 0)]]
    sheet = {"degree": [3, 1], "knots_u": [0] * 4 + [1] * 4, "knots_v": [0, 0, 1, 1], "ctrl": rows}
    return Body(model([sheet], at), "json", depth >= 0)


def frame(left: float, right: float, narrow: float = 0.0) -> tuple[list[tuple[float, float]], list[int]]:
    """Return the outline of a square frame whose lower bar is cut: the left part reaches to `left`, the right one to `right`.

    Also returns the numbers of the sides on the lines y = 0 and y = 1.
    """
    outline = [(right, narrow), (2, narrow), (2, 4), (-2, 4), (-2, 0), (left, 0), (left, 1), (-1, 1)]
    outline += [(-1, 3), (1, 3), (1, 1 - narrow), (right, 1 - narrow)]
    return outline, [0, 4, 6, 10]


def fingers(rng: Random, _: int) -> Body:
    """All faces whole rectangles, or walls whole and both planes trimmed where they do not cross."""
    at = drawn_map(rng)
    depth = depth_of(rng, at)
    return Body(model(fingers_faces(rng, depth), at), "json", depth >= 0)


def fingers_faces(rng: Random, depth: float) -> list[Surface]:
    outline, _ = frame(depth / 2, -depth / 2, rng.choice([0.0, 0.0, 0.2]))
    faces = [quad((*p, 0), (*q, 0), (*q, 1), (*p, 1)) for p, q in zip(outline, [*outline[1:], outline[0]], strict=True)]
    if depth < -1e-5 and rng.random() < 0.5:
        domain = [[-3, 3], [-1, 5]]
        faces.append(plane((0, 0, 1), (1, 0, 0), (0, 1, 0), domain, [outline]))
        mirrored = [(y, x) for x, y in outline[::-1]]
        faces.append(plane((0, 0, 0), (0, 1, 0), (1, 0, 0), domain[::-1], [mirrored]))
    else:
        right, left, low, high = outline[0][0], outline[5][0], outline[0][1], outline[10][1]
        corners = [
            [(right, low), (2, low), (1, high), (right, high)],
            [(2, low), (2, 4), (1, 3), (1, high)],
            [(2, 4), (-2, 4), (-1, 3), (1, 3)],
            [(-2, 4), (-2, 0), (-1, 1), (-1, 3)],
            [(-2, 0), (left, 0), (left, 1), (-1, 1)],
        ]
        faces += [quad(*[(*p, z) for p in four]) for four in corners for z in (0, 1)]
    return faces


def flush(rng: Random, _: int) -> Body:
    """Planes that go through both ends of the frame are one face each, on a domain far larger than the body."""
    depth = depth_of(rng, identity)
    left, right = depth / 2, -depth / 2
    outline, merged = frame(left, right)
    size = 10.0 ** rng.uniform(0.7, 5)
    domain = [[-size, size], [-size, size]]
    rectangle = lambda a, b: [(a, 0), (b, 0), (b, 1), (a, 1)]  # noqa: E731
    faces = [
        plane((0, 0, 1), (1, 0, 0), (0, 1, 0), domain, [outline]),
        plane((0, 0, 0), (0, 1, 0), (1, 0, 0), domain, [[(y, x) for x, y in outline[::-1]]]),
        plane((0, 0, 0), (1, 0, 0), (0, 0, 1), domain, [rectangle(-2, left), rectangle(right, 2)]),
        plane((0, 1, 0), (-1, 0, 0), (0, 0, 1), domain, [rectangle(-left, 1), rectangle(-1, -right)]),
    ]
    sides = list(zip(outline, [*outline[1:], outline[0]], strict=True))
    faces += [quad((*p, 0), (*q, 0), (*q, 1), (*p, 1)) for k, (p, q) in enumerate(sides) if k not in merged]
    return Body(model(faces, identity), "json", depth >= 0)


def pinched(rng: Random, number: int) -> Body:
    """Two boxes with a corner in common, or two quarters of cones with their apex, with faces that go through it."""
    at = drawn_map(rng)
    if number % 2:
        rows = [(circle(1, -1, False), 1.0), (circle(0, 0, False), 1.0), (circle(1, 1, False), 1.0)]
        lateral = turned(rows, 1, [0, 0, 1, 2, 2], False)
        if rng.random() < 0.7:
            lateral["trim"] = [lines([(0, 0), (1, 0), (1, 2), (0, 2)])]
        bow = [[(0, 0), (1, 1), (0, 1)], [(0, 0), (0, -1), (1, -1)]]
        caps = [
            turned([([[0, 0, z, w] for *_, w in circle(1, z, False)], 1.0), (circle(1, z, False), 1.0)], 1, [0, 0, 1, 1], False)
            for z in (-1, 1)
        ]
        sides = [plane((0, 0, 0), u, (0, 0, 1), [[-2, 2]] * 2, bow) for u in ((1, 0, 0), (0, 1, 0))]
        return Body(model([lateral, *caps, *sides], at), "json", True)
    unit_vectors = [(1, 0, 0), (0, 1, 0), (0, 0, 1)]
    size = [rng.uniform(0.5, 2) for _ in range(3)]
    faces = []
    for k in range(3):
        u, v = unit_vectors[(k + 1) % 3], unit_vectors[(k + 2) % 3]
        a, b = size[(k + 1) % 3], size[(k + 2) % 3]
        squares = [[(0, 0), (a, 0), (a, b), (0, b)], [(0, 0), (-a, 0), (-a, -b), (0, -b)]]
        faces.append(plane((0, 0, 0), u, v, [[-3, 3]] * 2, squares))
        for sign, square in zip((1, -1), squares, strict=True):
            faces.append(plane(tuple(sign * size[k] * c for c in unit_vectors[k]), u, v, [[-3, 3]] * 2, [square]))
    return Body(model(faces, at), "json", True)


def folded(rng: Random, _: int) -> Body:
    """The last part of a plane face lies on the part before it, or goes on from it."""
    count, step = rng.randint(1, 800), 10 ** rng.uniform(-12, -9)
    sign = rng.choice([-1, 1])
    xs = [0.0, 1.0]
    for _ in range(count):
        xs.append(xs[-1] + sign * step)
    end = len(xs) - 1
    knots = [0, 0, *range(1, end), end, end]
    sheet = {"degree": [1, 1], "knots_u": knots, "knots_v": [0, 0, 1, 1], "ctrl": [[[x, 0, 0, 1], [x, 1, 0, 1]] for x in xs]}
    if rng.random() < 0.8:
        sheet["trim"] = [lines([(0, 0), (end, 0), (end, 0.9), (end - 0.5, 1), (0, 1)])]
    meets = sign < 0
    return Body(model([sheet], identity), "json", meets, 2 * count * step)


def gaps(rng: Random, _: int) -> Body:
    """Fingers apart by less than twice the gap are not known to be apart, and those apart by more may be."""
    gap = 10 ** rng.uniform(-6, -3)
    distance = gap * rng.choice([0.1, 0.5, 1.0, 1.9, 2.1, 4.0, 20.0])
    faces = fingers_faces(rng, -distance)
    for face in faces:
        face["gap"] = gap
    return Body(model(faces, identity), "json", None if distance >= 2 * gap else True)


def rims(rng: Random, number: int) -> Body:
    """Sheets: two triangles in a point, and a ring whose ends lie in each other by less than loops may cross.

    The region of a face is where the winding number is not 0, so that the ring may be closed.
    """
    if number % 2:
        turn = rng.uniform(0, 6)
        corners = [(1, -1), (1, 1)], [(-1, 1), (-1, -1)]
        spun = [[(x * math.cos(turn) - y * math.sin(turn), x * math.sin(turn) + y * math.cos(turn)) for x, y in two] for two in corners]
        loops = [[(0, 0), *two] for two in spun] if rng.random() < 0.5 else [[(0, 0), *spun[0], (0, 0), *spun[1]]]
        return Body(model([plane((0, 0, 0), (1, 0, 0), (0, 1, 0), [[-3, 3]] * 2, loops)], drawn_map(rng)), "json", True)
    size = 10 ** rng.uniform(2, 6)
    depth = 10 ** rng.uniform(-4, -1) * rng.choice([1, -1])
    outline, _ = frame(depth / 2, -depth / 2)
    return Body(model([plane((0, 0, 0), (1, 0, 0), (0, 1, 0), [[-size, size]] * 2, [outline])], identity), "json", None if depth > 0 else False)


def mesh(rng: Random, _: int) -> Body:
    triangles = drawn_triangles(rng)
    points = sorted({corner for triangle in triangles for corner in triangle})
    numbers = {point: number for number, point in enumerate(points)}
    # Corners at one point are one in a mesh.
    text = [f"OFF\n{len(points)} {len(triangles)} 0"]
    text += [" ".join(map(str, point)) for point in points]
    text += ["3 " + " ".join(str(numbers[corner]) for corner in triangle) for triangle in triangles]
    return Body("\n".join(text) + "\n", "off", do_meet(triangles))


def facets(rng: Random, _: int) -> Body:
    """A patch for each triangle, with two control points that are one corner of it."""
    triangles = drawn_triangles(rng)
    faces = []
    for triangle in triangles:
        k = rng.randrange(3)
        a, b, c = triangle[k:] + triangle[:k]
        faces.append(quad(a, b, c, a))
    return Body(model(faces, drawn_map(rng)), "json", do_meet(triangles))


def trims(rng: Random, _: int) -> Body:
    """A trimmed plane for each triangle, of a domain that is larger by far."""
    triangles = drawn_triangles(rng)
    faces = []
    for a, b, c in triangles:
        u, v = (tuple(p - q for p, q in zip(corner, a, strict=True)) for corner in (b, c))
        faces.append(plane(a, u, v, [[-rng.uniform(0.5, 9), 2.0], [-1.0, rng.uniform(1.5, 9)]], [[(0, 0), (1, 0), (0, 1)]]))
    return Body(model(faces, drawn_map(rng)), "json", do_meet(triangles))


# Triangles with whole coordinates


def drawn_triangles(rng: Random) -> Triangles:
    """Return a closed surface about a point, with some corners moved at random, or two in each other, touching, or apart."""
    while True:
        found = sphere(rng, (0, 0, 0))
        if rng.random() < 0.3:
            found = found + sphere(rng, tuple(rng.choice([0, 6, 12, 20]) for _ in range(3)))
        if all(any(normal(triangle)) for triangle in found):
            return found


def sphere(rng: Random, place: tuple[int, int, int]) -> Triangles:
    """Return an octahedron, divided once in half of the draws, of size 6 to 12, with up to three corners moved."""
    size = rng.choice([6, 8, 12])
    axes = [tuple(sign * size * (k == axis) for k in range(3)) for axis in range(3) for sign in (1, -1)]
    faces = [(axes[i], axes[2 + j], axes[4 + k]) for i in (0, 1) for j in (0, 1) for k in (0, 1)]
    faces = [(a, b, c) if dot(normal((a, b, c)), a) > 0 else (a, c, b) for a, b, c in faces]
    if rng.random() < 0.5:
        faces = [triangle for face in faces for triangle in divided(face)]
    corners = sorted({corner for face in faces for corner in face})
    moved = {corner: corner for corner in corners}
    for corner in rng.sample(corners, rng.randint(0, 3)):
        reach = rng.choice([1, 2, size, 2 * size])
        moved[corner] = tuple(c + rng.randint(-reach, reach) for c in corner)
    return [tuple(tuple(c + p for c, p in zip(moved[corner], place, strict=True)) for corner in face) for face in faces]


def divided(face: tuple[Any, Any, Any]) -> Triangles:
    middle = lambda p, q: tuple((x + y) // 2 + (x + y > 0) - (x + y < 0) for x, y in zip(p, q, strict=True))  # noqa: E731
    a, b, c = face
    ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
    return [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]


def do_meet(triangles: Triangles) -> bool:
    """Return whether triangles have more in common than corners and edges of one surface that two share."""
    edges = Counter(frozenset(pair) for triangle in triangles for pair in combinations(triangle, 2))
    if any(count > 2 for count in edges.values()):
        return True
    return any(pair_meets(a, b) for a, b in combinations(triangles, 2)) or any(
        fans(triangles, corner) > 1 for corner in {corner for triangle in triangles for corner in triangle}
    )


def fans(triangles: Triangles, corner: tuple[int, int, int]) -> int:
    """Return the number of fans of triangles about a corner."""
    about = [set(triangle) for triangle in triangles if corner in triangle]
    count = 0
    while about:
        count += 1
        fan = [about.pop()]
        while fan:
            one = fan.pop()
            joined = [other for other in about if len(one & other) >= 2]
            about = [other for other in about if len(one & other) < 2]
            fan += joined
    return count


def pair_meets(one: Any, other: Any) -> bool:
    shared = [corner for corner in one if corner in other]
    if len(shared) == 3:
        return True
    if len(shared) == 2:
        a, b = ([corner for corner in triangle if corner not in shared][0] for triangle in (one, other))
        p, q = shared
        edge, to_a, to_b = sub(q, p), sub(a, p), sub(b, p)
        return dot(cross(edge, to_a), to_b) == 0 and dot(cross(edge, to_a), cross(edge, to_b)) > 0
    for first, second in ((one, other), (other, one)):
        for pair in combinations(first, 2):
            if not (set(pair) & set(shared)) and segment_meets(pair, second):
                return True
    return False


def segment_meets(segment: Any, triangle: Any) -> bool:
    p, q = segment
    a, b, c = triangle
    up = normal(triangle)
    of_p, of_q = dot(up, sub(p, a)), dot(up, sub(q, a))
    if of_p * of_q > 0:
        return False
    if of_p == of_q == 0:
        return flat_meets(p, q, triangle, up)
    along = sub(q, p)
    signs = [dot(along, cross(sub(x, p), sub(y, p))) for x, y in ((a, b), (b, c), (c, a))]
    return all(sign >= 0 for sign in signs) or all(sign <= 0 for sign in signs)


def flat_meets(p: Any, q: Any, triangle: Any, up: Any) -> bool:
    turn = lambda x, y, z: dot(up, cross(sub(y, x), sub(z, x)))  # noqa: E731
    a, b, c = triangle
    for point in (p, q):
        if min(turn(a, b, point), turn(b, c, point), turn(c, a, point)) >= 0:
            return True
    for x, y in ((a, b), (b, c), (c, a)):
        if turn(x, y, p) * turn(x, y, q) <= 0 and turn(p, q, x) * turn(p, q, y) <= 0:
            if any((turn(x, y, p), turn(x, y, q))) or overlap(p, q, x, y):
                return True
    return False


def overlap(p: Any, q: Any, x: Any, y: Any) -> bool:
    along = sub(q, p)
    low, high = sorted((0, dot(along, along)))
    one, other = sorted((dot(along, sub(x, p)), dot(along, sub(y, p))))
    return one <= high and low <= other


def normal(triangle: Any) -> tuple[int, int, int]:
    a, b, c = triangle
    return cross(sub(b, a), sub(c, a))


def sub(a: Any, b: Any) -> tuple[int, int, int]:
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def dot(a: Any, b: Any) -> int:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Any, b: Any) -> tuple[int, int, int]:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


FAMILIES: dict[str, Callable[[Random, int], Body]] = {
    "mesh": mesh,
    "facets": facets,
    "trims": trims,
    "torus": torus,
    "revolved": revolved,
    "fingers": fingers,
    "flush": flush,
    "pinched": pinched,
    "loop": loop,
    "folded": folded,
    "gaps": gaps,
    "rims": rims,
}

if __name__ == "__main__":
    main()
