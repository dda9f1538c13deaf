"""One run of one peer in a process of its own: `one.py PEER PROBLEM [STEPS]` prints one JSON line."""

import importlib
import json
import sys

from problem import PROBLEMS, measure


def main():
    peer, name = sys.argv[1:3]
    steps = int(sys.argv[3]) if len(sys.argv) > 3 else None
    module = importlib.import_module("with_" + peer.split("-")[0])
    figures = measure(module.simulation(peer), PROBLEMS[name], steps)
    print(json.dumps({"peer": peer, "version": module.VERSION, **figures}))


main()
