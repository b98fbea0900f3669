"""Operators: simulate to keyframes, live, copy the settings."""

import bpy

import math

from . import keyframes, live
from .conventions import continuous
from .flight import FlightJob, together
from .job_operator import JobOperator
from .objects import flown_objects, has_keys, request_of, surroundings_of
from .samara_library import SamaraError


_BEFORE = 0.25  # frames before the release, from which the keys' velocities are taken


def led_frames(o):
    """How many frames keys lead the object: whole ones, so that the keys of a flight that is made again lead it alike."""
    return max(1, round(o.samara.release)) if has_keys(o) and o.samara.release > 0.0 else 0


def _set_frame(scene, frame):
    scene.frame_set(math.floor(frame), subframe=frame % 1.0)


def _let_go(scene, o, surroundings):
    """The flight of an object from where keys have it at its release, with their velocities there."""
    frames = led_frames(o)
    _set_frame(scene, scene.frame_start + frames - _BEFORE)
    before_location, before_rotation, _ = o.matrix_basis.decompose()
    _set_frame(scene, scene.frame_start + frames)
    location, rotation, _ = o.matrix_basis.decompose()
    seconds = _BEFORE * surroundings.frame_seconds
    w, *axis = rotation @ before_rotation.conjugated()
    length = math.hypot(*axis)
    angle = 2.0 * math.atan2(math.copysign(length, w), abs(w))
    turning = [x / length * angle / seconds if length > 0.0 else 0.0 for x in axis]
    return request_of(o, surroundings, (frames, [x / seconds for x in location - before_location], turning))


def requests_of(context, objects):
    """The objects' flights, from their poses at the scene's first frame where keys move them, or at their release, else of
    now; and the poses (location, quaternion) at the frames before their release of those that keys lead, by name."""
    scene = context.scene
    now = scene.frame_current_final
    obstacles = live.look_at_obstacles(context)
    if any(has_keys(o) for o in objects):
        scene.frame_set(scene.frame_start)
    context.view_layer.update()
    led = [o for o in objects if led_frames(o)]
    ways = {o.name: [] for o in led}
    try:
        surroundings = surroundings_of(scene, obstacles)
        requests = {o.name: request_of(o, surroundings) for o in objects if o not in led}
        for o in led:
            requests[o.name] = _let_go(scene, o, surroundings)
        last = max((led_frames(o) for o in led), default=0)
        for i in range(min(last, surroundings.frames)):
            scene.frame_set(scene.frame_start + i)
            for o in led:
                if i < led_frames(o):
                    location, rotation, _ = o.matrix_basis.decompose()
                    ways[o.name].append((tuple(location), tuple(rotation)))
        return together([requests[o.name] for o in objects]), ways
    finally:
        if scene.frame_current_final != now:
            _set_frame(scene, now)


def insert_flights(context, objects, flights, ways):
    """Keys at every frame of the scene's range: those that led an object stay, one a frame."""
    scene = context.scene
    for o, flight in zip(objects, flights):
        if o.samara.live:
            live.go_off(o)
        locations, rotations = flight.locations().copy(), flight.rotations().copy()
        for i, (location, rotation) in enumerate(ways.get(o.name, ())):
            locations[i], rotations[i] = location, rotation
        keyframes.insert_poses(o, scene.frame_start, locations, continuous(rotations))
    scene.frame_set(scene.frame_current, subframe=scene.frame_subframe)


class SAMARA_OT_simulate(JobOperator, bpy.types.Operator):
    bl_idname = "samara.simulate"
    bl_label = "Simulate to Keyframes"
    bl_description = "Flies the selected objects over the scene's frame range and keys their location and rotation"
    bl_options = {"UNDO"}  # not REGISTER: to change a past call must not run it all again
    CANCELLED = "simulation cancelled; nothing has changed"

    def start(self, context):
        self._objects = flown_objects(context)
        requests, self._ways = requests_of(context, self._objects)
        return FlightJob(requests)

    def status(self):
        return f"samara simulates: {100.0 * self.job.progress():.0f} %"

    def finish(self, context):
        insert_flights(context, self._objects, self.job.flights, self._ways)
        frames = self.job.flights[0].request.surroundings.frames
        self.report({"INFO"}, f"{len(self._objects)} objects simulated over {frames} frames")
        return {"FINISHED"}


class SAMARA_OT_live(bpy.types.Operator):
    bl_idname = "samara.live"
    bl_label = "Live"
    bl_description = (
        "The selected objects follow their simulations at every frame change, without keys; "
        "once more: they are back where they started"
    )
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context):
        try:
            objects = flown_objects(context)
            if all(o.samara.live for o in objects):
                for o in objects:
                    live.go_off(o)
            else:
                context.view_layer.update()
                live.go_live([o for o in objects if not o.samara.live], context)
        except SamaraError as fault:
            self.report({"ERROR"}, str(fault))
            return {"CANCELLED"}
        return {"FINISHED"}


class SAMARA_OT_copy_settings(bpy.types.Operator):
    bl_idname = "samara.copy_settings"
    bl_label = "Copy to Selected"
    bl_description = "Gives the active object's body and its settings to the other selected objects"
    bl_options = {"REGISTER", "UNDO"}

    COPIED = (
        "body_file",
        "body_scale",
        "density",
        "mass_source",
        "mass",
        "use_center_of_mass",
        "center_of_mass",
        "use_inertia",
        "inertia",
        "products_of_inertia",
        "loads",
        "drag_coefficient",
        "lift_coefficient",
        "noise",
        "velocity",
        "angular_velocity",
        "release",
    )

    @classmethod
    def poll(cls, context):
        return context.object is not None

    def execute(self, context):
        source = context.object
        for o in context.selected_objects:
            if o == source:
                continue
            for name in self.COPIED:
                setattr(o.samara, name, getattr(source.samara, name))
        return {"FINISHED"}


CLASSES = (SAMARA_OT_simulate, SAMARA_OT_live, SAMARA_OT_copy_settings)
