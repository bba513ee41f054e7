"""What lcm-logger recorded, as it may have become: cut off, damaged in the middle."""
from __future__ import annotations

import os
import struct
from collections.abc import Iterator
from typing import BinaryIO

MARK = b"\xed\xa1\xda\x01"
HEAD = struct.Struct(">4sqqii")  # mark, number, time, lengths of channel and data
LONGEST_CHANNEL = 255
CHUNK = 1 << 16


def read_events(path: str | os.PathLike[str]) -> Iterator[tuple[str, bytes]]:
    """Yields channel and bytes of each message. What is no whole event is passed over, up to the next mark of one."""
    with open(path, "rb") as log:
        size = os.fstat(log.fileno()).st_size
        place = 0
        while place < size:
            end = event_end(log, place, size)
            if end is None:
                place = next_mark(log, place + 1, size)
                continue
            log.seek(place)
            _, _, _, channel, data = HEAD.unpack(log.read(HEAD.size))
            name = log.read(channel).decode("utf-8", "replace")
            yield name, log.read(data)
            place = end


def event_end(log: BinaryIO, place: int, size: int) -> int | None:
    """Where the event that begins at a place ends; None where none does, or its lengths reach over another."""
    log.seek(place)
    head = log.read(HEAD.size)
    if len(head) < HEAD.size:
        return None
    mark, _, _, channel, data = HEAD.unpack(head)
    end = place + HEAD.size + channel + data
    if mark != MARK or not 0 < channel <= LONGEST_CHANNEL or data < 0 or end > size:
        return None
    log.seek(end)
    is_followed = end == size or log.read(len(MARK)) == MARK
    return end if is_followed or next_mark(log, place + 1, size) >= end else None


def next_mark(log: BinaryIO, place: int, size: int) -> int:
    while place < size:
        log.seek(place)
        found = log.read(CHUNK + len(MARK) - 1).find(MARK)
        if found >= 0:
            return place + found
        place += CHUNK
    return size


def listed_prefixes(prefixes: set[str]) -> str:
    """Tells which prefixes channels of mocapd have: "without a prefix", 'with prefix "left."'."""
    if prefixes == {""}:
        return "without a prefix"
    return f"with {'prefix' if len(prefixes) == 1 else 'the prefixes'} " + ", ".join(f'"{prefix}"' for prefix in sorted(prefixes))
