#!/usr/bin/env python3
"""Converts a TFLite network of floating-point numbers to ONNX, with numpy alone.

    convert_tflite.py IN.tflite OUT.onnx [SIZE ...]

Keeps the outputs that have one of these numbers of values, and what they need; without any, all of
them. TFLite's tensors are N x H x W x C, ONNX's are N x C x H x W. What OpenCV 4.6 reads of ONNX
is written: version 11 of the operators, but limits of Clip as attributes.

Knows the operators of MediaPipe's landmark networks and refuses others.
"""
import struct
import sys
from dataclasses import dataclass, field

import numpy as np


class ConversionError(Exception):
    """What cannot be converted, in one line."""


# ---------------------------------------------------------------------------------------------------
# Reading: schema.fbs of TensorFlow Lite, of which only fields that are needed here have a number.

OPERATORS = {0: "ADD", 3: "CONV_2D", 4: "DEPTHWISE_CONV_2D", 6: "DEQUANTIZE", 14: "LOGISTIC",
             17: "MAX_POOL_2D", 22: "RESHAPE", 23: "RESIZE_BILINEAR", 34: "PAD"}
TYPES = {0: np.float32, 1: np.float16, 2: np.int32, 4: np.int64}


class Table:
    """A table of a FlatBuffer: fields by number, any of which may be missing."""

    def __init__(self, data, at):
        self.data = data
        self.at = at
        self.fields_at = at - struct.unpack_from("<i", data, at)[0]
        self.field_count = (struct.unpack_from("<H", data, self.fields_at)[0] - 4) // 2

    def place(self, number):
        """Where a field is; None if it is missing."""
        if number >= self.field_count:
            return None
        offset = struct.unpack_from("<H", self.data, self.fields_at + 4 + 2 * number)[0]
        return self.at + offset if offset else None

    def number(self, number, kind, fallback=0):
        """A number of a struct module's kind, such as i or b."""
        at = self.place(number)
        return fallback if at is None else struct.unpack_from("<" + kind, self.data, at)[0]

    def target(self, number):
        """What a field refers to; None if it is missing."""
        at = self.place(number)
        return None if at is None else at + struct.unpack_from("<I", self.data, at)[0]

    def table(self, number):
        at = self.target(number)
        return None if at is None else Table(self.data, at)

    def tables(self, number):
        at = self.target(number)
        if at is None:
            return []
        count = struct.unpack_from("<I", self.data, at)[0]
        places = range(at + 4, at + 4 + 4 * count, 4)
        return [Table(self.data, p + struct.unpack_from("<I", self.data, p)[0]) for p in places]

    def integers(self, number):
        at = self.target(number)
        if at is None:
            return []
        count = struct.unpack_from("<I", self.data, at)[0]
        return list(struct.unpack_from(f"<{count}i", self.data, at + 4))

    def bytes(self, number):
        at = self.target(number)
        if at is None:
            return b""
        count = struct.unpack_from("<I", self.data, at)[0]
        return self.data[at + 4:at + 4 + count]


@dataclass
class Operator:
    """An operator: numbers of its tensors, and its options."""
    name: str
    inputs: list
    outputs: list
    options: Table

    def option(self, number, kind="b", fallback=0):
        return self.options.number(number, kind, fallback) if self.options else fallback


class TfLite:
    """A network as a file has it: shapes and constants by tensor, and operators in order."""

    def __init__(self, data):
        if data[4:8] != b"TFL3":
            raise ConversionError("is not a TFLite network")
        model = Table(data, struct.unpack_from("<I", data, 0)[0])
        graph = model.tables(2)[0]
        buffers = model.tables(4)
        self.shapes = []
        self.constants = {}
        for i, tensor in enumerate(graph.tables(0)):
            self.shapes.append(tensor.integers(0))
            content = buffers[tensor.number(2, "I")].bytes(0)
            if content:
                self.constants[i] = self._constant(tensor, content)
        self.inputs = graph.integers(1)
        self.outputs = graph.integers(2)
        codes = [max(code.number(0, "b"), code.number(3, "i")) for code in model.tables(1)]
        self.operators = []
        for operator in graph.tables(3):
            code = codes[operator.number(0, "I")]
            self.operators.append(Operator(OPERATORS.get(code, f"number {code}"),
                                           operator.integers(1), operator.integers(2),
                                           operator.table(4)))

    @staticmethod
    def _constant(tensor, content):
        kind = tensor.number(1, "b")
        if kind not in TYPES:
            raise ConversionError(f"has a tensor of type {kind}, which is not known here")
        if tensor.place(6) is not None:
            raise ConversionError("has sparse tensors, which are not known here")
        return np.frombuffer(content, TYPES[kind]).reshape(tensor.integers(0))


# ---------------------------------------------------------------------------------------------------
# Writing: onnx.proto, by protobuf's rules.

FLOAT, INT64 = 1, 7


def varint(value):
    value &= (1 << 64) - 1
    out = bytearray()
    while value > 0x7F:
        out.append(value & 0x7F | 0x80)
        value >>= 7
    out.append(value)
    return bytes(out)


