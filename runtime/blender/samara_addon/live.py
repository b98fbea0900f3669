"""Live playback: objects take the poses of their simulations whenever the frame changes."""

import os
import threading
import time

import bpy
from bpy.app.handlers import persistent

from . import pose_cache
from .flight import fleets_of, together
from .objects import has_keys, own_channels, request_of, surroundings_of, turn_by_quaternions
from .obstacles import ObstaclesOfScene
from .samara_library import SamaraError

_flights = {}  # flights by the names of scene and object
_obstacles = {}  # by the name of the scene: their dependencies, and their state when last sampled
_stale = set()  # names of scenes whose obstacles have changed since
_ahead = []  # threads that simulate in advance
_busy = False  # while the frames of a scene are sampled
_renders = False
PATIENCE = 0.05  # s: how long a frame change waits for simulations; renders wait for all


def live_objects(scene):
    return [o for o in scene.objects if o.samara.live]


def look_at_obstacles(context):
    """Samples the obstacles of the scene with their motions, frame by frame. Not for handlers."""
    global _busy
    scene = context.scene
    _busy = True
    try:
        obstacles = ObstaclesOfScene(scene)
        _obstacles[scene.name] = (obstacles.frame, obstacles.taken_over_frames(context))
        _stale.discard(scene.name)
    finally:
        _busy = False
    return _obstacles[scene.name][1]


def _known_obstacles(scene):
    """Returns the obstacles as last sampled; in a handler they are sampled again only where they do not move."""
    obstacles = ObstaclesOfScene(scene)
    known = _obstacles.get(scene.name)
    if known is not None and known[0] == obstacles.frame and scene.name not in _stale:
        return known[1]
    if not obstacles.move:
        depsgraph = bpy.context.evaluated_depsgraph_get() if obstacles.objects else None
        _obstacles[scene.name] = (obstacles.frame, obstacles.taken_at(depsgraph))
        _stale.discard(scene.name)
    elif known is None:
        raise SamaraError("an obstacle moves, and its path is not sampled yet; click Live again")
    else:
        note_change(scene)
    return _obstacles[scene.name][1]


def _drop(keys):
    """Drops flights, and ends the fleets that no flight needs."""
    left = {_flights.pop(key).fleet for key in keys if key in _flights}
    for fleet in left - {None} - {flight.fleet for flight in _flights.values()}:
        fleet.cancelled.set()


def _fly(requests, scene, refused):
    """Returns flights for changed requests: from the disk where they are stored, else in a few new fleets."""
    live = {o.name for o in live_objects(scene)} | {request.name for request in requests}
    _drop([key for key in _flights if key[0] == scene.name and key[1] not in live])
    missing, changed, read = [], [], {}
    folder = pose_cache.folder_of_file()
    for request in requests:
        key = (scene.name, request.name)
        if key in _flights and _flights[key].request == request:
            continue
        changed.append(key)
        flight = pose_cache.read(request, folder)
        if flight is None:
            missing.append(request)
        else:
            read[key] = flight
    if missing and missing[0].group_digest:  # colliding bodies are simulated together or not at all
        missing, read = requests, {}
        changed = [(scene.name, request.name) for request in requests]
    _drop(changed)
    _flights.update(read)
    for fleet in fleets_of(missing, refused, os.cpu_count() or 1):
        for flight in fleet.flights:
            _flights[(scene.name, flight.request.name)] = flight
        thread = threading.Thread(target=_fly_ahead, args=(fleet, folder), daemon=True)
        _ahead[:] = [other for other in _ahead if other.is_alive()] + [thread]
        thread.start()


def _fly_ahead(fleet, folder):
    """Simulates to the end beside Blender, and stores the result on disk."""
    try:
        fleet.fly_to(fleet.surroundings.frames - 1)
    except SamaraError:
        return  # reported when its frame is shown
    if fleet.cancelled.is_set():
        return
    for flight in fleet.flights:
        pose_cache.write(flight, folder)
    pose_cache.trim(folder)


def wait():
    """Waits until everything is simulated and stored on disk."""
    for thread in _ahead:
        thread.join()


def _may_wait():
    """Whether the shown poses must be final, as for renders, rather than quick."""
    return bpy.app.background or _renders


def _put(o, location, rotation):
    """Moves the object to a pose, whatever its delta transform."""
    (o.location,), (o.rotation_quaternion,) = own_channels(o, [location], [rotation])


def _show_object(o, scene, deadline):
    """Returns whether the object has its final pose; otherwise it waits at the last simulated frame."""
    flight = _flights[(scene.name, o.name)]
    frame = min(scene.frame_current_final - scene.frame_start, flight.request.surroundings.frames - 1.0)
    if deadline is not None:
        while flight.flown <= frame and flight.is_flying() and time.monotonic() < deadline:
            time.sleep(0.001)
        if flight.is_flying():
            frame = min(frame, max(0.0, flight.flown - 1.0))
            if flight.flown == 0:
                return False
    _put(o, *flight.pose_at(frame))
    return frame >= scene.frame_current_final - scene.frame_start or not flight.is_flying()


