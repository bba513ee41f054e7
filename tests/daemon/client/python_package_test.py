#!/usr/bin/python3
"""The Python package: what it makes of packets, logs and messages, whole and damaged.

usage: python_package_test.py [TEST ...]      with the package in PYTHONPATH
"""
import itertools
import os
import random
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import types
import unittest
import warnings
from unittest import mock

import numpy as np

import mocapd
from client_log import GROUP, free_group, need_multicast, skip
from mocapd.lcm_log import HEAD, MARK
from mocapd.lcm_udp import (FRAGMENT_HEADER, FRAGMENT_MAGIC, MOST_BYTES, MOST_SENDERS, SHORT_HEADER, SHORT_MAGIC, Reassembly,
                            parse_group)
from mocapd.mocap import body_t, people_t, person_body_t, person_t, pose_t
from mocapd.poses import decoded
from mocapd.results import COLUMNS

JOINTS = ("neck_x", "elbow_l_z", "knee_r_y")
START_US = 1_700_000_000_000_000


def short_packet(channel, data, number=1):
    return SHORT_HEADER.pack(SHORT_MAGIC, number) + channel.encode() + b"\0" + data


def pieces_of(channel, data, number, size=1000):
    """As LCM cuts a message: the first piece has the channel before its data."""
    cuts = [data[place:place + size] for place in range(0, len(data), size)]
    return [FRAGMENT_HEADER.pack(FRAGMENT_MAGIC, number, len(data), i * size, i, len(cuts)) +
            (channel.encode() + b"\0" if i == 0 else b"") + cut for i, cut in enumerate(cuts)]


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


class FolderTest(unittest.TestCase):
    """Folders that are taken for others."""

    def setUp(self):
        self.folder = self.enterContext(tempfile.TemporaryDirectory())

    def holds(self, *names):
        for name in names:
            path = os.path.join(self.folder, name)
            os.makedirs(os.path.dirname(path), exist_ok=True)
            open(path, "w").close()
        return self.folder

    def test_one_person_is_not_read_as_several(self):
        with self.assertRaisesRegex(ValueError, "is a result of one person; use read_result"):
            mocapd.read_people(self.holds("poses.csv", "body.toml"))

    def test_several_people_are_not_read_as_one_whatever_their_numbers(self):
        with self.assertRaisesRegex(ValueError, "several people; use read_people"):
            mocapd.read_result(self.holds("person-7/poses.csv"))

    def test_a_take_is_no_result_whoever_is_in_it(self):
        take = self.holds("take.toml", "person-1/truth.csv")
        for read in (mocapd.read_result, mocapd.read_people):
            with self.assertRaisesRegex(ValueError, "is a take, not a result; .*mocap track"):
                read(take)

    def test_folders_and_logs_are_not_mixed_up(self):
        with self.assertRaisesRegex(ValueError, "is a folder; use read_result"):
            mocapd.read_log(self.folder)
        with self.assertRaisesRegex(ValueError, "use read_log"):
            mocapd.read_result(self.holds("session.lcm") + "/session.lcm")

    def test_what_is_not_there_or_damaged_is_named(self):
        gone = os.path.join(self.folder, "gone")
        for read in (mocapd.read_result, mocapd.read_log, mocapd.read_people):
            with self.assertRaisesRegex(FileNotFoundError, "^[^\\n]*gone[^\\n]*: not found; expected "):
                read(gone)
        with self.assertRaisesRegex(FileNotFoundError, "body.toml: not found; expected"):
            mocapd.read_result(self.holds("poses.csv"))
        whole = 'model = "full"\nstature_mm = 1700\n'
        for text, problem in ((whole + '[joints]\nnames = ["neck_x"]', "body.toml: joints.names and joints.columns differ"),
                              ("model = ", "body.toml: .*; expected TOML"), ('model = "full"', "body.toml: stature_mm is missing")):
            with open(os.path.join(self.folder, "body.toml"), "w", encoding="utf-8") as file:
                file.write(text)
            with self.assertRaisesRegex(ValueError, problem):
                mocapd.read_result(self.folder)

    def test_nobody_is_an_empty_folder_and_no_other(self):
        self.assertEqual(mocapd.read_people(self.folder), {})
        with self.assertRaisesRegex(ValueError, "no person-1"):
            mocapd.read_people(self.holds("notes.txt"))


