"""Make the meshes in `scenes/meshes/` from the packages that they come from, or by formula.

    python tools/make_meshes.py [bunny-1.0.1.tgz]

- `bunny.ply.gz`: the Stanford bunny, a range scan of a clay figure (Stanford 3D Scanning Repository, Greg Turk and
  Marc Levoy, 1994), as simplified in the npm package `bunny` 1.0.1 by Mikola Lysenko, which states "Public Domain".
  The archive is what `npm pack bunny@1.0.1` fetches; its checksum is verified. Only this mesh needs it, and nothing
  at run time does.
- `brilliant.ply.gz`: a round brilliant cut with 57 facets, made here by intersecting its facet planes (Tolkowsky's
  proportions of 1919), girdle diameter 2.
- `vase.ply.gz`: a thin-walled vase, a surface of revolution 0.3 high.
- `cove.ply.gz`: a table that bends up into a backdrop, 8 wide, 3 high.

The files are binary little-endian PLY, compressed with no time stamp, so that a second run gives the same bytes.
"""

from __future__ import annotations

import gzip
import hashlib
import json
import sys
import tarfile
from pathlib import Path

import numpy as np

MESHES = Path(__file__).resolve().parent.parent / "scenes" / "meshes"
BUNNY_SHA256 = "381e02c74b98cf18814d7bec794726ef70b9c67e037273e82054d0043f6ae303"


def bunny(archive: Path) -> tuple[np.ndarray, np.ndarray]:
    """Vertices and faces of the Stanford bunny from the npm package, standing on y = 0 around the axis."""
    digest = hashlib.sha256(archive.read_bytes()).hexdigest()
    if digest != BUNNY_SHA256:
        sys.exit(f"{archive}: SHA-256 is {digest}, expected {BUNNY_SHA256}")
    with tarfile.open(archive) as package:
        member = package.extractfile("package/index.js")
        assert member is not None
        text = member.read().decode()
    tables = [part.split("=", 1)[1].strip().rstrip(";") for part in text.split("exports.")[1:]]
    positions, faces = np.array(json.loads(tables[0])), np.array(json.loads(tables[1]))
    positions -= (positions.min(axis=0) + positions.max(axis=0)) * [0.5, 0.0, 0.5]
    positions[:, 1] -= positions[:, 1].min()
    return positions, faces


def brilliant() -> tuple[np.ndarray, np.ndarray]:
    """A round brilliant: table, 8 stars, 8 mains and 16 upper halves above; 16 lower halves and 8 mains below.

    Tolkowsky (1919): table 53 % of the diameter, crown angle 34.5°, pavilion angle 40.75°; a girdle 2 % thick.
    The vertices are the points where three facet planes meet inside all others.
    """
    planes: list[tuple[float, float, float, float]] = []

    def facet(azimuth: float, slope: float, point: tuple[float, float]) -> None:
        """A plane that leans by `slope` (degrees from horizontal) and goes through radius and height `point`."""
        a, s = np.radians(azimuth), np.radians(slope)
        normal = np.array([np.sin(s) * np.cos(a), np.cos(s), np.sin(s) * np.sin(a)])
        through = np.array([point[0] * np.cos(a), point[1], point[0] * np.sin(a)])
        planes.append((*normal, float(normal @ through)))

    half_girdle, table = 0.02, 0.53
    crown, pavilion = 34.5, 40.75
    height = half_girdle + (1 - table) * np.tan(np.radians(crown))
    planes.append((0.0, 1.0, 0.0, height))
    for i in range(8):
        facet(45 * i, crown, (1.0, half_girdle))
        facet(45 * i, 180 - pavilion, (1.0, -half_girdle))
        facet(45 * i + 22.5, 21.0, (table * np.cos(np.radians(22.5)), height))
    for i in range(16):
        azimuth = 22.5 * i + 11.25
        rim = np.cos(np.radians(11.25))
        facet(azimuth, 41.0, (rim, half_girdle))
        facet(azimuth, 180 - 42.2, (rim, -half_girdle))
    for i in range(64):
        facet(360 / 64 * (i + 0.5), 90.0, (0.9985, 0.0))
    return intersection(np.array(planes))


