"""bench/runners/impact.py: a tiny run of each kind keeps the contract of the bench, and wrong settings are named."""

import math

import pytest
import yaml
from conftest import ROOT
from hvi.errors import HVIError
from runners import Cannot, impact

CASES = {path.stem: yaml.safe_load(path.read_text()) for path in (ROOT / "bench" / "cases").glob("*.yaml")}
CASES = {name: case for name, case in CASES.items() if case["runner"] == "impact"}


def run(lmp_exe, folder, name, settings, **changes):
    """the record of a run of a case, which is what the contract says"""
    case = {**CASES[name], **changes}
    r = impact.run(case, settings, folder, lmp_exe, timeout=120)
    assert set(r) - {"starts"} == {"particles", "steps", "loop_s", "errors", "numbers", "ledger", "failed"} and r.get("starts", 1) >= 1
    assert isinstance(r["particles"], int) and isinstance(r["steps"], int)
    for name in ("errors", "numbers", "ledger"):
        assert all(isinstance(k, str) and isinstance(v, (int, float)) and math.isfinite(v) for k, v in r[name].items()), r[name]
    if not r["failed"]:
        assert r["particles"] > 0 and r["steps"] > 0 and r["loop_s"] > 0 and case["error"]["main"] in r["errors"]
    assert not [path for path in folder.rglob("*") if path.is_file() and path.stat().st_size > 3e6], "something large is left"
    return r


@pytest.mark.parametrize("name", sorted(CASES))
def test_case_files(name):
    """what a case file says is there: methods, inputs and their variables, all settings of both forms"""
    case = CASES[name]
    assert {"title", "group", "about", "runner", "scene", "error", "resolution", "methods", "default", "short"} <= set(case)
    assert case["group"] in ("measured", "dem") and case["default"]["method"] in case["methods"]
    used = set()
    for entry in [*case["short"], *case.get("full", [])]:
        words = {k: v if isinstance(v, list) else [v] for k, v in entry.items()}
        for method in words["method"]:
            used.add(method)
            said = case["methods"][method]
            settings = {k: v[0] for k, v in words.items() if k not in impact.OURS}
            source = impact.source_of(impact.BENCH / said.get("scene", case["scene"]))
            if "cannot" not in said:
                for _, given, _ in impact.parts(case, method, impact.variables_of(case, said, settings), source):
                    source.check(given, name)
    assert used == set(case["methods"])


def test_plate(lmp_exe, tmp_path):
    """errors are those of the numbers, by hand; the ledger is closed; a part of the particles are elements in the hybrid"""
    sph = run(lmp_exe, tmp_path / "sph", "ceg3", {"method": "riemann", "dx": 1.25})
    assert not sph["failed"] and sph["ledger"]["energy"] < 1e-5 and sph["ledger"]["momentum"] < 1e-12
    measured = {"hole_mm": 18.90, "front_m_s": 5296, "length_mm": 81.1, "diameter_mm": 65.6}
    off = [abs(sph["numbers"][k] / v - 1) for k, v in measured.items()]
    assert sph["errors"]["mean error"] == pytest.approx(25 * sum(off)) and sph["errors"]["hole"] == pytest.approx(100 * off[0])
    hybrid = run(lmp_exe, tmp_path / "hybrid", "ceg3", {"method": "hybrid", "dx": 1})
    full = run(lmp_exe, tmp_path / "full", "ceg3", {"method": "riemann", "dx": 1})
    assert not hybrid["failed"] and hybrid["particles"] < 0.8 * full["particles"]
    assert hybrid["numbers"]["front_m_s"] == pytest.approx(full["numbers"]["front_m_s"], rel=0.01)


@pytest.mark.long
def test_shield(lmp_exe, tmp_path):
    """a case of hvi shield: errors of both holes, by hand; the ledger is closed; walls of elements, or why there are none"""
    r = run(lmp_exe, tmp_path / "sph", "emi", {"method": "riemann", "dx": 0.8, "tstop": 30, "shift": 0.25})
    assert not r["failed"] and r["ledger"]["energy"] < 1e-3 and r["ledger"]["momentum"] < 1e-12
    off = [100 * abs(r["numbers"][name] / value - 1) for name, value in (("hole1_mm", 9.3), ("hole2_mm", 58))]
    assert r["errors"]["mean error"] == pytest.approx(sum(off) / 2) and r["errors"]["hole1"] == pytest.approx(off[0])
    with pytest.raises(Cannot, match="1 layers of particles"):
        run(lmp_exe, tmp_path / "thin", "emi", {"method": "hybrid", "dx": 0.8})
    with pytest.raises(HVIError, match="emi.yaml has no setting 'spacing'"):
        run(lmp_exe, tmp_path / "wrong", "emi", {"method": "riemann", "spacing": 0.8})
    with pytest.raises(HVIError, match="settings: tstop: 5 us are over before"):
        run(lmp_exe, tmp_path / "short", "emi", {"method": "riemann", "dx": 0.8, "tstop": 5})


