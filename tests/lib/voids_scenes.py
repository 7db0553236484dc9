"""Spall voids: the section of a material, what runs put out of their state."""

from dumps import named, read_dump

VOIDS = "spall voids\n  sigma 0.6\n  rate 1.0\n  m 0.2\n  phi_c 0.04\n"
NAMES = "p T eps damage initiation spalled voids void_damage fragsize vm sxx syy szz sxy sxz syz".split()
OUT = f"""compute S all hvi/atom {' '.join(NAMES)}
compute R all property/atom drho desph rho esph
dump d all custom 1 {{0}} id x y z vx vy vz fx fy fz c_R[*] c_S[*]
dump_modify d format float %.17g sort id
run 0
undump d
uncompute S
uncompute R
"""


def read(path):
    return named(read_dump(path), R="drho de rho esph", S=" ".join(NAMES))