def intersection(planes: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The convex solid inside all planes n·x ≤ d, as triangles whose fronts face outwards.

    Points nearer than 1e-4 are one, so that no sliver is left; the hull of the points closes the surface.
    """
    from scipy.spatial import ConvexHull, HalfspaceIntersection

    solid = HalfspaceIntersection(np.column_stack([planes[:, :3], -planes[:, 3]]), np.zeros(3))
    points = np.unique(solid.intersections.round(4), axis=0) + 0.0
    hull = ConvexHull(points, qhull_options="Qt")
    used, faces = np.unique(hull.simplices, return_inverse=True)
    points, faces = points[used], faces.reshape(-1, 3)
    corners = points[faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    inwards = np.einsum("fi,fi->f", normals, hull.equations[:, :3]) < 0
    faces[inwards] = faces[inwards][:, ::-1]
    return points, faces


def vase() -> tuple[np.ndarray, np.ndarray]:
    """A thin-walled vase of height 0.3 around the y axis: foot, outside, lip, inside."""
    from scipy.interpolate import PchipInterpolator

    height = np.array([0.0, 0.004, 0.03, 0.09, 0.16, 0.22, 0.26, 0.29, 0.3])
    radius = np.array([0.044, 0.048, 0.060, 0.082, 0.076, 0.046, 0.034, 0.040, 0.048])
    curve = PchipInterpolator(height, radius)
    up = 0.3 * (1 - np.cos(np.pi * np.linspace(0, 1, 41))) / 2
    outer = np.column_stack([curve(up), up])
    lip_angle = np.linspace(0, np.pi, 7)[1:-1]
    lip = np.column_stack([0.0455 + 0.0025 * np.cos(lip_angle), 0.3 + 0.0025 * np.sin(lip_angle)])
    down = np.linspace(0.3, 0.008, 31)
    inner = np.column_stack([curve(down) - 0.005, down])
    return revolved(np.concatenate([outer, lip, inner]), 72)


def revolved(profile: np.ndarray, sides: int) -> tuple[np.ndarray, np.ndarray]:
    """The closed solid swept by a profile of (radius, height), from the axis to the axis, around y."""
    angle = 2 * np.pi * np.arange(sides) / sides
    circle = np.column_stack([np.cos(angle), np.zeros(sides), -np.sin(angle)])
    rings = [radius * circle + [0.0, height, 0.0] for radius, height in profile]
    ends = np.array([[0.0, profile[0, 1], 0.0], [0.0, profile[-1, 1], 0.0]])
    faces = []
    here = np.arange(sides)
    there = (here + 1) % sides
    for i in range(len(profile) - 1):
        low, high = i * sides, (i + 1) * sides
        faces += [np.column_stack([low + here, low + there, high + there])]
        faces += [np.column_stack([low + here, high + there, high + here])]
    first, last = len(profile) * sides, (len(profile) - 1) * sides
    faces += [np.column_stack([np.full(sides, first), there, here])]
    faces += [np.column_stack([np.full(sides, first + 1), last + here, last + there])]
    return np.concatenate([*rings, ends]), np.concatenate(faces)


def cove() -> tuple[np.ndarray, np.ndarray]:
    """A table from z = 3 to z = -1, a quarter circle of radius 0.8, and a wall up to y = 3; x from -4 to 4."""
    bend = np.linspace(0, np.pi / 2, 49)
    arc = np.column_stack([0.8 - 0.8 * np.cos(bend), -1.0 - 0.8 * np.sin(bend)])
    profile = np.concatenate([[[0.0, 3.0]], [[0.0, -0.9]], arc, [[0.9, -1.8]], [[3.0, -1.8]]])
    left = np.column_stack([np.full(len(profile), -4.0), profile])
    right = np.column_stack([np.full(len(profile), 4.0), profile])
    here = np.arange(len(profile) - 1)
    count = len(profile)
    first = np.column_stack([here, count + here, count + here + 1])
    second = np.column_stack([here, count + here + 1, here + 1])
    return np.concatenate([left, right]), np.concatenate([first, second])


def write(name: str, positions: np.ndarray, faces: np.ndarray, comments: list[str]) -> None:
    """Write a compressed PLY with its provenance as comments."""
    header = ["ply", "format binary_little_endian 1.0", *(f"comment {text}" for text in comments)]
    header += [f"element vertex {len(positions)}", *(f"property float {axis}" for axis in "xyz")]
    header += [f"element face {len(faces)}", "property list uchar int vertex_indices", "end_header", ""]
    rows = np.zeros(len(faces), dtype=[("count", "u1"), ("index", "<i4", 3)])
    rows["count"], rows["index"] = 3, faces
    data = "\n".join(header).encode() + positions.astype("<f4").tobytes() + rows.tobytes()
    path = MESHES / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(gzip.compress(data, 9, mtime=0))
    print(f"{path.name}: {len(positions)} vertices, {len(faces)} faces, {path.stat().st_size} bytes")


def main(arguments: list[str]) -> None:
    """Make the meshes; the bunny only when its archive is given."""
    made_by = "made by tools/make_meshes.py"
    write("brilliant.ply.gz", *brilliant(), ["round brilliant cut, girdle diameter 2, y up", made_by])
    write("vase.ply.gz", *vase(), ["vase, height 0.3, y up", made_by])
    write("cove.ply.gz", *cove(), ["table and backdrop, y up", made_by])
    if arguments:
        comments = [
            "Stanford bunny, Stanford 3D Scanning Repository, G. Turk and M. Levoy 1994",
            "simplified: npm package bunny 1.0.1 by Mikola Lysenko, licence: Public Domain",
            f"archive SHA-256 {BUNNY_SHA256}",
            made_by,
        ]
        write("bunny.ply.gz", *bunny(Path(arguments[0])), comments)


if __name__ == "__main__":
    main(sys.argv[1:])
