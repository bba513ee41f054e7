# SPDX-License-Identifier: Apache-2.0
"""A live body of mocapd in Blender: an armature that moves as the person in the studio does.

Install it under Edit > Preferences > Add-ons > Install, and press Start in the tab mocapd of the 3D view's sidebar (key N). On
the host of mocapd, send the poses here:

    mocap stream osc --to THIS-HOST:39539

It listens to the VMC protocol (OSC over UDP). The armature has the person's sizes and the names of Unity's bones, and faces -y
when the person faces x in the studio, as imported BVH and glTF do.
"""
import math
import socket
import struct

import bpy
from mathutils import Matrix, Quaternion, Vector

bl_info = {
    "name": "mocapd live",
    "author": "mocapd maintainers",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "3D View > Sidebar > mocapd",
    "description": "Moves an armature like the person that mocapd tracks",
    "category": "Animation",
}

PORT = 39539
PERIOD_S = 1 / 60
MOST_NESTED = 4
SHORTEST_BONE = 0.01  # Blender removes bones of zero length.

# The parent of each bone; parents come first.
PARENTS = {
    "Hips": None, "Spine": "Hips", "Chest": "Spine", "Neck": "Chest", "Head": "Neck",
    "LeftShoulder": "Chest", "LeftUpperArm": "LeftShoulder", "LeftLowerArm": "LeftUpperArm", "LeftHand": "LeftLowerArm",
    "RightShoulder": "Chest", "RightUpperArm": "RightShoulder", "RightLowerArm": "RightUpperArm", "RightHand": "RightLowerArm",
    "LeftUpperLeg": "Hips", "LeftLowerLeg": "LeftUpperLeg", "LeftFoot": "LeftLowerLeg", "LeftToes": "LeftFoot",
    "RightUpperLeg": "Hips", "RightLowerLeg": "RightUpperLeg", "RightFoot": "RightLowerLeg", "RightToes": "RightFoot",
}
# Where a bone is drawn to, without effect on its rotation: the next joint, or at the end of a limb a direction and a share of the bone before.
NEXT = {"Hips": "Spine", "Spine": "Chest", "Chest": "Neck", "Neck": "Head", "LeftShoulder": "LeftUpperArm",
        "LeftUpperArm": "LeftLowerArm", "LeftLowerArm": "LeftHand", "RightShoulder": "RightUpperArm",
        "RightUpperArm": "RightLowerArm", "RightLowerArm": "RightHand", "LeftUpperLeg": "LeftLowerLeg",
        "LeftLowerLeg": "LeftFoot", "LeftFoot": "LeftToes", "RightUpperLeg": "RightLowerLeg", "RightLowerLeg": "RightFoot",
        "RightFoot": "RightToes"}
ENDS = {"Head": (Vector((0, 0, 1)), 1.5), "LeftHand": (Vector((1, 0, 0)), 0.7), "RightHand": (Vector((-1, 0, 0)), 0.7),
        "LeftToes": (Vector((0, -1, 0)), 0.5), "RightToes": (Vector((0, -1, 0)), 0.5)}

# Unity is left-handed with x right, y up and z forward. Here x is the person's left and y points backwards.
BLENDER_FROM_UNITY = Matrix(((-1, 0, 0), (0, 0, -1), (0, 1, 0)))


def osc_text(packet, place):
    end = packet.index(b"\0", place)
    return packet[place:end].decode("utf-8", "replace"), end // 4 * 4 + 4


def osc_messages(packet, depth=0):
    """Yields address and arguments of each message of a packet. Raises ValueError or struct.error for what is none."""
    if packet.startswith(b"#bundle\0"):
        if depth > MOST_NESTED:
            raise ValueError("bundles in bundles")
        place = 16
        while place < len(packet):
            size, = struct.unpack_from(">i", packet, place)
            if not 0 < size <= len(packet) - place - 4:
                raise ValueError("an element that is longer than its bundle")
            yield from osc_messages(packet[place + 4:place + 4 + size], depth + 1)
            place += 4 + size
        return
    address, place = osc_text(packet, 0)
    types, place = osc_text(packet, place)
    arguments = []
    for kind in types[1:]:
        if kind == "s":
            value, place = osc_text(packet, place)
        else:
            if kind not in "if":
                raise ValueError("a type that the protocol has not")
            value, = struct.unpack_from(">" + kind, packet, place)
            place += 4
        arguments.append(value)
    yield address, arguments


