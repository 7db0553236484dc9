"""Bytes that are nearly right: a text of seeds, a few changes made to it. The same random numbers make the same text."""

import re

from seeds import NUMBERS

_NUMBER = re.compile(rb"[-+]?\d[\d.eE+-]*")
_WORD = re.compile(rb"[^\s,:{}\[\]]+")


def _span(rng, text, pattern):
    found = [match.span() for match in pattern.finditer(text)]
    return rng.choice(found) if found else (len(text), len(text))


def _lines(rng, text):
    lines = text.split(b"\n")
    a, b = rng.randrange(len(lines)), rng.randrange(len(lines))
    which = rng.randrange(5)
    if which == 0:
        del lines[a]
    elif which == 1:
        lines.insert(b, lines[a])
    elif which == 2:
        lines[a], lines[b] = lines[b], lines[a]
    elif which == 3:
        lines = lines[:a] + [lines[a] + b" " + lines[b]] + lines[a + 1:]
    else:
        lines[a:a] = lines[min(a, b):max(a, b)]
    return b"\n".join(lines)


def _bytes(rng, text):
    at = rng.randrange(len(text) + 1)
    which = rng.randrange(4)
    if which == 0:
        return text[:at] + bytes([rng.randrange(256)]) + text[at + 1:]
    if which == 1:
        return text[:at] + rng.choice([b"\0", b"\r", b"\xff", b"\xef\xbb\xbf", b"\t", b"\n\n", b" ", b"#", b"'", b'"', b"-", b":", b","]) + text[at:]
    if which == 2:
        return text[:at] + text[at + rng.randrange(1, 9):]
    return text[:at]


def _repeat(rng, text, words):
    at = rng.randrange(len(text) + 1)
    return text[:at] + rng.choice([*words, b"[", b"{", b"- ", b"[[", b"{a: ", b"9", b" ", b"(", b"\n"]) * rng.choice([2, 30, 2000, 20000]) + text[at:]


def mutated(rng, texts, words):
    """rng: of random; texts, words: bytes"""
    text = rng.choice(texts)
    for _ in range(rng.choice([1, 1, 1, 2, 3, 5, 9])):
        which = rng.randrange(8)
        if which in (0, 1):
            a, b = _span(rng, text, _NUMBER)
            text = text[:a] + rng.choice(NUMBERS) + text[b:]
        elif which in (2, 3):
            a, b = _span(rng, text, _WORD)
            text = text[:a] + rng.choice(words) + text[rng.choice([a, b]):]
        elif which == 4:
            text = _lines(rng, text)
        elif which == 5:
            text = _bytes(rng, text)
        elif which == 6:
            other = rng.choice(texts)
            text = text[:rng.randrange(len(text) + 1)] + other[rng.randrange(len(other) + 1):]
        elif rng.random() < 0.2:
            text = _repeat(rng, text, words)
    return text[:1 << 20]
