"""examples/whipple-shield, coarse and short: holes, closed ledgers, and a verdict that another program finds too."""

import hvi
import numpy as np
import pytest
import yaml

KEYS = """hole1_diameter_mm hole2_diameter_mm perforated front_velocity_m_s cloud_length_mm cloud_diameter_mm length_ratio
    axial_velocity_ratio particles steps time_us wall_s ranks particle_steps_per_s energy_ratio energy_missed_ratio momentum_error mass_error
    lammps_version package_version""".split()
PER_WALL = """reached perforated detached_spall spall_mass_mg fragments largest_fragment_mm largest_fragment_mass_fraction
    largest_fragment_velocity_m_s momentum_N_s momentum_ratio energy_J energy_ratio passed_mass_mg cloud_velocity_ratio
    cloud_front_velocity_ratio cloud_momentum_ratio cloud_energy_ratio pieces_apart largest_apart_mass_fraction""".split()
SMALL = dict(quarter="no", kernel="cubic", eta=1.2, dx=0.6, spacing=12, radius1=7, radius2=9, behind=20, tstop=8)


@pytest.fixture
def shield(lmp, root, tmp_path):
    def run(nranks=1, folder="run", fails=False, **variables):
        folder = tmp_path / folder
        r = lmp(root / "examples" / "whipple-shield" / "in.whipple", nranks=nranks, cwd=folder, expect_fail=fails,
                env={"LAMMPS_POTENTIALS": str(root / "potentials")}, vars={"out": folder, **variables})
        return r if fails else yaml.safe_load((folder / "result.yaml").read_text())

    return run


@pytest.mark.parametrize("nranks", [1, 2])
def test_two_walls(shield, nranks):
    """4,000 particles, 2 layers in a wall: wider holes than fine ones, but all of it is there, and the books are closed"""
    r = shield(nranks, **SMALL)
    assert [key for key in KEYS if key not in r] == []
    assert [f"wall{k}_{key}" for k in (1, 2) for key in PER_WALL if f"wall{k}_{key}" not in r] == []
    assert r["perforated"] and r["wall1_perforated"] and r["walls_reached"] == 2
    assert 7 < r["hole1_min_mm"] <= r["hole1_diameter_mm"] <= r["hole1_max_mm"] < 14
    assert abs(r["energy_ratio"] - 1) < 1e-3  # also after wall 2 was made
    assert r["momentum_error"] < 1e-10 and abs(r["mass_error"]) < 1e-10
    assert 0.5 < r["wall1_cloud_velocity_ratio"] < 1 and 0.7 < r["wall1_cloud_energy_ratio"] < 1
    # 12 mm behind wall 1 the momentum that is not in the cloud is that of the wall's front and of what was thrown back
    assert r["wall2_cloud_momentum_ratio"] > 0.2 and r["wall2_momentum_ratio"] > r["wall1_momentum_ratio"]


def verdict(frame, layer, front, rear, near):
    """as in Howto_shield, from a dump: masses of what passed, of spall, of the largest sound piece and of the largest
    that is apart; what passed; types layer is the wall"""
    kind, v = frame["type"], frame.v[:, 2]
    failed = hvi.fragments.has_failed(frame)

    def pieces(where, sound):
        f = frame.select(where)
        alone = failed[where] & sound
        label = np.arange(len(f))
        some = np.flatnonzero(~alone)
        found = hvi.find(f.select(~alone), distance=near)
        place = np.searchsorted(f.ids[some], found.label)
        label[some] = some[place]
        return label

    def wall_piece(sound):
        """what hangs together with the largest sound piece of the wall"""
        mine = np.flatnonzero(kind == layer)
        alone = pieces(kind == layer, True)
        member = mine[np.argmax(alone == np.argmax(np.bincount(alone, frame.m[mine])))]
        everything = pieces(np.ones(len(kind), dtype=bool), sound)
        return everything == everything[member]

    passed = (frame.x[:, 2] > rear) & (v > 0) & ~wall_piece(True)
    spall = passed & ~wall_piece(False) & (kind == layer)
    largest, most = (np.bincount(pieces(passed, sound), frame.m[passed]).max() if passed.any() else 0.0 for sound in (True, False))
    return frame.m[passed].sum(), frame.m[spall].sum(), largest, most, passed


def test_verdict_is_that_of_another_program(shield, tmp_path):
    r = shield(material_t="Al6061-T6.hvi", v0=1500, **SMALL)
    dump = hvi.Dump(str(tmp_path / "run" / "cloud1.dump"))
    frame = dump[0]
    passed, spall, largest, most, who = verdict(frame, 2, 0.0, 0.8e-3, 1.5 * 0.6e-3)
    ball = 2785 * 4 / 3 * np.pi * 2.5e-3**3
    assert r["wall1_passed_mass_mg"] == pytest.approx(1e6 * passed, rel=1e-4)
    assert r["wall1_spall_mass_mg"] == pytest.approx(1e6 * spall, rel=1e-4)
    assert r["wall1_largest_fragment_mass_fraction"] == pytest.approx(largest / ball, abs=1e-6)
    assert r["wall1_largest_apart_mass_fraction"] == pytest.approx(most / ball, abs=1e-6)
    assert most > largest > 1.5 * frame.m.max()  # not all single particles
    _, summary = hvi.fragments.both(frame.select(who), distance=1.5 * 0.6e-3, failed=list(hvi.fragments.FAILED))
    assert (r["wall1_fragments"], r["wall1_pieces_apart"]) == (summary["fragments"], summary["pieces_apart"])
    debris = hvi.debris.estimate(frame, hvi.fragments.has_failed(frame), {1: 2785.0, 2: 2703.0}).summary  # the dump has what it takes
    assert sum(debris[f"{kind}_mass"] for kind in hvi.debris.KINDS) == pytest.approx(frame.m.sum(), rel=1e-14) and debris["subparticle_mass"] > 0
    wall = frame["type"] == 2
    assert r["wall1_momentum_N_s"] == pytest.approx(frame.m[wall] @ frame.v[wall, 2], rel=1e-4)
    assert frame.m[frame["type"] == 1].sum() == pytest.approx(ball, rel=1e-5)  # of what is in the material file


