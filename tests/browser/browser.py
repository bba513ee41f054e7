"""A Chromium without a window, driven by Selenium, that looks at `mocap view`."""
import json
import os
import sys
import time

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "tests/system"))
from running_daemon import Failure

SCREENSHOTS = os.path.join(ROOT, "build/browser")
CHROMIUM, DRIVER = "/usr/bin/chromium", "/usr/bin/chromedriver"
# WebGL by the processor, as a machine without a display has no other.
ARGUMENTS = ["--headless=new", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--hide-scrollbars",
             "--disable-background-networking", "--no-first-run"]


def why_not():
    """What this machine lacks for a test in a browser; empty: nothing."""
    missing = [name for name in (CHROMIUM, DRIVER) if not os.path.exists(name)]
    try:
        import selenium  # noqa: F401
    except ImportError:
        missing.append("python3-selenium")
    return "" if not missing else "%s: missing; tools/install_packages --browser installs it" % ", ".join(missing)


class Browser:
    """Ends with the block."""

    def __init__(self, width=1280, height=800):
        self.size = width, height

    def __enter__(self):
        from selenium import webdriver
        from selenium.webdriver.chrome.service import Service
        options = webdriver.ChromeOptions()
        options.binary_location = CHROMIUM
        for argument in [*ARGUMENTS, "--window-size=%d,%d" % self.size]:
            options.add_argument(argument)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        self.driver = webdriver.Chrome(service=Service(DRIVER), options=options)
        self.driver.set_page_load_timeout(60)
        self.driver.set_script_timeout(60)
        self.resize(*self.size)
        return self

    def __exit__(self, *_):
        self.driver.quit()

    def resize(self, width, height, is_phone=False):
        """The size of what the page has; a window's is larger."""
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                    {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": is_phone})

    def prefer(self, scheme):
        """`light` or `dark`, as the system would."""
        self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": scheme}]})

    def open(self, address):
        # Elsewhere first: an address that differs after its # alone would not be loaded anew.
        self.driver.get("about:blank")
        self.driver.get(address)

    def run(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    def run_async(self, script, *arguments):
        """What the script, in which `await` may be said, returns; raises where it throws."""
        found = self.driver.execute_async_script(
            "const done = arguments[arguments.length - 1];"
            "(async () => {%s})().then((value) => done([value]), (error) => done(String(error)));" % script, *arguments)
        if not isinstance(found, list):
            raise Failure("%s: in the browser" % found)
        return found[0]

    def until(self, script, seconds, otherwise, *arguments):
        """What the expression gives in the page, once that is true there: looked at whenever the page draws."""
        found = self.driver.execute_async_script("""
            const [milliseconds, rest, done] = [arguments[0], arguments[1], arguments[arguments.length - 1]];
            const end = performance.now() + milliseconds;
            const look = () => {
              let found = null;
              try { found = (function() { return %s; }).apply(null, rest); } catch { }
              if (found) done(found);
              else if (performance.now() > end) done(null);
              else setTimeout(look, 20);
            };
            look();""" % script, 1000 * min(seconds, 55), arguments)
        if found is None:
            raise Failure("the page %s in %g s; it shows: %s" % (otherwise, seconds, self.text()[:600]))
        return found

    def text(self):
        return " ".join(self.run("return document.body.innerText").split())

    def click(self, element_id):
        self.run("document.getElementById(arguments[0]).scrollIntoView({block: 'center'})", element_id)
        self.driver.find_element("id", element_id).click()

    def type(self, element_id, words):
        field = self.driver.find_element("id", element_id)
        field.clear()
        field.send_keys(words)

    def errors(self):
        """What the console told since the last time, of what is worse than a warning."""
        return [entry["message"] for entry in self.driver.get_log("browser") if entry["level"] == "SEVERE"]

    def screenshot(self, name):
        os.makedirs(SCREENSHOTS, exist_ok=True)
        self.driver.save_screenshot(os.path.join(SCREENSHOTS, name + ".png"))

    def json(self, path):
        return json.loads(self.run_async("return await (await fetch(arguments[0])).text()", path))


def wait_until(holds, seconds, otherwise):
    """What `holds` gives, once that is something."""
    end = time.time() + seconds
    while time.time() < end:
        found = holds()
        if found:
            return found
        time.sleep(0.05)
    raise Failure("%s in %g s" % (otherwise, seconds))
