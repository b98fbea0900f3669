"""Obstacles and wind."""

import bpy
import mathutils

from .steps import add_bodies, clear_keys, empty_scene, matrices, run, scene, select, starts, three_bodies


def bodies_over_roof(file):
    """Three bodies over a roof that is scaled, turned, parented and bevelled by a modifier."""
    objects = three_bodies(file)
    bpy.ops.object.empty_add(location=(1.0, 0.0, -3.0), rotation=(0.0, 0.3, 0.4))
    parent = bpy.context.object
    bpy.ops.mesh.primitive_cube_add(size=1.0)
    roof = bpy.context.object
    roof.name = "Roof"
    roof.parent = parent
    roof.scale = (-9.0, 7.0, 0.5)
    bevel = roof.modifiers.new("bevel", "BEVEL")
    bevel.width, bevel.segments = 0.1, 2
    roof.samara.is_obstacle = True
    roof.samara.friction = 0.3
    select(objects)
    return objects, roof


def set_wind():
    settings = scene.samara
    settings.use_wind = True
    settings.wind_speed = 0.5
    settings.wind_direction = (0.0, 2.0, 0.0)
    settings.wind_profile = "LOG"
    settings.wind_height = 20.0
    settings.wind_roughness = 0.5
    settings.ground = -8.0
    settings.use_ground = True
    settings.gust_speed = 0.2
    settings.gust_length = 3.0
    settings.gust_seed = 4


def world_triangles(o):
    """As lists of corners, metres, each anticlockwise from outside."""
    evaluated = o.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = evaluated.to_mesh()
    mesh.calc_loop_triangles()
    corners = [[list(0.1 * (o.matrix_world @ mesh.vertices[i].co)) for i in t.vertices] for t in mesh.loop_triangles]
    evaluated.to_mesh_clear()
    mirrored = o.matrix_world.determinant() < 0.0
    return [t[::-1] for t in corners] if mirrored else corners


def roof(file):
    """Keys and Live over a roof in a wind, and Live once the roof has been moved."""
    objects, roof = bodies_over_roof(file)
    set_wind()
    frames = range(11, 72)
    found = {"starts": starts(objects), "error": run(bpy.ops.samara.simulate)}
    found["triangles"] = world_triangles(roof)
    found["matrices"] = matrices(objects, frames)
    clear_keys(objects)
    scene.frame_set(11)
    for o in objects:
        o.matrix_world = mathutils.Matrix(found["matrices"][o.name][0])
    found["live_error"] = run(bpy.ops.samara.live)
    found["live"] = matrices(objects, frames)
    roof.parent.location.z -= 20.0
    bpy.context.view_layer.update()
    found["roof_far"] = matrices(objects, [71])
    roof.parent.location.z += 20.0
    bpy.context.view_layer.update()
    found["roof_back"] = matrices(objects, frames)
    roof.samara.is_obstacle = False
    found["no_roof"] = matrices(objects, [71])
    found["live_errors"] = [o.samara.live_error for o in objects]
    return found


def lift(file):
    """Bodies on a platform that keys raise, and its scale animated."""
    objects = three_bodies(file)
    bpy.ops.mesh.primitive_cube_add(size=1.0, location=(1.5, 0.0, -2.0))
    lift = bpy.context.object
    lift.scale = (20.0, 20.0, 1.0)
    lift.samara.is_obstacle = True
    for frame, height in ((41, -2.0), (71, 2.0)):
        lift.location.z = height
        lift.keyframe_insert("location", frame=frame)
    for curve in lift.animation_data.action.fcurves:
        for point in curve.keyframe_points:
            point.interpolation = "LINEAR"
    scene.frame_set(11)
    select(objects)
    found = {"error": run(bpy.ops.samara.simulate), "frame": scene.frame_current}
    found["matrices"] = matrices(objects, [41, 56, 71])
    clear_keys(objects)
    scene.frame_set(11)
    for i, o in enumerate(objects):
        o.location = (1.5 * i, -0.5 * i, 0.25 * i)
        o.rotation_quaternion = mathutils.Quaternion((1.0, 0.3 * i, -0.2, 0.1 * i)).normalized()
    found["live_error"] = run(bpy.ops.samara.live)
    found["live"] = matrices(objects, [41, 56, 71])
    assert run(bpy.ops.samara.live) == ""
    lift.scale.x = 1.0
    lift.keyframe_insert("scale", frame=11)
    lift.scale.x = 2.0
    lift.keyframe_insert("scale", frame=71)
    found["scale"] = run(bpy.ops.samara.simulate)
    lift.animation_data_clear()
    lift.scale.x = 20.0
    lift.location.z = 0.0
    found["inside"] = run(bpy.ops.samara.simulate)
    lift.data.clear_geometry()
    found["no_faces"] = run(bpy.ops.samara.simulate)
    lift.samara.is_obstacle = False
    objects[0].samara.is_obstacle = True
    found["is_obstacle"] = run(bpy.ops.samara.simulate)
    return found


def keyed_wind(file):
    """A body in a wind whose speed keys raise: by keys, live, and with other keys; and what may not be keyed."""
    empty_scene()
    scene.render.fps, scene.render.fps_base = 24, 1.0
    scene.frame_start, scene.frame_end = 1, 25
    (o,) = add_bodies(file, 1, density=1600.0)
    o.samara.noise = False
    settings = scene.samara
    settings.use_wind, settings.wind_direction = True, (1.0, 0.0, 0.0)
    for frame, speed in ((1, 0.0), (25, 1.2)):
        settings.wind_speed = speed
        settings.keyframe_insert("wind_speed", frame=frame)
    curve = scene.animation_data.action.fcurves[0]
    for point in curve.keyframe_points:
        point.interpolation = "LINEAR"
    found = {"error": run(bpy.ops.samara.simulate)}
    frames = range(1, 26)
    found["keyed"] = matrices([o], frames)[o.name]
    clear_keys([o])
    scene.frame_set(1)
    o.matrix_world = mathutils.Matrix(found["keyed"][0])
    found["live_error"] = run(bpy.ops.samara.live)
    found["live"] = matrices([o], reversed(frames))[o.name][::-1]
    curve.keyframe_points[1].co[1] = 0.3
    found["live_slower"] = matrices([o], [25])[o.name][0]
    settings.gust_speed = 0.1
    scene.frame_set(2)
    found["gusts"] = o.samara.live_error
    settings.gust_speed = 0.0
    settings.keyframe_insert("gust_length", frame=1)
    found["length"] = run(bpy.ops.samara.simulate)
    scene.animation_data_clear()
    settings.driver_add("wind_speed")
    found["driver"] = run(bpy.ops.samara.simulate)
    return found


TASKS = (roof, lift, keyed_wind)
