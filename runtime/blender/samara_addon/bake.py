"""Operator that bakes a body file from an object's mesh, by the program samara."""

import os
import tempfile

import bpy
import numpy
from bpy.props import EnumProperty

from .bake_job import BakeJob, bake_commands, find_program, write_stl
from .conventions import metres_per_unit, noise_name
from .job_operator import JobOperator
from .meshes import evaluated_mesh
from .objects import fluid_of, scale_of
from .samara_library import SamaraError


def mesh_corners(context, o):
    """Returns the triangles (n, 3 corners, 3) of the object with modifiers and scale, in metres about its origin."""
    if any(s < 0.0 for s in scale_of(o)):
        raise SamaraError(f"{o.name}: has a negative scale, which flips its faces; apply it (Ctrl A, Scale)")
    if any(s == 0.0 for s in scale_of(o)):
        raise SamaraError(f"{o.name}: has a scale of 0 and so no volume; give it another scale")
    vertices, triangles = evaluated_mesh(o, context.evaluated_depsgraph_get())
    return (vertices * numpy.array(scale_of(o)) * metres_per_unit(context.scene))[triangles]


def output_folder():
    """Returns the folder of baked bodies: beside the .blend file, or a temporary one while that is not saved."""
    if bpy.data.filepath:
        folder = bpy.path.abspath("//samara")
    else:
        folder = os.path.join(tempfile.gettempdir(), f"samara-{os.getuid()}")
    try:
        os.makedirs(folder, exist_ok=True)
    except OSError as error:
        raise SamaraError(f"{folder}: {error.strerror}") from None
    return folder


class SAMARA_OT_bake(JobOperator, bpy.types.Operator):
    bl_idname = "samara.bake"
    bl_label = "Bake Body"
    bl_description = "Makes a body file from the active object's closed mesh, with the program samara"
    bl_options = {"UNDO"}  # not REGISTER, by which changed settings of a past call would run it again
    WHILE_RUNNING = {"PASS_THROUGH"}
    CANCELLED = "bake cancelled; solved cases are kept, and the next bake continues from there"

    quality: EnumProperty(
        name="Quality",
        items=[
            ("SHAPE", "Added mass only", "Takes a second, without OpenFOAM. Loads come from the surface or from coefficients"),
            ("SMOKE", "Smoke", "The coarsest tables, for tests only"),
            ("PREVIEW", "Preview", "Tables from OpenFOAM in a minute or two, for trying a bake; falls are further off than without tables"),
            ("STANDARD", "Standard", "Tables for work; takes ten minutes and more"),
        ],
        default="STANDARD",
    )

    @classmethod
    def poll(cls, context):
        return context.object is not None

    def start(self, context):
        o = context.object
        program = find_program(preferences(context).program)
        corners = mesh_corners(context, o)
        folder, name = output_folder(), noise_name(o.name)
        try:
            write_stl(os.path.join(folder, f"{name}.stl"), corners)
            body = o.samara
            meshing = ["--keep"] if body.keep else ["--triangles", str(body.triangles)] if body.triangles else []
            if body.thickness > 0.0:
                meshing += ["--thickness", repr(body.thickness * metres_per_unit(context.scene))]
            commands = bake_commands(program, folder, name, self.quality, body.density, fluid_of(context.scene), meshing)
        except OSError as error:
            raise SamaraError(f"{error.filename}: {error.strerror}") from None
        self._name, self._scale = o.name, scale_of(o)
        self._file = os.path.join(folder, f"{name}.body.h5")
        return BakeJob(commands)

    def status(self):
        return f"samara is baking. {self.job.line}"

    def finish(self, context):
        o = bpy.data.objects.get(self._name)
        if o is None:
            self.report({"WARNING"}, f"{self._file}: is baked, but the object {self._name} no longer exists; pick the file in another object")
            return {"FINISHED"}
        o.samara.body_file = bpy.path.relpath(self._file) if bpy.data.filepath else self._file
        o.samara.body_scale = self._scale
        self.report({"INFO"}, f"{self._file}: is baked")
        return {"FINISHED"}


def preferences(context):
    return context.preferences.addons[__package__].preferences


class SamaraPreferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    program: bpy.props.StringProperty(
        name="samara", description="The program that bakes bodies", subtype="FILE_PATH", default="samara"
    )

    def draw(self, context):
        self.layout.prop(self, "program")


CLASSES = (SamaraPreferences, SAMARA_OT_bake)
