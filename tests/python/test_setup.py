"""What the set-up does when something is wrong: each case ends in one line that says what to do."""

import functools
import hashlib
import http.server
import os
import subprocess
import tarfile
import threading

import pytest

TARBALL = "lammps_20250204+dfsg.1.orig.tar.xz"
NOWHERE = "http://127.0.0.1:9"  # the discard port: refused at once


@pytest.fixture
def fetch(root, tmp_path):
    def run(version="20250204", cache=tmp_path / "cache", **env):
        env = {**os.environ, "HVI_CACHE": str(cache), "HVI_MIRROR": NOWHERE, "HVI_LAMMPS_GIT": str(tmp_path / "none.git"),
               "HVI_RETRIES": "0", "no_proxy": "127.0.0.1", **env}
        return subprocess.run([root / "cmake" / "fetch.sh", version], env=env, text=True, capture_output=True, timeout=120)

    return run


@pytest.fixture
def mirror(tmp_path):
    """a Debian mirror on this machine; value: (address, folder of the tarballs)"""
    pool = tmp_path / "mirror" / "pool" / "main" / "l" / "lammps"
    pool.mkdir(parents=True)

    class Quiet(http.server.SimpleHTTPRequestHandler):
        def log_message(self, *args):
            pass

    handler = functools.partial(Quiet, directory=str(tmp_path / "mirror"))
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_address[1]}", pool
        server.shutdown()


def last_line(result):
    lines = result.stderr.strip().splitlines()
    assert lines, result
    return lines[-1]


def git(folder, *args):
    name = ["-c", "user.name=t", "-c", "user.email=t@t", "-c", "init.defaultBranch=m"]
    subprocess.run(["git", *name, *args], cwd=folder, check=True, capture_output=True)


def test_no_network(fetch, tmp_path):
    r = fetch()
    assert r.returncode == 1 and r.stdout == ""
    assert "check the network" in last_line(r) and "LAMMPS_SOURCE_DIR" in last_line(r)
    assert not (tmp_path / "cache" / "lammps-20250204").exists()


def test_unstable_may_have_moved_on(fetch):
    r = fetch("20260704")
    assert r.returncode == 1
    assert "unstable may have moved on" in last_line(r) and "LAMMPS_SOURCE_DIR" in last_line(r)


def test_wrong_checksum(fetch, mirror, tmp_path):
    address, pool = mirror
    (pool / TARBALL).write_bytes(b"not LAMMPS")
    r = fetch(HVI_MIRROR=address)
    assert r.returncode == 1
    assert "wrong checksum" in last_line(r) and "HVI_MIRROR" in last_line(r)
    assert hashlib.sha256(b"not LAMMPS").hexdigest() in last_line(r)
    # nothing of it stays behind
    assert not [p for p in (tmp_path / "cache").rglob("*") if p.is_file() and p.name != "lock-source"]


def test_damaged_cache_is_fetched_again(fetch, tmp_path):
    damaged = tmp_path / "cache" / "downloads" / "lammps_20250204.orig.tar.xz"
    damaged.parent.mkdir(parents=True)
    damaged.write_bytes(b"half of it")
    r = fetch()
    assert r.returncode == 1 and "wrong checksum: fetching it again" in r.stderr
    assert not damaged.exists()


@pytest.mark.parametrize("version, good", [("4 Feb 2025", True), ("1 Jan 2024", False)])
def test_from_git_when_debian_has_it_not(fetch, tmp_path, version, good):
    source = tmp_path / "lammps"
    (source / "src").mkdir(parents=True)
    (source / "src" / "version.h").write_text(f'#define LAMMPS_VERSION "{version}"\n')
    git(source, "init")
    git(source, "add", ".")
    git(source, "commit", "-m", "x")
    git(source, "tag", "patch_4Feb2025")
    leftover = tmp_path / "cache" / "unpack-20250204.1"  # of an interrupted run
    leftover.mkdir(parents=True)
    r = fetch(HVI_LAMMPS_GIT=f"file://{source}")
    final = tmp_path / "cache" / "lammps-20250204"
    assert not leftover.exists()
    if good:
        assert r.returncode == 0, r.stderr
        assert r.stdout.strip() == str(final) and (final / "src" / "version.h").exists()
        again = fetch()  # needs no network any more
        assert again.returncode == 0 and again.stderr == ""
    else:
        assert r.returncode == 1 and "not LAMMPS 4 Feb 2025" in last_line(r)
        assert not final.exists()


def test_unknown_version(fetch):
    r = fetch("20190101")
    assert r.returncode == 1 and "use 20250204 or 20260704" in last_line(r)


def make(root, tmp_path, *args):
    command = ["make", "-C", root, f"BUILD={tmp_path / 'b'}", "DEPS=no", *args]
    env = {k: v for k, v in os.environ.items() if k not in ("MAKEFLAGS", "MAKELEVEL", "MFLAGS")}
    return subprocess.run([str(c) for c in command], env=env, text=True, capture_output=True, timeout=300)


def complaints(result):
    assert result.returncode != 0
    return [line for line in result.stderr.splitlines() if line and not line.startswith(("make", "gmake"))]


def fake_lammps(folder, version):
    (folder / "src").mkdir(parents=True)
    (folder / "cmake").mkdir()
    (folder / "src" / "version.h").write_text(f'#define LAMMPS_VERSION "{version}"\n')
    (folder / "cmake" / "CMakeLists.txt").write_text(
        'cmake_minimum_required(VERSION 3.16)\nproject(x NONE)\nmessage(FATAL_ERROR "broken tree")\n')
    return folder


