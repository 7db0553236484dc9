#!/usr/bin/env python3
"""The pages of python3 -m hvi report and view in a real browser: browser.py PAGE.html [OUT]

Headless Chromium (tests/lib/chromium.py): no message in the console, nothing asked of a network, all pictures load, nothing is cut off at the widths of a desk and of a phone,
pages print. The only script is python/hvi/report/view.js, and a browser would run no other. Its scene draws, turns, goes through time, takes other colors and cuts, each time with one
call and without making anything; without WebGL and on paper there is the still picture. Screenshots and the print are left in OUT. `make verify` runs it on a report of a run of its own.
"""

import base64
import hashlib
import html
import pathlib
import re
import sys

TESTS = pathlib.Path(__file__).resolve().parents[1]
sys.path[:0] = [str(TESTS / "lib")]

import chromium  # noqa: E402

WIDTHS = {"desk": 1400, "phone": 390}
VIEW = (TESTS.parent / "python/hvi/report/view.js").read_text()
DRAWN, CHANGED = 0.01, 0.001  # of the pixels at least: a scene is more than background, and things that a reader does to it change it
# what a reader would see, as the page itself measures it; wide tables may scroll within their frames
LOOK = """(() => {
  const cut = [...document.querySelectorAll("body *")].filter(e => !e.closest(".scroll, pre, .axes") && e.getBoundingClientRect().right > document.documentElement.clientWidth + 1);
  const is = name => { const e = document.querySelector(".scene " + name); return e !== null && getComputedStyle(e).display !== "none"; };
  return {
    pictures: document.images.length, broken: [...document.images].filter(i => !i.naturalWidth).length, silent: [...document.images].filter(i => !i.alt).length,
    width: document.documentElement.clientWidth, scroll: document.documentElement.scrollWidth, height: document.documentElement.scrollHeight,
    cut: cut.map(e => e.tagName + " " + e.textContent.slice(0, 40)), live: is(".live"), still: is(".still"),
    scripts: document.querySelectorAll("script, iframe, object, embed, [onload], [onerror]").length};
})()"""
# looks at the scene after each thing that a reader may do: shares of the pixels that are not background, and that have changed; calls that draw, and that make something
SCENE = """(() => {
  const root = document.querySelector(".scene"), canvas = root.querySelector("canvas"), gl = canvas.getContext("webgl2"), wait = () => new Promise(requestAnimationFrame);
  const count = { draws: 0, made: 0 }, draws = ["drawArrays", "drawElements", "drawArraysInstanced", "drawElementsInstanced"];
  for (const name of [...draws, "bufferData", "createBuffer", "createTexture", "texImage2D", "createVertexArray", "createProgram", "createShader"]) {
    const call = gl[name].bind(gl);
    gl[name] = (...words) => {
      count[draws.includes(name) ? "draws" : "made"]++;
      const made = call(...words);
      if (!draws.includes(name)) return made;
      now = new Uint8Array(4 * gl.drawingBufferWidth * gl.drawingBufferHeight); // pixels are there only until the page is shown
      gl.readPixels(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight, gl.RGBA, gl.UNSIGNED_BYTE, now);
    };
  }
  canvas.setPointerCapture = () => {}; // of a pointer that is none
  const point = (kind, x, y, more) => canvas.dispatchEvent(new PointerEvent(kind, { pointerId: 1, clientX: x, clientY: y, buttons: 1, bubbles: true, ...more }));
  let before = null, now = null;
  window.hvi = {
    control: name => root.querySelector(`[data-is="${name}"]`),
    drag: (dx, dy, more) => { point("pointerdown", 200, 200, more); point("pointermove", 200 + dx, 200 + dy, more); point("pointerup", 200 + dx, 200 + dy, more); },
    set: (name, value, event) => { hvi.control(name).value = value; hvi.control(name).dispatchEvent(new Event(event)); },
    key: name => canvas.dispatchEvent(new KeyboardEvent("keydown", { key: name, cancelable: true })),
    after: async act => {
      await wait();
      Object.assign(count, { draws: 0, made: 0 });
      act();
      for (let k = 0; k < 20 && !count.draws; k++) await wait();
      let full = 0, changed = 0;
      for (let k = 0; k < now.length; k += 4) {
        full += Math.abs(now[k] - 247) + Math.abs(now[k + 2] - 250) > 6;
        changed += before !== null && Math.abs(now[k] - before[k]) + Math.abs(now[k + 1] - before[k + 1]) + Math.abs(now[k + 2] - before[k + 2]) > 12;
      }
      before = now;
      return { drawn: 4 * full / now.length, changed: 4 * changed / now.length, ...count };
    },
  };
  return { size: [canvas.width, canvas.height], last: Number(hvi.control("time").max), colors: [...hvi.control("color").options].map(o => o.textContent),
           whole: hvi.control("mirror").closest("label").hidden, legend: hvi.control("legend").textContent };
})()"""


