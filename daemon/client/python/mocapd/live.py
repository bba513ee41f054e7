"""Poses as they come."""
from __future__ import annotations

from collections.abc import Iterator

from .lcm_log import listed_prefixes, read_events
from .lcm_udp import Deadline, Event, receive
from .poses import BODILESS, DAMAGED, Pose, PoseDecoder

#: Where mocapd sends unless it is told otherwise.
DEFAULT_URL = "udpm://239.255.76.67:7667?ttl=0"
STATUS = "MOCAP_STATUS"
MOST_HEARD, MOST_NAMED = 100, 8


def messages(url: str | None = None, timeout_s: float | None = None) -> Iterator[Event]:
    """Yields channel and bytes of every LCM message.

    @param url  "udpm://GROUP:PORT", or "file://PATH" of a log, whose messages come at once, one after the other.
    @param timeout_s  raises TimeoutError when nothing comes for so long.
    @raises ValueError  for an address that is none. @raises OSError  where no group can be joined, or no file read.
    """
    source = _Source(url, timeout_s)
    for event in source.events():
        yield event
        source.renew()


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
        source = _Source(url, timeout_s, prefix, "MOCAP_PEOPLE", person)
        for people in _people(source):
            for pose in people:
                if pose.person == person:
                    yield pose
                    source.renew()
        return
    source = _Source(url, timeout_s, prefix, "MOCAP_POSE")
    decoder = PoseDecoder()
    for channel, data in source.events():
        if channel == prefix + "MOCAP_BODY":
            decoder.take_body(data)
        elif channel == prefix + "MOCAP_DETAILS":
            decoder.details.take(data)
        elif channel == prefix + "MOCAP_POSE":
            pose = decoder.pose(data)
            source.left_out = decoder.left_out
            if pose is not None:
                yield pose
                source.renew()


def listen_people(url: str | None = None, prefix: str = "", timeout_s: float | None = None) -> Iterator[list[Pose]]:
    """Yields everybody's poses of every frame set, whoever has been followed the longest first; nobody's: an empty list.

    Whose body is not known yet is left out, for a second at most. Arguments are those of listen().
    """
    source = _Source(url, timeout_s, prefix, "MOCAP_PEOPLE")
    for people in _people(source):
        yield people
        source.renew()


def _people(source: _Source) -> Iterator[list[Pose]]:
    decoder = PoseDecoder()
    for channel, data in source.events():
        if channel == source.prefix + "MOCAP_BODIES":
            decoder.take_person_body(data)
        elif channel == source.prefix + "MOCAP_DETAILS":
            decoder.details.take(data)
        elif channel == source.prefix + "MOCAP_PEOPLE":
            people = decoder.people(data)
            source.left_out = decoder.left_out
            if people is not None:
                yield people


class _Source:
    """Messages, and what to say when the wanted ones do not come."""

    def __init__(self, url: str | None, timeout_s: float | None, prefix: str = "", wanted: str = "message",
                 person: int | None = None) -> None:
        self.address = url or DEFAULT_URL
        self.prefix, self.wanted, self.person = prefix, wanted, person
        self.deadline = Deadline(timeout_s)
        self.heard: set[str] = set()  #: channels, since the deadline was renewed
        self.left_out: dict[int | None, str] = {}  #: of the last wanted message, as of PoseDecoder

    def renew(self) -> None:
        self.deadline.renew()
        self.heard.clear()

    def events(self) -> Iterator[Event]:
        """@raises TimeoutError  in one line, at the deadline."""
        if self.address.startswith("file://"):
            yield from read_events(self.address.removeprefix("file://").partition("?")[0])
            return
        self.deadline.renew()
        try:
            for event in receive(self.address, self.deadline):
                if len(self.heard) < MOST_HEARD or event[0] in (self.prefix + self.wanted, self.prefix + STATUS):
                    self.heard.add(event[0])
                yield event
        except TimeoutError:
            whose = "" if self.person is None else f" of person {self.person}"
            raise TimeoutError(f"{self.address}: no {self.prefix}{self.wanted}{whose} came for {self.deadline.timeout_s:g} s"
                               f"{self._found()}") from None

    def _found(self) -> str:
        if not self.heard:
            return "; is mocapd running? mocap doctor checks the network"
        if self.prefix + self.wanted in self.heard:
            return self._left_out()
        if self.prefix + STATUS in self.heard:
            return ", only mocapd's status: mocap status says why; a node never sends poses, its studio does"
        prefixes = {channel.removesuffix(STATUS) for channel in self.heard if channel.endswith(STATUS)}
        if prefixes:
            remedy = "leave prefix= out" if prefixes == {""} else "choose it with prefix="
            return f", but mocapd sends there {listed_prefixes(prefixes)}: {remedy}"
        return f", but {', '.join(sorted(self.heard)[:MOST_NAMED])}; expected messages of mocapd"

    def _left_out(self) -> str:
        why = self.left_out.get(self.person, self.left_out.get(None))
        if why == BODILESS:
            body = "MOCAP_BODY" if self.person is None else "MOCAP_BODIES"
            return f", only some without a body: no {self.prefix}{body} came that fits them"
        return ", only damaged ones" if why == DAMAGED else ", but of others; mocap status lists who is tracked"
