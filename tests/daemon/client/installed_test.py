#!/usr/bin/python3
"""What `cmake --install` leaves, used without the build tree: programs, headers, the Python package, and files of the system."""
import glob
import os
import re
import socket
import stat
import struct
import subprocess
import tempfile
import time
import unittest

from client_log import BIN, free_group, need_multicast

SOURCE = os.path.abspath(os.path.join(os.path.dirname(__file__), "../../.."))
BUILD = os.path.dirname(BIN)
# In a namespace of its own nobody sees the build tree; where that is not permitted, the commands just do not name it.
HIDDEN = ["unshare", "--map-root-user", "--mount", "sh", "-c", 'mount -t tmpfs none "$0" && exec "$@"', BUILD]


def run(*words, **options):
    return subprocess.run(words, capture_output=True, text=True, cwd="/", **options)


def install(destdir="", prefix=None):
    """As somebody whose files are nobody else's business."""
    chosen = ["--prefix", prefix] if prefix else []
    subprocess.run(["cmake", "--install", BUILD, *chosen], check=True, capture_output=True, umask=0o077,
                   env={**os.environ, "DESTDIR": destdir})


def read(*path):
    with open(os.path.join(*path), encoding="utf-8") as file:
        return file.read()


class InstalledTest(unittest.TestCase):
    """Below a prefix of its own."""

    @classmethod
    def setUpClass(cls):
        cls.hides = HIDDEN if run(*HIDDEN, "true").returncode == 0 else []
        cls.folder = cls.enterClassContext(tempfile.TemporaryDirectory())
        cls.prefix = os.path.join(cls.folder, "prefix")
        install(prefix=cls.prefix)

    def alone(self, *words, **environment):
        """The output of a command that sees what is installed, but not what was built."""
        done = run(*self.hides, *words, env={"PATH": "/usr/bin:/bin", **environment})
        self.assertEqual(done.returncode, 0, f"{words}: {done.stderr}")
        return done.stdout

    def test_everybody_may_read_it_whatever_the_umask(self):
        for folder, folders, files in os.walk(self.prefix):
            for name in [*folders, *files]:
                path = os.path.join(folder, name)
                mode = stat.S_IMODE(os.stat(path).st_mode)
                runs = os.path.isdir(path) or os.path.dirname(path).endswith("/bin")
                self.assertEqual(oct(mode), oct(0o755 if runs else 0o644), path)

    def test_no_text_names_the_build_tree(self):
        for path in glob.glob(self.prefix + "/**", recursive=True):
            if os.path.isfile(path) and os.path.dirname(path) != self.prefix + "/bin":
                with open(path, "rb") as file:
                    self.assertNotIn(BUILD.encode(), file.read(), path)

    def test_programs_track_and_find_their_configuration(self):
        mocap, config = self.prefix + "/bin/mocap", self.prefix + "/etc/mocapd/mocapd.toml"
        take, result = self.folder + "/take", self.folder + "/result"
        self.alone(mocap, "simulate", "--out", take, "--seconds", "0.5", "--fps", "10", "--cameras", "3", "--width", "160",
                   "--height", "120")
        self.alone(mocap, "track", take, "--out", result, "--voxel-size", "60")
        self.assertTrue(os.path.exists(result + "/body.toml"))
        self.alone(self.prefix + "/bin/mocapd", "--config", config, "--check-config")
        text = read(config)
        with open(config, "w", encoding="utf-8") as file:
            file.write("nonsense = 1\n")
        said = run(mocap, "doctor").stderr
        with open(config, "w", encoding="utf-8") as file:
            file.write(text)
        self.assertIn(config, said)

    def test_units_start_what_is_installed(self):
        units = glob.glob(self.prefix + "/lib/systemd/system/mocapd*.service")
        self.assertEqual(len(units), 4)
        paths = re.findall(re.escape(self.prefix) + r"[\w/.]+", "".join(read(unit) for unit in units))
        self.assertEqual({os.path.relpath(path, self.prefix) for path in paths},
                         {"bin/mocap", "bin/mocapd", "etc/mocapd/mocapd.toml"})
        for path in paths:
            self.assertTrue(os.path.exists(path), path)

    def test_clients_are_built_by_cmake_and_by_pkg_config(self):
        build, example = self.folder + "/by_cmake", self.prefix + "/share/doc/mocapd-dev/examples"
        self.alone("cmake", "-G", "Ninja", "-S", example, "-B", build, f"-DCMAKE_PREFIX_PATH={self.prefix}")
        self.alone("cmake", "--build", build)
        flags = self.alone("pkg-config", "--cflags", "--libs", "mocap-lcmtypes",
                           PKG_CONFIG_PATH=self.prefix + "/share/pkgconfig").split()
        self.alone("g++", "-std=c++17", example + "/follow_pose.cpp", *flags, "-o", self.folder + "/by_pkg_config")
        follow = self.folder + "/by_pkg_config"
        self.assertRegex(run(follow, "--help").stdout, "^usage: follow_pose ")
        for wrong in (["", "soon"], ["", ""], ["--frobnicate"], ["", "1", "left.", "more"]):
            done = run(follow, *wrong)
            self.assertEqual((done.returncode, done.stdout, done.stderr[:6]), (2, "", "usage:"), wrong)
        need_multicast(self)
        done = run(follow, "udpm://239.255.76.64:7667?ttl=0", "0.1")
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertRegex(done.stderr, r"^follow_pose: no pose came for 0.1 s; is mocapd running.*\n$")
        self.assertRegex(self.said_beside("left.", follow, "1"), 'but mocapd sends there with prefix "left."\n$')
        self.assertRegex(self.said_beside("", follow, "1", "left."), "but mocapd sends there without a prefix\n$")
        self.assertRegex(self.said_beside("left.", follow, "1", "left."), "only mocapd's status: mocap status says why\n$")
        python = ("/usr/bin/python3", "-B", example + "/follow_pose.py")
        self.assertRegex(self.said_beside("left.", *python, "1", "right."), 'no right.MOCAP_POSE came .* with prefix "left.": choose')

    def said_beside(self, prefix, *words):
        """Runs an example, whose first words are followed by the URL, beside a daemon that sends its status only."""
        group, port = free_group().removeprefix("udpm://").partition("?")[0].split(":")
        place = next(i for i, word in enumerate(words) if word == "1")
        words = [*words[:place], f"udpm://{group}:{port}?ttl=0", *words[place:]]
        message = struct.pack(">II", 0x4C433032, 0) + f"{prefix}MOCAP_STATUS".encode() + b"\0x"
        with subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as process, \
                socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
            while process.poll() is None:
                sender.sendto(message, (group, int(port)))
                time.sleep(0.01)
            return process.stderr.read()

    def test_python_imports_it_from_the_prefix_of_an_environment(self):
        [package] = glob.glob(self.prefix + "/lib/python3.*/site-packages")
        self.alone("/usr/bin/python3", "-B", "-c", "import mocapd; mocapd.listen", PYTHONPATH=package)


