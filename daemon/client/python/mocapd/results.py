"""Whole takes: what `mocap track` left, and logs of messages."""
from __future__ import annotations

import csv
import dataclasses
import os
import pathlib
import tomllib
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from .lcm_log import listed_prefixes, read_events
from .mocap.people_t import people_t
from .mocap.pose_t import pose_t
from .poses import (CONTACT_NAMES, FURTHER_POINT_NAMES, PAPER_JOINT_NAMES, POINT_NAMES, THETA_NAMES, TRACKING, Body, PoseDecoder,
                    PoseDetails, SetDetails, decoded, has_numbers, is_time, place_of, rotation_matrix, state_name)

if TYPE_CHECKING:
    import pandas

Path = str | os.PathLike[str]
POSE, BODY, PEOPLE, BODIES, DETAILS = "MOCAP_POSE", "MOCAP_BODY", "MOCAP_PEOPLE", "MOCAP_BODIES", "MOCAP_DETAILS"

#: The columns that every poses.csv has. The first torso_x_mm and so on are the origin of the torso's frame, the second the point torso.
COLUMNS: tuple[str, ...] = (
    "frame", "timestamp_ns", "state", "torso_x_mm", "torso_y_mm", "torso_z_mm", "torso_axis_x", "torso_axis_y", "torso_axis_z",
    "torso_angle_rad", *(f"{name}_rad" for name in THETA_NAMES), *(f"{name}_{axis}_mm" for name in POINT_NAMES for axis in "xyz"),
    "residual_mm", "voxels")
TORSO_PLACE, ANGLE_PLACE, THETA_PLACE, POINT_PLACE, RESIDUAL_PLACE = 3, 9, 10, 26, 95


@dataclasses.dataclass(frozen=True, eq=False)
class Result:
    """A person's poses, a row a frame set. Whatever was not tracked is NaN."""
    model: str  #: name of the body's table
    stature_mm: float
    sizes_mm: dict[str, float]
    frame: np.ndarray  #: n, numbers of the frame sets
    timestamp_ns: np.ndarray  #: n, of capture
    state: np.ndarray  #: n, words
    torso_mm: np.ndarray  #: n x 3
    torso_axis: np.ndarray  #: n x 3, unit vectors about which the torso is turned
    torso_angle_rad: np.ndarray  #: n
    torso_rotation: np.ndarray  #: n x 3 x 3, the same turn: from the torso's frame to the studio's
    theta_rad: np.ndarray  #: n x 16, the angles of the paper's Table 1
    points_mm: np.ndarray  #: n x 23 x 3, in the order of POINT_NAMES
    residual_mm: np.ndarray  #: n
    points_std_mm: np.ndarray  #: n x 23, standard deviation of each point along its worst axis; NaN in results without
    probability: np.ndarray  #: n, of the pose, 0 to 1; NaN where the tracker could not tell, and in results without
    further_points_mm: np.ndarray  #: n x 14 x 3, in the order of FURTHER_POINT_NAMES; NaN where they are not known
    further_points_std_mm: np.ndarray  #: n x 14
    contacts: np.ndarray  #: n x 4, how likely CONTACT_NAMES touch the floor, 0 to 1; NaN where it is not known
    joint_names: tuple[str, ...]  #: as of live poses; in results without them, the paper's sixteen
    joints_rad: np.ndarray  #: n x joint_names

    def __len__(self) -> int:
        return len(self.frame)

    @property
    def is_tracked(self) -> np.ndarray:
        return self.state == TRACKING

    @property
    def time_s(self) -> np.ndarray:
        """Since the first frame set; n."""
        return (self.timestamp_ns - self.timestamp_ns[:1]) * 1e-9

    def point(self, name: str) -> np.ndarray:
        """Where one of POINT_NAMES or FURTHER_POINT_NAMES lies; n x 3 [mm]. @raises ValueError  for another name."""
        points = np.concatenate([self.points_mm, self.further_points_mm], axis=1)
        return points[:, place_of(name, POINT_NAMES + FURTHER_POINT_NAMES, "point")]

    def angle(self, joint: str) -> np.ndarray:
        """How far a joint is turned; n [rad]. One of joint_names, or "theta_1" to "theta_16" of Table 1.

        @raises ValueError  for another name.
        """
        place = place_of(joint, self.joint_names + THETA_NAMES, "joint")
        joints = len(self.joint_names)
        return self.joints_rad[:, place] if place < joints else self.theta_rad[:, place - joints]

    def to_columns(self) -> dict[str, np.ndarray]:
        """A column a number, each of n rows, with the names of `mocap export --format csv`."""
        columns = {"frame": self.frame, "timestamp_ns": self.timestamp_ns, "time_s": self.time_s, "state": self.state}
        columns |= {f"torso_origin_{name}_mm": self.torso_mm[:, i] for i, name in enumerate("xyz")}
        columns |= {f"torso_axis_{name}": self.torso_axis[:, i] for i, name in enumerate("xyz")}
        columns["torso_angle_rad"] = self.torso_angle_rad
        columns |= {f"{name}_rad": self.theta_rad[:, i] for i, name in enumerate(THETA_NAMES)}
        columns |= {f"{name}_{axis}_mm": self.points_mm[:, i, k] for i, name in enumerate(POINT_NAMES)
                    for k, axis in enumerate("xyz")}
        columns["residual_mm"] = self.residual_mm
        columns |= {f"{name}_rad": self.joints_rad[:, i] for i, name in enumerate(self.joint_names)}
        columns |= {f"{name}_{axis}_mm": self.further_points_mm[:, i, k] for i, name in enumerate(FURTHER_POINT_NAMES)
                    for k, axis in enumerate("xyz")}
        deviations = np.concatenate([self.points_std_mm, self.further_points_std_mm], axis=1)
        columns |= {f"deviation_{name}_mm": deviations[:, i] for i, name in enumerate(POINT_NAMES + FURTHER_POINT_NAMES)}
        columns |= {f"contact_{name}": self.contacts[:, i] for i, name in enumerate(CONTACT_NAMES)}
        columns["probability"] = self.probability
        return columns

    def to_pandas(self) -> pandas.DataFrame:
        """The same as a table. Needs pandas."""
        import pandas
        return pandas.DataFrame(self.to_columns())


