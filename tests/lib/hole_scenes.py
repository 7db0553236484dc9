"""Plates with holes that are known, as data files, and the input that reads them."""

import numpy as np

HEAD = """
clear
units {units}
atom_style {style}
boundary {boundary}
comm_style {comm}
comm_modify cutoff {cut}
read_data {data}
{balance}
neighbor $(0.2*{cut}) bin
pair_style zero {cut}
pair_coeff * *
"""
THERMO = """
thermo_style custom step {}
thermo_modify format float %.17g
run 0
"""


def plate(kind, layers, width, rng, shape="round", shift=True):
    """particles of a plate of half this width around z = 0, one per unit of volume"""
    n = int(1.5 * width) + 2
    z = np.arange(layers) - (layers - 1) / 2
    if kind == "random":
        w = 1.45 * width
        x = rng.uniform(-1, 1, (rng.poisson(4 * w * w * layers), 3)) * [w, w, layers / 2]
    elif kind == "fcc":
        c = 4 ** (1 / 3)
        x = []
        for k in range(layers):
            for at in [(0, 0), (0.5, 0.5)] if k % 2 else [(0.5, 0), (0, 0.5)]:
                a, b = np.meshgrid(np.arange(-n, n + 1) + at[0], np.arange(-n, n + 1) + at[1])
                x.append(np.stack([a, b, np.full(a.shape, z[k] / 2)], -1).reshape(-1, 3) * c)
        x = np.concatenate(x)
    else:
        x = np.stack(np.meshgrid(np.arange(-n, n + 1), np.arange(-n, n + 1), z), -1).reshape(-1, 3)
    x[:, :2] += rng.uniform(-0.5, 0.5, 2) if shift else 0.5
    if kind == "turned":
        c, s = np.cos(t := rng.uniform(0, np.pi)), np.sin(t)
        x[:, :2] = x[:, :2] @ [[c, s], [-s, c]]
    inside = radius(x) < width if shape == "round" else np.abs(x[:, :2]).max(1) < width
    return x[inside]


def radius(x, center=(0, 0)):
    return np.hypot(x[:, 0] - center[0], x[:, 1] - center[1])


def write_data(path, x, types=None, masses=(1.0,), box=None, image=None, style="atomic"):
    n = len(x)
    types = np.ones(n, int) if types is None else types
    image = np.zeros((n, 3), int) if image is None else image
    box = [(p.min() - 1, p.max() + 1) for p in x.T] if box is None else box
    extra = {"atomic": "", "sphere": " 1 {}"}[style]
    lines = ["plate", "", f"{n} atoms", f"{len(masses)} atom types", ""]
    lines += [f"{lo:.17g} {hi:.17g} {a}lo {a}hi" for (lo, hi), a in zip(box, "xyz")]
    if style == "atomic":
        lines += ["", "Masses", ""] + [f"{k + 1} {m!r}" for k, m in enumerate(masses)]
    lines += ["", f"Atoms # {style}", ""]
    lines += [f"{i + 1} {t}{extra.format(masses[t - 1])} {p[0]:.17g} {p[1]:.17g} {p[2]:.17g} {m[0]} {m[1]} {m[2]}"
              for i, (t, p, m) in enumerate(zip(types, x, image))]
    path.write_text("\n".join(lines) + "\n")


def head(data, units="lj", style="atomic", boundary="f f f", comm="brick", cut=1.5):
    return HEAD.format(data=data, units=units, style=style, boundary=boundary, comm=comm, cut=cut,
                       balance="balance 1.0 rcb" if comm == "tiled" else "")
