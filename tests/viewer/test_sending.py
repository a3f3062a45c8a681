"""Pictures are encoded exactly, and sent by a thread that leaves out what is late."""

import io
import threading
import time

import numpy as np
import PIL.Image
import pytest

from illuminant.viewer.sending import Sender, background, encoded


@pytest.mark.parametrize("shape", [(1, 1, 3), (7, 5, 3), (40, 61, 4)])
def test_a_png_holds_the_codes(shape):
    codes = np.random.default_rng(3).integers(0, 256, shape, dtype=np.uint8)
    with PIL.Image.open(io.BytesIO(encoded(codes))) as image:
        assert (np.asarray(image) == codes).all()
    turned = codes[:, ::-1]  # not contiguous
    with PIL.Image.open(io.BytesIO(encoded(turned))) as image:
        assert (np.asarray(image) == turned).all()


def test_a_depth_is_what_viser_itself_sends():
    import viser._scene_api as scene_api

    sent = []

    class Scene:
        _websock_interface = type("Queue", (), {"queue_message": staticmethod(sent.append)})

    client = type("Client", (), {"scene": Scene})
    codes = np.random.default_rng(4).integers(0, 256, (6, 9, 3), dtype=np.uint8)
    depth = np.random.default_rng(5).uniform(0.1, 200.0, (6, 9)).astype(np.float32)
    background(client, encoded(codes), depth)
    scene_api.SceneApi.set_background_image(Scene, codes, format="png", depth=depth)
    ours, theirs = sent
    assert type(ours) is type(theirs) and ours.format == theirs.format == "png"
    for name in ("rgb_data", "depth_data"):
        with (
            PIL.Image.open(io.BytesIO(getattr(ours, name))) as a,
            PIL.Image.open(io.BytesIO(getattr(theirs, name))) as b,
        ):
            assert a.mode == b.mode
            assert np.array_equal(np.asarray(a), np.asarray(b)), name


def test_asking_takes_no_time_and_only_the_latest_is_sent():
    latest, sent, free = [0], [], threading.Event()

    def send() -> None:
        sent.append(latest[0])
        free.wait(10.0)

    sender = Sender(send, print)
    begun = time.monotonic()
    for number in range(1, 50):
        latest[0] = number
        sender.ask()
    assert time.monotonic() - begun < 5.0
    free.set()
    end = time.monotonic() + 30.0
    while sent[-1:] != [49] and time.monotonic() < end:
        time.sleep(0.01)
    sender.close()
    assert sent[-1] == 49
    assert len(sent) <= 3


def test_a_mistake_is_told_and_the_next_picture_is_sent():
    told, done = [], threading.Event()

    def send() -> None:
        if not told:
            raise ValueError("no picture")
        done.set()

    sender = Sender(send, told.append)
    sender.ask()
    end = time.monotonic() + 30.0
    while not told and time.monotonic() < end:
        time.sleep(0.01)
    sender.ask()
    assert done.wait(30.0)
    sender.close()
    assert told == ["ValueError: no picture"]
    assert not sender._thread.is_alive()
