"""Checkpoints: a render that was cut off goes on to the bits of one that was not; wrong files are refused."""

import json
import os
import random
import signal
import threading
import time
from contextlib import nullcontext
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import illuminant
from illuminant.checkpoint import FIRST_LINE, Checkpoint, Keeper
from illuminant.errors import DataError, Interrupted, MachineError, UsageError
from illuminant.form_factor_rows import Rows, joined
from illuminant.job import Job
from illuminant.rendering import RenderInterrupted

SMALL = {"size": (40, 24), "samples": 24}
KINDS = [
    {"technique": "path"},
    {"technique": "path", "caustics": True},
    {"technique": "path", "error": 0.2, "samples": 128},
    {"technique": "path", "sampling": "uniform:20", "keep_spectra": True, "lamps": True},
    {"technique": "distributed", "illumination": "hall", "sampler": "jittered"},
    {"technique": "phong", "illumination": "phong", "layers": "terms"},
    {"technique": "radiosity", "elements": 300, "form_factors": "rays:64"},
    {"technique": "hybrid", "elements": 200, "form_factors": "rays:64"},
]


class Cut:
    """A progress that ends a render at its so many-th report."""

    def __init__(self, reports: int) -> None:
        self.left = reports

    def __call__(self, progress: object) -> bool:
        """Count a report."""
        self.left -= 1
        return self.left > 0


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: "-".join(map(str, kind.values())))
def test_a_render_that_was_cut_off_goes_on_to_the_same_bits(scenes, tmp_path, kind, same):
    options = {**SMALL, **kind}
    whole = illuminant.render(scenes / "cornell.toml", **options)
    file, chance = tmp_path / "image.ckpt", random.Random(3)
    for attempt in range(40):
        before = Checkpoint.read(file) if file.exists() else None
        job = Job(scenes / "cornell.toml", checkpoint=before, threads=1 + attempt % 2, **options)
        cut = Cut(chance.randint(1, 3)) if attempt < 3 else None
        for _ in job.passes(cut, Keeper(file)):
            pass
        if not job.stopped:
            break
    same(job.image(), whole)


class Dying(Keeper):
    """Keeps so many checkpoints, and then the process dies."""

    def __init__(self, file: Path, keeps: int) -> None:
        super().__init__(file, every=0.0)
        self.left = keeps

    def keep(self, job: Job) -> bool:
        """Keep one, or die."""
        kept = super().keep(job)
        self.left -= 1
        if self.left == 0:
            raise SystemExit
        return kept


def test_form_factors_that_were_found_are_not_found_again(scenes, tmp_path, same):
    options = {**SMALL, "technique": "radiosity", "elements": 300, "form_factors": "rays:64"}
    whole = illuminant.render(scenes / "cornell.toml", **options)
    file, before = tmp_path / "image.ckpt", None
    kept = []
    for keeps in (2, 1, 0):
        with pytest.raises(SystemExit) if keeps else nullcontext():
            job = Job(scenes / "cornell.toml", checkpoint=before, keeper=Dying(file, keeps), **options)
        before = Checkpoint.read(file)
        if keeps:
            assert (before.done, before.end, before.samples, before.part) == (0, 0, 0, b"")
            kept.append(before)
    # A row and two more, then another.
    assert [len(Rows.from_bytes(one.rows)) for one in kept] == [3, 4]
    list(job.passes(None, Keeper(file)))
    same(job.image(), whole)
    last = Checkpoint.read(file)
    assert last.solution
    assert not last.rows
    # Who has no keeper goes on from them too.
    job = Job(scenes / "cornell.toml", checkpoint=kept[0], **options)
    list(job.passes())
    same(job.image(), whole)


def test_ctrl_c_keeps_the_form_factors_so_far(scenes, tmp_path, monkeypatch):
    options = {**SMALL, "technique": "radiosity", "elements": 300, "form_factors": "rays:64"}

    def interrupt(*_: object) -> bool:
        raise KeyboardInterrupt

    monkeypatch.setattr(Keeper, "due", interrupt)
    with pytest.raises(Interrupted, match=r"a\.ckpt holds the form factors that were found"):
        illuminant.render(scenes / "cornell.toml", checkpoint=tmp_path / "a.ckpt", **options)
    assert len(Rows.from_bytes(Checkpoint.read(tmp_path / "a.ckpt").rows)) == 1


