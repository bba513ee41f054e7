"""What messages tell of people, in numpy."""
from __future__ import annotations

import dataclasses
import difflib
import struct
from typing import Any, TypeVar

import numpy as np

from .mocap.body_t import body_t
from .mocap.people_t import people_t
from .mocap.person_body_t import person_body_t
from .mocap.person_details_t import person_details_t
from .mocap.person_t import person_t
from .mocap.pose_t import pose_t

#: The 23 points of every pose, in the order of its arrays.
POINT_NAMES: tuple[str, ...] = (
    "torso", "head", "upper_arm_l", "upper_arm_r", "thigh_l", "thigh_r", "lower_arm_l", "lower_arm_r", "calf_l", "calf_r",
    "neck", "shoulder_l", "shoulder_r", "hip_l", "hip_r", "elbow_l", "elbow_r", "fingertips_l", "fingertips_r", "knee_l",
    "knee_r", "foot_l", "foot_r")
#: Points beyond the 23: of hands, feet and collarbones, where joints of the body turn these.
FURTHER_POINT_NAMES: tuple[str, ...] = (
    "clavicle_l", "clavicle_r", "wrist_l", "wrist_r", "ankle_l", "ankle_r", "heel_l", "heel_r", "ball_l", "ball_r", "toe_l", "toe_r",
    "knuckles_l", "knuckles_r")
#: Parts of the feet that touch the floor, in the order of `contacts`; a toe stands for the forefoot.
CONTACT_NAMES: tuple[str, ...] = ("heel_l", "heel_r", "toe_l", "toe_r")
#: Names of the paper's sixteen angles, theta_1 to theta_16, in mocapd's own body tables.
PAPER_JOINT_NAMES: tuple[str, ...] = (
    "neck_x", "neck_y", "shoulder_l_x", "shoulder_r_x", "shoulder_l_z", "shoulder_r_z", "shoulder_l_y", "shoulder_r_y", "elbow_l_z",
    "elbow_r_z", "hip_l_x", "hip_r_x", "hip_l_y", "hip_r_y", "knee_l_y", "knee_r_y")
THETA_NAMES = tuple(f"theta_{i + 1}" for i in range(len(PAPER_JOINT_NAMES)))
STATES = ("searching", "acquiring", "tracking", "lost")
TRACKING = "tracking"

#: Why a message makes no pose.
DAMAGED, BODILESS = "damaged", "bodiless"

LATEST_US = 4 * 10**15  # A larger value is not a time of day.

Message = TypeVar("Message")


def decoded(kind: type[Message], data: bytes) -> Message | None:
    """Decodes a message; None for what is none of its type, whatever stands in it."""
    try:
        return kind.decode(data)  # type: ignore[attr-defined]
    except (ValueError, struct.error, IndexError, OverflowError, MemoryError):
        return None


def place_of(name: str, names: tuple[str, ...], kind: str) -> int:
    """Where a name is among those that there are. @raises ValueError  naming them, the nearest first."""
    if name not in names:
        near = difflib.get_close_matches(name, names, n=3, cutoff=0.5)
        others = [other for other in names if other not in near]
        raise ValueError(f"there is no {kind} {name!r}; there are {', '.join(near + others)}")
    return names.index(name)


def is_time(utime: int) -> bool:
    return 0 <= utime <= LATEST_US


def has_numbers(message: Any) -> bool:
    """Whether the numbers of a pose_t or person_t are any."""
    parts = (message.torso_mm, message.torso_axis, message.torso_angle_rad, message.theta_rad, message.joint_rad, message.point_mm,
             message.point_std_mm, message.residual_mm)
    return all(np.isfinite(part).all() for part in parts)


def why_not(message: Any, body: Body | None) -> str:
    """Why a pose_t or person_t makes no pose with this body; None is a message that cannot be decoded."""
    if message is None or not has_numbers(message):
        return DAMAGED
    return BODILESS if body is None or len(body.joint_names) != message.num_joints else DAMAGED


def state_name(number: int) -> str:
    return STATES[min(max(number, 0), len(STATES) - 1)]


def rotation_matrix(axis: Any, angle_rad: float) -> np.ndarray:
    """Turns about an axis, a unit vector, by an angle; 3 x 3."""
    x, y, z = axis
    hat = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle_rad) * hat + (1 - np.cos(angle_rad)) * hat @ hat


