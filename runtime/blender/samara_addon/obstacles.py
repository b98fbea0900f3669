"""Objects that bodies collide with: their meshes, and their motions over the scene's frame range."""

import numpy

from .conventions import frame_count, metres_per_unit, seconds_per_frame
from .flight import Obstacle
from .meshes import evaluated_mesh
from .samara_library import SamaraError


def obstacle_objects(scene):
    return [o for o in scene.objects if o.samara.is_obstacle]


def is_moved(o):
    """Whether keys, drivers or constraints, its own or of a parent, may move the object."""
    while o is not None:
        data = o.animation_data
        if o.constraints or (data is not None and (data.action or data.drivers or data.nla_tracks)):
            return True
        o = o.parent
    return False


def _shape(o, depsgraph, unit):
    """Returns vertices (m) in the object's rotated axes, with its scale applied, and triangles."""
    vertices, triangles = evaluated_mesh(o, depsgraph)
    stretch = _stretch(o, depsgraph)
    if numpy.linalg.det(stretch) < 0.0:
        triangles = triangles[:, ::-1]
    return unit * vertices @ stretch.T, numpy.ascontiguousarray(triangles)


def _stretch(o, depsgraph):
    """Returns the part of the object's matrix without translation and rotation."""
    matrix = o.evaluated_get(depsgraph).matrix_world
    turn = numpy.array(matrix.to_quaternion().to_matrix())
    return turn.T @ numpy.array(matrix.to_3x3())


def _key(o, depsgraph, time, unit):
    matrix = o.evaluated_get(depsgraph).matrix_world
    return [time, *(unit * x for x in matrix.translation), *matrix.to_quaternion()]


class ObstaclesOfScene:
    """The obstacles of a scene. Where some may move, they are sampled frame by frame, which is not allowed in handlers."""

    def __init__(self, scene):
        self.objects = obstacle_objects(scene)
        self.move = any(is_moved(o) for o in self.objects)
        self._unit = metres_per_unit(scene)
        # The dependencies of their arrays besides the objects: for static ones only names and unit.
        self.frame = (tuple(o.name for o in self.objects), self._unit)
        if self.move:
            self.frame += (scene.frame_start, frame_count(scene), seconds_per_frame(scene))

    def taken_at(self, depsgraph):
        """Returns the obstacles at their current places."""
        return tuple(self._obstacle(o, depsgraph, [_key(o, depsgraph, 0.0, self._unit)]) for o in self.objects)

    def taken_over_frames(self, context):
        """Returns the obstacles with their motions from the scene's first frame to its last; restores the scene's frame."""
        scene, now = context.scene, context.scene.frame_current_final
        count, seconds = frame_count(scene), seconds_per_frame(scene)
        depsgraph = context.evaluated_depsgraph_get()
        if not self.move:
            return self.taken_at(depsgraph)
        keys = {o.name: [] for o in self.objects}
        try:
            for i in range(count - 1, -1, -1):  # backwards, so that meshes are those of the first frame
                scene.frame_set(scene.frame_start + i)
                for o in self.objects:
                    keys[o.name].append(_key(o, depsgraph, i * seconds, self._unit))
                if i == count - 1:
                    last = {o.name: _stretch(o, depsgraph) for o in self.objects}
            for o in self.objects:
                if not numpy.allclose(last[o.name], _stretch(o, depsgraph), rtol=1e-3, atol=1e-6):
                    raise SamaraError(f"{o.name}: its scale is animated, but obstacles are rigid; remove those keys")
            return tuple(self._obstacle(o, depsgraph, keys[o.name][::-1]) for o in self.objects)
        finally:
            scene.frame_set(int(now), subframe=now % 1.0)

    def _obstacle(self, o, depsgraph, keys):
        vertices, triangles = _shape(o, depsgraph, self._unit)
        keys = numpy.array(keys)
        if (keys[:, 1:] == keys[0, 1:]).all():
            keys = keys[:1]
        return Obstacle(
            name=o.name,
            vertices=vertices.tobytes(),
            triangles=triangles.tobytes(),
            friction=o.samara.friction,
            keys=keys.tobytes(),
        )
