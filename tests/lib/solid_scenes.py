"""Solids in scenes: a material, particles of two types of it in a smooth field of velocity, the input of their run, what it puts out, and data files of it."""

from math import gamma

import numpy as np
from dumps import named, read_dump
from sph_scenes import random_fluid, scene

# si-like numbers in lj units: rho0 1, c0 4; strength and damage so that a part yields, some fail
MATERIAL = """# DATE: 2026-01-01 UNITS: lj CONTRIBUTOR: test CITATION: none
eos gruneisen
  rho0 1.0
  C 4.0
  S1 1.4
  g0 2.0
  a 0.5
  cp 1.0
  T0 300
strength johnson-cook
  G 6.0
  A 0.25
  B 0.4
  n 0.4
  C 0.01
  m 1.0
  epsdot0 1.0
  Tref 300
  Tm 900
damage johnson-cook
  D1 0.02
  D2 0.04
  D3 -1.5
  D4 0.01
  D5 0.5
  epsdot0 1.0
spall limit
  sigma_p {sigma_p}
"""
SOFT = MATERIAL.replace("spall limit", "  u_f 0.04\nspall limit")  # damage takes plastic displacement
PAIR = "pair_style hvi/sph {kernel} {words}\npair_coeff 1 1 file {path} h 1.25\npair_coeff 2 2 file {path} h 1.25\n"
OUT = """compute S all hvi/atom p c eps damage spalled vm sxx syy szz sxy sxz syz
compute R all property/atom drho desph rho esph
dump d all custom 1 {0} id type x y z vx vy vz fx fy fz c_R[1] c_R[2] c_R[3] c_R[4] c_S[*]
dump_modify d format float %.17g sort id
run 0
undump d
uncompute S
uncompute R
"""
NEIGHBOR = "neighbor 0.3 bin\nneigh_modify every 1 delay 0 check yes\n"
FIXES = "fix sph all hvi/sph\nfix jc all hvi/johnson-cook {}\ntimestep 0.004\n"
READ = """units lj
boundary p p p
atom_style sph
atom_modify map {map} sort 0 0
region box block 0 1 0 1 0 1
create_box 2 box
{fixes}
read_data half.data add merge fix sph NULL NULL fix sph NULL sph_rates fix sph NULL sph_step fix jc NULL NULL fix jc NULL jc_forces
"""


def read(path):
    out = named(read_dump(path), R="drho de rho esph", S="p c eps damage spalled vm sxx syy szz sxy sxz syz")
    return {**out, "type": out["type"].astype(int), "S": np.stack([out.pop(name) for name in "sxx syy szz sxy sxz syz".split()], axis=1)}


def state(seed=21, speed=0.35, **kw):
    s = random_fluid(8, seed=seed, jitter=0.05, speed=speed, h=1.25, types=2, **kw)
    s.mass = {1: 1.0, 2: 1.0}
    s.rho = np.ones(len(s.x))
    s.esph = np.zeros(len(s.x))
    s.h = {1: 1.25, 2: 1.25}
    # a field with shear, compression and stretch, smooth
    k = 2 * np.pi / s.box[0]
    s.v += 0.8 * np.stack([np.sin(k * s.x[:, 1]), np.sin(k * s.x[:, 2]) + np.sin(k * s.x[:, 1]), np.cos(k * s.x[:, 0])], -1)
    return s


def start(s, tmp_path, material, words="viscosity 1 2", tension="yes", more="", steps=40, jc="", kernel="cubic", **kw):
    pair = PAIR.format(kernel=kernel, words=words, path=material) + f"pair_coeff 1 2 tension {tension}\n"
    text = scene(s, tmp_path / "s.data", pair, **kw) + f"fix jc all hvi/johnson-cook {jc}\ntimestep 0.004\n"
    return text + more + (f"run {steps}\n" if steps else "")


def as_tensor(d):
    """the deviator, from the whole stress of the dump"""
    xx, yy, zz, xy, xz, yz = (d["S"] + np.outer(d["p"], [1, 1, 1, 0, 0, 0])).T
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]).transpose(2, 0, 1)


def reader(path, words="viscosity 1 2", jc="", map="array"):
    return READ.format(map=map, fixes=FIXES.format(jc)) + PAIR.format(kernel="cubic", words=words, path=path) + "pair_coeff 1 2 tension yes\n" + NEIGHBOR


def compare(one, two, tolerance):
    for name in one:
        assert np.abs(one[name] - two[name]).max() <= tolerance * max(1.0, np.abs(one[name]).max()), name


def factor(modulus, seed, tag):
    """Weibull's factor of mean 1 from SplitMix64's finalizer of seed and ID"""
    def mix(x):
        x = (x + 0x9e3779b97f4a7c15) % 2**64
        x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9 % 2**64
        x = (x ^ (x >> 27)) * 0x94d049bb133111eb % 2**64
        return x ^ (x >> 31)

    u = np.array([((mix(mix(seed) ^ int(t)) >> 12) + 0.5) / 2**52 for t in tag])
    return (-np.log(u)) ** (1 / modulus) / gamma(1 + 1 / modulus)
