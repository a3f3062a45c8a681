"""Files are written whole or not at all."""

import os
import resource
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from illuminant import output
from illuminant.errors import Error, ImageError, MachineError, UsageError
from illuminant.image import Image


def test_an_older_file_is_replaced_and_keeps_its_permissions(tmp_path: Path) -> None:
    path = tmp_path / "a.bin"
    path.write_bytes(b"old")
    path.chmod(0o640)
    output.write_bytes(path, b"new")
    assert path.read_bytes() == b"new"
    assert path.stat().st_mode & 0o777 == 0o640
    assert [item.name for item in tmp_path.iterdir()] == ["a.bin"]


def test_a_new_file_has_the_permissions_of_the_umask(tmp_path: Path) -> None:
    before = os.umask(0o027)
    try:
        output.write_bytes(tmp_path / "a.bin", b"new")
    finally:
        os.umask(before)
    assert (tmp_path / "a.bin").stat().st_mode & 0o777 == 0o640


def test_a_link_stays_a_link(tmp_path: Path) -> None:
    (tmp_path / "real.bin").write_bytes(b"old")
    (tmp_path / "link.bin").symlink_to("real.bin")
    output.write_bytes(tmp_path / "link.bin", b"new")
    assert (tmp_path / "link.bin").is_symlink()
    assert (tmp_path / "real.bin").read_bytes() == b"new"


def test_a_failure_leaves_the_older_file(tmp_path: Path) -> None:
    path = tmp_path / "a.bin"
    path.write_bytes(b"old")

    def fail(temporary: Path) -> None:
        assert temporary.suffix == ".bin" and temporary.parent == tmp_path
        temporary.write_bytes(b"half")
        raise OSError(28, "No space left on device")

    with pytest.raises(MachineError, match=r"a\.bin cannot be written: no space left on device\."):
        output.write(path, fail)
    assert path.read_bytes() == b"old"
    assert [item.name for item in tmp_path.iterdir()] == ["a.bin"]


def test_a_link_into_no_folder(tmp_path: Path) -> None:
    (tmp_path / "link.bin").symlink_to(tmp_path / "none" / "real.bin")
    with pytest.raises(ImageError, match=r"link\.bin cannot be written: there is no folder .*none\."):
        output.write_bytes(tmp_path / "link.bin", b"new")


_KILLED = """
import os, signal, sys
from illuminant import output
def encode(temporary):
    temporary.write_bytes(b"half")
    os.kill(os.getpid(), signal.SIGKILL)
output.write(sys.argv[1], encode)
"""


def test_what_a_killed_process_leaves_goes_when_the_file_is_written_again(tmp_path: Path) -> None:
    path = tmp_path / "a.bin"
    done = subprocess.run([sys.executable, "-c", _KILLED, str(path)], check=False, timeout=60)
    assert done.returncode == -signal.SIGKILL
    (left,) = tmp_path.iterdir()
    assert left.name.startswith(".a.illuminant-") and left.read_bytes() == b"half"
    output.write_bytes(tmp_path / "b.bin", b"another file is none of its business")
    assert left.exists()
    output.write_bytes(path, b"whole")
    assert sorted(item.name for item in tmp_path.iterdir()) == ["a.bin", "b.bin"]


def test_what_another_writes_right_now_stays(tmp_path: Path) -> None:
    path = tmp_path / "a.bin"

    def encode(temporary: Path) -> None:
        output.write_bytes(path, b"the other")
        temporary.write_bytes(b"this one")

    output.write(path, encode)
    assert path.read_bytes() == b"this one"
    assert [item.name for item in tmp_path.iterdir()] == ["a.bin"]


