#!/usr/bin/env python3
"""Drives a page that `export X.html` has written in a headless Chromium, by the DevTools protocol over a pipe.

web-page.py PAGE WIDTHxHEIGHT STEP...    runs the steps in order, and ends with 1 after any error of the page:
  wait                    until the page has drawn its finest image
  shot FILE.png           saves what the page shows, without its panel
  compare FILE.png DECIBELS  compares it with an image, prints the PSNR, and is an error below that many decibels
  drag X,Y X,Y            drags with the left button, and prints the frames a second meanwhile
  wheel X,Y TURNS         turns the wheel so many times, forwards where that is positive
  slide NAME VALUE        moves a slider
  camera JSON             puts the camera elsewhere: position and axes
  print EXPRESSION        prints the value of an expression of JavaScript
"""
import base64
import json
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time
import zlib


class Browser:
    def __init__(self, width, height):
        program = shutil.which("chromium") or shutil.which("chromium-browser")
        self.profile = tempfile.TemporaryDirectory()
        to_browser, from_us = os.pipe()
        to_us, from_browser = os.pipe()
        # Chromium reads at 3 and writes at 4; these may be taken already.
        high = [os.dup(end) for end in (to_browser, from_browser)]

        def redirect():
            kept = [os.dup(end) for end in high]
            while min(kept) < 5:
                kept = [os.dup(end) for end in kept]
            os.dup2(kept[0], 3)
            os.dup2(kept[1], 4)

        self.process = subprocess.Popen(
            [program, "--headless=new", "--no-sandbox", "--remote-debugging-pipe", "--use-gl=angle", "--use-angle=swiftshader",
             "--enable-unsafe-swiftshader", "--hide-scrollbars", "--force-device-scale-factor=1", "--disable-gpu-vsync",
             f"--window-size={width},{height}", f"--user-data-dir={self.profile.name}", "about:blank"],
            pass_fds=[3, 4, *high], preexec_fn=redirect, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        for end in (to_browser, from_browser, *high):
            os.close(end)
        self.writer = os.fdopen(from_us, "wb", buffering=0)
        self.reader = os.fdopen(to_us, "rb", buffering=0)
        self.rest = b""
        self.count = 0
        self.session = None
        self.errors = []
        target = next(one for one in self.call("Target.getTargets")["targetInfos"] if one["type"] == "page")
        self.session = self.call("Target.attachToTarget", targetId=target["targetId"], flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log"):
            self.call(domain + ".enable")
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)

    def call(self, method, **parameters):
        self.count += 1
        message = {"id": self.count, "method": method, "params": parameters}
        if self.session:
            message["sessionId"] = self.session
        self.writer.write(json.dumps(message).encode() + b"\0")
        while True:
            answer = self.read()
            if answer.get("id") == self.count:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']}")
                return answer["result"]
            self.note(answer)

    def read(self):
        while b"\0" not in self.rest:
            more = os.read(self.reader.fileno(), 1 << 16)
            if not more:
                raise RuntimeError("the browser has ended")
            self.rest += more
        text, self.rest = self.rest.split(b"\0", 1)
        return json.loads(text)

    def note(self, event):
        method, parameters = event.get("method"), event.get("params", {})
        if method == "Runtime.exceptionThrown":
            details = parameters["exceptionDetails"]
            self.errors.append(details.get("exception", {}).get("description") or details["text"])
        elif method == "Runtime.consoleAPICalled" and parameters["type"] in ("error", "warning"):
            self.errors.append(" ".join(str(one.get("value") or one.get("description")) for one in parameters["args"]))
        elif method == "Log.entryAdded" and parameters["entry"]["level"] == "error":
            self.errors.append(parameters["entry"]["text"])

    def evaluate(self, expression):
        result = self.call("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in result:
            raise RuntimeError(result["exceptionDetails"].get("exception", {}).get("description"))
        return result["result"].get("value")

    def mouse(self, kind, place, **more):
        self.call("Input.dispatchMouseEvent", type=kind, x=place[0], y=place[1], **more)

    def close(self):
        self.process.terminate()
        self.process.wait()


def wait(browser, seconds=480):
    end = time.time() + seconds
    while browser.evaluate("document.getElementById('canvas').dataset.state") != "done":
        if time.time() > end or browser.errors:
            raise RuntimeError("the page does not come to an end: " + "; ".join(browser.errors))
        time.sleep(0.2)


def processor_time(browser):
    """Seconds that the browser's processes have computed."""
    total = 0
    for entry in pathlib.Path("/proc").glob("[0-9]*/stat"):
        try:
            arguments = (entry.parent / "cmdline").read_bytes()
            fields = entry.read_text().rsplit(")", 1)[1].split()
        except OSError:
            continue
        if browser.profile.name.encode() in arguments or int(fields[1]) == browser.process.pid:
            total += int(fields[11]) + int(fields[12])
    return total / os.sysconf("SC_CLK_TCK")


def screenshot(browser):
    browser.evaluate("document.getElementById('panel').style.visibility = 'hidden'")
    image = base64.b64decode(browser.call("Page.captureScreenshot", format="png")["data"])
    browser.evaluate("document.getElementById('panel').style.visibility = ''")
    return image


def pixels(png):
    """The size of a PNG of 8 bits, and its red, green and blue."""
    chunks, at, data = {}, 8, b""
    while at < len(png):
        size, kind = int.from_bytes(png[at:at + 4], "big"), png[at + 4:at + 8]
        chunks[kind] = png[at + 8:at + 8 + size]
        data += chunks[kind] if kind == b"IDAT" else b""
        at += 12 + size
    header = chunks[b"IHDR"]
    width, height = int.from_bytes(header[:4], "big"), int.from_bytes(header[4:8], "big")
    step = {2: 3, 6: 4}[header[9]]
    rows, size, above, result = zlib.decompress(data), step * width, bytes(step * width), bytearray()
    for y in range(height):
        kind, row = rows[y * (size + 1)], bytearray(rows[y * (size + 1) + 1:(y + 1) * (size + 1)])
        for i in range(size if kind else 0):
            left, up, corner = row[i - step] if i >= step else 0, above[i], above[i - step] if i >= step else 0
            if kind == 4:
                guess = left + up - corner
                added = min((left, up, corner), key=lambda one: abs(guess - one))
            else:
                added = (0, left, up, (left + up) // 2)[kind]
            row[i] = (row[i] + added) & 255
        above = bytes(row)
        result += bytes(value for i, value in enumerate(row) if i % step < 3)
    return (width, height), result


def compare(browser, file, least):
    (size, ours), (other, theirs) = pixels(screenshot(browser)), pixels(pathlib.Path(file).read_bytes())
    if size != other:
        raise RuntimeError(f"{file} has the size {other}, and the page {size}")
    squares = sum((a - b) ** 2 for a, b in zip(ours, theirs))
    decibels = 10 * math.log10(255 ** 2 * len(ours) / max(squares, 1))
    print(f"{file}: {decibels:.2f} dB")
    if decibels < least:
        browser.errors.append(f"fewer than {least} dB")


def place(text):
    return [float(number) for number in text.split(",")]


def drag(browser, start, end):
    browser.evaluate("""window.times = []; (function count(time) { window.times.push(time); window.counting =
        requestAnimationFrame(count); })(performance.now())""")
    browser.mouse("mousePressed", start, button="left", buttons=1, clickCount=1)
    began, computed = time.time(), processor_time(browser)
    while (part := (time.time() - began) / 4) < 1:
        browser.mouse("mouseMoved", [a + part * (b - a) for a, b in zip(start, end)], button="left", buttons=1)
    browser.mouse("mouseReleased", end, button="left", clickCount=1)
    # The first second is there to find how fine frames may be.
    times = browser.evaluate("(cancelAnimationFrame(window.counting), window.times)")
    late = [one for one in times if one > times[0] + 1500]
    print(f"drag: {1000 * (len(late) - 1) / (late[-1] - late[0]):.1f} frames a second, "
          f"{1000 * (processor_time(browser) - computed) / (len(times) - 1):.0f} ms of processor time each, "
          f"{browser.evaluate('viewer.instances')} instances")


def main():
    page, size, *steps = sys.argv[1:]
    browser = Browser(*(int(one) for one in size.split("x")))
    try:
        browser.call("Page.navigate", url=pathlib.Path(page).resolve().as_uri())
        while browser.evaluate("document.readyState") != "complete":
            time.sleep(0.05)
        while steps:
            step = steps.pop(0)
            if step == "wait":
                began = time.time()
                wait(browser)
                print(f"wait: {time.time() - began:.1f} s, {browser.evaluate('viewer.instances')} instances")
            elif step == "shot":
                pathlib.Path(steps.pop(0)).write_bytes(screenshot(browser))
            elif step == "compare":
                compare(browser, steps.pop(0), float(steps.pop(0)))
            elif step == "drag":
                drag(browser, place(steps.pop(0)), place(steps.pop(0)))
            elif step == "wheel":
                at, turns = place(steps.pop(0)), float(steps.pop(0))
                for _ in range(int(abs(turns))):
                    browser.mouse("mouseWheel", at, deltaX=0, deltaY=-100 if turns > 0 else 100)
                    time.sleep(0.05)
            elif step == "slide":
                name, value = steps.pop(0), steps.pop(0)
                browser.evaluate(f"""(slider => {{ slider.value = {value}; slider.dispatchEvent(new Event("input")); }})(
                    document.querySelector('input[title="{name}"]'))""")
            elif step == "camera":
                browser.evaluate(f"(Object.assign(viewer.camera, {steps.pop(0)}), viewer.change())")
            elif step == "print":
                print(json.dumps(browser.evaluate(steps.pop(0))))
            else:
                raise SystemExit(f"unknown step {step}")
    finally:
        browser.close()
    for error in browser.errors:
        print("error:", error)
    sys.exit(1 if browser.errors else 0)


if __name__ == "__main__":
    main()
