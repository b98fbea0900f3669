"""Makes the mesh that shows a body, and places on a mesh where bodies start."""

import math

import bpy
import numpy

from .meshes import evaluated_mesh

CREASE = math.radians(40.0)  # a sharper edge stays sharp, as where samara meshes shapes


def _area_vectors(corners):
    """Returns normals of triangles (n, 3 corners, 3) as long as their areas."""
    return 0.5 * numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])


def box_projection(vertices, triangles):
    """Returns texture coordinates (n, 3 corners, 2): each triangle is seen along the principal axis that it faces most, the longer of
    the other two axes to the right. The body's longest extent is 1."""
    corners = vertices[triangles]
    areas = _area_vectors(corners)
    weights = numpy.linalg.norm(areas, axis=1)
    centers = corners.mean(axis=1)
    centers -= numpy.average(centers, axis=0, weights=weights)
    axes = numpy.linalg.eigh((centers * weights[:, None]).T @ centers)[1][:, ::-1]  # the longest first
    axes *= numpy.sign(axes[numpy.abs(axes).argmax(axis=0), range(3)])
    along = vertices @ axes
    along = (along - along.min(axis=0)) / numpy.ptp(along, axis=0).max()
    facing = numpy.abs(areas @ axes).argmax(axis=1)
    shown = numpy.array([[1, 2], [0, 2], [0, 1]])[facing]
    return numpy.take_along_axis(along[triangles], shown[:, None, :].repeat(3, axis=1), axis=2)


def mesh_of(body, unit):
    """Returns a new mesh of the body's surface: smooth up to its creases, with texture coordinates. unit: m of a Blender unit."""
    vertices, triangles = body.surface()
    mesh = bpy.data.meshes.new(body.name)
    mesh.from_pydata((vertices / unit).tolist(), [], triangles.tolist())
    mesh.polygons.foreach_set("use_smooth", numpy.ones(len(triangles), bool))
    if hasattr(mesh, "use_auto_smooth"):  # before Blender 4.1
        mesh.use_auto_smooth, mesh.auto_smooth_angle = True, CREASE
    else:
        mesh.set_sharp_from_angle(angle=CREASE)
    mesh.uv_layers.new(name="UVMap").data.foreach_set("uv", box_projection(vertices, triangles).ravel())
    mesh.update()
    return mesh


def places_on(o, context, count, offset, random):
    """Returns points (count, 3) of the world, drawn uniformly over the area of the object's mesh, `offset` outside of its faces."""
    vertices, triangles = evaluated_mesh(o, context.evaluated_depsgraph_get())
    matrix = numpy.array(o.matrix_world)
    corners = (vertices @ matrix[:3, :3].T + matrix[:3, 3])[triangles]
    areas = _area_vectors(corners) * (-1.0 if numpy.linalg.det(matrix[:3, :3]) < 0.0 else 1.0)
    sizes = numpy.linalg.norm(areas, axis=1)
    chosen = random.choice(len(sizes), count, p=sizes / sizes.sum())
    # A uniform point of the triangle: Osada et al., Shape distributions, ACM TOG 21 (2002), eq. 1.
    root, share = numpy.sqrt(random.uniform(size=count)), random.uniform(size=count)
    weights = numpy.stack((1.0 - root, root * (1.0 - share), root * share), axis=1)
    points = numpy.einsum("ij,ijk->ik", weights, corners[chosen])
    return points + offset * areas[chosen] / sizes[chosen, None]
