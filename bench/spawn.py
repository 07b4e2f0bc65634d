"""Runs one program and writes what it took, as JSON, to a file: `python spawn.py FILE PROGRAM ARGUMENT...`.

A process of its own, because a child's largest memory starts with that of the process it was forked from: measured
from a benchmark that holds a scene of 500 MB, every program would seem to take 500 MB. This one is small.
"""

import json
import os
import sys
import time

started = time.perf_counter()
process = os.posix_spawnp(sys.argv[2], sys.argv[2:], os.environ)
_, wait_status, usage = os.wait4(process, 0)
taken = {
    "wall": time.perf_counter() - started,
    "cpu": usage.ru_utime + usage.ru_stime,
    "peak": usage.ru_maxrss * (1 if sys.platform == "darwin" else 1024),
    "status": os.waitstatus_to_exitcode(wait_status),
}
with open(sys.argv[1], "w") as file:
    json.dump(taken, file)
