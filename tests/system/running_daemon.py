"""A mocapd of one's own, beside any that the system runs: in a folder, with a socket and an LCM address of its own."""
import json
import os
import signal
import socket
import struct
import subprocess
import tempfile
import threading
import time

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
BIN = os.environ.get("MOCAP_BIN_DIR", os.path.join(ROOT, "build/release/bin"))
GROUP = "239.255.76.67"
SHORT_MESSAGE = 0x4C433032
SEARCHING, ACQUIRING, TRACKING, LOST = range(4)


class Failure(Exception):
    """Something that ought to hold does not."""


class Pose:
    """The head of a pose_t."""

    def __init__(self, data):
        _, self.utime, self.complete_utime, self.publish_utime, self.frame, self.state = struct.unpack(">qqqqqb", data[:41])


class Listener(threading.Thread):
    """Hears the poses on a port; `read` makes of each what is wanted of it."""

    def __init__(self, port, read=Pose):
        super().__init__(daemon=True)
        self.read = read
        self.poses = []
        self.udp = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.udp.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        self.udp.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4 << 20)
        self.udp.bind((GROUP, port))
        self.udp.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP,
                            struct.pack("4s4s", socket.inet_aton(GROUP), socket.inet_aton("127.0.0.1")))

    def run(self):
        while True:
            packet = self.udp.recv(65536)
            if struct.unpack(">I", packet[:4])[0] != SHORT_MESSAGE:
                continue
            channel, _, data = packet[8:].partition(b"\0")
            if channel == b"MOCAP_POSE":
                self.poses.append(self.read(data))


class Daemon:
    """Starts with a configuration; ends with the block. `folder` outlives it where it is given; `wrapper` is a command that runs it."""

    def __init__(self, config, folder=None, takes=None, wrapper=()):
        self.wrapper = wrapper
        self.port = 20000 + os.getpid() % 40000
        self.lcm_url = "udpm://%s:%d?ttl=0" % (GROUP, self.port)
        self.folder = folder or tempfile.mkdtemp(prefix="mocapd-")
        self.takes = takes or os.path.join(self.folder, "takes")
        self.socket = os.path.join(self.folder, "control")
        self.log_file = os.path.join(self.folder, "log")
        self.config = os.path.join(self.folder, "mocapd.toml")
        with open(self.config, "w") as out:
            out.write(config.format(takes=self.takes) + '\n[lcm]\nurl = "%s"\n[control]\nsocket = "%s"\n'
                      % (self.lcm_url, self.socket))

    def __enter__(self):
        with open(self.log_file, "ab") as log:
            self.process = subprocess.Popen([*self.wrapper, os.path.join(BIN, "mocapd"), "--config", self.config],
                                            stdout=subprocess.DEVNULL, stderr=log,
                                            env={**os.environ, "XDG_STATE_HOME": self.folder})
        self.wait_until(lambda: self.status()["sets_complete"] > 0, 120, "no frames flow")
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGTERM)
        self.process.wait(60)

    def mocap(self, *words):
        done = subprocess.run([os.path.join(BIN, "mocap"), *words, "--socket", self.socket], capture_output=True, text=True)
        if done.returncode != 0:
            raise Failure("mocap %s: %s" % (" ".join(words), done.stderr.strip()))
        return done.stdout

    def status(self):
        return json.loads(self.mocap("status", "--json"))

    def wait_until(self, holds, seconds, otherwise):
        end = time.time() + seconds
        while time.time() < end:
            if self.process.poll() is not None:
                raise Failure("mocapd ended: " + open(self.log_file).read()[-500:])
            try:
                if holds():
                    return
            except Failure:
                pass
            time.sleep(0.3)
        raise Failure(otherwise)

    def kill(self):
        """Returns when it was, in ns since the epoch."""
        now = time.time_ns()
        self.process.kill()
        self.process.wait()
        return now

    def resident_kb(self):
        with open("/proc/%d/smaps_rollup" % self.process.pid) as rollup:
            return next(int(line.split()[1]) for line in rollup if line.startswith("Rss:"))


def track(take, out):
    """Opens a take as anybody would, and tracks it. Gives the times of its sets in ns."""
    subprocess.run([os.path.join(BIN, "mocap"), "track", take, "--out", out], check=True, capture_output=True)
    with open(os.path.join(out, "poses.csv")) as poses:
        return [int(line.split(",")[1]) for line in poses.readlines()[1:]]


def percentile(values, share):
    ordered = sorted(values)
    return ordered[min(len(ordered) - 1, int(share * len(ordered)))]


def need_multicast():
    if subprocess.run(["ip", "route", "get", GROUP], capture_output=True).returncode != 0:
        raise SystemExit("there is no multicast route; as root: ip link set lo up && ip route add 224.0.0.0/4 dev lo")