class Receiver:
    """Hears the protocol and keeps the newest pose that is whole."""

    def __init__(self, port):
        # Of IPv6 and IPv4, where the system has both.
        is_both = socket.has_dualstack_ipv6()
        self.udp = socket.socket(socket.AF_INET6 if is_both else socket.AF_INET, socket.SOCK_DGRAM)
        try:
            if is_both:
                self.udp.setsockopt(socket.IPPROTO_IPV6, socket.IPV6_V6ONLY, 0)
            self.udp.bind(("", port))
        except OSError:
            self.udp.close()
            raise
        self.udp.setblocking(False)
        self.is_tracked = False
        self.time_s = 0.0
        self.coming = {}
        self.pose = None  # The transform of each bone from its parent, in Blender's axes.
        self.pose_time_s = None

    def close(self):
        self.udp.close()

    def poll(self):
        """Takes all that has come; tells whether there is a new pose."""
        before = self.pose_time_s
        while True:
            try:
                packet = self.udp.recv(65536)
            except BlockingIOError:
                return self.pose_time_s != before
            try:
                for address, arguments in osc_messages(packet):
                    self.take(address, arguments)
            except (ValueError, struct.error):
                continue  # From another sender.

    def take(self, address, arguments):
        if address == "/VMC/Ext/OK":
            self.is_tracked = arguments[-1:] == [1]
            self.coming = {}
        elif address == "/VMC/Ext/T" and are_numbers(arguments[:1], 1):
            self.time_s = arguments[0]
        elif address == "/VMC/Ext/Bone/Pos" and arguments[:1] and arguments[0] in PARENTS and are_numbers(arguments[1:8], 7):
            name, x, y, z, qx, qy, qz, qw = arguments[:8]
            self.coming[name] = transform((x, y, z), (qw, qx, qy, qz))
            if len(self.coming) == len(PARENTS):
                self.pose, self.pose_time_s = self.coming, self.time_s
                self.coming = {}


def are_numbers(arguments, count):
    return len(arguments) == count and all(isinstance(number, float) and math.isfinite(number) for number in arguments)


def transform(position, quaternion):
    rotation = BLENDER_FROM_UNITY @ Quaternion(quaternion).to_matrix() @ BLENDER_FROM_UNITY.transposed()
    return Matrix.Translation(BLENDER_FROM_UNITY @ Vector(position)) @ rotation.to_4x4()


def joints_of(pose, turned=True):
    """Where each bone of a pose lies; not turned: in its T-pose, above the origin."""
    joints = {}
    for name, parent in PARENTS.items():
        local = pose[name] if turned else Matrix.Translation(pose[name].translation)
        joints[name] = joints[parent] @ local if parent else local
    if not turned:
        hips = pose["Hips"].translation
        lift = Vector((-hips.x, -hips.y, -joints["LeftToes"].translation.z))
        joints = {name: Matrix.Translation(lift) @ joint for name, joint in joints.items()}
    return joints


def make_armature(pose):
    """Makes an armature of the person's sizes in the scene."""
    data = bpy.data.armatures.new("mocapd")
    armature = bpy.data.objects.new("mocapd", data)
    bpy.context.scene.collection.objects.link(armature)
    bpy.context.view_layer.objects.active = armature
    bpy.ops.object.mode_set(mode="EDIT")
    rest = {name: joint.translation for name, joint in joints_of(pose, turned=False).items()}
    for name, parent in PARENTS.items():
        bone = data.edit_bones.new(name)
        bone.head = rest[name]
        if name in NEXT:
            bone.tail = rest[NEXT[name]]
        else:
            direction, share = ENDS[name]
            bone.tail = rest[name] + direction * share * (rest[name] - rest[parent]).length
        if bone.length < SHORTEST_BONE:
            bone.tail = bone.head + Vector((0, 0, SHORTEST_BONE))
        bone.parent = data.edit_bones[parent] if parent else None
    bpy.ops.object.mode_set(mode="OBJECT")
    for bone in armature.pose.bones:
        bone.rotation_mode = "QUATERNION"
    return armature