def read_result(folder: Path) -> Result:
    """Reads a folder of `mocap track`, or RESULT/person-K of several people.

    @raises OSError  where it is none. @raises ValueError  naming file and line of what is damaged, or what else it is: a log, a
    take, or a result of several people.
    """
    poses = pathlib.Path(folder) / "poses.csv"
    if pathlib.Path(folder).is_file():
        raise ValueError(f"{folder}: is a file; use read_log() for a log, or give the folder that mocap track made")
    if not poses.exists():
        if _person_folders(folder):
            raise ValueError(f"{folder}: contains several people; use read_people(), or one of its folders person-K")
        _refuse_take(folder)
        raise FileNotFoundError(f"{poses}: not found; expected the folder that mocap track made")
    body = _read_body(pathlib.Path(folder) / "body.toml")
    rows = _Rows()
    with open(poses, newline="", encoding="utf-8-sig") as table:
        reader = csv.reader(table)
        header = next(reader, [])
        if tuple(header[:len(COLUMNS)]) != COLUMNS:
            raise ValueError(f"{poses}: line 1: is no header of poses.csv; expected {', '.join(COLUMNS[:4])} ... as mocap track writes it")
        columns = _joint_columns(poses, header, body)
        places = _Places(joints=[header.index(column) for column in columns.values()],
                         deviations=[_place_in(header, f"deviation_{point}_mm") for point in POINT_NAMES],
                         further=[_place_in(header, f"{point}_{axis}_mm") for point in FURTHER_POINT_NAMES for axis in "xyz"],
                         further_deviations=[_place_in(header, f"deviation_{point}_mm") for point in FURTHER_POINT_NAMES],
                         contacts=[_place_in(header, f"contact_{point}") for point in CONTACT_NAMES],
                         probability=_place_in(header, "probability"))
        for row in filter(None, reader):
            try:
                if len(row) != len(header):
                    raise ValueError(f"has {len(row)} cells, not {len(header)}")
                rows.add_cells(row, places)
            except (ValueError, OverflowError) as error:
                raise ValueError(f"{poses}: line {reader.line_num}: {error}; expected a row of poses.csv") from error
    sizes = {name.removesuffix("_mm"): size for name, size in body.get("sizes", {}).items()}
    return rows.result(body["model"], body["stature_mm"], sizes, tuple(columns))


