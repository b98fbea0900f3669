"""Operator that adds one or many objects with the surface of a body file."""

import os

import bpy
import numpy
from bpy.props import BoolProperty, FloatProperty, FloatVectorProperty, IntProperty, StringProperty

from .conventions import metres_per_unit
from .samara_library import SamaraError, body_of_file


def _mesh_of(body, unit):
    vertices, triangles = body.surface()
    mesh = bpy.data.meshes.new(body.name)
    mesh.from_pydata((vertices / unit).tolist(), [], triangles.tolist())
    mesh.update()
    return mesh


def _random_turn(random):
    """Returns a uniformly distributed random quaternion."""
    q = random.normal(size=4)
    return q / numpy.linalg.norm(q)


class SAMARA_OT_add_bodies(bpy.types.Operator):
    bl_idname = "samara.add_bodies"
    bl_label = "samara Bodies"
    bl_description = "Adds objects with the shape and size of a body file around the 3D cursor"
    bl_options = {"REGISTER", "UNDO"}

    filepath: StringProperty(subtype="FILE_PATH")
    filter_glob: StringProperty(default="*.h5", options={"HIDDEN"})
    count: IntProperty(name="Count", default=1, min=1, max=100000)
    spread: FloatVectorProperty(
        name="Spread", description="Largest distance from the 3D cursor along each axis", subtype="TRANSLATION", size=3
    )
    turn: BoolProperty(name="Turn", description="Gives each body a random orientation")
    smallest_size: FloatProperty(
        name="Smallest Size", description="Smallest random size relative to the body file", default=1.0, min=0.001
    )
    largest_size: FloatProperty(name="Largest Size", description="Largest random size relative to the body file", default=1.0, min=0.001)
    release: FloatProperty(
        name="Release Over", description="Number of frames over which the bodies are released at random times", default=0.0, min=0.0
    )
    spread_seed: IntProperty(name="Seed of the Spread", default=1, min=0)
    density: FloatProperty(name="Density", description="kg/m^3", default=1200.0, min=0.001, precision=1)

    def invoke(self, context, event):
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def execute(self, context):
        try:
            body = body_of_file(os.path.normpath(bpy.path.abspath(self.filepath)) if self.filepath else "")
            mesh = _mesh_of(body, metres_per_unit(context.scene))
        except SamaraError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        random = numpy.random.default_rng(self.spread_seed)
        sizes = numpy.log([min(self.smallest_size, self.largest_size), max(self.smallest_size, self.largest_size)])
        for o in context.selected_objects:
            o.select_set(False)
        for _ in range(self.count):
            o = bpy.data.objects.new(body.name, mesh)
            shift = random.uniform(-1.0, 1.0, 3) * numpy.array(self.spread)
            o.location = numpy.array(context.scene.cursor.location) + shift
            o.rotation_mode = "QUATERNION"
            if self.turn:
                o.rotation_quaternion = _random_turn(random)
            o.scale = [numpy.exp(random.uniform(*sizes))] * 3 if sizes[0] < sizes[1] else [self.smallest_size] * 3
            o.samara.release = random.uniform(0.0, self.release) if self.release > 0.0 else 0.0
            o.samara.body_file = self.filepath
            o.samara.density = self.density
            context.collection.objects.link(o)
            o.select_set(True)
        context.view_layer.objects.active = o
        return {"FINISHED"}


def _menu(self, _context):
    self.layout.operator(SAMARA_OT_add_bodies.bl_idname, icon="FORCE_WIND")


CLASSES = (SAMARA_OT_add_bodies,)


def register():
    bpy.types.VIEW3D_MT_add.append(_menu)


def unregister():
    bpy.types.VIEW3D_MT_add.remove(_menu)
