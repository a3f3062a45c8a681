# Every verb of this repository; `make help` lists them.
# Needed: git, make, Python 3.11 or newer, cargo 1.85 or newer with the C linker it calls. Nothing else.
#
# What is out of date is decided by file times alone (stamps in .venv), so a second `make demo` starts at once.

SHELL := /bin/bash
.SHELLFLAGS := -eu -o pipefail -c
.DELETE_ON_ERROR:
.DEFAULT_GOAL := help
MAKEFLAGS += --no-builtin-rules --no-print-directory

PYTHON ?= python3
# rustup puts cargo here; a shell that was open before still does not know.
export PATH := $(PATH):$(HOME)/.cargo/bin
# maturin builds the bindings with this set; clippy must too, or each would undo the other's build of pyo3.
export PYO3_BUILD_EXTENSION_MODULE := 1

BIN := .venv/bin
UV := $(BIN)/uv
REQUIREMENTS := requirements/run.txt requirements/test.txt requirements/docs.txt
RUST := $(shell find crates -type f) Cargo.toml Cargo.lock .cargo/config.toml pyproject.toml

.PHONY: help setup demo test test-slow lint format bench wheel requirements clean FORCE

help: ## List the verbs
	@grep -hE '^[a-z-]+:.*## ' $(MAKEFILE_LIST) | sed -E 's/^([a-z-]+):.*## /  make \1\t/' | expand -t 22

# --- environment -------------------------------------------------------------------------------------------------

setup: .venv/.core ## Make .venv: pinned packages, compiled core, `illuminant` command
	@echo "illuminant: .venv is ready"

# An environment holds absolute paths: in a checkout that was moved it is made anew.
ifneq ($(shell cat .venv/.checkout 2>/dev/null),$(CURDIR))
.venv/.checkout: FORCE
endif
.venv/.checkout:
	@tools/check_toolchain.sh $(PYTHON)
	@echo "illuminant: making the Python environment .venv"
	@rm -rf .venv
	@$(PYTHON) -m venv .venv
	@printf '%s\n' '$(CURDIR)' > $@

.venv/.uv: requirements/uv.txt .venv/.checkout
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check --require-hashes -r requirements/uv.txt
	@touch $@

.venv/.packages: $(REQUIREMENTS) .venv/.uv
	@echo "illuminant: installing the pinned packages"
	@$(UV) pip sync --quiet --python $(BIN)/python --require-hashes $(REQUIREMENTS)
	@touch $@

# The stamp takes the time at which the build began, so an edit made during the build is not missed.
.venv/.core: $(RUST) .venv/.packages
	@tools/check_toolchain.sh $(BIN)/python
	@echo "illuminant: compiling the core (about two minutes the first time)"
	@touch .venv/.core-begun
	@$(UV) pip install --quiet --python $(BIN)/python --no-deps --no-build-isolation \
	  --reinstall-package illuminant --editable .
	@mv .venv/.core-begun $@

requirements: .venv/.uv ## Pin the Python packages again (UPGRADE=1 takes newer versions)
	@compile() { $(UV) pip compile --quiet --python-version 3.11 --generate-hashes --no-emit-index-url \
	  --no-emit-find-links --custom-compile-command "make requirements" $(if $(UPGRADE),--upgrade) "$$@"; }; \
	compile requirements/uv.in -o requirements/uv.txt; \
	compile pyproject.toml -o requirements/run.txt; \
	compile requirements/test.in -c requirements/run.txt -o requirements/test.txt; \
	compile requirements/docs.in -c requirements/run.txt -c requirements/test.txt -o requirements/docs.txt; \
	compile requirements/bench.in -o requirements/bench.txt
