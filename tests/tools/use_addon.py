"""Installs the add-on's zip in Blender, does one task with it, and prints what came of it as a line of JSON after "FOUND ":

  blender -b --factory-startup --python-exit-code 3 --python use_addon.py -- ZIP TASK [ARGUMENT ...]

Tasks in a window, which are generators that yield the seconds to let it live, need one in place of -b:

  xvfb-run -a blender --factory-startup --enable-event-simulate --python use_addon.py -- ZIP TASK [ARGUMENT ...]
"""

import inspect
import json
import os
import sys
import threading
import time
import traceback

import addon_utils
import bpy
import mathutils

zip_file, task, *arguments = sys.argv[sys.argv.index("--") + 1 :]
scene = bpy.context.scene


def empty_scene():
    bpy.ops.object.select_all(action="SELECT")
    bpy.ops.object.delete()


def run(operator, **options):
    """The error that the operator reports, or an empty text. With an undo step, as from a button."""
    try:
        operator("EXEC_DEFAULT", True, **options)
    except RuntimeError as fault:
        return str(fault).strip()
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
        scene.frame_set(int(frame), subframe=frame % 1.0)
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
    from samara.conventions import noise_name

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


def keys(file):
    objects = three_bodies(file)
    found = {"starts": starts(objects)}
    bpy.ops.ed.undo_push(message="before")
    found["error"] = run(bpy.ops.samara.simulate)
    curves = [c for o in objects for c in o.animation_data.action.fcurves]
    found["keys"] = sorted({len(c.keyframe_points) for c in curves})
    found["range"] = [curves[0].keyframe_points[0].co[0], curves[0].keyframe_points[-1].co[0]]
    found["interpolations"] = sorted({p.interpolation for c in curves for p in c.keyframe_points})
    found["matrices"] = matrices(objects, range(11, 72))
    scene.frame_set(31)
    found["error_again"] = run(bpy.ops.samara.simulate)
    found["frame"] = scene.frame_current
    found["matrices_again"] = matrices(objects, range(11, 72))
    bpy.ops.ed.undo()
    bpy.ops.ed.undo()
    found["animated_after_undo"] = sum(o.animation_data is not None for o in bpy.context.scene.objects)
    return found


def live(file):
    objects = three_bodies(file)
    begin = {o.name: [list(row) for row in o.matrix_basis] for o in objects}
    found = {"error": run(bpy.ops.samara.live), "begin": begin}
    shuffled = [60, 12, 40, 11, 71, 13, 40.25, 5, 90]
    found["scrubbed"] = matrices(objects, shuffled)
    found["keys_while_live"] = sum(o.animation_data is not None for o in objects)
    scene.samara.seed = 6
    found["other_seed"] = matrices(objects, shuffled)
    scene.samara.seed = 5
    found["off"] = run(bpy.ops.samara.live)
    found["end"] = {o.name: [list(row) for row in o.matrix_basis] for o in objects}
    assert run(bpy.ops.samara.live) == ""
    scene.frame_set(50)
    found["simulate_while_live"] = run(bpy.ops.samara.simulate)
    found["live_after"] = sum(o.samara.live for o in objects)
    found["keyed"] = matrices(objects, shuffled)
    found["live_on_keys"] = run(bpy.ops.samara.live)
    return found


def clear_keys(objects):
    for o in objects:
        o.animation_data_clear()


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


def masses(file):
    """Where a body is after a second, by how its mass is given."""
    empty_scene()
    (o,) = add_bodies(file, 1, density=3000.0)
    scene.frame_end = 25
    body = o.samara
    body.noise = False
    start = list(o.location)

    def end():
        clear_keys([o])
        o.location, o.rotation_quaternion = start, (0.8, 0.0, 0.6, 0.0)
        assert run(bpy.ops.samara.simulate) == ""
        return matrices([o], [25])[o.name][0]

    found = {"source": body.mass_source, "file": end()}
    body.mass_source = "DENSITY"
    found["density"] = end()
    body.density = 1200.0
    found["same_density"] = end()
    body.mass_source = "MASS"
    body.mass = 1200.0 * 33.51032163829e-6
    found["same_mass"] = end()
    body.use_center_of_mass = True
    body.center_of_mass = (0.0, 0.0, 0.004)
    found["off_center"] = end()
    body.use_inertia = True
    body.inertia = (2e-5, 2e-5, 2e-5)
    found["inertia"] = end()
    body.inertia = (2e-5, 0.0, 0.0)
    clear_keys([o])
    found["no_inertia"] = run(bpy.ops.samara.simulate)
    o.samara.mass_source = "FILE"
    found["start"] = [list(row) for row in o.matrix_basis]
    return found


