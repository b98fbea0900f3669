"""The tutorial of docs/reference/blender.md by script: a hundred leaves fall, as keys, and one frame is rendered.

  blender -b --factory-startup --python hundred_leaves.py -- ADD-ON.zip leaf.body.h5 PICTURE.png [LEAVES.blend]
"""

import os
import sys

import bpy

zip_file, body_file, picture, *blend_file = map(os.path.abspath, sys.argv[sys.argv.index("--") + 1 :])
try:
    if bpy.ops.preferences.addon_install(filepath=zip_file) != {"FINISHED"}:
        raise RuntimeError("Blender cannot install it")
    if bpy.ops.preferences.addon_enable(module="samara_addon") != {"FINISHED"}:
        raise RuntimeError("Blender finds no module samara_addon")
except RuntimeError as error:
    reasons = [line for line in str(error).splitlines() if line and not line.startswith("Location:")]
    sys.exit(f"{zip_file}: the add-on is not enabled: {reasons[-1]}")
scene = bpy.context.scene
for name in ("Cube", "Light", "Camera"):
    bpy.data.objects.remove(bpy.data.objects[name])

# The leaves: Add > samara Bodies.
scene.cursor.location = (0.0, 0.0, 1.6)
bpy.ops.samara.add_bodies(filepath=body_file, count=100, spread=(0.6, 0.4, 0.5), turn=True, density=600.0)

# The air and the floor: Physics > samara > Scene.
scene.samara.fluid = "AIR"
scene.samara.use_ground = True
scene.samara.ground = 0.0
scene.frame_end = 72
bpy.ops.samara.simulate()

# What one sees.
def coloured(o, colour):
    material = bpy.data.materials.new(o.name)
    material.use_nodes = True
    material.node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = colour
    o.data.materials.append(material)


coloured(bpy.data.objects["leaf"], (0.7, 0.2, 0.02, 1.0))
bpy.ops.mesh.primitive_plane_add(size=40.0, location=(0.0, 0.0, 0.0))
coloured(bpy.context.object, (0.4, 0.38, 0.32, 1.0))
scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.35, 0.45, 0.6, 1.0)
bpy.ops.object.light_add(type="SUN", rotation=(0.7, 0.5, 0.0))
bpy.context.object.data.energy = 2.0
bpy.ops.object.camera_add(location=(0.0, -2.0, 1.0), rotation=(1.27, 0.0, 0.0))
scene.camera = bpy.context.object

scene.render.engine = "CYCLES"  # the others need a screen
scene.cycles.samples = 64
scene.cycles.use_denoising = False
scene.view_settings.view_transform = "Standard"
scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 520, 325, 100
scene.render.dither_intensity = 0.0
scene.render.image_settings.compression = 100
scene.render.filepath = picture
scene.frame_set(25)
bpy.ops.render.render(write_still=True)
if blend_file:
    bpy.ops.wm.save_as_mainfile(filepath=blend_file[0])
