#!/usr/bin/env python3
"""Figures and tables of the studies:  python3 plot.py [--tables DIR] [--runs DIR] [--out DIR] [NAME ...]

Reads DIR/NAME.csv (written by hvi sweep) for each study, draws OUT/NAME*.png and prints the tables of README.md in
Markdown. Studies without a table are left out. Pictures of clouds need the dumps of the runs in --runs.
"""
import argparse
import csv
import io
import pathlib
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import yaml
from PIL import Image

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
import hvi  # noqa: E402

COLOR = {"sc": "C0", "fcc": "C3"}
F, F_BALL, BIG, BIG_BALL, BIG_PASSED = ("fragmentation", "projectile_fragmentation", "largest_fragment_mass_fraction",
                                        "projectile_largest_fragment_mass_fraction",
                                        "projectile_cloud_largest_fragment_mass_fraction")
R, VA, VA_FRONT = "length_ratio", "axial_velocity_ratio_displacement", "axial_velocity_ratio"
VOLUME = 4 / 3 * np.pi * 4.765**3 + np.pi * 20**2 * 0.425 * 9.53  # mm^3, sphere and a plate of 20 mm radius


PAPER_SIZE = pathlib.Path(__file__).resolve().parent / "../debris-cloud/result-paper.yaml"


def number(text):
    try:
        return float(text)
    except ValueError:
        return text


def read(path):
    """the rows of a table, numbers as floats"""
    with open(path, newline="") as table:
        return [{key: number(value) for key, value in row.items()} for row in csv.DictReader(table)]


def column(rows, key):
    return np.array([row[key] for row in rows])


def lattices(rows):
    """(lattice, its rows) for those that are there"""
    return [(name, found) for name in ("sc", "fcc") if (found := [row for row in rows if row["lattice"] == name])]


def markdown(title, rows, columns):
    """print a table; columns: {heading: key or function of a row}"""
    def cell(value):
        if not isinstance(value, float):
            return str(value)
        return f"{value:,.0f}" if abs(value) >= 1e3 else f"{value:.3g}"

    print(f"\n{title}\n\n| {' | '.join(columns)} |\n|{'---|' * len(columns)}")
    for row in rows:
        print("| " + " | ".join(cell(key(row) if callable(key) else row[key]) for key in columns.values()) + " |")


def pivot(title, rows, x, y, keys):
    """print values over two columns of a table"""
    xs, ys, _ = grid(rows, x, y, keys[0])
    values = [grid(rows, x, y, key)[2] for key in keys]
    def short(value):
        return f"{value / 1e6:g}e6" if value >= 1e5 else f"{value:g}"

    markdown(title, [{y: short(name), **{f"{x} {short(v)}": " / ".join(f"{value[i, j]:.2f}" for value in values) for j, v in enumerate(xs)}}
                     for i, name in enumerate(ys)], {name: name for name in (y, *(f"{x} {short(v)}" for v in xs))})


def save(figure, out, name):
    """a PNG of 64 colors, small enough for a repository"""
    buffer = io.BytesIO()
    figure.savefig(buffer, dpi=90)
    plt.close(figure)
    Image.open(buffer).convert("RGB").quantize(64).save(out / f"{name}.png", optimize=True)
    print(f"{out / name}.png", file=sys.stderr)


# --- the studies: each takes the rows of its table, the folder for figures, and the folder of its runs ---

MEASURES = {"F of the cloud": F, "F of the sphere": F_BALL, "largest fragment of the sphere / sphere": BIG_BALL,
            "$L_a / L_r$": R, "$v_a / v_0$, displacement of the front": VA, "$v_a / v_0$, particles at the front": VA_FRONT}


