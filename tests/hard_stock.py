"""The scenes of hard_solids.py and hard_impacts.py with the package MACHDYN of LAMMPS: beside those of this package, nothing is asked of them."""


def stock(lmp, folder, scene, setting, **how):
    raise NotImplementedError(scene)
