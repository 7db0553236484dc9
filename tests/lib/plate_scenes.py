"""examples/single-plate/in.plate as it is, or as a user edits it: whole bodies, bodies of files, an angle."""

import pathlib

FOLDER = pathlib.Path(__file__).resolve().parents[2] / "examples" / "single-plate"


def replaced(text, old, new):
    assert text.count(old) == 1, old
    return text.replace(old, new)


def text(quarter=True, body=None, wall=None, angle=False, end_on=False):
    """The input. body, wall: data files of the sphere, with its middle at 0, and of the plate, in their places; angle: a variable, degrees in the x-z plane;
    end_on: a cylinder as long as its diameter"""
    found = (FOLDER / "in.plate").read_text()
    if not quarter:
        edge = "0 $(1e-3*v_Rplate+v_R)"
        assert found.count(edge) == 2
        found = found.replace(edge, "$(-1e-3*v_Rplate-v_R) $(1e-3*v_Rplate+v_R)")
        found = replaced(found, " mirror x 0 lo mirror y 0 lo", "")
        found = replaced(found, "v_plane v_plane", "v_plane")
        found = replaced(found, "colname -2 mirror_x_lo colname -1 mirror_y_lo", "colname -1 mirror_none")
        found = replaced(found, "(4e3*c_cloud[9]", "(1e3*c_cloud[9]")
        found = replaced(found, "(4*c_cloud[11]", "(c_cloud[11]")
    if wall:
        found = replaced(found, "create_atoms 2 region plate\n", f"read_data    {wall} add append offset 1 0 0 0 0\n")
    if body:  # last: the box shrinks to what is there
        found = replaced(found, "create_atoms 1 region sphere\n", "")
        found = replaced(found, "pair_style   hvi/sph", f"read_data    {body} add append shift 0 0 $(-v_R)\npair_style   hvi/sph")
    if end_on:
        found = replaced(found, "region       sphere sphere 0 0 $(-1.0001*v_R) ${R} units box", "region       sphere cylinder z 0 0 ${R} $(-2.0001*v_R) -1e-9 units box")
    if angle:
        found = replaced(found, "velocity     projectile set 0 0 ${v0} units box", "velocity     projectile set $(v_v0*sin(v_angle*PI/180)) 0 $(v_v0*cos(v_angle*PI/180)) units box")
        found = replaced(found, "variable dx ", "variable angle      index 0\nvariable dx ")
        found = replaced(found, "hvi/variables known dx", "hvi/variables known angle dx")
    return found
