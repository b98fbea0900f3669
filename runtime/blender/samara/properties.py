"""What the add-on stores with objects and scenes."""

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


class SamaraBody(bpy.types.PropertyGroup):
    """The body of an object."""

    body_file: StringProperty(
        name="Body File",
        description="NAME.body.h5 of samara: shape, added mass, tables. The origin and axes are the object's",
        subtype="FILE_PATH",
    )
    body_scale: FloatVectorProperty(
        description="The object's scale for which the body file was made", size=3, default=(1.0, 1.0, 1.0)
    )
    density: FloatProperty(
        name="Density", description="kg/m^3, uniform", default=1200.0, min=0.001, soft_max=20000.0, precision=1
    )
    loads: EnumProperty(
        name="Loads",
        description="Where drag, lift and moments come from",
        items=[
            ("AUTO", "Automatic", "Tables where the body file has them, else coefficients"),
            ("TABLE", "Tables", "The body file's tables, baked with OpenFOAM"),
            ("COEFFICIENTS", "Coefficients", "Drag and lift coefficients"),
        ],
    )
    drag_coefficient: FloatProperty(name="Drag", description="Drag coefficient", default=1.2, min=0.0)
    lift_coefficient: FloatProperty(name="Lift", description="Lift coefficient", default=0.6)
    noise: BoolProperty(
        name="Noise", description="Shakes by the turbulence of the body file's tables; needs tables", default=True
    )
    velocity: FloatVectorProperty(
        name="Velocity", description="At the first frame, of the centre of mass", subtype="VELOCITY", size=3
    )
    angular_velocity: FloatVectorProperty(
        name="Angular Velocity", description="At the first frame: rad/s about the world's axes", size=3
    )
    live: BoolProperty(description="Whether the object follows its simulation at every frame change")
    live_error: StringProperty(description="Why it no longer does")
    start_location: FloatVectorProperty(size=3)
    start_rotation: FloatVectorProperty(size=4, default=(1.0, 0.0, 0.0, 0.0))
    start_rotation_mode: StringProperty(default="XYZ")


class SamaraSurroundings(bpy.types.PropertyGroup):
    """What all bodies of a scene share."""

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
        name="Viscosity", description="Dynamic, Pa s", default=1.002e-3, min=1e-9, precision=7
    )
    current: FloatVectorProperty(
        name="Current", description="Of the fluid, uniform and steady", subtype="VELOCITY", size=3
    )
    use_ground: BoolProperty(name="Ground", description="Level ground, on which bodies come to rest")
    ground: FloatProperty(name="Height", description="Of the ground", subtype="DISTANCE")
    seed: IntProperty(
        name="Seed", description="Of the noise; objects differ in it by their names", default=1, min=0
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