def sizes(file):
    """Bodies of many sizes, released one after the other; and where one of twice the size is after a second."""
    empty_scene()
    objects = add_bodies(file, 12, density=1600.0, smallest_size=0.5, largest_size=2.0, release=10.0)
    scene.frame_end = 25
    for o in objects:
        o.samara.noise = False
    found = {
        "scales": [list(o.scale) for o in objects],
        "releases": [o.samara.release for o in objects],
        "fault": run(bpy.ops.samara.simulate),
    }
    places = matrices(objects, [1, 4, 25])
    found["places"] = [[places[o.name][k][2][3] for k in range(3)] for o in objects]

    empty_scene()
    (o,) = add_bodies(file, 1)
    o.scale = (2.0, 2.0, 2.0)
    o.rotation_quaternion = (0.8, 0.0, 0.6, 0.0)
    body = o.samara
    body.noise = False
    body.release = 4.8
    body.mass_source = "MASS"
    body.mass = 8.0 * 1200.0 * 33.51032163829e-6
    body.use_center_of_mass = True
    body.center_of_mass = (0.0, 0.0, 0.008)
    found["start"] = [list(row) for row in o.matrix_basis]
    assert run(bpy.ops.samara.simulate) == ""
    found["twice"] = matrices([o], [25])[o.name][0]
    return found


def led(file):
    """A body that keys move and turn evenly until its release."""
    empty_scene()
    (o,) = add_bodies(file, 1, density=1200.0)
    scene.frame_start, scene.frame_end = 11, 41
    body = o.samara
    body.noise = False
    scene.unit_settings.scale_length = 0.1
    body.release = 10.0
    o.rotation_mode = "XYZ"
    for frame, place, turn in ((11, (0.0, 0.0, 0.0), 0.0), (31, (2.0, 0.0, 1.0), 1.0)):
        o.location, o.rotation_euler = place, (0.0, turn, 0.0)
        o.keyframe_insert("location", frame=frame)
        o.keyframe_insert("rotation_euler", frame=frame)
    for curve in o.animation_data.action.fcurves:
        for point in curve.keyframe_points:
            point.interpolation = "LINEAR"
    led_way = matrices([o], range(11, 21))[o.name]
    found = {"led": led_way, "seconds_per_frame": scene.render.fps_base / scene.render.fps}
    found["fault"] = run(bpy.ops.samara.simulate)
    found["flown"] = matrices([o], range(11, 42))[o.name]
    found["again"] = run(bpy.ops.samara.simulate)
    found["flown_again"] = matrices([o], range(11, 42))[o.name]
    return found


def cache(file, folder):
    """Live from the disk: in a saved file that is opened again, and with a flight that is damaged."""
    from samara import flight, live

    objects = three_bodies(file)
    bpy.ops.wm.save_as_mainfile(filepath=os.path.join(folder, "scene.blend"))
    assert run(bpy.ops.samara.live) == ""
    shown = [40, 71, 12]
    found = {"first": matrices(objects, shown)}
    live.wait()
    cached = os.path.join(folder, "samara", "live")
    found["files"] = len(os.listdir(cached))
    bpy.ops.wm.save_mainfile()

    flown = []
    fleet = flight.Fleet.__init__

    def counted(self, surroundings, requests, refused):
        flown.extend(request.name for request in requests)
        fleet(self, surroundings, requests, refused)

    flight.Fleet.__init__ = counted
    bpy.ops.wm.open_mainfile(filepath=os.path.join(folder, "scene.blend"))
    global scene
    scene = bpy.context.scene
    objects = live.live_objects(scene)
    found["again"] = matrices(objects, shown)
    found["flown_again"] = len(flown)
    for i, name in enumerate(sorted(os.listdir(cached))):
        with open(os.path.join(cached, name), "r+b") as damaged:
            damaged.truncate(0 if i == 0 else 500)
    bpy.ops.wm.open_mainfile(filepath=os.path.join(folder, "scene.blend"))
    scene = bpy.context.scene
    found["damaged"] = matrices(live.live_objects(scene), shown)
    found["flown_damaged"] = len(flown)
    live.wait()
    return found