def test_ctrl_c_ends_rows_that_take_long(scenes, tmp_path):
    options = {
        **SMALL,
        "technique": "radiosity",
        "elements": 300,
        "form_factors": "rays:1000000",
        "threads": 1,
    }
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    timer = threading.Timer(4.0, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    begin = time.monotonic()
    try:
        with pytest.raises((Interrupted, KeyboardInterrupt)):
            illuminant.render(scenes / "cornell.toml", checkpoint=tmp_path / "a.ckpt", **options)
        assert time.monotonic() - begin < 30.0
    finally:
        timer.cancel()
        signal.signal(signal.SIGINT, before)


def test_rows_that_are_not_of_the_scene_are_refused(scenes, tmp_path):
    options = {**SMALL, "technique": "radiosity", "elements": 300, "form_factors": "rays:64"}
    with pytest.raises(SystemExit):
        Job(scenes / "cornell.toml", keeper=Dying(tmp_path / "a.ckpt", 1), **options)
    kept = Checkpoint.read(tmp_path / "a.ckpt")
    rows = Rows.from_bytes(kept.rows)
    many = joined([replace(rows, first=i * len(rows)) for i in range(2000)])
    wide = replace(rows, columns=rows.columns + 100_000)
    negative = replace(rows, values=-rows.values)
    nothing = replace(rows, values=rows.values * float("nan"))
    for wrong in (many, wide, negative, nothing, replace(rows, starts=rows.starts[::-1].copy())):
        with pytest.raises(DataError, match="form factors of the checkpoint are damaged"):
            Job(scenes / "cornell.toml", checkpoint=replace(kept, rows=wrong.to_bytes()), **options)
    for content in (kept.rows[:-1], kept.rows[:9], b"\xff" * 16):
        with pytest.raises(DataError, match="damaged"):
            Rows.from_bytes(content)
    replace(kept, done=1, end=1).write(tmp_path / "b.ckpt")
    with pytest.raises(DataError, match="damaged: its header cannot be"):
        Checkpoint.read(tmp_path / "b.ckpt")


def test_a_range_that_was_cut_off_is_completed_before_its_noise_decides(scenes, tmp_path, same):
    """Half a range of more samples in some tiles would look as if the image were good enough, or not."""
    options = {"size": (64, 48), "error": 0.04, "samples": 1024}
    whole = illuminant.render(scenes / "cornell.toml", **options)
    assert whole.settings["samples"] > 64
    for cut in (64, whole.settings["samples"] // 2 // 64 * 64):
        job = Job(scenes / "cornell.toml", **options)
        for done in job.passes():
            if done >= cut:
                break
        job.under_way = job.next_end()
        job.core_render.run(job.done, job.under_way, tiles=(0, 5))
        job.checkpoint().write(tmp_path / "image.ckpt")
        later = Job(scenes / "cornell.toml", checkpoint=Checkpoint.read(tmp_path / "image.ckpt"), **options)
        list(later.passes())
        same(later.image(), whole)


def test_fewer_samples_than_there_are_cannot_be_asked_for(scenes):
    job = Job(scenes / "cornell.toml", size=(40, 24), samples=128)
    next(job.passes())
    job.core_render.run(0, 64, tiles=(0, 1))
    with pytest.raises(UsageError, match="--samples 16: the checkpoint holds up to 64 of a pixel"):
        Job(scenes / "cornell.toml", size=(40, 24), samples=16, checkpoint=job.checkpoint())


def test_ctrl_c_while_a_checkpoint_is_written_keeps_the_image(scenes, tmp_path, monkeypatch):
    def interrupt(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(Checkpoint, "write", interrupt)
    with pytest.raises(RenderInterrupted) as caught:
        illuminant.render(scenes / "cornell.toml", **SMALL, checkpoint=tmp_path / "image.ckpt")
    assert caught.value.image.statistics["least_samples"] == 24


def test_a_checkpoint_goes_where_a_link_leads(scenes, tmp_path):
    (tmp_path / "far").mkdir()
    (tmp_path / "image.ckpt").symlink_to(tmp_path / "far" / "real.ckpt")
    illuminant.render(scenes / "cornell.toml", **SMALL, checkpoint=tmp_path / "image.ckpt")
    assert (tmp_path / "image.ckpt").is_symlink()
    assert Checkpoint.read(tmp_path / "far" / "real.ckpt").done == 24
    assert [item.name for item in (tmp_path / "far").iterdir()] == ["real.ckpt"]


def test_more_samples_can_be_asked_for_later(scenes, tmp_path, same):
    file = tmp_path / "image.ckpt"
    illuminant.render(scenes / "cornell.toml", size=(40, 24), samples=8, checkpoint=file)
    more = illuminant.render(scenes / "cornell.toml", **SMALL, checkpoint=file, resume=True)
    same(more, illuminant.render(scenes / "cornell.toml", **SMALL))


def test_checkpoints_are_written_on_the_way(scenes, tmp_path, same):
    file, seen = tmp_path / "image.ckpt", []

    class Watched(Keeper):
        def keep(self, job: Job) -> bool:
            kept = super().keep(job)
            seen.append(Checkpoint.read(file).seconds)
            return kept

    job = Job(scenes / "cornell.toml", size=(128, 128), samples=64)
    assert list(job.passes(None, Watched(file, every=0.15)))[-1] == 64
    assert len(seen) > 2
    assert seen == sorted(seen)
    same(job.image(), illuminant.render(scenes / "cornell.toml", size=(128, 128), samples=64))


def test_a_checkpoint_of_another_render_is_refused_with_what_differs(scenes, tmp_path):
    file = tmp_path / "image.ckpt"
    illuminant.render(scenes / "cornell.toml", **SMALL, checkpoint=file)
    for options, words in (
        ({"seed": 7}, "seed was 0 and is 7"),
        ({"technique": "distributed"}, "technique was path and is distributed"),
        ({"size": (40, 25)}, "the scene has changed; size was [40, 24] and is [40, 25]"),
        ({"layers": "depth"}, 'layers was [] and is ["depth"]'),
    ):
        with pytest.raises(UsageError) as caught:
            illuminant.render(scenes / "cornell.toml", **{**SMALL, **options}, checkpoint=file, resume=True)
        assert words in str(caught.value)
    with pytest.raises(UsageError, match="the scene has changed"):
        illuminant.render(scenes / "demo.toml", **SMALL, checkpoint=file, resume=True)
    with pytest.raises(UsageError, match="--resume, or remove it"):
        illuminant.render(scenes / "cornell.toml", **SMALL, checkpoint=file)
    kept = Checkpoint.read(file)
    older = replace(kept, identity={**kept.identity, "version": "0.0.1"})
    with pytest.raises(UsageError, match=r"version was 0\.0\.1 and is"):
        Job(scenes / "cornell.toml", checkpoint=older, **SMALL)


def test_samples_of_counted_samplers_are_part_of_the_identity(scenes, tmp_path):
    file = tmp_path / "image.ckpt"
    illuminant.render(scenes / "cornell.toml", **SMALL, sampler="stratified", checkpoint=file)
    with pytest.raises(UsageError, match="samples was 24 and is 48"):
        illuminant.render(
            scenes / "cornell.toml",
            **{**SMALL, "samples": 48},
            sampler="stratified",
            checkpoint=file,
            resume=True,
        )


@settings(max_examples=300)
@given(at=st.integers(0, 10_000), bit=st.integers(0, 7), cut=st.booleans())
def test_any_damage_is_found(at, bit, cut):
    whole = _bytes(Checkpoint({"seed": 0}, 64, 64, 9, 1.5, bytes(range(100)), b"solution"))
    at %= len(whole)
    damaged = whole[:at] if cut else whole[:at] + bytes([whole[at] ^ 1 << bit]) + whole[at + 1 :]
    with pytest.raises(DataError):
        Checkpoint.from_bytes(damaged)


def _bytes(checkpoint: Checkpoint) -> bytes:
    """What `write` writes."""
    import tempfile

    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "one")
        checkpoint.write(file)
        assert [path.name for path in Path(folder).iterdir()] == ["one"]
        return file.read_bytes()


@pytest.mark.parametrize(
    "header",
    [
        {"identity": []},
        {"done": -1},
        {"done": 1.5},
        {"end": 0},
        {"samples": 2**70},
        {"seconds": 1e400},
        {"blocks": [0, 2**70]},
        {"blocks": [-5, 5]},
        {"blocks": None},
        None,
    ],
)
def test_a_header_that_cannot_be_is_refused_even_with_the_right_digest(header):
    import hashlib
    import struct

    whole = {"identity": {}, "done": 1, "end": 1, "samples": 1, "seconds": 1, "blocks": [0, 0, 0]}
    text = json.dumps(header and whole | header).encode()
    content = FIRST_LINE + struct.pack("<Q", len(text)) + text
    with pytest.raises(DataError, match="damaged"):
        Checkpoint.from_bytes(content + hashlib.sha256(content).digest())


def test_a_part_of_another_film_is_refused(scenes, same):
    job = Job(scenes / "cornell.toml", **SMALL)
    other = Job(scenes / "cornell.toml", size=(8, 8), samples=1)
    for one in (job, other):
        list(one.passes())
    with pytest.raises(DataError, match="its pixels differ"):
        job.join(other.core_render.part())
    before = job.image()
    with pytest.raises(DataError, match="samples 0 to 24 of tile 0 are in the render already"):
        job.join(job.core_render.part())
    with pytest.raises(DataError, match="damaged"):
        job.join(job.core_render.part()[:-3])
    same(job.image(), before)


def test_a_full_disk_costs_the_newest_checkpoint_and_no_more(scenes, tmp_path, monkeypatch):
    file, told = tmp_path / "image.ckpt", []
    job = Job(scenes / "cornell.toml", **SMALL)
    keeper = Keeper(file, 60.0, told.append)
    assert keeper.keep(job)
    before = file.read_bytes()
    real = open

    class Full:
        """A file on a disk that has room for a thousand bytes."""

        def __init__(self, *arguments: object) -> None:
            self.file, self.room = real(*arguments), 1000

        def write(self, block: bytes) -> None:
            self.room -= len(block)
            if self.room < 0:
                raise OSError(28, "No space left on device")
            self.file.write(block)

        def __enter__(self) -> "Full":
            return self

        def __exit__(self, *error: object) -> None:
            self.file.close()

    list(job.passes())
    monkeypatch.setattr("illuminant.checkpoint.open", Full, raising=False)
    assert not keeper.keep(job)
    assert isinstance(told[0], MachineError)
    assert "no space left" in str(told[0])
    assert file.read_bytes() == before
    assert [path.name for path in tmp_path.iterdir()] == ["image.ckpt"]


def test_another_file_is_no_checkpoint_and_stays(inside, scenes, tmp_path):
    scene = tmp_path / "a.toml"
    scene.write_text("# precious")
    with pytest.raises(
        UsageError, match=r"a\.toml is there already, and is no checkpoint: name another file\."
    ):
        illuminant.render(scenes / "cornell.toml", **SMALL, checkpoint=scene)
    words = ["render", scenes / "cornell.toml", "-o", tmp_path / "a.exr", "--checkpoint", tmp_path / "a.exr"]
    assert "is the file of the image too" in inside(*words).stderr
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.toml"]
    with pytest.raises(UsageError, match="every soon"):
        illuminant.render("nowhere.toml", checkpoint=tmp_path / "a.ckpt", every="soon")


def test_of_two_that_write_one_file_the_first_keeps_it(scenes, tmp_path):
    job = Job(scenes / "cornell.toml", **SMALL)
    told: list[str] = []
    keepers = [Keeper(tmp_path / "a.ckpt", trouble=lambda error: told.append(str(error))) for _ in range(2)]
    assert [keepers[i].keep(job) for i in (0, 1, 0)] == [True, False, True]
    assert len(told) == 1 and "is written by another process too" in told[0]


def test_the_command_keeps_and_resumes(inside, scenes, tmp_path):
    words = ["render", scenes / "cornell.toml", "-o", tmp_path / "a.exr", "--size", "40x24", "--json"]
    kept = ["--checkpoint", tmp_path / "a.ckpt", "--every", "1s"]
    assert inside(*words, "--samples", 8, *kept).returncode == 0
    refused = inside(*words, "--samples", 24, *kept)
    assert refused.returncode == 2
    assert "--resume" in refused.stderr
    assert inside(*words, "--samples", 24, *kept, "--resume").returncode == 0
    same_samples = inside(*words[:3], tmp_path / "b.exr", *words[4:], "--samples", 24)
    assert same_samples.returncode == 0
    one, other = (illuminant.Image.open(tmp_path / name) for name in ("a.exr", "b.exr"))
    assert one.xyz.tobytes() == other.xyz.tobytes()
    assert one.settings == other.settings
    assert "goes with --checkpoint" in inside(*words, "--resume").stderr
    assert "--every soon" in inside(*words, *kept, "--every", "soon").stderr
    (tmp_path / "a.ckpt").write_bytes(FIRST_LINE + bytes(90))
    damaged = inside(*words, *kept, "--resume")
    assert damaged.returncode == 2
    assert "is damaged" in damaged.stderr
