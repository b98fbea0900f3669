"""Steps that the tasks have in common."""

import bpy
import mathutils

scene = bpy.context.scene


def empty_scene():
    bpy.ops.object.select_all(action="SELECT")
    bpy.ops.object.delete()


def run(operator, **options):
    """The error that the operator reports, or an empty text. With an undo step, as from a button."""
    try:
        operator("EXEC_DEFAULT", True, **options)
    except RuntimeError as error:
        return str(error).strip()
    return ""


def select(objects):
    for o in bpy.context.selected_objects:
        o.select_set(False)
    for o in objects:
        o.select_set(True)
        bpy.context.view_layer.objects.active = o


def matrices(objects, frames):
    """By object: its matrix in the world at every frame, as rows."""
    found = {o.name: [] for o in objects}
    for frame in frames:
        bpy.context.scene.frame_set(int(frame), subframe=frame % 1.0)  # of the file that is open now
        for o in objects:
            found[o.name].append([list(row) for row in o.matrix_world])
    return found


def add_bodies(file, count, **options):
    assert run(bpy.ops.samara.add_bodies, filepath=file, count=count, **options) == ""
    return list(bpy.context.selected_objects)


def three_bodies(file):
    """Three objects that start differently, in a scene with units and a frame rate of its own."""
    empty_scene()
    scene.unit_settings.scale_length = 0.1
    scene.render.fps, scene.render.fps_base = 24, 1.001
    scene.frame_start, scene.frame_end = 11, 71
    scene.samara.seed = 5
    objects = add_bodies(file, 3, density=1600.0)
    for i, o in enumerate(objects):
        o.location = (1.5 * i, -0.5 * i, 0.25 * i)
        o.rotation_quaternion = mathutils.Quaternion((1.0, 0.3 * i, -0.2, 0.1 * i)).normalized()
    objects[1].samara.velocity = (1.0, 0.0, -2.0)
    objects[1].samara.angular_velocity = (0.0, 3.0, 0.5)
    objects[2].samara.noise = False
    return objects


def starts(objects):
    """What the scene of `samara simulate` needs to know."""
    from samara_addon.conventions import noise_name

    bpy.context.view_layer.update()
    return {
        o.name: {
            "noise_name": noise_name(o.name),
            "position": [0.1 * x for x in o.matrix_world.translation],
            "orientation": list(o.matrix_world.to_quaternion()),
            "velocity": [0.1 * x for x in o.samara.velocity],
            "angular_velocity": list(o.samara.angular_velocity),
            "noise": o.samara.noise,
        }
        for o in objects
    }


def clear_keys(objects):
    for o in objects:
        o.animation_data_clear()