def errors(good, newer, cut):
    empty_scene()
    found = {"none_selected": run(bpy.ops.samara.simulate)}
    (o,) = add_bodies(good, 1)
    o.animation_data_clear()
    for name, file in (("newer", newer), ("cut", cut), ("missing", good + ".not")):
        o.samara.body_file = file
        found[name] = run(bpy.ops.samara.simulate)
        found[name + "_live"] = run(bpy.ops.samara.live)
    o.samara.body_file = good
    o.scale = (2.0, 2.0, 1.0)
    found["scale"] = run(bpy.ops.samara.simulate)
    o.scale = (1.0, 1.0, 1.0)
    scene.frame_end = scene.frame_start
    found["range"] = run(bpy.ops.samara.simulate)
    scene.frame_end = 40
    bpy.ops.object.empty_add()
    parent = bpy.context.object
    select([o])
    o.parent = parent
    found["parent"] = run(bpy.ops.samara.simulate)
    o.parent = None
    o.animation_data_clear()
    assert run(bpy.ops.samara.live) == ""
    o.samara.body_file = cut
    scene.frame_set(9)
    found["in_handler"] = o.samara.live_error
    found["live_after"] = o.samara.live
    o.samara.body_file = good
    found["good"] = run(bpy.ops.samara.simulate)

    from samara import samara_library

    samara_library.library.cache_clear()
    place, samara_library.LIBRARY = samara_library.LIBRARY, samara_library.LIBRARY + ".not"
    found["no_library"] = run(bpy.ops.samara.simulate)
    samara_library.LIBRARY = place
    found["library_again"] = run(bpy.ops.samara.simulate)
    return found


def bake(program, quality):
    empty_scene()
    found = {}
    settings = bpy.context.preferences.addons["samara"].preferences
    bpy.ops.mesh.primitive_plane_add(size=0.02)
    settings.program = program + "-not"
    found["no_program"] = run(bpy.ops.samara.bake, quality=quality)
    settings.program = program
    found["open"] = run(bpy.ops.samara.bake, quality=quality)
    bpy.ops.mesh.primitive_uv_sphere_add(radius=0.5)
    o = bpy.context.object
    o.name = "Ball 1"
    o.scale = (-0.04, 0.04, 0.04)
    found["negative"] = run(bpy.ops.samara.bake, quality=quality)
    o.scale = (0.04, 0.04, 0.04)
    o.modifiers.new("smooth", "SUBSURF").levels = 1
    found["error"] = run(bpy.ops.samara.bake, quality=quality)

    from samara import samara_library
    from samara.bake import mesh_corners
    from samara.bake_job import BakeJob, bake_command

    found["file"] = o.samara.body_file
    body = samara_library.body_of_file(o.samara.body_file)
    found["tables"] = body.has_tables
    vertices, _ = body.surface()
    found["extent"] = list(vertices.max(axis=0) - vertices.min(axis=0))
    found["simulate"] = run(bpy.ops.samara.simulate)
    bpy.ops.mesh.primitive_cube_add()
    found["empty_of_faces"] = ""
    bpy.context.object.data.clear_geometry()
    found["empty_of_faces"] = run(bpy.ops.samara.bake, quality=quality)
    # A bake that is cancelled ends at once.
    job = BakeJob(["sleep", "600"])
    job.cancel()
    found["cancelled"] = job.cancelled
    return found


def render(file, picture):
    empty_scene()
    add_bodies(file, 20, spread=(0.15, 0.15, 0.1), turn=True, density=1600.0)
    scene.frame_end = 12
    assert run(bpy.ops.samara.simulate) == ""
    bpy.ops.object.camera_add(location=(0.0, -0.6, 0.0), rotation=(1.5708, 0.0, 0.0))
    scene.camera = bpy.context.object
    bpy.ops.object.light_add(type="SUN", rotation=(0.5, 0.3, 0.0))
    bpy.context.object.data.energy = 4.0
    scene.render.engine = "CYCLES"
    scene.cycles.samples = 4
    scene.cycles.use_denoising = False
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 320, 240, 100
    scene.render.filepath = picture
    scene.frame_set(12)
    bpy.ops.render.render(write_still=True)
    pixels = bpy.data.images.load(picture).pixels[:]
    return {"bright": sum(p > 0.5 for p in pixels[0::4]) / (len(pixels) / 4)}


def crowd(file, count, frames):
    """Seconds and CPU seconds for many bodies over many frames: of their flights alone, and of the whole button."""
    empty_scene()
    objects = add_bodies(file, int(count), spread=(1.0, 1.0, 1.0), turn=True, density=600.0)
    scene.samara.fluid = "AIR"
    scene.frame_end = int(frames)

    from samara.flight import FlightJob
    from samara.simulate import requests_of

    start, start_cpu = time.perf_counter(), time.process_time()
    FlightJob(requests_of(bpy.context, objects)).wait()
    flown, flown_cpu = time.perf_counter(), time.process_time()
    assert run(bpy.ops.samara.simulate) == ""
    end, end_cpu = time.perf_counter(), time.process_time()
    return {
        "simulation": {"seconds": flown - start, "cpu": flown_cpu - start_cpu},
        "with_keys": {"seconds": end - flown, "cpu": end_cpu - flown_cpu},
    }


