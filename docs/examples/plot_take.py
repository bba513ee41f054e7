#!/usr/bin/env python3
"""Plots a hand's path and how elbows and knees bend, of a result of `mocap track` or of a log. Needs matplotlib.

usage: plot_take.py RESULT|LOG [PICTURE]      into a window, or a picture
"""
import os
import sys

import matplotlib.pyplot as plt
import numpy as np

import mocapd

# A joint, and the sign with which it bends.
BENT = {"left elbow": ("elbow_l_z", -1), "right elbow": ("elbow_r_z", 1), "left knee": ("knee_l_y", 1), "right knee": ("knee_r_y", 1)}


def plot(result):
    figure = plt.figure(figsize=(11, 4.5), layout="constrained")
    path = figure.add_subplot(1, 2, 1, projection="3d")
    for side, name in (("left", "fingertips_l"), ("right", "fingertips_r")):
        path.plot(*(result.point(name).T / 1000), label=side + " hand")
    path.set(xlabel="x [m]", ylabel="y [m]", zlabel="z [m]", title="Paths of the hands")
    path.set_aspect("equal")
    path.locator_params(nbins=4)
    path.legend()
    angles = figure.add_subplot(1, 2, 2)
    for name, (joint, sign) in BENT.items():
        angles.plot(result.time_s, np.degrees(sign * result.angle(joint)), label=name)
    angles.set(xlabel="time [s]", ylabel="bent by [°]", title="Elbows and knees")
    angles.grid(alpha=0.3)
    angles.legend(loc="lower center", bbox_to_anchor=(0.5, 1.08), ncols=4)
    return figure


def main():
    if "--help" in sys.argv:
        return print(__doc__)
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    path, *picture = sys.argv[1:]
    try:
        result = mocapd.read_result(path) if os.path.isdir(path) else mocapd.read_log(path)
    except (OSError, ValueError) as error:
        sys.exit(f"plot_take: {error}")
    figure = plot(result)
    figure.savefig(picture[0], dpi=120) if picture else plt.show()


if __name__ == "__main__":
    main()
