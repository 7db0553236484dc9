"""Runs LAMMPS inputs and says what must not be: a signal, a report of a sanitizer, a hang, an end without a message.

    python3 tests/fuzz/inputs.py LMP FILE    one input; ranks as its first line says
"""

import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import time

import grammar
from seeds import ROOT

SECONDS = 60
BAD = re.compile(r"(?:Address|Leak|UndefinedBehavior)Sanitizer|runtime error:|Segmentation fault|Caught signal|Signal: [A-Z]|Signal code|terminate called|exited on signal|"
                 r"double free|corrupted|stack smashing|Assertion.*failed|\[\d+\] .*\(\+0x[0-9a-f]+\)")
ERROR = re.compile(r"^ERROR[^:\n]*: *\S", re.M)


def ranks_of(text):
    found = re.match(r"# .*\branks (\d)", text)
    return int(found[1]) if found else 1


def check(lmp, path, seconds=SECONDS):
    """(what is wrong, '' if nothing; '' if it ran, else LAMMPS's message)"""
    path = pathlib.Path(path)
    ranks = ranks_of(path.read_text())
    command = [str(ROOT / "cmake" / "env.sh"), *(["mpirun", "-np", str(ranks)] if ranks > 1 else []), str(lmp), "-in", path.name, "-log", "none"]
    environment = {"LAMMPS_POTENTIALS": str(ROOT / "potentials"), **os.environ}
    process = subprocess.Popen(command, cwd=path.parent, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                               text=True, errors="replace", start_new_session=True)
    try:
        out, _ = process.communicate(timeout=seconds)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGTERM)
        try:
            out, _ = process.communicate(timeout=10)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            out, _ = process.communicate()
        return f"no end after {seconds} s\n{out[-3000:]}", ""
    if found := BAD.search(out):
        return f"{found[0]}\n{out[max(0, found.start() - 300):found.start() + 5000]}", ""
    if process.returncode == 0:
        return "", ""
    if not ERROR.search(out):
        return f"status {process.returncode} without a message\n{out[-3000:]}", ""
    return "", re.search(r"^ERROR.*", out, re.M)[0]


def where(wrong):
    """the place of ours in a report, to tell findings apart"""
    frames = re.findall(r"((?:hvi_|pair_hvi|fix_hvi|compute_hvi|bond_hvi)\w+\.(?:cpp|h):\d+)", wrong)
    return f"{wrong.splitlines()[0][:80]} {' '.join(frames[:2])}"


def run(lmp, folder, seed, seconds=None, count=None):
    """Writes and runs inputs until time or count is over; returns (executions, those that ran to the end, {where: seed}, {message: number})"""
    folder = pathlib.Path(folder)
    found, messages, n, ran = {}, {}, 0, 0
    end = time.monotonic() + (seconds or 1e9)
    while n != count and time.monotonic() < end:
        one = f"{seed}-{n}"
        here = folder / "now"
        shutil.rmtree(here, ignore_errors=True)
        path, _ = grammar.write(one, here)
        wrong, message = check(lmp, path)
        if wrong.startswith("no end"):  # on a busy machine ranks that wait for each other are slow: it must not end in ten times that, either
            wrong, message = check(lmp, path, 10 * SECONDS)
        n += 1
        ran += not wrong and not message
        if message:
            key = re.sub(r"\(\S+:\d+\)|[-+]?\d[\d.eE+-]*", "#", message)[:70]
            messages[key] = messages.get(key, 0) + 1
        if wrong and (key := where(wrong)) not in found:
            found[key] = one
            shutil.copytree(here, folder / one, dirs_exist_ok=True)
            (folder / one / "wrong.txt").write_text(wrong)
    return n, ran, found, messages


if __name__ == "__main__":
    print(check(sys.argv[1], sys.argv[2])[0] or "nothing is wrong")
