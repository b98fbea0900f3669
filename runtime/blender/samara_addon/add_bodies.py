"""Operator that adds one or many objects with the surface of a body file, and its menu."""

import bpy
import numpy
from bpy.props import BoolProperty, FloatProperty, FloatVectorProperty, IntProperty, StringProperty

from .body_mesh import mesh_of, places_on
from .conventions import metres_per_unit
from .objects import path_of_body_file
from .ready_bodies import PREFIX, ready_bodies, ready_body
from .samara_library import SamaraError, body_of_file


def _random_turn(random):
    """Returns a uniformly distributed random quaternion."""
    q = random.normal(size=4)
    return q / numpy.linalg.norm(q)


class SAMARA_OT_add_bodies(bpy.types.Operator):
    bl_idname = "samara.add_bodies"
    bl_label = "samara Bodies"
    bl_description = "Adds objects with the shape and size of a body file around the 3D cursor or on a mesh"
    bl_options = {"REGISTER", "UNDO"}

    filepath: StringProperty(subtype="FILE_PATH")
    filter_glob: StringProperty(default="*.h5", options={"HIDDEN"})
    ready: StringProperty(
        name="Ready-Baked", description="Name of a ready-baked body, in place of a file", options={"HIDDEN", "SKIP_SAVE"}
    )
    count: IntProperty(name="Count", default=1, min=1, max=100000)
    spread: FloatVectorProperty(
        name="Spread", description="Largest distance from the 3D cursor, or the place on the mesh, along each axis",
        subtype="TRANSLATION", size=3
    )
    emitter: StringProperty(name="On Mesh", description="Object on whose surface the bodies start, in place of the 3D cursor")
    offset: FloatProperty(
        name="Offset", description="Distance from the faces of the mesh along their normals", subtype="DISTANCE", default=0.0
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
    first_color: FloatVectorProperty(
        name="Colour", description="Each object's colour is a random mixture of two; materials have it by Object Info > Color",
        subtype="COLOR", size=4, min=0.0, max=1.0, default=(1.0, 1.0, 1.0, 1.0)
    )
    second_color: FloatVectorProperty(
        name="to", description="The other colour", subtype="COLOR", size=4, min=0.0, max=1.0, default=(1.0, 1.0, 1.0, 1.0)
    )

    def invoke(self, context, event):
        if self.ready:
            return self.execute(context)
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.prop(self, "count")
        layout.prop_search(self, "emitter", context.scene, "objects")
        if self.emitter:
            layout.prop(self, "offset")
        for name in ("spread", "turn", "smallest_size", "largest_size", "release", "density", "first_color", "second_color", "spread_seed"):
            layout.prop(self, name)

    def _file(self):
        """Returns what the objects have as their body file, and its body."""
        if not self.ready:
            return self.filepath, body_of_file(path_of_body_file(self.filepath))
        file = PREFIX + self.ready
        if not self.properties.is_property_set("density"):
            self.density = ready_body(file).density
        return file, body_of_file(path_of_body_file(file))

    def _places(self, context, random):
        if not self.emitter:
            return numpy.tile(numpy.array(context.scene.cursor.location), (self.count, 1))
        o = context.scene.objects.get(self.emitter)
        if o is None:
            raise SamaraError(f"{self.emitter}: is not in the scene; choose another object to start on")
        return places_on(o, context, self.count, self.offset, random)

    def execute(self, context):
        random = numpy.random.default_rng(self.spread_seed)
        try:
            file, body = self._file()
            places = self._places(context, numpy.random.default_rng([self.spread_seed, 1]))
            mesh = mesh_of(body, metres_per_unit(context.scene))
        except SamaraError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        fluid = context.scene.samara.fluid
        mixing = numpy.random.default_rng([self.spread_seed, 2]).uniform(size=(self.count, 1))
        colors = (1.0 - mixing) * numpy.array(self.first_color) + mixing * numpy.array(self.second_color)
        sizes = numpy.log([min(self.smallest_size, self.largest_size), max(self.smallest_size, self.largest_size)])
        for o in context.selected_objects:
            o.select_set(False)
        for place, color in zip(places, colors):
            o = bpy.data.objects.new(body.name, mesh)
            o.location = place + random.uniform(-1.0, 1.0, 3) * numpy.array(self.spread)
            o.rotation_mode = "QUATERNION"
            if self.turn:
                o.rotation_quaternion = _random_turn(random)
            o.scale = [numpy.exp(random.uniform(*sizes))] * 3 if sizes[0] < sizes[1] else [self.smallest_size] * 3
            o.color = color
            o.samara.release = random.uniform(0.0, self.release) if self.release > 0.0 else 0.0
            o.samara.body_file = file
            o.samara.density = self.density
            context.collection.objects.link(o)
            o.select_set(True)
        context.view_layer.objects.active = o
        if context.scene.samara.fluid != fluid:
            self.report({"INFO"}, f"{body.name}: the scene's fluid is now {context.scene.samara.fluid.lower()}, for which it was baked")
        return {"FINISHED"}


class SAMARA_MT_add_bodies(bpy.types.Menu):
    bl_idname = "SAMARA_MT_add_bodies"
    bl_label = "samara Bodies"

    def draw(self, _context):
        layout = self.layout
        layout.operator_context = "INVOKE_DEFAULT"
        try:
            for body in ready_bodies().values():
                layout.operator(SAMARA_OT_add_bodies.bl_idname, text=f"{body.name.capitalize()}: {body.purpose}").ready = body.name
        except SamaraError as error:
            layout.label(text=str(error), icon="ERROR")
        layout.separator()
        layout.operator(SAMARA_OT_add_bodies.bl_idname, text="From File...", icon="FILEBROWSER")


def _menu(self, _context):
    self.layout.menu(SAMARA_MT_add_bodies.bl_idname, icon="FORCE_WIND")


CLASSES = (SAMARA_OT_add_bodies, SAMARA_MT_add_bodies)


def register():
    bpy.types.VIEW3D_MT_add.append(_menu)


def unregister():
    bpy.types.VIEW3D_MT_add.remove(_menu)
