"""The properties that the add-on stores with objects and scenes."""

import bpy
from bpy.props import (
    BoolProperty,
    EnumProperty,
    FloatProperty,
    FloatVectorProperty,
    IntProperty,
    PointerProperty,
    StringProperty,
)

from . import live
from .ready_bodies import ready_body
from .samara_library import SamaraError


def _obstacles_changed(_, context):
    live.note_change(context.scene)


def _body_file_changed(body, context):
    """Takes up the density of a ready-baked body, and its fluid where it is the scene's first body."""
    try:
        ready = ready_body(body.body_file)
    except SamaraError:
        return  # shown in the panel
    if ready is None:
        return
    if not body.is_property_set("density"):
        body.density = ready.density
    if not any(o.samara.body_file for o in context.scene.objects if o != body.id_data):
        context.scene.samara.fluid = ready.fluid


class SamaraBody(bpy.types.PropertyGroup):
    """The properties of an object's body."""

    body_file: StringProperty(
        name="Body File",
        description="samara's body file NAME.body.h5: shape, added mass, tables; or a ready-baked body, such as samara:leaf. "
        "Its origin and axes are those of the object",
        subtype="FILE_PATH",
        update=_body_file_changed,
    )
    body_scale: FloatVectorProperty(
        description="The object's scale for which the body file was made", size=3, default=(1.0, 1.0, 1.0)
    )
    density: FloatProperty(
        name="Density", description="Uniform density, kg/m^3", default=1200.0, min=0.001, soft_max=20000.0, precision=1
    )
    mass_source: EnumProperty(
        name="Mass",
        description="How the body's mass is defined",
        items=[
            ("FILE", "As Baked", "The mass in the body file; a uniform density if the file has none"),
            ("DENSITY", "Density", "A uniform density"),
            ("AREA", "Area", "A mass by area, as of paper and leaves; objects of other sizes keep the thickness"),
            ("MASS", "Mass", "A mass, optionally with its centre and moments of inertia"),
        ],
    )
    area_density: FloatProperty(
        name="Mass by Area", description="g/m^2 of half of the surface", default=80.0, min=0.001, soft_max=1000.0, precision=1
    )
    mass: FloatProperty(name="Mass", description="kg", default=0.001, min=1e-9, precision=6)
    use_center_of_mass: BoolProperty(name="Centre", description="Set the centre of mass; otherwise it is the centroid of the volume")
    center_of_mass: FloatVectorProperty(
        name="Centre", description="Centre of mass in the object's axes", subtype="TRANSLATION", size=3, precision=5
    )
    use_inertia: BoolProperty(name="Inertia", description="Set the inertia; otherwise the density is uniform")
    inertia: FloatVectorProperty(
        name="Moments", description="xx, yy, zz about the centre of mass, kg m^2", size=3, min=0.0, precision=9, step=0.0001
    )
    products_of_inertia: FloatVectorProperty(
        name="Products", description="xy, xz, yz of the inertia tensor, kg m^2", size=3, precision=9, step=0.0001
    )
    loads: EnumProperty(
        name="Loads",
        description="The source of drag, lift and moments",
        items=[
            ("AUTO", "Automatic", "What the body file recommends, otherwise its tables, otherwise surface loads, otherwise coefficients"),
            ("TABLE", "Tables", "The body file's tables, baked with OpenFOAM"),
            ("SURFACE", "Surface", "Forces estimated from potential flow, without CFD"),
            ("COEFFICIENTS", "Coefficients", "Drag and lift coefficients"),
        ],
    )
    drag_coefficient: FloatProperty(name="Drag", description="Drag coefficient", default=1.2, min=0.0)
    lift_coefficient: FloatProperty(name="Lift", description="Lift coefficient", default=0.6)
    patches: IntProperty(
        name="Patches",
        description="Patches of the surface, each with the loads of its own velocity, for bodies that spin; "
        "0: as the body file recommends, otherwise 1",
        default=0, min=0, max=32
    )
    noise: BoolProperty(
        name="Noise", description="Random loads from the turbulence of the wake", default=True
    )
    velocity: FloatVectorProperty(
        name="Velocity", description="Velocity of the centre of mass at the first frame", subtype="VELOCITY", size=3
    )
    angular_velocity: FloatVectorProperty(
        name="Angular Velocity", description="Angular velocity at the first frame: rad/s about the world's axes", size=3
    )
    release: FloatProperty(
        name="Release",
        description="Number of frames, from the first, during which the body is held or follows its keys. It is then released "
        "with the velocity of the keys",
        default=0.0, min=0.0, precision=1
    )
    returns: IntProperty(
        name="Return",
        description="Keyframes take over at this frame, counted from the first one; 0: never",
        default=0,
        min=0,
    )
    return_blend: IntProperty(
        name="Blend", description="Number of frames before the return over which the motion is blended into the keys", default=12, min=1
    )
    is_obstacle: BoolProperty(
        name="Obstacle",
        description="Bodies collide with this object's mesh, with modifiers; they do not move it",
        update=_obstacles_changed,
    )
    friction: FloatProperty(
        name="Friction", description="Coulomb friction coefficient", default=0.5, min=0.0, soft_max=2.0,
        update=_obstacles_changed,
    )
    keep: BoolProperty(
        name="Keep Triangles", description="Bake with the mesh's own triangles; otherwise samara meshes the shape again"
    )
    triangles: IntProperty(
        name="Triangles", description="About how many the baked body has; 0: as many as the shape needs", default=0, min=0, max=1000000
    )
    thickness: FloatProperty(
        name="Thickness", description="Makes an open sheet a body of this thickness, of which it is the middle; 0: the mesh is closed",
        subtype="DISTANCE", default=0.0, min=0.0, precision=5, step=0.01
    )
    live: BoolProperty(description="Whether the object follows its simulation at every frame change")
    live_error: StringProperty(description="Why the object no longer follows its simulation")
    start_location: FloatVectorProperty(size=3)
    start_rotation: FloatVectorProperty(size=4, default=(1.0, 0.0, 0.0, 0.0))
    start_rotation_mode: StringProperty(default="XYZ")


