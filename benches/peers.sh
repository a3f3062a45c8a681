#!/bin/bash
# Makes the environment of the peers, .venv-bench, and says whether LLVM, which Mitsuba compiles with, is there.
# usage: benches/peers.sh        prints the line to export when all is well
set -eu
cd "$(dirname "$0")/.."

make --silent .venv-bench/.packages >&2

llvm=${DRJIT_LIBLLVM_PATH:-}
if [ -z "$llvm" ]; then
    for candidate in /usr/lib/*/libLLVM.so.19.1 /usr/lib/*/libLLVM-19.so* /usr/lib64/libLLVM.so.19.1; do
        [ -e "$candidate" ] && llvm=$candidate && break
    done
fi
if [ ! -e "$llvm" ]; then
    echo "peers.sh: Mitsuba's llvm_ad variants need LLVM 19, which was not found." >&2
    echo "peers.sh: install it (Debian 12: apt-get install libllvm19) or set DRJIT_LIBLLVM_PATH to libLLVM.so." >&2
    exit 2
fi
echo "export DRJIT_LIBLLVM_PATH=$llvm"
