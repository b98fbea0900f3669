"""Flights to keyframes and live, by mass and size, led by keys, from the disk, and what is refused."""

import os
import time

import bpy
import mathutils

from .steps import add_bodies, clear_keys, empty_scene, matrices, run, scene, select, starts, three_bodies


def key(o, keys):
    """Straight keys of the object: (frame, place, turn about y)."""
    o.rotation_mode = "XYZ"
    for frame, place, turn in keys:
        o.location, o.rotation_euler = place, (0.0, turn, 0.0)
        o.keyframe_insert("location", frame=frame)
        o.keyframe_insert("rotation_euler", frame=frame)
    for curve in o.animation_data.action.fcurves:
        for point in curve.keyframe_points:
            point.interpolation = "LINEAR"


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
        "error": run(bpy.ops.samara.simulate),
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


def deltas(file):
    """A body whose pose and size are its own, or partly of a delta transform: by keys, live, and back at its start."""
    empty_scene()
    (o,) = add_bodies(file, 1, density=1600.0)
    scene.frame_end = 25
    o.samara.noise = False
    place, turn = mathutils.Vector((0.5, -1.0, 2.0)), mathutils.Euler((0.3, -0.5, 1.1)).to_quaternion()
    found = {"errors": []}
    for name, shift, mode, delta in (
        ("own", (0.0, 0.0, 0.0), "XYZ", mathutils.Quaternion()),
        ("euler", (1.0, 2.0, 3.0), "XYZ", mathutils.Euler((0.2, 0.9, -0.4)).to_quaternion()),
        ("quaternion", (-1.0, 0.0, 0.5), "QUATERNION", mathutils.Euler((0.2, 0.9, -0.4)).to_quaternion()),
    ):
        clear_keys([o])
        o.rotation_mode = mode
        o.delta_location, o.location = shift, place - mathutils.Vector(shift)
        o.delta_rotation_euler, o.delta_rotation_quaternion = (0.0, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0)
        own = delta.conjugated() @ turn
        if mode == "XYZ":
            o.delta_rotation_euler, o.rotation_euler = delta.to_euler(), own.to_euler()
        else:
            o.delta_rotation_quaternion, o.rotation_quaternion = delta, own
        o.delta_scale, o.scale = ((1.0, 1.0, 1.0), (2.0, 2.0, 2.0)) if name == "own" else ((4.0, 4.0, 4.0), (0.5, 0.5, 0.5))
        bpy.context.view_layer.update()
        begin = [list(row) for row in o.matrix_basis]
        found["errors"].append(run(bpy.ops.samara.live))
        live_way = matrices([o], (1, 13, 25))[o.name]
        scene.frame_set(1)
        found["errors"].append(run(bpy.ops.samara.live))
        end = [list(row) for row in o.matrix_basis]
        assert o.rotation_mode == mode
        found["errors"].append(run(bpy.ops.samara.simulate))
        found[name] = {"begin": begin, "live": live_way, "end": end, "keyed": matrices([o], (1, 13, 25))[o.name]}
    o.keyframe_insert("delta_location", frame=1)
    found["animated"] = run(bpy.ops.samara.simulate)
    return found


def ended(file):
    """How many flights go on for a body that went off Live, and for one that was removed."""
    from samara_addon import live

    empty_scene()
    scene.frame_end = 100000
    found = {}
    for name, leave in (("off", lambda: run(bpy.ops.samara.live)), ("removed", bpy.ops.object.delete)):
        add_bodies(file, 1)
        (other,) = add_bodies(file, 1) if name == "removed" else (None,)
        if other:
            assert run(bpy.ops.samara.live) == ""
            select([o for o in bpy.context.scene.objects if o != other])
        assert run(bpy.ops.samara.live) == ""
        leave()
        scene.frame_set(2)
        time.sleep(0.5)
        found[name] = sum(thread.is_alive() for thread in live._ahead)
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
    key(o, ((11, (0.0, 0.0, 0.0), 0.0), (31, (2.0, 0.0, 1.0), 1.0)))
    led_way = matrices([o], range(11, 21))[o.name]
    found = {"led": led_way, "seconds_per_frame": scene.render.fps_base / scene.render.fps}
    found["error"] = run(bpy.ops.samara.simulate)
    found["flown"] = matrices([o], range(11, 42))[o.name]
    found["again"] = run(bpy.ops.samara.simulate)
    found["flown_again"] = matrices([o], range(11, 42))[o.name]
    return found


