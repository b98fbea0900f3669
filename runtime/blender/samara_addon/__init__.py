"""samara in Blender: bodies that fall, flutter and tumble, as keyframes or live."""

bl_info = {
    "name": "samara",
    "author": "samara",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "Properties > Physics > samara, and Add > samara Bodies",
    "description": "Rigid bodies that fall, flutter and tumble through water or air",
    "category": "Physics",
}

import bpy

try:
    import numpy  # Debian's Blender comes without it
except ImportError:
    raise ImportError("samara needs numpy in Blender's Python; on Debian: apt install python3-numpy") from None

if not hasattr(numpy, "bool"):
    numpy.bool = bool  # Blender 3.4's .glb importer uses numpy.bool, which numpy 1.24 to 1.26 does not have

from . import add_bodies, bake, live, panel, properties, simulate

_CLASSES = bake.CLASSES + simulate.CLASSES + add_bodies.CLASSES + panel.CLASSES


def register():
    properties.register()
    for c in _CLASSES:
        bpy.utils.register_class(c)
    add_bodies.register()
    live.register()


def unregister():
    live.unregister()
    add_bodies.unregister()
    for c in reversed(_CLASSES):
        bpy.utils.unregister_class(c)
    properties.unregister()
