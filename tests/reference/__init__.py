"""Reference solutions and prototypes for the tests: NumPy only, independent of the C++ sources.

layers.py  layered bodies with p = K (rho/rho0 - 1), exact Riemann solver, second-order Lagrangian Godunov scheme
fronts.py  the same problems by event-driven front tracking: exact but for the steps that stand for rarefaction fans
sph1d.py   one-dimensional SPH, form "sum", with interface density dissipation: the equations as published
gas.py     shocks in an ideal gas: Riemann problems, Noh, Sedov, blasts between walls
impedance.py  plates that meet, sound at a step of impedance
elastic_plastic.py  plates of elastic, perfectly plastic solids that meet
measures.py  errors of particle runs against these
eos_curves.py  Hugoniots and releases of laws of the package against measured ones and each other
rule.py    how rules for the dissipation do on random layers
"""
