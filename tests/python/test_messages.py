"""The messages that the documentation quotes are those of the code, word by word."""

import re

import pytest


@pytest.fixture(scope="module")
def texts(root):
    """all string literals of the package and of its Python, adjacent ones joined, what is filled in as {}"""
    source = "\n".join(p.read_text() for folder, ends in (("src/USER-HVI", "cpp"), ("src/USER-HVI", "h"), ("lib/hvi", "cpp"), ("lib/hvi", "h"), ("python/hvi", "py"), ("examples", "yaml"))
                       for p in sorted((root / folder).rglob(f"*.{ends}")))
    joined = re.sub(r'"\s*\n\s*f?"', "", source)
    return re.sub(r"\{[^{}\n;]*\}", "{}", joined)


def quoted(root):
    page = (root / "doc" / "src" / "Howto_messages.rst").read_text()
    for block in re.findall(r"^\.\. code-block:: none\n\n((?:   \S.*\n)+)", page, re.M):
        yield from (line.strip() for line in block.splitlines())


ELSEWHERE = {"ERROR: Unrecognized pair style 'hvi/sph'": "LAMMPS", "verdict: undecided": "hvi shield"}


def test_quoted_messages_are_in_the_code(root, texts):
    found = [line for line in quoted(root) if line not in ELSEWHERE]
    assert len(found) > 10
    assert [line for line in found if line not in texts] == []


def test_one_that_is_not_there_is_found(texts):
    assert "Pair hvi/sph: particles {} and {} are in the same place" not in texts
