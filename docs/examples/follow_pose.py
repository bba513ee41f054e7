#!/usr/bin/env python3
"""Prints where the tracked person's hands are.

usage: follow_pose.py [URL [SECONDS [PREFIX]]]

URL is LCM's; "" is its default, and file://LOG plays a log. Ends after so many seconds (10) without a pose. PREFIX stands before the channels' names:
lcm.prefix of mocapd's configuration.
"""
import math
import sys

import mocapd


def follow(url=None, seconds="10", prefix=""):
    for pose in mocapd.listen(url, prefix, timeout_s=float(seconds)):
        if pose.is_tracked:
            left, right = pose.point("fingertips_l"), pose.point("fingertips_r")
            sure = "" if math.isnan(pose.probability) else "   %.0f %% sure" % (100 * pose.probability)
            print("left hand %6.0f %6.0f %6.0f mm   right hand %6.0f %6.0f %6.0f mm%s" % (*left, *right, sure), flush=True)


def main():
    if "--help" in sys.argv:
        return print(__doc__)
    if len(sys.argv) > 4:
        sys.exit(__doc__)
    try:
        follow(*sys.argv[1:])
    except KeyboardInterrupt:
        pass
    except (OSError, ValueError) as error:  # A time-out is an OSError.
        sys.exit(f"follow_pose: {error}")


if __name__ == "__main__":
    main()
