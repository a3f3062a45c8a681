"""The program as somebody meets it who does everything wrong: one sentence, the right exit code, nothing written."""

import os
import resource
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

Command = Callable[..., "subprocess.CompletedProcess[str]"]

BROKEN = {
    "binary.toml": b"\x7fELF\x02\x01\x01\x00\xff\xfe",
    "empty.toml": b"",
    "latin.toml": 'title = "caf\xe9"\n'.encode("latin-1"),
    "kinds.toml": b'camera = [1, 2]\nobjects = 3\nmaterials = "x"\nlights = []\n',
    "deep.toml": b"x = " + b"[" * 10_000,
    "fake.exr": b"\x7fELF not an image",
    "short.png": b"\x89PNG\r\n\x1a\n\0\0",
}
REPLACED = {
    "nan.toml": ("radius = 0.5", "radius = nan"),
    "huge.toml": ("radius = 0.5", "radius = 1e300"),
    "tiny.toml": ("radius = 0.5", "radius = 1e-300"),
    "long.toml": ("size = [32, 24]", f"size = [{10**30}, 2]"),
    "large.toml": ("size = [32, 24]", f"size = [{10**9}, {10**9}]"),
    "twice.toml": ("[materials.lamp]", "[materials.grey]"),
    "none.toml": ("sphere = { center = [0.0, 0.5, 0.0], radius = 0.5 }", 'mesh = "none.ply"'),
    "folder.toml": ("sphere = { center = [0.0, 0.5, 0.0], radius = 0.5 }", 'mesh = "folder.ply"'),
    "broken.toml": ("sphere = { center = [0.0, 0.5, 0.0], radius = 0.5 }", 'mesh = "fake.ply"'),
    "away.toml": ("target = [0.0, 0.6, 0.0]", "target = [0.0, 0.6, 9.0]"),
    "magic.toml": ("samples = 8", 'technique = "magic"'),
    "depth.toml": ("samples = 8", "depth = 0"),
}


@pytest.fixture
def folder(scene: Path) -> Path:
    """A folder with a good scene, `ball.toml`, and many broken files."""
    text = scene.read_text()
    for name, content in BROKEN.items():
        (scene.parent / name).write_bytes(content)
    for name, (old, new) in REPLACED.items():
        assert old in text, name
        (scene.parent / name).write_text(text.replace(old, new))
    (scene.parent / "fake.ply").write_bytes(b"ply\nformat nothing\n")
    (scene.parent / "folder.ply").mkdir()
    return scene.parent


LONG = "a" * 5000


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ("render missing.toml", "missing.toml: there is no such file"),
        ("render .", ". is a folder: name a scene file."),
        ("render binary.toml", "binary.toml:1: is not UTF-8 text"),
        ("render latin.toml", "latin.toml:1: is not UTF-8 text"),
        ("render short.png", "short.png:1: is not UTF-8 text"),
        ("render deep.toml", "deep.toml:1: is not valid TOML at column"),
        ("render nan.toml", "[objects.ball] sphere.radius: must be a finite number, found nan"),
        ("render huge.toml", "[objects.ball] sphere.radius: must be at most"),
        ("render tiny.toml", "[objects.ball] sphere.radius: must be at least"),
        ("render long.toml", "long.toml:6: is not valid TOML at column"),
        ("render large.toml", "[camera] size: is 1000000000 × 1000000000 pixels; at most"),
        ("render twice.toml", "twice.toml:15: is not valid TOML at column"),
        ("render none.toml", "[objects.ball] mesh: none.ply: there is no such file"),
        ("render folder.toml", "[objects.ball] mesh: folder.ply: is a folder"),
        ("render away.toml", "away.toml:4: [camera] eye: the camera sees nothing"),
        ("render magic.toml", 'magic.toml:9: [render] technique: no technique "magic"'),
        ("render depth.toml", "depth.toml:9: [render] depth: must be at least 1, found 0"),
        (f"render {LONG}.toml", "...: file name too long."),
        (f"render ball.toml -o {LONG}.png", "a.png cannot be written: file name too long."),
        ("render ball.toml -o /dev/full", "/dev/full has no extension"),
        ("render ball.toml -o full.png", "full.png cannot be written: it is not an ordinary file."),
        ("render ball.toml -o a.exr -o none/a.png", "there is no folder none."),
        ("render ball.toml -o .png", ".png has no extension"),
        ("render ball.toml --samples -5", "--samples -5: expected a whole number from 1"),
        ("render ball.toml --samples 1.5", "--samples: expected a whole number (see"),
        ("render ball.toml --samples many", "--samples: expected a whole number (see"),
        ("render ball.toml --samples", "Option '--samples' requires an argument"),
        ("render ball.toml --exposure bright", "--exposure: expected a number (see"),
        ("render ball.toml --exposure nan", "--exposure nan: expected a positive number."),
        ("render ball.toml --size 0x0", "--size 0x0: expected width and height"),
        ("render ball.toml --threads -1", "--threads -1: expected a whole number from 0"),
        (
            "render ball.toml --filter box:nan",
            "--filter box:nan: expected gaussian, box, tent, mitchell or blackman-harris",
        ),
        (
            "render ball.toml --technique magic",
            '--technique magic: no technique "magic"; known are constant, gouraud, phong, raytrace, distributed, path, '
            "radiosity, specular-radiosity, hybrid.",
        ),
        (
            "render ball.toml --sampling fitted:0",
            '--sampling fitted:0: fitted:N takes a whole number N from 1 to 32, not "0"',
        ),
        ("render ball.toml --sampling rbg", '--sampling rbg: no spectral sampling "rbg"; known are fitted:N'),
        ("render ball.toml --pixel 1", "--pixel 1: expected column and row"),
        ("render ball.toml --pixel 1,1 --sample -1", "--sample -1: expected a whole number from 0 to"),
        ("render ball.toml --sample 3", "--sample 3: goes with --pixel"),
        ("render ball.toml more.toml", "One argument is enough, and more.toml is more (see"),
        ("check .", ".: is a folder."),
        ("info .", ". cannot be read: it is a folder."),
        ("info fake.exr", "fake.exr cannot be read: it does not begin as an EXR file does."),
        ("diff short.png short.png", "short.png is not a whole PNG"),
        ("new none/a.toml", "there is no folder none."),
    ],
)
def test_one_sentence_and_nothing_written(
    folder: Path, inside: Command, arguments: str, sentence: str
) -> None:
    (folder / "full.png").symlink_to("/dev/full")
    before = sorted(folder.iterdir())
    done = inside(*arguments.split(), cwd=folder)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith("Error: ") and done.stderr.count("\n") == 1
    assert sentence in done.stderr
    assert len(done.stderr) < 400
    assert sorted(folder.iterdir()) == before