def convergence(rows, out, runs):
    figure, axes = plt.subplots(2, 3, figsize=(11, 6), sharex=True, layout="constrained")
    for lattice, found in lattices(rows):
        found.sort(key=lambda row: -row["spacing_mm"])
        n = VOLUME / column(found, "spacing_mm") ** 3
        for ax, key in zip(axes.flat, MEASURES.values()):
            ax.semilogx(n, column(found, key), "o-", color=COLOR[lattice], label=f"{lattice}, 12 us")
    paper = yaml.safe_load(PAPER_SIZE.read_text())
    for ax, (title, key) in zip(axes.flat, MEASURES.items()):
        if key in paper:
            ax.plot(VOLUME / paper["spacing_mm"] ** 3, paper[key], "D", color=COLOR["sc"], mfc="w", label="sc, 32 us")
        ax.axvline(2.5e5, color="gray", lw=0.8, ls=":")
        ax.set_title(title, fontsize=10)
        ax.set_ylim(0, 1.08 * ax.dataLim.ymax)
        ax.grid(alpha=0.3)
    axes[0, 0].legend()
    figure.supxlabel("particles of sphere and a plate of 20 mm radius at this spacing; dotted: 250,000")
    save(figure, out, "convergence")
    markdown("convergence", rows, {
        "lattice": "lattice", "layers": "plate_layers", "a (mm)": "spacing_mm", "particles": "particles",
        "with plate of 20 mm": lambda row: VOLUME / row["spacing_mm"] ** 3, "F": F, "F, sphere": F_BALL,
        "largest fragment of the cloud": BIG, "of the sphere": BIG_BALL, "L_a/L_r": R, "v_a/v0, displacement": VA, "v_a/v0, front": VA_FRONT})


def grid(rows, x, y, key):
    """values of a table as a matrix over two of its columns"""
    xs, ys = sorted(set(column(rows, x))), sorted(set(column(rows, y)))
    values = np.full((len(ys), len(xs)), np.nan)
    for row in rows:
        values[ys.index(row[y]), xs.index(row[x])] = row[key]
    return np.array(xs), np.array(ys), values


def parameters(rows, out, runs):
    keys = {"F of the cloud": F, "sphere's largest fragment in the cloud": BIG_PASSED, "$L_a / L_r$": R, "$v_a / v_0$": VA}
    found = lattices(rows)
    figure, axes = plt.subplots(len(found), 4, figsize=(13, 3 * len(found)), squeeze=False, layout="constrained")
    for line, (lattice, part) in zip(axes, found):
        for ax, (title, key) in zip(line, keys.items()):
            kappa, eps, values = grid(part, "kappa", "eps", key)
            ax.imshow(values, origin="lower", aspect="auto", cmap="viridis", vmin=0, vmax=np.nanmax(column(rows, key)))
            for (i, j), value in np.ndenumerate(values):
                ax.text(j, i, f"{value:.2f}", ha="center", va="center", fontsize=8,
                        color="w" if value < 0.6 * np.nanmax(column(rows, key)) else "k")
            ax.set_xticks(range(len(kappa)), [f"{k / 1e6:g}" for k in kappa])
            ax.set_yticks(range(len(eps)), [f"{e:g}" for e in eps])
            ax.set_title(f"{lattice}: {title}", fontsize=10)
        line[0].set_ylabel("eps (J)")
    figure.supxlabel("kappa (1e6 J/m$^2$)")
    save(figure, out, "parameters")
    for lattice, part in found:
        pivot(f"{lattice}: F / largest fragment of the sphere in the cloud / L_a/L_r / v_a/v0", part, "kappa", "eps",
              (F, BIG_PASSED, R, VA))
    for lattice, part in found:
        kappa, eps, _ = grid(part, "kappa", "eps", F)
        cells = {(len(eps) - 1 - list(eps).index(row["eps"]), list(kappa).index(row["kappa"])): row for row in part}
        montage(cells, runs, out, f"parameters-{lattice}", lambda row: f"eps {row['eps']:g} J, kappa {row['kappa'] / 1e6:g}e6 J/m$^2$")


def thickness(rows, out, runs):
    figure, ax = plt.subplots(figsize=(6, 4), layout="constrained")
    for lattice, found in lattices(rows):
        found.sort(key=lambda row: row["tD"])
        for key, style, label in ((VA, "o-", "displacement"), (VA_FRONT, "s--", "particles at the front")):
            ax.plot(column(found, "tD"), column(found, key), style, color=COLOR[lattice], mfc="w" if style[0] == "s" else None,
                    label=f"{lattice}, {label}")
    ax.set(xlabel="t/D", ylabel="$v_a / v_0$", xlim=(0, None))
    ax.grid(alpha=0.3)
    ax.legend(fontsize=8)
    save(figure, out, "thickness")
    markdown("thickness", sorted(rows, key=lambda row: (row["lattice"] != "sc", row["tD"])), {
        "lattice": "lattice", "t/D": "tD", "layers": "plate_layers", "particles": "particles", "v_a/v0, displacement": VA,
        "v_a/v0, particles at the front": VA_FRONT, "L_a/L_r": R, "F": F, "largest fragment of the sphere": BIG_BALL})


