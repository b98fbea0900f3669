"""Writes keys of location and rotation, many at a time."""

import bpy
import numpy

from .objects import own_channels, turn_by_quaternions

_LINEAR = 1  # 'LINEAR' among the interpolations of a key


def _own_action(o):
    """Returns the object's action, not shared with other objects."""
    data = o.animation_data_create()
    if data.action is None:
        data.action = bpy.data.actions.new(f"{o.name} samara")
    elif data.action.users > 1:
        data.action = data.action.copy()
    return data.action


def _insert_channel(action, path, index, frames, values):
    old = action.fcurves.find(path, index=index)
    if old is not None:
        action.fcurves.remove(old)
    curve = action.fcurves.new(path, index=index, action_group="samara")
    points = numpy.empty((len(frames), 2), numpy.float32)
    points[:, 0] = frames
    points[:, 1] = values
    curve.keyframe_points.add(len(frames))
    curve.keyframe_points.foreach_set("co", points.ravel())
    curve.keyframe_points.foreach_set("interpolation", numpy.full(len(frames), _LINEAR, numpy.int32))
    curve.update()


def insert_poses(o, frames, locations, rotations):
    """Replaces all keys of location and rotation_quaternion by linear ones at n frames, in order, that give the poses (n, 3) and
    (n, 4) together with the object's delta transform."""
    turn_by_quaternions(o)
    locations, rotations = own_channels(o, locations, rotations)
    action = _own_action(o)
    for path, values in (("location", locations), ("rotation_quaternion", rotations)):
        for index in range(values.shape[1]):
            _insert_channel(action, path, index, frames, values[:, index])
    data = o.animation_data
    # From Blender 4.4 on an action has slots, one of which belongs to the object.
    if getattr(data, "action_slot", True) is None and data.action_suitable_slots:
        data.action_slot = data.action_suitable_slots[0]
