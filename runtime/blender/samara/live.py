"""Live playback: objects take the poses of their simulations whenever the frame changes."""

import bpy
from bpy.app.handlers import persistent

from .flight import Flight
from .objects import has_keys, request_of
from .samara_library import SamaraError

_flights = {}  # by the name of scene and object


def _flight_of(o, scene):
    """The object's flight, flown anew where anything that it depends on has changed."""
    request = request_of(o, scene)
    key = (scene.name, o.name)
    if key not in _flights or _flights[key].request != request:
        _flights[key] = Flight(request)
    return _flights[key]


def _show_object(o, scene):
    frame = scene.frame_current_final - scene.frame_start
    location, rotation = _flight_of(o, scene).pose_at(frame)
    o.location = location
    o.rotation_quaternion = rotation


def show(scene):
    """Puts all live objects where they are at the scene's frame. One that cannot be flown goes off, and says why."""
    for o in scene.objects:
        if not o.samara.live:
            continue
        try:
            _show_object(o, scene)
        except SamaraError as fault:
            o.samara.live_error = str(fault)
            go_off(o)


def go_live(objects, scene):
    """All of them, or none and a SamaraError."""
    for o in objects:
        if has_keys(o):
            raise SamaraError(
                f"{o.name}: has keys or drivers, which would hide the live motion; clear them "
                "(Object > Animation > Clear Keyframes)"
            )
    for o in objects:
        _flight_of(o, scene)
    for o in objects:
        flight = _flight_of(o, scene)
        body = o.samara
        body.start_location = [x / flight.request.metres_per_unit for x in flight.request.position]
        body.start_rotation = flight.request.orientation
        body.start_rotation_mode = o.rotation_mode
        o.rotation_mode = "QUATERNION"
        body.live_error = ""
        body.live = True
    show(scene)


def go_off(o):
    """Back to where the object started from."""
    body = o.samara
    body.live = False
    o.location = body.start_location
    o.rotation_quaternion = body.start_rotation
    o.rotation_mode = body.start_rotation_mode
    for key in [key for key in _flights if key[1] == o.name]:
        del _flights[key]


# Before the change is evaluated, so that the frame, in the view or rendered, has the poses set here.
@persistent
def _on_frame_change(scene, _=None):
    show(scene)


@persistent
def _on_load(*_):
    _flights.clear()


def register():
    bpy.app.handlers.frame_change_pre.append(_on_frame_change)
    bpy.app.handlers.load_post.append(_on_load)


def unregister():
    bpy.app.handlers.frame_change_pre.remove(_on_frame_change)
    bpy.app.handlers.load_post.remove(_on_load)
    _flights.clear()
