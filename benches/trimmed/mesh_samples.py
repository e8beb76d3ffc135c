"""Writes a ball in every format of meshes and points, for damage.py.

    python3 benches/trimmed/mesh_samples.py FOLDER

Needs numpy. Each format is written by its specification, not by a library, so that every encoding is
there: binary and text STL, the three of PLY, a glTF and a GLB of one scene, a 3MF of two items.
"""

import base64
import io
import json
import struct
import sys
import zipfile
from pathlib import Path

import numpy as np

RINGS, SIDES = 9, 16


def ball() -> tuple[np.ndarray, np.ndarray]:
    polar = np.pi * (np.arange(RINGS) + 0.5) / RINGS
    turn = 2 * np.pi * np.arange(SIDES) / SIDES
    rings = [[np.sin(p) * np.cos(t), np.sin(p) * np.sin(t), np.cos(p)] for p in polar for t in turn]
    at = lambda ring, side: ring * SIDES + side % SIDES  # noqa: E731
    quads = [(at(r, s), at(r + 1, s), at(r + 1, s + 1), at(r, s + 1)) for r in range(RINGS - 1) for s in range(SIDES)]
    return np.array(rings), np.array([triangle for a, b, c, d in quads for triangle in ((a, b, c), (a, c, d))])


def stl(vertices: np.ndarray, triangles: np.ndarray) -> tuple[bytes, bytes]:
    records = [struct.pack("<12fH", 0, 0, 1, *vertices[triangle].ravel(), 0) for triangle in triangles]
    binary = bytes(80) + struct.pack("<I", len(triangles)) + b"".join(records)
    loops = [
        "facet normal 0 0 1\nouter loop\n" + "".join("vertex {} {} {}\n".format(*vertices[v]) for v in triangle) + "endloop\nendfacet\n"
        for triangle in triangles
    ]
    return binary, ("solid ball\n" + "".join(loops) + "endsolid ball\n").encode()


def ply(vertices: np.ndarray, triangles: np.ndarray, order: str) -> bytes:
    encoding = {"<": "binary_little_endian", ">": "binary_big_endian", "": "ascii"}[order]
    header = (
        f"ply\nformat {encoding} 1.0\nelement vertex {len(vertices)}\nproperty double x\nproperty double y\n"
        f"property double z\nelement face {len(triangles)}\nproperty list int int vertex_indices\nend_header\n"
    ).encode()
    if not order:
        lines = ["{} {} {}".format(*vertex) for vertex in vertices] + ["3 {} {} {}".format(*t) for t in triangles]
        return header + "\n".join(lines).encode() + b"\n"
    faces = b"".join(struct.pack(f"{order}4i", 3, *triangle) for triangle in triangles)
    return header + vertices.astype(f"{order}f8").tobytes() + faces


def gltf(vertices: np.ndarray, triangles: np.ndarray) -> tuple[bytes, bytes]:
    positions, indices = vertices.astype("<f4").tobytes(), triangles.astype("<u2").tobytes()
    scene = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0, 1]}],
        "nodes": [{"mesh": 0, "name": "one"}, {"mesh": 0, "name": "two", "translation": [3, 0, 0]}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": len(vertices), "type": "VEC3", "min": [-1] * 3, "max": [1] * 3},
            {"bufferView": 1, "componentType": 5123, "count": triangles.size, "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteOffset": 0, "byteLength": len(positions)},
            {"buffer": 0, "byteOffset": len(positions), "byteLength": len(indices)},
        ],
        "buffers": [{"byteLength": len(positions) + len(indices)}],
    }
    chunk = json.dumps(scene).encode()
    chunk += b" " * (-len(chunk) % 4)
    data = positions + indices
    data += bytes(-len(data) % 4)
    length = 12 + 8 + len(chunk) + 8 + len(data)
    head = struct.pack("<4sII", b"glTF", 2, length)
    glb = head + struct.pack("<I4s", len(chunk), b"JSON") + chunk + struct.pack("<I4s", len(data), b"BIN\0") + data
    uri = "data:application/octet-stream;base64," + base64.b64encode(positions + indices).decode()
    scene["buffers"][0]["uri"] = uri
    return json.dumps(scene).encode(), glb


def three_mf(vertices: np.ndarray, triangles: np.ndarray) -> bytes:
    points = "".join('<vertex x="{}" y="{}" z="{}"/>'.format(*vertex) for vertex in vertices)
    faces = "".join('<triangle v1="{}" v2="{}" v3="{}"/>'.format(*triangle) for triangle in triangles)
    model = (
        '<?xml version="1.0"?><model unit="millimeter" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02">'
        f'<resources><object id="1"><mesh><vertices>{points}</vertices><triangles>{faces}</triangles></mesh></object>'
        '</resources><build><item objectid="1"/><item objectid="1" transform="1 0 0 0 1 0 0 0 1 3 0 0"/></build></model>'
    )
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("3D/3dmodel.model", model)
    return content.getvalue()


def main() -> None:
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    vertices, triangles = ball()
    binary, text = stl(vertices, triangles)
    embedded, glb = gltf(vertices, triangles)
    lines = ["{} {} {}".format(*vertex) for vertex in vertices]
    files = {
        "binary.stl": binary,
        "text.stl": text,
        "little.ply": ply(vertices, triangles, "<"),
        "big.ply": ply(vertices, triangles, ">"),
        "text.ply": ply(vertices, triangles, ""),
        "ball.obj": "\n".join(
            [f"v {line}" for line in lines] + ["f {} {} {}".format(*(triangle + 1)) for triangle in triangles]
        ).encode(),
        "ball.off": "\n".join(
            ["OFF", f"{len(vertices)} {len(triangles)} 0"] + lines + ["3 {} {} {}".format(*triangle) for triangle in triangles]
        ).encode(),
        "ball.gltf": embedded,
        "ball.glb": glb,
        "ball.3mf": three_mf(vertices, triangles),
        "points.xyz": "\n".join(lines).encode(),
        "points.pts": "\n".join([str(len(lines))] + [f"{line} 10 1 2 3" for line in lines]).encode(),
        "points.csv": "\n".join(["x,y,z"] + [line.replace(" ", ",") for line in lines]).encode(),
    }
    for name, content in files.items():
        (folder / name).write_bytes(content)


if __name__ == "__main__":
    main()
