# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Writes tabulated equations of state for ``pair_coeff I I eos table FILE`` from a formula or from arrays."""

import numpy as np

from ..errors import HVIError, writing

UNITS = ("si", "cgs", "micro", "lj")


def _grid(name, values):
    values = np.asarray(values, dtype=float)
    if values.ndim != 1 or len(values) < 2 or not np.isfinite(values).all() or (np.diff(values) <= 0).any():
        raise HVIError(f"{name} must be two or more finite numbers that increase")
    return values


def _block(word, rho, e, values):
    if callable(values):
        values = [[values(r, x) for x in e] for r in rho]
    values = np.asarray(values, dtype=float)
    if values.shape != (len(rho), len(e)):
        raise HVIError(f"{word} must have a row per density and a column per energy, "
                       f"{len(rho)} x {len(e)}, not {' x '.join(map(str, values.shape))}")
    if not np.isfinite(values).all():
        raise HVIError(f"{word} must be finite")
    rows = [f"{word} {len(rho)} {len(e)}", " ".join(["e", *(repr(float(x)) for x in e)])]
    rows += [" ".join(repr(float(x)) for x in (r, *row)) for r, row in zip(rho, values)]
    return "\n".join(rows) + "\n"


def write_eos_table(path, rho, e, pressure, temperature=None, *, rho0=None, units="si", density="linear",
                    interpolation="bicubic", comment="", date=None):
    """Writes a table on the grid of densities rho and energies per mass e.

    pressure, temperature: functions of (rho, e), or arrays with a row per density and a column per energy
    rho0: density of the reference state, where e = 0 and the pressure is about 0; None for gases
    density: linear or log, in what one interpolates; interpolation: bilinear or bicubic
    comment: where the numbers come from; date: a word that LAMMPS repeats in its log, for instance 2026-02-01
    """
    if units not in UNITS:
        raise HVIError(f"unknown units {units}: tables have {', '.join(UNITS)}")
    if density not in ("linear", "log"):
        raise HVIError(f"density must be linear or log, not {density}")
    if interpolation not in ("bilinear", "bicubic"):
        raise HVIError(f"interpolation must be bilinear or bicubic, not {interpolation}")
    rho, e = _grid("densities", rho), _grid("energies", e)
    if rho[0] <= 0:
        raise HVIError("densities must be > 0")
    if not comment.isascii() or "UNITS:" in comment or "DATE:" in comment:
        raise HVIError("the comment must be plain ASCII, without UNITS: and DATE:")
    text = "# " + (f"DATE: {date} " if date else "") + f"UNITS: {units}\n"
    text += "".join(f"# {line}\n" for line in comment.splitlines()) + "\n"
    if rho0 is not None:
        text += f"rho0 {float(rho0)!r}\n"
    text += f"density {density}\ninterpolation {interpolation}\n\n" + _block("pressure", rho, e, pressure)
    if temperature is not None:
        text += "\n" + _block("temperature", rho, e, temperature)
    with writing(path):
        with open(path, "w", encoding="ascii") as stream:
            stream.write(text)
