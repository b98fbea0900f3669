"""The film docs/pictures/leaves-on-roof.webp: a gust blows leaves and maple seeds onto a roof, at half their speed.

  samara simulate docs/scenes/roof-film.toml -o roof-film.h5
  samara export roof-film.h5 -o roof-film.glb
  blender -b --factory-startup --python docs/examples/roof_film.py -- ADD-ON.zip roof-film.glb FRAMES/
  img2webp -loop 0 -lossy -q 86 -m 6 -d 83 FRAMES/0*.png -d 1500 FRAMES/0100.png -o leaves-on-roof.webp

ADD-ON.zip is build/release/samara-blender-*.zip, img2webp is in Debian's package webp. A number after FRAMES/ renders
that frame alone. The noise of the few samples is taken out of all that neither a leaf nor its shadow touches: two
pictures without leaves, of few and of many samples, tell it, since every frame has the same noise.
"""

import math
import os
import random
import sys

import bpy
from mathutils import Vector

arguments = sys.argv[sys.argv.index("--") + 1 :]
zip_file, motion, folder = map(os.path.abspath, arguments[:3])
scene = bpy.context.scene
for o in list(bpy.data.objects):
    bpy.data.objects.remove(o)

# 24 frames a second, before the import, which places the motion's keys by it. Shown at 12 it is half the speed.
scene.render.fps = 24
scene.frame_start, scene.frame_end = 30, 100
try:
    if bpy.ops.preferences.addon_install(filepath=zip_file) != {"FINISHED"}:
        raise RuntimeError("Blender cannot install it")
    if bpy.ops.preferences.addon_enable(module="samara_addon") != {"FINISHED"}:
        raise RuntimeError("Blender finds no module samara_addon")
except RuntimeError as error:
    reasons = [line for line in str(error).splitlines() if line and not line.startswith("Location:")]
    sys.exit(f"{zip_file}: the add-on is not enabled: {reasons[-1]}")
bpy.ops.import_scene.gltf(filepath=motion)
imported = {o.name: o for o in bpy.context.selected_objects if o.type == "MESH"}
draw = random.Random(7)


class Material:
    """Nodes from textures to the principled shader, added one by one."""

    def __init__(self, name, colour=(0.5, 0.5, 0.5), roughness=0.8):
        self.material = bpy.data.materials.new(name)
        self.material.use_nodes = True
        self.tree = self.material.node_tree
        self.shader = self.tree.nodes["Principled BSDF"]
        self.set(self.shader, {"Base Color": (*colour, 1.0), "Roughness": roughness, "Specular": 0.25})

    def node(self, kind, inputs=(), **properties):
        node = self.tree.nodes.new("ShaderNode" + kind)
        for key, value in properties.items():
            setattr(node, key, value)
        self.set(node, dict(inputs))
        return node

    def set(self, node, inputs):
        for name, value in inputs.items():
            if isinstance(value, bpy.types.NodeSocket):
                self.tree.links.new(value, node.inputs[name])
            else:
                node.inputs[name].default_value = value

    def ramp(self, factor, *stops):
        node = self.node("ValToRGB", {"Fac": factor})
        elements = node.color_ramp.elements
        while len(elements) < len(stops):
            elements.new(1.0)
        for element, (position, colour) in zip(elements, stops):
            element.position, element.color = position, (*colour, 1.0)
        return node.outputs["Color"]

    def bump(self, height, strength, distance):
        bump = self.node("Bump", {"Height": height, "Strength": strength, "Distance": distance})
        self.set(self.shader, {"Normal": bump.outputs["Normal"]})


def mesh_object(name, vertices, faces, material):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(vertices, [], faces)
    mesh.materials.append(material)
    new = bpy.data.objects.new(name, mesh)
    scene.collection.objects.link(new)
    return new


def box(name, low, high, material):
    corners = [(x, y, z) for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])]
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return mesh_object(name, corners, faces, material)


