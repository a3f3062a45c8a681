"""Only who holds the token, from the viewer's own page, is admitted: files and WebSockets alike."""

import urllib.error
import urllib.request

import pytest

from illuminant.viewer.guard import Guard, new_token

OWN = {"Host": "127.0.0.1:8080"}
SOCKET = OWN | {"Upgrade": "websocket", "Origin": "http://127.0.0.1:8080"}


@pytest.fixture
def guard() -> Guard:
    return Guard("secret", "127.0.0.1", 8080)


def test_the_token_in_the_address_admits_and_gives_a_cookie_that_admits(guard):
    assert guard.refusal("/?token=secret", OWN) is None
    name, value = guard.cookie.split(";")[0].split("=")
    assert guard.refusal("/assets/index.js", OWN | {"Cookie": f"other=1; {name}={value}"}) is None
    assert "HttpOnly" in guard.cookie
    assert "SameSite=Strict" in guard.cookie


@pytest.mark.parametrize(
    "target", ["/", "/?token=", "/?token=secre", "/?token=secretx", "/?Token=secret", "/secret"]
)
def test_without_the_token_nothing_is_served(guard, target):
    assert guard.refusal(target, OWN)


@pytest.mark.parametrize(
    "host", ["evil.example:8080", "127.0.0.1:9090", "", "127.0.0.1.evil.example:8080", "[::", "a:b"]
)
def test_a_foreign_host_is_refused_even_with_the_token(guard, host):
    assert (
        guard.refusal("/?token=secret", {"Host": host}) == "this is not the host that the viewer listens on"
    )


@pytest.mark.parametrize(
    "origin", ["http://evil.example", "http://127.0.0.1:9090", "null", "", "file://127.0.0.1:8080"]
)
def test_a_websocket_of_another_page_is_refused_even_with_the_token(guard, origin):
    cookie = {"Cookie": f"{guard.cookie_name}=secret"}
    assert guard.refusal("/", SOCKET | cookie) is None
    assert guard.refusal("/", SOCKET | cookie | {"Origin": origin}) == "the request comes from another page"


def test_a_websocket_needs_the_token_too(guard):
    assert guard.refusal("/", SOCKET)


def test_a_server_for_all_takes_any_name_of_its_host_but_no_foreign_origin():
    guard = Guard("secret", "0.0.0.0", 8080)
    assert guard.refusal("/?token=secret", {"Host": "studio.example:8080"}) is None
    assert guard.refusal("/?token=secret", {"Host": "a:1", "Upgrade": "WebSocket", "Origin": "http://b:1"})


def test_a_damaged_cookie_is_no_cookie(guard):
    assert guard.refusal("/", OWN | {"Cookie": "\x00=;;;=,illuminant-8080"})


def test_odd_cookies_of_other_programs_hide_nothing(guard):
    odd = 'a={"b":1}; theme; k[]=1; ' + guard.cookie.split(";")[0]
    assert guard.refusal("/", OWN | {"Cookie": odd}) is None


@pytest.mark.parametrize("host", ["192.0.2.1", "no.such.host.invalid"])
def test_an_address_of_no_machine_here_is_one_sentence(repository, host):
    from illuminant.errors import Error
    from illuminant.viewer import view

    with pytest.raises(Error, match=host):
        view(repository / "scenes" / "cornell.toml", host=host)


def test_tokens_are_long_and_differ():
    tokens = {new_token() for _ in range(100)}
    assert len(tokens) == 100
    assert min(map(len, tokens)) >= 22


def test_the_running_server_refuses_and_serves(repository):
    from illuminant.viewer import view

    with view(repository / "scenes" / "cornell.toml", port=0) as viewer:
        port = viewer.port
        with pytest.raises(urllib.error.HTTPError) as refused:
            urllib.request.urlopen(f"http://127.0.0.1:{port}/")
        assert refused.value.code == 403
        refused.value.close()
        with urllib.request.urlopen(viewer.url.replace("localhost", "127.0.0.1")) as answer:
            assert answer.status == 200
            assert answer.headers["Set-Cookie"].startswith(f"illuminant-{port}=")
            assert answer.headers["Referrer-Policy"] == "no-referrer"


def test_a_port_that_is_taken_gives_another_and_says_so(repository):
    from illuminant.viewer import view

    scene = repository / "scenes" / "cornell.toml"
    with view(scene, port=0) as first, view(scene, port=first.port) as second:
        assert second.port != first.port
        assert f":{second.port}/" in second.url


def test_the_page_cannot_ask_for_a_tunnel(repository):
    from viser import _messages

    from illuminant.viewer import view

    with view(repository / "scenes" / "cornell.toml", port=0) as viewer:
        handled = viewer._server._websock_server._incoming_handlers
        assert _messages.ShareUrlRequest not in handled
        assert _messages.ShareUrlDisconnect not in handled