def test_many_write_one_file_at_a_time(tmp_path: Path) -> None:
    path = tmp_path / "a.bin"
    script = "import sys; from illuminant import output\nfor i in range(300): output.write_bytes(sys.argv[1], b'whole')"
    writers = [subprocess.Popen([sys.executable, "-c", script, str(path)]) for _ in range(4)]
    assert [writer.wait(60) for writer in writers] == [0] * 4
    assert [item.name for item in tmp_path.iterdir()] == ["a.bin"]
    assert path.read_bytes() == b"whole"


@pytest.mark.parametrize("name", ["図" * 78 + ".png", "a." + "b" * 240, "x" * 250 + ".toml", "a" * 255])
def test_a_name_as_long_as_the_file_system_takes(tmp_path: Path, name: str) -> None:
    output.write_bytes(tmp_path / name, b"whole")
    assert [item.name for item in tmp_path.iterdir()] == [name]


def test_a_link_in_a_circle(tmp_path: Path) -> None:
    (tmp_path / "a.bin").symlink_to(tmp_path / "b.bin")
    (tmp_path / "b.bin").symlink_to(tmp_path / "a.bin")
    with pytest.raises(
        ImageError, match=r"a\.bin cannot be written: it is a link that leads back to itself\."
    ):
        output.write_bytes(tmp_path / "a.bin", b"new")


def test_a_link_with_the_name_of_what_was_left_is_not_followed(tmp_path: Path) -> None:
    (tmp_path / "precious").write_bytes(b"kept")
    (tmp_path / ".a.illuminant-abcdefgh.bin").symlink_to(tmp_path / "precious")
    output.write_bytes(tmp_path / "a.bin", b"new")
    assert (tmp_path / "precious").read_bytes() == b"kept"


@pytest.mark.parametrize(
    ("name", "kind", "sentence"),
    [
        ("none/a.png", ImageError, "there is no folder"),
        ("folder", ImageError, "it is a folder"),
        ("folder.png", ImageError, "it is a folder"),
        ("a.jpg", UsageError, "has the extension .jpg"),
        ("a", UsageError, "has no extension"),
        ("pipe.png", ImageError, "it is not an ordinary file"),
    ],
)
def test_a_path_that_cannot_be_an_image(tmp_path: Path, name: str, kind: type[Error], sentence: str) -> None:
    (tmp_path / "folder").mkdir()
    (tmp_path / "folder.png").mkdir()
    os.mkfifo(tmp_path / "pipe.png")
    with pytest.raises(kind, match=sentence):
        Image(np.ones((2, 2, 3))).save(tmp_path / name)


# A limit on the size of files is the one full disk that a test can make anywhere.
_FULL = """
import resource, sys
import numpy as np
from illuminant.errors import MachineError
from illuminant.image import Image
image = Image(np.random.default_rng(0).random((300, 300, 3)))
image.save(sys.argv[1])                                    # loads everything, and makes the older file
for limit in (20_000, 3_000, 0):
    resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))
    try:
        Image(image.xyz * 2).save(sys.argv[1])
    except MachineError as error:
        print(error)
"""


@pytest.mark.skipif(not hasattr(resource, "RLIMIT_FSIZE"), reason="needs a limit on the size of files")
@pytest.mark.parametrize("name", ["a.exr", "a.png"])
def test_a_full_disk_is_one_sentence_and_nothing_is_lost(tmp_path: Path, name: str) -> None:
    path = tmp_path / name
    done = subprocess.run(
        [sys.executable, "-c", _FULL, str(path)], capture_output=True, text=True, timeout=60
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout == f"{path} cannot be written: file too large.\n" * 3
    assert [item.name for item in tmp_path.iterdir()] == [name]
    assert Image.open(path).xyz.shape == (300, 300, 3)


@pytest.mark.skipif(os.geteuid() == 0, reason="root may write anywhere")
def test_a_folder_without_permission(tmp_path: Path) -> None:
    tmp_path.chmod(0o500)
    try:
        with pytest.raises(ImageError, match="permission denied"):
            output.check(tmp_path / "a.png")
    finally:
        tmp_path.chmod(0o700)