def steps_of(scene):
    """(what a reader does, how), each in turn"""
    yield "as it was", "hvi.key('ArrowRight')"
    yield "turned by a drag", "hvi.drag(120, 40)"
    yield "turned by a key", "hvi.key('ArrowLeft')"
    yield "moved", "hvi.drag(60, 30, { shiftKey: true })"
    yield "nearer", "hvi.key('+')"
    yield "reset", "hvi.control('home').click()"
    if scene["last"]:
        yield "at the other end of time", f"hvi.set('time', Number(hvi.control('time').value) > {scene['last'] / 2} ? 0 : {scene['last']}, 'input')"
    for k, name in [*enumerate(scene["colors"])][::-1]:
        if len(scene["colors"]) > 1:
            yield f"colored by {name}", f"hvi.set('color', {k}, 'change')"
    yield "cut in another way", "hvi.set('cut', hvi.control('cut').value === 'none' ? (hvi.control('place').value = 250, 'x <') : 'none', 'change')"  # a quarter of what there is
    if not scene["whole"]:
        yield "without mirror images", "hvi.control('mirror').click()"


def look_at_scene(browser):
    """what is seen of the scene after each of the steps"""
    scene = browser.run(SCENE)
    scene["steps"] = {what: browser.run(f"hvi.after(() => {act})") for what, act in steps_of(scene)}
    return {**scene, "errors": browser.run("document.querySelector('canvas').getContext('webgl2').getError()")}


def wrong_scripts(text):
    """what a browser would run beside view.js"""
    scripts = re.findall(r"<script[^>]*>(.*?)</script>", text, re.S)
    if scripts != [VIEW]:
        yield f"{len(scripts)} scripts, or another one than python/hvi/report/view.js"
    checksum = "sha256-" + base64.b64encode(hashlib.sha256(VIEW.encode()).digest()).decode()
    if f"default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src '{checksum}'\"" not in html.unescape(text):
        yield f"the page does not say that only the script {checksum} may run"


def wrong_scene(scene):
    for what, step in scene["steps"].items():
        if step["draws"] != 1 or step["made"]:
            yield f"scene {what}: {step['draws']} calls that draw and {step['made']} that make something, not 1 and 0"
        if not DRAWN < step["drawn"] < 1 - DRAWN:
            yield f"scene {what}: {100 * (1 - step['drawn']):.3g} % of the pixels are background"
        if what != "as it was" and step["changed"] < CHANGED:
            yield f"scene {what}: it has not changed"
    if scene["errors"]:
        yield f"scene: error {scene['errors']} of WebGL"
    if not scene["legend"]:
        yield "scene: no legend"


def wrong_page(here, width):
    yield from (f"{here[key]} {what}" for key, what in (("broken", "pictures do not load"), ("silent", "pictures without alt")) if here[key])
    yield from (f"cut off: {what}" for what in here["cut"])
    if here["scripts"] != 1:
        yield f"{here['scripts']} scripts or frames, not 1"
    if here["scroll"] > here["width"] or here["width"] != width:
        yield f"{here['scroll']} pixels wide in a window of {here['width']}, which should be {width}"


def pictures_in(pdf):
    return pdf.read_bytes().count(b"/Subtype /Image")


def look(report, out):
    """{width: what is seen there} and a list of what is wrong; writes desk.png, phone.png, print.pdf"""
    out = pathlib.Path(out)
    out.mkdir(parents=True, exist_ok=True)
    seen, wrong = {}, list(wrong_scripts(pathlib.Path(report).read_text(encoding="utf-8")))
    with chromium.Chromium() as browser:
        for name, width in WIDTHS.items():
            browser.open(report, width)
            browser.wait_for_scene()
            here = seen[name] = browser.run(LOOK)
            wrong += [f"{name}: {what}" for what in wrong_page(here, width)]
            browser.size(width, min(here["height"], 16000))
            browser.shot(out / f"{name}.png")
            browser.size(width, 1000)
            if here["live"] and not here["still"]:
                here["scene"] = look_at_scene(browser)
                wrong += [f"{name}: {what}" for what in wrong_scene(here["scene"])]
            else:
                wrong.append(f"{name}: the scene is not there")
            wrong += [f"{name}: console: {line}" for line in browser.said]
        browser.print(out / "print.pdf")
        wrong += [f"loaded from elsewhere: {url}" for url in browser.asked]
    with chromium.Chromium(webgl=False) as browser:
        browser.open(report)
        here = browser.run(LOOK)
        wrong += [f"without WebGL: console: {line}" for line in browser.said]
        wrong += ["without WebGL the still picture is not there"] if here["live"] or not here["still"] else []
        browser.print(out / "still.pdf")
    count, still = pictures_in(out / "print.pdf"), pictures_in(out / "still.pdf")
    wrong += [f"{count} pictures on paper, and {still} without WebGL"] if count != still or not count else []
    (out / "still.pdf").unlink()
    return seen, wrong


def main():
    if not chromium.found():
        print("browser.py: skipped, chromium is not there (Debian: apt-get install chromium)")
        return 77  # as tests/verify/whole.py knows it
    seen, wrong = look(sys.argv[1], sys.argv[2] if len(sys.argv) > 2 else ".")
    for name, here in seen.items():
        print(f"{name}: {here['pictures']} pictures, {here['width']} x {here['height']} pixels")
        if scene := here.get("scene"):
            print(f"{name}: scene of {scene['size'][0]} x {scene['size'][1]} pixels, {scene['last'] + 1} frames; changed pixels: "
                  + ", ".join(f"{what} {100 * step['changed']:.2g} %" for what, step in scene["steps"].items()))
    print("\n".join(wrong) or "nothing is wrong")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