@dataclasses.dataclass(frozen=True, eq=False)
class Body:
    """A person's measured body: sizes, and the axes about which its joints turn.

    Axes and places are in the torso's frame (x out of the chest, y to the left, z up), arms out to the sides and legs down.
    """
    model: str
    stature_mm: float
    sizes_mm: dict[str, float]
    joint_names: tuple[str, ...]
    joint_parents: np.ndarray  #: parent of each joint, which comes before it; -1: the torso
    joint_axes: np.ndarray  #: n x 3, unit vectors
    joint_places_mm: np.ndarray  #: n x 3, a point on each axis
    joint_limits_rad: np.ndarray  #: n x 2

    @classmethod
    def of(cls, message: body_t) -> Body:
        joints = message.num_joints
        return cls(model=message.model, stature_mm=message.stature_mm,
                   sizes_mm=dict(zip(message.size_name, message.size_mm)), joint_names=tuple(message.joint_name),
                   joint_parents=np.array(message.joint_parent, dtype=int),
                   joint_axes=np.array(message.joint_axis, dtype=float).reshape(joints, 3),
                   joint_places_mm=np.array(message.joint_place_mm, dtype=float).reshape(joints, 3),
                   joint_limits_rad=np.column_stack([message.joint_min_rad, message.joint_max_rad]))


@dataclasses.dataclass(frozen=True, eq=False)
class PoseDetails:
    """What MOCAP_DETAILS adds to a pose. NaN: not known."""
    probability: float = float("nan")  #: of the pose, 0 to 1
    further_points_mm: np.ndarray = dataclasses.field(default_factory=lambda: np.full((len(FURTHER_POINT_NAMES), 3), np.nan))
    further_points_std_mm: np.ndarray = dataclasses.field(default_factory=lambda: np.full(len(FURTHER_POINT_NAMES), np.nan))
    contacts: np.ndarray = dataclasses.field(default_factory=lambda: np.full(len(CONTACT_NAMES), np.nan))  #: 0 to 1

    @classmethod
    def of(cls, details: person_details_t) -> PoseDetails:
        added = cls(probability=float(details.probability) if 0 <= details.probability <= 1 else float("nan"))
        for i, name in enumerate(FURTHER_POINT_NAMES):
            if name not in details.point_name:
                continue
            place = details.point_name.index(name)
            if np.isfinite(details.point_mm[place]).all():
                added.further_points_mm[i] = details.point_mm[place]
                added.further_points_std_mm[i] = details.point_std_mm[place]
        for i, name in enumerate(CONTACT_NAMES):
            if name in details.contact_name:
                contact = details.contact[details.contact_name.index(name)]
                added.contacts[i] = contact if 0 <= contact <= 1 else np.nan
        return added


