# `make help` lists the commands. They need python3 (3.11 or newer, with venv), a C compiler and cargo, and for the VS
# Code extension node 20 and npm; everything else is brought into .venv and, for the extension, into folders node_modules.

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
OUT := out
export UV_PYTHON_DOWNLOADS := never
UV := $(BIN)/uv
EXTENSION := vscode-extension
PICTURE := web/picture
# The rest of a recipe's line is left out where there is no node, except in CI.
NEEDS_NODE := if ! command -v npm > /dev/null; then \
	echo "The VS Code extension and its picture part are not looked at: there is no npm (node 20 or newer)."; \
	test -z "$$CI"; exit; fi;
CARGO_TEST := cargo test --quiet --release --workspace --manifest-path renderer/Cargo.toml

.DEFAULT_GOAL := help
.PHONY: help demo test test-quick test-extension test-workbench fuzz lint lint-extension format generate pins gallery
.PHONY: bench vsix
.PHONY: needs programs tools modules viewer wasm wheels release release-tools

help: ## Show this list
	@sed -n 's/^\([a-z-]*\):.*## /\1\t/p' $(MAKEFILE_LIST) | while IFS="$$(printf '\t')" read -r name text; do \
		printf '  make %-15s %s\n' "$$name" "$$text"; done

demo: ## Render the merman scene with straight and with bent rays into out/
	@PYTHON="$(PYTHON)" MAKE="$(MAKE)" sh tools/demo.sh

# One process a processor takes the next tests whenever it is done with its own.
PYTEST := $(BIN)/python -m pytest -q -n auto --maxprocesses 8 --dist worksteal

test: tools ## Run all tests
	$(PYTEST)
	$(CARGO_TEST)
	@$(MAKE) --no-print-directory test-extension

test-quick: tools ## Run the tests that are quick, for daily work: two minutes at most
	$(PYTEST) -m "not slow"

test-extension: ## Run the tests of the picture part, and those of the VS Code extension that need no VS Code
	@$(NEEDS_NODE) $(MAKE) --no-print-directory modules && for part in $(PICTURE) $(EXTENSION); do \
		(cd $$part && npm test --silent) || exit 1; done

test-workbench: tools vsix ## Drive the extension in a real VS Code; screenshots in out/screenshots/; needs chromium and rg
	$(EXTENSION)/test/e2e/run.sh $(OUT)

SECONDS ?= 120
SEED ?= $(shell date +%s)
fuzz: tools ## Try input that nobody would think of, two minutes a target (TARGETS="text edits" SECONDS=7200 SEED=1)
	$(BIN)/python -m fuzz $(TARGETS) --seconds $(SECONDS) --seed $(SEED)

lint: tools ## Check style, types and that generated files are current
	$(BIN)/ruff check
	$(BIN)/ruff format --check
	$(BIN)/basedpyright
	cargo fmt --all --check --manifest-path renderer/Cargo.toml
	cargo clippy --quiet --workspace --all-targets --manifest-path renderer/Cargo.toml -- -D warnings
	$(BIN)/m3dfmt --check examples/*.m3d
	cd grammar && ../$(BIN)/python -m generate --check
	@$(MAKE) --no-print-directory lint-extension

lint-extension: ## Check style and types of the picture part and the VS Code extension
	@$(NEEDS_NODE) $(MAKE) --no-print-directory modules && for part in $(PICTURE) $(EXTENSION); do \
		(cd $$part && npm run --silent check) || exit 1; done

format: tools ## Lay out the Python and Rust code
	$(BIN)/ruff check --fix --quiet
	$(BIN)/ruff format
	cargo fmt --all --manifest-path renderer/Cargo.toml

viewer: tools ## Bring pyvista (700 MB), for m3d-view and its tests
	@echo "Bringing pyvista (700 MB) ..."
	@$(UV) sync --quiet --inexact --group view

wasm: ## Build the kernel for web pages, out/wasm/m3d_web.wasm (the first time a few minutes)
	tools/wasm.sh $(OUT)/wasm

generate: tools ## Write everything that is made of something else: of grammar/language.toml, the IR, the version
	$(BIN)/python -m tools.version
	cd grammar && ../$(BIN)/python -m generate
	cargo run --quiet --release --manifest-path grammar/parser-generator/Cargo.toml
	$(BIN)/python -m tools.ir_crate
	$(BIN)/python -m tools.m3ir_page
	$(BIN)/python -m tools.render_options
	$(BIN)/python -m tools.preview_protocol
	$(BIN)/python -m tools.diagnostics_page

pins: tools ## Write the newest allowed version of every Python package into pyproject.toml
	$(BIN)/python -m tools.pins

gallery: tools ## Render the pictures of the documentation anew
	$(BIN)/python -m tools.gallery
	$(BIN)/python -m tools.texture_pictures
	$(BIN)/python -m tools.mirages_page

bench: tools ## Measure speed and memory, beside POV-Ray where it is installed
	$(BIN)/python -m bench

vsix: modules ## Pack the VS Code extension into out/
	@mkdir -p $(OUT)
	@rm -f $(OUT)/m3d-*.vsix
	cd $(EXTENSION) && npm run --silent pack -- --out $(CURDIR)/$(OUT)/

wheels: release-tools ## Build the distributions into dist/, and try them where there is no compiler
	$(BIN)/python -m tools.release wheels

release: release-tools ## Make all files of a release in dist/, with checksums: make release VERSION=x.y.z
	@test -n "$(VERSION)" || { echo "Which version? make release VERSION=x.y.z"; exit 2; }
	$(BIN)/python -m tools.release release $(VERSION)

# --- what the commands above need ------------------------------------------------------------------------------------

needs:
	@PYTHON="$(PYTHON)" sh tools/needs.sh

$(UV): | needs
	@echo "Building the programs into $(VENV): some minutes the first time."
	$(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check uv

# uv builds a part anew when its sources have changed, and does nothing otherwise. The first time it shows what it does.
QUIET = $$(test -x $(BIN)/m3dc && echo --quiet)

programs: needs $(UV)
	@$(UV) sync $(QUIET) --inexact --no-dev

tools: needs $(UV)
	@$(UV) sync $(QUIET) --inexact

# Tools that nobody else needs, zig among them (500 MB), in an environment of their own.
release-tools: tools
	@UV_PROJECT_ENVIRONMENT=$(OUT)/packaging/tools $(UV) sync --quiet --only-group release

# npm leaves this file. It is not `npm ci`, which refuses where the lock file lacks a package for another platform.
modules: $(PICTURE)/node_modules/.package-lock.json $(EXTENSION)/node_modules/.package-lock.json

%/node_modules/.package-lock.json: %/package-lock.json
	cd $* && npm install --ignore-scripts --no-save --no-audit --no-fund --loglevel=error
	@touch $@
