"""Memory depends on image and scene, not on the number of samples."""

import subprocess
import sys

PROGRAM = """
import resource, sys
import illuminant
samples = int(sys.argv[2])
image = illuminant.render(
    sys.argv[1], size=(20, 20), samples=samples, threads=2, sampling="uniform:4", depth=3
)
assert image.statistics["samples"] == 20 * 20 * samples
print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)
"""


def peak(scene, samples):
    command = [sys.executable, "-W", "ignore", "-c", PROGRAM, str(scene), str(samples)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=300, check=True)
    return int(done.stdout)


def test_peak_memory_at_16_and_4096_samples_differs_by_less_than_5_percent(scenes):
    """1.6 million paths against 6,400: two bytes kept for each would be 5 % of a process of 60 MB."""
    few, many = (peak(scenes / "cornell.toml", samples) for samples in (16, 4096))
    assert abs(many / few - 1) < 0.05, (few, many)
