"""An Ethernet switch between network namespaces that loses and delays frames on purpose. netem does so too, where the kernel has it."""
import ctypes
import fcntl
import heapq
import os
import random
import select
import struct
import threading
import time

TUNSETIFF = 0x400454CA
IFF_TAP, IFF_NO_PI = 0x0002, 0x1000
CLONE_NEWNET = 0x40000000
LIBC = ctypes.CDLL(None, use_errno=True)


def enter_network(of):
    with open("/proc/%s/ns/net" % of) as network:
        if LIBC.setns(network.fileno(), CLONE_NEWNET) != 0:
            raise OSError(ctypes.get_errno(), "setns")


def open_port(pid):
    """A device eth0 in the network of a process; what it sends can be read from the file, and what is written there it receives."""
    with open("/proc/thread-self/ns/net") as own:
        enter_network(pid)
        try:
            port = os.open("/dev/net/tun", os.O_RDWR | os.O_NONBLOCK)
            fcntl.ioctl(port, TUNSETIFF, struct.pack("16sH22x", b"eth0", IFF_TAP | IFF_NO_PI))
        finally:
            LIBC.setns(own.fileno(), CLONE_NEWNET)
    return port


class Switch(threading.Thread):
    """Passes each frame to all other ports."""

    def __init__(self):
        super().__init__(daemon=True)
        self.ports = []
        self.cut = set()
        self.loss = 0.0
        self.jitter_s = 0.0
        self.random = random.Random(1)
        self.waiting = []
        self.count = 0

    def add(self, pid):
        self.ports.append(open_port(pid))
        return self.ports[-1]

    def run(self):
        poll = select.epoll()
        for port in self.ports:
            poll.register(port, select.EPOLLIN)
        while True:
            pause = self.waiting[0][0] - time.monotonic() if self.waiting else 0.1
            for port, _ in poll.poll(max(0, pause)):
                self.take(port)
            while self.waiting and self.waiting[0][0] <= time.monotonic():
                _, _, port, frame = heapq.heappop(self.waiting)
                self.give(port, frame)

    def take(self, port):
        try:
            while True:
                frame = os.read(port, 2048)
                for other in self.ports:
                    if other != port and not {port, other} & self.cut and self.random.random() >= self.loss:
                        self.pass_on(other, frame)
        except BlockingIOError:
            pass

    def pass_on(self, port, frame):
        if self.jitter_s == 0:
            return self.give(port, frame)
        self.count += 1
        due = time.monotonic() + self.random.uniform(0, self.jitter_s)
        heapq.heappush(self.waiting, (due, self.count, port, frame))

    def give(self, port, frame):
        try:
            os.write(port, frame)
        except BlockingIOError:
            pass
