"""The table of pair_style hvi/sph at the start of a run, read from a log."""

import re

HEADER = "type  particles     spacing h/spacing neighbors rho/rho0 (least,most) layers  material: laws"
ROW = re.compile(r"^ +(\d+) +(\d+) +(\S+) +(\S+) +(\S+) +(-|\S+ \(\S+,\S+\)) +(\d+|-)  (\S+): (.*)$")


def tables(log):
    """one dict per table in the log: style, rows by type, terms, memory, communication"""
    out, lines = [], log.splitlines()
    for k, line in enumerate(lines):
        if line.strip() != HEADER:
            continue
        table = dict(style=lines[k - 1], rows={}, after=[])
        for row in lines[k + 1:]:
            found = ROW.match(row)
            if not found:
                break
            kind, number, spacing, h, near, density, layers, name, laws = found.groups()
            table["rows"][int(kind)] = dict(number=int(number), spacing=float(spacing), h=float(h), neighbors=float(near), layers=layers, name=name, laws=laws,
                                            density=[float(a) for a in re.findall(r"[\d.]+", density)])
        after = lines[k + 1 + len(table["rows"]):][:4]
        table["terms"] = re.match(r"^  terms: (.*)$", after[0]).group(1).split(", ")
        table["memory"] = [int(a) for a in re.match(r"^  memory: (\d+) bytes per owned and ghost particle, (\d+) more per owned particle in fixes$", after[2]).groups()]
        table["arrays"] = {name: int(size) for name, size in re.findall(r"(\w+) (\d+)", re.match(r"^  arrays, bytes: (.*)$", after[1]).group(1))}
        table["sent"] = [int(a) for a in re.match(r"^  communication beyond atom_style sph, doubles per ghost: (\d+) forward and (\d+) reverse in each step, (\d+) when new$",
                                                  after[3]).groups()]
        out.append(table)
    return out
