"""What other tools say of pairs of bodies with known contacts: OpenCASCADE's booleans and distances, FCL on triangles.

    python benches/assemblies/check_peers.py COMMAND [PAIRS [SEED]]

The pairs are those of `contacts.py`, in one assembly for the command and one by one for the others. Each word is judged
as in `checks.py`: a pair with a common volume is a clash, else one within TOUCHING is touching, else one nearer than
BELOW is near, else it is apart. FCL (`pip install python-fcl`, left out where it is not installed) has triangles
DEFLECTION off, and a clash where these meet by more than twice that, as its distances may be off; it cannot tell nested
shells from apart ones.
"""

from __future__ import annotations

import sys
import tempfile
import time
from collections import Counter
from pathlib import Path
from random import Random

import numpy as np
from assembly import silently
from checks import BELOW, checked, judged, write
from contacts import CONTACTS, Contact
from OCP.BRep import BRep_Tool
from OCP.BRepAlgoAPI import BRepAlgoAPI_Common
from OCP.BRepExtrema import BRepExtrema_DistShapeShape
from OCP.BRepGProp import BRepGProp
from OCP.BRepMesh import BRepMesh_IncrementalMesh
from OCP.GProp import GProp_GProps
from OCP.TopAbs import TopAbs_ShapeEnum
from OCP.TopExp import TopExp_Explorer
from OCP.TopLoc import TopLoc_Location
from OCP.TopoDS import TopoDS

try:
    import fcl
except ImportError:
    fcl = None

TOUCHING = 1e-6
# A boolean's volume below this is taken for none.
LEAST_VOLUME = 1e-9
DEFLECTION = 1e-2
# What a volume or a distance by a boolean may be off before it counts as wrong, relative and absolute.
SLACK = 1e-6


def main() -> None:
    command = sys.argv[1]
    pairs, seed = (int(value) for value in [*sys.argv[2:4], *["48", "1"][len(sys.argv) - 2 :]])
    rng = Random(seed)
    contacts = [CONTACTS[index % len(CONTACTS)](rng) for index in range(pairs)]
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "assembly.step")
        silently(lambda: write(contacts, path, rng))
        result, cpu = checked(command, path)
    faults, undecided = judged(result, contacts)
    print(f"ours: {len(faults)} of {pairs} wrong, {undecided} undecided, {cpu:.2f} CPU s with reading: {faults}")
    tools = [("OpenCASCADE", by_booleans, SLACK), *([("FCL", by_triangles, 2 * DEFLECTION)] if fcl else [])]
    for name, tool, slack in tools:
        started = time.process_time()
        wrong = Counter(fault for contact in contacts for fault in faults_of(contact, slack, *tool(contact)))
        spent = time.process_time() - started
        print(f"{name}: {sum(wrong.values())} of {pairs} wrong, {spent:.2f} CPU s: {dict(wrong)}")


def faults_of(
    contact: Contact, slack: float, state: str, clearance: float | None, volume: float | None
) -> list[str]:
    """Return at most one fault: a wrong word, or a number that is off."""
    if state not in contact.states:
        return [f"{contact.label}: {state}"]
    for name, known, found in (("clearance", contact.clearance, clearance), ("volume", contact.volume, volume)):
        if known is not None and found is not None and abs(found - known) > slack * max(1.0, known):
            return [f"{contact.label}: {name} off"]
    return []


def word(has_volume: bool, distance: float) -> str:
    if has_volume:
        return "clash"
    if distance <= TOUCHING:
        return "touching"
    return "near" if distance < BELOW else "apart"


def by_booleans(contact: Contact) -> tuple[str, float, float]:
    properties = GProp_GProps()
    BRepGProp.VolumeProperties_s(BRepAlgoAPI_Common(*contact.bodies).Shape(), properties)
    distance = BRepExtrema_DistShapeShape(*contact.bodies).Value()
    return word(properties.Mass() > LEAST_VOLUME, distance), distance, properties.Mass()


def by_triangles(contact: Contact) -> tuple[str, float, None]:
    one, other = (fcl.CollisionObject(mesh_of(body)) for body in contact.bodies)
    result = fcl.CollisionResult()
    request = fcl.CollisionRequest(num_max_contacts=1000, enable_contact=True)
    fcl.collide(one, other, request, result)
    depth = max((contact.penetration_depth for contact in result.contacts), default=0.0)
    distance = 0.0 if result.is_collision else fcl.distance(one, other)
    return word(depth > 2 * DEFLECTION, distance), distance, None


def mesh_of(shape) -> object:
    BRepMesh_IncrementalMesh(shape, DEFLECTION)
    points, triangles, count = [], [], 0
    faces = TopExp_Explorer(shape, TopAbs_ShapeEnum.TopAbs_FACE)
    while faces.More():
        mesh = BRep_Tool.Triangulation_s(TopoDS.Face(faces.Current()), TopLoc_Location())
        nodes = [mesh.Node(index + 1) for index in range(mesh.NbNodes())]
        points.extend((node.X(), node.Y(), node.Z()) for node in nodes)
        corners = [mesh.Triangle(index + 1).Get() for index in range(mesh.NbTriangles())]
        triangles.extend([count + corner - 1 for corner in triangle] for triangle in corners)
        count += len(nodes)
        faces.Next()
    model = fcl.BVHModel()
    model.beginModel(len(points), len(triangles))
    model.addSubModel(np.array(points), np.array(triangles))
    model.endModel()
    return model


if __name__ == "__main__":
    main()
