"""The references of tests/force-styles, which LAMMPS's own generator wrote, against forces, energies and stress in NumPy, from the data files."""

import numpy as np
import pytest
import yaml
from scenes import R_EQ
from sph_scenes import Fluid, rates, riemann_rates, tait


@pytest.fixture
def folder(root):
    return root / "tests" / "force-styles"


def sections(path):
    """{title: rows of numbers}"""
    found, title = {}, None
    for line in path.read_text().splitlines()[1:]:
        words = line.split("#")[0].split()
        if words and words[0][0].isalpha():
            title = words[0]
        elif words and title:
            found.setdefault(title, []).append([float(w) for w in words])
    return {k: np.array(v) for k, v in found.items()}


def reference(path):
    case = yaml.safe_load(path.read_text())
    rows = {key: np.array([[float(w) for w in line.split()] for line in case[key].splitlines()]) for key in ("init_forces", "init_stress")}
    return case, rows["init_forces"][:, 1:], rows["init_stress"][0]


def of_pairs(x, i, j, scaled, energy):
    """forces by their part along i - j, over r; energy; LAMMPS's order of the virial"""
    d = x[i] - x[j]
    f = np.zeros_like(x)
    np.add.at(f, i, scaled[:, None] * d)
    np.add.at(f, j, -scaled[:, None] * d)
    w = np.einsum("k,ka,kb->ab", scaled, d, d)
    return f, energy.sum(), w[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]


def same(path, key, want):
    case, f, stress = reference(path)
    assert np.abs(f - want[0]).max() < 1e-11 * np.abs(want[0]).max(), path.name
    assert np.abs(stress - want[2]).max() < 1e-11 * np.abs(want[2]).max(), path.name
    assert case[key] == pytest.approx(want[1], rel=1e-12), path.name
    return case


@pytest.mark.parametrize("name, law, factor", [("hvi_contact", {(1, 1): (1.0, 1.0), (1, 2): (0.8, 1.05), (2, 2): (0.5, 1.1)}, 1.0),
                                               ("hvi_contact_prefactor", {(1, 1): (1e-5, 2.0), (1, 2): (1e-5, 2.0), (2, 2): (1e-5, 2.0)}, 4.0)])
def test_contact(folder, name, law, factor):
    data = sections(folder / "data.dem")
    x, kind = data["Atoms"][:, 3:], data["Atoms"][:, 2].astype(int)
    i, j = np.triu_indices(len(x), 1)
    eps, sigma = np.array([law[tuple(sorted((kind[a], kind[b])))] for a, b in zip(i, j)]).T
    r = np.linalg.norm(x[i] - x[j], axis=1)
    near = r < R_EQ * sigma
    i, j, eps, sigma, r = i[near], j[near], eps[near], sigma[near], r[near]
    q = (sigma / r) ** 6
    assert len(r) > 10
    same(folder / f"pair-{name}.yaml", "init_vdwl", of_pairs(x, i, j, factor * eps * (12 * q**2 - 6 * q) / r**2, factor * eps * (q - 0.5) ** 2))


@pytest.mark.parametrize("name, cut", [("hvi_spring", {1: 5.0, 2: 5.0}), ("hvi_spring_breaks", {1: 1.2, 2: 1.25})])
def test_spring(folder, name, cut):
    data = sections(folder / "data.dem")
    x, bonds = data["Atoms"][:, 3:], data["Bonds"].astype(int)
    kind, i, j = bonds[:, 1], bonds[:, 2] - 1, bonds[:, 3] - 1
    k, rest = np.array([{1: (100.0, R_EQ), 2: (50.0, 1.0)}[t] for t in kind]).T
    r = np.linalg.norm(x[i] - x[j], axis=1)
    holds = r <= [cut[t] for t in kind]
    assert holds.all() == (name == "hvi_spring")
    pull = np.maximum(r - rest, 0.0) * holds
    same(folder / f"bond-{name}.yaml", "init_energy", of_pairs(x, i, j, -k * pull / r, 0.5 * k * pull**2))


@pytest.mark.parametrize("name, kernel, law", [("hvi_sph", "cubic", rates), ("hvi_sph_riemann", "wendland2", riemann_rates)])
def test_sph(folder, name, kernel, law):
    data = sections(folder / "data.sph")
    a = data["Atoms"]
    # forces are by estimated velocities, which only fix hvi/sph sets: the tester moves particles by fix nve
    s = Fluid(a[:, 5:], np.zeros((len(a), 3)), a[:, 2], a[:, 3], a[:, 1].astype(int), {1: 1e-6, 2: 2e-6}, {1: 1.2e-3, 2: 1.2e-3}, np.full(3, 7e-3))
    more = {} if law is rates else {"rho0": {1: 1000.0, 2: 2000.0}}  # types do not pull each other
    got = law(s, {1: tait(1000.0, 1480.0), 2: tait(2000.0, 1480.0)}, kernel, tension=False, **more)
    same(folder / f"pair-{name}.yaml", "init_vdwl", (got["f"], 0.0, got["virial"][[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]))
