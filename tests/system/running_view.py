"""A `mocap view` of one's own, and the few lines of HTTP and WebSocket that tests say to it, right or wrong."""
import base64
import http.client
import json
import os
import re
import signal
import socket
import struct
import subprocess
import time

from running_daemon import BIN, Failure, Pose

POSE, VOXELS, PICTURE = 1, 2, 3
TEXT, BINARY, CLOSE, PING, PONG = 1, 2, 8, 9, 10


class WholePose(Pose):
    """A pose_t with the points of the body [mm]."""

    def __init__(self, data):
        super().__init__(data)
        joints_at = 41 + 8 * 23
        points_at = joints_at + 4 + 8 * struct.unpack_from(">i", data, joints_at)[0]
        flat = struct.unpack_from(">69d", data, points_at)
        self.points_mm = [flat[i:i + 3] for i in range(0, 69, 3)]


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class View:
    """Starts with a daemon, or with a take and its results; ends with the block."""

    def __init__(self, folder, *words, daemon=None):
        self.port = free_port()
        self.origin = "http://127.0.0.1:%d" % self.port
        self.log_file = os.path.join(folder, "view-%d.log" % self.port)
        if daemon:
            words = [*words, "--url", daemon.lcm_url, "--socket", daemon.socket]
        self.words = [os.path.join(BIN, "mocap"), "view", *words, "--port", str(self.port)]

    def __enter__(self):
        with open(self.log_file, "ab") as log:
            self.process = subprocess.Popen(self.words, stdout=log, stderr=log)
        self.address = self.wait_until(lambda: re.search(r"http://127\.0\.0\.1:\d+/\S*", self.log()), 60, "prints no address")[0]
        self.token = self.address.partition("#token=")[2]
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGTERM)
        try:
            self.process.wait(20)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
            raise Failure("mocap view does not end within 20 s of SIGTERM") from None

    def log(self):
        with open(self.log_file, errors="replace") as log:
            return log.read()

    def wait_until(self, holds, seconds, otherwise):
        """What `holds` gives, once that is something."""
        end = time.time() + seconds
        while time.time() < end:
            if self.process.poll() is not None:
                raise Failure("mocap view ended with %s: %s" % (self.process.returncode, self.log()[-500:]))
            found = holds()
            if found:
                return found
            time.sleep(0.05)
        raise Failure("mocap view %s in %g s: %s" % (otherwise, seconds, self.log()[-500:]))

    def ask(self, path, method="GET", body=None, timeout=20, **headers):
        """Status, headers and body of an answer; `Content_Type=…` sets a header, Host=… another host."""
        headers = {name.replace("_", "-"): value for name, value in headers.items()}
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=timeout)
        try:
            connection.putrequest(method, path, skip_host="Host" in headers, skip_accept_encoding=True)
            if body is not None:
                headers.setdefault("Content-Length", str(len(body)))
            for name, value in headers.items():
                connection.putheader(name, value)
            connection.endheaders(body)
            answer = connection.getresponse()
            return answer.status, answer.headers, answer.read()
        finally:
            connection.close()

    def control(self, request, **headers):
        headers = {"Authorization": "Bearer " + self.token, "Content_Type": "application/json", "Origin": self.origin, **headers}
        return self.ask("/control", "POST", json.dumps({"request": request}).encode(),
                        **{name: value for name, value in headers.items() if value is not None})

    def processor_s(self):
        return processor_s(self.process.pid)

    def resident_kb(self):
        with open("/proc/%d/smaps_rollup" % self.process.pid) as rollup:
            return next(int(line.split()[1]) for line in rollup if line.startswith("Rss:"))

    def files(self):
        return len(os.listdir("/proc/%d/fd" % self.process.pid))


def processor_s(process):
    """Processor time of a process so far, its threads' included."""
    with open("/proc/%d/stat" % process) as stat:
        fields = stat.read().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def upgrade_request(view, host=None, origin=None):
    """What a browser says to open /live; None stands for what is right."""
    host = "127.0.0.1:%d" % view.port if host is None else host
    return ("GET /live HTTP/1.1\r\nHost: %s\r\nOrigin: %s\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
            "Sec-WebSocket-Key: %s\r\nSec-WebSocket-Version: 13\r\n\r\n"
            % (host, origin or "http://" + host, base64.b64encode(os.urandom(16)).decode())).encode()


def frame(payload=b"", opcode=BINARY, masked=True, final=True, length=None):
    """A WebSocket frame; `length` is what it says of itself, where that is another than it has."""
    length = len(payload) if length is None else length
    head = bytes([opcode | 128 * final])
    mask = 128 * masked
    if length < 126:
        head += bytes([mask | length])
    elif length < 65536:
        head += struct.pack(">BH", mask | 126, length)
    else:
        head += struct.pack(">BQ", mask | 127, length)
    if not masked:
        return head + payload
    key = os.urandom(4)
    return head + key + bytes(byte ^ key[i % 4] for i, byte in enumerate(payload))


class Live:
    """A client of /live."""

    def __init__(self, view, timeout=20, receive_bytes=None, **foreign):
        self.socket = socket.socket()
        if receive_bytes:
            self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, receive_bytes)
        self.socket.settimeout(timeout)
        self.socket.connect(("127.0.0.1", view.port))
        self.socket.sendall(upgrade_request(view, **foreign))
        self.rest = b""
        while b"\r\n\r\n" not in self.rest:
            self.rest += self.read_some()
        head, _, self.rest = self.rest.partition(b"\r\n\r\n")
        self.status = int(head.split()[1])

    def read_some(self):
        data = self.socket.recv(65536)
        if not data:
            raise ConnectionError("the server ended the connection")
        return data

    def take(self, count):
        while len(self.rest) < count:
            self.rest += self.read_some()
        data, self.rest = self.rest[:count], self.rest[count:]
        return data

    def message(self):
        """The next one: its opcode and what it carries."""
        opcode, whole = None, b""
        while True:
            first, second = self.take(2)
            length = second & 127
            if length == 126:
                length, = struct.unpack(">H", self.take(2))
            elif length == 127:
                length, = struct.unpack(">Q", self.take(8))
            data = self.take(length)
            if first & 15 == PING:
                self.socket.sendall(frame(data, PONG))
                continue
            opcode, whole = first & 15 or opcode, whole + data
            if first & 128:
                return opcode, whole

    def close(self):
        self.socket.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()
