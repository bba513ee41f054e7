"""Poses as they come."""
from __future__ import annotations

import time
from collections.abc import Iterator

from .lcm_log import read_events
from .lcm_udp import receive
from .poses import Pose, PoseDecoder

#: Where mocapd sends unless it is told otherwise.
DEFAULT_URL = "udpm://239.255.76.67:7667?ttl=0"


def messages(url: str | None = None, timeout_s: float | None = None) -> Iterator[tuple[str, bytes]]:
    """Yields channel and bytes of every LCM message.

    @param url  "udpm://GROUP:PORT", or "file://PATH" of a log, whose messages come at once, one after the other.
    @param timeout_s  raises TimeoutError when nothing comes for so long.
    @raises ValueError  for an address that is none. @raises OSError  where no group can be joined, or no file read.
    """
    address = url or DEFAULT_URL
    if address.startswith("file://"):
        return read_events(address.removeprefix("file://").partition("?")[0])
    return receive(address, timeout_s)


def _of_prefix(url: str | None, prefix: str, wanted: str, timeout_s: float | None) -> Iterator[tuple[str, bytes]]:
    """Yields the messages of one daemon, without the prefix of their channels.

    @raises TimeoutError  when none on the channel `wanted` comes for so long, whatever else does.
    """
    senders: set[str] = set()
    wanted_s = time.monotonic()
    try:
        for channel, data in messages(url, timeout_s):
            if channel.endswith("MOCAP_STATUS") and len(senders) < 8:
                senders.add(channel.removesuffix("MOCAP_STATUS"))
            if channel.startswith(prefix):
                yield channel.removeprefix(prefix), data
            if channel == prefix + wanted:
                senders, wanted_s = set(), time.monotonic()
            elif timeout_s is not None and time.monotonic() - wanted_s > timeout_s and not (url or "").startswith("file:"):
                raise TimeoutError
    except TimeoutError:
        raise TimeoutError(_silence_text(url or DEFAULT_URL, prefix, wanted, timeout_s, senders)) from None


def _silence_text(url: str, prefix: str, wanted: str, timeout_s: float | None, senders: set[str]) -> str:
    text = f"no {prefix}{wanted} has arrived on {url} for {timeout_s} s"
    if prefix in senders:
        return text + ", only mocapd's status: mocap status says why; a node never sends poses, its studio does"
    if senders:
        return text + f", but mocapd sends there with the prefixes {sorted(senders)}: choose one with prefix="
    return text + ": is mocapd running? mocap doctor checks the network"


def listen(url: str | None = None, prefix: str = "", person: int | None = None,
           timeout_s: float | None = None) -> Iterator[Pose]:
    """Yields the pose of every frame set, of whoever has been followed the longest, or of one person.

    A tracked pose comes once the person's body is known, within a second. A generator: break off when you have enough.

    @param url, timeout_s  as of messages().
    @raises TimeoutError  when no pose comes for so long, with what is heard instead.
    @param prefix  what stands before the channels' names (`lcm.prefix` in mocapd's configuration).
    @param person  number of the one who is meant, as `mocap status` tells it.
    """
    if person is not None:
        for people in listen_people(url, prefix, timeout_s):
            yield from (pose for pose in people if pose.person == person)
        return
    decoder = PoseDecoder()
    for channel, data in _of_prefix(url, prefix, "MOCAP_POSE", timeout_s):
        if channel == "MOCAP_BODY":
            decoder.take_body(data)
        elif channel == "MOCAP_POSE":
            pose = decoder.pose(data)
            if pose is not None:
                yield pose


def listen_people(url: str | None = None, prefix: str = "", timeout_s: float | None = None) -> Iterator[list[Pose]]:
    """Yields everybody's poses of every frame set, whoever has been followed the longest first; nobody's: an empty list.

    Whose body is not known yet is left out, for a second at most. Arguments are those of listen().
    """
    decoder = PoseDecoder()
    for channel, data in _of_prefix(url, prefix, "MOCAP_PEOPLE", timeout_s):
        if channel == "MOCAP_BODIES":
            decoder.take_person_body(data)
        elif channel == "MOCAP_PEOPLE":
            people = decoder.people(data)
            if people is not None:
                yield people
