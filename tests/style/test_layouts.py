"""One identical state gives the same forces, energies and virial on every layout, and they are those of the laws."""

import itertools

import numpy as np
import pytest
from dumps import read_dump, vectors
from scenes import BONDS, DUMP, cube, forces, books, ledger, read_bonds, scene

NEWTON = ("on on", "on off", "off on", "off off")
EPS, SIGMA = np.array([[1.0, 1.7], [1.7, 2.5]]), np.array([[1.0, 0.97], [0.97, 0.94]])
PAIRS = {
    "uniform": ("pair_style hvi/contact prefactor 4\npair_coeff * * 1.0 1.0\n", dict(F=4.0)),
    "types": ("pair_style hvi/contact\npair_coeff 1 1 1.0 1.0\npair_coeff 1 2 1.7 0.97\npair_coeff 2 2 2.5 0.94\n",
              dict(eps=EPS, sigma=SIGMA)),
}


@pytest.fixture(scope="module", params=["open", "periodic"])
def state(request):
    """random, a fifth of its bonds broken, moving"""
    return cube((7, 6, 5), jitter=0.15, cut=0.2, periodic=request.param == "periodic", types=2, seed=11)


@pytest.mark.each_value
@pytest.mark.parametrize("law", PAIRS)
@pytest.mark.parametrize("nranks", [1, 2, 3, 4])
def test_forces_energies_virial(lmp, tmp_path, state, law, nranks):
    """against the laws in NumPy: 1e-12 of the largest force; all newton settings, brick and tiled"""
    pair, terms = PAIRS[law]
    f, e_contact, e_spring, virial = forces(state, **terms)
    cases = list(itertools.product(NEWTON, ("brick", "tiled")))
    text = ""
    for k, (newton, comm) in enumerate(cases):
        text += "clear\n" + scene(state, tmp_path / "s.data", pair=pair, newton=newton, comm=comm)
        text += ledger() + "compute W all pressure NULL virial\nvariable V equal vol\n"
        text += "thermo_style custom step vol c_W[*] c_book[*]\nthermo_modify norm no format float %.16e\nfix nve all nve\n"
        text += "run 0\n" + DUMP.format(f"f.{k}") + BONDS.format(f"b.{k}")
    result = lmp(text, nranks=nranks)
    assert len(result.runs) == len(cases)
    bonds = {(min(i, j) + 1, max(i, j) + 1) for i, j in state.bonds.tolist()}
    for k, case in enumerate(cases):
        got = vectors(read_dump(tmp_path / f"f.{k}"), "f")
        assert np.abs(got - f).max() <= 1e-12 * np.abs(f).max(), case
        row = {name: column[0] for name, column in result.runs[k].items()}
        book = {name: column[0] for name, column in books(result.runs[k]).items()}
        assert book["contact"] == pytest.approx(e_contact, rel=1e-12), case
        assert book["spring"] == pytest.approx(e_spring, rel=1e-12), case
        w = np.array([row[f"c_W[{a}]"] for a in range(1, 7)]) * row["Volume"]
        assert np.abs(w - virial).max() <= 1e-11 * np.abs(virial).max(), case
        assert read_bonds(tmp_path / f"b.{k}") == bonds, case
