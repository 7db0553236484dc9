"""Whether a change of the sources has left every bit where it was: short runs of the examples' scenes with hashes of the state that they end in.

    cmake/env.sh /usr/bin/python3 tests/verify/net.py --lmp OLD/lmp --hashes FILE      writes FILE, where there is none
    cmake/env.sh /usr/bin/python3 tests/verify/net.py --lmp NEW/lmp --hashes FILE      compares; [--only WORD ...] for some scenes

Both with make CMAKE_ARGS=-DCMAKE_CXX_FLAGS=-ffp-contract=off: where products and sums are fused is up to the compiler, and changes with the code around
them. The state is x, v, rho, e and stress of every particle, with all digits. Scenes called rare use options that are held to 1e-12
per force evaluation instead (test_sph_forces, test_reference_loop): their hashes are shown, not judged."""

import argparse
import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import yaml

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "examples"
SPH = """compute net all hvi/atom p sxx syy szz sxy sxz syz
compute net_rho all sph/rho/atom
compute net_e all sph/e/atom
run {}
write_dump all custom net.dump id type x y z vx vy vz c_net_rho c_net_e c_net[*] modify sort id format float %.17g
"""
DEM = """fix net_move all nve
fix net_step all hvi/dt 0.05
compute net all hvi/atom nbonds
run {}
write_dump all custom net.dump id type x y z vx vy vz c_net modify sort id format float %.17g
"""
MONAGHAN, AUTO, RIEMANN = "viscosity 1 2", "viscosity 1 2 interface auto", "dissipation riemann"


class Scene:
    def __init__(self, text, variables=(), ranks=1, newton=True, folder=None, then=None, files=()):
        self.text, self.variables, self.ranks, self.newton, self.folder, self.then, self.files = text, list(variables), ranks, newton, folder, then, files


def cut(text, steps, dump=SPH):
    """An input up to its first run, which has so many steps"""
    head = re.split(r"^(?:run|include +legs.debris).*$", text, maxsplit=1, flags=re.M)[0]
    return head + dump.format(steps)


def example(name, steps, *edits, variables=(), **keys):
    text = (EXAMPLES / name).read_text()
    for old, new in edits:
        assert old in text, (name, old)
        text = text.replace(old, new)
    return Scene(cut(text, steps), variables, folder=(EXAMPLES / name).parent, **keys)


def variables(**given):
    return [word for name, value in given.items() for word in ("-var", name, str(value))]


