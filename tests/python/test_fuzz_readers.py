"""Any bytes for a file: only HVIError comes out of the readers of python/hvi. What fuzzers found, and a few new mutations; more: make fuzz."""

import pathlib
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "fuzz"))
import mutate  # noqa: E402
import readers  # noqa: E402
import seeds  # noqa: E402

FOUND = pathlib.Path(seeds.__file__).parent / "found"
MADE = {  # what is long, and was found, too
    "data": [seeds.DATA.replace("\n\n", "\n\n" + "a " * 20000, 1), seeds.DATA.replace("\n\n", "\n" * 30000, 1)],
    "shots": [seeds.of("shots")[0].decode() + "A" * 200000 + "\n"],
    "case": ["{a: " * 20000, "- " * 20000],
    "study": ["[" * 20000],
}


@pytest.fixture
def folder(tmp_path):
    readers.beside(tmp_path)
    return tmp_path


@pytest.mark.parametrize("kind", readers.KINDS)
def test_what_was_found(folder, kind):
    path = folder / f"now.{readers.KINDS[kind]}"
    texts = {found.name: found.read_bytes() for found in sorted((FOUND / kind).glob("*"))}
    texts.update((f"made {k}", text.encode()) for k, text in enumerate(MADE.get(kind, ())))
    for name, text in texts.items():
        path.write_bytes(text)
        assert not readers.check(kind, path), name


@pytest.mark.parametrize("kind", readers.KINDS)
def test_seeds(folder, kind):
    """with which fuzzing begins are files that can be read"""
    path = folder / f"now.{readers.KINDS[kind]}"
    for text in seeds.of(kind):
        if b"\n---\n" not in text:  # a material and its table in one, for C++
            path.write_bytes(text)
            readers.READ[kind](path)
            if kind == "case":
                readers.case.read(path)


@pytest.mark.parametrize("kind", readers.KINDS)
def test_mutations(tmp_path, kind):
    n, found = readers.run(kind, tmp_path, seed="short", count=100)
    assert n == 100 and not found


@pytest.mark.long
@pytest.mark.parametrize("kind", readers.KINDS)
def test_more_mutations(tmp_path, kind):
    n, found = readers.run(kind, tmp_path, seed="long", count=5000)
    assert n == 5000 and not found


def test_it_finds(tmp_path, monkeypatch):
    """another error, a hang and garbage in whole numbers are seen"""
    monkeypatch.setattr(readers, "SECONDS", 1)
    for wrong in (lambda path: {}["x"], lambda path: [0 for _ in iter(int, 1)], lambda path: readers.np.array([float("nan")]).astype(int)):
        monkeypatch.setitem(readers.READ, "case", wrong)
        assert readers.check("case", tmp_path)


def test_mutations_are_those_of_the_seed():
    texts, words = seeds.of("dump"), seeds.words("dump")
    made = [mutate.mutated(mutate_random("a"), texts, words) for _ in range(2)]
    assert made[0] == made[1] != mutate.mutated(mutate_random("b"), texts, words)


def mutate_random(seed):
    return readers.random.Random(seed)
