"""bench/scaling.py: the model of communication and imbalance, by counting in small cases; no run, no time."""

import numpy as np
import pytest
import scaling


def lattice(n):
    return np.stack(np.meshgrid(*[np.arange(k) + 0.5 for k in n], indexing="ij"), -1).reshape(-1, 3)


@pytest.mark.parametrize("ranks", [(2, 2, 1), (1, 2, 2), (2, 2, 2)])
def test_ghosts_of_a_cube(ranks):
    """those that come from others, counted: images of a rank's own are copied, but those of them that later directions send are sent"""
    side, cut = 12, 3
    widths = [side // n for n in ranks]
    sent = scaling.sent_ghosts(widths, ranks, cut, (True,) * 3)
    here, count = np.array([widths], float) / 2, 0
    for x in (lattice((3 * side,) * 3) - side):
        out = [abs(x[k] - here[0][k]) > widths[k] / 2 for k in range(3)]
        near = all(abs(x[k] - here[0][k]) < widths[k] / 2 + cut for k in range(3))
        # it comes in the last direction in which it is outside
        count += near and any(out) and ranks[max(k for k in range(3) if out[k])] > 1
    assert sent == pytest.approx(count)
    assert scaling.sent_ghosts(widths, (1, 1, 1), cut, (True,) * 3) == 0.0


def test_messages():
    """counted from side to side of a grid of ranks"""
    for ranks in ((2, 2, 1), (4, 2, 1), (3, 1, 2)):
        for around in (True, False):
            count = 0
            for r in np.ndindex(*ranks):
                for k in range(3):
                    for step in (-1, 1):
                        count += ranks[k] > 1 and (around or 0 <= r[k] + step < ranks[k])
            assert scaling.halo_messages(ranks, (around,) * 3) == count
    assert scaling.list_messages((1, 1, 1)) == 0 and scaling.list_messages((2, 1, 1)) == 2 * (2 + 2) and scaling.list_messages((4, 1, 1)) == 4 * (4 + 2)


def test_exchanges():
    """of the forms of solids"""
    assert scaling.exchanges(False) == (3, 3)
    assert scaling.exchanges(True) == (4, 3)


def column(*sides):
    return np.array([sides], float)


def test_map_counts():
    """particles in columns, and those around: on whole bins exactly, in between linear"""
    x = lattice((8, 8, 3))
    m = scaling.Map(x[:, 0], x[:, 1], np.ones(len(x)), np.arange(9.0))
    columns = np.array([[a, b, c, d] for a, b in ((0.0, 3.0), (3.0, 8.0)) for c, d in ((0.0, 3.0), (3.0, 8.0))])
    assert np.allclose(m.inside(columns), 3 * np.outer([3, 5], [3, 5]).ravel())
    assert np.allclose(m.inside(columns, 2.0), 3 * np.outer([5, 7], [5, 7]).ravel())  # nothing beyond the edges
    assert np.allclose(m.inside(column(0.0, 0.5, 0.0, 8.0)), 3 * 0.5 * 8)


def test_grid():
    """equal shares of weight in each direction, of unequal widths; not nearer than asked"""
    x = lattice((8, 8, 1))
    weight = np.where(x[:, 0] < 2, 9.0, 1.0)
    m = scaling.Map(x[:, 0], x[:, 1], weight, np.arange(9.0))
    assert np.allclose(m.cuts(1, 4), [0, 2, 4, 6, 8])
    assert np.allclose(m.inside(m.grid((4, 1))), weight.sum() / 4)
    assert m.cuts(0, 4)[1] < 1.0 and np.diff(m.cuts(0, 4, 1.0)).min() >= 1.0 - 1e-12
    assert m.grid((2, 4)).shape == (8, 4) and m.inside(m.grid((2, 4))).sum() == pytest.approx(weight.sum())


def test_between():
    """a density on its way from one map to another"""
    edges, zeros = np.arange(5.0), np.zeros(4)
    one, other = (scaling.Map(np.arange(4) + 0.5, zeros + 0.5, np.array(w, float), edges) for w in ([8, 0, 0, 0], [0, 0, 4, 4]))
    assert np.allclose([one.between(other, 0.25).inside(column(k, k + 1, 0, 1))[0] for k in range(4)], [6, 0, 1, 1])


@pytest.mark.parametrize("layout", ["grid", "bisected"])
def test_plate_steps(layout):
    """a plate that stays as it is needs no wait where columns are bisected; one whose front moves on does; eight times the particles, eight times the work"""
    x = lattice((32, 32, 1))
    edges = np.arange(33.0)

    def frame(front):
        awake = 1.0 * (np.hypot(x[:, 0], x[:, 1]) < front)
        return [scaling.Map(x[:, 0], x[:, 1], w, edges) for w in (np.ones(len(x)), awake, 0.2 + 0.8 * awake)]

    p = dict(P, cut=2.0, awake_s=1.0, asleep_s=0.2, ghost_share=0.0)
    still, moving = [[frame(16)] * 3], [[frame(16), frame(20), frame(24)]]
    one, later = (scaling.plate_steps(maps, 16, 1024, 1024, 1.0, p, layout) for maps in (still, moving))
    if layout == "bisected":
        assert one["over"] == pytest.approx(1.0, abs=1e-6) and later["over"] > 1.1
    else:
        assert one["over"] > 1.2
    assert later["alone"] == pytest.approx(0.8 * (np.hypot(x[:, 0], x[:, 1]) < 20).sum() + 0.2 * 1024)
    assert one["efficiency"] == pytest.approx(one["alone"] / 16 / (one["work"] + one["waiting"] + one["halo"] + one["reductions"]))
    finer = scaling.plate_steps(moving, 16, 8 * 1024, 1024, 1.0, p, layout)  # 12.5 steps later: beyond the frames, so the last one
    assert finer["alone"] == pytest.approx(8 * (0.8 * (np.hypot(x[:, 0], x[:, 1]) < 24).sum() + 0.2 * 1024))


@pytest.mark.parametrize("ranks", [1, 2, 3, 7, 16])
def test_bisected(ranks):
    """equal shares whatever the weights, as there are no gaps between columns"""
    x = lattice((24, 16, 1)) + [2.0, 0.0, 0.0]
    weight = 1.0 + 20.0 * (np.hypot(x[:, 0] - 5, x[:, 1]) < 4)
    m = scaling.Map(x[:, 0], x[:, 1], weight, np.arange(27.0))
    columns = m.bisected(ranks)
    assert columns.shape == (ranks, 4) and np.allclose(m.inside(columns), weight.sum() / ranks)
    assert np.prod(columns[:, 1::2] - columns[:, ::2], axis=1).sum() == pytest.approx(24 * 16)


def test_bisected_as_rcb_does():
    """across the direction in which the narrower part is the wider one: not the longer one, where the weight is at an end"""
    x = lattice((10, 6, 1))
    weight = np.where(x[:, 0] < 1, 100.0, 1.0)
    assert np.allclose(scaling.Map(x[:, 0], x[:, 1], weight, np.arange(11.0)).bisected(2), [[0, 10, 0, 3], [0, 10, 3, 6]])
    assert np.allclose(scaling.Map(x[:, 0], x[:, 1], np.ones(60), np.arange(11.0)).bisected(3), [[0, 10 / 3, 0, 6], [10 / 3, 20 / 3, 0, 6], [20 / 3, 10, 0, 6]])


def test_tiled_messages():
    """a wide column beside two narrow ones, and what is farther away"""
    columns = np.array([[0, 4, 0, 4], [4, 8, 0, 2], [4, 8, 2, 4], [8, 9, 0, 1]], float)
    assert scaling.tiled_messages(columns, 1.0).tolist() == [2, 3, 2, 1]
    assert scaling.tiled_messages(columns, 4.5).tolist() == [3, 3, 2, 2]
    four = np.array([[0, 4, 0, 4], [4, 8, 0, 4], [0, 4, 4, 8], [4, 8, 4, 8]], float)
    assert scaling.tiled_messages(four, 1.0).tolist() == [2, 2, 2, 2]  # across the corner by way of another


P = dict(forward=10, reverse=5, border=13, exchanges=(2, 1), builds=0.5, balance_reductions=50, latency=1e-6, bandwidth=1e9, owned_bytes=2.0, ghost_bytes=1.0)


def test_step_time():
    """by hand"""
    t = scaling.step_time(np.array([1.0, 3.0]), np.array([100.0, 200.0]), 4, 6, 4, P)
    assert t["work"] == 2.0 and t["waiting"] == 1.0
    assert t["halo"] == pytest.approx((6 * 3 + 0.5 * (2 * 4 + 6)) * 1e-6 + 8 * (15 + 0.5 * 5) * 200 / 1e9)
    assert t["reductions"] == pytest.approx((2 + 0.5 * 4 + 1) * 2 * 2 * 1e-6)
    tiled = scaling.step_time(np.array([1.0, 3.0]), np.array([100.0, 200.0]), 4, 6, 4, P, "bisected")
    assert tiled["halo"] == t["halo"] and tiled["reductions"] == pytest.approx((2 + 0.5 * 9 + (2 * scaling.MEDIAN + 2) * 1.5 / 50) * 2 * 2 * 1e-6)
    alone = scaling.step_time(np.array([1.0]), np.array([0.0]), 1, 4, 4, P)
    assert alone == {"work": 1.0, "waiting": 0.0, "halo": 0.0, "reductions": 0.0}
    assert scaling.memory_of_rank(10, 5, 100, P) == 20 + 5 + 400


def test_counted(tmp_path):
    """files of Open MPI's monitoring: its own messages (I) are not counted, nor calls of other communicators"""
    for rank in range(2):
        (tmp_path / f"mon.{rank}.prof").write_text(
            f"# POINT TO POINT\nE\t{rank}\t{1 - rank}\t100 bytes\t3 msgs sent\t1,2\nI\t{rank}\t{1 - rank}\t999 bytes\t9 msgs sent\n# COLLECTIVES\n"
            f"D\tMPI_COMM_SELF\tprocs: {rank}\nA2A\t{rank}\t0 bytes\t77 msgs sent\nD\tMPI_COMM_WORLD\tprocs: 0,1\nA2A\t{rank}\t50 bytes\t7 msgs sent\n")
    assert scaling.counted(str(tmp_path), 2) == (200, 6, 7)
