"""What other tools say of pairs of bodies with known contacts: OpenCASCADE's booleans and distances, FCL and Coal on
triangles.

    python benches/assemblies/check_peers.py COMMAND [PAIRS [SEED]]

The pairs are those of `contacts.py`, in one assembly for the command and one by one for the others. Each word is judged
as in `checks.py`: a pair with a common volume is a clash, else one within TOUCHING is touching, else one nearer than
BELOW is near, else it is apart. FCL (`pip install python-fcl`) and Coal (`pip install coal`), each left out where it is not
installed, have triangles DEFLECTION off, and a clash where these meet by more than twice that, as their distances may be
off; they cannot tell nested shells from apart ones.
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
from OCP.TopoDS import TopoDS, TopoDS_Shape

try:
    import fcl
except ImportError:
    fcl = None
try:
    import coal
except ImportError:
    coal = None

TOUCHING = 1e-6
# A boolean's volume below this is taken for none.
LEAST_VOLUME = 1e-9
DEFLECTION = 1e-2
CONTACTS_ASKED = 1000
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
    tools = [("OpenCASCADE", by_booleans, SLACK)]
    tools += [(name, tool, 2 * DEFLECTION) for name, module, tool in TRIANGLES if module is not None]
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


def by_fcl(contact: Contact) -> tuple[str, float, None]:
    def mesh(body: TopoDS_Shape) -> object:
        points, triangles = mesh_of(body)
        model = fcl.BVHModel()
        model.beginModel(len(points), len(triangles))
        model.addSubModel(points, triangles)
        model.endModel()
        return fcl.CollisionObject(model)

    one, other = map(mesh, contact.bodies)
    result = fcl.CollisionResult()
    fcl.collide(one, other, fcl.CollisionRequest(num_max_contacts=CONTACTS_ASKED, enable_contact=True), result)
    depth = max((contact.penetration_depth for contact in result.contacts), default=0.0)
    distance = 0.0 if result.is_collision else fcl.distance(one, other)
    return word(depth > 2 * DEFLECTION, distance), distance, None


def by_coal(contact: Contact) -> tuple[str, float, None]:
    def mesh(body: TopoDS_Shape) -> object:
        points, triangles = mesh_of(body)
        model = coal.BVHModelOBBRSS()
        model.beginModel(len(triangles), len(points))
        model.addVertices(points)
        model.addTriangles(triangles)
        model.endModel()
        return model

    one, other = map(mesh, contact.bodies)
    here, result = coal.Transform3s(), coal.CollisionResult()
    coal.collide(one, here, other, here, coal.CollisionRequest(coal.CollisionRequestFlag.CONTACT, CONTACTS_ASKED), result)
    # Depths are negative distances.
    depths = (-result.getContact(index).penetration_depth for index in range(result.numContacts()))
    depth = max(depths, default=0.0)
    request, nearest = coal.DistanceRequest(), coal.DistanceResult()
    distance = 0.0 if result.isCollision() else coal.distance(one, here, other, here, request, nearest)
    return word(depth > 2 * DEFLECTION, distance), distance, None


def mesh_of(shape: TopoDS_Shape) -> tuple[np.ndarray, np.ndarray]:
    """Return the corners and the triangles of a body."""
    BRepMesh_IncrementalMesh(shape, DEFLECTION)
    points, triangles = [], []
    faces = TopExp_Explorer(shape, TopAbs_ShapeEnum.TopAbs_FACE)
    while faces.More():
        mesh = BRep_Tool.Triangulation_s(TopoDS.Face(faces.Current()), TopLoc_Location())
        first = len(points)
        nodes = [mesh.Node(index + 1) for index in range(mesh.NbNodes())]
        points.extend((node.X(), node.Y(), node.Z()) for node in nodes)
        corners = [mesh.Triangle(index + 1).Get() for index in range(mesh.NbTriangles())]
        triangles.extend([first + corner - 1 for corner in triangle] for triangle in corners)
        faces.Next()
    return np.array(points), np.array(triangles)


TRIANGLES = [("FCL", fcl, by_fcl), ("Coal", coal, by_coal)]


if __name__ == "__main__":
    main()