# Leaves: each a colour of its own, with a pale midrib, and light shines through them.
leaf = Material("leaf", roughness=0.55)
chance = leaf.node("ObjectInfo").outputs["Random"]
colour = leaf.ramp(
    chance,
    (0.0, (0.30, 0.03, 0.015)),
    (0.25, (0.62, 0.09, 0.015)),
    (0.5, (0.80, 0.24, 0.02)),
    (0.75, (0.86, 0.46, 0.04)),
    (1.0, (0.62, 0.50, 0.08)),
)
place = leaf.node("SeparateXYZ", {"Vector": leaf.node("TexCoord").outputs["Object"]}).outputs
across = leaf.node("Math", {0: place["Y"]}, operation="ABSOLUTE").outputs[0]
rib = leaf.node("MapRange", {"Value": across, "From Min": 0.0004, "From Max": 0.0016, "To Min": 0.55, "To Max": 0.0})
spots = leaf.node("TexNoise", {"Vector": leaf.node("TexCoord").outputs["Object"], "Scale": 120.0})
mottled = leaf.node("MixRGB", {"Fac": 0.35, "Color1": colour, "Color2": spots.outputs["Fac"]}, blend_type="OVERLAY")
colour = leaf.node(
    "MixRGB", {"Fac": rib.outputs[0], "Color1": mottled.outputs[0], "Color2": (0.9, 0.62, 0.25, 1.0)}
).outputs[0]
leaf.set(leaf.shader, {"Base Color": colour})
through = leaf.node("BsdfTranslucent", {"Color": colour})
mix = leaf.node("MixShader", {0: 0.4, 1: leaf.shader.outputs[0], 2: through.outputs[0]})
leaf.set(leaf.tree.nodes["Material Output"], {"Surface": mix.outputs[0]})
seed = Material("seed", (0.46, 0.27, 0.10), 0.6)
for name, o in imported.items():
    if name.startswith(("leaf", "early", "samara")):
        o.data.materials.clear()
        o.data.materials.append((seed if name.startswith("samara") else leaf).material)
        o.data.use_auto_smooth = True
        for face in o.data.polygons:
            face.use_smooth = True

# Shingles on the courses of the roof that the leaves fall on: never above it, and each of another grey.
roof = imported["roof"]
courses = {}
for face in roof.data.polygons:
    corners = [roof.matrix_world @ roof.data.vertices[i].co for i in face.vertices]
    low, high = min(corners, key=lambda p: p.y), max(corners, key=lambda p: p.y)
    if 0.08 < (high - low).yz.length < 0.3:
        courses[round(low.y, 3)] = (Vector((0, low.y, low.z)), Vector((0, high.y, high.z)))
left, right = (f((roof.matrix_world @ v.co).x for v in roof.data.vertices) for f in (min, max))
vertices, faces, tints = [], [], []
for low, high in courses.values():
    along = (high - low).normalized()
    up = Vector((0, -along.z, along.y))
    x = left
    while x < right:
        width = draw.uniform(0.06, 0.15)
        edge, sunk, tint = draw.uniform(0.0, 0.005), draw.uniform(0.0, 0.0012), draw.random()
        first = len(vertices)
        for h in (-sunk, -0.012):
            for q, s in ((x + 0.0012, edge), (x + width - 0.0012, edge), (x + width - 0.0012, 0.128), (x + 0.0012, 0.128)):
                vertices.append(Vector((min(q, right), 0, 0)) + low + s * along + h * up)
        sides = [(0, 1, 2, 3), (0, 4, 5, 1), (1, 5, 6, 2), (3, 7, 4, 0)]
        faces += [[first + i for i in side] for side in sides]
        tints += [tint] * 4 * len(sides)
        x += width
wood = Material("shingles", roughness=0.85)
shingles = mesh_object("shingles", vertices, faces, wood.material)
attribute = shingles.data.color_attributes.new("tint", "FLOAT_COLOR", "CORNER")
for i, tint in enumerate(tints):
    attribute.data[i].color = (tint, tint, tint, 1.0)
tint = wood.node("VertexColor", layer_name="tint").outputs["Color"]
grain_place = wood.node("Mapping", {"Vector": wood.node("TexCoord").outputs["Object"], "Scale": (150.0, 8.0, 8.0)})
shifted = wood.node("VectorMath", {0: grain_place.outputs[0], 1: tint}, operation="ADD").outputs[0]
grain = wood.node("TexNoise", {"Vector": shifted, "Scale": 1.0, "Detail": 3.0}).outputs["Fac"]
colour = wood.ramp(
    tint, (0.0, (0.055, 0.062, 0.075)), (0.5, (0.105, 0.108, 0.118)), (0.85, (0.16, 0.15, 0.145)), (1.0, (0.175, 0.135, 0.105))
)
streaked = wood.node("MixRGB", {"Fac": 0.6, "Color1": colour, "Color2": grain}, blend_type="OVERLAY")
wood.set(wood.shader, {"Base Color": streaked.outputs[0]})
wood.bump(grain, 0.5, 0.002)
roof.data.materials.clear()
roof.data.materials.append(Material("underlay", (0.015, 0.014, 0.014)).material)
roof.location.z -= 0.006

