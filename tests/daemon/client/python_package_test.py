#!/usr/bin/python3
"""The Python package: what it makes of packets, addresses and messages, whole and damaged, and of poses as they come.

usage: python_package_test.py [TEST ...]      with the package in PYTHONPATH
"""
import os
import random
import signal
import socket
import struct
import subprocess
import sys
import unittest

import numpy as np

import mocapd
from client_log import GROUP, free_group, need_multicast
from client_messages import JOINTS, START_US, LogTest, body_message, details_message, people_message, person_body_message, pose_message
from mocapd.lcm_udp import (FRAGMENT_HEADER, FRAGMENT_MAGIC, MOST_BYTES, MOST_SENDERS, SHORT_HEADER, SHORT_MAGIC, Reassembly,
                            parse_group)
from mocapd.mocap import people_t, pose_t
from mocapd.poses import decoded


def short_packet(channel, data, number=1):
    return SHORT_HEADER.pack(SHORT_MAGIC, number) + channel.encode() + b"\0" + data


def pieces_of(channel, data, number, size=1000):
    """As LCM cuts a message: the first piece has the channel before its data."""
    cuts = [data[place:place + size] for place in range(0, len(data), size)]
    return [FRAGMENT_HEADER.pack(FRAGMENT_MAGIC, number, len(data), i * size, i, len(cuts)) +
            (channel.encode() + b"\0" if i == 0 else b"") + cut for i, cut in enumerate(cuts)]


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
        for message in (pose_message(1), body_message(), people_message(1, [(1, "anna"), (2, "")]), person_body_message(1),
                        details_message(1, 2, 0, 0.6)):
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

    def test_a_pose_is_as_sure_as_its_details_tell(self):
        self.log.add("MOCAP_BODY", body_message()).add("MOCAP_POSE", pose_message(3))
        for frame, probability in ((4, 0.6), (5, 7.0)):
            self.log.add("MOCAP_DETAILS", details_message(frame, 12, 0, probability)).add("MOCAP_POSE", pose_message(frame))
        self.log.write()
        np.testing.assert_array_equal([pose.probability for pose in mocapd.listen(self.url)], [np.nan, 0.6, np.nan])

    def test_details_tell_points_and_contacts_by_name(self):
        self.log.add("MOCAP_BODY", body_message()).add("MOCAP_POSE", pose_message(3))
        self.log.add("MOCAP_DETAILS", details_message(4, 12, 0, 0.6)).add("MOCAP_POSE", pose_message(4)).write()
        before, pose = mocapd.listen(self.url)
        result = mocapd.read_log(self.log.path)
        self.assertTrue(np.isnan(before.contacts).all() and np.isnan(before.point("wrist_l")).all())
        np.testing.assert_array_equal(pose.contacts, [0.25, np.nan, 0.75, np.nan])
        np.testing.assert_array_equal(pose.point("wrist_l"), [1, 2, 3])
        np.testing.assert_array_equal(result.contacts, [before.contacts, pose.contacts])
        np.testing.assert_array_equal(result.point("wrist_l")[1], [1, 2, 3])

    def test_everybody_has_a_probability_of_their_own(self):
        for number in (1, 4):
            self.log.add("MOCAP_BODIES", person_body_message(number))
        self.log.add("MOCAP_PEOPLE", people_message(1, [(1, ""), (4, "")]))
        for number, probability in ((1, 0.9), (4, 0.6)):
            self.log.add("MOCAP_DETAILS", details_message(2, number, number // 4, probability))
        self.log.add("MOCAP_PEOPLE", people_message(2, [(1, ""), (4, "")])).write()
        *_, people = mocapd.listen_people(self.url)
        self.assertEqual([pose.probability for pose in people], [0.9, 0.6])

    def test_names_that_are_none_are_answered_with_those_that_there_are(self):
        self.log.add("MOCAP_BODY", body_message()).add("MOCAP_POSE", pose_message(3)).write()
        pose, = mocapd.listen(self.url)
        result = mocapd.read_log(self.log.path)
        for some in (pose, result):
            with self.assertRaisesRegex(ValueError, "no point 'wrist'; there are wrist_.*torso, head, .*fingertips_l"):
                some.point("wrist")
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


if __name__ == "__main__":
    sys.dont_write_bytecode = True
    unittest.main()
