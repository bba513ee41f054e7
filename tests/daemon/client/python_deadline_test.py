#!/usr/bin/python3
"""The Python package: when it gives up waiting for poses, and what it says then.

usage: python_deadline_test.py [TEST ...]      with the package in PYTHONPATH
"""
import itertools
import sys
import types
import unittest
from unittest import mock

import mocapd
from client_messages import body_message, people_message, person_body_message, pose_message


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
