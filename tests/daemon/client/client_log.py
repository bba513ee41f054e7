"""What a real daemon says, for the tests of clients: people who walk through the simulated studio."""
import os
import subprocess
import tempfile

BIN = os.environ["MOCAP_BIN_DIR"]
GROUP = "239.255.76.67"
CONFIG = """
[source]
driver = "take"
take = "{take}"
rate = "{rate}"
loop = {loop}
[lcm]
url = "{url}"
[control]
socket = "{folder}/control"
[recording]
folder = "{folder}/takes"
"""


def mocap(*words):
    return subprocess.run([os.path.join(BIN, "mocap"), *words], check=True, capture_output=True, text=True).stdout


def skip(test, why):
    """As the tests in C++ tell it, for tools/check."""
    print(f"{test.id()}: Skipped\n{why}", flush=True)
    test.skipTest(why)


def need_multicast(test):
    if subprocess.run(["ip", "route", "get", GROUP], capture_output=True).returncode != 0:
        skip(test, "needs a multicast route; tools/check gives itself one")


def free_group():
    return f"udpm://{GROUP}:{20000 + os.getpid() % 40000}?ttl=0"


class TrackedTake:
    """A take of people that a daemon has tracked, and the log of what it said, while a block runs."""

    def __init__(self, people=1):
        self.people = people

    def __enter__(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = self.temporary.name
        self.take, self.log = os.path.join(self.folder, "take"), os.path.join(self.folder, "log")
        mocap("simulate", "--out", self.take, "--motion", "walk", "--people", str(self.people), "--seconds", "3", "--fps", "15",
              "--cameras", "4", "--width", "320", "--height", "240")
        if self.daemon(f"file://{self.log}?mode=w").wait() != 0:
            raise RuntimeError("mocapd failed")
        return self

    def __exit__(self, *_):
        self.temporary.cleanup()

    def daemon(self, url, rate="fast", loop="false"):
        """Starts one that plays the take."""
        config = os.path.join(self.folder, "mocapd.toml")
        with open(config, "w") as out:
            out.write(CONFIG.format(take=self.take, url=url, rate=rate, loop=loop, folder=self.folder))
        return subprocess.Popen([os.path.join(BIN, "mocapd"), "--config", config], stdout=subprocess.DEVNULL,
                                stderr=subprocess.DEVNULL, env={**os.environ, "XDG_STATE_HOME": self.folder})