class ReadResultTest(unittest.TestCase):
    """Results of a table, whatever columns follow the first ones."""
    BODY = 'model = "full"\nstature_mm = 1700.0\n[sizes]\nthigh_mm = 420.0\n'
    JOINTS = '[joints]\nnames = ["knee_r_y", "wrist_l_x"]\ncolumns = ["theta_16_rad", "wrist_l_x_rad"]\n'

    def setUp(self):
        self.folder = self.enterContext(tempfile.TemporaryDirectory())

    def result(self, further=(), cells=(), body=BODY):
        """Of one row, in which every cell of the first columns differs from all others."""
        numbers = [str(place) for place in range(len(COLUMNS))]
        numbers[2] = "tracking"
        with open(os.path.join(self.folder, "poses.csv"), "w", encoding="utf-8") as table:
            table.write(",".join([*COLUMNS, *further]) + "\n" + ",".join([*numbers, *cells]) + "\n")
        with open(os.path.join(self.folder, "body.toml"), "w", encoding="utf-8") as file:
            file.write(body)
        return mocapd.read_result(self.folder)

    def test_the_torsos_origin_is_not_the_point_torso(self):
        result = self.result()
        np.testing.assert_array_equal(result.torso_mm, [[3, 4, 5]])
        np.testing.assert_array_equal(result.point("torso"), [[26, 27, 28]])
        np.testing.assert_array_equal(result.point("foot_r"), [[92, 93, 94]])
        np.testing.assert_array_equal(result.residual_mm, [95])

    def test_a_result_of_before_has_the_papers_joints_by_name(self):
        result = self.result()
        self.assertEqual(result.joint_names, mocapd.PAPER_JOINT_NAMES)
        np.testing.assert_array_equal(result.angle("elbow_l_z"), result.theta_rad[:, 8])
        self.assertTrue(np.isnan(result.points_std_mm).all())

    def test_further_columns_are_found_by_name(self):
        result = self.result(("probability", "deviation_head_mm", "wrist_l_x_rad"), ("", "6.5", "-0.5"), self.BODY + self.JOINTS)
        self.assertEqual(result.joint_names, ("knee_r_y", "wrist_l_x"))
        np.testing.assert_array_equal(result.angle("wrist_l_x"), [-0.5])
        np.testing.assert_array_equal(result.angle("knee_r_y"), result.theta_rad[:, 15])
        self.assertEqual(result.points_std_mm[0, 1], 6.5)

    def test_what_has_no_value_is_nan(self):
        result = self.result(("deviation_head_mm", "wrist_l_x_rad"), ("", ""), self.BODY + self.JOINTS)
        self.assertTrue(np.isnan(result.points_std_mm[0, 1]) and np.isnan(result.angle("wrist_l_x")[0]))

    def test_another_table_is_told(self):
        with self.assertRaisesRegex(ValueError, "poses.csv: line 2: has 97 cells, not 98"):
            self.result(("probability",))
        with open(os.path.join(self.folder, "poses.csv"), "w", encoding="utf-8") as table:
            table.write("frame,timestamp_ns,x\n")
        with self.assertRaisesRegex(ValueError, "poses.csv: line 1: is no header of poses.csv; expected frame, "):
            mocapd.read_result(self.folder)


