"""The panel in the physics tab of an object."""

import bpy

from .objects import body_file_of
from .samara_library import SamaraError, body_of_file


class SAMARA_PT_body(bpy.types.Panel):
    bl_idname = "SAMARA_PT_body"
    bl_label = "samara"
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "physics"

    @classmethod
    def poll(cls, context):
        return context.object is not None

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        body = context.object.samara

        layout.prop(body, "body_file")
        row = layout.row()
        row.operator_menu_enum("samara.bake", "quality", text="Bake from Mesh", icon="MESH_DATA")
        has_tables = _draw_file(layout, context.object)

        layout.prop(body, "density")
        layout.prop(body, "loads")
        if body.loads == "COEFFICIENTS" or (body.loads == "AUTO" and not has_tables):
            column = layout.column(align=True)
            column.prop(body, "drag_coefficient")
            column.prop(body, "lift_coefficient")
        else:
            layout.prop(body, "noise")
        layout.prop(body, "velocity")
        layout.prop(body, "angular_velocity")

        column = layout.column()
        column.operator("samara.copy_settings", icon="COPYDOWN")
        column.operator("samara.simulate", icon="KEYFRAME")
        column.operator("samara.live", icon="PLAY", depress=body.live)
        if body.live_error:
            layout.label(text=body.live_error, icon="ERROR")


def _draw_file(layout, o):
    """What the file holds, or why it cannot be read. Returns whether it has tables."""
    if not o.samara.body_file:
        return False
    try:
        body = body_of_file(body_file_of(o))
    except SamaraError as fault:
        layout.label(text=str(fault), icon="ERROR")
        return False
    layout.label(text=f"{body.name}: added mass{' and tables' if body.has_tables else ''}", icon="INFO")
    return body.has_tables


class SAMARA_PT_surroundings(bpy.types.Panel):
    bl_label = "Scene"
    bl_parent_id = "SAMARA_PT_body"
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "physics"

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        surroundings = context.scene.samara
        layout.prop(surroundings, "fluid")
        if surroundings.fluid == "CUSTOM":
            layout.prop(surroundings, "fluid_density")
            layout.prop(surroundings, "fluid_viscosity")
        layout.prop(surroundings, "current")
        layout.prop(surroundings, "seed")
        layout.prop(surroundings, "step")
        layout.prop(surroundings, "use_ground")
        if surroundings.use_ground:
            layout.prop(surroundings, "ground")


CLASSES = (SAMARA_PT_body, SAMARA_PT_surroundings)