class BuiltTest(unittest.TestCase):
    """Before anything is installed."""

    def test_the_demo_builds_all_that_is_installed_and_all_that_it_names(self):
        demo = read(SOURCE, "tools/demo")
        [target] = re.findall(r"tools/build --target (.*)", demo)
        commands = run("ninja", "-C", BUILD, "-t", "commands", *target.split()).stdout
        built = {"bin/mocap": " -o bin/mocap ", "bin/mocapd": " -o bin/mocapd ", "python": f" --ppath {BUILD}/python "}
        for name, how in built.items():
            self.assertTrue(how in commands, name)
        self.assertLessEqual(set(re.findall(r"build/release/(bin/\w+|python)", demo)), set(built))

    def test_an_incomplete_build_is_not_installed_at_all(self):
        with tempfile.TemporaryDirectory() as folder:
            script, prefix = folder + "/install_folders.cmake", folder + "/prefix"
            with open(script, "w", encoding="utf-8") as file:
                file.write(read(BUILD, "systemd/install_folders.cmake").replace(BUILD, folder))
            done = run("cmake", f"-DCMAKE_INSTALL_PREFIX={prefix}", "-P", script)
            self.assertNotEqual(done.returncode, 0)
            self.assertIn("mocapd: not built yet; run tools/build", " ".join(done.stderr.split()))
            self.assertFalse(os.path.exists(prefix))


class StagedTest(unittest.TestCase):
    """In a folder that stands for /, as packages are made."""

    def setUp(self):
        self.root = self.enterContext(tempfile.TemporaryDirectory())

    def test_below_usr_local_python_finds_the_package(self):
        install(self.root, "/usr/local")
        [package] = glob.glob(self.root + "/**/mocapd/__init__.py", recursive=True)
        folder = os.path.dirname(os.path.dirname(package)).removeprefix(self.root)
        self.assertIn(folder, run("/usr/bin/python3", "-I", "-c", "import sys; print('\\n'.join(sys.path))").stdout.splitlines())

    def test_what_was_configured_is_kept(self):
        install(self.root, "/usr/local")
        config = self.root + "/usr/local/etc/mocapd/mocapd.toml"
        with open(config, "w", encoding="utf-8") as file:
            file.write("# mine\n")
        install(self.root, "/usr/local")
        self.assertEqual(read(config), "# mine\n")

    def test_below_usr_lies_what_the_packages_take(self):
        install(self.root, "/usr")
        taken = [line for name in glob.glob(SOURCE + "/debian/*.install") for line in read(name).splitlines()]
        self.assertGreater(len(taken), 10)
        for path in taken:
            self.assertTrue(os.path.exists(os.path.join(self.root, path)), path)
        unit = read(self.root, "lib/systemd/system/mocapd.service")
        self.assertIn("ExecStart=/usr/bin/mocapd --config /etc/mocapd/mocapd.toml\n", unit)
        self.assertTrue(os.path.exists(self.root + "/etc/mocapd/mocapd.toml"))


if __name__ == "__main__":
    unittest.main()