def number(field_number, value):
    return varint(field_number << 3) + varint(value)


def blob(field_number, content):
    if isinstance(content, str):
        content = content.encode()
    return varint(field_number << 3 | 2) + varint(len(content)) + content


def attribute(name, value):
    """An AttributeProto of a number, a text or a list of whole numbers."""
    if isinstance(value, float):
        return blob(1, name) + varint(2 << 3 | 5) + struct.pack("<f", value) + number(20, 1)
    if isinstance(value, int):
        return blob(1, name) + number(3, value) + number(20, 2)
    if isinstance(value, str):
        return blob(1, name) + blob(4, value) + number(20, 3)
    return blob(1, name) + b"".join(number(8, int(v)) for v in value) + number(20, 7)


@dataclass
class Node:
    operation: str
    inputs: list
    output: str
    attributes: dict = field(default_factory=dict)

    def encoded(self):
        return (b"".join(blob(1, i) for i in self.inputs) + blob(2, self.output) +
                blob(3, self.output) + blob(4, self.operation) +
                b"".join(blob(5, attribute(k, v)) for k, v in self.attributes.items()))


def encoded_tensor(name, values):
    kind = INT64 if values.dtype == np.int64 else FLOAT
    return (b"".join(number(1, size) for size in values.shape) + number(2, kind) + blob(8, name) +
            blob(9, values.tobytes()))


def encoded_value(name, shape):
    sizes = b"".join(blob(1, number(1, size)) for size in shape)
    return blob(1, name) + blob(2, blob(1, number(1, FLOAT) + blob(2, sizes)))


# ---------------------------------------------------------------------------------------------------
# Converting.


def name_of(tensor):
    return f"t{tensor}"


def channels_first(shape):
    return [shape[0], shape[3], shape[1], shape[2]] if len(shape) == 4 else list(shape)