class ReassemblyTest(unittest.TestCase):
    DATA = bytes(random.Random(1).randbytes(4500))

    def take_all(self, packets, sender="a"):
        reassembly = Reassembly()
        return [event for event in (reassembly.take(packet, sender) for packet in packets) if event], reassembly

    def test_a_small_message_is_one_packet(self):
        events, _ = self.take_all([short_packet("POSE", b"\0data\0")])
        self.assertEqual(events, [("POSE", b"\0data\0")])

    def test_pieces_come_in_any_order_and_twice(self):
        pieces = pieces_of("VOXELS", self.DATA, 7)
        random.Random(2).shuffle(pieces)
        events, reassembly = self.take_all([pieces[0]] + pieces)
        self.assertEqual(events, [("VOXELS", self.DATA)])
        self.assertEqual(reassembly.bytes_held, 0)

    def test_a_message_that_lost_a_piece_does_not_mix_with_the_next(self):
        torn = pieces_of("VOXELS", self.DATA, 7)[:-1]
        whole = pieces_of("VOXELS", self.DATA[::-1], 8)
        events, _ = self.take_all(torn + whole)
        self.assertEqual(events, [("VOXELS", self.DATA[::-1])])

    def test_senders_in_turns_do_not_disturb_each_other(self):
        reassembly = Reassembly()
        turns = zip(pieces_of("A", self.DATA, 7), pieces_of("B", self.DATA[::-1], 7))
        events = [reassembly.take(piece, sender) for pair in turns for sender, piece in zip("ab", pair)]
        self.assertEqual([event for event in events if event], [("A", self.DATA), ("B", self.DATA[::-1])])

    def test_packets_of_others_are_passed_over(self):
        header = FRAGMENT_HEADER.pack
        wrong = [b"", b"\0" * 7, b"LC02", b"LC02\0\0\0\1POSE", b"LC02\0\0\0\1\0data", short_packet("x" * 300, b""),
                 header(FRAGMENT_MAGIC, 1, 10, 8, 1, 2) + b"more than 10", header(FRAGMENT_MAGIC, 1, 10, 0, 2, 2) + b"x",
                 header(FRAGMENT_MAGIC, 1, 0xFFFFFFFF, 0, 1, 2) + b"x", header(FRAGMENT_MAGIC, 1, 10, 0, 0, 0) + b"A\0x",
                 header(FRAGMENT_MAGIC, 1, 2, 0, 1, 0xFFFF) + b"x", header(FRAGMENT_MAGIC, 1, 4, 0, 0, 1) + b"no channel"]
        events, reassembly = self.take_all(wrong)
        self.assertEqual(events, [])
        self.assertEqual(reassembly.bytes_held, 0)

    def test_what_is_never_ended_does_not_fill_the_memory(self):
        reassembly = Reassembly()
        for sender in range(3 * MOST_SENDERS):
            reassembly.take(FRAGMENT_HEADER.pack(FRAGMENT_MAGIC, 1, 1 << 20, 0, 1, 2) + b"x", sender)
            self.assertLessEqual(reassembly.bytes_held, MOST_BYTES)
        for sender in range(3 * MOST_SENDERS):
            reassembly.take(FRAGMENT_HEADER.pack(FRAGMENT_MAGIC, 1, 1, 0, 1, 2) + b"x", -sender)
        self.assertLessEqual(len(reassembly.begun), MOST_SENDERS)


class AddressTest(unittest.TestCase):
    def test_lcms_addresses_are_understood(self):
        self.assertEqual(parse_group("udpm://239.1.2.3:99?ttl=1&recv_buf_size=100"), ("239.1.2.3", 99))
        self.assertEqual(parse_group("udpm://"), (GROUP, 7667))

    def test_others_are_told(self):
        for wrong in ("udpm://10.0.0.1:7667", "tcpq://127.0.0.1:7700", "udpm://239.1.2.3:99?tll=1", "udpm://239.1.2.3:99999", "x"):
            with self.assertRaisesRegex(ValueError, "expected"):
                next(mocapd.listen(wrong))


    def test_a_port_of_another_program_is_named(self):
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as other:
            other.bind(("", 0))
            port = other.getsockname()[1]
            with self.assertRaisesRegex(OSError, f"UDP port {port} is in use by another program: ss -ulpn"):
                next(mocapd.listen(f"udpm://{GROUP}:{port}", timeout_s=1))


