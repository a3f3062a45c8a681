"""What the machine must have: a processor, Embree, memory."""

import os
import re
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

from illuminant import embree, machine, processor
from illuminant.errors import MachineError, UsageError
from illuminant.settings import Settings

Command = Callable[..., "subprocess.CompletedProcess[str]"]
HASWELL = set(processor.REQUIRED)


def test_a_processor_of_the_level_passes() -> None:
    processor.check(HASWELL)
    assert processor.missing(HASWELL) == []


def test_an_older_processor_is_refused_in_one_sentence() -> None:
    with pytest.raises(MachineError) as caught:
        processor.check(HASWELL - {"avx2", "fma"})
    assert str(caught.value).startswith(
        "This processor lacks AVX2, FMA: illuminant is compiled for x86-64-v3"
    )
    assert caught.value.exit_code == 3


def test_elsewhere_than_on_linux_nothing_is_checked(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(processor.platform, "machine", lambda: "aarch64")
    assert processor.features() is None
    processor.check()


def test_embree_is_found_without_importing_its_package() -> None:
    import subprocess
    import sys

    # In a process of its own: other tests read meshes, and that imports it.
    code = "import sys; from illuminant import embree; print(embree.find().name, 'embreex' in sys.modules)"
    found = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
    assert found.startswith("libembree4") and found.split()[1] == "False"


def test_a_named_library_wins_and_must_be_there(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    (tmp_path / "libembree4.so").write_bytes(b"no library")
    monkeypatch.setenv(embree.VARIABLE, str(tmp_path / "libembree4.so"))
    assert embree.find() == tmp_path / "libembree4.so"
    monkeypatch.setenv(embree.VARIABLE, str(tmp_path / "none.so"))
    with pytest.raises(MachineError, match=r"ILLUMINANT_EMBREE names .*none\.so, which is not a file"):
        embree.find()


def test_no_embree_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv(embree.VARIABLE, raising=False)
    monkeypatch.setattr(embree.importlib.util, "find_spec", lambda name: None)
    with pytest.raises(MachineError, match=r"was not found: install it with `pip install embreex`"):
        embree.find()


def test_a_wrong_library_says_what_to_install(scene: Path, command: Command) -> None:
    library = scene.with_name("libembree4.so")
    library.write_bytes(b"no library")
    done = command("render", scene, env={**os.environ, embree.VARIABLE: str(library)})
    assert done.returncode == 3
    assert re.fullmatch(
        rf"Error: {library} cannot be used as Embree 4 \(.+\): install it with `pip install embreex`, .+\n",
        done.stderr,
    )


def test_an_image_too_large_for_the_memory_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    from illuminant.film_memory import check_memory

    monkeypatch.setattr(machine, "memory_available", lambda: 10**9)
    check_memory(Settings(), 960 * 540)
    with pytest.raises(
        MachineError, match=r"67,108,864 pixels .* needs about .*B of memory, and 1\.0 GB are free"
    ):
        check_memory(Settings(keep_spectra=True), 2**26)


@pytest.mark.parametrize(
    ("option", "value", "sentence"),
    [
        ("size", "0x5", "expected width and height"),
        ("size", "10", "expected width and height"),
        ("size", f"{10**9}x{10**9}", "that is 1e+18 pixels"),
        ("time", "-3s", "expected a time"),
        ("time", "fast", "expected a time"),
        ("error", "120%", "expected a relative error"),
        ("error", "nan", "expected a relative error"),
        ("filter", "lanczos", "expected gaussian, box, tent, mitchell or blackman-harris"),
        ("filter", "box:99", "expected gaussian, box, tent, mitchell or blackman-harris"),
        ("layers", "depth,dept", "--layers dept: there is no such layer"),
        ("samples", 0, "expected a whole number from 1"),
        ("seed", -1, "expected a whole number from 0"),
        ("depth", 1.5, "expected a whole number from 1"),
        ("frames", 2, "no render option 'frames'"),
    ],
)
def test_an_option_that_cannot_be_is_one_sentence(option: str, value: object, sentence: str) -> None:
    from illuminant.settings import resolve

    with pytest.raises(UsageError) as caught:
        resolve({}, **{option: value})
    assert sentence in str(caught.value)
    assert "\n" not in str(caught.value)


def test_options_win_over_the_scene_and_the_scene_over_defaults() -> None:
    from illuminant.settings import resolve

    scene = {"samples": 256, "seed": 5, "filter": {"kind": "tent", "radius": 2.0}, "exposure": 0.1}
    assert resolve(scene).samples == 256
    assert resolve(scene, samples=4).samples == 4
    assert resolve(scene, time="10s").samples is None
    assert resolve(scene, error=0.01, samples=512).samples == 512
    assert resolve(scene).filter == ("tent", 2.0)
    assert resolve({}).samples == 64
