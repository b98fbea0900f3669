"""Operators: simulate to keyframes, live, copy the settings."""

import bpy

from . import keyframes, live
from .flight import FlightJob
from .job_operator import JobOperator
from .objects import flown_objects, has_keys, request_of, surroundings_of
from .samara_library import SamaraError


def requests_of(context, objects):
    """The objects' flights, from their poses at the scene's first frame where keys move them, else of now."""
    scene = context.scene
    now = scene.frame_current_final
    obstacles = live.look_at_obstacles(context)
    if any(has_keys(o) for o in objects):
        scene.frame_set(scene.frame_start)
    context.view_layer.update()
    try:
        surroundings = surroundings_of(scene, obstacles)
        return [request_of(o, surroundings) for o in objects]
    finally:
        if scene.frame_current_final != now:
            scene.frame_set(int(now), subframe=now % 1.0)


def insert_flights(context, objects, flights):
    """Keys at every frame of the scene's range."""
    scene = context.scene
    for o, flight in zip(objects, flights):
        if o.samara.live:
            live.go_off(o)
        keyframes.insert_poses(o, scene.frame_start, flight.locations(), flight.rotations())
    scene.frame_set(scene.frame_current, subframe=scene.frame_subframe)


class SAMARA_OT_simulate(JobOperator, bpy.types.Operator):
    bl_idname = "samara.simulate"
    bl_label = "Simulate to Keyframes"
    bl_description = "Flies the selected objects over the scene's frame range and keys their location and rotation"
    bl_options = {"UNDO"}  # not REGISTER: to change a past call must not run it all again
    CANCELLED = "simulation cancelled; nothing has changed"

    def start(self, context):
        self._objects = flown_objects(context)
        return FlightJob(requests_of(context, self._objects))

    def status(self):
        return f"samara simulates: {100.0 * self.job.progress():.0f} %"

    def finish(self, context):
        insert_flights(context, self._objects, self.job.flights)
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