def _place_in(header: list[str], column: str) -> int | None:
    return header.index(column) if column in header else None


def _read_body(file: pathlib.Path) -> dict[str, Any]:
    if not file.exists():
        raise FileNotFoundError(f"{file}: not found; expected it beside poses.csv, as mocap track writes it")
    try:
        body = tomllib.loads(file.read_text(encoding="utf-8"))
    except ValueError as error:
        raise ValueError(f"{file}: {error}; expected TOML, as mocap track writes it") from error
    for key in ("model", "stature_mm"):
        if key not in body:
            raise ValueError(f"{file}: {key} is missing; expected it, as mocap track writes it")
    joints = body.setdefault("joints", {"names": PAPER_JOINT_NAMES, "columns": [f"{name}_rad" for name in THETA_NAMES]})
    if len(joints.get("names", ())) != len(joints.get("columns", ())):
        raise ValueError(f"{file}: joints.names and joints.columns differ in length; expected a column for each joint")
    for name, column in zip(joints["names"], joints["columns"]):
        if column not in (f"{name}_rad", *(f"{theta}_rad" for theta in THETA_NAMES)):
            raise ValueError(f"{file}: joints.columns has {column!r} for the joint {name}; expected {name}_rad, or one of theta_1_rad "
                             "to theta_16_rad")
    return body


def _joint_columns(poses: pathlib.Path, header: list[str], body: dict[str, Any]) -> dict[str, str]:
    """The columns of the joints by their names. Older results have the paper's sixteen angles only."""
    columns = dict(zip(body["joints"]["names"], body["joints"]["columns"]))
    if len(header) == len(COLUMNS):
        return {name: column for name, column in columns.items() if column in COLUMNS}
    for column in columns.values():
        if column not in header:
            raise ValueError(f"{poses}: line 1: has no column {column!r}; expected it, as [joints] columns of body.toml names it")
    return columns


def read_log(path: Path, prefix: str | None = None, person: int | None = None) -> Result:
    """Reads the poses in a log: of whoever had been followed the longest, or of one person.

    @param prefix  what stands before the channels' names; None: whatever it is, if it is one.
    @param person  number, as in read_people().
    @raises ValueError  when it holds none, or those of several daemons, or is a folder.
    """
    if pathlib.Path(path).is_dir():
        raise ValueError(f"{path}: is a folder; use read_result() or read_people() for what mocap track made")
    _require(path)
    if person is not None:
        people = _read_people_log(path, prefix)
        if person not in people:
            raise ValueError(f"{path}: contains no person {person}; there are {sorted(people)}")
        return people[person][1]
    chosen = _choose_prefix(path, POSE, prefix)
    decoder, rows = PoseDecoder(), _Rows()
    for channel, data in read_events(path):
        if channel == chosen + BODY:
            decoder.take_body(data)
        elif channel == chosen + DETAILS:
            decoder.details.take(data)
        elif channel == chosen + POSE:
            message = decoded(pose_t, data)
            if message is not None:
                rows.add_message(message, message.utime, message.frame, decoder.details.of(message.utime, None))
    return _result_of(path, rows, decoder.body)


