#!/usr/bin/env python3
"""The report of python3 -m hvi report in a real browser: browser.py REPORT.html [OUT]

Chromium (Debian: apt-get install chromium), headless: no message in the console, nothing asked of a network, all pictures load, nothing is cut off
at the widths of a desk and of a phone, pages print. Screenshots and the print are left in OUT. `make verify` runs it on a report of a run of its own.
"""

import html
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

WIDTHS = {"desk": 1400, "phone": 390}
# what a reader would see, as the page itself measures it; wide tables may scroll within their frames
LOOK = """<script>
addEventListener("load", () => {
  const cut = [...document.querySelectorAll("body *")].filter(e => !e.closest(".scroll, pre") && e.getBoundingClientRect().right > document.documentElement.clientWidth + 1);
  const scripts = document.querySelectorAll("script:not([data-look]), iframe, object, embed, [onload], [onerror]").length;
  parent.postMessage(JSON.stringify({
    pictures: document.images.length, broken: [...document.images].filter(i => !i.naturalWidth).length, silent: [...document.images].filter(i => !i.alt).length,
    width: document.documentElement.clientWidth, scroll: document.documentElement.scrollWidth, cut: cut.map(e => e.tagName + " " + e.textContent.slice(0, 40)),
    scripts: scripts, loaded: performance.getEntriesByType("resource").filter(r => !r.name.startsWith("data:")).map(r => r.name),
    height: document.documentElement.scrollHeight}), "*");
});
</script>"""
FRAME = """<!DOCTYPE html><title>frame</title><body style="margin: 0"><iframe src="{page}" style="border: 0; width: {width}px; height: {height}px"></iframe>
<script>addEventListener("message", said => document.body.setAttribute("data-seen", said.data));</script></body>"""


def chromium():
    """path of the browser, None if there is none"""
    return next((path for name in ("chromium", "chromium-browser", "google-chrome") if (path := shutil.which(name))), None)


def call(*words, timeout=180):
    """(stdout, messages of the page's console)"""
    with tempfile.TemporaryDirectory() as home:
        command = [chromium(), "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--hide-scrollbars", "--no-first-run", "--enable-logging=stderr",
                   f"--user-data-dir={home}", "--virtual-time-budget=20000", *words]
        done = subprocess.run(command, capture_output=True, text=True, timeout=timeout, env={**os.environ, "HOME": home})
    if done.returncode:
        raise RuntimeError(f"{' '.join(command)}: exit status {done.returncode}\n{done.stderr[-2000:]}")
    return done.stdout, re.findall(r"CONSOLE[^\n]*", done.stderr)


def look(report, out):
    """{width: what is seen there} and a list of what is wrong; writes desk.png, phone.png, print.pdf"""
    out = pathlib.Path(out)
    out.mkdir(parents=True, exist_ok=True)
    seen, wrong = {}, []
    text = pathlib.Path(report).read_text(encoding="utf-8")
    for name, width in WIDTHS.items():
        # a window is not as narrow as a phone: the page is shown in a frame of that width
        page, frame = out / f"{name}.look.html", out / f"{name}.frame.html"
        page.write_text(text.replace("</body>", LOOK.replace("<script>", "<script data-look>") + "</body>"), encoding="utf-8")
        frame.write_text(FRAME.format(page=page.name, width=width, height=1000))
        dom, said = call(f"--window-size={max(width, 500)},1000", "--dump-dom", frame.resolve().as_uri())
        found = re.search(r'data-seen="([^"]*)"', dom)
        if not found:
            wrong.append(f"{name}: the page did not load")
            continue
        here = seen[name] = json.loads(html.unescape(found[1]))
        wrong += [f"{name}: console: {line}" for line in said]
        wrong += [f"{name}: {here[key]} {text}" for key, text in (("broken", "pictures do not load"), ("silent", "pictures without alt"), ("scripts", "scripts or frames")) if here[key]]
        wrong += [f"{name}: loaded from elsewhere: {url}" for url in here["loaded"]] + [f"{name}: cut off: {text}" for text in here["cut"]]
        if here["scroll"] > here["width"]:
            wrong.append(f"{name}: {here['scroll']} pixels wide in a window of {here['width']}")
        if here["width"] != width:
            wrong.append(f"{name}: shown {here['width']} pixels wide, not {width}")
        high = min(here["height"], 16000)
        frame.write_text(FRAME.format(page=page.name, width=width, height=high))
        call(f"--window-size={max(width, 500)},{high}", f"--screenshot={out.resolve() / (name + '.png')}", frame.resolve().as_uri())
        page.unlink()
        frame.unlink()
    call("--no-pdf-header-footer", f"--print-to-pdf={out.resolve() / 'print.pdf'}", pathlib.Path(report).resolve().as_uri())
    for made in ("desk.png", "phone.png", "print.pdf"):
        if not (out / made).is_file() or (out / made).stat().st_size < 20000:
            wrong.append(f"{made} was not made")
    return seen, wrong


def main():
    if not chromium():
        print("browser.py: skipped, chromium is not there (Debian: apt-get install chromium)")
        return 0
    seen, wrong = look(sys.argv[1], sys.argv[2] if len(sys.argv) > 2 else ".")
    for name, here in seen.items():
        print(f"{name}: {here['pictures']} pictures, {here['width']} x {here['height']} pixels")
    print("\n".join(wrong) or "nothing is wrong")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
