"""Bodies that are added: ready-baked ones, on a mesh, with colours; those that spin; how many triangles a bake keeps."""

import bpy
import mathutils
import numpy

from .steps import empty_scene, matrices, run, scene


def add(**options):
    assert run(bpy.ops.samara.add_bodies, **options) == ""
    return list(bpy.context.selected_objects)


def ready():
    """What ready-baked bodies bring with them."""
    empty_scene()
    (leaf,) = add(ready="leaf")
    mesh = leaf.data
    uv = numpy.empty(2 * len(mesh.loops))
    mesh.uv_layers[0].data.foreach_get("uv", uv)
    found = {"first_fluid": scene.samara.fluid, "file": leaf.samara.body_file, "density": leaf.samara.density}
    found["uv"] = [list(uv.reshape(-1, 2).min(axis=0)), list(uv.reshape(-1, 2).max(axis=0))]
    found["smooth"] = all(p.use_smooth for p in mesh.polygons)
    (disc,) = add(ready="disc")
    found["fluid_beside_the_leaf"] = scene.samara.fluid
    disc.data.calc_normals_split()
    normals = numpy.array([disc.data.loops[i].normal[:] for p in disc.data.polygons for i in p.loop_indices])
    found["leaning"] = float(numpy.minimum(numpy.abs(normals[:, 2]), numpy.hypot(normals[:, 0], normals[:, 1])).max())
    found["simulate"] = run(bpy.ops.samara.simulate)
    empty_scene()
    add(ready="disc")
    found["fluid_of_the_disc"] = scene.samara.fluid
    empty_scene()
    bpy.ops.mesh.primitive_cube_add()
    bpy.context.object.samara.body_file = "samara:sheet"
    found["fluid_by_the_property"] = scene.samara.fluid
    bpy.context.object.samara.body_file = "samara:sheat"
    found["unknown"] = run(bpy.ops.samara.simulate)
    return found


def coloured():
    """Bodies on a plane that is turned and scaled, in colours between two."""
    empty_scene()
    bpy.ops.mesh.primitive_plane_add(size=2.0, location=(1.0, 2.0, 3.0), rotation=(0.5, 0.2, 0.1))
    plane = bpy.context.object
    plane.name, plane.scale = "Crown", (2.0, 0.5, 1.0)
    bpy.context.view_layer.update()
    red, yellow = (0.8, 0.1, 0.0, 1.0), (1.0, 0.7, 0.1, 1.0)
    options = {"ready": "leaf", "count": 200, "emitter": "Crown", "offset": 0.25, "first_color": red, "second_color": yellow}
    bodies = add(**options)
    back = plane.matrix_world.inverted()
    return {
        "on_plane": [list(back @ o.location) for o in bodies],
        "shares": [[(o.color[k] - red[k]) / (yellow[k] - red[k]) for k in range(3)] for o in bodies],
        "missing": run(bpy.ops.samara.add_bodies, **{**options, "emitter": "Crwn"}),
        "no_faces": run(bpy.ops.samara.add_bodies, **{**options, "emitter": no_faces()}),
    }


def no_faces():
    bpy.ops.object.empty_add()
    return bpy.context.object.name


def spin():
    """Maple seeds: where their keys are, and the poses there."""
    from samara_addon import simulate
    from samara_addon.conventions import noise_name

    empty_scene()
    scene.render.fps, scene.render.fps_base = 24, 1.0
    scene.frame_start, scene.frame_end = 1, 61
    seeds = add(ready="samara", count=3)
    seeds[1].samara.patches = 8
    for i, o in enumerate(seeds):
        o.location = (0.0, 0.0, float(i))
        o.rotation_quaternion = mathutils.Quaternion((1.0, 0.2, 0.1 * i, 0.0)).normalized()
    bpy.context.view_layer.update()
    found = {"starts": {o.name: {"name": noise_name(o.name), "position": list(o.location),
                                 "orientation": list(o.matrix_world.decompose()[1].normalized()), "patches": o.samara.patches} for o in seeds}}
    reports, summary = [], simulate.summary
    simulate.summary = lambda *numbers: reports.append(summary(*numbers)) or reports[-1]
    found["error"] = run(bpy.ops.samara.simulate)
    found["report"] = reports[-1]
    frames = {o.name: [p.co[0] for p in o.animation_data.action.fcurves[0].keyframe_points] for o in seeds}
    found["frames"] = frames
    found["matrices"] = {o.name: matrices([o], frames[o.name])[o.name] for o in seeds}
    return found


def meshing(program):
    """How many triangles a ball's body file has, by its own triangles and by a number."""
    from samara_addon import samara_library

    empty_scene()
    bpy.context.preferences.addons["samara_addon"].preferences.program = program
    bpy.ops.mesh.primitive_uv_sphere_add(radius=0.02, segments=24, ring_count=12)
    o = bpy.context.object
    o.data.calc_loop_triangles()
    found = {"own": len(o.data.loop_triangles)}
    for name, keep, triangles in (("kept", True, 0), ("few", False, 200), ("many", False, 2000)):
        o.samara.keep, o.samara.triangles = keep, triangles
        found[name + "_error"] = run(bpy.ops.samara.bake, quality="SHAPE")
        body = samara_library.body_of_file(o.samara.body_file)
        found[name] = [len(body.surface()[1]), body.has_added_mass, body.name]
    return found


TASKS = (ready, coloured, spin, meshing)
