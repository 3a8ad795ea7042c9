#!/usr/bin/env python3
"""frontier_runs.py SCANOUT RUNS ARGUMENTS...: do several runs of `scanout frontier ARGUMENTS` find the same frontier but for ties?

Every configuration on the frontier of a run is on that of each other run, or something as good stands there: it errs no more by a
tenth of a code, as squares add up, or by a fiftieth, and its time in proportion to the picture as asked for may be as short (the
intervals overlap, of which those of a frontier hold together with 95 %). Prints each configuration with the number of runs that have it, and those that have nothing as good in some run; exit code 1
where there is one.
"""
import collections
import json
import subprocess
import sys
import tempfile


class Run:
    """A frontier: its points with options, error, and CPU time in proportion to the picture as asked for."""

    def __init__(self, report):
        points = report["points"]
        self.frontier = [
            (points[f["point"]]["options"], points[f["point"]]["rmse_codes"], f["times_as_long"]["low"], f["times_as_long"]["high"])
            for f in report["frontier"]
        ]
        self.names = {point[0] for point in self.frontier}

    def has_as_good(self, point):
        name, error, _, high = point
        return name in self.names or any(
            (e ** 2 <= error ** 2 + 0.1 ** 2 or 0.98 * e <= error) and low <= high for _, e, low, _ in self.frontier)


def main():
    scanout, runs, arguments = sys.argv[1], int(sys.argv[2]), sys.argv[3:]
    found = []
    with tempfile.NamedTemporaryFile() as report:
        for _ in range(runs):
            subprocess.run([scanout, "frontier", *arguments, f"--json={report.name}"], check=True, stdout=subprocess.DEVNULL)
            found.append(Run(json.load(open(report.name))))
    times = collections.Counter(name for run in found for name in run.names)
    for name, count in times.most_common():
        print(f"{count:3} of {runs}  {name or 'as asked for'}")
    missing = [(i, j, point) for i, a in enumerate(found) for j, b in enumerate(found) for point in a.frontier
               if not b.has_as_good(point)]
    lacking = collections.Counter((point[0], point[1]) for _, _, point in missing)
    for (name, error), count in lacking.most_common():
        print(f"{name or 'as asked for'} ({error:.3f} codes): nothing as good in the other run, {count} times")
    sizes = [len(run.frontier) for run in found]
    print(f"{runs} runs of {min(sizes)} to {max(sizes)} points; {len(missing)} of {sum(sizes) * (runs - 1)} comparisons differ by "
          "more than ties")
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
