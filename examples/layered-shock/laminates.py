#!/usr/bin/env python3
"""Laminates of Zisis et al. as variables of in.layers; projectile and outer layers are of one material. Densities in 1000 kg/m^3, if real.

    ../../build/lmp -in in.layers $(python3 laminates.py st_glass_st)
"""
import sys

CASES = {
    "test": dict(rho_a=1.0, Ca_a=1.0, rho_b=0.5, Ca_b=0.25, tstop=0.2),
    "al_glass_al": dict(rho_a=2.7, Ca_a=3.7, rho_b=1.9, Ca_b=7.6, tstop=0.75),
    "al_carbon_al": dict(rho_a=2.7, Ca_a=3.7, rho_b=1.9, Ca_b=1.1, tstop=0.75),
    "st_glass_st": dict(rho_a=8.0, Ca_a=3.9, rho_b=1.9, Ca_b=7.6, tstop=0.75),
    "st_carbon_st": dict(rho_a=8.0, Ca_a=3.9, rho_b=1.9, Ca_b=1.1, tstop=0.75),
}


def case_of(rho, Ca):
    """name of the case with these densities and Cauchy numbers of projectile, alpha and beta; else what they are"""
    for case, v in CASES.items():
        if (list(rho), list(Ca)) == ([v["rho_a"], v["rho_a"], v["rho_b"]], [v["Ca_a"], v["Ca_a"], v["Ca_b"]]):
            return case
    return f"rho {rho}, Ca {Ca}"


if __name__ == "__main__":
    if len(sys.argv) != 2 or sys.argv[1] not in CASES:
        sys.exit(f"one of {', '.join(CASES)}")
    print(*(f"-var {key} {value}" for key, value in CASES[sys.argv[1]].items()))
