"""Where Blender puts the joints of a BVH or GLB file; runs inside of Blender.

usage: blender --background --factory-startup --python blender_places.py -- FILE OUT.json SECONDS ...

Writes a list of {bone: [x, y, z]} in metres, Blender's axes (z up), one for each of the times. Those of GLB count from the
file's time 0, those of BVH from its first frame.
"""
import json
import sys

import bpy
import io_anim_bvh.import_bvh
import numpy

# Debian 12's Blender uses a name that Debian 12's numpy has no more, and a mode that its Python has no more.
numpy.bool = bool
io_anim_bvh.import_bvh.open = lambda path, mode: open(path)

FPS = 25


def places(armature):
    heads = {bone.name: armature.matrix_world @ bone.head for bone in armature.pose.bones}
    tails = {bone.name + "/tail": armature.matrix_world @ bone.tail for bone in armature.pose.bones}
    return {name: list(place) for name, place in {**heads, **tails}.items()}


def main(path, out, *seconds):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.fps = FPS
    if path.endswith(".bvh"):
        first_frame = 1
        bpy.ops.import_anim.bvh(filepath=path, global_scale=0.01, frame_start=first_frame, use_fps_scale=True)
    else:
        first_frame = 0
        bpy.ops.import_scene.gltf(filepath=path)
    armature = next(thing for thing in bpy.data.objects if thing.type == "ARMATURE")
    found = []
    for second in map(float, seconds):
        frame = first_frame + second * FPS
        scene.frame_set(int(frame + 1e-6), subframe=max(0.0, frame - int(frame + 1e-6)))
        found.append(places(armature))
    with open(out, "w") as file:
        json.dump({"places": found, "meshes": [len(mesh.vertices) for mesh in bpy.data.meshes]}, file)


main(*sys.argv[sys.argv.index("--") + 1:])