def show(scene):
    """Moves all live objects to their poses at the scene's frame. An object that cannot be simulated is no longer live, and shows the
    reason. Returns whether an object waits at an earlier frame that is simulated already."""
    objects = {o.name: o for o in live_objects(scene)}
    if not objects or _busy:
        return False

    def give_up(name, error):
        o = objects.pop(name, None)
        if o is not None:
            o.samara.live_error = str(error)
            go_off(o)

    requests = []
    try:
        surroundings = surroundings_of(scene, _known_obstacles(scene))
    except SamaraError as error:
        for name in list(objects):
            give_up(name, error)
        return False
    for o in list(objects.values()):
        try:
            requests.append(request_of(o, surroundings))
        except SamaraError as error:
            give_up(o.name, error)
    _fly(together(requests), scene, lambda request, error: give_up(request.name, error))
    deadline = None if _may_wait() else time.monotonic() + PATIENCE
    behind = False
    for o in list(objects.values()):
        try:
            behind = not _show_object(o, scene, deadline) or behind
        except SamaraError as error:
            give_up(o.name, error)
    if behind and not bpy.app.timers.is_registered(_catch_up):
        bpy.app.timers.register(_catch_up, first_interval=0.1)
    return behind


def _catch_up():
    """Shows the frame again when more is simulated."""
    return 0.1 if show(bpy.context.scene) else None


def go_live(objects, context):
    """Makes all objects live, or none and raises SamaraError."""
    scene = context.scene
    for o in objects:
        if has_keys(o):
            raise SamaraError(
                f"{o.name}: has keys or drivers, which override the live motion; clear them "
                "(Object > Animation > Clear Keyframes)"
            )
    surroundings = surroundings_of(scene, look_at_obstacles(context))

    def refuse(_, error):
        raise error

    others = [request_of(o, surroundings) for o in live_objects(scene)] if surroundings.bodies_collide else []
    requests = [request_of(o, surroundings) for o in objects]
    _fly(together(others + requests), scene, refuse)
    for o, request in zip(objects, requests):
        body = o.samara
        body.start_location = [x / surroundings.metres_per_unit for x in request.position]
        body.start_rotation = request.orientation
        body.start_rotation_mode = o.rotation_mode
        turn_by_quaternions(o)
        body.live_error = ""
        body.live = True
    show(scene)


def go_off(o):
    """Moves the object back to its start."""
    body = o.samara
    body.live = False
    _put(o, body.start_location, body.start_rotation)
    if body.start_rotation_mode != "QUATERNION":
        o.delta_rotation_quaternion = (1.0, 0.0, 0.0, 0.0)  # that mode has a separate delta
        o.rotation_mode = body.start_rotation_mode
    _drop([key for key in _flights if key[1] == o.name])


# Before the frame change is evaluated, so that the view and renders have the poses set here.
@persistent
def _on_frame_change(scene, _=None):
    show(scene)


@persistent
def _on_render(*_):
    global _renders
    _renders = True


@persistent
def _on_render_end(*_):
    global _renders
    _renders = False


@persistent
def _on_update(scene, depsgraph):
    """Marks obstacles as changed; they are sampled again as soon as no handler runs."""
    if _busy or not live_objects(scene):
        return
    obstacles = ObstaclesOfScene(scene)
    names = {o.name for o in obstacles.objects} | {o.data.name for o in obstacles.objects if o.data}
    for update in depsgraph.updates:
        is_way = isinstance(update.id, bpy.types.Action)
        is_shape = update.is_updated_geometry or (update.is_updated_transform and not obstacles.move)
        if is_way or (is_shape and update.id.name in names):
            note_change(scene)


def note_change(scene):
    """Marks the obstacles of the scene as changed; they are sampled again once no handler runs."""
    _stale.add(scene.name)
    if not bpy.app.background and not bpy.app.timers.is_registered(_look_again):
        bpy.app.timers.register(_look_again, first_interval=0.1)


def _look_again():
    scene = bpy.context.scene
    if scene.name in _stale and live_objects(scene):
        try:
            look_at_obstacles(bpy.context)
        except SamaraError:
            _stale.discard(scene.name)
        show(scene)
    return None


@persistent
def _on_load(*_):
    _forget()
    if live_objects(bpy.context.scene):
        try:
            look_at_obstacles(bpy.context)
        except SamaraError:
            return  # reported at the first frame change
        show(bpy.context.scene)


def _forget():
    for flight in _flights.values():
        if flight.fleet is not None:
            flight.fleet.cancelled.set()
    _flights.clear()
    _obstacles.clear()
    _stale.clear()


_HANDLERS = (
    ("frame_change_pre", _on_frame_change),
    ("depsgraph_update_post", _on_update),
    ("load_post", _on_load),
    ("render_init", _on_render),
    ("render_complete", _on_render_end),
    ("render_cancel", _on_render_end),
)


def register():
    for name, handler in _HANDLERS:
        getattr(bpy.app.handlers, name).append(handler)


def unregister():
    for name, handler in _HANDLERS:
        getattr(bpy.app.handlers, name).remove(handler)
    for timer in (_look_again, _catch_up):
        if bpy.app.timers.is_registered(timer):
            bpy.app.timers.unregister(timer)
    _forget()