class DecodeTest(unittest.TestCase):
    def test_damaged_messages_are_none_or_something_else_but_never_an_error(self):
        chance = random.Random(3)
        for message in (pose_message(1), body_message(), people_message(1, [(1, "anna"), (2, "")]), person_body_message(1)):
            whole = message.encode()
            for end in range(0, len(whole), 7):
                self.assertIsNone(decoded(type(message), whole[:end]))
            for _ in range(300):
                data = bytearray(whole)
                for _ in range(3):
                    data[chance.randrange(8, len(data))] = chance.randrange(256)
                decoded(type(message), bytes(data))

    def test_a_count_that_does_not_fit_takes_no_memory(self):
        data = people_message(1, []).encode()
        count = struct.pack(">i", 0x7FFFFFFF)
        self.assertIsNone(decoded(people_t, data[:40] + count + data[44:]))

    def test_another_types_message_is_none(self):
        self.assertIsNone(decoded(pose_t, body_message().encode()))


class ListenTest(LogTest):
    def test_a_pose_has_points_and_angles_by_name(self):
        self.log.add("MOCAP_BODY", body_message()).add("MOCAP_POSE", pose_message(3)).write()
        pose, = mocapd.listen(self.url)
        self.assertTrue(pose.is_tracked)
        self.assertEqual((pose.utime, pose.frame, pose.state), (START_US + 30_000, 3, "tracking"))
        np.testing.assert_array_equal(pose.point("fingertips_l"), [3017, 170, -17])
        self.assertEqual(pose.angle("elbow_l_z"), 0.2)
        np.testing.assert_allclose(pose.torso_rotation @ [1, 0, 0], [np.cos(0.5), np.sin(0.5), 0])
        self.assertEqual(pose.body.sizes_mm, {"thigh": 420.0})
        self.assertEqual(pose.points_mm.shape, (23, 3))

    def test_names_that_are_none_are_answered_with_those_that_there_are(self):
        self.log.add("MOCAP_BODY", body_message()).add("MOCAP_POSE", pose_message(3)).write()
        pose, = mocapd.listen(self.url)
        result = mocapd.read_log(self.log.path)
        for some in (pose, result):
            with self.assertRaisesRegex(ValueError, "no point 'wrist_l'; there are .*torso, head, .*fingertips_l"):
                some.point("wrist_l")
            with self.assertRaisesRegex(ValueError, "no joint 'elbow_l'; there are elbow_l_z, neck_x, knee_r_y"):
                some.angle("elbow_l")
        with self.assertRaisesRegex(ValueError, "no joint 'theta_17'; .* theta_16"):
            result.angle("theta_17")
        with self.assertRaisesRegex(ValueError, "no joint 'knee_l_y'; there are knee_r_y, neck_x, elbow_l_z, theta_1, "):
            pose.angle("knee_l_y")
        self.assertEqual(result.angle("theta_16")[0], result.theta_rad[0, 15])
        self.assertEqual(pose.angle("theta_16"), result.theta_rad[0, 15])
        np.testing.assert_array_equal(result.points_std_mm, np.full((1, 23), 5.0))
        self.assertEqual(result.angle("elbow_l_z")[0], 0.2)

    def test_whoever_is_not_tracked_is_nan(self):
        for frame, state in enumerate((pose_t.SEARCHING, pose_t.ACQUIRING, pose_t.LOST)):
            self.log.add("MOCAP_POSE", pose_message(frame, state))
        self.log.write()
        poses = list(mocapd.listen(self.url))
        self.assertEqual([pose.state for pose in poses], ["searching", "acquiring", "lost"])
        for pose in poses:
            self.assertFalse(pose.is_tracked)
            self.assertTrue(np.isnan(pose.points_mm).all() and np.isnan(pose.torso_mm).all())
            self.assertTrue(np.isnan(pose.angle("elbow_l_z")))

    def test_tracked_poses_begin_with_the_body(self):
        self.log.add("MOCAP_POSE", pose_message(1)).add("MOCAP_BODY", body_message()).add("MOCAP_POSE", pose_message(2)).write()
        self.assertEqual([pose.frame for pose in mocapd.listen(self.url)], [2])

    def test_numbers_that_are_none_are_passed_over(self):
        wrong, late = pose_message(1), pose_message(2)
        wrong.point_mm[4][1] = float("nan")
        late.utime = 2**63 - 1
        self.log.add("MOCAP_BODY", body_message()).add("MOCAP_POSE", wrong).add("MOCAP_POSE", late).write()
        self.assertEqual(list(mocapd.listen(self.url)), [])

    def test_a_prefix_is_that_of_one_daemon(self):
        for prefix in ("left.", "right."):
            self.log.add(prefix + "MOCAP_BODY", body_message())
        self.log.add("left.MOCAP_POSE", pose_message(1)).add("right.MOCAP_POSE", pose_message(2)).write()
        self.assertEqual([pose.frame for pose in mocapd.listen(self.url, prefix="right.")], [2])
        self.assertEqual(list(mocapd.listen(self.url)), [])

    def test_several_people_come_as_sets(self):
        self.log.add("MOCAP_PEOPLE", people_message(0, [(1, "anna"), (4, "")]))
        self.log.add("MOCAP_BODIES", person_body_message(1)).add("MOCAP_BODIES", person_body_message(4))
        for frame in (1, 2):
            self.log.add("MOCAP_PEOPLE", people_message(frame, [(1, "anna"), (4, "")]))
        self.log.add("MOCAP_PEOPLE", people_message(3, [])).write()
        sets = list(mocapd.listen_people(self.url))
        self.assertEqual([[(pose.person, pose.name) for pose in people] for people in sets],
                         [[], [(1, "anna"), (4, "")], [(1, "anna"), (4, "")], []])
        self.assertEqual([pose.point("torso")[0] for pose in mocapd.listen(self.url, person=4)], [5000, 6000])