def test_untested_version(root, tmp_path):
    source = fake_lammps(tmp_path / "old", "2 Aug 2023")
    lines = complaints(make(root, tmp_path, f"LAMMPS_SOURCE_DIR={source}"))
    assert len(lines) == 1 and lines[0].startswith("lammps-hvi: ")
    assert "2 Aug 2023" in lines[0] and "4 Feb 2025 or 4 Jul 2026" in lines[0] and "ALLOW_UNTESTED" in lines[0]
    # with the permission it goes on to LAMMPS's own cmake
    lines = complaints(make(root, tmp_path, f"LAMMPS_SOURCE_DIR={source}", "ALLOW_UNTESTED=yes"))
    assert len(lines) == 1 and "broken tree" in lines[0]


def test_source_dir_is_no_lammps(root, tmp_path):
    lines = complaints(make(root, tmp_path, f"LAMMPS_SOURCE_DIR={tmp_path}"))
    assert len(lines) == 1 and "not a LAMMPS source tree" in lines[0]


def test_no_mpi(root, tmp_path):
    source = fake_lammps(tmp_path / "lammps", "4 Feb 2025")
    lines = complaints(make(root, tmp_path, f"LAMMPS_SOURCE_DIR={source}", "CMAKE_ARGS=-DCMAKE_DISABLE_FIND_PACKAGE_MPI=ON"))
    assert len(lines) == 1 and "no MPI found" in lines[0] and "openmpi-bin libopenmpi-dev" in lines[0]


def test_missing_libraries(root, tmp_path):
    source = fake_lammps(tmp_path / "lammps", "4 Feb 2025")
    lines = complaints(make(root, tmp_path, f"LAMMPS_SOURCE_DIR={source}", "CMAKE_ARGS=-DCMAKE_DISABLE_FIND_PACKAGE_PNG=ON"))
    assert len(lines) == 1 and lines[0].endswith("libpng-dev)")


def fake_debian(tmp_path, **programs):
    """deps.sh build with these programs, others in place of those that change a machine; what apt-get was called with is in calls"""
    fake = tmp_path / "bin"
    fake.mkdir()
    calls = tmp_path / "calls"
    for name, text in {"id": "echo 0", "sudo": "exit 1", "dpkg-query": f"[ -e {calls}.done ] && for p in \"$@\"; do echo installed $p; done; true",
                       "apt-get": f"echo \"$@\" >>{calls}; case \"$*\" in *install*) touch {calls}.done;; esac", **programs}.items():
        (fake / name).write_text(f"#!/bin/sh\n{text}\n")
        (fake / name).chmod(0o755)
    return calls, {**os.environ, "PATH": f"{fake}:{os.environ['PATH']}", "DEPS": "yes"}


def test_root_is_told_what_is_done_before(root, tmp_path):
    """the whole command, and how to refuse it; with DEPS=no nothing is called"""
    calls, env = fake_debian(tmp_path)
    r = subprocess.run([root / "cmake" / "deps.sh", "build"], text=True, capture_output=True, env={**env, "DEPS": "no"})
    assert (r.returncode, r.stderr, calls.exists()) == (0, "", False)
    r = subprocess.run([root / "cmake" / "deps.sh", "build"], text=True, capture_output=True, env=env)
    assert r.returncode == 0, r.stderr
    said, = r.stderr.splitlines()
    assert said.startswith("lammps-hvi: as root: apt-get update && apt-get install ") and said.endswith("(DEPS=no: nothing is installed)")
    did = [line.partition("install ")[2].split() for line in calls.read_text().splitlines() if " install " in line]
    assert did == [said.partition(" install ")[2].partition("   (")[0].split()] and "g++" in did[0]


def test_it_is_said_before_it_is_done(root, tmp_path):
    """an apt-get that stops at once has been announced"""
    calls, env = fake_debian(tmp_path, **{"apt-get": "kill -9 $PPID"})
    r = subprocess.run([root / "cmake" / "deps.sh", "build"], text=True, capture_output=True, env=env)
    assert r.stderr.startswith("lammps-hvi: as root: apt-get update && ") and not calls.exists()


def test_missing_packages_without_root(root, tmp_path):
    """an ordinary user without sudo is told the one command"""
    fake = tmp_path / "bin"
    fake.mkdir()
    for name, text in {"id": "echo 1000", "sudo": "exit 1", "dpkg-query": "exit 1", "apt-get": "exit 1"}.items():
        (fake / name).write_text(f"#!/bin/sh\n{text}\n")
        (fake / name).chmod(0o755)
    r = subprocess.run([root / "cmake" / "deps.sh", "build"], text=True, capture_output=True,
                       env={**os.environ, "PATH": f"{fake}:{os.environ['PATH']}", "DEPS": "yes"})
    assert r.returncode == 1
    assert len(r.stderr.splitlines()) == 1 and "apt-get install" in r.stderr and "libopenmpi-dev" in r.stderr


def test_source_archive(root, tmp_path):
    """make dist: what git has of the last commit, in a folder with the version, and its checksum"""
    if subprocess.run(["git", "-C", root, "rev-parse", "HEAD"], capture_output=True).returncode:
        pytest.skip("not a clone")
    subprocess.run(["make", "dist", f"BUILD={tmp_path}"], cwd=root, check=True, capture_output=True)
    (archive,) = tmp_path.glob("lammps-hvi-*.tar.gz")
    subprocess.run(["sha256sum", "--check", f"{archive.name}.sha256"], cwd=tmp_path, check=True, capture_output=True)
    with tarfile.open(archive) as tar:
        names = {member.name.removeprefix(archive.name.removesuffix(".tar.gz") + "/") for member in tar if member.isfile()}
    tracked = subprocess.run(["git", "-C", root, "ls-tree", "-r", "-z", "--name-only", "HEAD"], check=True, capture_output=True, text=True).stdout
    assert names == set(tracked.split("\0")) - {""}
