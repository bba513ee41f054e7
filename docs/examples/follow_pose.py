#!/usr/bin/env python3
"""Prints where the tracked person's hands are.

Debian has no Python module of LCM, and none is needed to listen: a message is one UDP packet. Make the types first,
here beside this file (package liblcm-bin):

    lcm-gen --python /usr/share/mocapd/lcmtypes/*.lcm
"""
import socket
import struct

from mocap import body_t, pose_t

GROUP, PORT = "239.255.76.67", 7667
SHORT_MESSAGE = 0x4C433032  # "LC02"; larger ones come in pieces, which poses never do.


def messages():
    """Yields channel and bytes of every message."""
    udp = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    udp.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    udp.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEPORT, 1)
    udp.bind((GROUP, PORT))
    udp.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP,
                   struct.pack("4sL", socket.inet_aton(GROUP), socket.INADDR_ANY))
    while True:
        packet = udp.recv(65536)
        magic, _ = struct.unpack(">II", packet[:8])
        if magic == SHORT_MESSAGE:
            channel, _, data = packet[8:].partition(b"\0")
            yield channel.decode(), data


def main():
    names = None
    for channel, data in messages():
        if channel == "MOCAP_BODY":
            names = list(body_t.decode(data).point_name)
        elif channel == "MOCAP_POSE" and names:
            pose = pose_t.decode(data)
            if pose.state == pose_t.TRACKING:
                left, right = (pose.point_mm[names.index("fingertips_" + side)] for side in "lr")
                print("left hand %6.0f %6.0f %6.0f mm   right hand %6.0f %6.0f %6.0f mm" % (*left, *right), flush=True)


if __name__ == "__main__":
    main()
