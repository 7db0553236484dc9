"""For tests of hvi shield with LAMMPS: a case of a few words, its written input run once, its result; no front door."""

import pytest
import yaml
from hvi.shield import chain, record, script
from hvi.shield import case as cases


def wall(thickness, gap=None, radius=None, **more):
    """as a case has it, mm"""
    return {"thickness_mm": thickness, **{key: value for key, value in (("gap_mm", gap), ("radius_mm", radius)) if value is not None}, **more}


def mapping(*walls, D=5, v=7.1, ball="Al2024-T3", material="Al2024-T3", dx=0.8, angle=0, method="sph", not_modelled=(), **settings):
    """a case of one spacing and shift: diameter in mm, speed in km/s; walls of the material unless they say another"""
    return {"projectile": {"diameter_mm": D, "material": ball}, "speed_km_s": v, "angle_deg": angle, "walls": [{"material": material, **of} for of in walls],
            "spacings_mm": [dx], "shifts": [0], "method": method, **({"not_modelled": list(not_modelled)} if not_modelled else {}), "settings": {"film": -1, **settings}}


def read(path, *walls, **words):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(yaml.safe_dump(mapping(*walls, **words)))
    return cases.read(path)


def write_record(folder, n, us, columns):
    """walls.dat, pieces.dat and history.dat of a run with n walls; us: time of each row; columns: {(wall, name): value of all rows, or of each}, 0 without"""
    folder.mkdir(exist_ok=True)
    book = [0.0] * record.BOOK
    for k in (8, 9, 12, 19, 26, 27):  # energy and momentum balance, mass
        book[k - 1] = 1.0

    def value(k, name, row):
        of = columns.get((k, name), float(name == "mass"))
        return of[row] if isinstance(of, (list, tuple)) else of

    for name in ("walls.dat", "pieces.dat"):
        (folder / name).write_text("".join(f"{100 * row} {n}\n" + "".join(f"{k} " + " ".join(f"{value(k, name, row):g}" for name in record.WALL) + "\n" for k in range(1, n + 1)) for row in range(len(us))))
    (folder / "history.dat").write_text("".join(f"{100 * row} {time} {1e-6 * time} {' '.join(map(str, book))}\n" for row, time in enumerate(us)))


@pytest.fixture
def shield(lmp, tmp_path):
    """shield(*walls, nranks=1, folder="run", edit=function of the input's text, **words of mapping()) -> result.yaml"""
    def run(*walls, nranks=1, folder="run", edit=None, **words):
        where = tmp_path / folder
        chain.write_run(read(tmp_path / f"{folder}.yaml", *walls, **words), 0, 0, where)
        path = where / script.BEGIN
        if edit:
            path.write_text(edit(path.read_text()))
        r = lmp(path, nranks=nranks, cwd=where, env={"LAMMPS_POTENTIALS": ""})
        (where / "log.lammps").write_text(r.log)
        return chain.judge(where)

    return run
