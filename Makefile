# make        set up .venv if it is missing, then derive, check, generate, document and measure
# make test   set up, then prove everything again and run the tests
# make lint   style, types and the layers
SHELL := /bin/bash
.DEFAULT_GOAL := run
.PHONY: run setup test lint lock clean

PYTHONS := python3 python3.13 python3.12 python3.11
BIN := .venv/bin
STAMP := .venv/installed
PORTIONS := derivations codegen generated

run: $(STAMP)
	@$(BIN)/rodproof run

setup: $(STAMP)

test: $(STAMP)
	@$(BIN)/python -m pytest -q -n 2

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

# Pins what is installed now (for whoever maintains the project).
lock: $(STAMP)
	@$(BIN)/python -m pip freeze --all --exclude-editable --exclude pip | LC_ALL=C sort -f > requirements.lock.new
	@mv requirements.lock.new requirements.lock && touch $(STAMP)

clean:
	rm -rf build dist .pytest_cache .mypy_cache .ruff_cache .hypothesis .import_linter_cache
