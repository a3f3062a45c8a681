# Every verb of this repository; `make help` lists them.
# Needed: git, make, Python 3.11 or newer, cargo 1.85 or newer with the C linker that it calls. Nothing else.
#
# File times alone decide what is out of date (stamps in .venv), so a second `make demo` starts at once.

SHELL := /bin/bash
.SHELLFLAGS := -eu -o pipefail -c
.DELETE_ON_ERROR:
.DEFAULT_GOAL := help
MAKEFLAGS += --no-builtin-rules --no-print-directory

PYTHON ?= python3
# rustup puts cargo here; a shell that was open before does not know it yet.
export PATH := $(PATH):$(HOME)/.cargo/bin

BIN := .venv/bin
UV := $(BIN)/uv
REQUIREMENTS := requirements/run.txt requirements/test.txt requirements/docs.txt
RUST := $(shell find crates -type f) Cargo.toml Cargo.lock .cargo/config.toml pyproject.toml

# `--workspace` makes the tests use the very libraries that maturin builds (same features), so nothing is built twice.
# clippy takes maturin's description of the interpreter, or each of the two would undo the other's build of pyo3.
CARGO_TEST = ILLUMINANT_EMBREE="$$(ls "$(CURDIR)"/.venv/lib/python3*/site-packages/embreex.libs/libembree4*)" \
  cargo test --release --workspace --quiet
CLIPPY = PYO3_BUILD_EXTENSION_MODULE=1 PYO3_CONFIG_FILE="$$(ls "$(CURDIR)"/target/maturin/pyo3-config-*.txt | tail -n 1)" \
  cargo clippy --release --workspace --all-targets --quiet -- -D warnings

.PHONY: help setup demo test test-slow lint format bench kills soak fuzz site wheel requirements clean FORCE

help: ## List the verbs
	@grep -hE '^[a-z-]+:.*## ' $(MAKEFILE_LIST) | sed -E 's/^([a-z-]+):.*## /  make \1\t/' | expand -t 22

demo: .venv/.core ## Render scenes/demo.toml to demo.png
	@$(BIN)/illuminant render scenes/demo.toml -o demo.png
	@echo "illuminant: the image is $(CURDIR)/demo.png"

test: lint ## Run every check: lint, Rust tests, Python tests
	@echo "illuminant: cargo test"
	@$(CARGO_TEST)
	@tools/browser.sh
	@echo "illuminant: pytest"
	@$(BIN)/python -m pytest -n 2 --dist loadfile

test-slow: .venv/.core ## Run the long tests: a million draws, the wheel by itself
	@$(CARGO_TEST) --test laws -- --ignored
	@$(BIN)/python -m pytest -m slow

lint: .venv/.core ## rustfmt, clippy, ruff, mypy; any warning fails
	@tools/check_toolchain.sh $(BIN)/python lint
	@echo "illuminant: rustfmt, clippy"
	@cargo fmt --all --check
	@$(CLIPPY)
	@echo "illuminant: ruff, mypy"
	@$(BIN)/ruff check --quiet
	@$(BIN)/ruff format --quiet --check || { echo "illuminant: 'make format' lays these files out." >&2; exit 1; }
	@$(BIN)/mypy

format: .venv/.packages ## Lay out the Rust and Python sources
	@cargo fmt --all
	@$(BIN)/ruff check --quiet --fix-only
	@$(BIN)/ruff format --quiet

bench: .venv/.core ## Measure beside peers and beside raw Embree; prints tables (docs/benchmarks.md)
	@peers=$$(benches/peers.sh); eval "$$peers"; \
	for script in compare_mitsuba embree_limit lanes memory fitted color dither scanline glossy many_lamps form_factors viewer radiance; do \
	  echo "illuminant: benches/$$script.py"; $(BIN)/python benches/$$script.py; done

kills: .venv/.core ## Kill 200 renders at random moments (endurance/kills.txt)
	@$(BIN)/python endurance/kills.py --kills 200 --record endurance/kills.txt

soak: .venv/.core ## Half an hour of mixed work (endurance/soak.txt)
	@$(BIN)/python endurance/soak.py --minutes 30 --record endurance/soak.txt

fuzz: .venv/.core ## Millions of hostile inputs, hours, recorded (fuzz/last-run.txt)
	@ILLUMINANT_EMBREE="$$(ls "$(CURDIR)"/.venv/lib/python3*/site-packages/embreex.libs/libembree4*)" $(BIN)/python fuzz/run.py --jobs 2

site: .venv/.core build/atlas/index.md ## Build the documentation site in build/site/html (docs, atlas, references)
	@$(BIN)/python tools/site/build.py build/site --atlas build/atlas --notebooks

build/atlas/index.md: $(shell find python/illuminant/atlas -name '*.py') .venv/.core
	@echo "illuminant: drawing the atlas (up to a quarter of an hour)"
	@rm -rf build/atlas
	@mkdir -p build
	@$(BIN)/illuminant atlas --all -o build/atlas > /dev/null

wheel: .venv/.core ## Build the abi3 wheel in dist/
	@rm -rf dist
	@$(BIN)/maturin build --quiet --release --strip --out dist
	@echo "illuminant: the wheel is $$(ls "$(CURDIR)"/dist/*.whl)"

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
	@$(UV) pip sync --compile-bytecode --quiet --python $(BIN)/python --require-hashes $(REQUIREMENTS)
	@touch $@

# The stamp takes the time at which the build began, so an edit made during the build is not missed.
.venv/.core: $(RUST) .venv/.packages
	@tools/check_toolchain.sh $(BIN)/python
	@echo "illuminant: compiling the core (about seven minutes the first time)"
	@$(if $(CI),cargo metadata --locked --format-version 1 > /dev/null)
	@begun=$$(mktemp .venv/.core-begun.XXXXXX); trap 'rm -f "$$begun"' EXIT; \
	$(UV) pip install --quiet --python $(BIN)/python --no-deps --no-build-isolation \
	  --reinstall-package illuminant --editable .; \
	mv "$$begun" $@

requirements: .venv/.uv ## Pin the Python packages again (UPGRADE=1 takes newer versions)
	@compile() { $(UV) pip compile --quiet --python-version 3.11 --generate-hashes --no-emit-index-url \
	  --no-emit-find-links --custom-compile-command "make requirements" $(if $(UPGRADE),--upgrade) "$$@"; }; \
	compile requirements/uv.in -o requirements/uv.txt; \
	compile pyproject.toml -o requirements/run.txt; \
	compile requirements/test.in -c requirements/run.txt -o requirements/test.txt; \
	compile requirements/docs.in -c requirements/run.txt -c requirements/test.txt -o requirements/docs.txt; \
	compile requirements/bench.in -o requirements/bench.txt

# Peers live in an environment of their own: they pin other versions of the same packages.
.venv-bench/.packages: requirements/bench.txt .venv/.uv
	@$(UV) venv --quiet --clear --python $(BIN)/python .venv-bench
	@$(UV) pip sync --compile-bytecode --quiet --python .venv-bench/bin/python --require-hashes $<
	@touch $@

clean: ## Remove everything that was built, and the environments
	@rm -rf .venv .venv-bench build dist target demo.png .mypy_cache .pytest_cache .ruff_cache .hypothesis
	@rm -f python/illuminant/*.so
	@find python tests tools benches -name __pycache__ -type d -prune -exec rm -rf {} +
