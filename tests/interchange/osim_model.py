"""Reads the joints of an OpenSim model and moves them: as little of OpenSim as tells where a motion puts the bodies."""
import xml.etree.ElementTree

import numpy as np


def numbers(element, name):
    return np.array([float(word) for word in element.findtext(name).split()])


def turn(axis, angle):
    x, y, z = axis / np.linalg.norm(axis)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


def transform(rotation, translation):
    whole = np.eye(4)
    whole[:3, :3], whole[:3, 3] = rotation, translation
    return whole


def offset(frame):
    x, y, z = numbers(frame, "orientation")
    axes = np.eye(3)
    return transform(turn(axes[0], x) @ turn(axes[1], y) @ turn(axes[2], z), numbers(frame, "translation"))


def value(function, coordinate):
    if function.tag == "LinearFunction":
        slope, constant = numbers(function, "coefficients")
        return slope * coordinate + constant
    if function.tag == "Constant":
        return float(function.findtext("value"))
    return float(np.interp(coordinate, numbers(function, "x"), numbers(function, "y")))


class Joint:
    def __init__(self, element):
        self.kind = element.tag
        frames = {frame.get("name"): frame for frame in element.iter("PhysicalOffsetFrame")}
        parent = frames[element.findtext("socket_parent_frame")]
        child = frames[element.findtext("socket_child_frame")]
        self.parent = parent.findtext("socket_parent").split("/")[-1]
        self.child = child.findtext("socket_parent").split("/")[-1]
        self.before, self.after = offset(parent), np.linalg.inv(offset(child))
        self.coordinates = [coordinate.get("name") for coordinate in element.iter("Coordinate")]
        self.axes = list(element.iter("TransformAxis"))

    def motion(self, at):
        if self.kind == "PinJoint":
            return transform(turn(np.array([0, 0, 1]), at(self.coordinates[0])), np.zeros(3))
        if self.kind == "UniversalJoint":
            first, second = (at(name) for name in self.coordinates)
            return transform(turn(np.array([1, 0, 0]), first) @ turn(np.array([0, 1, 0]), second), np.zeros(3))
        rotation, translation = np.eye(3), np.zeros(3)
        for axis in self.axes:
            name = (axis.findtext("coordinates") or "").strip()
            amount = value(axis[-1], at(name) if name else 0.0)
            if axis.get("name").startswith("rotation"):
                rotation = rotation @ turn(numbers(axis, "axis"), amount)
            else:
                translation = translation + amount * numbers(axis, "axis")
        return transform(rotation, translation)


class Model:
    def __init__(self, path):
        root = xml.etree.ElementTree.parse(path).getroot()
        kinds = ("CustomJoint", "PinJoint", "UniversalJoint", "WeldJoint")
        self.joints = [Joint(element) for kind in kinds for element in root.iter(kind)]
        self.coordinates = {name for joint in self.joints for name in joint.coordinates}

    def bodies(self, coordinates):
        """Where each body's frame is in the ground, a 4 x 4 matrix [m]; coordinates that are not given are 0 [rad, m]."""
        placed = {"ground": np.eye(4)}
        waiting = list(self.joints)
        while waiting:
            joint = next(joint for joint in waiting if joint.parent in placed)
            waiting.remove(joint)
            motion = joint.motion(lambda name: coordinates.get(name, 0.0))
            placed[joint.child] = placed[joint.parent] @ joint.before @ motion @ joint.after
        return placed
