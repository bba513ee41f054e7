"""Messages and logs as mocapd makes them, for the tests of the Python package."""
import os
import tempfile
import unittest

import mocapd
from mocapd.lcm_log import HEAD, MARK
from mocapd.mocap import body_t, people_t, person_body_t, person_details_t, person_t, pose_t

JOINTS = ("neck_x", "elbow_l_z", "knee_r_y")
START_US = 1_700_000_000_000_000


def body_message():
    body = body_t()
    body.model, body.stature_mm = "full", 1700.0
    body.point_name = list(mocapd.POINT_NAMES)
    body.num_joints, body.joint_name = len(JOINTS), list(JOINTS)
    body.joint_parent, body.joint_axis = [-1, -1, -1], [[1.0, 0, 0], [0, 0, 1.0], [0, 1.0, 0]]
    body.joint_place_mm = [[0.0, 0, 0]] * 3
    body.joint_min_rad, body.joint_max_rad = [-1.0] * 3, [1.0] * 3
    body.num_sizes, body.size_name, body.size_mm = 1, ["thigh"], [420.0]
    return body


def fill_pose(message, frame, state=pose_t.TRACKING):
    """Numbers that differ from each other and from those of other frames."""
    message.state = state
    message.torso_mm = [100.0 + frame, 200.0, 1000.0]
    message.torso_axis, message.torso_angle_rad = [0.0, 0.0, 1.0], 0.5
    message.theta_rad = [0.01 * i + frame for i in range(16)]
    message.num_joints, message.joint_rad = len(JOINTS), [0.1 + frame, 0.2, 0.3]
    message.point_mm = [[1000.0 * frame + i, 10.0 * i, -float(i)] for i in range(23)]
    message.point_std_mm = [5.0] * 23
    message.residual_mm = 12.0
    return message


def pose_message(frame, state=pose_t.TRACKING):
    pose = fill_pose(pose_t(), frame, state)
    pose.utime, pose.frame = START_US + frame * 10_000, frame
    pose.num_cameras, pose.camera_used = 2, [True, False]
    return pose


def people_message(frame, people):
    """people: numbers and names"""
    message = people_t()
    message.utime, message.frame, message.num_people = START_US + frame * 10_000, frame, len(people)
    for number, name in people:
        person = fill_pose(person_t(), frame + number)
        person.id, person.name = number, name
        message.people.append(person)
    return message


def details_message(frame, number, place, probability):
    message = person_details_t()
    message.utime, message.frame = START_US + frame * 10_000, frame
    message.person, message.place, message.state = number, place, pose_t.TRACKING
    message.probability = probability
    message.point_name, message.point_mm, message.point_std_mm = ["wrist_l", "nose"], [[1, 2, 3], [4, 5, 6]], [7, 8]
    message.num_points = len(message.point_name)
    message.contact_name, message.contact = ["toe_l", "heel_l", "knee_l"], [0.75, 0.25, 1]
    message.num_contacts = len(message.contact_name)
    return message


def person_body_message(number, name=""):
    message = person_body_t()
    message.id, message.name, message.body = number, name, body_message()
    return message


class Log:
    """A log as lcm-logger writes it."""

    def __init__(self, folder, name="test.lcm"):
        self.path = os.path.join(folder, name)
        self.events = []

    def add(self, channel, message):
        data = message if isinstance(message, bytes) else message.encode()
        time_us = START_US + 1000 * len(self.events)
        self.events.append(HEAD.pack(MARK, len(self.events), time_us, len(channel), len(data)) + channel.encode() + data)
        return self

    def write(self, damage=lambda data: data):
        with open(self.path, "wb") as out:
            out.write(damage(b"".join(self.events)))
        return self.path


class LogTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.log = Log(folder.name)
        self.url = "file://" + self.log.path
