# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""What material files say that decides whether a body is a solid: its laws of strength, and what lets it fail under tension."""

import difflib
import os
import re

from ..errors import reading
from . import library

SOLID = "damage yes spall voids"  # words of fix hvi/johnson-cook that shields take
YES, NO = {"yes", "on", "true"}, {"no", "off", "false"}  # as LAMMPS has them


def last_word(words, key):
    """what follows a keyword in the words of a style, where it is given last, as LAMMPS takes it; None: it is not"""
    words = words.split()
    return next((value for name, value in reversed([*zip(words, words[1:])]) if name == key), None)


def strengths(path):
    """laws of strength in a material file"""
    with reading(path):
        return re.findall(r"^[ \t]*strength[ \t]+([\w-]+)", path.read_text(errors="replace"), re.M)


def find(reader, node, key):
    """Reads the name of a material: a file beside that of the reader, or one of the package, without .hvi; it must have a section strength"""
    name = reader.text(node, key)
    known = {path.stem: path for folder in reversed(library.potentials()) for path in sorted(folder.glob("*.hvi"))}

    def solids():
        """those that a run can take: of which another one has a law, too, as all materials of a run have one in common"""
        laws = {stem: set(strengths(path)) - {"none"} for stem, path in known.items()}
        return sorted(stem for stem in laws if any(laws[stem] & laws[other] for other in laws if other != stem))

    own = next((path for path in (reader.path.parent / name, reader.path.parent / f"{name}.hvi") if os.path.isfile(path)), None)  # is_file() raises for a long name
    path = own or known.get(name.removesuffix(".hvi"))
    if own and not re.fullmatch(r"[\w.+-]+\.hvi", own.name, re.A):
        reader.wrong(key, f"the file is named {own.name!r}, which goes into a LAMMPS input: letters, digits and . _ + - only, and .hvi at the end", node)
    if path is None:
        reader.wrong(key, f"no material {name}{meant(name, solids())} (known: {', '.join(solids())})", node)
    if not strengths(path):
        reader.wrong(key, f"{path.stem} has no section strength, it would be a liquid (known: {', '.join(solids())})", node)
    return str(own.resolve()) if own else path.name


COMMON = {"aluminum": "Al", "aluminium": "Al", "copper": "Cu", "steel": "steel", "iron": "Fe", "titanium": "Ti", "tantalum": "Ta", "lead": "Pb", "tungsten": "W", "nickel": "Ni",
          "magnesium": "Mg", "beryllium": "Be", "zinc": "Zn", "silver": "Ag", "gold": "Au"}


def meant(name, known):
    """words on which of the known materials a name may mean"""
    element = COMMON.get(name.lower())
    of = [stem for stem in known if element and re.match(rf"{element}(?![a-z])", stem)]
    near = of or difflib.get_close_matches(name, known, 1, 0.4)
    return f"; did you mean {' or '.join(near)}?" if near else ""


def check(case, reader):
    """All materials must have the law of strength that the run takes: one without it would be a liquid, whatever else its file has"""
    words = case.setting("solid").split()
    law = last_word(case.setting("solid"), "strength") or "johnson-cook"
    places = [("projectile: material", case.material), *((f"wall {k}: material", wall.material) for k, wall in enumerate(case.walls, 1))]
    laws = {name: strengths(path) for _, name in places if (path := library.of_case(name)).is_file()}
    common = sorted(set.intersection(*map(set, laws.values())) - {"none"}) if laws else []
    for key, name in places:
        if name not in laws or law in laws[name] or law == "none":
            continue
        kept = " ".join(word for k, word in enumerate(words) if word != "strength" and (k == 0 or words[k - 1] != "strength"))
        remedy = (f"take settings: {{solid: {kept} strength {common[0]}}}, which all materials of this case have" if common else
                  f"all materials of a case must have one law in common, and these have none: give {library.stem(name)} a section strength {law}")
        reader.wrong(key, f"{library.stem(name)} has strength {' and '.join(laws[name])}, and the run takes {law}: it would be a liquid; {remedy}")


def lacking(name, solid):
    """{kind: why} of the laws, spall and damage, by which a material does not fail with these words of fix hvi/johnson-cook: its file has none, or the words take none"""
    path = library.of_case(name)
    if not path.is_file():
        return {}  # LAMMPS says so
    text = path.read_text(errors="replace")
    law = {kind: last_word(solid, kind) or preset for kind, preset in (("spall", "principal"), ("damage", "yes"))}
    section = {"spall": law["spall"] if law["spall"] in ("voids", "tuler-butcher", "grady") else "limit", "damage": r"[\w-]+" if law["damage"] in YES else law["damage"]}
    found = {}
    for kind, none in (("spall", {"none", "pressure"}), ("damage", NO)):  # with spall pressure nothing comes apart
        if law[kind] in none:
            found[kind] = f"with {kind} {law[kind]}"
        elif kind == "damage" and last_word(solid, "strength") == "none":
            found[kind] = "with strength none"
        elif not re.search(rf"^[ \t]*{kind}[ \t]+{section[kind]}(?![\w-])", text, re.M):
            found[kind] = f"whose file has no law of {kind} ({solid})"
    return found
