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

        layout.prop(body, "is_obstacle")
        if body.is_obstacle:
            layout.prop(body, "friction")
            return

        layout.prop(body, "body_file")
        row = layout.row()
        row.operator_menu_enum("samara.bake", "quality", text="Bake from Mesh", icon="MESH_DATA")
        file = _draw_file(layout, context.object)

        _draw_mass(layout, body, file is not None and file.mass > 0.0)
        layout.prop(body, "loads")
        loads = file.loads_in_use(body.loads) if file else body.loads
        if loads == "COEFFICIENTS":
            column = layout.column(align=True)
            column.prop(body, "drag_coefficient")
            column.prop(body, "lift_coefficient")
        else:
            layout.prop(body, "noise")
        layout.prop(body, "patches")
        layout.prop(body, "velocity")
        layout.prop(body, "angular_velocity")
        layout.prop(body, "release")
        layout.prop(body, "returns")
        if body.returns > 0:
            layout.prop(body, "return_blend")

        column = layout.column()
        column.operator("samara.copy_settings", icon="COPYDOWN")
        column.operator("samara.simulate", icon="KEYFRAME")
        column.operator("samara.live", icon="PLAY", depress=body.live)
        if body.live_error:
            layout.label(text=body.live_error, icon="ERROR")


def _draw_file(layout, o):
    """Shows the content of the body file, or why it cannot be read. Returns its body; None where there is none."""
    if not o.samara.body_file:
        return None
    try:
        body = body_of_file(body_file_of(o))
    except SamaraError as error:
        layout.label(text=str(error), icon="ERROR")
        return None
    weighs = f", {1000.0 * body.mass:.4g} g" if body.mass > 0.0 else ""
    loads = {"TABLE": " and tables", "SURFACE": " and surface loads", "COEFFICIENTS": ""}[body.loads_in_use("AUTO")]
    layout.label(text=f"{body.name}: added mass{loads}{weighs}", icon="INFO")
    return body


def _draw_mass(layout, body, has_mass):
    layout.prop(body, "mass_source")
    if body.mass_source == "DENSITY" or (body.mass_source == "FILE" and not has_mass):
        layout.prop(body, "density")
    if body.mass_source == "AREA":
        layout.prop(body, "area_density")
    if body.mass_source == "MASS":
        column = layout.column()
        column.prop(body, "mass")
        column.prop(body, "use_center_of_mass")
        if body.use_center_of_mass:
            column.prop(body, "center_of_mass", text="")
        column.prop(body, "use_inertia")
        if body.use_inertia:
            column.prop(body, "inertia")
            column.prop(body, "products_of_inertia")


def _draw_wind(layout, wind):
    layout.prop(wind, "use_wind")
    if not wind.use_wind:
        return
    keyed = layout.column()
    keyed.use_property_decorate = True  # with a button for keys
    keyed.prop(wind, "wind_speed")
    keyed.prop(wind, "wind_direction")
    layout.prop(wind, "wind_profile")
    if wind.wind_profile != "NONE":
        layout.prop(wind, "wind_height")
        layout.prop(wind, "wind_roughness" if wind.wind_profile == "LOG" else "wind_exponent")
    keyed = layout.column()
    keyed.use_property_decorate = True
    keyed.prop(wind, "gust_speed")
    if wind.gust_speed > 0.0:
        layout.prop(wind, "gust_length")
        layout.prop(wind, "gust_spectrum")
        layout.prop(wind, "gust_seed")


class SAMARA_PT_bake(bpy.types.Panel):
    bl_label = "Mesh of the Bake"
    bl_parent_id = "SAMARA_PT_body"
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "physics"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        return context.object is not None and not context.object.samara.is_obstacle

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        body = context.object.samara
        layout.prop(body, "thickness")
        layout.prop(body, "keep")
        row = layout.row()
        row.active = not body.keep
        row.prop(body, "triangles")


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
        _draw_wind(layout, surroundings)
        layout.prop(surroundings, "seed")
        layout.prop(surroundings, "step")
        layout.prop(surroundings, "use_ground")
        if surroundings.use_ground:
            layout.prop(surroundings, "ground")
        layout.prop(surroundings, "bodies_meet")


CLASSES = (SAMARA_PT_body, SAMARA_PT_bake, SAMARA_PT_surroundings)
