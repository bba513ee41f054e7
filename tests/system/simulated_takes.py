"""For scripts that calibrate and track simulated takes: mocap, and takes with another calibration."""
import json
import os
import subprocess
import sys

MOCAP = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../build/release/bin/mocap")


def mocap(*words):
    done = subprocess.run([MOCAP, *words], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit("mocap %s: %s" % (" ".join(words), done.stderr.strip()))
    return done.stdout


def tracking_error(take, result):
    """The mean error over joints and frames [mm]."""
    mocap("track", take, "--out", result)
    return json.loads(mocap("evaluate", take, result, "--json"))["mpjpe_mm"]


def with_calibration(take, calibration, folder):
    """The take once more, with another calibration."""
    os.mkdir(folder)
    for name in os.listdir(take):
        source = calibration if name == "calibration.toml" else os.path.join(take, name)
        os.symlink(source, os.path.join(folder, name))
    return folder
