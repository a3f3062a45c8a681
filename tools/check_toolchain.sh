#!/bin/bash
# Says in one sentence what this machine lacks to build illuminant, and stops; silent when all is there.
# usage: tools/check_toolchain.sh PYTHON [lint]      lint: rustfmt and clippy are needed too
set -u
python=$1

stop() {
    echo "illuminant: $1" >&2
    exit 1
}

# at_least FOUND WANTED: is the dotted version FOUND as new as WANTED?
at_least() {
    [ "$(printf '%s\n%s\n' "$2" "$1" | sort -V | head -n 1)" = "$2" ]
}

command -v "$python" >/dev/null ||
    stop "Python 3.11 or newer is needed and '$python' was not found; install it or say where it is with 'make PYTHON=...'."
"$python" -c 'import sys; sys.exit(sys.version_info < (3, 11))' ||
    stop "Python 3.11 or newer is needed, '$python' is $("$python" --version 2>&1); name another one with 'make PYTHON=...'."
"$python" -c 'import ensurepip, venv' 2>/dev/null ||
    stop "'$python' cannot make environments; install its venv module (Debian: apt-get install python3-venv)."

command -v cargo >/dev/null ||
    stop "cargo 1.85 or newer is needed and was not found; install Rust as https://rustup.rs describes."
found=$(cargo --version 2>/dev/null | cut -d ' ' -f 2)
at_least "${found:-0}" 1.85 ||
    stop "cargo 1.85 or newer is needed, $(command -v cargo) is ${found:-broken}; install a current Rust as https://rustup.rs describes."
command -v cc >/dev/null ||
    stop "cargo needs a C linker and 'cc' was not found; install one (Debian: apt-get install gcc libc6-dev)."

if [ "${2:-}" = lint ]; then
    for tool in fmt clippy; do
        cargo "$tool" --version >/dev/null 2>&1 ||
            stop "'cargo $tool' is needed and was not found; install it with 'rustup component add rustfmt clippy'."
    done
fi