def read_people(folder_or_log: Path, prefix: str | None = None) -> dict[str, Result]:
    """Reads everybody out of a folder of `mocap track --people`, or out of a log.

    @return  by "person-1" and so on; out of a log by the person's name, for whoever has one of his own.
    @raises ValueError  for a folder of one person, for a take, and for other folders.
    """
    folder = pathlib.Path(folder_or_log)
    if (folder / "poses.csv").exists():
        raise ValueError(f"{folder}: is a result of one person; use read_result()")
    if folder.is_dir():
        people = _person_folders(folder)
        if not people:
            _refuse_take(folder)
            # Where nobody was tracked, `mocap track --people` leaves an empty folder.
            if any(folder.iterdir()):
                raise ValueError(f"{folder}: contains no person-1 or the like; expected what mocap track --people makes, or a log")
        return {person.name: read_result(person) for person in people}
    _require(folder)
    results: dict[str, Result] = {}
    for number, (name, result) in _read_people_log(folder, prefix).items():
        # Two people may have had the same name, one after the other.
        results[name if name and name not in results else f"person-{number}"] = result
    return results


def _require(log: Path) -> None:
    if not pathlib.Path(log).exists():
        raise FileNotFoundError(f"{log}: not found; expected a log of lcm-logger")
    if pathlib.Path(log).name in ("poses.csv", "body.toml"):
        raise ValueError(f"{log}: is a file of a result, not a log; use read_result() with its folder, {pathlib.Path(log).parent}")


def _person_folders(folder: Path) -> list[pathlib.Path]:
    """Results in RESULT/person-K, by number; a take has folders of these names without poses."""
    numbers = {path: path.name.removeprefix("person-") for path in pathlib.Path(folder).glob("person-*")}
    return sorted((path for path, number in numbers.items() if number.isdecimal() and (path / "poses.csv").exists()),
                  key=lambda path: int(numbers[path]))


def _refuse_take(folder: Path) -> None:
    if (pathlib.Path(folder) / "take.toml").exists():
        raise ValueError(f"{folder}: is a take, not a result; track it first: mocap track TAKE --out RESULT")


def _read_people_log(path: Path, prefix: str | None) -> dict[int, tuple[str, Result]]:
    """By number. Whom a daemon follows after it was started again is somebody else, with a number above all before."""
    chosen = _choose_prefix(path, PEOPLE, prefix)
    rows: dict[int, _Rows] = {}
    names: dict[int, str] = {}
    bodies: dict[int, Body] = {}
    decoder, details = PoseDecoder(), SetDetails()
    before, frame = 0, -1
    for channel, data in read_events(path):
        if channel == chosen + BODIES:
            decoder.take_person_body(data)
            bodies |= {before + number: body for number, body in decoder.bodies.items() if before + number in rows}
        elif channel == chosen + DETAILS:
            details.take(data)
        elif channel == chosen + PEOPLE:
            people = decoded(people_t, data)
            if people is None:
                continue
            if people.frame < frame:
                before, decoder = max(rows, default=0), PoseDecoder()
            frame = people.frame
            for person in people.people:
                rows.setdefault(before + person.id, _Rows()).add_message(
                    person, people.utime, people.frame, details.of(people.utime, person.id))
                names[before + person.id] = person.name or names.get(before + person.id, "")
    return {number: (names[number], _result_of(path, rows[number], bodies[number])) for number in sorted(rows)
            if number in bodies}


def _result_of(path: Path, rows: _Rows, body: Body | None) -> Result:
    if body is None:
        raise ValueError(f"{path}: contains no body message of mocapd; expected a log of its messages")
    return rows.result(body.model, body.stature_mm, body.sizes_mm, body.joint_names)


def _choose_prefix(path: Path, name: str, wanted: str | None) -> str:
    found = {channel.removesuffix(name) for channel, _ in read_events(path) if channel.endswith(name)}
    if wanted is None and len(found) == 1:
        return found.pop()
    if wanted is None and found:
        raise ValueError(f"{path}: contains messages of several daemons, {listed_prefixes(found)}: choose one with prefix=")
    if wanted is None or wanted not in found:
        there = f", but some {listed_prefixes(found)}" if found else "; expected a log of mocapd's messages"
        raise ValueError(f"{path}: contains no {wanted or ''}{name}{there}")
    return wanted


class _Places(NamedTuple):
    """Where columns of poses.csv are that not every result has."""
    joints: list[int]
    deviations: list[int | None]
    further: list[int | None]
    further_deviations: list[int | None]
    contacts: list[int | None]
    probability: int | None


