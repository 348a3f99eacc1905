# Every target sets up what it needs and does nothing twice. `make` alone lists them.
SHELL := /bin/bash
.SHELLFLAGS := -euo pipefail -c
.DEFAULT_GOAL := help
.DELETE_ON_ERROR:
.NOTPARALLEL:

PYTHON ?= python3
HOST = 127.0.0.1
PORT = 8000
ARGS =

BIN := .venv/bin
GL_PACKAGES := libegl1 libgl1 libgl1-mesa-dri
# Of Mitsuba's llvm variant, which the benchmark goes without where there is none.
LLVM_PACKAGES := libllvm19
WEB_SOURCES := $(shell find web/src web/public web/index.html web/*.json web/*.ts 2>/dev/null)
BENCH_NPM := $(if $(wildcard bench/package-lock.json),bench/node_modules/.stamp)

.PHONY: help
help: ## list the targets
	@sed -n 's/^\([a-z]*\):[^#]*## \(.*\)/  make \1\t\2/p' $(MAKEFILE_LIST) | expand -t 17

.PHONY: setup
setup: system-gl system-chromium .venv/.stamp-dev web/dist/index.html ## everything that play, test, bench and check need

.PHONY: play
play: system-gl .venv/.stamp-play web/dist/index.html ## serve the playground (HOST=127.0.0.1 PORT=8000)
	$(BIN)/lightbench serve --host $(HOST) --port $(PORT)

.PHONY: test
test: setup ## run every test (ARGS= goes to pytest); with CI=true a skipped test fails
	cd web && npm test
	$(BIN)/pytest -n auto --dist loadfile --no-loadscope-reorder $(ARGS)

.PHONY: bench
bench: setup bench-peer $(BENCH_NPM) ## measure frames and rays, offline and in Chromium
	$(BIN)/python -m bench $(ARGS)

.PHONY: check
check: .venv/.stamp-dev web/node_modules/.stamp ## format, lint and types of Python and TypeScript
	$(BIN)/ruff format --check
	$(BIN)/ruff check
	$(BIN)/mypy
	cd web && npm run check

.PHONY: goldens
goldens: system-gl .venv/.stamp-dev ## render the golden images anew: look at them before you commit
	$(BIN)/pytest tests/test_golden.py tests/test_figure_sheets.py --update-goldens $(ARGS)

# $(call apt,PACKAGES): install the missing ones where that is allowed, else name the command.
define apt
command -v dpkg-query >/dev/null || exit 0; \
missing=$$(for p in $(1); do \
  [[ "$$(dpkg-query -W -f='$${Status}' $$p 2>/dev/null)" == *"ok installed"* ]] || echo $$p; \
done | paste -sd' '); \
[ -n "$$missing" ] || exit 0; \
if [ "$$(id -u)" = 0 ]; then root=; elif sudo -n true 2>/dev/null; then root="sudo -n"; else \
  echo "Missing system packages; run: sudo apt-get install -y $$missing" >&2; exit 1; fi; \
echo "Installing $$missing"; \
apt="$$root env DEBIAN_FRONTEND=noninteractive apt-get -qq -o DPkg::Lock::Timeout=300"; \
$$apt update; $$apt install -y --no-install-recommends $$missing </dev/null >/dev/null
endef

.PHONY: system-gl
system-gl:
	@$(call apt,$(GL_PACKAGES))

.PHONY: system-chromium
system-chromium:
	@for name in chromium chromium-browser google-chrome; do \
	  ! command -v $$name >/dev/null || exit 0; done; \
	$(call apt,chromium)

.PHONY: bench-peer
bench-peer: .venv/.stamp-bench
	@($(call apt,$(LLVM_PACKAGES))) || echo "No $(LLVM_PACKAGES): the benchmark says what it leaves out." >&2

.venv/bin/pip:
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null || \
	  { echo "Lightbench needs Python 3.11 or newer: make PYTHON=/path/to/python3.11 ..." >&2; exit 1; }
	@! $(PYTHON) -c 'import ensurepip' 2>/dev/null || exit 0; $(call apt,python3-venv)
	$(PYTHON) -m venv .venv

.venv/.stamp-play: pyproject.toml | .venv/bin/pip
	$(BIN)/pip install --quiet --disable-pip-version-check -e '.[atlas]'
	@touch $@

.venv/.stamp-dev: pyproject.toml | .venv/bin/pip
	$(BIN)/pip install --quiet --disable-pip-version-check -e '.[dev]'
	@touch .venv/.stamp-play $@

.venv/.stamp-bench: .venv/.stamp-dev
	$(BIN)/pip install --quiet --disable-pip-version-check -e '.[bench]' && touch $@ || \
	  echo "No Mitsuba: the benchmark says what it leaves out." >&2

.PHONY: node
node:
	@node -e 'const [a, b] = process.versions.node.split("."); process.exit(a > 20 || (a == 20 && b >= 19) ? 0 : 1)' \
	  2>/dev/null && command -v npm >/dev/null || \
	  { echo "Lightbench needs Node 20.19 or newer, with npm." >&2; exit 1; }

%/node_modules/.stamp: %/package.json %/package-lock.json | node
	cd $* && npm ci --no-audit --no-fund
	@touch $@

web/dist/index.html: web/node_modules/.stamp $(WEB_SOURCES)
	cd web && npm run build
	@touch $@
