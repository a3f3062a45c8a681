"""`illuminant video`: what the verbs write, say and refuse."""

import json
import subprocess
from collections.abc import Callable
from pathlib import Path

import numpy as np
import PIL.Image
import pytest

from illuminant import plots
from illuminant.cli import run
from illuminant.display.patterns import color_bars
from illuminant.display.picture import Picture
from illuminant.display.video import scopes, transmission
from illuminant.display.video.composite import encode
from illuminant.display.video.frame_buffer import opened, with_values

Inside = Callable[..., "subprocess.CompletedProcess[str]"]


@pytest.fixture
def video(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Inside:
    """Runs `illuminant video` with the given arguments in the folder of the test."""
    monkeypatch.chdir(tmp_path)
    bars = np.repeat(np.array([*color_bars.bars_75().values(), (1.0, 1.0, 0.0)]), 16, axis=0)
    Picture.of_values(np.tile(bars, (12, 1, 1)), "sRGB").save("bars.png")

    def call(*arguments: object) -> "subprocess.CompletedProcess[str]":
        words = ["video", *map(str, arguments)]
        code = run(words)
        captured = capsys.readouterr()
        return subprocess.CompletedProcess(words, code, captured.out, captured.err)

    return call


def test_transmit_writes_what_the_function_computes(video: Inside) -> None:
    done = video("transmit", "bars.png", "sent.png", "--decoder", "notch", "--hue", 20, "--chroma", 0.5)
    assert done.returncode == 0 and done.stderr.startswith("sent.png: decoder notch")
    before, after = opened("bars.png"), opened("sent.png")
    wanted = transmission.transmit(before.values, decoder="notch", hue_deg=20, chroma=0.5)
    np.testing.assert_array_equal(after.codes, with_values(before, wanted, "").codes)
    assert video("transmit", "bars.png", "pair.png", "--beside").returncode == 0
    np.testing.assert_array_equal(opened("pair.png").codes[:, :128], before.codes)
    assert video("transmit", "bars.png", "c.png", "--correct", "--bandwidth", "4.2,1.3,1.3").returncode == 0


def test_a_picture_of_no_display_is_refused_until_one_is_named(video: Inside) -> None:
    PIL.Image.new("RGB", (16, 8), (90, 30, 20)).save("mute.png")
    verbs = [
        "transmit mute.png out.png",
        "transmit mute.png out.png --correct",
        "check mute.png --repair out.png",
        "monochrome mute.png out.png",
        "safe mute.png out.png",
        "components mute.png out.png",
        "scope mute.png -o out.png",
        "fields mute.png mute.png out.png",
        "fields --split mute.png odd.png out.png",
    ]
    for verb in verbs:
        done = video(*verb.split())
        assert done.returncode not in (0, 3) and "does not say which display" in done.stderr, verb
        assert not Path("out.png").exists()
        assert video(*verb.split(), "--assume", "SMPTE-C").returncode == 0, verb
        if "scope" not in verb:
            assert opened("out.png").display.name == "SMPTE-C"
        Path("out.png").unlink()


def test_frames_have_any_number(video: Inside) -> None:
    assert video("transmit", "bars.png", "a.png", "--frame", 99999999999999999999).returncode == 0
    assert video("transmit", "bars.png", "b.png", "--frame", 1).returncode == 0
    assert Path("a.png").read_bytes() == Path("b.png").read_bytes()


def test_check_ends_with_one_above_the_limit_and_repairs(video: Inside) -> None:
    done = video("check", "bars.png", "--max", 10, "--repair", "legal.png", "-o", "map.png")
    assert done.returncode == 1
    assert " 12.50 %  hot" in done.stdout and "130.8 IRE" in done.stdout
    assert "Unfit: hot 12.5 % is above 10 %." in done.stderr
    assert video("check", "bars.png", "--max", 12.5).returncode == 0
    assert video("check", "legal.png", "--max", 0).returncode == 0
    assert (opened("map.png").codes[:, -8:] == [255, 26, 26]).all()
    assert video("check", "legal.png", "--max", 0, "--limits", "-20,110").returncode == 1
    facts = json.loads(video("check", "bars.png", "--json").stdout)
    assert facts["percent"]["hot"] == 12.5 and facts["highest_ire"] == pytest.approx(130.8, abs=0.05)
    assert facts["percent"]["title"] > 0


def test_fields_are_woven_and_split_bit_for_bit(video: Inside) -> None:
    rng = np.random.default_rng(3)
    odd, even = (rng.integers(0, 65536, (8, 10, 3)).astype(np.uint16) for _ in range(2))
    Picture(odd, "sRGB", 16).save("a.png")
    Picture(even, "sRGB", 16).save("b.png")
    assert video("fields", "a.png", "b.png", "frame.png").returncode == 0
    assert video("fields", "--split", "frame.png", "odd.png", "even.png").returncode == 0
    np.testing.assert_array_equal(opened("odd.png").codes, odd[::2])
    np.testing.assert_array_equal(opened("even.png").codes, even[1::2])
    assert video("fields", "--split", "--full", "frame.png", "odd.png", "even.png").returncode == 0
    np.testing.assert_array_equal(opened("even.png").codes[1::2], even[1::2])
    assert "bars.png is sRGB of 8 bits" in video("fields", "a.png", "bars.png", "no.png").stderr
    assert video("fields", "--split", "frame.png", "half.png", "rest.png").returncode == 0
    assert "one shape" in video("fields", "a.png", "half.png", "no.png").stderr


def test_monochrome_safe_and_components_write_pictures(video: Inside) -> None:
    assert video("monochrome", "bars.png", "grey.png").returncode == 0
    grey, bars = opened("grey.png"), opened("bars.png")
    np.testing.assert_allclose(
        grey.values, np.repeat((bars.values @ [0.299, 0.587, 0.114])[..., None], 3, -1), atol=0.51 / 255
    )
    assert "safe title 13,1 to 114,10" in video("safe", "bars.png", "safe.png").stderr
    assert "safe title 6,1 to 121,10" in video("safe", "bars.png", "a.png", "--standard", "ST 2046-1").stderr
    assert video("components", "bars.png", "parts.png").returncode == 0
    parts = opened("parts.png").values
    assert parts.shape == (24, 256, 3)
    np.testing.assert_allclose(parts[:12, 128:], grey.values, atol=0.51 / 255)
    assert video("components", "bars.png", "bands.png", "--bands").returncode == 0


def test_instruments_and_gamut_are_plotted(video: Inside, tmp_path: Path) -> None:
    assert video("scope", "bars.png", "-o", "line.png", "--kind", "luminance", "--line", 3).returncode == 0
    assert video("scope", "bars.png", "-o", "all.svg", "--kind", "vectorscope").returncode == 0
    done = video("gamut", "-o", "gamut.png")
    assert done.stderr == "gamut.png: hot corners are yellow, cyan, red and blue\n"
    assert {path.name for path in tmp_path.iterdir()} == {"all.svg", "bars.png", "gamut.png", "line.png"}


def test_a_plot_shows_the_trace_that_was_computed() -> None:
    image = np.tile(np.repeat(np.array(list(color_bars.bars_75().values())), 20, axis=0), (6, 1, 1))
    signal = encode(transmission.on_lines(image))
    line = plots.waveform(signal, 2).axes[0].lines[0]
    np.testing.assert_array_equal(line.get_ydata(), scopes.waveform(signal, 2, finer=8)[1][0])
    trace = plots.vectorscope(signal, 2).axes[0].lines[-1]
    np.testing.assert_array_equal(np.transpose(trace.get_data()), scopes.vectors(signal, 2))
    beam_time, beam = scopes.beam(signal)
    assert beam.shape == (6, 3640) and beam_time.max() < 63.7
    assert beam.max() == pytest.approx(scopes.waveform(signal, finer=16)[1].max(), abs=0.5)


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ("transmit none.png a.png", "none.png cannot be read: there is no such file."),
        ("transmit broken.png a.png", "broken.png is not a whole PNG"),
        ("transmit bars.png a.exr", "a.exr: expected a file that ends in .png"),
        ("transmit bars.png no/a.png", "there is no folder no"),
        (
            "transmit bars.png a.png --decoder combb",
            'expected comb, notch or low-pass (did you mean "comb"?)',
        ),
        ("transmit bars.png a.png --bandwidth 4.2", "expected three numbers in MHz"),
        ("transmit bars.png a.png --bandwidth 4.2,3,0.5", "bandwidth of I is 3 MHz"),
        ("transmit bars.png a.png --hue nan", "hue control needs an angle"),
        ("transmit bars.png a.png --chroma nan", "chroma control of nan"),
        ("transmit bars.png a.png --setup 50", "setup of 50 IRE"),
        ("transmit bars.png a.png --lines 0", "--lines 0: expected 2 to 10000"),
        ("check bars.png --measure heat", "--measure heat: expected hot, fine"),
        ("check bars.png --max 200", "--max 200: expected a percentage"),
        ("check bars.png --limits 3", "--limits 3: expected two levels"),
        ("check bars.png --threshold 0", "threshold of 0"),
        ("scope bars.png -o a.png --line 12", "--line 12: bars.png has rows 0 to 11."),
        ("scope bars.png -o a.jpg", "a.jpg: expected a file that ends in .png or .svg"),
        ("scope bars.png -o a.png --kind eye", "--kind eye: expected waveform"),
        ("fields bars.png bars.png a.png --full", "--full goes with --split"),
        ("safe bars.png a.png --standard EBU", "RP 27.3 or ST 2046-1, not 'EBU'"),
    ],
)
def test_a_mistake_is_one_sentence(video: Inside, arguments: str, sentence: str) -> None:
    Path("broken.png").write_bytes(Path("bars.png").read_bytes()[:-30])
    done = video(*arguments.split())
    assert done.returncode == 2
    assert sentence in done.stderr
    assert done.stderr.startswith("Error: ") and len(done.stderr.splitlines()) == 1
    assert not Path("a.png").exists()