class ReadLogTest(LogTest):
    def whole(self):
        self.log.add("MOCAP_BODY", body_message())
        for frame in range(6):
            self.log.add("MOCAP_POSE", pose_message(frame, pose_t.LOST if frame == 4 else pose_t.TRACKING))
        return self.log

    def test_a_log_is_arrays_with_gaps_where_nobody_was_tracked(self):
        result = mocapd.read_log(self.whole().write())
        self.assertEqual(len(result), 6)
        np.testing.assert_array_equal(result.is_tracked, [True, True, True, True, False, True])
        np.testing.assert_array_equal(result.point("knee_l")[:, 0], [19, 1019, 2019, 3019, np.nan, 5019])
        np.testing.assert_allclose(result.time_s, np.arange(6) * 0.01)
        np.testing.assert_array_equal(result.angle("elbow_l_z"), [0.2, 0.2, 0.2, 0.2, np.nan, 0.2])
        np.testing.assert_array_equal(result.angle("theta_2")[:2], [0.01, 1.01])
        self.assertEqual(result.stature_mm, 1700)

    def test_damage_in_the_middle_costs_the_messages_there(self):
        log = self.whole()
        place = sum(map(len, log.events[:3])) + 40
        result = mocapd.read_log(log.write(lambda data: data[:place] + b"\xff" * 300 + data[place + 200:]))
        self.assertEqual(list(result.frame), [0, 1, 3, 4, 5])

    def test_a_log_that_was_cut_off_is_read_up_to_there(self):
        self.assertEqual(list(mocapd.read_log(self.whole().write(lambda data: data[:-100])).frame), [0, 1, 2, 3, 4])

    def test_lengths_that_are_none_are_passed_over(self):
        event = self.whole().events[2]
        for channel, data in ((-1, 10), (300, 10), (10, -5), (10, 0x7FFFFFFF)):
            head = HEAD.pack(MARK, 0, 0, channel, data)
            self.log.events[2] = head + event[HEAD.size:]
            self.assertEqual(list(mocapd.read_log(self.log.write()).frame), [0, 2, 3, 4, 5])

    def test_daemons_are_never_mixed(self):
        for prefix in ("left.", "right."):
            self.log.add(prefix + "MOCAP_BODY", body_message()).add(prefix + "MOCAP_POSE", pose_message(len(prefix)))
        self.log.write()
        with self.assertRaisesRegex(ValueError, "left.*right"):
            mocapd.read_log(self.log.path)
        self.assertEqual(list(mocapd.read_log(self.log.path, prefix="right.").frame), [6])

    def test_what_is_no_log_is_told(self):
        self.log.add("OTHER", b"x").write()
        with self.assertRaisesRegex(ValueError, "contains no MOCAP_POSE"):
            mocapd.read_log(self.log.path)

    def test_numbers_that_are_none_are_passed_over(self):
        self.whole()
        for name, value in (("torso_angle_rad", float("inf")), ("residual_mm", float("nan")), ("utime", 2**63 - 1)):
            wrong = pose_message(10)
            setattr(wrong, name, value)
            self.log.add("MOCAP_POSE", wrong)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            self.assertEqual(list(mocapd.read_log(self.log.write()).frame), [0, 1, 2, 3, 4, 5])

    def test_who_has_anothers_name_has_a_number(self):
        for number in (1, 2):
            self.log.add("MOCAP_BODIES", person_body_message(number))
        self.log.add("MOCAP_PEOPLE", people_message(0, [(1, "anna")])).add("MOCAP_BODIES", person_body_message(1))
        self.log.add("MOCAP_PEOPLE", people_message(1, [(2, "anna")])).add("MOCAP_BODIES", person_body_message(2))
        self.assertEqual(list(mocapd.read_people(self.log.write())), ["anna", "person-2"])

    def test_people_are_told_apart_and_from_those_of_another_run(self):
        for number in (1, 2):
            self.log.add("MOCAP_BODIES", person_body_message(number))
        for run in range(2):
            for frame in range(3):
                self.log.add("MOCAP_PEOPLE", people_message(frame, [(1, "anna" if run == 0 else ""), (2, "")]))
                for number in (1, 2):
                    self.log.add("MOCAP_BODIES", person_body_message(number))
        people = mocapd.read_people(self.log.write())
        self.assertEqual(list(people), ["anna", "person-2", "person-3", "person-4"])
        self.assertEqual([len(result) for result in people.values()], [3, 3, 3, 3])
        np.testing.assert_array_equal(mocapd.read_log(self.log.path, person=2).point("torso")[:, 0], [2000, 3000, 4000])

    def test_a_column_is_a_number_with_a_name_of_its_own(self):
        columns = mocapd.read_log(self.whole().write()).to_columns()
        self.assertEqual({column.shape for column in columns.values()}, {(6,)})
        self.assertEqual(columns["torso_origin_x_mm"][1], 101)
        self.assertEqual(columns["torso_x_mm"][1], 1000)
        self.assertEqual(columns["elbow_l_z_rad"][1], 0.2)
        self.assertEqual(columns["deviation_head_mm"][1], 5)

    def test_pandas_has_a_column_a_number(self):
        try:
            import pandas  # noqa: F401
        except ImportError:
            skip(self, "needs Debian's package python3-pandas")
        table = mocapd.read_log(self.whole().write()).to_pandas()
        self.assertEqual(len(table), 6)
        self.assertEqual(table["knee_l_x_mm"][1], 1019)
        self.assertEqual(table["elbow_l_z_rad"][1], 0.2)
        self.assertEqual(list(table.loc[1, ["torso_axis_x", "torso_axis_z", "torso_angle_rad"]]), [0, 1, 0.5])
        self.assertTrue(np.isnan(table["torso_x_mm"][4]))


