#!/usr/bin/python3
"""The Python package: what it makes of results and logs, whole and damaged.

usage: python_result_test.py [TEST ...]      with the package in PYTHONPATH
"""
import os
import sys
import tempfile
import unittest
import warnings

import numpy as np

import mocapd
from client_log import skip
from client_messages import LogTest, body_message, details_message, people_message, person_body_message, pose_message
from mocapd.lcm_log import HEAD, MARK
from mocapd.mocap import pose_t
from mocapd.results import COLUMNS


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
        self.assertTrue(np.isnan(result.points_std_mm).all() and np.isnan(result.probability).all())

    def test_further_columns_are_found_by_name(self):
        result = self.result(("probability", "deviation_head_mm", "wrist_l_x_rad"), ("0.625", "6.5", "-0.5"), self.BODY + self.JOINTS)
        np.testing.assert_array_equal(result.probability, [0.625])
        self.assertEqual(result.joint_names, ("knee_r_y", "wrist_l_x"))
        np.testing.assert_array_equal(result.angle("wrist_l_x"), [-0.5])
        np.testing.assert_array_equal(result.angle("knee_r_y"), result.theta_rad[:, 15])
        self.assertEqual(result.points_std_mm[0, 1], 6.5)

    def test_contacts_are_found_by_name(self):
        result = self.result(("contact_toe_l", "contact_heel_l"), ("0.75", "0.25"))
        np.testing.assert_array_equal(result.contacts, [[0.25, np.nan, 0.75, np.nan]])
        np.testing.assert_array_equal(result.to_columns()["contact_toe_l"], [0.75])

    def test_what_has_no_value_is_nan(self):
        result = self.result(("probability", "deviation_head_mm", "wrist_l_x_rad"), ("", "", ""), self.BODY + self.JOINTS)
        self.assertTrue(np.isnan(result.probability[0]))
        self.assertTrue(np.isnan(result.points_std_mm[0, 1]) and np.isnan(result.angle("wrist_l_x")[0]))

    def test_a_column_that_the_body_names_and_the_table_lacks_is_told(self):
        with self.assertRaisesRegex(ValueError, "poses.csv: line 1: has no column 'wrist_l_x_rad'; expected it, as .joints. columns of body.toml"):
            self.result(("deviation_head_mm",), ("6.5",), self.BODY + self.JOINTS)
        with self.assertRaisesRegex(ValueError, "body.toml: joints.columns has 'wrist_rad' for the joint wrist_l_x; expected wrist_l_x_rad, or"):
            self.result(("wrist_rad",), ("6.5",), self.BODY + self.JOINTS.replace("wrist_l_x_rad", "wrist_rad"))

    def test_an_older_result_has_only_the_papers_joints(self):
        self.assertEqual(self.result(body=self.BODY + self.JOINTS).joint_names, ("knee_r_y",))

    def test_another_table_is_told(self):
        with self.assertRaisesRegex(ValueError, "poses.csv: line 2: has 97 cells, not 98"):
            self.result(("probability",))
        with open(os.path.join(self.folder, "poses.csv"), "w", encoding="utf-8") as table:
            table.write("frame,timestamp_ns,x\n")
        with self.assertRaisesRegex(ValueError, "poses.csv: line 1: is no header of poses.csv; expected frame, "):
            mocapd.read_result(self.folder)


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
        with self.assertRaisesRegex(ValueError, 'daemons, with the prefixes "left.", "right.": choose one with prefix=$'):
            mocapd.read_log(self.log.path)
        with self.assertRaisesRegex(ValueError, 'contains no top.MOCAP_POSE, but some with the prefixes "left.", "right."$'):
            mocapd.read_log(self.log.path, prefix="top.")
        self.assertEqual(list(mocapd.read_log(self.log.path, prefix="right.").frame), [6])

    def test_of_a_file_of_a_result_the_folder_is_wanted(self):
        with tempfile.TemporaryDirectory() as folder:
            table = os.path.join(folder, "poses.csv")
            open(table, "w").close()
            for read in (mocapd.read_log, mocapd.read_people):
                with self.assertRaisesRegex(ValueError, f"is a file of a result, not a log; use read_result.* its folder, {folder}$"):
                    read(table)

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

    def test_how_sure_poses_are_comes_with_the_details_of_the_same_set(self):
        self.whole().add("MOCAP_DETAILS", details_message(6, 12, 0, 0.6)).add("MOCAP_DETAILS", details_message(6, 1, 1, 0.9))
        self.log.add("MOCAP_POSE", pose_message(6))
        self.log.add("MOCAP_DETAILS", details_message(6, 12, 0, 0.6)).add("MOCAP_POSE", pose_message(7))
        result = mocapd.read_log(self.log.write())
        np.testing.assert_array_equal(result.probability, [np.nan] * 6 + [0.6, np.nan])
        np.testing.assert_array_equal(result.to_columns()["probability"], result.probability)

    def test_people_who_come_after_a_restart_are_as_sure_as_their_details(self):
        for frame in (5, 0):
            for number in (1, 2):
                self.log.add("MOCAP_DETAILS", details_message(frame, number, number - 1, 0.1 * number + 0.01 * frame))
            self.log.add("MOCAP_PEOPLE", people_message(frame, [(1, ""), (2, "")]))
            for number in (1, 2):
                self.log.add("MOCAP_BODIES", person_body_message(number))
        people = mocapd.read_people(self.log.write())
        np.testing.assert_allclose([result.probability[0] for result in people.values()], [0.15, 0.25, 0.1, 0.2])

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


if __name__ == "__main__":
    sys.dont_write_bytecode = True
    unittest.main()
