"""A studio of GigE Vision cameras, served on the loopback of a network namespace."""
import os
import re
import subprocess
import sys
import threading
import time

from running_daemon import BIN, Failure

OWN_NETWORK = "MOCAP_OWN_NETWORK"


def set_up_network():
    for words in (["link", "set", "lo", "up"], ["route", "replace", "224.0.0.0/4", "dev", "lo"]):
        subprocess.run(["ip", *words], check=True)


def enter_network_of_its_own():
    if OWN_NETWORK not in os.environ:
        as_user = [] if os.geteuid() == 0 else ["--map-root-user"]
        os.execvpe("unshare", ["unshare", "--net", *as_user, sys.executable, *sys.argv], {**os.environ, OWN_NETWORK: "1"})
    set_up_network()


class Studio:
    """`mocap gige-studio`, and when it said what."""

    def __init__(self, take, folder, *options):
        self.config = os.path.join(folder, "served.toml")
        self.process = subprocess.Popen([os.path.join(BIN, "mocap"), "gige-studio", take, "--config", self.config, *options],
                                        stdout=subprocess.PIPE, text=True)
        self.lines = []
        threading.Thread(target=self.read, daemon=True).start()

    def read(self):
        for line in self.process.stdout:
            self.lines.append((time.time(), line))

    def wait_for(self, pattern, times=1, seconds=60):
        """The last of so many lines that match: when it came, and what it says in the pattern's group."""
        end = time.time() + seconds
        while time.time() < end:
            found = [(when, match) for when, line in self.lines for match in [re.search(pattern, line)] if match]
            if len(found) >= times:
                return found[times - 1][0], found[times - 1][1][1]
            if self.process.poll() is not None:
                break
            time.sleep(0.01)
        raise Failure("gige-studio did not say \"%s\"" % pattern)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.wait()
