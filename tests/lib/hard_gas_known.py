"""What the hard cases of gases and liquids are known to miss, and why: {case: {method: {measure: cause}}}."""


def because(cause, measures):
    return dict.fromkeys(measures.split(), cause)


PATH = "density is integrated along the way through the shock, and comes out wrong behind strong ones, at any resolution"
RINGS = "rings at the head of the rarefaction"
JUMP = "rings at the head of the rarefaction, and pressure dips at a contact that begins as a jump"
FEW = "two of 200 particles, right at the bound"
COARSE = "resolution: the shock, and the hot middle behind it, are a few particles wide"
HOT = "the empty middle is a few hot particles with h at its limit"
ROUND = "round-off grows in the hot middle, slowly: a little more than 1e-6"
LAST = "the last particles stay too dense, as nothing is beyond them that their density could follow"
ROUGH = "nothing evens out density that does not go with the places of particles, which are disordered"
UNLIKE = "sums over unlike neighbors are not 1: particles beside the interface find new places, and density keeps what that changed"
PULL = "the liquid is in tension: particles clump (tensile instability)"
ARMS = "in tension at the roots of the arms, where 16 of 576 particles are at 0.48 of the spacing"
VISCOUS = "the viscosity that shocks need acts on shear"
UNSTILL = "this kernel does not hold gas under pressure still: noise takes what moves"
THICK = "the layer gets thick faster than a wave of 24 spacings grows"
NOISE = "a tenth of the viscosity leaves disorder, in which this kernel lets pairs form"

KNOWN = {
    **{k: {"monaghan": because(PATH, "rho u p"), "riemann": because(JUMP, "u p") | because(FEW, "paired")}
       for k in ("blast-left", "blast-right", "cold-blast", "woodward-colella")},
    **{k: {"monaghan": because(PATH, "rho u p")} for k in ("noh-1d", "cold-noh")},
    "noh-2d": {"monaghan": because(PATH, "rho u p"), "riemann": because(COARSE, "u p")},
    "noh-3d": {m: because(COARSE, "u p") for m in ("monaghan", "riemann")},
    "sedov-2d": {"monaghan": because(HOT, "rho u p"), "riemann": because(HOT, "u p") | because(ROUND, "symmetry")},
    "sedov-3d": {"monaghan": because(HOT, "p"), "riemann": because(ROUND, "symmetry")},
    "vacuum-gas": {"monaghan": because(LAST, "rho u p front"),
                   "riemann": because(RINGS, "rho u p")},
    "vapor-dome-100": {"monaghan": because("velocities of neighbors behind the fan alternate by 0.2 %", "back"), "riemann": because(RINGS, "back")},
    "vapor-dome-400": {"riemann": because(RINGS, "back")},
    "interface-100": {"monaghan": because(PATH, "p"), "interface": because(PATH, "rho u p")},
    "interface-1000": {"monaghan": because(PATH, "u p"), "interface": because(PATH, "rho u p"),
                       "riemann": because("half of it is at the reflected shock, which is a little wider than the bound has it", "u")},
    **{f"contrast-{k}-rest": {"monaghan": because(ROUGH, "p")} for k in (100, 1000)},
    "table-edge": {"riemann": because("overshoots the density of the start by 5 %, so it leaves the table", "run")},
    "random-rest": {"monaghan": because(ROUGH, "p rho")},
    "spacing-2-rest": {"monaghan": because(UNLIKE, "rho p"), "interface": because(UNLIKE, "rho")},
    "spacing-4-rest": {"monaghan": because(UNLIKE, "rho p u"), "interface": because(UNLIKE, "rho p u")},
    "spacing-2-shock": {"monaghan": because(PATH, "rho p"), "interface": because(PATH, "rho p")},
    "spacing-4-shock": {"monaghan": because(PATH, "rho p"), "interface": because(PATH, "p")},
    "spacing-2-rest-2d": {"monaghan": because(UNLIKE, "rho p")},
    "spacing-4-rest-2d": {"monaghan": because(UNLIKE, "rho p")},
    "spacing-4-shock-2d": {"monaghan": because(UNLIKE, "p_fine p_coarse"), "interface": because(UNLIKE, "p_fine")},
    "shear": {"monaghan": because(VISCOUS, "lost v"), "monaghan wendland4": because(VISCOUS, "lost v"), "riemann": because(UNSTILL, "lost v"),
              "riemann wendland4": because("resolution: it falls with the square of the spacing, 32 particles per wave are a few short", "lost")},
    "kelvin-helmholtz": {"monaghan": because(VISCOUS, "grows"), "interface": because(VISCOUS, "grows"), "riemann": because(THICK, "grows")},
    "spinning-disc": {"monaghan": because(PULL, "paired v"), "riemann": because(PULL, "paired v"), "monaghan wendland4": because(PULL, "v"),
                      "riemann wendland4": because(PULL, "paired v")},
    "spinning-square": {"riemann": because(ARMS, "paired")},
    "vortices": {f"{k} monaghan": because(NOISE, "paired") for k in ("cubic", "quartic", "quintic", "gauss")}}
