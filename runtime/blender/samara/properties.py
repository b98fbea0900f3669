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


def _obstacles_changed(_, context):
    live.note_change(context.scene)


class SamaraBody(bpy.types.PropertyGroup):
    """The properties of an object's body."""

    body_file: StringProperty(
        name="Body File",
        description="NAME.body.h5 of samara: shape, added mass, tables. Its origin and axes are those of the object",
        subtype="FILE_PATH",
    )
    body_scale: FloatVectorProperty(
        description="The object's scale for which the body file was made", size=3, default=(1.0, 1.0, 1.0)
    )
    density: FloatProperty(
        name="Density", description="kg/m^3, uniform", default=1200.0, min=0.001, soft_max=20000.0, precision=1
    )
    mass_source: EnumProperty(
        name="Mass",
        description="How the body's mass is given",
        items=[
            ("FILE", "As Baked", "What the body file says; by the density where it says nothing"),
            ("DENSITY", "Density", "Uniform"),
            ("MASS", "Mass", "With a centre and moments of inertia of its own, where they are ticked"),
        ],
    )
    mass: FloatProperty(name="Mass", description="kg", default=0.001, min=1e-9, precision=6)
    use_center_of_mass: BoolProperty(name="Centre", description="Give the centre of mass; otherwise it is the centroid of the volume")
    center_of_mass: FloatVectorProperty(
        name="Centre", description="Centre of mass in the object's axes", subtype="TRANSLATION", size=3, precision=5
    )
    use_inertia: BoolProperty(name="Inertia", description="Give the inertia; otherwise the mass is uniform in the volume")
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
            ("AUTO", "Automatic", "What the body file holds: tables, else its surface's loads, else coefficients"),
            ("TABLE", "Tables", "The body file's tables, baked with OpenFOAM"),
            ("SURFACE", "Surface", "The pressure that potential flow tells of the surface, without CFD"),
            ("COEFFICIENTS", "Coefficients", "Drag and lift coefficients"),
        ],
    )
    drag_coefficient: FloatProperty(name="Drag", description="Drag coefficient", default=1.2, min=0.0)
    lift_coefficient: FloatProperty(name="Lift", description="Lift coefficient", default=0.6)
    noise: BoolProperty(
        name="Noise", description="Random loads by the turbulence in the body file's tables; needs tables", default=True
    )
    velocity: FloatVectorProperty(
        name="Velocity", description="Velocity of the centre of mass at the first frame", subtype="VELOCITY", size=3
    )
    angular_velocity: FloatVectorProperty(
        name="Angular Velocity", description="Angular velocity at the first frame: rad/s about the world's axes", size=3
    )
    release: FloatProperty(
        name="Release",
        description="Frames after the first one until which the body is held in place, or follows its keys and is released "
        "with their velocity",
        default=0.0, min=0.0, precision=1
    )
    returns: IntProperty(
        name="Return",
        description="Frames after the first one from which the object follows its keys again; 0: never",
        default=0,
        min=0,
    )
    return_blend: IntProperty(
        name="Blend", description="Frames before the return over which the motion is blended into the keys", default=12, min=1
    )
    is_obstacle: BoolProperty(
        name="Obstacle",
        description="Bodies land on this object's mesh, with modifiers, slide on it and fall off; it is not moved by them",
        update=_obstacles_changed,
    )
    friction: FloatProperty(
        name="Friction", description="Coulomb's coefficient of friction", default=0.5, min=0.0, soft_max=2.0,
        update=_obstacles_changed,
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
            ("CUSTOM", "Custom", "Density and viscosity of your own"),
        ],
    )
    fluid_density: FloatProperty(name="Fluid Density", description="kg/m^3", default=998.2, min=1e-6, precision=3)
    fluid_viscosity: FloatProperty(
        name="Viscosity", description="Dynamic viscosity, Pa s", default=1.002e-3, min=1e-9, precision=7
    )
    current: FloatVectorProperty(
        name="Current", description="Uniform and steady velocity of the fluid", subtype="VELOCITY", size=3
    )
    use_wind: BoolProperty(name="Wind", description="Wind in addition to the current, at the place of every body")
    wind_speed: FloatProperty(name="Speed", description="Speed of the mean wind", default=3.0, min=0.0)
    wind_direction: FloatVectorProperty(
        name="Direction", description="Direction in which the wind blows", subtype="XYZ", size=3, default=(1.0, 0.0, 0.0)
    )
    wind_profile: EnumProperty(
        name="Profile",
        description="The profile of the mean wind over the height above the ground",
        items=[
            ("NONE", "Uniform", "The same everywhere"),
            ("LOG", "Logarithmic", "Over rough ground"),
            ("POWER", "Power Law", "By an exponent"),
        ],
    )
    wind_height: FloatProperty(
        name="Height", description="Height above the ground at which the wind has its speed", subtype="DISTANCE", default=10.0, min=1e-3
    )
    wind_roughness: FloatProperty(
        name="Roughness", description="Roughness length z0: 0.03 m for grass, 1 m for a town", subtype="DISTANCE",
        default=0.03, min=1e-6, precision=4,
    )
    wind_exponent: FloatProperty(name="Exponent", default=0.14, min=1e-3, max=1.0, precision=3)
    gust_speed: FloatProperty(name="Gusts", description="Root mean square of each component of the gusts; 0: none", default=0.0, min=0.0)
    gust_length: FloatProperty(name="Size", description="Length of the gusts along the wind", subtype="DISTANCE", default=1.0, min=1e-4)
    gust_spectrum: EnumProperty(
        name="Spectrum",
        items=[("VON_KARMAN", "von Karman", "Free turbulence"), ("KAIMAL", "Kaimal", "Near the ground")],
    )
    gust_seed: IntProperty(name="Gust Seed", description="Another seed gives other gusts of the same strength", default=1, min=0)
    use_ground: BoolProperty(name="Ground", description="Level ground, on which bodies come to rest")
    ground: FloatProperty(name="Height", description="Height of the ground", subtype="DISTANCE")
    bodies_meet: BoolProperty(  # the name that .blend files keep
        name="Bodies Collide",
        description="Bodies that are simulated together, live or by one Simulate to Keyframes, collide with each other",
    )
    seed: IntProperty(
        name="Seed", description="Seed of the noise; objects with different names have different noise", default=1, min=0
    )
    step: FloatProperty(
        name="Step", description="Time step in seconds, whatever the frame rate", default=0.002, min=1e-5, max=0.1, precision=4
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
