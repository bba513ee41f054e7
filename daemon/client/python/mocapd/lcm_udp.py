"""LCM's messages from a multicast group: small ones in a packet, large ones in pieces."""
from __future__ import annotations

import collections
import dataclasses
import errno
import ipaddress
import os
import socket
import struct
import time
from collections.abc import Iterator
from urllib.parse import parse_qsl, urlsplit

SHORT_MAGIC, FRAGMENT_MAGIC = 0x4C433032, 0x4C433033  # "LC02", "LC03"
SHORT_HEADER = struct.Struct(">II")  # magic, number
FRAGMENT_HEADER = struct.Struct(">IIIIHH")  # magic, number, size, offset, piece, pieces
LONGEST_CHANNEL = 63
# The limits of LCM's own receiver: incomplete messages must not fill the memory.
MOST_SENDERS, MOST_BYTES = 1000, 1 << 24
RECEIVE_BUFFER = 4 << 20

Event = tuple[str, bytes]


class Deadline:
    """When to give up waiting."""

    def __init__(self, timeout_s: float | None) -> None:
        self.timeout_s = timeout_s
        self.renew()

    def renew(self) -> None:
        self.at_s = None if self.timeout_s is None else time.monotonic() + self.timeout_s

    def left_s(self) -> float | None:
        """None: for ever. @raises TimeoutError  when it has passed."""
        if self.at_s is None:
            return None
        left_s = self.at_s - time.monotonic()
        if left_s <= 0:
            raise TimeoutError
        return left_s


@dataclasses.dataclass
class Begun:
    """A message of which pieces have come."""
    number: int
    data: bytearray
    has_come: bytearray  # per piece: 1 if received
    missing: int
    channel: str | None = None


class Reassembly:
    """Puts messages together from packets, which may be lost, doubled, out of order, or anything at all."""

    def __init__(self) -> None:
        self.begun: collections.OrderedDict[object, Begun] = collections.OrderedDict()

    @property
    def bytes_held(self) -> int:
        return sum(len(message.data) for message in self.begun.values())

    def take(self, packet: bytes, sender: object) -> Event | None:
        """Takes a packet; gives channel and bytes of the message that it ends."""
        if len(packet) < SHORT_HEADER.size:
            return None
        magic, _ = SHORT_HEADER.unpack_from(packet)
        if magic == SHORT_MAGIC:
            return split_channel(packet[SHORT_HEADER.size:])
        if magic == FRAGMENT_MAGIC and len(packet) >= FRAGMENT_HEADER.size:
            return self._take_piece(packet, sender)
        return None

    def _take_piece(self, packet: bytes, sender: object) -> Event | None:
        _, number, size, offset, piece, pieces = FRAGMENT_HEADER.unpack_from(packet)
        data = packet[FRAGMENT_HEADER.size:]
        channel = None
        if piece == 0:
            first = split_channel(data)
            if first is None:
                return None
            channel, data = first
        is_piece = piece < pieces <= size + 1 and size <= MOST_BYTES and offset + len(data) <= size
        if not is_piece:
            return None
        message = self._message(number, size, pieces, sender)
        if message.has_come[piece]:
            return None
        message.has_come[piece] = 1
        message.missing -= 1
        message.data[offset:offset + len(data)] = data
        message.channel = channel or message.channel
        if message.missing > 0:
            return None
        del self.begun[sender]
        return (message.channel, bytes(message.data)) if message.channel else None

    def _message(self, number: int, size: int, pieces: int, sender: object) -> Begun:
        """The one that the sender has begun; one that was never ended goes when the next begins."""
        begun = self.begun.get(sender)
        if begun and (begun.number, len(begun.data), len(begun.has_come)) == (number, size, pieces):
            return begun
        self.begun.pop(sender, None)
        while self.begun and (self.bytes_held + size > MOST_BYTES or len(self.begun) >= MOST_SENDERS):
            self.begun.popitem(last=False)
        message = self.begun[sender] = Begun(number, bytearray(size), bytearray(pieces), pieces)
        return message


def split_channel(data: bytes) -> Event | None:
    channel, end, rest = data.partition(b"\0")
    if not end or not channel or len(channel) > LONGEST_CHANNEL:
        return None
    return channel.decode("utf-8", "replace"), rest


def parse_group(url: str) -> tuple[str, int]:
    """Group and port of ``udpm://GROUP:PORT?ttl=0``, as LCM has it. ttl counts for senders alone."""
    parts = urlsplit(url)
    options = dict(parse_qsl(parts.query, keep_blank_values=True))
    unknown = set(options) - {"ttl", "recv_buf_size"}
    try:
        group, port = parts.hostname or "239.255.76.67", parts.port or 7667
        is_group = ipaddress.IPv4Address(group).is_multicast
    except ValueError:
        is_group = False
    if parts.scheme != "udpm" or not is_group or unknown:
        raise ValueError(f"{url!r} is not an LCM address that can be received; "
                         "expected udpm://239.255.76.67:7667 or file:///path/to/a.log")
    return group, port


def open_socket(group: str, port: int) -> socket.socket:
    """Joins a group. @raises OSError  where there is no multicast route, or another program has the port."""
    udp = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    udp.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    if hasattr(socket, "SO_REUSEPORT"):
        udp.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEPORT, 1)
    udp.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, RECEIVE_BUFFER)
    try:
        # Outside of Linux, a group cannot be bound to.
        udp.bind((group if hasattr(socket, "SO_REUSEPORT") else "", port))
    except OSError as error:
        udp.close()
        if error.errno != errno.EADDRINUSE:
            raise
        raise OSError(error.errno, f"UDP port {port} is in use by another program: ss -ulpn names it; end it, or use another "
                      "port") from error
    try:
        udp.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP,
                       struct.pack("=4sL", socket.inet_aton(group), socket.INADDR_ANY))
    except OSError as error:
        udp.close()
        raise OSError(error.errno, f"the group {group} cannot be joined ({os.strerror(error.errno or 0)}); expected a multicast route: "
                      "ip route add 224.0.0.0/4 dev lo") from error
    return udp


def receive(url: str, deadline: Deadline) -> Iterator[Event]:
    """Yields channel and bytes of every message on a group.

    @raises TimeoutError  when the deadline passes.
    """
    reassembly = Reassembly()
    with open_socket(*parse_group(url)) as udp:
        while True:
            udp.settimeout(deadline.left_s())
            packet, sender = udp.recvfrom(65536)
            event = reassembly.take(packet, sender)
            if event is not None:
                yield event


class Publisher:
    """Sends messages to a group, each in one packet."""

    def __init__(self, url: str) -> None:
        self.address = parse_group(url)
        self.number = 0
        self.udp = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.udp.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, int(dict(parse_qsl(urlsplit(url).query)).get("ttl", 0)))

    def publish(self, channel: str, data: bytes) -> None:
        """@raises OSError  without a route, or for a message that is too large for a packet."""
        self.udp.sendto(SHORT_HEADER.pack(SHORT_MAGIC, self.number) + channel.encode() + b"\0" + data, self.address)
        self.number = (self.number + 1) % 2 ** 32

    def close(self) -> None:
        self.udp.close()
