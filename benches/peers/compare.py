"""Runs every peer on both problems, turn about, checks that they agree and prints the medians."""

import argparse
import json
import os
import platform
import shlex
import statistics
import subprocess
import sys

from problem import PROBLEMS

PEERS = ("warp", "taichi", "taichi-serial")
# Slow; to check the others.
CHECKS = ("numpy", "numpy-gradient")
# Codes of the same scheme differ by the order of sums only; what is compared is scaled by its size.
AGREEMENT = 1e-10
MEASURED = ("updates_per_cpu_s", "updates_per_s", "bytes_per_particle")


def main():
    options = arguments()
    for peer in options.peers:
        if peer in CHECKS:
            continue
        for problem in options.problems:
            print(f"compiling {peer} {problem}", file=sys.stderr, flush=True)
            run(peer, problem, steps=1)
    prefix = shlex.split(options.prefix)
    runs = []
    for turn in range(options.repeat):
        for problem in options.problems:
            for peer in options.peers:
                print(f"turn {turn + 1}: {peer} {problem}", file=sys.stderr, flush=True)
                runs.append(run(peer, problem, options.steps, prefix))
    if options.json:
        machine = {"cpu": cpu(), "python": platform.python_version()}
        for figures in runs:
            print(json.dumps({**figures, **machine}))
    else:
        table(runs, options)
    sys.exit(1 if disagreements(runs) else 0)


def arguments():
    parser = argparse.ArgumentParser(prog="run", description=__doc__)
    parser.add_argument("--json", action="store_true", help="one JSON line a run instead of the table")
    parser.add_argument("--repeat", type=int, default=3, help="runs of each peer and problem (3)")
    parser.add_argument("--steps", type=int, help="timed steps (A: 50, B: 15)")
    parser.add_argument("--peers", nargs="+", choices=PEERS + CHECKS, default=PEERS)
    parser.add_argument("--problems", nargs="+", choices=PROBLEMS, default=list(PROBLEMS))
    parser.add_argument("--prefix", default="", help="command to start each timed run under, as 'taskset -c 1'")
    return parser.parse_args()


def run(peer, problem, steps=None, prefix=()):
    """One run in a process of its own."""
    command = [*prefix, sys.executable, os.path.join(os.path.dirname(__file__), "one.py"), peer, problem]
    if steps:
        command.append(str(steps))
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if done.returncode != 0:
        sys.exit(f"{peer} {problem} failed:\n{done.stdout}{done.stderr}")
    return json.loads(done.stdout.splitlines()[-1])


def disagreements(runs):
    """Prints and counts probes unlike those of the first run of their problem and scheme, and mass and
    momentum from what was given at the start: 1 m/s along the first axis, for the sines cancel."""
    count = 0
    for figures in runs:
        name = figures["problem"]
        problem = PROBLEMS[name]
        first = next(r for r in runs if r["problem"] == name and by_gradient(r) == by_gradient(figures))
        mass = problem.mass * problem.particles
        expected = {
            "mass": [mass],
            "momentum": [mass] + [0.0] * (problem.dim - 1),
            **{
                key: first[key] if isinstance(first[key], list) else [first[key]]
                for key in ("kinetic_energy", "stored_energy", "first_position", "first_velocity")
            },
        }
        for key, wanted in expected.items():
            found = figures[key] if isinstance(figures[key], list) else [figures[key]]
            size = max(abs(value) for value in wanted)
            # Written so that NaN disagrees.
            if not all(abs(a - b) <= AGREEMENT * size for a, b in zip(found, wanted, strict=True)):
                print(f"{figures['peer']} {name}: {key} is {found}, not {wanted}", file=sys.stderr)
                count += 1
    return count


def by_gradient(figures):
    """Whether forces come from the gradients of the functions."""
    return figures["peer"].endswith("-gradient")


def table(runs, options):
    """Speeds and memory, then the probes."""
    print(f"{cpu()}, Python {platform.python_version()}, one thread, median of {options.repeat}\n")
    print("| peer | version | problem | particles | M updates/CPU-s (least-most) | M updates/s | bytes/particle |")
    print("|---|---|---|---|---|---|---|")
    for problem in options.problems:
        for peer in options.peers:
            same = [r for r in runs if (r["peer"], r["problem"]) == (peer, problem)]
            rate, wall, size = ([r[key] for r in same] for key in MEASURED)
            print(
                f"| {peer} | {same[0]['version']} | {problem} | {same[0]['particles']} "
                f"| {statistics.median(rate) / 1e6:.2f} ({min(rate) / 1e6:.2f}-{max(rate) / 1e6:.2f}) "
                f"| {statistics.median(wall) / 1e6:.2f} | {statistics.median(size):.0f} |"
            )
    print("\n| peer | problem | steps | momentum, kg m/s | kinetic energy, J | stored energy, J | first particle, m |")
    print("|---|---|---|---|---|---|---|")
    for problem in options.problems:
        for peer in options.peers:
            one = next(r for r in runs if (r["peer"], r["problem"]) == (peer, problem))
            print(
                f"| {peer} | {problem} | {one['steps']} | {vector(one['momentum'])} "
                f"| {one['kinetic_energy']:.11f} | {one['stored_energy']:.11f} "
                f"| {vector(one['first_position'])} |"
            )


def vector(values):
    return ", ".join(f"{value:.13g}" if abs(value) > 1e-9 else f"{value:.0e}" for value in values)


def cpu():
    """The model of the processor."""
    with open("/proc/cpuinfo") as file:
        for line in file:
            if line.startswith("model name"):
                return line.split(":", 1)[1].strip()
    return platform.machine()


main()