# The chimney's bricks.
chimney = imported["chimney"]
brick = Material("brick", roughness=0.9)
uv = chimney.data.uv_layers.new(name="walls")
for loop in chimney.data.loops:
    p = chimney.matrix_world @ chimney.data.vertices[loop.vertex_index].co
    uv.data[loop.index].uv = (p.x + p.y, p.z)
texture = brick.node(
    "TexBrick",
    {
        "Vector": brick.node("UVMap", uv_map="walls").outputs[0],
        "Color1": (0.30, 0.085, 0.045, 1.0),
        "Color2": (0.19, 0.06, 0.04, 1.0),
        "Mortar": (0.30, 0.27, 0.23, 1.0),
        "Scale": 1.0,
        "Mortar Size": 0.0035,
        "Brick Width": 0.105,
        "Row Height": 0.038,
    },
)
brick.set(brick.shader, {"Base Color": texture.outputs["Color"]})
stone = Material("stone", (0.27, 0.255, 0.235)).material
chimney.data.materials.clear()
chimney.data.materials.append(brick.material)
chimney.data.materials.append(stone)
for face in chimney.data.polygons:
    if min((chimney.matrix_world @ chimney.data.vertices[i].co).z for i in face.vertices) > 2.8:
        face.material_index = 1

# A red house under the roof, which the bodies did not know of: none comes there.
eave, ridge = min(low.y for low, _ in courses.values()), max(high.z for _, high in courses.values())
foot = min(low.z for low, _ in courses.values())
boards = Material("boards", (0.26, 0.035, 0.022), 0.75)
stripes = boards.node("SeparateXYZ", {"Vector": boards.node("TexCoord").outputs["Object"]}).outputs["Y"]
saw = boards.node("Math", {0: stripes, 1: 0.09}, operation="PINGPONG").outputs[0]
boards.set(boards.shader, {"Base Color": boards.ramp(saw, (0.0, (0.06, 0.01, 0.008)), (0.06, (0.26, 0.035, 0.022)))})
white = Material("white", (0.72, 0.70, 0.66), 0.6).material
inner = [(eave + 0.10, 0.0), (-eave - 0.10, 0.0), (-eave - 0.10, foot + 0.02), (0.0, ridge - 0.05), (eave + 0.10, foot + 0.02)]
mesh_object(
    "walls",
    [(x, y, z) for x in (left + 0.10, right - 0.1) for y, z in inner],
    [[4, 3, 2, 1, 0], [5, 6, 7, 8, 9]] + [[i, (i + 1) % 5, 5 + (i + 1) % 5, 5 + i] for i in range(5)],
    boards.material,
)
for side in (-1.0, 1.0):  # the boards under the gable's edge, just below the shingles
    a, b = Vector((0, side * eave, foot - 0.012)), Vector((0, 0, ridge - 0.012))
    drop = Vector((0, 0, -0.085))
    ends = [a, b, b + drop, a + drop]
    mesh_object(
        "gable",
        [Vector((x, 0, 0)) + p for x in (left - 0.004, left + 0.022) for p in ends],
        [[0, 1, 2, 3], [7, 6, 5, 4]] + [[i, 4 + i, 4 + (i + 1) % 4, (i + 1) % 4] for i in range(4)],
        white,
    )
box("fascia", (left, eave + 0.006, foot - 0.09), (right, eave + 0.026, foot - 0.016), white)

# Trees in the distance, out of focus, in haze, and a meadow. One mesh: each object costs time in every frame.
bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=2, radius=1.0)
ball = bpy.context.object.data
bpy.data.objects.remove(bpy.context.object)
vertices, faces, tones = [], [], []
for _ in range(110):
    angle, distance = draw.uniform(-0.7, 1.2), draw.uniform(18.0, 45.0)
    haze = 0.05 + 0.5 * (distance - 18.0) / 27.0
    tree = draw.choice(((0.34, 0.08, 0.01), (0.45, 0.20, 0.02), (0.22, 0.17, 0.02), (0.26, 0.04, 0.01), (0.08, 0.11, 0.02)))
    tone = [(1.0 - haze) * c + haze * h for c, h in zip(tree, (0.60, 0.47, 0.36))]
    middle = Vector((distance * math.sin(angle), distance * math.cos(angle), 0.9))
    for _ in range(16):
        crown = middle + Vector((draw.gauss(0, 0.7), draw.gauss(0, 0.7), draw.triangular(-1.0, 2.2, 0.3)))
        first, radius = len(vertices), draw.uniform(0.2, 0.6)
        vertices += [crown + radius * v.co for v in ball.vertices]
        faces += [[first + k for k in face.vertices] for face in ball.polygons]
        tones += [(*tone, 1.0)] * len(ball.vertices)
