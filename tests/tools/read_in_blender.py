"""Imports files into Blender and prints, as one line of JSON after "FOUND ", what arrived:

  blender -b --factory-startup --python read_in_blender.py -- FRAME_RATE LAST_FRAME motion.glb [a.chan ...]

For every object of the .glb, and for an empty with each .chan: its matrix in the world at every frame; for the objects also
the vertices of their mesh and its name, its materials and UVs. Channels are read with y up turned to z up and Nuke's rotation order.
"""

import json
import sys

import addon_utils
import bpy
import numpy

numpy.bool = bool  # Blender 3.4's importer uses a name that Debian's numpy 1.24 no longer has

frame_rate, last_frame, glb, *channels = sys.argv[sys.argv.index("--") + 1 :]
scene = bpy.context.scene
bpy.ops.object.select_all(action="SELECT")
bpy.ops.object.delete()
scene.render.fps = int(frame_rate)
scene.frame_end = int(last_frame)

bpy.ops.import_scene.gltf(filepath=glb)
objects = {o.name: o for o in scene.objects if o.type == "MESH"}

addon_utils.enable("io_anim_nuke_chan")
for file in channels:
    bpy.ops.object.empty_add()
    empty = bpy.context.object
    empty.rotation_mode = "QUATERNION"
    bpy.ops.import_scene.import_chan(filepath=file, z_up=True, rotation_order="ZXY")
    objects[file] = empty

found = {name: {"matrices": []} for name in objects}
for name, o in objects.items():
    if o.type == "MESH":
        found[name]["mesh"] = o.data.name
        found[name]["vertices"] = [list(v.co) for v in o.data.vertices]
        found[name]["materials"] = [slot.name for slot in o.material_slots]
        found[name]["images"] = [
            [node.image.name, *node.image.size]
            for slot in o.material_slots
            for node in slot.material.node_tree.nodes
            if node.type == "TEX_IMAGE"
        ]
        found[name]["slots"] = [polygon.material_index for polygon in o.data.polygons]
        found[name]["uvs"] = [list(place.uv) for layer in o.data.uv_layers for place in layer.data]
for frame in range(int(last_frame) + 1):
    scene.frame_set(frame)
    for name, o in objects.items():
        found[name]["matrices"].append([list(row) for row in o.matrix_world])
print("\nFOUND " + json.dumps({"fps": scene.render.fps, "version": bpy.app.version_string, "objects": found}))
