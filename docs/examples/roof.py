"""The picture of docs/tutorials/roof.md: leaves and maple seeds on a roof, by a film camera with motion blur.

  blender -b --factory-startup --python roof.py -- ADD-ON.zip MOTION.glb PICTURE.png [FRAME [SAMARA.blend]]
"""

import math
import os
import random
import sys

import bpy
from mathutils import Vector

arguments = sys.argv[sys.argv.index("--") + 1 :]
zip_file, motion, picture = map(os.path.abspath, arguments[:3])
frame = int(arguments[3]) if len(arguments) > 3 else 84
scene = bpy.context.scene
for o in list(bpy.data.objects):
    bpy.data.objects.remove(o)

# 24 frames a second, before the import: it places the motion's keys by it, between the frames where they are.
scene.render.fps = 24
try:
    if bpy.ops.preferences.addon_install(filepath=zip_file) != {"FINISHED"}:
        raise RuntimeError("Blender cannot install it")
    if bpy.ops.preferences.addon_enable(module="samara_addon") != {"FINISHED"}:
        raise RuntimeError("Blender finds no module samara_addon")
except RuntimeError as error:
    reasons = [line for line in str(error).splitlines() if line and not line.startswith("Location:")]
    sys.exit(f"{zip_file}: the add-on is not enabled: {reasons[-1]}")
bpy.ops.import_scene.gltf(filepath=motion)
imported = list(bpy.context.selected_objects)
scene.frame_start, scene.frame_end = 1, 192


def material(name, colour, roughness=0.8):
    new = bpy.data.materials.new(name)
    new.use_nodes = True
    shader = new.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (*colour, 1.0)
    shader.inputs["Roughness"].default_value = roughness
    return new


# Each copy has a colour of its own; the mesh is shared.
autumn = [
    material("autumn", colour, 0.6)
    for colour in ((0.62, 0.11, 0.02), (0.75, 0.27, 0.02), (0.80, 0.45, 0.04), (0.35, 0.07, 0.02), (0.45, 0.32, 0.05))
]
seed = material("seed", (0.42, 0.26, 0.10), 0.7)
tiles = material("tiles", (0.20, 0.07, 0.045))
nodes, links = tiles.node_tree.nodes, tiles.node_tree.links
bricks, place = nodes.new("ShaderNodeTexBrick"), nodes.new("ShaderNodeTexCoord")
bricks.inputs["Scale"].default_value, bricks.inputs["Mortar Size"].default_value = 5.0, 0.012
for name, colour in (("Color1", (0.22, 0.075, 0.05)), ("Color2", (0.15, 0.055, 0.04)), ("Mortar", (0.05, 0.025, 0.02))):
    bricks.inputs[name].default_value = (*colour, 1.0)
links.new(place.outputs["Object"], bricks.inputs["Vector"])
links.new(bricks.outputs["Color"], nodes["Principled BSDF"].inputs["Base Color"])
draw = random.Random(1)
for o in imported:
    if o.type != "MESH":
        continue
    if not o.data.materials:
        o.data.materials.append(None)
    o.material_slots[0].link = "OBJECT"
    if o.name.startswith("leaf"):
        o.material_slots[0].material = draw.choice(autumn)
    elif o.name.startswith("samara"):
        o.material_slots[0].material = seed
    else:
        o.material_slots[0].material = tiles

# Walls under the roof, which the bodies did not know of: none comes there.
gable = [(-0.8, 0.0), (0.8, 0.0), (0.8, 0.5), (0.0, 0.98), (-0.8, 0.5)]
walls = bpy.data.meshes.new("walls")
walls.from_pydata(
    [(x, y, z) for x in (-0.85, 0.85) for y, z in gable],
    [],
    [[4, 3, 2, 1, 0], [5, 6, 7, 8, 9]] + [[i, (i + 1) % 5, 5 + (i + 1) % 5, 5 + i] for i in range(5)],
)
walls.materials.append(material("plaster", (0.62, 0.56, 0.46)))
scene.collection.objects.link(bpy.data.objects.new("walls", walls))
bpy.ops.mesh.primitive_plane_add(size=60.0, location=(0.0, 0.0, -0.002))
bpy.context.object.data.materials.append(material("lawn", (0.085, 0.105, 0.04), 0.95))

# A low sun behind the camera's left shoulder, and a pale sky.
bpy.ops.object.light_add(type="SUN", rotation=(math.radians(58), 0.0, math.radians(-38)))
sun = bpy.context.object.data
sun.energy, sun.color, sun.angle = 4.6, (1.0, 0.84, 0.64), math.radians(1.0)
sky = scene.world.node_tree.nodes["Background"].inputs
sky["Color"].default_value, sky["Strength"].default_value = (0.55, 0.68, 0.85, 1.0), 0.65

bpy.ops.object.camera_add(location=(-2.0, -3.0, 1.55))
camera = bpy.context.object
camera.rotation_euler = (Vector((0.08, -0.1, 0.93)) - camera.location).to_track_quat("-Z", "Y").to_euler()
camera.data.lens = 42.0
scene.camera = camera

scene.render.use_motion_blur = True
scene.render.motion_blur_shutter = 0.5  # of a frame: a film camera's 180 degrees
scene.render.engine = "CYCLES"  # the others need a screen
scene.cycles.samples = 96
scene.cycles.use_denoising = False
scene.view_settings.view_transform = "Filmic"
scene.view_settings.look = "Medium High Contrast"
scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 960, 540, 100
scene.render.image_settings.file_format = "JPEG" if picture.endswith((".jpg", ".jpeg")) else "PNG"
scene.render.image_settings.quality = 88
scene.render.filepath = picture
scene.frame_set(frame)
if len(arguments) > 4:
    bpy.ops.wm.save_as_mainfile(filepath=os.path.abspath(arguments[4]))
bpy.ops.render.render(write_still=True)