def returned(file):
    """A body that keys hold, let go, and have again, moving, from frame 35 on."""
    empty_scene()
    (o,) = add_bodies(file, 1, density=1200.0)
    scene.frame_start, scene.frame_end = 11, 51
    scene.unit_settings.scale_length = 0.1
    body = o.samara
    body.noise = False
    key(o, ((11, (0.0, 0.0, 0.0), 0.0), (21, (0.0, 0.0, 0.0), 0.0), (51, (3.0, 0.0, 6.0), 1.5)))
    frames = range(11, 52)
    found = {"keyed": matrices([o], frames)[o.name]}
    action = o.animation_data.action.copy()
    body.release = 4.0
    found["error"] = run(bpy.ops.samara.simulate)
    found["flown"] = matrices([o], frames)[o.name]
    o.animation_data.action = action
    o.rotation_mode = "XYZ"
    body.returns, body.return_blend = 24, 10
    found["error"] += run(bpy.ops.samara.simulate)
    found["returned"] = matrices([o], frames)[o.name]
    found["error"] += run(bpy.ops.samara.simulate)
    found["again"] = matrices([o], frames)[o.name]
    o.keyframe_insert("location", frame=20)
    o.location.x += 600.0
    o.keyframe_insert("location", frame=21)
    body.release, body.returns = 10.0, 0
    found["jump"] = run(bpy.ops.samara.simulate)
    body.release, body.returns = 24.0, 24
    found["too_early"] = run(bpy.ops.samara.simulate)
    body.release = 0.0
    clear_keys([o])
    found["no_keys"] = run(bpy.ops.samara.simulate)
    return found


def meeting(file):
    """Two bodies, one above the other, that fall onto the ground: alone, and where they meet; by keys and live."""
    empty_scene()
    objects = add_bodies(file, 2, density=1600.0)
    scene.frame_start, scene.frame_end = 1, 49
    scene.unit_settings.scale_length = 0.1
    scene.samara.use_ground, scene.samara.ground = True, 0.0
    for o, height in zip(objects, (0.6, 2.0)):
        o.samara.noise = False
        o.location = (0.0, 0.0, height)
        o.rotation_mode = "QUATERNION"
        o.rotation_quaternion = (1.0, 0.0, 0.0, 0.0)
    select(objects)
    found = {}
    for name, meet in (("alone", False), ("met", True)):
        scene.samara.bodies_meet = meet
        assert run(bpy.ops.samara.live) == ""
        places = matrices(objects, (1, 25, 49))
        found[name + "_live"] = [places[o.name] for o in objects]
        assert run(bpy.ops.samara.live) == ""
        assert run(bpy.ops.samara.simulate) == ""
        places = matrices(objects, (1, 25, 49))
        found[name] = [places[o.name] for o in objects]
        clear_keys(objects)
        for o, height in zip(objects, (0.6, 2.0)):
            o.location = (0.0, 0.0, height)
            o.rotation_quaternion = (1.0, 0.0, 0.0, 0.0)
    return found


def cache(file, folder):
    """Live from the disk: in a saved file that is opened again, and with a flight that is damaged."""
    from samara_addon import flight, live

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

    def counted(self, surroundings, requests, *others):
        flown.extend(request.name for request in requests)
        fleet(self, surroundings, requests, *others)

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

    from samara_addon import samara_library

    samara_library.library.cache_clear()
    place, samara_library.LIBRARY = samara_library.LIBRARY, samara_library.LIBRARY + ".not"
    found["no_library"] = run(bpy.ops.samara.simulate)
    samara_library.LIBRARY = place
    found["library_again"] = run(bpy.ops.samara.simulate)
    return found


def scrub(file, count, frames, folder):
    """Seconds of many bodies live over ground and a roof of 2,000 triangles: until they are live, until all is flown, and of
    the slowest change of a frame: while it is flown, after that, and in the file opened anew."""
    from samara_addon import live

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


TASKS = (keys, live, masses, sizes, deltas, ended, led, returned, meeting, cache, errors, scrub)