@pytest.mark.parametrize("thickness, perforated, spall", [(1.6, True, True), (4, True, None), (8, False, False)])
def test_verdict_flips_with_the_thickness(shield, thickness, perforated, spall):
    """5 mm at 1.5 km/s: 4 mm are pierced, 6 mm only spall, late, 8 mm hold"""
    r = shield(quarter="no", dx=0.8, walls=1, v0=1500, t1=thickness, radius1=8, behind=15, back=10, tstop=10)
    assert r["perforated"] is perforated and (r["hole1_diameter_mm"] > 0) is perforated
    assert (r["wall1_spall_mass_mg"] > 0) is r["wall1_detached_spall"] and spall in (None, r["wall1_detached_spall"])
    assert (r["wall1_largest_fragment_mm"] > 0) is perforated
    assert abs(r["energy_ratio"] - 1) < 1e-3


def test_lists_of_walls(shield, root, tmp_path):
    """three walls, one of them from a data file, of two materials; probes and an absorbing rim"""
    from hvi import plates

    plates.write(tmp_path / "turned.data", plates.make(7e-3, 1.2e-3, 0.6e-3, 4, [0, 45]), 2703.0)
    r = shield(quarter="no", dx=0.6, walls=3, thickness=[0.6, 1.2, 0.6], gap=[0, 4, 4], radius=[6, 7, 7], layers=[1, 4, 1],
               plate=["plain", tmp_path / "turned.data", "plain"], material=["Al2024-T3.hvi", "Al6061-T6.hvi", "Al2024-T3.hvi"],
               tstop=2.5, edge="absorb", rim=1.2, probes="yes", probe_at=[3, 5], behind=10)
    assert r["walls_reached"] == 3
    assert abs(r["energy_ratio"] - 1) < 1e-3 and r["momentum_error"] < 1e-10 and abs(r["mass_error"]) < 1e-10
    table = np.loadtxt(tmp_path / "run" / "probe2_3.dat")
    assert table.shape[1] == 4 and table[-1, 1] > table[0, 1] and table[:, 2].max() > 1e6


@pytest.mark.parametrize("variables, message", [
    (dict(walls=3, thickness=[1, 1]), "fewer values of thickness than walls, 3"),
    (dict(walls=2, material=["Al2024-T3.hvi"] * 3), "more values of material than walls, 2"),
    (dict(walls=2, gap=[0, 5, 5]), "more values of gap than walls, 2"),
    (dict(walls=0), "walls must be a whole number"), (dict(walls=1.5), "walls must be a whole number"),
    (dict(quarter="half"), "quarter must be auto, yes or no, not half"), (dict(quarter="yes", angle=30), "quarter=yes needs angle=0"),
    (dict(edge="soft"), "edge must be free, clamp or absorb, not soft"), (dict(probes="maybe"), "probes must be yes or no"),
    (dict(t1=-1), "wall 1: thickness and radius must be above 0"), (dict(plate=["missing.data", "plain"]), "neither plain nor a file"),
    (dict(zones=0), "zones must be a whole number"), (dict(material_t="Unobtainium.hvi"), "Unobtainium.hvi")], ids=str)
def test_wrong_input(shield, variables, message):
    r = shield(fails=True, **{"quarter": "no", "dx": 0.8, **variables})
    assert message in r.log + r.stdout


def test_quarter_is_the_whole(shield):
    """until the cloud of wall 1 has passed, a quarter between mirrors is what the whole is, to what is printed"""
    quarter, whole = [shield(folder=q, **{**SMALL, "quarter": q}) for q in ("yes", "no")]
    assert 4 * quarter["particles"] == whole["particles"]
    # if the largest fragments are single particles, which is the largest is anybody's guess
    single = quarter["wall1_largest_fragment_mm"] < 1.01 * (6 / np.pi) ** (1 / 3) * SMALL["dx"]
    for key in PER_WALL:
        if key not in ("reached", "perforated", "detached_spall", "fragments", "pieces_apart", *["largest_fragment_velocity_m_s"] * single):
            assert quarter[f"wall1_{key}"] == pytest.approx(whole[f"wall1_{key}"], rel=1e-3), key
    assert quarter["hole1_diameter_mm"] == pytest.approx(whole["hole1_diameter_mm"], rel=0.03)
    assert abs(quarter["energy_ratio"] - 1) < 1e-3 and quarter["momentum_error"] < 1e-10