foliage = Material("foliage", roughness=1.0)
foliage.set(foliage.shader, {"Base Color": foliage.node("VertexColor", layer_name="tone").outputs["Color"]})
trees = mesh_object("trees", vertices, faces, foliage.material).data
trees.polygons.foreach_set("use_smooth", [True] * len(faces))
trees.color_attributes.new("tone", "FLOAT_COLOR", "POINT").data.foreach_set("color", [c for t in tones for c in t])
bpy.ops.mesh.primitive_plane_add(size=200.0)
bpy.context.object.data.materials.append(Material("meadow", (0.17, 0.16, 0.05), 1.0).material)

# A low sun from the left, behind the house, so that leaves glow and cast long shadows; a sky warm at the horizon.
bpy.ops.object.light_add(type="SUN")
sun = bpy.context.object
sun.rotation_euler = Vector((-0.75, 0.02, 0.62)).to_track_quat("Z", "Y").to_euler()
sun.data.energy, sun.data.color, sun.data.angle = 7.5, (1.0, 0.77, 0.52), math.radians(1.2)
world = scene.world.node_tree
ramp = world.nodes.new("ShaderNodeValToRGB")
height = world.nodes.new("ShaderNodeSeparateXYZ")
world.links.new(world.nodes.new("ShaderNodeTexCoord").outputs["Generated"], height.inputs[0])
world.links.new(height.outputs["Z"], ramp.inputs["Fac"])
world.links.new(ramp.outputs["Color"], world.nodes["Background"].inputs["Color"])
ramp.color_ramp.elements.new(0.5)
for element, (position, colour) in zip(
    ramp.color_ramp.elements, ((0.0, (1.0, 0.70, 0.42)), (0.10, (0.42, 0.60, 0.85)), (0.5, (0.16, 0.34, 0.70)))
):
    element.position, element.color = position, (*colour, 1.0)
world.nodes["Background"].inputs["Strength"].default_value = 1.0
scene.world.cycles.sampling_method = "NONE"  # less noise: the sky is seen by bounces alone

bpy.ops.object.camera_add(location=(-1.95, -3.3, 2.98))
camera = bpy.context.object
camera.rotation_euler = (Vector((0.02, -0.45, 2.58)) - camera.location).to_track_quat("-Z", "Y").to_euler()
camera.data.lens = 58.0
camera.data.dof.use_dof, camera.data.dof.aperture_fstop = True, 1.1
camera.data.dof.focus_distance = (Vector((0.0, -0.6, 2.4)) - camera.location).length
scene.camera = camera

scene.render.engine = "CYCLES"
cycles = scene.cycles
cycles.use_denoising = cycles.use_adaptive_sampling = False  # Debian's Blender has no denoiser
cycles.max_bounces = 1
scene.render.use_motion_blur, scene.render.motion_blur_shutter = True, 0.5
scene.view_settings.view_transform = "Filmic"
scene.view_settings.exposure = 0.2
scene.view_settings.look = "Medium High Contrast"
scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 540, 360, 100
scene.render.use_persistent_data = True
if len(arguments) > 3:
    scene.frame_start = scene.frame_end = int(arguments[3])

# Without leaves: few samples and many.
few, many = 12, 72
flying = [o for name, o in imported.items() if name.startswith(("leaf", "early", "samara"))]
for o in flying:
    o.hide_render = True
scene.render.image_settings.file_format = "OPEN_EXR"
still = {}
for samples in (many, few):
    cycles.samples = samples
    scene.render.filepath = os.path.join(folder, f"still-{samples}.exr")
    bpy.ops.render.render(write_still=True)
    still[samples] = bpy.data.images.load(scene.render.filepath)
for o in flying:
    o.hide_render = False

# Each frame: with leaves + many - few.
scene.use_nodes = True
tree = scene.node_tree
value = tree.nodes["Render Layers"].outputs["Image"]
for samples, operation in ((many, "ADD"), (few, "SUBTRACT")):
    image = tree.nodes.new("CompositorNodeImage")
    image.image = still[samples]
    add = tree.nodes.new("CompositorNodeMixRGB")
    add.blend_type = operation
    tree.links.new(value, add.inputs[1])
    tree.links.new(image.outputs["Image"], add.inputs[2])
    value = add.outputs["Image"]
tree.links.new(value, tree.nodes["Composite"].inputs["Image"])
scene.render.image_settings.file_format, scene.render.image_settings.color_depth = "PNG", "8"
scene.render.filepath = os.path.join(folder, "")
bpy.ops.render.render(animation=True)
