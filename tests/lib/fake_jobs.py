"""Runs what job.sh of a batch runs, in forks of one process that has loaded hvi: fake_jobs.py SOCKET. Most of the time of such a job is that of its imports.

A client of the socket sends a line of JSON: folder, index, environment. The fork answers with a line, its number, and when it has ended with another, its exit status.
"""

import json
import os
import signal
import socket
import sys
import traceback


class Job:
    """As subprocess.Popen of sh job.sh"""

    def __init__(self, folder, index, environment):
        self.connection = socket.socket(socket.AF_UNIX)
        self.connection.connect(environment["FAKE_JOBS"])
        self.lines = self.connection.makefile("rw")
        self.lines.write(json.dumps([str(folder), index, environment]) + "\n")
        self.lines.flush()
        self.pid = int(self.lines.readline())

    def terminate(self):
        os.kill(self.pid, signal.SIGTERM)

    def wait(self):
        return int(self.lines.readline() or -1)


def serve(path):
    import hvi.shield.decision  # noqa: F401  what the runs of a batch are made of
    from hvi.jobs import task

    waiting = socket.socket(socket.AF_UNIX)
    waiting.bind(path)
    waiting.listen()
    signal.signal(signal.SIGCHLD, signal.SIG_IGN)  # nobody waits for the forks
    print("ready", flush=True)
    while True:
        connection, _ = waiting.accept()
        if os.fork() == 0:
            break
        connection.close()
    status, lines = 1, connection.makefile("rw")
    try:
        signal.signal(signal.SIGCHLD, signal.SIG_DFL)
        waiting.close()
        folder, index, environment = json.loads(lines.readline())
        lines.write(f"{os.getpid()}\n")
        lines.flush()
        os.environ.clear()
        os.environ.update(environment)
        os.chdir(folder)
        with open(f"{index}.txt", "a") as out:
            os.dup2(out.fileno(), 1)
            os.dup2(out.fileno(), 2)
        status = task.main(index)
    except BaseException:
        traceback.print_exc()
    finally:
        sys.stdout.flush()
        sys.stderr.flush()
        lines.write(f"{status}\n")
        lines.flush()
        os._exit(status)


if __name__ == "__main__":
    serve(sys.argv[1])