def shield(steps, restart=False, case="quick", spacing=None, **keys):
    """A case as hvi shield writes it"""
    nodes = yaml.safe_load((EXAMPLES / "whipple-shield" / "cases" / f"{case}.yaml").read_text())
    ranks, newton = keys.pop("ranks", 1), keys.pop("newton", True)
    settings = keys.pop("settings", {})
    nodes.update(keys)
    nodes.setdefault("settings", {}).update(settings)
    folder = pathlib.Path(tempfile.mkdtemp())
    (folder / "case.yaml").write_text(yaml.safe_dump(nodes, sort_keys=False))
    words = [sys.executable, "-m", "hvi", "shield", "case.yaml", "--write", "written"]
    done = subprocess.run(words, cwd=folder, env=dict(os.environ, PYTHONPATH=str(ROOT / "python")), capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    written = sorted(p.parent for p in (folder / "written").rglob("in.shield"))
    wanted = [p for p in written if spacing is None or f"{spacing:g}" in p.name] or written
    run = wanted[0]
    text, then = (run / "in.shield").read_text(), (run / "in.continue").read_text()
    files = [p for p in run.iterdir() if not p.name.startswith("in.")]
    if not restart:
        return Scene(cut(text, steps), ranks=ranks, newton=newton, files=files)
    first = re.split(r"^run .*$", text, maxsplit=1, flags=re.M)[0] + f"run {steps // 2}\nwrite_restart net.restart\n"
    return Scene(first, ranks=ranks, newton=newton, files=files, then=(cut(then, steps - steps // 2), ["-var", "from", "net.restart"]))


def scenes():
    plate = "single-plate/in.plate"
    halved = [("pair_style   hvi/sph", "region net block INF 0 INF INF INF INF\ndelete_atoms region net\npair_style   hvi/sph"), ("${pair} h variable", "mirror x 0 lo ${pair} h variable")]
    words = lambda pair: ("-var", "pair", pair)
    yield "layers", example("layered-shock/in.layers", 1000, variables=variables(n=200))
    yield "layers-none", example("layered-shock/in.layers", 600, variables=variables(n=200, pair="viscosity 1 2 interface 0"))
    yield "layers-auto-gap", example("layered-shock/in.layers", 600, variables=variables(n=200, gap=0.1, pair=AUTO))
    yield "layers-riemann", example("layered-shock/in.layers", 600, variables=variables(n=200, pair=RIEMANN))
    yield "layers-cubic-constant", example("layered-shock/in.layers", 600, variables=variables(n=200, kernel="cubic", hvar="constant"))
    yield "rare-layers-symmetric", example("layered-shock/in.layers", 300, ("form sum", "form symmetric"), variables=variables(n=200))
    yield "rare-layers-quintic", example("layered-shock/in.layers", 300, variables=variables(n=200, kernel="quintic"))
    for pair, name in ((MONAGHAN, "monaghan"), (AUTO, "auto"), (RIEMANN, "riemann")):
        yield f"sod-{name}", example("standard-shocks/in.sod", 400, variables=[*variables(n=400), *words(pair)])
        yield f"flyer-{name}", example("standard-shocks/in.flyer", 300, variables=[*variables(n=100), *words(pair)])
        yield f"noh2-{name}", example("standard-shocks/in.noh", 60, variables=[*variables(dim=2, n=20), *words(pair)])
        for mode, keys in (("", {}), ("-np2", {"ranks": 2}), ("-newton-off", {"newton": False, "ranks": 2})):
            yield f"noh3-{name}{mode}", example("standard-shocks/in.noh", 40, variables=[*variables(dim=3, n=10), *words(pair)], **keys)
        yield f"noh3-{name}-mirror", example("standard-shocks/in.noh", 40, *halved, variables=[*variables(dim=3, n=10), *words(pair)], ranks=2)
    yield "sod-unequal", example("standard-shocks/in.sod", 400, variables=variables(n=200, masses="unequal"))
    for style in ("hvi", "hvi-dt", "parity"):
        yield ("" if style == "hvi-dt" else "rare-") + f"shock-{style}", example("stock-comparison/in.shock", 100, variables=variables(style=style, pair="cubic h constant interface 0.3", h=2)
                                                                              if style != "parity" else variables(style=style))
    yield "rare-collapse", example("stock-comparison/in.collapse", 200)

    yield "plate", example(plate, 400, variables=variables(dx=1))
    yield "plate-fine", example(plate, 120, variables=variables(dx=0.5))
    yield "plate-np2", example(plate, 300, variables=variables(dx=1), ranks=2)
    yield "plate-newton-off", example(plate, 300, variables=variables(dx=1), ranks=2, newton=False)
    yield "plate-viscosity", example(plate, 300, variables=variables(dx=1, pair="viscosity 1 2"))
    yield "rare-plate-interface", example(plate, 200, variables=variables(dx=1, pair="viscosity 1 2 interface auto"))
    yield "plate-variable-h", example(plate, 200, variables=variables(dx=1, pair="dissipation riemann h variable"))
    yield "plate-gauss", example(plate, 100, variables=variables(dx=1, kernel="gauss"))
    yield "plate-principal", example(plate, 300, variables=variables(dx=1, damage="yes", spall="principal"))
    yield "plate-displacement-lists", example(plate, 150, variables=variables(dx=1, move="lists displacement sleep no"))
    yield "rare-plate-artstress", example(plate, 200, variables=variables(dx=1, pair="dissipation riemann artstress 0.3 4"))
    yield "shield", shield(400, spacing=0.5)
    yield "shield-np2", shield(400, spacing=0.5, ranks=2)
    yield "shield-restart", shield(400, restart=True, spacing=0.5)
    yield "shield-restart-np2", shield(400, restart=True, spacing=0.5, ranks=2)
    yield "emi", shield(150, case="emi", spacing=0.4)
    yield "hybrid", shield(300, spacing=0.5, method="hybrid")
    yield "hybrid-np2", shield(300, spacing=0.5, method="hybrid", ranks=2)
    yield "hybrid-newton-off", shield(200, spacing=0.5, method="hybrid", ranks=2, newton=False)
    yield "hybrid-restart", shield(300, restart=True, spacing=0.5, method="hybrid")
    debris = (EXAMPLES / "debris-cloud" / "in.debris").read_text()
    for ranks in (1, 2):
        flight = cut(debris, 1500, DEM)
        yield f"debris-np{ranks}", Scene(flight, variables(N=4000), ranks=ranks, folder=EXAMPLES / "debris-cloud")


def run(lmp, scene):
    """The hash of the state it ends in"""
    folder = pathlib.Path(tempfile.mkdtemp())
    for source in list(scene.folder.iterdir()) if scene.folder else scene.files:
        if source.is_file() and source.suffix != ".png":
            shutil.copy(source, folder)
    try:
        for text, more in ((scene.text, scene.variables), *([scene.then] if scene.then else [])):
            (folder / "in.net").write_text(("" if scene.newton else "newton off\n") + (text if scene.newton else re.sub(r"^newton .*$", "", text, flags=re.M)))
            words = [str(lmp), "-in", "in.net", "-log", "none", *more]
            words = ["mpirun", "--oversubscribe", "--bind-to", "none", "-np", str(scene.ranks)] + words if scene.ranks > 1 else words
            done = subprocess.run(words, cwd=folder, capture_output=True, text=True, env=dict(os.environ, LAMMPS_POTENTIALS=str(ROOT / "potentials"), OMP_NUM_THREADS="1"))
            if done.returncode:
                return "failed: " + " ".join(line for line in (done.stdout + done.stderr).splitlines() if "ERROR" in line)[:300]
        rows = (folder / "net.dump").read_text().replace("-0 ", "0 ").split("ITEM: ATOMS", 1)[1]
        if "nan" in rows:
            return "not a number"
        return hashlib.sha256(rows.encode()).hexdigest()[:16]
    finally:
        shutil.rmtree(folder)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--lmp", required=True, type=pathlib.Path)
    parser.add_argument("--hashes", required=True, type=pathlib.Path)
    parser.add_argument("--only", nargs="*", default=[], help="scenes whose names have one of these words")
    parser.add_argument("--jobs", type=int, default=2)
    args = parser.parse_args()
    wanted = [(name, scene) for name, scene in scenes() if not args.only or any(word in name for word in args.only)]
    with concurrent.futures.ThreadPoolExecutor(args.jobs) as pool:
        found = dict(zip([name for name, _ in wanted], pool.map(lambda pair: run(args.lmp.resolve(), pair[1]), wanted)))
    if not args.hashes.exists():
        args.hashes.write_text(json.dumps(found, indent=1))
        print(*(f"{name:28} {value}" for name, value in found.items()), sep="\n")
        return any(value.startswith(("failed", "not a")) for value in found.values())
    kept = json.loads(args.hashes.read_text())
    judged = {name: "new" if name not in kept else "same" if kept[name] == value else "other (rare)" if name.startswith("rare") and not value.startswith("failed") else "OTHER"
              for name, value in found.items()}
    print(*(f"{name:28} {judged[name]:14} {found[name]}" for name in found), sep="\n")
    return "OTHER" in judged.values()


if __name__ == "__main__":
    sys.exit(main())