@dataclasses.dataclass(frozen=True, eq=False)
class Pose:
    """A person's pose at one moment. Arrays are full of NaN where nobody is tracked."""
    utime: int  #: of capture, microseconds since the Unix epoch
    frame: int  #: number of the frame set
    state: str  #: "searching", "acquiring", "tracking" or "lost"
    person: int | None  #: number of the person, if there are several
    name: str  #: name under which the person's sizes were saved; empty: none
    body: Body | None  #: None: not tracked
    torso_mm: np.ndarray  #: 3
    torso_rotation: np.ndarray  #: 3 x 3, from the torso's frame to the studio's
    theta_rad: np.ndarray  #: 16, the angles of the paper's Table 1
    joints_rad: np.ndarray  #: n, in the order of body.joint_names
    points_mm: np.ndarray  #: 23 x 3, in the order of POINT_NAMES
    points_std_mm: np.ndarray  #: 23
    residual_mm: float  #: mean distance between the body and the observations
    probability: float  #: of the pose, 0 to 1; NaN: not known
    further_points_mm: np.ndarray  #: 14 x 3, in the order of FURTHER_POINT_NAMES; NaN: not known
    further_points_std_mm: np.ndarray  #: 14
    contacts: np.ndarray  #: 4, how likely CONTACT_NAMES touch the floor, 0 to 1; NaN: not known

    @property
    def is_tracked(self) -> bool:
        return self.body is not None

    @property
    def time_s(self) -> float:
        """Of capture, since the Unix epoch."""
        return self.utime * 1e-6

    def point(self, name: str) -> np.ndarray:
        """Where one of POINT_NAMES or FURTHER_POINT_NAMES lies; 3 [mm]. @raises ValueError  for another name."""
        return np.concatenate([self.points_mm, self.further_points_mm])[place_of(name, POINT_NAMES + FURTHER_POINT_NAMES, "point")]

    def angle(self, joint: str) -> float:
        """How far a joint is turned [rad]: one of body.joint_names, or "theta_1" to "theta_16". NaN where nobody is tracked.

        @raises ValueError  for another name, where somebody is tracked.
        """
        if self.body is None:
            return float("nan")
        place = place_of(joint, self.body.joint_names + THETA_NAMES, "joint")
        return float(np.concatenate([self.joints_rad, self.theta_rad])[place])

    @classmethod
    def of(cls, message: pose_t | person_t, utime: int, frame: int, body: Body | None, person: int | None = None,
           name: str = "", details: PoseDetails | None = None) -> Pose | None:
        """Reads a message. None where somebody is tracked and the body is not known yet, or a number is none."""
        state = state_name(message.state)
        if not is_time(utime):
            return None
        if state != TRACKING:
            return cls.untracked(utime, frame, state, person, name)
        if body is None or len(body.joint_names) != message.num_joints or not has_numbers(message):
            return None
        details = details or PoseDetails()
        return cls(utime=utime, frame=frame, state=state, person=person, name=name, body=body,
                   torso_mm=np.array(message.torso_mm), theta_rad=np.array(message.theta_rad),
                   joints_rad=np.array(message.joint_rad),
                   torso_rotation=rotation_matrix(message.torso_axis, message.torso_angle_rad),
                   points_mm=np.array(message.point_mm), points_std_mm=np.array(message.point_std_mm),
                   residual_mm=message.residual_mm, **vars(details))

    @classmethod
    def untracked(cls, utime: int, frame: int, state: str, person: int | None, name: str) -> Pose:
        def nothing(*shape: int) -> np.ndarray:
            return np.full(shape, np.nan)
        return cls(utime=utime, frame=frame, state=state, person=person, name=name, body=None, torso_mm=nothing(3),
                   torso_rotation=nothing(3, 3), theta_rad=nothing(len(THETA_NAMES)), joints_rad=nothing(0),
                   points_mm=nothing(len(POINT_NAMES), 3), points_std_mm=nothing(len(POINT_NAMES)), residual_mm=float("nan"),
                   **vars(PoseDetails()))


class SetDetails:
    """What MOCAP_DETAILS told of the people in the latest frame set. It comes before their poses."""

    def __init__(self) -> None:
        self._of_set: list[person_details_t] = []

    def take(self, data: bytes) -> None:
        message = decoded(person_details_t, data)
        if message is None:
            return
        others = [before for before in self._of_set if before.utime == message.utime and before.person != message.person]
        self._of_set = [*others, message]

    def of(self, utime: int, person: int | None) -> PoseDetails:
        """The details of a person's pose; None: of the pose in pose_t."""
        for details in self._of_set:
            is_meant = details.place == 0 if person is None else details.person == person
            if details.utime == utime and is_meant:
                return PoseDetails.of(details)
        return PoseDetails()


class PoseDecoder:
    """Makes poses of a daemon's messages, which it takes one by one."""

    def __init__(self) -> None:
        self.body: Body | None = None
        self.bodies: dict[int, Body] = {}
        self.details = SetDetails()
        #: Whose poses were left out of the last message, and why: DAMAGED or BODILESS. None: of pose(), or everybody.
        self.left_out: dict[int | None, str] = {}

    def take_body(self, data: bytes) -> None:
        message = decoded(body_t, data)
        if message is not None:
            self.body = Body.of(message)

    def take_person_body(self, data: bytes) -> None:
        message = decoded(person_body_t, data)
        if message is not None:
            self.bodies[message.id] = Body.of(message.body)

    def pose(self, data: bytes) -> Pose | None:
        message = decoded(pose_t, data)
        pose = None if message is None else Pose.of(
            message, message.utime, message.frame, self.body, details=self.details.of(message.utime, None))
        self.left_out = {None: why_not(message, self.body)} if pose is None else {}
        return pose

    def people(self, data: bytes) -> list[Pose] | None:
        """Everybody of one set; None for what is none."""
        message = decoded(people_t, data)
        if message is None:
            self.left_out = {None: DAMAGED}
            return None
        self.bodies = {person.id: self.bodies[person.id] for person in message.people if person.id in self.bodies}
        poses = [Pose.of(person, message.utime, message.frame, self.bodies.get(person.id), person.id, person.name,
                         self.details.of(message.utime, person.id))
                 for person in message.people]
        self.left_out = {person.id: why_not(person, self.bodies.get(person.id))
                         for person, pose in zip(message.people, poses) if pose is None}
        return [pose for pose in poses if pose is not None]
