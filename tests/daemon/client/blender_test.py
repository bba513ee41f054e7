#!/usr/bin/python3
"""The add-on in Debian's Blender, without a screen: it is installed as a person would, hears `mocap stream osc`, and its bones are
held against the points of `mocap stream json`. Ends with 77 where there is no Blender.

Blender runs this file too, with what it needs after "--".
"""
import json
import os
import socket
import struct
import subprocess
import sys
import tempfile

try:
    import bpy
except ImportError:
    bpy = None

SOURCE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))))
ADD_ON = os.path.join(SOURCE, "daemon/client/blender/mocapd_live.py")
MOST_APART_M = 0.002
FEWEST_POSES = 20
POINTS = {"Spine": "torso", "Neck": "neck", "LeftUpperArm": "shoulder_l", "RightUpperArm": "shoulder_r", "LeftLowerArm": "elbow_l",
          "RightLowerArm": "elbow_r", "LeftUpperLeg": "hip_l", "RightUpperLeg": "hip_r", "LeftLowerLeg": "knee_l",
          "RightLowerLeg": "knee_r"}


def osc(address, *arguments):
    def text(value):
        return value.encode() + b"\0" * (4 - len(value) % 4)
    kinds = {str: "s", float: "f", int: "i"}
    packed = [text(value) if isinstance(value, str) else struct.pack(">" + kinds[type(value)], value) for value in arguments]
    return text(address) + text("," + "".join(kinds[type(value)] for value in arguments)) + b"".join(packed)


def in_blender(mocap, log, port):
    """Compares each pose that the armature takes on."""
    import mathutils
    bpy.ops.preferences.addon_install(filepath=ADD_ON)
    bpy.ops.preferences.addon_enable(module="mocapd_live")
    import mocapd_live
    bpy.context.scene.mocapd_port = port
    assert bpy.ops.mocapd.start() == {"FINISHED"}
    told = subprocess.run([mocap, "stream", "json", "--url", f"file://{log}?speed=0"], check=True, capture_output=True, text=True)
    lines = [json.loads(line) for line in told.stdout.splitlines()]
    points_at = {line["utime"] - lines[0]["utime"]: line["points_mm"] for line in lines if "points_mm" in line}
    assert len(points_at) >= FEWEST_POSES, len(points_at)
    # What is nobody's must not disturb.
    stranger = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    for garbage in (b"", b"#bundle\0", b"\xff" * 100, b"/VMC/Ext/Bone/Pos\0\0\0,sf\0Hips",
                    b"#bundle\0" + b"\0" * 8 + b"\x7f\xff\xff\xff"):
        stranger.sendto(garbage, ("127.0.0.1", port))
    live = mocapd_live.live_body
    if socket.has_dualstack_ipv6():
        with socket.socket(socket.AF_INET6, socket.SOCK_DGRAM) as neighbour:
            neighbour.sendto(osc("/VMC/Ext/T", 12.5), ("::1", port))
            assert not live.poll() and live.receiver.time_s == 12.5, live.receiver.time_s
    # Neither must whole poses of nothing, nor an armature that lost a bone.
    for number in ("x", float("nan"), 0.0):
        for bone in mocapd_live.PARENTS:
            stranger.sendto(osc("/VMC/Ext/Bone/Pos", bone, *[number] * 7), ("127.0.0.1", port))
        assert live.poll() == (number == 0.0), number
    bpy.data.objects.remove(bpy.data.objects["mocapd"])
    stream = subprocess.Popen([mocap, "stream", "osc", "--to", f"127.0.0.1:{port}", "--url", f"file://{log}"])
    worst, poses = 0.0, 0
    while stream.poll() is None or live.receiver.poll():
        if not live.poll():
            continue
        armature = bpy.data.objects["mocapd"]
        bpy.context.view_layer.update()
        time_us = min(points_at, key=lambda at: abs(at - live.receiver.pose_time_s * 1e6))
        for bone, point in POINTS.items():
            x, y, z = points_at[time_us][point]
            wanted = mathutils.Vector((y, -x, z)) / 1000
            worst = max(worst, (armature.matrix_world @ armature.pose.bones[bone].head - wanted).length)
        assert is_left_on_the_left(armature)
        poses += 1
    assert stream.returncode == 0, stream.returncode
    assert poses >= FEWEST_POSES, f"{poses} poses"
    assert worst < MOST_APART_M, f"{1000 * worst:.2f} mm apart"
    assert len(armature.pose.bones) == 21
    assert not live.receiver.is_tracked or lines[-1]["state"] == "tracking"
    bpy.ops.mocapd.stop()
    bpy.ops.preferences.addon_disable(module="mocapd_live")
    print(f"blender_test: {poses} poses, heads of bones at most {1000 * worst:.3f} mm apart")


def is_left_on_the_left(armature):
    """The chest's front, as the spine's bone is turned from its T-pose, has the left shoulder on its left."""
    bones = armature.pose.bones
    rest = bones["Spine"].bone.matrix_local.to_3x3()
    turn = bones["Spine"].matrix.to_3x3() @ rest.inverted()
    left = turn.col[0]
    return (bones["LeftUpperArm"].head - bones["RightUpperArm"].head).dot(left) > 0.1


def free_port():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as udp:
        udp.bind(("127.0.0.1", 0))
        return udp.getsockname()[1]


def main():
    from client_log import BIN, TrackedTake
    from shutil import which
    if not which("blender"):
        print("blender_test: Skipped\nneeds Debian's package blender; tools/check --blender has it")
        sys.exit(77)
    with TrackedTake() as take, tempfile.TemporaryDirectory() as home:
        environment = {**os.environ, "BLENDER_USER_SCRIPTS": home, "BLENDER_USER_CONFIG": home, "HOME": home}
        done = subprocess.run(["blender", "--background", "--factory-startup", "--python-exit-code", "1", "--python",
                               os.path.abspath(__file__), "--", os.path.join(BIN, "mocap"), take.log, str(free_port())],
                              env=environment)
    sys.exit(done.returncode)


if __name__ == "__main__":
    if bpy:
        binary, log_file, udp_port = sys.argv[sys.argv.index("--") + 1:]
        in_blender(binary, log_file, int(udp_port))
    else:
        main()