@pytest.mark.long
def test_shots(lmp_exe, tmp_path):
    """verdicts of published shots at twice the spacings of their study: two layers in the rear wall do not decide"""
    r = run(lmp_exe, tmp_path / "run", "shots", {"method": "riemann", "finer": 0.5}, shots=["18", "4-2010"])
    assert r["numbers"] == {"18 right": 0, "4-2010 right": 0} and r["errors"] == {"wrong verdicts": 100.0} and r["starts"] == 2 and not r["failed"]


def test_stock(lmp_exe, tmp_path):
    """a stock scene gives the same numbers or says why not; one that stops is a failure with what LAMMPS said"""
    r = run(lmp_exe, tmp_path / "ulsph", "ceg3", {"method": "stock smd/ulsph, plain gradients", "dx": 2, "Rplate": 20})
    assert set(r["numbers"]) == {"hole_mm", "front_m_s", "length_mm", "diameter_mm"} or r["failed"]
    r = run(lmp_exe, tmp_path / "bad", "ceg3", {"method": "stock smd/ulsph", "dx": 2, "style": "none"})
    assert r["failed"] and not r["errors"]


def test_debris(lmp_exe, tmp_path):
    r = run(lmp_exe, tmp_path / "sc", "debris", {"method": "sc", "layers": 3, "tstop": 2})
    assert 0 < r["numbers"]["F"] <= 1 and r["ledger"]["energy"] < 1e-3
    r = run(lmp_exe, tmp_path / "bpm", "debris", {"method": "stock bpm/spring", "layers": 3, "tstop": 2})
    assert 0 < r["numbers"]["F"] <= 1 and not r["ledger"]
    coarse, fine = (run(lmp_exe, tmp_path / str(c), "debris-step", {"method": "sc", "C": c, "N": 3000, "tstop": 2})["errors"] for c in (0.2, 0.05))
    assert fine["largest drift"] < 0.3 * coarse["largest drift"]


def test_parts(lmp_exe, tmp_path):
    """several runs are one point: spall of two shots, and where a number falls through a value between speeds"""
    table = {**CASES["plates"]["table"], "names": ["6061-80 2323", "Cu on Cu"]}
    r = run(lmp_exe, tmp_path / "plates", "plates", {"method": "riemann", "n": 16}, table=table)
    off = [abs(r["numbers"][f"{name} strength_GPa"] / value - 1) for name, value in (("6061-80 2323", 1.23), ("Cu on Cu", 1.328))]
    assert r["errors"]["mean error"] == pytest.approx(50 * sum(off))
    case = {"crossing": {"of": "m", "at": 0.5, "over": "v0", "scale": 0.001, "as": "half_km_s", "reference": 2.0}, "measures": {"m": "mass"}}
    for masses, half in (((0.9, 0.7, 0.3), 2.75), ((0.9, 0.8, 0.7), None)):
        record = {"particles": 1, "steps": 1, "loop_s": 1.0, "errors": {}, "numbers": {}, "ledger": {}, "failed": ""}
        impact.answers(case, {}, [("", {"v0": v}, {}, {"mass": m}) for v, m in zip((2000, 2500, 3000), masses)], record)
        assert bool(record["failed"]) == (half is None)
        if half:
            assert record["numbers"]["half_km_s"] == pytest.approx(half) and record["errors"]["mean error"] == pytest.approx(37.5)


def test_wrong(lmp_exe, tmp_path):
    with pytest.raises(HVIError, match="no method 'sand'"):
        run(lmp_exe, tmp_path / "1", "ceg3", {"method": "sand", "dx": 2})
    with pytest.raises(HVIError, match="in.plate has no variable 'spacing'"):
        run(lmp_exe, tmp_path / "2", "ceg3", {"method": "riemann", "spacing": 2})
    with pytest.raises(HVIError, match="layers must be a number above 0"):
        run(lmp_exe, tmp_path / "3", "holes", {"method": "riemann"})
    with pytest.raises(Cannot, match="no whole elements"):
        run(lmp_exe, tmp_path / "4", "ceg3", {"method": "hybrid", "dx": 0.4})
    with pytest.raises(Cannot, match="in no book"):
        run(lmp_exe, tmp_path / "5", "debris-step", {"method": "stock bpm/spring", "C": 0.1})
    r = run(lmp_exe, tmp_path / "6", "ceg3", {"method": "riemann", "dx": 0})
    assert "dx must be a number above 0" in r["failed"]
