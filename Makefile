# make run      install, then run the main job: a real delivery, from pallet to trolleys
# make serve    install, then show the cell's screen; it prints one link
# make studies  the paper's case studies on geometry alone
# make test     install, then check and test everything; samples every figure
# make check    formatting, lint, types and layers only
# make figures  measure every figure (half an hour; resumable) and print the table of the README

PYTHON ?= python3
BIN := .venv/bin
OUT ?= out
COVERAGE := --cov=depal.domain --cov=depal.geometry --cov=depal.selection --cov=depal.errors \
	--cov-branch --cov-report=term-missing:skip-covered --cov-fail-under=100

.PHONY: run serve studies test check figures clean

run: .venv/.installed
	@mkdir -p $(OUT)
	@rm -rf $(OUT)/run
	$(BIN)/depal run --record $(OUT)/run --json $(OUT)/run.json
	@echo "the run as it went: $(OUT)/run/run.gif; decision by decision: $(BIN)/depal replay $(OUT)/run"

serve: .venv/.installed
	$(BIN)/depal serve --data $(OUT)/depal-data

studies: .venv/.installed
	@mkdir -p $(OUT)
	$(BIN)/depal study table1 --json $(OUT)/table1.json --plot $(OUT)/table1.png
	$(BIN)/depal study fig8 --json $(OUT)/fig8.json --plot $(OUT)/fig8.png
	$(BIN)/depal study fig9 --json $(OUT)/fig9.json --plot $(OUT)/fig9.png
	$(BIN)/depal study case2 --json $(OUT)/case2.json --plot $(OUT)/case2.png

test: check
	@find src -name '*.nb[ic]' -delete
	$(BIN)/pytest -q -n 2
	NUMBA_DISABLE_JIT=1 $(BIN)/pytest -q tests/domain tests/geometry tests/selection $(COVERAGE)

check: .venv/.installed
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/lint-imports
	$(BIN)/mypy

figures: .venv/.installed
	$(BIN)/python scripts/figures.py

clean:
	rm -rf .venv $(OUT) .figures .mypy_cache .pytest_cache .ruff_cache .hypothesis .import_linter_cache .coverage
	find . -name __pycache__ -type d -prune -exec rm -rf {} +

.venv/.installed: pyproject.toml constraints.txt
	$(PYTHON) -m venv .venv
	$(BIN)/python -m pip install --disable-pip-version-check --quiet --constraint constraints.txt --editable '.[dev]'
	@touch $@
