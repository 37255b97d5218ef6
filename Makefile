PYTHON ?= python3
sources := $(shell find cli core twin -name '*.py')
checked := $(sources) $(shell find tests benchmarks docs configs -type f -not -path '*/__pycache__/*' 2>/dev/null) README.md Makefile

help: ## show the targets
	@sed -n 's/^\([a-z]*\):.*## /\1\t/p' $(MAKEFILE_LIST)

maps: outputs/maps.png ## compute configs/maps.toml into outputs/maps.nc, and draw outputs/maps.png

test: build/tested ## lint, types and tests

stress: .venv/installed ## the long form of the stress suite (minutes)
	.venv/bin/python -m tests.stress.long

bench: .venv/installed ## measure time and error (minutes), and write docs/benchmarks.md and its figures
	.venv/bin/python -m benchmarks

clean: ## remove the virtual environment and what was built (outputs stay)
	rm -rf .venv build .mypy_cache .ruff_cache .pytest_cache

.venv/installed: pyproject.toml constraints.txt
	$(PYTHON) -m venv .venv
	.venv/bin/python -m pip install --quiet --disable-pip-version-check -c constraints.txt -e '.[test]'
	touch $@

outputs/maps.nc: configs/maps.toml $(sources) .venv/installed
	.venv/bin/gradhesion run configs/maps.toml -o $@ --overwrite

outputs/maps.png: outputs/maps.nc
	.venv/bin/gradhesion plot $< -o $@ --overwrite

build/types/gradhesion:
	mkdir -p $@
	ln -s ../../../core ../../../cli ../../../twin $@

build/tested: $(checked) .venv/installed | build/types/gradhesion
	.venv/bin/ruff check
	.venv/bin/ruff format --check
	.venv/bin/mypy
	.venv/bin/pytest
	touch $@

.PHONY: help maps test stress bench clean
