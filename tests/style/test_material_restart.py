"""A restart file knows the numbers of its materials: files that were edited in between do not go on without a word."""

import pytest

FILE = """# UNITS: si
# any comment
eos mie-gruneisen
rho0 1.0
C 4.0
S1 1.5
g0 2.0
strength perfect
G 5.0
Y 0.1
"""

SCENE = """units si
atom_style sph
atom_modify map array
lattice sc 1.0
region box block 0 4 0 4 0 4
create_box 1 box
create_atoms 1 box
mass 1 1.0
set group all sph/rho 1.02
pair_style hvi/sph cubic
pair_coeff 1 1 file soft.hvi h 1.2
fix move all hvi/sph
timestep 0.001
run 2
write_restart state
"""
ALONE = "read_restart state\nfix move all hvi/sph\nrun 1\n"
AGAIN = ALONE.replace("fix move", "pair_style hvi/sph cubic\npair_coeff 1 1 file soft.hvi h 1.2\nfix move")


@pytest.fixture
def state(lmp, tmp_path):
    """runs the scene, then an input with another material file there"""

    def go(text, script, **kwargs):
        (tmp_path / "soft.hvi").write_text(FILE)
        lmp(SCENE, cwd=tmp_path)
        (tmp_path / "soft.hvi").write_text(text(FILE))
        return lmp(script, cwd=tmp_path, **kwargs)

    return go


def differs(result):
    return [w for w in result.warnings if "not those the restart file was written with" in w]


@pytest.mark.parametrize("script", [ALONE, AGAIN])
def test_comments_and_order_do_not_matter(state, script):
    def edit(file):
        head, strength = file.split("strength perfect\n")
        lines = head.replace("any comment", "another").splitlines()
        order = lines[:3] + lines[3:][::-1] + ["strength perfect"] + strength.splitlines()[::-1]
        return "\n".join(order).replace("S1 1.5", "S1   1.50  # here") + "\n"

    assert not differs(state(edit, script))


def number(file):
    return file.replace("S1 1.5", "S1 1.6")


def of_strength(file):
    return file.replace("Y 0.1", "Y 0.2")


@pytest.mark.parametrize("edit", [number, of_strength])
def test_other_numbers_are_refused(state, edit):
    error = state(edit, ALONE, expect_fail=True).error
    assert "numbers of material soft.hvi of type 1 are not those the restart file was written with" in error
    assert "give pair_coeff again" in error


@pytest.mark.parametrize("edit", [number, of_strength])
def test_unless_the_input_gives_them_which_is_said_once(state, edit):
    assert len(differs(state(edit, AGAIN + "run 1\n"))) == 1


def test_a_section_more_is_another_material(state):
    assert differs(state(lambda file: file + "spall limit\nsigma_p 1.0\n", AGAIN))