def onset(tD):
    """velocity (m/s) above which a 2017-T4 sphere breaks on a 6061-T6 plate (Piekutowski 2003)"""
    return np.where(tD < 0.16, 1436 * tD ** (-1 / 3), 2600)


def fragmentation(rows, out, runs):
    keys = {"F of the cloud": (F, 0.3), "F of the sphere": (F_BALL, 0.3), "largest fragment of the sphere / sphere": (BIG_BALL, 0.5, 0.9)}
    found = lattices(rows)
    figure, axes = plt.subplots(len(found), 3, figsize=(13, 4 * len(found)), squeeze=False, sharex=True, sharey=True,
                                layout="constrained")
    for line, (lattice, part) in zip(axes, found):
        for ax, (title, (key, *levels)) in zip(line, keys.items()):
            tD, v0, values = grid(part, "tD", "v0", key)
            filled = ax.contourf(tD, v0 / 1e3, values, levels=np.linspace(0, 1, 21), cmap="viridis")
            if np.nanmin(values) < levels[0] < np.nanmax(values):
                ax.contour(tD, v0 / 1e3, values, levels=levels, colors="w", linewidths=2, linestyles=["-", "--"][:len(levels)])
            for (i, j), value in np.ndenumerate(values):
                ax.text(tD[j], v0[i] / 1e3, f"{value:.2f}", ha="center", va="center", fontsize=7,
                        color="k" if value > 0.6 else "w")
            fine = np.linspace(tD[0], tD[-1], 200)
            ax.plot(fine, onset(fine) / 1e3, "r--", lw=1.5)
            ax.set_title(f"{lattice}: {title}", fontsize=10)
            ax.set(xlim=(tD[0] - 0.03, tD[-1] + 0.03), ylim=(v0[0] / 1e3 - 0.3, v0[-1] / 1e3 + 0.3), facecolor="#808080")
        figure.colorbar(filled, ax=line[-1])
        line[0].set_ylabel("$v_0$ (km/s)")
    for ax in axes[-1]:
        ax.set_xlabel("t/D")
    figure.supxlabel("white: F = 0.3; half (dashed: 90 %) of the sphere in one piece.   red: measured onset of fragmentation of the sphere", fontsize=11)
    save(figure, out, "fragmentation")
    for lattice, part in found:
        pivot(f"{lattice}: F of the cloud / largest fragment of the sphere", part, "tD", "v0", (F, BIG_BALL))


def thin_plate(rows, out, runs):
    markdown("thin-plate", rows, {
        "lattice": "lattice", "t/D": "tD", "v0 (m/s)": "v0_m_s", "layers": "plate_layers", "a (mm)": "spacing_mm",
        "particles": "particles", "F": F, "F, sphere": F_BALL, "largest fragment of the sphere": BIG_BALL, "L_a/L_r": R, "v_a/v0": VA})
    plates = list(dict.fromkeys((row["tD"], row["v0_m_s"], row["plate_layers"]) for row in rows))
    cells = {(("sc", "fcc").index(row["lattice"]), plates.index((row["tD"], row["v0_m_s"], row["plate_layers"]))): row for row in rows}
    montage(cells, runs, out, "thin-plate", lambda row: f"{row['lattice']}, t/D {row['tD']:g}, {row['v0_m_s'] / 1e3:g} km/s, "
            f"{row['plate_layers']:g} layer" + "s" * (row["plate_layers"] > 1), width=2.5)


def sensitivity(rows, out, runs):
    """one variable at a time; what a row differs in from the default is in its job's name"""
    keys = {"F": F, "F, sphere": F_BALL, "largest of the sphere": BIG_BALL, "$L_a/L_r$": R, "$v_a/v_0$": VA}
    found = lattices(rows)
    what = {row["job"]: "{} {:g}".format(name, float(value)) for row in rows
            for name, value in [row["job"].split("_lattice")[0].split("-", 1)]}
    figure, axes = plt.subplots(1, len(keys), figsize=(12, 5), sharey=True, layout="constrained")
    for ax, (title, key) in zip(axes, keys.items()):
        for lattice, part in found:
            ax.plot(column(part, key), range(len(part)), "o", color=COLOR[lattice], label=lattice)
            ax.axvline(part[0][key], color=COLOR[lattice], lw=0.8)
        ax.set_title(title, fontsize=10)
        ax.set_xlim(-0.03 * ax.dataLim.xmax, 1.08 * ax.dataLim.xmax)
        ax.grid(alpha=0.3)
    axes[0].set_yticks(range(len(found[0][1])), [what[row["job"]] for row in found[0][1]])
    axes[0].invert_yaxis()
    axes[2].legend(loc="lower right")
    save(figure, out, "sensitivity")
    markdown("sensitivity", rows, {"lattice": "lattice", "changed": lambda row: what[row["job"]], "F": F, "F, sphere": F_BALL,
                                   "largest fragment of the sphere": BIG_BALL, "L_a/L_r": R, "L_a/(2 L_r)": "length_to_diameter",
                                   "v_a/v0, displacement": VA, "v_a/v0, front": VA_FRONT,
                                   "energy in broken bonds": lambda row: row["energy_broken_bonds_J"] / row["energy_start_J"]})


