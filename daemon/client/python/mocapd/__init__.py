"""Poses of mocapd, a markerless motion capture service, as numpy arrays.

Live, with the service running on this host or sending to its network:

    import mocapd
    for pose in mocapd.listen():
        if pose.is_tracked:
            print(pose.point("fingertips_l"), pose.angle("elbow_l_z"))

From what ``mocap track`` left, or from what ``lcm-logger`` or a recording kept of the messages:

    walk = mocapd.read_result("result")
    walk = mocapd.read_log("session.lcm")
    walk.angle("elbow_l_z")                          # the names of live poses
    walk.to_pandas().plot(x="time_s", y="fingertips_l_z_mm")

Millimetres, radians; the studio's frame is right-handed with z up and the floor at z = 0. ``_l`` is the person's left.
Whatever was not tracked is NaN. LCM's own Python module is not needed.
"""
from .keypoints import KeypointSender
from .live import DEFAULT_URL, listen, listen_people, messages
from .poses import CONTACT_NAMES, FURTHER_POINT_NAMES, PAPER_JOINT_NAMES, POINT_NAMES, Body, Pose
from .results import Result, read_log, read_people, read_result

__all__ = ["CONTACT_NAMES", "DEFAULT_URL", "FURTHER_POINT_NAMES", "PAPER_JOINT_NAMES", "POINT_NAMES", "Body", "KeypointSender", "Pose",
           "Result", "listen", "listen_people", "messages", "read_log", "read_people", "read_result"]
