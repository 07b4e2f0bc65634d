# `make help` lists the commands. They need python3 (3.11 or newer, with venv), a C compiler and cargo; everything else
# is brought into .venv.

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
OUT := out
export UV_PYTHON_DOWNLOADS := never
UV := $(BIN)/uv
CARGO_TEST := cargo test --quiet --release --manifest-path renderer/Cargo.toml

.DEFAULT_GOAL := help
.PHONY: help demo test lint format generate gallery bench programs tools

help: ## Show this list
	@sed -n 's/^\([a-z]*\):.*## /\1\t/p' $(MAKEFILE_LIST) | while IFS="$$(printf '\t')" read -r name text; do \
		printf '  make %-10s %s\n' "$$name" "$$text"; done

demo: programs ## Render the merman scene with straight and with bent rays into out/
	@mkdir -p $(OUT)
	$(BIN)/m3dc -o $(OUT)/merman.m3ir examples/merman.m3d
	$(BIN)/m3d-render $(OUT)/merman.m3ir --straight -o $(OUT)/merman-straight.png
	$(BIN)/m3d-render $(OUT)/merman.m3ir -o $(OUT)/merman-mirage.png
	@echo "What is there:      $(CURDIR)/$(OUT)/merman-straight.png"
	@echo "What one sees of it: $(CURDIR)/$(OUT)/merman-mirage.png"

test: tools ## Run all tests
	$(BIN)/python -m pytest -q
	$(CARGO_TEST)

lint: tools ## Check style, types and that generated files are current
	$(BIN)/ruff check
	$(BIN)/ruff format --check
	$(BIN)/basedpyright
	cargo fmt --check --manifest-path renderer/Cargo.toml
	cargo clippy --quiet --all-targets --manifest-path renderer/Cargo.toml -- -D warnings
	$(BIN)/m3dfmt --check examples/*.m3d
	cd grammar && ../$(BIN)/python -m generate --check

format: tools ## Lay out the Python and Rust code
	$(BIN)/ruff check --fix --quiet
	$(BIN)/ruff format
	cargo fmt --manifest-path renderer/Cargo.toml

generate: tools ## Write everything that is made of grammar/language.toml
	cd grammar && ../$(BIN)/python -m generate
	cargo run --quiet --release --manifest-path grammar/parser-generator/Cargo.toml
	$(BIN)/python docs/m3ir.py
	$(BIN)/python docs/diagnostics.py

gallery: tools ## Render the pictures of the documentation anew
	$(BIN)/python docs/gallery.py
	$(BIN)/python docs/texture_pictures.py
	$(BIN)/python docs/mirages.py

bench: tools ## Measure speed and memory, beside POV-Ray where it is installed
	$(BIN)/python -m bench

# --- what the commands above need ------------------------------------------------------------------------------------

$(UV):
	$(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check uv

# uv builds a part anew when its sources have changed, and does nothing otherwise.
programs: $(UV)
	@$(UV) sync --quiet --inexact --no-dev

tools: $(UV)
	@$(UV) sync --quiet --inexact
