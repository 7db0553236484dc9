# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
# A notebook as a script: cells begin with "# %%", for Jupyter (by jupytext), VS Code and Spyder; python3 runs it, too.

# %% A case, as in CASE.yaml; so coarse that it takes seconds, and too coarse to be believed
import hvi

case = {"projectile": {"diameter_mm": 4, "material": "Al2017-T4"},
        "speed_km_s": 6.5,
        "walls": [{"thickness_mm": 1.0, "material": "Al6061-T6"},
                  {"thickness_mm": 2.0, "material": "Al6061-T6", "gap_mm": 30}],
        "spacings_mm": [1.0, 0.8], "shifts": [0]}

# %% Case in, verdict out: runs LAMMPS, or reads what was run before
answer = hvi.verdict(case, name="coarse", jobs=2, ranks=1)
print(answer)                                   # the verdict, its reasons, notes
print(answer.verdict, answer.margins, sum(answer.areal_densities), "kg/m^2")

# %% A row per run
runs = answer.dataframe()                       # pandas; as runs/coarse/runs.csv
print(runs[["spacing_mm", "verdict", "hole2_diameter_mm", "wall2_spall_mass_mg", "core_s"]])

# %% The finest run: a row per moment
run = answer.runs[0]
history = run.dataframe()                       # index in us; columns in SI, of the whole shield
print(history["wall2 momentum (kg m/s)"].max(), history["wall2 hole_diameter (m)"].iloc[-1])

# %% Its particles, frame by frame
frames = run.frames()                           # in m, m/s, kg, as all of in.shield
frame = frames[-1].whole()                      # with the mirror images of a quarter
print(frame.x.shape, frame.v.shape, frame.m.sum(), "kg at", frame.time, "s")
behind = hvi.measure(frame, "z", 33e-3)         # beyond the rear of wall 2: a dict
sound = hvi.find(frame, distance=1.2e-3, axis="z", plane=33e-3, failed=["damage", "spalled"])
print(behind["momentum"], sound.summary["largest_fragment_mass_fraction"])
print(frame.dataframe().groupby("type")["mass"].sum())

# %% The same in MDAnalysis, and a picture
u = hvi.open(frames)
fast = u.atoms[u.atoms.present & (u.atoms.vz > 1000)]
print(len(fast), "particles faster than 1 km/s")
hvi.figures.save(hvi.figures.side(frame, "y", color="velocity", thickness=2e-3), "coarse.png")
