"""Poses as they come."""
from __future__ import annotations

from collections.abc import Iterator

from .lcm_log import read_events
from .lcm_udp import Deadline, Event, receive
from .poses import Pose, PoseDecoder

#: Where mocapd sends unless it is told otherwise.
DEFAULT_URL = "udpm://239.255.76.67:7667?ttl=0"
MOST_NAMED = 12


def messages(url: str | None = None, timeout_s: float | None = None) -> Iterator[Event]:
    """Yields channel and bytes of every LCM message.

    @param url  "udpm://GROUP:PORT", or "file://PATH" of a log, whose messages come at once, one after the other.
    @param timeout_s  raises TimeoutError when nothing comes for so long.
    @raises ValueError  for an address that is none. @raises OSError  where no group can be joined, or no file read.
    """
    source = _Source(url, timeout_s, "message")
    for event in source.events():
        yield event
        source.deadline.renew()


def listen(url: str | None = None, prefix: str = "", person: int | None = None,
           timeout_s: float | None = None) -> Iterator[Pose]:
    """Yields the pose of every frame set, of whoever has been followed the longest, or of one person.

    A tracked pose comes once the person's body is known, within a second. A generator: break off when you have enough.

    @param url  as of messages().
    @param prefix  what stands before the channels' names (`lcm.prefix` in mocapd's configuration).
    @param person  number of the one who is meant, as `mocap status` tells it.
    @param timeout_s  raises TimeoutError when no pose comes for so long, whatever else does; it says what was heard instead.
    """
    if person is not None:
        source = _Source(url, timeout_s, f"person {person} on {prefix}MOCAP_PEOPLE")
        for people in _people(source, prefix):
            for pose in people:
                if pose.person == person:
                    yield pose
                    source.deadline.renew()
        return
    source = _Source(url, timeout_s, prefix + "MOCAP_POSE")
    decoder = PoseDecoder()
    for channel, data in source.events():
        if channel == prefix + "MOCAP_BODY":
            decoder.take_body(data)
        elif channel == prefix + "MOCAP_POSE":
            pose = decoder.pose(data)
            if pose is not None:
                yield pose
                source.deadline.renew()


def listen_people(url: str | None = None, prefix: str = "", timeout_s: float | None = None) -> Iterator[list[Pose]]:
    """Yields everybody's poses of every frame set, whoever has been followed the longest first; nobody's: an empty list.

    Whose body is not known yet is left out, for a second at most. Arguments are those of listen().
    """
    source = _Source(url, timeout_s, prefix + "MOCAP_PEOPLE")
    for people in _people(source, prefix):
        yield people
        source.deadline.renew()


def _people(source: _Source, prefix: str) -> Iterator[list[Pose]]:
    decoder = PoseDecoder()
    for channel, data in source.events():
        if channel == prefix + "MOCAP_BODIES":
            decoder.take_person_body(data)
        elif channel == prefix + "MOCAP_PEOPLE":
            people = decoder.people(data)
            if people is not None:
                yield people


class _Source:
    """Messages, and what to say when the wanted ones do not come."""

    def __init__(self, url: str | None, timeout_s: float | None, wanted: str) -> None:
        self.address = url or DEFAULT_URL
        self.wanted = wanted
        self.deadline = Deadline(timeout_s)
        self.heard: dict[str, None] = {}

    def events(self) -> Iterator[Event]:
        """@raises TimeoutError  in one line, at the deadline."""
        if self.address.startswith("file://"):
            yield from read_events(self.address.removeprefix("file://").partition("?")[0])
            return
        self.deadline.renew()
        try:
            for event in receive(self.address, self.deadline):
                self.heard[event[0]] = None
                yield event
        except TimeoutError:
            raise TimeoutError(f"{self.address}: no {self.wanted} came for {self.deadline.timeout_s:g} s, {self._found()}") from None

    def _found(self) -> str:
        if not self.heard:
            return ("nor any other message; expected mocapd to run here, or to send to this network: mocap status and lcm.url in its "
                    "configuration tell")
        names = sorted(self.heard)
        more = " and others" if len(names) > MOST_NAMED else ""
        return f"but {', '.join(names[:MOST_NAMED])}{more}; expected another prefix or person, or mocapd of this version"