def scrub(file, count, frames, folder):
    """Seconds of many bodies live over ground and a roof of 2,000 triangles: until they are live, until all is flown, and of
    the slowest change of a frame: while it is flown, after that, and in the file opened anew."""
    from samara import live

    empty_scene()
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=32, y_subdivisions=32, size=2.0, location=(0.0, 0.0, -1.5), rotation=(0.3, 0.0, 0.0))
    bpy.context.object.samara.is_obstacle = True
    objects = add_bodies(file, int(count), spread=(0.8, 0.8, 0.8), turn=True, density=600.0)
    scene.samara.fluid, scene.samara.use_ground, scene.samara.ground = "AIR", True, -3.0
    scene.frame_end = int(frames)
    bpy.ops.wm.save_as_mainfile(filepath=os.path.join(folder, "scrub.blend"))

    def slowest(scene):
        shuffled = [1 + (97 * i) % int(frames) for i in range(int(frames))]
        seconds = []
        for frame in shuffled:
            start = time.perf_counter()
            scene.frame_set(frame)
            seconds.append(time.perf_counter() - start)
        return {"first": seconds[0], "slowest": max(seconds), "mean": sum(seconds) / len(seconds)}

    start = time.perf_counter()
    assert run(bpy.ops.samara.live) == ""
    found = {"live": time.perf_counter() - start, "while_flown": slowest(scene)}
    live.wait()
    found["all_flown"] = time.perf_counter() - start
    found["flown"] = slowest(scene)
    bpy.ops.wm.save_mainfile()
    bpy.ops.wm.open_mainfile(filepath=os.path.join(folder, "scrub.blend"))
    found["from_disk"] = slowest(bpy.context.scene)
    return found


class Watch:
    """What an operator's calls for events return, and its lines while it runs."""

    def __init__(self, operator):
        self.results, self.lines = [], []
        modal, status = operator.modal, operator.status

        def watched_modal(operator, context, event):
            self.results.append(*modal(operator, context, event))
            return {self.results[-1]}

        def watched_status(operator):
            self.lines.append(status(operator))
            return self.lines[-1]

        operator.modal, operator.status = watched_modal, watched_status

    def runs(self):
        return not self.results or self.results[-1] in ("RUNNING_MODAL", "PASS_THROUGH")


def press(operator, **options):
    """A button pressed in the window."""
    with bpy.context.temp_override(window=bpy.context.window_manager.windows[0]):
        return list(operator("INVOKE_DEFAULT", True, **options))


def press_escape():
    for value in ("PRESS", "RELEASE"):
        bpy.context.window_manager.windows[0].event_simulate(type="ESC", value=value, x=10, y=10)


def simulate_in_window(file):
    """The button that simulates: Esc half way, then to its end, then what it refuses."""
    from samara.simulate import SAMARA_OT_simulate as operator

    objects = three_bodies(file)
    scene.frame_set(31)

    def shown():
        keyed = [o.animation_data is not None for o in objects]
        return [scene.frame_current, keyed] + [[o.rotation_mode, [list(r) for r in o.matrix_basis]] for o in objects]

    before = shown()
    scene.frame_end, scene.samara.step = 3000, 1e-5  # many seconds
    watch = Watch(operator)
    found = {"pressed": press(bpy.ops.samara.simulate)}
    while watch.runs() and watch.lines[-1:] in ([], ["samara simulates: 0 %"]):
        yield 0.05
    found["half_way"] = watch.lines[-1]
    press_escape()
    while watch.runs():
        yield 0.05
    found["cancelled"] = watch.results[-1]
    found["unchanged"] = shown() == before

    scene.frame_end, scene.samara.step = 71, 0.002
    watch.results.clear()
    press(bpy.ops.samara.simulate)
    while watch.runs():
        yield 0.05
    found["finished"] = watch.results[-1]
    found["keys"] = sorted({len(c.keyframe_points) for o in objects for c in o.animation_data.action.fcurves})
    objects[0].scale = (2.0, 1.0, 2.0)
    found["refused"] = run(bpy.ops.samara.simulate)
    return found