def padding(is_valid, size, kernel, stride, dilation):
    """What TFLite adds before and after; SAME divides it so that the output has size / stride."""
    if is_valid:
        return 0, 0
    wanted = (-(-size // stride) - 1) * stride + (kernel - 1) * dilation + 1
    total = max(wanted - size, 0)
    return total // 2, total - total // 2


class Converter:
    """Makes nodes and constants of ONNX from a network."""

    def __init__(self, network):
        self.network = network
        self.constants = dict(network.constants)
        self.nodes = []
        self.values = {}  # Constants of ONNX by name.
        steps = {"ADD": self._add, "CONV_2D": self._convolution,
                 "DEPTHWISE_CONV_2D": self._depthwise_convolution, "DEQUANTIZE": self._dequantize,
                 "LOGISTIC": self._logistic, "MAX_POOL_2D": self._max_pool,
                 "RESHAPE": self._reshape, "RESIZE_BILINEAR": self._resize, "PAD": self._pad}
        for operator in network.operators:
            if operator.name not in steps:
                raise ConversionError(f"has the operator {operator.name}, which is not known here")
            steps[operator.name](operator)

    def model(self, outputs):
        """The whole ONNX file, without what these outputs do not need."""
        nodes = self._needed([name_of(i) for i in outputs])
        used = {name for node in nodes for name in node.inputs}
        shapes = self.network.shapes

        def values(tensors):
            return [encoded_value(name_of(i), channels_first(shapes[i])) for i in tensors]

        graph = b"".join(blob(1, node.encoded()) for node in nodes) + blob(2, "pose")
        graph += b"".join(blob(5, encoded_tensor(name, value))
                          for name, value in self.values.items() if name in used)
        graph += b"".join(blob(11, value) for value in values(self.network.inputs))
        graph += b"".join(blob(12, value) for value in values(outputs))
        operators = blob(1, "") + number(2, 11)
        return number(1, 7) + blob(2, "mocap") + blob(7, graph) + blob(8, operators)

    def _needed(self, outputs):
        wanted = set(outputs)
        nodes = []
        for node in reversed(self.nodes):
            if node.output in wanted:
                wanted.update(node.inputs)
                nodes.append(node)
        return nodes[::-1]

    def _constant(self, name, values, kind=np.float32):
        self.values[name] = np.ascontiguousarray(values, kind)
        return name

    def _emit(self, operation, inputs, tensor, activation=0, **attributes):
        """Adds a node, and one for the activation that TFLite has in the same operator."""
        out = name_of(tensor)
        if activation == 0:
            self.nodes.append(Node(operation, inputs, out, attributes))
            return
        before = out + "_before"
        self.nodes.append(Node(operation, inputs, before, attributes))
        if activation == 1:
            self.nodes.append(Node("Relu", [before], out))
        elif activation == 3:
            self.nodes.append(Node("Clip", [before], out, {"min": 0.0, "max": 6.0}))
        else:
            raise ConversionError(f"has activation {activation}, which is not known here")

    def _pads(self, operator, kernel, strides, dilations=(1, 1)):
        sizes = self.network.shapes[operator.inputs[0]][1:3]
        is_valid = operator.option(0) == 1
        (top, bottom), (left, right) = (padding(is_valid, *each) for each in
                                        zip(sizes, kernel, strides, dilations))
        return [top, left, bottom, right]

    def _convolve(self, operator, weights, group, activation, dilations):
        tensor = operator.outputs[0]
        kernel = list(weights.shape[2:])
        strides = [operator.option(2, "i", 1), operator.option(1, "i", 1)]
        inputs = [name_of(operator.inputs[0]), self._constant(name_of(tensor) + "_w", weights)]
        if len(operator.inputs) > 2 and operator.inputs[2] >= 0:
            bias = self.constants[operator.inputs[2]]
            inputs.append(self._constant(name_of(tensor) + "_b", bias))
        self._emit("Conv", inputs, tensor, activation, kernel_shape=kernel, strides=strides,
                   dilations=dilations, group=group,
                   pads=self._pads(operator, kernel, strides, dilations))

    def _convolution(self, operator):
        weights = self.constants[operator.inputs[1]].transpose(0, 3, 1, 2)
        dilations = [operator.option(5, "i", 1), operator.option(4, "i", 1)]
        self._convolve(operator, weights, 1, operator.option(3), dilations)

    def _depthwise_convolution(self, operator):
        weights = self.constants[operator.inputs[1]].transpose(3, 0, 1, 2)
        dilations = [operator.option(6, "i", 1), operator.option(5, "i", 1)]
        channels = self.network.shapes[operator.inputs[0]][3]
        self._convolve(operator, weights, channels, operator.option(4), dilations)

    def _dequantize(self, operator):
        if operator.inputs[0] not in self.constants:
            raise ConversionError("computes with numbers that are not floating-point")
        values = self.constants[operator.inputs[0]].astype(np.float32)
        self.constants[operator.outputs[0]] = values

    def _add(self, operator):
        if any(i in self.constants for i in operator.inputs):
            raise ConversionError("adds constants, which is not known here")
        self._emit("Add", [name_of(i) for i in operator.inputs], operator.outputs[0],
                   operator.option(0))

    def _logistic(self, operator):
        self._emit("Sigmoid", [name_of(operator.inputs[0])], operator.outputs[0])

    def _max_pool(self, operator):
        kernel = [operator.option(4, "i"), operator.option(3, "i")]
        strides = [operator.option(2, "i"), operator.option(1, "i")]
        self._emit("MaxPool", [name_of(operator.inputs[0])], operator.outputs[0],
                   operator.option(5), kernel_shape=kernel, strides=strides,
                   pads=self._pads(operator, kernel, strides))

    def _pad(self, operator):
        pads = self.constants[operator.inputs[1]][[0, 3, 1, 2]]
        tensor = operator.outputs[0]
        pads = self._constant(name_of(tensor) + "_p", np.concatenate([pads[:, 0], pads[:, 1]]),
                              np.int64)
        self._emit("Pad", [name_of(operator.inputs[0]), pads], tensor, mode="constant")

    def _resize(self, operator):
        tensor = operator.outputs[0]
        before, after = (np.array(channels_first(self.network.shapes[i]), float)
                         for i in (operator.inputs[0], tensor))
        align_corners, half_pixel = operator.option(2), operator.option(3)
        mode = "align_corners" if align_corners else "half_pixel" if half_pixel else "asymmetric"
        region = self._constant(name_of(tensor) + "_r", np.zeros(0))
        scales = self._constant(name_of(tensor) + "_s", after / before)
        self._emit("Resize", [name_of(operator.inputs[0]), region, scales], tensor, mode="linear",
                   coordinate_transformation_mode=mode)

    def _reshape(self, operator):
        before, after = (self.network.shapes[i] for i in (operator.inputs[0], operator.outputs[0]))
        # In another order of channels, other shapes would mix them.
        keeps_order = (len(before) < 4 or before == after or before[1] == before[2] == 1 or
                       before[3] == 1)
        if not keeps_order:
            raise ConversionError(f"reshapes {before} to {after}, which is not known here")
        tensor = operator.outputs[0]
        shape = self._constant(name_of(tensor) + "_s", channels_first(after), np.int64)
        self._emit("Reshape", [name_of(operator.inputs[0]), shape], tensor)


def convert(data, sizes):
    """Converts a file's content, keeping the outputs of these sizes; all if there are none."""
    network = TfLite(data)
    outputs = [i for i in network.outputs if not sizes or np.prod(network.shapes[i]) in sizes]
    if sizes and len(outputs) != len(sizes):
        raise ConversionError(f"has not one output for each of the sizes {sizes}")
    return Converter(network).model(outputs)


def main(arguments):
    if len(arguments) < 2:
        sys.exit("usage: convert_tflite.py IN.tflite OUT.onnx [SIZE ...]")
    source, target = arguments[:2]
    try:
        with open(source, "rb") as file:
            data = file.read()
        model = convert(data, [int(size) for size in arguments[2:]])
        with open(target, "wb") as file:
            file.write(model)
    except (ConversionError, OSError, ValueError) as error:
        sys.exit(f"{source}: {error}")
    except (struct.error, IndexError, KeyError):
        sys.exit(f"{source}: is damaged; expected a TFLite network")


if __name__ == "__main__":
    main(sys.argv[1:])