class SamaraSurroundings(bpy.types.PropertyGroup):
    """The properties that all bodies of a scene share."""

    fluid: EnumProperty(
        name="Fluid",
        items=[
            ("WATER", "Water", "998.2 kg/m^3, 1.002e-3 Pa s"),
            ("AIR", "Air", "1.204 kg/m^3, 1.825e-5 Pa s"),
            ("CUSTOM", "Custom", "Your own density and viscosity"),
        ],
    )
    fluid_density: FloatProperty(name="Fluid Density", description="kg/m^3", default=998.2, min=1e-6, precision=3)
    fluid_viscosity: FloatProperty(
        name="Viscosity", description="Dynamic viscosity, Pa s", default=1.002e-3, min=1e-9, precision=7
    )
    current: FloatVectorProperty(
        name="Current", description="Uniform and steady velocity of the fluid", subtype="VELOCITY", size=3
    )
    use_wind: BoolProperty(name="Wind", description="The scene's wind, in addition to the current")
    wind_speed: FloatProperty(name="Speed", description="Speed of the mean wind", default=3.0, min=0.0)
    wind_direction: FloatVectorProperty(
        name="Direction", description="Direction in which the wind blows", subtype="XYZ", size=3, default=(1.0, 0.0, 0.0)
    )
    wind_profile: EnumProperty(
        name="Profile",
        description="Profile of the mean wind with height above the ground",
        items=[
            ("NONE", "Uniform", "The same speed everywhere"),
            ("LOG", "Logarithmic", "Logarithmic profile over rough ground"),
            ("POWER", "Power Law", "Power-law profile with an exponent"),
        ],
    )
    wind_height: FloatProperty(
        name="Height", description="Height above the ground at which Speed applies", subtype="DISTANCE", default=10.0, min=1e-3
    )
    wind_roughness: FloatProperty(
        name="Roughness", description="Roughness length z0: 0.03 m for grass, 1 m for a town", subtype="DISTANCE",
        default=0.03, min=1e-6, precision=4,
    )
    wind_exponent: FloatProperty(name="Exponent", default=0.14, min=1e-3, max=1.0, precision=3)
    gust_speed: FloatProperty(name="Gusts", description="Root mean square of each component of the gusts; 0: none", default=0.0, min=0.0)
    gust_length: FloatProperty(name="Size", description="Length scale of the gusts along the wind", subtype="DISTANCE", default=1.0, min=1e-4)
    gust_spectrum: EnumProperty(
        name="Spectrum",
        items=[("VON_KARMAN", "von Karman", "Free turbulence"), ("KAIMAL", "Kaimal", "Near the ground")],
    )
    gust_seed: IntProperty(name="Gust Seed", description="Seed of the gusts", default=1, min=0)
    use_ground: BoolProperty(name="Ground", description="Level ground, on which bodies come to rest")
    ground: FloatProperty(name="Height", description="Height of the ground", subtype="DISTANCE")
    bodies_meet: BoolProperty(  # the name that .blend files keep
        name="Bodies Collide",
        description="Bodies that are simulated together collide with each other",
    )
    seed: IntProperty(
        name="Seed", description="Seed of the noise; objects with different names get different noise", default=1, min=0
    )
    step: FloatProperty(
        name="Step", description="Time step in seconds, independent of the frame rate", default=0.002, min=1e-5, max=0.1, precision=4
    )


CLASSES = (SamaraBody, SamaraSurroundings)


def register():
    for c in CLASSES:
        bpy.utils.register_class(c)
    bpy.types.Object.samara = PointerProperty(type=SamaraBody)
    bpy.types.Scene.samara = PointerProperty(type=SamaraSurroundings)


def unregister():
    del bpy.types.Scene.samara
    del bpy.types.Object.samara
    for c in reversed(CLASSES):
        bpy.utils.unregister_class(c)