def plate_size(rows, out, runs):
    markdown("plate-size", rows, {"lattice": "lattice", "plate radius (mm)": "Rplate", "particles": "particles", "F": F,
                                  "F of all particles": "fragmentation_all", "largest fragment of the sphere": BIG_BALL,
                                  "L_a/L_r": R, "v_a/v0, displacement": VA, "v_a/v0, front": VA_FRONT})


# --- pictures of clouds ---

WINDOW = "each window: z from -25 to 95 mm (the shot flies to the right), x from -45 to 45 mm"

def picture(ax, folder, spacing):
    """the cloud from the side: sphere red, plate blue; strong colors for fragments of ten particles and more"""
    frame = hvi.Dump(folder / "debris.dump", masses={1: 1.0, 2: 1.0})[-1]
    found = hvi.find(frame, bonds=folder / "bonds.dump")
    big, ball = found.table["count"][found.row] >= 10, frame["type"] == 1
    for chosen, color in ((~big & ~ball, "#9db8e8"), (~big & ball, "#f0a8a0"), (big & ~ball, "#1f3f9f"), (big & ball, "#c01010")):
        ax.scatter(1e3 * frame["z"][chosen], 1e3 * frame["x"][chosen], s=max(0.15, 2.5 * spacing**2), c=color, lw=0)
    ax.set(xlim=(-25, 95), ylim=(-45, 45), aspect="equal", xticks=[], yticks=[])


def montage(cells, runs, out, name, title, width=2.2):
    """pictures of jobs in rows and columns; cells: {(row, column): row of the table}"""
    if not all((runs / row["job"] / "debris.dump").is_file() for row in cells.values()):
        print(f"no dumps in {runs}: {name}.png is left as it is", file=sys.stderr)
        return
    lines, columns = (1 + max(place[k] for place in cells) for k in (0, 1))
    figure, axes = plt.subplots(lines, columns, figsize=(width * columns, 0.86 * width * lines), squeeze=False, layout="constrained")
    for ax in axes.flat:
        ax.axis("off")
    for place, row in cells.items():
        axes[place].axis("on")
        axes[place].set_title(title(row), fontsize=8)
        picture(axes[place], runs / row["job"], row["spacing_mm"])
    figure.supxlabel(WINDOW, fontsize=8)
    save(figure, out, name)


STUDIES = {"convergence": convergence, "parameters": parameters, "thickness": thickness, "fragmentation": fragmentation,
           "thin-plate": thin_plate, "sensitivity": sensitivity, "plate-size": plate_size}


def main(argv=None):
    here = pathlib.Path(__file__).resolve().parent
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", help=f"studies: {', '.join(STUDIES)} (default: all)")
    parser.add_argument("--tables", type=pathlib.Path, default=here / "results", help="folder of the CSV tables (default: results)")
    parser.add_argument("--runs", type=pathlib.Path, default="runs", help="folder of the runs, for pictures of clouds (default: runs)")
    parser.add_argument("--out", type=pathlib.Path, default=".", help="folder for the figures (default: this one)")
    args = parser.parse_args(argv)
    unknown = set(args.names) - set(STUDIES)
    if unknown:
        parser.error(f"unknown study {', '.join(sorted(unknown))}; known: {', '.join(STUDIES)}")
    found = [name for name in args.names or STUDIES if (args.tables / f"{name}.csv").is_file()]
    if not found:
        sys.exit(f"plot.py: no table of {', '.join(args.names or STUDIES)} in {args.tables}: run hvi sweep first")
    args.out.mkdir(parents=True, exist_ok=True)
    for name in found:
        rows = read(args.tables / f"{name}.csv")
        if rows:
            STUDIES[name](rows, args.out, args.runs / name)


if __name__ == "__main__":
    main()
