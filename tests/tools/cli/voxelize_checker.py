"""voxelize_checker.py ORACLES MESH VOX RES [--color]: a .vox file against the oracles of the shared data, as one line of
JSON: voxels that every right voxelizer has and that are missing, voxels outside what it may have, samples of the
surface outside all voxels, and with --color the difference to the mean colour by area (dE76)."""
import json
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, sys.argv[1])
import numpy as np
import compare
import gltf_min
import sat_voxelize


def obj_triangles(path):
    vertices, faces = [], []
    for line in open(path, errors="replace"):
        words = line.split()
        if words and words[0] == "v":
            vertices.append([float(x) for x in words[1:4]])
        if words and words[0] == "f":
            at = [int(w.split("/")[0]) for w in words[1:]]
            at = [i - 1 if i > 0 else len(vertices) + i for i in at]
            faces += [[at[0], at[k], at[k + 1]] for k in range(1, len(at) - 1)]
    return np.array(vertices)[np.array(faces)]


def check(mesh, vox, resolution, wants_colour):
    if mesh.endswith(".obj"):
        triangles = obj_triangles(mesh)
    else:
        triangles = gltf_min.all_pos(gltf_min.triangles(gltf_min.load(mesh)))
    triangles = gltf_min.to_vox_axes(triangles)
    must, may, dims = sat_voxelize.voxelize(triangles, resolution)
    cells, _, _ = compare.world(open(vox, "rb").read())
    cells = cells - cells.min(0)
    inside = (cells < dims).all(1)
    have = np.zeros(dims, bool)
    have[tuple(cells[inside].T)] = True
    low, scale, _ = sat_voxelize.grid_transform(triangles, resolution)
    holes = sat_voxelize.cover(triangles, have, low, scale, step=0.6)[1] if not must.any() else 0
    result = dict(have=int(have.sum()), missing=int((must & ~have).sum()), extra=int((have & ~may).sum()),
                  outside=int((~inside).sum()), holes=holes)
    if wants_colour:
        result.update({k: v for k, v in compare.run(mesh, vox, resolution, True).items() if k.startswith("dE")})
    return result


arguments = [a for a in sys.argv[2:] if a != "--color"]
print(json.dumps(check(arguments[0], arguments[1], int(arguments[2]), "--color" in sys.argv)))
