"""The same scene with the same settings is the same image, to the bit: across threads, processes and C libraries."""

import hashlib
import os
import re
import shutil
import subprocess
import sys

import pytest

import illuminant
from illuminant import core

ELEMENTARY = re.compile(
    r"a?(sin|cos|tan)h?f?|atan2f?|exp(2|10|m1)?f?|log(2|10|1p)?f?|powf?|cbrtf?|hypotf?|sincosf?|[tl]gammaf?(_r)?"
)


def test_the_core_takes_no_elementary_function_from_the_c_library():
    nm = shutil.which("nm")
    if nm is None:
        pytest.skip("no nm: the symbols of the core cannot be listed")
    listed = subprocess.run(
        [nm, "-D", core.core().__file__], capture_output=True, text=True, check=True
    ).stdout
    taken = [line.split()[-1].partition("@")[0] for line in listed.splitlines() if " U " in line]
    assert "memcpy" in taken, "the list is not that of a library"
    assert [name for name in taken if ELEMENTARY.fullmatch(name)] == []


# The C library and NumPy as they are on a processor without these.
OLDER = {
    "GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2,-FMA",
    "NPY_DISABLE_CPU_FEATURES": "AVX2 FMA3",
}

RENDER = """
import hashlib, sys, illuminant
image = illuminant.render(sys.argv[1], threads=int(sys.argv[2]), size=(48, 32), samples=8, technique=sys.argv[3],
    illumination=sys.argv[4], layers="depth,normal,albedo" if sys.argv[3] == "path" else None, elements=300)
print(hashlib.sha256(image.xyz.tobytes() + b"".join(one.tobytes() for one in image.layers.values())).hexdigest())
"""


@pytest.mark.parametrize(
    ("scene", "technique", "illumination"),
    [
        ("cornell", "path", "general"),
        ("prism", "path", "general"),
        ("demo", "distributed", "general"),
        ("cornell", "radiosity", "general"),
        ("cornell", "phong", "blinn"),
    ],
)
def test_processes_and_threads_change_no_bit(scenes, scene, technique, illumination):
    found = set()
    for threads, seed, extra in ((1, "1", {}), (2, "2", OLDER), (5, "3", {})):
        environment = {**os.environ, "PYTHONHASHSEED": seed, **extra}
        words = [
            sys.executable,
            "-c",
            RENDER,
            str(scenes / f"{scene}.toml"),
            str(threads),
            technique,
            illumination,
        ]
        done = subprocess.run(words, capture_output=True, text=True, check=True, env=environment)
        found.add(done.stdout.strip())
    image = illuminant.render(
        scenes / f"{scene}.toml",
        size=(48, 32),
        samples=8,
        technique=technique,
        illumination=illumination,
        layers="depth,normal,albedo" if technique == "path" else None,
        elements=300,
    )
    layers = b"".join(one.tobytes() for one in image.layers.values())
    found.add(hashlib.sha256(image.xyz.tobytes() + layers).hexdigest())
    assert len(found) == 1
