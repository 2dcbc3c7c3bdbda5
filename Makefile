# make        set up .venv if it is missing, then derive, check, generate, document and measure
# make test   set up, then prove everything again and run the tests
# make extras add what the optional parts need (numba, PyElastica, dask.distributed)
# make lint   style, types and the layers
SHELL := /bin/bash
.DEFAULT_GOAL := run
.PHONY: run setup extras peers test lint lock clean

PYTHONS := python3 python3.13 python3.12 python3.11
BIN := .venv/bin
STAMP := .venv/installed
PORTIONS := derivations codegen generated

run: $(STAMP)
	@$(BIN)/rodproof run

setup: $(STAMP)

test: $(STAMP)
	@$(BIN)/python -m pytest -q -n 2

# Parts that need an extra are tested where it is installed, and named as skipped elsewhere.
extras: $(STAMP)
	$(BIN)/python -m pip install -q --disable-pip-version-check -r requirements-extras.lock

peers: extras
	$(BIN)/python -m pip install -q --disable-pip-version-check -r requirements-peers.lock

lint: $(STAMP)
	@mkdir -p .venv/typing/rodproof
	@for portion in $(PORTIONS); do ln -sfn ../../../$$portion .venv/typing/rodproof/$$portion; done
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy $(PORTIONS:%=-p rodproof.%)
	$(BIN)/lint-imports --no-cache

# The stamp holds as long as the pinned versions and the list of packages do.
$(STAMP): requirements.lock pyproject.toml
	@set -e; \
	if ! $(BIN)/python -m pip --version >/dev/null 2>&1; then \
	    for name in $(PYTHONS); do \
	        if "$$name" -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null; then \
	            python="$$name"; break; fi; \
	    done; \
	    if [ -z "$${python:-}" ]; then \
	        echo "rodproof needs Python 3.11 or newer; none of these is: $(PYTHONS)" >&2; exit 1; fi; \
	    if ! "$$python" -c 'import venv, ensurepip' 2>/dev/null; then \
	        echo "$$python has no venv module; on Debian: apt-get install python3-venv" >&2; exit 1; fi; \
	    echo "setting up .venv with $$("$$python" --version), once"; \
	    "$$python" -m venv --clear .venv; \
	fi; \
	$(BIN)/python -m pip install -q --disable-pip-version-check -r requirements.lock; \
	$(BIN)/python -m pip install -q --disable-pip-version-check --no-build-isolation --no-deps -e .; \
	touch $@

# Pins what a fresh environment gets today, layer by layer (for whoever maintains the project).
FREEZE := -m pip freeze --all --exclude pip | LC_ALL=C sort -f
lock: $(STAMP)
	@set -e; bare=$$(mktemp -d); trap 'rm -rf "$$bare"' EXIT; \
	$(BIN)/python -m venv "$$bare"; : > "$$bare/before"; \
	for layer in test,lint:requirements numba,elastica,cluster:requirements-extras \
	             peers:requirements-peers; do \
	    "$$bare/bin/python" -m pip install -q --disable-pip-version-check ".[$${layer%%:*}]"; \
	    "$$bare/bin/python" $(FREEZE) | grep -v '^rodproof' > "$$bare/after"; \
	    comm -13 <(LC_ALL=C sort "$$bare/before") <(LC_ALL=C sort "$$bare/after") | \
	        LC_ALL=C sort -f > "$${layer#*:}.lock"; \
	    cp "$$bare/after" "$$bare/before"; \
	done; \
	touch $(STAMP)

clean:
	rm -rf build dist .pytest_cache .mypy_cache .ruff_cache .hypothesis .import_linter_cache