class _Rows:
    """Rows of a result, as they are read."""

    def __init__(self) -> None:
        self.heads: list[tuple[int | np.int64, int | np.int64, str]] = []
        self.poses: list[tuple[np.ndarray, ...] | None] = []

    def add_cells(self, row: list[str], places: _Places) -> None:
        def numbers(begin: int, end: int) -> np.ndarray:
            return np.array([float(cell) for cell in row[begin:end]])

        def number_or_none(place: int | None) -> float:
            return float(row[place] or "nan") if place is not None else float("nan")

        def numbers_or_none(places: list[Any]) -> np.ndarray:
            return np.array([number_or_none(place) for place in places])
        self.heads.append((np.int64(int(row[0])), np.int64(int(row[1])), row[2]))
        if row[2] != TRACKING:
            self.poses.append(None)
            return
        self.poses.append((numbers(TORSO_PLACE, TORSO_PLACE + 3), numbers(TORSO_PLACE + 3, ANGLE_PLACE), np.array(float(row[ANGLE_PLACE])),
                           numbers(THETA_PLACE, POINT_PLACE), numbers(POINT_PLACE, RESIDUAL_PLACE).reshape(-1, 3),
                           np.array(float(row[RESIDUAL_PLACE])), numbers_or_none(places.deviations),
                           np.array(number_or_none(places.probability)), numbers_or_none(places.further).reshape(-1, 3),
                           numbers_or_none(places.further_deviations), numbers_or_none(places.contacts),
                           numbers_or_none(places.joints)))

    def add_message(self, message: Any, utime: int, frame: int, details: PoseDetails) -> None:
        state = state_name(message.state)
        head = (frame, utime * 1000, state)
        came_before = bool(self.heads) and self.heads[-1] == head
        if came_before or not is_time(utime) or not has_numbers(message):
            return
        self.heads.append(head)
        self.poses.append(None if state != TRACKING else (
            np.array(message.torso_mm), np.array(message.torso_axis), np.array(message.torso_angle_rad),
            np.array(message.theta_rad), np.array(message.point_mm), np.array(message.residual_mm),
            np.array(message.point_std_mm), np.array(details.probability), details.further_points_mm, details.further_points_std_mm,
            details.contacts, np.array(message.joint_rad)))

    def result(self, model: str, stature_mm: float, sizes_mm: dict[str, float], joint_names: tuple[str, ...]) -> Result:
        shapes = ((3,), (3,), (), (len(THETA_NAMES),), (len(POINT_NAMES), 3), (), (len(POINT_NAMES),), (),
                  (len(FURTHER_POINT_NAMES), 3), (len(FURTHER_POINT_NAMES),), (len(CONTACT_NAMES),),
                  (len(joint_names),))
        columns = [np.full((len(self.heads), *shape), np.nan) for shape in shapes]
        for i, pose in enumerate(self.poses):
            if pose is None:
                continue
            for column, value in zip(columns, pose):
                # Joints of a body that the person had before have no column.
                if column[i].shape == value.shape:
                    column[i] = value
        frames, times, states = zip(*self.heads) if self.heads else ((), (), ())
        (torso_mm, axes, angles, theta, points, residual, deviations, probability, further, further_deviations, contacts,
         joints) = columns
        rotation = np.array([rotation_matrix(*turn) for turn in zip(axes, angles)]).reshape(-1, 3, 3)
        return Result(model=model, stature_mm=stature_mm, sizes_mm=sizes_mm, frame=np.array(frames, dtype=np.int64),
                      timestamp_ns=np.array(times, dtype=np.int64), state=np.array(states, dtype=str), torso_mm=torso_mm,
                      torso_axis=axes, torso_angle_rad=angles, torso_rotation=rotation, theta_rad=theta, points_mm=points,
                      residual_mm=residual, points_std_mm=deviations, probability=probability, further_points_mm=further,
                      further_points_std_mm=further_deviations, contacts=contacts, joint_names=joint_names, joints_rad=joints)
