"""Keypoints for mocapd: what a pose network finds in pictures."""
from __future__ import annotations

from collections.abc import Iterable
from types import TracebackType

from .lcm_udp import Publisher
from .live import DEFAULT_URL
from .mocap.keypoint_t import keypoint_t
from .mocap.keypoints_t import keypoints_t

CHANNEL = "MOCAP_KEYPOINTS"


class KeypointSender:
    """Sends keypoints to mocapd, which weighs them against what silhouettes show."""

    def __init__(self, name: str, url: str | None = None, prefix: str = "") -> None:
        """
        @param name  tells programs that send apart, in `mocap status`.
        @param url  "udpm://GROUP:PORT?ttl=0"; ttl is how many networks away mocapd may be.
        @param prefix  what stands before the channels' names (`lcm.prefix` in mocapd's configuration).
        @raises ValueError  for an address that is none. @raises OSError  without a multicast route.
        """
        self.name, self.channel = name, prefix + CHANNEL
        self.publisher = Publisher(url or DEFAULT_URL)

    def send(self, camera: str, capture_ns: int, points: Iterable[tuple[str, float, float, float]], person: int = 0) -> None:
        """Sends what was found of one person in one picture.

        @param capture_ns  of the picture, by the same clock as the poses: 1000 times their `utime`.
        @param points  name, x and y in the camera's picture [px], and score from 0 to 1 of each.
        @param person  tells people of one picture apart.
        """
        message = keypoints_t()
        message.version, message.sender = keypoints_t.VERSION, self.name
        message.camera, message.capture_ns, message.person = camera, capture_ns, person
        for name, x_px, y_px, score in points:
            point = keypoint_t()
            point.name, point.x_px, point.y_px, point.score = name, float(x_px), float(y_px), float(score)
            message.points.append(point)
        message.num_points = len(message.points)
        self.publisher.publish(self.channel, message.encode())

    def close(self) -> None:
        self.publisher.close()

    def __enter__(self) -> KeypointSender:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self.close()