def apply_pose(armature, pose):
    """Moves the bones to where the person's are, though the sizes may have been refined since the armature was made."""
    joints = joints_of(pose)
    posed = {}
    for name, parent in PARENTS.items():
        bone = armature.pose.bones[name]
        rest = bone.bone.matrix_local
        turned = joints[name].to_3x3() @ rest.to_3x3()
        posed[name] = Matrix.Translation(joints[name].translation) @ turned.to_4x4()
        unposed = posed[parent] @ bone.parent.bone.matrix_local.inverted_safe() @ rest if parent else rest
        bone.matrix_basis = unposed.inverted_safe() @ posed[name]


def has_bones(thing):
    """Whether it is there and nobody has taken a bone away."""
    return thing is not None and thing.type == "ARMATURE" and set(PARENTS) <= set(thing.pose.bones.keys())


class LiveBody:
    """What is heard, and the armature that it moves."""

    def __init__(self, port):
        self.receiver = Receiver(port)
        self.armature_name = None

    def poll(self):
        """Moves the armature to the newest pose; tells whether there was one."""
        if not self.receiver.poll():
            return False
        pose = self.receiver.pose
        armature = bpy.data.objects.get(self.armature_name or "")
        if not has_bones(armature):
            if bpy.context.mode != "OBJECT":
                return False  # Somebody is editing. Making bones needs edit mode, too.
            armature = make_armature(pose)
            self.armature_name = armature.name
        apply_pose(armature, pose)
        return True


live_body = None


def tick():
    if live_body is None:
        return None
    live_body.poll()
    return PERIOD_S


class MOCAPD_OT_start(bpy.types.Operator):
    bl_idname = "mocapd.start"
    bl_label = "Start"
    bl_description = "Listen to mocap stream osc, and move an armature"

    @classmethod
    def poll(cls, context):
        return live_body is None and context.mode == "OBJECT"

    def execute(self, context):
        global live_body
        port = context.scene.mocapd_port
        try:
            live_body = LiveBody(port)
        except OSError as error:
            self.report({"ERROR"}, f"UDP port {port}: {error.strerror}; choose another port")
            return {"CANCELLED"}
        bpy.app.timers.register(tick, persistent=True)
        return {"FINISHED"}


class MOCAPD_OT_stop(bpy.types.Operator):
    bl_idname = "mocapd.stop"
    bl_label = "Stop"
    bl_description = "Stop listening; the armature stays"

    @classmethod
    def poll(cls, context):
        return live_body is not None

    def execute(self, context):
        stop()
        return {"FINISHED"}


class MOCAPD_PT_panel(bpy.types.Panel):
    bl_label = "mocapd"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "mocapd"

    def draw(self, context):
        column = self.layout.column()
        column.prop(context.scene, "mocapd_port")
        column.operator("mocapd.start")
        column.operator("mocapd.stop")
        if live_body is not None:
            column.label(text="tracked" if live_body.receiver.is_tracked else "nobody is tracked")


def stop():
    global live_body
    if live_body is not None:
        live_body.receiver.close()
        live_body = None
    if bpy.app.timers.is_registered(tick):
        bpy.app.timers.unregister(tick)


CLASSES = (MOCAPD_OT_start, MOCAPD_OT_stop, MOCAPD_PT_panel)


def register():
    for kind in CLASSES:
        bpy.utils.register_class(kind)
    bpy.types.Scene.mocapd_port = bpy.props.IntProperty(name="UDP port", default=PORT, min=1, max=65535,
                                                        description="Where mocap stream osc --to sends")


def unregister():
    stop()
    del bpy.types.Scene.mocapd_port
    for kind in reversed(CLASSES):
        bpy.utils.unregister_class(kind)


if __name__ == "__main__":
    register()
