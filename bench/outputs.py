"""The G-code itself: the same bytes for any number of threads, and read without complaint by programs people print with."""

import hashlib
import shutil
import subprocess

import models
from judge import two_at_a_time
from peers import PEERS, slice_with_ours

FOLDER = models.CACHE / "outputs"
THREADS = (1, 2, 8)
# (column, check of ../shared/peers and what it is called with, what makes our file fit)
READERS = [
    ("gpx -r", "gpx-check.sh", ["r"], ["--printer", "replicator-dual"]),
    ("gpx -g", "gpx-check.sh", ["g"], ["--printer", "replicator-dual"]),
    ("printrun", "printrun-check.sh", [], ["--load", models.SETTINGS]),
]


def same_bytes(program, name):
    """What is wrong; empty where all numbers of threads give one file."""
    hashes = {}
    for threads in THREADS:
        output = FOLDER / f"{name}.gcode"
        slice_with_ours(program, name, output, [], threads)
        hashes[threads] = hashlib.sha256(output.read_bytes()).hexdigest()
    return "" if len(set(hashes.values())) == 1 else f"other bytes: {hashes}"


def read_by(program, name, title, check, arguments, settings):
    """What the reader complains of; empty where it does not."""
    output = FOLDER / f"{name}.{title.replace(' ', '')}.gcode"
    done = subprocess.run([program, "slice", *models.stl_pair(name), *settings, "-o", output, "--quiet"],
                          stderr=subprocess.PIPE, text=True)
    if done.returncode != 0:
        raise RuntimeError(f"cleancolor does not slice {name} for {title}:\n{done.stderr[-1500:]}")
    done = subprocess.run(["bash", PEERS / check, output, *arguments],
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    return "" if done.returncode == 0 else done.stdout.strip()[-500:] or f"exit code {done.returncode}"


def complaints(program, name):
    """{column: what is wrong or empty}"""
    found = {"threads": same_bytes(program, name)}
    return found | {reader[0]: read_by(program, name, *reader) for reader in READERS}


def checked(program, names):
    """Markdown table, and sentences about what is wrong."""
    if not shutil.which("gpx"):
        raise RuntimeError("gpx is not installed; run scripts/setup peers")
    FOLDER.mkdir(parents=True, exist_ok=True)
    threads = ", ".join(map(str, THREADS))
    lines = [f"| model | same bytes with {threads} threads | " + " | ".join(f"read by {r[0]}" for r in READERS) + " |",
             "|" + "---|" * (len(READERS) + 2)]
    wrong = []
    for name, found in zip(names, two_at_a_time(complaints, [(program, name) for name in names])):
        lines.append(f"| {name} | " + " | ".join("**no**" if text else "yes" for text in found.values()) + " |")
        wrong += [f"{name}, {column}: {text}" for column, text in found.items() if text]
    return "\n".join(lines) + "\n", wrong
