"""`illuminant calibrate`: from readings to a description that is verified, and a record of it."""

import io
import json
import sys

import numpy as np
import pytest
from PIL import Image, ImageCms

from illuminant import color
from illuminant.cli import run
from illuminant.display.calibration import monitor, readings
from illuminant.display.displays import named


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def typed(monkeypatch, text):
    monkeypatch.setattr(sys, "stdin", io.StringIO(text))


def test_a_maladjusted_monitor_is_described_and_the_description_verified(folder, capsys):
    assert run(["calibrate", "simulate", "--seed", "4", "-o", "a.csv"]) == 0
    assert run(["calibrate", "fit", "a.csv", "-o", "a.toml", "--name", "left monitor", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["before"]["mean"] > 5.0 and told["after"]["mean"] < 0.5
    assert told["after"]["outside"] == ["cyan"]
    display = named("a.toml")
    assert display.name == "left monitor"
    assert display.peak == pytest.approx(told["white"]["luminance"], rel=1e-4)
    assert run(["calibrate", "patterns", "-o", "check", "--verify", "a.toml", "--size", "64x64"]) == 0
    assert run(["calibrate", "simulate", "--seed", "4", "--codes", "check/readings.csv", "-o", "b.csv"]) == 0
    assert run(["calibrate", "verify", "a.toml", "b.csv"]) == 0
    assert "cyan" in capsys.readouterr().out
    # Another monitor does not fit this description.
    assert run(["calibrate", "simulate", "--seed", "2", "--codes", "check/readings.csv", "-o", "c.csv"]) == 0
    assert run(["calibrate", "verify", "a.toml", "c.csv"]) == 1


def test_knobs_turned_by_readings_pass_the_criteria(folder, capsys):
    assert run(["calibrate", "simulate", "--seed", "2", "-o", "before.csv"]) == 0
    assert run(["calibrate", "simulate", "--seed", "2", "--adjusted", "-o", "after.csv"]) == 0
    assert "round  1" in capsys.readouterr().err
    verdicts = []
    for table in ("before.csv", "after.csv"):
        assert run(["calibrate", "fit", table, "--json"]) == 0
        verdicts.append({v["name"]: v["passed"] for v in json.loads(capsys.readouterr().out)["verdict"]})
    assert not all(verdicts[0].values())
    assert all(verdicts[1].values())


def test_a_cold_monitor_is_dimmer(folder):
    assert run(["calibrate", "simulate", "--ideal", "--noise", "0", "--minutes", "0", "-o", "cold.csv"]) == 0
    assert run(["calibrate", "simulate", "--ideal", "--noise", "0", "-o", "warm.csv"]) == 0
    cold, warm = (readings.read(name).xyz[10, 1] for name in ("cold.csv", "warm.csv"))
    assert cold < 0.95 * warm == pytest.approx(0.95 * 103.0, rel=1e-3)


def test_a_session_is_written_and_typed_in(folder, capsys, monkeypatch):
    assert run(["calibrate", "patterns", "-o", "studio", "--size", "64x64"]) == 0
    assert (folder / "studio" / "index.html").is_file()
    typed(monkeypatch, "0 0 0\n0.31, 0.33, 1.5\nb\n0.3127 0.3290 1.6\nq\n")
    assert run(["calibrate", "walk", "studio/readings.csv"]) == 0
    assert "2 of 33 readings, 31 to go" in capsys.readouterr().err
    table = readings.read("studio/readings.csv")
    assert table.xyz[:, 1].tolist() == [0.0, 1.6] and len(table.unread) == 31
    np.testing.assert_allclose(np.concatenate([table.codes, table.unread]), readings.plan(), atol=1e-12)
    typed(monkeypatch, "".join("95 100 109\n" for _ in range(31)))
    assert run(["calibrate", "walk", "studio/readings.csv", "--as", "XYZ"]) == 0
    assert "33 of 33 readings" in capsys.readouterr().err
    assert run(["calibrate", "patterns", "-o", "studio", "--size", "64x64"]) == 2
    assert "not overwritten" in capsys.readouterr().err


def test_the_guide_tells_six_steps_in_80_columns(capsys):
    assert run(["calibrate", "guide"]) == 0
    out = capsys.readouterr().out
    assert [line[:2] for line in out.splitlines() if line[:1].isdigit()] == [f"{n}." for n in range(1, 7)]
    assert max(map(len, out.splitlines())) <= 95 and out.count("passes:") >= 6
    assert run(["calibrate"]) == 0
    assert capsys.readouterr().out == out
    assert run(["calibrate", "guide", "--json"]) == 0
    assert len(json.loads(capsys.readouterr().out)) == 6


def test_the_record_says_when_to_look_again(folder, capsys):
    assert run(["calibrate", "simulate", "--seed", "3", "--adjusted", "-o", "a.csv"]) == 0
    assert run(["calibrate", "log", "log.csv", "--readings", "a.csv", "--date", "2026-01-01"]) == 0
    capsys.readouterr()
    white_low = ["--white", "97.9,103,112.2", "--low", "2.9,3,3.3"]
    words = ["--kind", "analyzer", "--date", "2026-01-31", "--note", "dusted, with care"]
    assert run(["calibrate", "log", "log.csv", *white_low, *words, "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["entries"] == 2 and told["moved"] > 0.0 and told["full"] == "2026-07-02"
    assert run(["calibrate", "log", "log.csv"]) == 0
    assert "in full: 2026-07-02" in capsys.readouterr().out
    assert (folder / "log.csv").read_text().endswith("dusted, with care\n")


def test_a_profile_of_the_monitor_is_written(folder):
    assert run(["calibrate", "simulate", "--seed", "1", "-o", "a.csv"]) == 0
    assert run(["calibrate", "fit", "a.csv", "-o", "a.toml", "--icc", "a.icc"]) == 0
    described, profiled = named("a.toml"), named("a.icc")
    np.testing.assert_allclose(profiled.primaries, described.primaries, atol=2e-4)
    codes = np.random.default_rng(1).random((40, 3))
    np.testing.assert_allclose(profiled.decode(codes), described.decode(codes), atol=2e-4)


def test_littlecms_opens_the_profile_and_makes_the_same_colours_of_it(folder):
    assert run(["calibrate", "simulate", "--seed", "3", "-o", "a.csv"]) == 0
    assert run(["calibrate", "fit", "a.csv", "-o", "a.toml", "--icc", "a.icc", "--name", "left monitor"]) == 0
    profile = ImageCms.getOpenProfile("a.icc")
    assert ImageCms.getProfileDescription(profile).strip() == "left monitor"
    codes = np.random.default_rng(1).integers(0, 256, (40, 50, 3), dtype=np.uint8)
    codes[0] = codes[0, :, :1]
    through = ImageCms.profileToProfile(
        Image.fromarray(codes), profile, ImageCms.createProfile("sRGB"), renderingIntent=1
    )
    monitor = named("a.toml")
    # Relative colorimetry: white to white, and black left out.
    xyz = monitor.decode(codes / 255.0) @ monitor.to_xyz_matrix.T
    xyz = color.adapt(xyz, monitor.white, (0.3127, 0.3290), method="Bradford")
    linear = color.xyz_to_rgb(xyz, "sRGB")
    inside = ((linear > 0.0) & (linear < 1.0)).all(axis=-1)
    assert inside.mean() > 0.5
    wanted = 255.0 * color.encode(linear.clip(0.0, 1.0), "sRGB")
    away = np.abs(np.asarray(through)[inside] - wanted[inside])
    assert away.max() < 2.0 and away.mean() < 0.5


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["fit", "none.csv"], "none.csv: The readings cannot be read"),
        (["fit", "bad.csv"], "bad.csv:2: Y is 'x'"),
        (["fit", "good.csv", "-o", "a.txt"], "ends in .toml"),
        (["fit", "good.csv", "--icc", "a.toml"], "ends in .icc"),
        (["fit", "good.csv", "--low", "2"], "low cutoff"),
        (["fit", "good.csv", "--assumed", "TV"], "no display 'TV'"),
        (["fit", "good.csv", "-o", "none/a.toml"], "there is no folder none"),
        (["verify", "none.toml", "good.csv"], "none.toml cannot be read"),
        (["verify", "sRGB", "good.csv"], "There is no reading of dark skin"),
        (["walk", "none.csv"], "cannot be read"),
        (["walk", "good.csv", "--as", "Lab"], "--as Lab"),
        (["log", "log.csv"], "There is no record log.csv yet"),
        (["log", "log.csv", "--white", "1,2,3"], "belong together"),
        (["log", "log.csv", "--white", "1,2", "--low", "1,2,3"], "--white 1,2: expected 3 numbers"),
        (["log", "log.csv", "--readings", "good.csv", "--date", "May"], "--date May"),
        (["log", "log.csv", "--note", "x"], "Nothing to record"),
        (["log", "log.csv", "--readings", "good.csv", "--kind", "half"], "not 'half'"),
        (["log", "log.csv", "--readings", "good.csv", "--date", "9999-12-31"], "up to 9999-07-02"),
        (["fit", "good.csv", "-o", "a.toml", "--luminance", "0"], "number above 0, not 0"),
        (["fit", "good.csv", "-o", "a.toml", "--luminance", "nan"], "number above 0, not nan"),
        (["patterns", "-o", "a", "--size", "20x20"], "A crosshatch has 1 to 5 squares"),
        (["simulate", "-o", "a.csv", "--seed", "-1"], "--seed -1"),
        (["simulate", "-o", "a.csv", "--noise", "nan"], "--noise nan"),
        (["simulate", "-o", "a.csv", "--minutes", "nan"], "--minutes nan"),
        (["simulate", "-o", "none/a.csv"], "there is no folder none"),
        (["patterns", "-o", "good.csv"], "cannot be made"),
        (["patterns", "-o", "a", "--window", "0"], "not 0"),
        (["patterns", "-o", "a", "--verify", "none.toml"], "none.toml cannot be read"),
    ],
)
def test_a_mistake_is_one_sentence(folder, capsys, arguments, words):
    (folder / "bad.csv").write_text("r,g,b,X,Y,Z\n0,0,0,1,x,3\n")
    codes = readings.plan()
    readings.Readings(codes, monitor.Monitor().xyz(codes)).save("good.csv")
    assert run(["calibrate", *arguments]) == 2
    captured = capsys.readouterr()
    assert words in captured.err and captured.err.count("\n") == 1
    assert sorted(path.name for path in folder.iterdir()) == ["bad.csv", "good.csv"]


def test_a_record_of_the_last_days_stays_readable(folder, capsys):
    white_low = ["--white", "97.9,103,112.2", "--low", "2.9,3,3.3"]
    assert run(["calibrate", "log", "log.csv", *white_low, "--date", "9999-07-02"]) == 0
    before = (folder / "log.csv").read_bytes()
    assert run(["calibrate", "log", "log.csv", *white_low, "--date", "9999-07-03"]) == 2
    assert (folder / "log.csv").read_bytes() == before
    capsys.readouterr()
    assert run(["calibrate", "log", "log.csv"]) == 0
    assert "in full: 9999-12-31" in capsys.readouterr().out
    (folder / "log.csv").write_bytes(before.replace(b"9999-07-02", b"9999-12-01"))
    assert run(["calibrate", "log", "log.csv"]) == 2
    assert "has no next one" in capsys.readouterr().err
