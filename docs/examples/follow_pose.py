#!/usr/bin/env python3
"""Prints where the tracked person's hands are.

usage: follow_pose.py [URL]      of LCM; file://LOG plays a log
"""
import sys

import mocapd


def main():
    for pose in mocapd.listen(*sys.argv[1:]):
        if pose.is_tracked:
            left, right = pose.point("fingertips_l"), pose.point("fingertips_r")
            print("left hand %6.0f %6.0f %6.0f mm   right hand %6.0f %6.0f %6.0f mm" % (*left, *right), flush=True)


if __name__ == "__main__":
    main()
