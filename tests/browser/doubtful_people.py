"""Messages of a mocapd that is in doubt: those of a real one, sent again with other times and with details of the test's own."""
import os
import socket
import struct
import sys
import threading
import time

from running_daemon import BIN, GROUP

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(BIN)), "python"))
import mocapd
from mocapd.mocap import people_t, person_body_t, person_details_t

WANTED = ("MOCAP_STUDIO", "MOCAP_BODY", "MOCAP_BODIES", "MOCAP_PEOPLE")
RIVAL_APART_MM = 700.0


def heard_once(url):
    """One message of each kind, with somebody tracked."""
    kept = {}
    for channel, data in mocapd.messages(url, timeout_s=30):
        if channel not in WANTED or (channel == "MOCAP_PEOPLE" and people_t.decode(data).people[:1] == []):
            continue
        kept[channel] = data
        if len(kept) == len(WANTED):
            return kept
    raise RuntimeError("the messages ended")


class DoubtfulPeople:
    """Two people who stand still, side by side: of one the pose is sure, of the other it is in doubt. Ends with the block."""

    def __init__(self, messages, port, probability=0.6):
        self.port, self.probability, self.number = port, probability, 0
        self.url = "udpm://%s:%d?ttl=0" % (GROUP, port)
        self.messages = messages
        self.set = people_t.decode(messages["MOCAP_PEOPLE"])
        first = self.set.people[0]
        second = people_t.decode(messages["MOCAP_PEOPLE"]).people[0]
        second.id = first.id + 1
        second.torso_mm = [second.torso_mm[0], second.torso_mm[1] + 1000.0, second.torso_mm[2]]
        second.point_mm = [[x, y + 1000.0, z] for x, y, z in second.point_mm]
        self.set.people, self.set.num_people = [first, second], 2
        self.set.camera_used = list(self.set.camera_used)
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, 0)
        self.ended = threading.Event()
        self.thread = threading.Thread(target=self.run, daemon=True)

    def __enter__(self):
        self.thread.start()
        return self

    def __exit__(self, *_):
        self.ended.set()
        self.thread.join()
        self.socket.close()

    def run(self):
        bodies = [person_body_t.decode(self.messages["MOCAP_BODIES"]) for _ in self.set.people]
        for body, person in zip(bodies, self.set.people):
            body.id = person.id
        while not self.ended.wait(0.05):
            self.send("MOCAP_STUDIO", self.messages["MOCAP_STUDIO"])
            self.send("MOCAP_BODY", self.messages["MOCAP_BODY"])
            for body in bodies:
                self.send("MOCAP_BODIES", body.encode())
            self.set.utime = int(1e6 * time.time())
            self.set.publish_utime = self.set.utime + 1000
            self.set.frame += 1
            for place in range(2):
                self.send("MOCAP_DETAILS", self.details(place).encode())
            self.send("MOCAP_PEOPLE", self.set.encode())

    def details(self, place):
        person = self.set.people[place]
        details = person_details_t()
        details.utime, details.frame, details.person, details.place = self.set.utime, self.set.frame, person.id, place
        details.state = person.state
        details.probability = 0.99 if place == 0 else self.probability
        if place == 1:
            details.rival_probability, details.num_rival_points = 1 - self.probability, 23
            details.rival_point_mm = [[x + RIVAL_APART_MM, y, z] for x, y, z in person.point_mm]
        return details

    def send(self, channel, data):
        """As LCM sends what fits into a packet."""
        packet = struct.pack(">II", 0x4C433032, self.number) + channel.encode() + b"\0" + data
        self.number += 1
        self.socket.sendto(packet, (GROUP, self.port))