def live_in_window(file):
    """Live while the flights are slow: a late frame is asked for, waited for, and flown to."""
    from samara import live
    from samara.samara_library import Simulation

    objects = three_bodies(file)
    advance_to = Simulation.advance_to
    half_way, released = 30 / 24.0, threading.Event()  # s

    def stop_half_way(simulation, time):
        if time > half_way:
            released.wait()
        advance_to(simulation, time)

    Simulation.advance_to = stop_half_way
    found = {"error": run(bpy.ops.samara.live)}
    early = [list(o.location) for o in objects]
    scene.frame_set(71)
    found["flown"] = min(flight.flown for flight in live._flights.values())
    while any(list(o.location) == there for o, there in zip(objects, early)):
        yield 0.1
    found["moved_on"] = min(flight.flown for flight in live._flights.values())
    released.set()
    while any(flight.is_flying() for flight in live._flights.values()):
        yield 0.2
    yield 0.3
    found["frame"] = scene.frame_current
    found["shown"] = {o.name: [list(row) for row in o.matrix_basis] for o in objects}
    assert run(bpy.ops.samara.live) == ""
    assert run(bpy.ops.samara.simulate) == ""
    found["keyed"] = {name: rows[0] for name, rows in matrices(objects, [71]).items()}
    return found


def bake_in_window(program, folder):
    """The button that bakes: Esc half way, an end with an error, then to its end."""
    from samara.bake import SAMARA_OT_bake as operator

    def program_that(name, text):
        path = os.path.join(folder, name)
        with open(path, "w") as script:
            script.write("#!/bin/sh\n" + text)
        os.chmod(path, 0o755)
        return path

    empty_scene()
    bpy.ops.mesh.primitive_uv_sphere_add(radius=0.02)
    body = bpy.context.object.samara
    settings = bpy.context.preferences.addons["samara"].preferences
    process_file = os.path.join(folder, "process")
    watch = Watch(operator)
    settings.program = program_that("slow", f"echo 'case 3 of 10' >&2\necho $$ > '{process_file}'\nexec sleep 600\n")
    found = {"pressed": press(bpy.ops.samara.bake)}
    while watch.runs() and not any("3 of 10" in line for line in watch.lines):
        yield 0.05
    found["half_way"] = watch.lines[-1]
    found["while_running"] = watch.results[-1]
    press_escape()
    while watch.runs():
        yield 0.05
    found["cancelled"] = watch.results[-1]
    with open(process_file) as file:
        found["process_lives"] = os.path.exists(f"/proc/{file.read().strip()}")
    found["file_when_cancelled"] = body.body_file

    settings.program = program_that("failing", "echo 'slow: refused' >&2\nexit 1\n")
    watch.results.clear()
    press(bpy.ops.samara.bake)
    while watch.runs():
        yield 0.05
    found["refused"] = watch.results[-1]

    settings.program = program
    watch.results.clear()
    press(bpy.ops.samara.bake, quality="SHAPE")
    while watch.runs():
        yield 0.05
    found["finished"] = watch.results[-1]
    found["file"] = body.body_file
    return found


def glb(motion):
    """A .glb file, with the importer as this Blender has it."""
    empty_scene()
    found = {"error": run(bpy.ops.import_scene.gltf, filepath=motion)}
    found["meshes"] = sum(o.type == "MESH" for o in scene.objects)
    return found


def version():
    from samara import bl_info, samara_library

    return {"library": samara_library.version(), "bl_info": ".".join(map(str, bl_info["version"]))}


bpy.ops.preferences.addon_install(filepath=zip_file)
bpy.ops.preferences.addon_enable(module="samara")
assert addon_utils.check("samara")[1], "the add-on is not enabled"


def finish(found):
    bpy.ops.preferences.addon_disable(module="samara")
    print("\nFOUND " + json.dumps(found), flush=True)


def go_on(steps):
    """The next step of a task in a window; ends Blender after the last one, and after one that fails."""
    try:
        return next(steps)
    except StopIteration as end:
        finish(end.value)
    except Exception:
        traceback.print_exc()
    bpy.ops.wm.quit_blender()
    return None


tasks = (keys, live, roof, lift, masses, sizes, led, cache, scrub, errors, bake, render, crowd, simulate_in_window, live_in_window, bake_in_window, glb, version)
found = {f.__name__: f for f in tasks}[task](*arguments)
if inspect.isgenerator(found):
    bpy.context.preferences.view.show_splash = False
    bpy.app.timers.register(lambda: go_on(found), first_interval=0.5)
else:
    finish(found)
