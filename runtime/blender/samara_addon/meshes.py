"""Meshes of objects with their modifiers."""

import numpy

from .samara_library import SamaraError


def evaluated_mesh(o, depsgraph):
    """Returns vertices (n, 3), in Blender units and the object's axes, and triangles (m, 3)."""
    evaluated = o.evaluated_get(depsgraph)
    try:
        mesh = evaluated.to_mesh()
    except RuntimeError:
        raise SamaraError(f"{o.name}: has no mesh; choose an object with a mesh") from None
    try:
        mesh.calc_loop_triangles()
        vertices = numpy.empty(3 * len(mesh.vertices), numpy.float32)
        triangles = numpy.empty(3 * len(mesh.loop_triangles), numpy.int32)
        mesh.vertices.foreach_get("co", vertices)
        mesh.loop_triangles.foreach_get("vertices", triangles)
    finally:
        evaluated.to_mesh_clear()
    if not len(triangles):
        raise SamaraError(f"{o.name}: has no faces; choose a mesh with faces")
    return vertices.reshape(-1, 3).astype(float), triangles.reshape(-1, 3)
