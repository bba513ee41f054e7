"""A studio and its camera nodes, each in a network of its own on one switch."""
import json
import os
import subprocess
import time

from running_daemon import BIN

GROUP = "239.255.76.67"
URL = "udpm://%s:7667?ttl=1" % GROUP
FAKETIME = "/usr/lib/%s-linux-gnu/faketime/libfaketimeMT.so.1" % os.uname().machine

NODE = """
role = "node"
[node]
name = "{name}"
cameras = {cameras}
[source]
driver = "take"
take = "{take}"
loop = true
in_memory = true
"""
STUDIO = """
role = "studio"
calibration = "{take}/calibration.toml"
[source]
driver = "none"
fps = {fps}
[people]
most = 1
"""
BOTH = """
[lcm]
url = "%s"
[control]
socket = "{folder}/control"
""" % URL


class Host:
    """A network of its own on the switch; whatever runs there ends with it."""

    def __init__(self, number, folder, switch):
        self.folder = os.path.join(folder, "host%d" % number)
        os.makedirs(self.folder)
        self.processes = []
        self.holder = subprocess.Popen(["unshare", "--net", "sleep", "infinity"])
        while os.readlink("/proc/%d/ns/net" % self.holder.pid) == os.readlink("/proc/self/ns/net"):
            time.sleep(0.01)
        self.port = switch.add(self.holder.pid)
        for words in (["link", "set", "lo", "up"], ["link", "set", "eth0", "up"], ["address", "add", "10.9.0.%d/24" % number, "dev", "eth0"],
                      ["route", "add", "224.0.0.0/4", "dev", "eth0"]):
            subprocess.run([*self.inside(), "ip", *words], check=True)

    def inside(self):
        return ["nsenter", "--target", str(self.holder.pid), "--net"]

    def start_mocapd(self, config, **environment):
        path = os.path.join(self.folder, "mocapd.toml")
        with open(path, "w") as out:
            out.write(config + BOTH.format(folder=self.folder))
        log = open(os.path.join(self.folder, "log"), "ab")
        process = subprocess.Popen([*self.inside(), os.path.join(BIN, "mocapd"), "--config", path], stdout=subprocess.DEVNULL, stderr=log,
                                   env={**os.environ, "XDG_STATE_HOME": self.folder, **environment})
        self.processes.append(process)
        return process

    def status(self):
        asked = subprocess.run([os.path.join(BIN, "mocap"), "status", "--json", "--socket", os.path.join(self.folder, "control")],
                               capture_output=True, text=True)
        return json.loads(asked.stdout) if asked.returncode == 0 else {"good": False, "complaints": [asked.stderr], "nodes": []}

    def end(self):
        for process in self.processes:
            process.kill()
            process.wait()
        self.holder.kill()
        self.holder.wait()


class Node(Host):
    def __init__(self, number, folder, switch, take, cameras):
        super().__init__(number, folder, switch)
        self.name = "node%d" % number
        self.config = NODE.format(name=self.name, cameras=json.dumps(cameras), take=take)
        self.clock = os.path.join(self.folder, "clock")
        self.set_clock(0)

    def start(self):
        self.process = self.start_mocapd(self.config, LD_PRELOAD=FAKETIME, FAKETIME_TIMESTAMP_FILE=self.clock, FAKETIME_NO_CACHE="1",
                                         DONT_FAKE_MONOTONIC="1")

    def ask(self):
        """What reaches its mocapd, in the place of ssh (see ask_over_ssh)."""
        return [*self.inside(), os.path.join(BIN, "mocap"), "ask", "--socket", os.path.join(self.folder, "control")]

    def set_clock(self, ahead_s):
        with open(self.clock + ".new", "w") as out:
            out.write("%+.3f\n" % ahead_s)
        os.replace(self.clock + ".new", self.clock)


def studio_config(take, fps, nodes):
    """Of a studio that asks its nodes, which are pairs of a Node and its cameras."""
    return STUDIO.format(take=take, fps=fps) + "".join(
        '[[nodes]]\nname = "%s"\ncameras = %s\ncontrol = %s\n' % (node.name, json.dumps(cameras), json.dumps(node.ask()))
        for node, cameras in nodes)
