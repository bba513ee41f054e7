#!/usr/bin/env python3
"""Sends keypoints to mocapd, as a program with a pose network does. The network is played here: it finds mocapd's own points, 3 px off.

usage: send_keypoints.py [URL [SECONDS [PREFIX]]]

URL is LCM's; "" is its default. Ends after so many seconds (10) without a pose. PREFIX stands before the channels' names: lcm.prefix.
"""
import random
import sys
import tomllib

import mocapd
from mocapd.mocap import studio_t

POINTS = [f"{point}_{side}" for point in ("shoulder", "elbow", "hip", "knee") for side in "lr"]

def pixel(camera, point_mm):  # Tsai's lens, as simulated cameras have. Others: OpenCV projectPoints.
    x, y, z = (sum(r * p for r, p in zip(row, point_mm)) + t for row, t in zip(camera["rotation"], camera["translation_mm"]))
    xu, yu, bend = camera["focal_mm"] * x / z, camera["focal_mm"] * y / z, 1
    for _ in range(10):
        bend = 1 + camera["kappa1"] * ((xu / bend) ** 2 + (yu / bend) ** 2)
    (cx, cy), (dx, dy) = camera["center_px"], camera["pitch_mm"]
    return camera["sx"] * xu / bend / dx + cx + random.gauss(0, 3), yu / bend / dy + cy + random.gauss(0, 3)

def witness(url=None, seconds="10", prefix=""):
    studios = (data for channel, data in mocapd.messages(url, timeout_s=float(seconds)) if channel == prefix + "MOCAP_STUDIO")
    cameras = tomllib.loads(studio_t.decode(next(studios)).calibration)["cameras"]
    with mocapd.KeypointSender("example", url, prefix) as sender:
        for people in mocapd.listen_people(url, prefix, timeout_s=float(seconds)):
            for pose in filter(lambda each: each.is_tracked, people):
                for name, camera in cameras.items():
                    sender.send(name, 1000 * pose.utime, [(point, *pixel(camera, pose.point(point)), 0.9) for point in POINTS], pose.person)

if __name__ == "__main__":
    if "--help" in sys.argv or len(sys.argv) > 4:
        sys.exit(print(__doc__) if "--help" in sys.argv else __doc__)
    try:
        witness(*sys.argv[1:])
    except (KeyboardInterrupt, OSError, ValueError, KeyError) as error:
        sys.exit(f"send_keypoints: {error}")