class MulticastTest(LogTest):
    def test_what_another_program_sends_is_heard(self):
        need_multicast(self)
        large = bytes(random.Random(5).randbytes(300_000))
        self.log.add("MOCAP_VOXELS", large).add("MOCAP_BODY", body_message())
        for frame in range(5):
            self.log.add("MOCAP_POSE", pose_message(frame))
        self.log.write()
        url = free_group()
        events = mocapd.messages(url, timeout_s=20)
        # The generator joins the group when it is first asked.
        player = subprocess.Popen(["sh", "-c", f"while :; do lcm-logplayer --speed=10 --lcm-url='{url}' {self.log.path}; done"],
                                  stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
        self.addCleanup(player.wait)
        self.addCleanup(os.killpg, player.pid, signal.SIGTERM)
        heard = {}
        for channel, data in events:
            heard.setdefault(channel, data)
            if len(heard) == 3:
                break
        self.assertEqual(heard["MOCAP_VOXELS"], large)
        self.assertEqual(heard["MOCAP_BODY"], body_message().encode())
        self.assertEqual(decoded(pose_t, heard["MOCAP_POSE"]).num_joints, len(JOINTS))

    def test_silence_ends_when_it_was_asked_to(self):
        need_multicast(self)
        url = "udpm://239.255.76.66:7667"
        silent = "came for 0.01 s; is mocapd running\\? mocap doctor checks the network$"
        for heard in (mocapd.messages(url, 0.01), mocapd.listen(url, timeout_s=0.01), mocapd.listen(url, person=2, timeout_s=0.01),
                      mocapd.listen_people(url, timeout_s=0.01)):
            with self.assertRaisesRegex(TimeoutError, f"^{url}: no .* {silent}"):
                next(heard)


class DeadlineTest(unittest.TestCase):
    """Of a source that never falls silent, by a clock that goes on by a second with each of its messages."""

    def hears(self, *events, listen=mocapd.listen, **arguments):
        def receive(_, deadline):
            for event in itertools.cycle(events):
                deadline.left_s()
                yield event
        clock = types.SimpleNamespace(monotonic=itertools.count().__next__)
        with mock.patch("mocapd.live.receive", receive), mock.patch("mocapd.lcm_udp.time", clock):
            yield from listen("udpm://", timeout_s=5, **arguments)

    BODY, POSE = ("MOCAP_BODY", body_message().encode()), ("MOCAP_POSE", pose_message(1).encode())
    PEOPLE = ("MOCAP_BODIES", person_body_message(1).encode()), ("MOCAP_PEOPLE", people_message(1, [(1, "")]).encode())
    STATUS = ("left_MOCAP_STATUS", b"")

    def test_other_messages_do_not_hold_off_the_end(self):
        for listen in (mocapd.listen, mocapd.listen_people):
            for prefix, told in (("", r"but mocapd sends there with the prefixes \['left_'\]: choose one with prefix="),
                                 ("left_", "only mocapd's status: .*; a node never sends poses, its studio does")):
                with self.assertRaisesRegex(TimeoutError, f"^udpm://: no {prefix}MOCAP_[A-Z]+ came for 5 s, {told}$"):
                    next(self.hears(self.STATUS, listen=listen, prefix=prefix))
        with self.assertRaisesRegex(TimeoutError, "but OTHER; expected messages of mocapd$"):
            next(self.hears(("OTHER", b"")))

    def test_neither_do_other_people(self):
        with self.assertRaisesRegex(TimeoutError, "no MOCAP_PEOPLE of person 2 came for 5 s, but of others; mocap status lists"):
            next(self.hears(*self.PEOPLE, person=2))

    def test_poses_do(self):
        self.assertEqual(len(list(itertools.islice(self.hears(self.BODY, self.POSE), 20))), 20)
        self.assertEqual(len(list(itertools.islice(self.hears(*self.PEOPLE, person=1), 20))), 20)
        self.assertEqual(len(list(itertools.islice(self.hears(*self.PEOPLE, listen=mocapd.listen_people), 20))), 20)


if __name__ == "__main__":
    sys.dont_write_bytecode = True
    unittest.main()
