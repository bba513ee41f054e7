#!/usr/bin/python3
"""`mocap stream json` and `mocap export` beside the Python package: two readers that share no line have to agree, and with what
`mocap track` leaves.
"""
import csv
import json
import os
import signal
import socket
import subprocess
import tempfile
import unittest

import numpy as np

import mocapd
from client_log import BIN, TrackedTake, free_group, mocap, need_multicast
from mocapd.mocap import keypoint_senders_t

SOURCE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../..")
EXAMPLES = os.path.join(SOURCE, "docs/examples")
LAST_BONE = b"RightFoot\0"
ROUNDED_MM, ROUNDED_RAD, ROUNDED_SHARE = 6e-4, 6e-7, 6e-4


def lines_of(log, *words):
    return [json.loads(line) for line in mocap("stream", "json", "--url", f"file://{log}?speed=0", *words).splitlines()]


def example(name, *words):
    return subprocess.run(["/usr/bin/python3", "-B", os.path.join(EXAMPLES, name), *words], check=True, capture_output=True,
                          text=True, env={**os.environ, "MPLBACKEND": "Agg"}).stdout


class StreamTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.take = cls.enterClassContext(TrackedTake(people=2))
        cls.log = cls.take.log

    def assert_same(self, lines, poses):
        self.assertEqual([(line["utime"], line["frame"], line["state"]) for line in lines],
                         [(pose.utime, pose.frame, pose.state) for pose in poses])
        for line, pose in zip(lines, poses):
            self.assertEqual("points_mm" in line, pose.is_tracked)
            if not pose.is_tracked:
                continue
            self.assertEqual(tuple(line["joints_rad"]), pose.body.joint_names)
            known = [name for name in mocapd.POINT_NAMES + mocapd.FURTHER_POINT_NAMES if np.isfinite(pose.point(name)).all()]
            self.assertEqual(list(line["points_mm"]), known)
            np.testing.assert_allclose(list(line["points_mm"].values()), [pose.point(name) for name in known], rtol=0, atol=ROUNDED_MM)
            deviations = dict(zip(mocapd.POINT_NAMES + mocapd.FURTHER_POINT_NAMES,
                                  [*pose.points_std_mm, *pose.further_points_std_mm]))
            np.testing.assert_allclose(list(line["points_std_mm"].values()), [deviations[name] for name in known], rtol=0,
                                       atol=ROUNDED_MM)
            contacts = {name: contact for name, contact in zip(mocapd.CONTACT_NAMES, pose.contacts) if np.isfinite(contact)}
            self.assertEqual(list(line.get("contacts", {})), list(contacts))
            np.testing.assert_allclose(list(line.get("contacts", {}).values()), list(contacts.values()), rtol=0, atol=ROUNDED_SHARE)
            np.testing.assert_allclose(list(line["joints_rad"].values()), pose.joints_rad, rtol=0, atol=ROUNDED_RAD)
            np.testing.assert_allclose(line["torso_rotation"], pose.torso_rotation, rtol=0, atol=ROUNDED_RAD)
            np.testing.assert_allclose(line["torso_mm"], pose.torso_mm, rtol=0, atol=ROUNDED_MM)

    def test_lines_are_what_python_hears(self):
        lines = lines_of(self.log)
        self.assertGreater(sum(line["state"] == "tracking" for line in lines), 20)
        self.assert_same(lines, list(mocapd.listen("file://" + self.log)))

    def test_a_running_daemon_is_heard_by_both(self):
        need_multicast(self)
        url = free_group()
        stream = subprocess.Popen([os.path.join(BIN, "mocap"), "stream", "json", "--url", url], stdout=subprocess.PIPE, text=True)
        daemon = self.take.daemon(url, rate="realtime", loop="true")
        try:
            # From then on it hears all that is heard here.
            while json.loads(stream.stdout.readline())["state"] != "tracking":
                pass
            heard = mocapd.listen(url, timeout_s=60)
            poses = [next(pose for pose in heard if pose.is_tracked) for _ in range(5)]
            wanted = {pose.utime for pose in poses}
            lines = {}
            while not wanted <= set(lines):
                line = json.loads(stream.stdout.readline())
                lines[line["utime"]] = line
            self.assert_same([lines[pose.utime] for pose in poses], poses)
            stream.send_signal(signal.SIGINT)
            self.assertEqual(stream.wait(30), 0)
        finally:
            for process in (stream, daemon):
                process.kill()
                process.communicate()

    def test_everybody_has_lines(self):
        lines = lines_of(self.log, "--people")
        poses = [pose for people in mocapd.listen_people("file://" + self.log) for pose in people]
        self.assertEqual({line["person"] for line in lines}, {1, 2})
        self.assertEqual([line["person"] for line in lines], [pose.person for pose in poses])
        self.assert_same(lines, poses)

    def test_one_person_is_chosen(self):
        lines = [line for line in lines_of(self.log, "--person", "2") if line["state"] == "tracking"]
        self.assertGreater(len(lines), 5)
        self.assert_same(lines, [pose for pose in mocapd.listen("file://" + self.log, person=2) if pose.is_tracked])

    def test_a_person_who_is_not_there_is_told_with_those_who_are(self):
        refused = subprocess.run([os.path.join(BIN, "mocap"), "stream", "json", "--url", f"file://{self.log}?speed=0", "--person", "99"],
                                 capture_output=True, text=True)
        self.assertEqual(refused.returncode, 2)
        self.assertRegex(refused.stderr, r": person 99 is not tracked; last seen: person 1, person 2$")
        need_multicast(self)
        url = free_group()
        stream = subprocess.Popen([os.path.join(BIN, "mocap"), "stream", "json", "--url", url, "--person", "99"],
                                  stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        daemon = self.take.daemon(url, rate="realtime", loop="true")
        try:
            while "person 99 is not tracked; last seen: person " not in (line := stream.stderr.readline()):
                self.assertRegex(line, "no messages|no poses")
        finally:
            for process in (stream, daemon):
                process.kill()
                process.communicate()

    def test_what_runs_on_says_how_it_is_ended(self):
        for words in (("view", self.take.take, "--port", "0"), ("stream", "osc", "--url", free_group())):
            with subprocess.Popen([os.path.join(BIN, "mocap"), *words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True) as program:
                while "Ctrl-C ends it" not in (line := program.stdout.readline()):
                    self.assertTrue(line, words)
                program.send_signal(signal.SIGINT)
                self.assertEqual(program.wait(60), 0)

    def test_who_has_read_enough_ends_it_quietly(self):
        with subprocess.Popen([os.path.join(BIN, "mocap"), "stream", "json", "--url", f"file://{self.log}?speed=0"],
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE) as stream:
            stream.stdout.readline()
            stream.stdout.close()
            self.assertEqual(stream.stderr.read(), b"")
            self.assertEqual(stream.wait(), 0)

    def test_an_interrupt_ends_it_though_nobody_reads(self):
        with subprocess.Popen([os.path.join(BIN, "mocap"), "stream", "json", "--url", f"file://{self.log}?speed=0"],
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE) as stream:
            stream.stdout.readline()
            stream.send_signal(signal.SIGINT)
            self.assertEqual(stream.wait(60), 0)
            self.assertEqual(stream.stderr.read(), b"")

    def test_bones_go_to_whoever_was_named(self):
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as udp:
            udp.bind(("127.0.0.1", 0))
            udp.settimeout(60)
            to = "127.0.0.1:%d" % udp.getsockname()[1]
            done = subprocess.run([os.path.join(BIN, "mocap"), "stream", "osc", "--to", to, "--url", f"file://{self.log}?speed=0"],
                                  check=True, capture_output=True, text=True)
            self.assertEqual((done.stdout, done.stderr), ("", f"mocap stream: sends to {to}; Ctrl-C ends it\n"))
            heard = b""
            while LAST_BONE not in heard:
                heard += udp.recv(65536)
        self.assertEqual(heard.count(b"/VMC/Ext/Root/Pos\0"), 1)
        self.assertEqual(heard.count(b"/VMC/Ext/Bone/Pos\0"), 21)

    def test_a_log_reads_as_mocap_export_reads_it(self):
        with tempfile.TemporaryDirectory() as folder:
            table = os.path.join(folder, "out.csv")
            mocap("export", self.log, "--format", "csv", "--out", table)
            with open(table, newline="") as lines:
                rows = list(csv.DictReader(lines))
            result = mocapd.read_log(self.log)
            self.assertEqual(len(result), len(rows))
            self.assertEqual(set(result.to_columns()) - {"timestamp_ns"},
                             {name for name in rows[0] if not name.endswith("_deg")} - {"utime_us", "voxels"})
            for i, row in enumerate(rows):
                self.assertEqual((result.frame[i], result.state[i]), (int(row["frame"]), row["state"]))
                self.assertEqual(result.timestamp_ns[i], int(row["utime_us"]) * 1000)
                if not result.is_tracked[i]:
                    continue
                points = [[float(row[f"{name}_{axis}_mm"]) for axis in "xyz"] for name in mocapd.POINT_NAMES]
                np.testing.assert_allclose(result.points_mm[i], points, rtol=0, atol=ROUNDED_MM)
                deviations = [float(row[f"deviation_{name}_mm"]) for name in mocapd.POINT_NAMES]
                np.testing.assert_allclose(result.points_std_mm[i], deviations, rtol=0, atol=ROUNDED_MM)
                joints = [float(row[f"{name}_rad"]) for name in result.joint_names]
                np.testing.assert_allclose(result.joints_rad[i], joints, rtol=0, atol=ROUNDED_RAD)
                theta = [float(row[f"theta_{k + 1}_rad"]) for k in range(16)]
                np.testing.assert_allclose(result.theta_rad[i], theta, rtol=0, atol=ROUNDED_RAD)

    def test_people_have_the_names_that_mocap_export_gives(self):
        with tempfile.TemporaryDirectory() as folder:
            mocap("export", self.log, "--people", "--format", "csv", "--out", os.path.join(folder, "out.csv"))
            files = sorted(os.listdir(folder))
        self.assertEqual(files, [f"out-{name}.csv" for name in sorted(mocapd.read_people(self.log))])

    def test_the_examples_work(self):
        hands = example("follow_pose.py", "file://" + self.log).splitlines()
        tracked = [pose for pose in mocapd.listen("file://" + self.log) if pose.is_tracked]
        self.assertEqual(len(hands), len(tracked))
        self.assertIn("%6.0f %6.0f %6.0f mm   right" % tuple(tracked[-1].point("fingertips_l")), hands[-1])
        with tempfile.TemporaryDirectory() as folder:
            picture = os.path.join(folder, "take.png")
            example("plot_take.py", self.log, picture)
            with open(picture, "rb") as file:
                self.assertEqual(file.read(4), b"\x89PNG")

    def test_results_of_mocap_track_read_as_their_tables(self):
        with tempfile.TemporaryDirectory() as folder:
            mocap("track", self.take.take, "--people", "2", "--out", folder)
            people = mocapd.read_people(folder)
            self.assertEqual(list(people), ["person-1", "person-2"])
            for name, result in people.items():
                table = os.path.join(folder, name, "poses.csv")
                with open(table, newline="") as lines:
                    rows = list(csv.DictReader(lines))
                self.assertEqual(len(result), len(rows))
                self.assertGreater(result.is_tracked.sum(), 20)
                hand = [float(row["fingertips_r_z_mm"]) if row["state"] == "tracking" else np.nan for row in rows]
                np.testing.assert_array_equal(result.point("fingertips_r")[:, 2], hand)
                self.assertGreater(result.sizes_mm["thigh"], 200)
                # Angles have the names that live poses have.
                live = next(pose for pose in mocapd.listen("file://" + self.log) if pose.is_tracked)
                self.assertEqual(result.joint_names, live.body.joint_names)
                for theta, joint in enumerate(mocapd.PAPER_JOINT_NAMES):
                    np.testing.assert_array_equal(result.angle(joint), result.angle(f"theta_{theta + 1}"))
                self.assertFalse(np.isnan(result.points_std_mm[result.is_tracked]).any())
                with open(table, "a") as damaged:
                    damaged.write("1,2,tracking,x\n")
                with self.assertRaisesRegex(ValueError, f"poses.csv: line {len(rows) + 2}: .*expected"):
                    mocapd.read_result(os.path.dirname(table))

    def test_the_documents_python_runs_as_it_stands(self):
        with tempfile.TemporaryDirectory() as folder:
            mocap("track", self.take.take, "--out", os.path.join(folder, "result"))
            os.symlink(self.log, os.path.join(folder, "session.lcm"))
            with open(os.path.join(SOURCE, "docs/clients.md"), encoding="utf-8") as document:
                block = document.read().partition("```python\n")[2].partition("```")[0]
            # Nobody sends here: the log stands in for the service.
            block = block.replace("mocapd.listen(", f"mocapd.listen('file://{self.log}', ")
            block = block.replace("mocapd.listen_people(", f"mocapd.listen_people('file://{self.log}', ")
            done = subprocess.run(["/usr/bin/python3", "-B", "-c", block], cwd=folder, capture_output=True, text=True, timeout=60)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertEqual(len(done.stdout.splitlines()), 3)

    def test_an_example_sends_keypoints_that_the_daemon_takes(self):
        need_multicast(self)
        url = free_group()
        daemon = self.take.daemon(url, rate="realtime", loop="true")
        sender = subprocess.Popen(["/usr/bin/python3", "-B", os.path.join(EXAMPLES, "send_keypoints.py"), url, "60"],
                                  stderr=subprocess.PIPE, text=True)
        try:
            for channel, data in mocapd.messages(url, timeout_s=60):
                self.assertIsNone(sender.poll())
                if channel != "MOCAP_KEYPOINT_SENDERS":
                    continue
                senders = keypoint_senders_t.decode(data)
                if senders.num_senders and senders.taken[0] > 30:
                    break
            self.assertEqual(senders.name, ["example"])
            # Busy computers miss sets: what no set has taken in time is old.
            refused = {reason: count for reason, count in zip(senders.reason, senders.refused[0]) if count > 0 and reason != "old"}
            self.assertEqual(refused, {})
            self.assertEqual(senders.dropped_points[0], 0)
            self.assertLess(senders.lag_ms[0], 1000)
        finally:
            for process in (sender, daemon):
                process.kill()
                process.communicate()

    def test_examples_tell_how_they_are_used(self):
        for name, wrong in (("follow_pose.py", ["", "1", "left.", "more"]), ("plot_take.py", []), ("plot_take.py", ["a", "b", "c"]),
                            ("send_keypoints.py", ["", "1", "left.", "more"])):
            self.assertIn(f"usage: {name} ", example(name, "--help"))
            done = subprocess.run(["/usr/bin/python3", "-B", os.path.join(EXAMPLES, name), *wrong], capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stdout), (1, ""))
            self.assertIn(f"usage: {name} ", done.stderr)
            self.assertNotIn("Traceback", done.stderr)

    def test_an_example_that_hears_nothing_says_so_in_a_line(self):
        need_multicast(self)
        done = subprocess.run(["/usr/bin/python3", "-B", os.path.join(EXAMPLES, "follow_pose.py"), "udpm://239.255.76.65:7667", "0.1"],
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, r"^follow_pose: udpm://239.255.76.65:7667: no MOCAP_POSE came for 0.1 s; .*\n$")


if __name__ == "__main__":
    unittest.main()
