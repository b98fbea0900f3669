"""The tutorial docs/tutorials/blender.md by script: a hundred leaves fall, as keys, and one frame is rendered.

  blender -b --factory-startup --python hundred_leaves.py -- ADD-ON.zip PICTURE [LEAVES.blend]
"""

import math
import os
import random
import sys

import bpy
from mathutils import Vector

zip_file, picture, *blend_file = map(os.path.abspath, sys.argv[sys.argv.index("--") + 1 :])
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

# The leaves, which bring air with them: Add > samara Bodies > Leaf; then Mass: Density, of dry ones: 200 kg/m^3 are 60 g/m^2.
scene.cursor.location = (0.0, 0.0, 1.6)
bpy.ops.samara.add_bodies(ready="leaf", count=100, spread=(0.6, 0.4, 0.5), turn=True, density=200.0)
leaves = list(bpy.context.selected_objects)
for leaf in leaves:
    leaf.samara.mass_source = "DENSITY"

# The floor: Physics > samara > Scene.
scene.samara.use_ground = True
scene.samara.ground = 0.0
scene.frame_end = 72
bpy.ops.samara.simulate()


# What one sees: each leaf in one of five colours, and light shines through it.
def material(name, colour, roughness=0.8, through=0.0):
    new = bpy.data.materials.new(name)
    new.use_nodes = True
    nodes, links = new.node_tree.nodes, new.node_tree.links
    shader = nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (*colour, 1.0)
    shader.inputs["Roughness"].default_value = roughness
    if through:
        translucent, mix = nodes.new("ShaderNodeBsdfTranslucent"), nodes.new("ShaderNodeMixShader")
        translucent.inputs["Color"].default_value = (*colour, 1.0)
        mix.inputs[0].default_value = through
        links.new(shader.outputs[0], mix.inputs[1])
        links.new(translucent.outputs[0], mix.inputs[2])
        links.new(mix.outputs[0], nodes["Material Output"].inputs["Surface"])
    return new


autumn = [
    material("autumn", colour, 0.5, 0.4)
    for colour in ((0.55, 0.05, 0.02), (0.72, 0.16, 0.02), (0.82, 0.33, 0.02), (0.85, 0.55, 0.06), (0.40, 0.36, 0.06))
]
leaves[0].data.materials.append(None)  # a slot; the leaves share one mesh
draw = random.Random(3)
for leaf in leaves:
    leaf.material_slots[0].link = "OBJECT"
    leaf.material_slots[0].material = draw.choice(autumn)

# A floor of boards: a brick texture whose bricks are 80 m long, with a grain.
boards = material("boards", (0.3, 0.2, 0.1), 0.5)
nodes, links = boards.node_tree.nodes, boards.node_tree.links
nodes["Principled BSDF"].inputs["Specular"].default_value = 0.15
bricks, place, streaks, grain, mix = (nodes.new("ShaderNode" + kind) for kind in ("TexBrick", "TexCoord", "Mapping", "TexNoise", "MixRGB"))
for name, value in (("Scale", 1.0), ("Brick Width", 80.0), ("Row Height", 0.12), ("Mortar Size", 0.002), ("Mortar Smooth", 0.1)):
    bricks.inputs[name].default_value = value
for name, colour in (("Color1", (0.15, 0.085, 0.045)), ("Color2", (0.065, 0.036, 0.02)), ("Mortar", (0.015, 0.01, 0.008))):
    bricks.inputs[name].default_value = (*colour, 1.0)
streaks.inputs["Scale"].default_value = (2.5, 60.0, 1.0)
grain.inputs["Scale"].default_value, grain.inputs["Detail"].default_value = 1.0, 4.0
mix.blend_type, mix.inputs["Fac"].default_value = "OVERLAY", 0.8
links.new(place.outputs["Object"], bricks.inputs["Vector"])
links.new(place.outputs["Object"], streaks.inputs["Vector"])
links.new(streaks.outputs[0], grain.inputs["Vector"])
links.new(bricks.outputs["Color"], mix.inputs["Color1"])
links.new(grain.outputs["Fac"], mix.inputs["Color2"])
links.new(mix.outputs[0], nodes["Principled BSDF"].inputs["Base Color"])
bpy.ops.mesh.primitive_plane_add(size=60.0, location=(0.03, 0.0, 0.0), rotation=(0.0, 0.0, math.radians(90)))
bpy.context.object.data.materials.append(boards)

# A low sun behind the leaves on the left, and a sky that is bright at the horizon.
bpy.ops.object.light_add(type="SUN")
sun = bpy.context.object
sun.rotation_euler = Vector((-0.7, 0.5, 0.45)).to_track_quat("Z", "Y").to_euler()
sun.data.energy, sun.data.color, sun.data.angle = 6.0, (1.0, 0.80, 0.56), math.radians(1.5)
world = scene.world.node_tree
ramp, height = world.nodes.new("ShaderNodeValToRGB"), world.nodes.new("ShaderNodeSeparateXYZ")
world.links.new(world.nodes.new("ShaderNodeTexCoord").outputs["Generated"], height.inputs[0])
world.links.new(height.outputs["Z"], ramp.inputs["Fac"])
world.links.new(ramp.outputs["Color"], world.nodes["Background"].inputs["Color"])
ramp.color_ramp.elements[0].color = (0.58, 0.52, 0.46, 1.0)
ramp.color_ramp.elements[1].position, ramp.color_ramp.elements[1].color = 0.22, (0.10, 0.20, 0.40, 1.0)
scene.world.cycles.sampling_method = "NONE"

bpy.ops.object.camera_add(location=(0.0, -1.9, 0.74))
camera = bpy.context.object
camera.rotation_euler = (Vector((0.0, 0.0, 0.36)) - camera.location).to_track_quat("-Z", "Y").to_euler()
camera.data.lens = 44.0
camera.data.dof.use_dof, camera.data.dof.focus_distance, camera.data.dof.aperture_fstop = True, 1.75, 2.8
scene.camera = camera

scene.render.engine = "CYCLES"  # the others need a screen
scene.cycles.samples = 48
scene.cycles.max_bounces = 2
scene.cycles.use_denoising = False  # Debian's Blender has no denoiser
scene.render.use_motion_blur, scene.render.motion_blur_shutter = True, 0.15
scene.view_settings.view_transform = "Filmic"
scene.view_settings.look = "Medium High Contrast"
scene.view_settings.exposure = 0.5
scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 1280, 640, 100
scene.render.image_settings.file_format = "JPEG" if picture.endswith((".jpg", ".jpeg")) else "PNG"
scene.render.image_settings.quality = 88
scene.render.filepath = picture
scene.frame_set(34)
if blend_file:
    bpy.ops.wm.save_as_mainfile(filepath=blend_file[0])
bpy.ops.render.render(write_still=True)