def test_a_damaged_mesh_is_one_sentence(folder: Path, inside: Command) -> None:
    done = inside("check", "broken.toml", cwd=folder)
    assert done.returncode == 1
    assert "[objects.ball] mesh: fake.ply: cannot be read as PLY (" in done.stdout
    assert done.stdout.count("\n") == 1


def test_each_mistake_has_a_line_of_its_own_and_none_is_a_consequence(folder: Path, inside: Command) -> None:
    lines = inside("render", "kinds.toml", cwd=folder).stderr.splitlines()
    assert [line.split(": must")[0] for line in lines] == [
        f"Error: kinds.toml:{i}: [{table}]"
        for i, table in enumerate(("camera", "objects", "materials", "lights"), start=1)
    ]
    lines = inside("render", "empty.toml", cwd=folder).stderr.splitlines()
    assert len(lines) == 3 and all(line.startswith("Error: empty.toml: ") for line in lines)


def test_names_in_any_script(folder: Path, inside: Command) -> None:
    text = (folder / "ball.toml").read_text()
    text = text.replace("[materials.grey]", '[materials."grün 図"]').replace('"grey"', '"grün 図"')
    (folder / "mâché 図.toml").write_text(text, encoding="utf-8")
    done = inside("render", "mâché 図.toml", "-o", "bild 図.png", "-o", "bild 図.png", cwd=folder)
    assert done.returncode == 0
    assert done.stderr.startswith("bild 図.png: ")
    assert (folder / "bild 図.png").read_bytes().startswith(b"\x89PNG")


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs /dev/full")
def test_a_full_standard_output_is_one_sentence() -> None:
    with open("/dev/full", "w") as full:
        done = subprocess.run(
            [sys.executable, "-m", "illuminant", "spectra", "list"],
            stdout=full,
            stderr=subprocess.PIPE,
            text=True,
            check=False,
        )
    assert done.returncode == 3
    assert done.stderr.splitlines()[0] == "Error: The output cannot be written: no space left on device."
    assert "Traceback" not in done.stderr


def test_a_limit_of_memory_is_met_before_the_work(folder: Path) -> None:
    def limit() -> None:
        resource.setrlimit(resource.RLIMIT_AS, (2**30, 2**30))

    program = Path(sys.executable).with_name("illuminant")
    done = subprocess.run(
        [str(program), "render", "ball.toml", "--size", "8000x8000", "-o", "a.png"],
        cwd=folder,
        preexec_fn=limit,
        capture_output=True,
        text=True,
        env={**os.environ, "OPENBLAS_NUM_THREADS": "1"},
        check=False,
    )
    assert done.returncode == 3
    assert done.stderr.startswith("Error: An image of 64,000,000 pixels") and done.stderr.count("\n") == 1
    assert not (folder / "a.png").exists()
