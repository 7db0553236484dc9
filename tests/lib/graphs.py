"""Circles in what depends on what."""

import collections


def circle(edges):
    """a shortest circle [a, b, ..., a] in {node: its next ones}, None if there is none"""
    best = None
    for start in sorted(edges):
        before, queue = {start: None}, collections.deque([start])
        while queue:
            here = queue.popleft()
            if start in edges.get(here, ()):
                way = [start]
                while here is not None:
                    way.append(here)
                    here = before[here]
                if best is None or len(way) < len(best):
                    best = way[::-1]
                break
            for there in sorted(edges.get(here, ())):
                if there not in before:
                    before[there] = here
                    queue.append(there)
    return best


def circles(edges):
    """circles one after the other, each without the last step of those before, until none is left"""
    edges = {a: set(b) for a, b in edges.items()}
    found = []
    while way := circle(edges):
        found.append(way)
        edges[way[-2]].remove(way[-1])
    return found
