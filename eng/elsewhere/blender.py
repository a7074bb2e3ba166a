# Opens a .glb in Blender and renders it through its own camera, with its own lights and an even sky:
# blender -b --python eng/elsewhere/blender.py -- FILE.glb IMAGE.png
import sys

import numpy

# Some packages of Blender's importer name types that newer versions of NumPy no longer have.
numpy.bool = bool

import bpy

source, image = sys.argv[sys.argv.index("--") + 1:]
bpy.ops.wm.read_factory_settings(use_empty=True)
# Lights of glTF are in lux; without units, 1 shows a white surface as bright as it does elsewhere.
names = bpy.ops.import_scene.gltf.get_rna_type().properties.keys()
mode = next(name for name in names if name.endswith("convert_lighting_mode"))
bpy.ops.import_scene.gltf(filepath=source, **{mode: "COMPAT"})

scene = bpy.context.scene
scene.camera = next(thing for thing in bpy.data.objects if thing.type == "CAMERA")
scene.render.engine = "CYCLES"
scene.cycles.samples = 32
scene.cycles.use_denoising = False
scene.render.resolution_x, scene.render.resolution_y = 480, 270
scene.view_settings.view_transform = "Standard"
scene.world = bpy.data.worlds.new("sky")
scene.world.use_nodes = True
scene.world.node_tree.nodes["Background"].inputs[0].default_value = (0.25, 0.25, 0.25, 1)
scene.render.filepath = image
bpy.ops.render.render(write_still=True)
print("faces:", sum(len(thing.data.polygons) for thing in bpy.data.objects if thing.type == "MESH"))
