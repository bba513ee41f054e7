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

    def hears(self, *events, first=(), listen=mocapd.listen, **arguments):
        def receive(_, deadline):
            for event in itertools.chain(first, itertools.cycle(events)):
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
            for prefix, told in (("", 'but mocapd sends there with prefix "left_": choose it with prefix='),
                                 ("left_", "only mocapd's status: .*; a node never sends poses, its studio does")):
                with self.assertRaisesRegex(TimeoutError, f"^udpm://: no {prefix}MOCAP_[A-Z]+ came for 5 s, {told}$"):
                    next(self.hears(self.STATUS, listen=listen, prefix=prefix))
        plain = ("MOCAP_STATUS", b"")
        with self.assertRaisesRegex(TimeoutError, "but mocapd sends there without a prefix: leave prefix= out$"):
            next(self.hears(plain, prefix="right."))
        with self.assertRaisesRegex(TimeoutError, 'there with the prefixes "", "left_": choose it with prefix=$'):
            next(self.hears(plain, self.STATUS, prefix="right."))
        with self.assertRaisesRegex(TimeoutError, "but OTHER; expected messages of mocapd$"):
            next(self.hears(("OTHER", b"")))

    def test_neither_do_other_people(self):
        with self.assertRaisesRegex(TimeoutError, "no MOCAP_PEOPLE of person 2 came for 5 s, but of others; mocap status lists"):
            next(self.hears(*self.PEOPLE, person=2))

    def test_what_came_before_the_last_pose_is_no_reason(self):
        other = ("OTHER", b"")
        for listen, first in ((mocapd.listen, (self.STATUS, self.BODY, self.POSE)), (mocapd.listen_people, self.PEOPLE)):
            with self.assertRaisesRegex(TimeoutError, "came for 5 s, but OTHER; expected messages of mocapd$"):
                list(self.hears(other, first=first, listen=listen))
        with self.assertRaisesRegex(TimeoutError, "came for 5 s, but OTHER; expected messages of mocapd$"):
            list(self.hears(other, first=self.PEOPLE, person=1))

    def test_silence_after_messages_is_silence(self):
        def receive(_, deadline):
            yield self.STATUS
            while True:
                deadline.left_s()
        clock = types.SimpleNamespace(monotonic=itertools.count().__next__)
        with mock.patch("mocapd.live.receive", receive), mock.patch("mocapd.lcm_udp.time", clock):
            with self.assertRaisesRegex(TimeoutError, "no message came for 5 s; is mocapd running"):
                list(mocapd.messages("udpm://", timeout_s=5))

    def test_poses_without_a_body_are_not_called_damaged(self):
        with self.assertRaisesRegex(TimeoutError, "only some without a body: no MOCAP_BODY came that fits them$"):
            next(self.hears(self.POSE))
        with self.assertRaisesRegex(TimeoutError, "of person 1 came for 5 s, only some without a body: no MOCAP_BODIES came"):
            next(self.hears(self.PEOPLE[1], person=1))

    def test_damaged_poses_are_called_so_whoever_is_waited_for(self):
        for arguments in ({}, {"person": 1}, {"listen": mocapd.listen_people}):
            with self.assertRaisesRegex(TimeoutError, "came for 5 s, only damaged ones$"):
                next(self.hears(("MOCAP_POSE", b"x"), ("MOCAP_PEOPLE", b"x"), **arguments))

    def test_many_channels_do_not_hide_the_one_that_is_waited_for(self):
        with mock.patch("mocapd.live.MOST_HEARD", 2):
            with self.assertRaisesRegex(TimeoutError, "only damaged ones$"):
                next(self.hears(("x1", b""), ("x2", b""), ("MOCAP_POSE", b"x")))

    def test_poses_do(self):
        self.assertEqual(len(list(itertools.islice(self.hears(self.BODY, self.POSE), 20))), 20)
        self.assertEqual(len(list(itertools.islice(self.hears(*self.PEOPLE, person=1), 20))), 20)
        self.assertEqual(len(list(itertools.islice(self.hears(*self.PEOPLE, listen=mocapd.listen_people), 20))), 20)


if __name__ == "__main__":
    sys.dont_write_bytecode = True
    unittest.main()
