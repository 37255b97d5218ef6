PYTHON ?= python3
sources := $(shell find api cli core twin -name '*.py')
drawing := $(wildcard figures/*.py api/*.mplstyle)
# Not the pages and pictures that are written here: to check the sources would draw them anew, where a clone dates them before these.
checked := $(sources) $(drawing) $(shell find tests benchmarks docs configs -type f -not -path '*/__pycache__/*' -not -path 'docs/reference/*' -not -name '*.png' -not -name '*.svg' 2>/dev/null) README.md CITATION.cff Makefile
pictures := $(addprefix fig,1 2a 2b 3a 3b 3c 4a 4b 4c 5a 5b 5c 6 7a 7b 7c 8 9)
pictures += $(addprefix extra_,amplitudes rim energy_map energy_exponent energy_amplitude energy_wavelength roughness best_exponent best_wavelength error_bars front closing split speed)

help: # show the targets
	@sed -n 's/^\([a-z-]*\):.*## /\1\t/p' $(MAKEFILE_LIST)

maps: outputs/maps.png ## compute configs/maps.toml into outputs/maps.nc, and draw two maps of it as outputs/maps.png

figures: $(foreach form,png pdf,$(pictures:%=outputs/figures/%.$(form))) ## draw the figures of the paper into outputs/figures/, .png and .pdf

docs-figures: $(pictures:%=docs/figures/paper/%.png) docs/figures/paper/fig1.svg # draw them small for docs/paper.md

test: build/tested ## lint, types and tests

docs: .venv/complete ## build the manual into build/docs/, offline, a warning being an error
	.venv/bin/python -m sphinx -E -a -q -W --keep-going -d build/doctrees docs build/docs

lowest: build/lowest/tested build/before/tested # the quick tests with the lowest versions of pyproject.toml, and with the numba before the newest

stress: .venv/complete ## run what takes minutes: 100,000 hostile scenes, runs killed at 200 random moments and at every rename, the recipes of docs/architecture.md
	STRESS_SCENES=100000 STRESS_SEED=1000 .venv/bin/pytest tests/stress -k long
	.venv/bin/python -m tests.faults.trials --random 200
	.venv/bin/pytest tests/stress/recipes.py

bench: .venv/complete ## measure time and error (minutes), and write docs/benchmarks.md and its figures
	.venv/bin/python -m benchmarks

clean: # remove the virtual environment and what was built (outputs stay)
	rm -rf .venv build dist .mypy_cache .ruff_cache .pytest_cache

# Modules are compiled when they are first imported: to compile all of them takes as long as the rest. Where none may be
# kept, as some containers set, every process would compile all that it imports: a second in place of a fifth.
unexport PYTHONDONTWRITEBYTECODE
install = .venv/bin/python -m pip install --quiet --no-compile --disable-pip-version-check -c constraints.txt

.venv/installed: pyproject.toml constraints.txt | build/types/gradhesion
	$(PYTHON) -m venv .venv
	$(install) -e .
	echo $(CURDIR)/build/types > "$$(echo .venv/lib/python*/site-packages)/gradhesion.pth" # mypy and pyright follow no import hook
	touch $@

.venv/complete: .venv/installed
	$(install) -e '.[docs,test]'
	touch $@

outputs/maps.nc: configs/maps.toml $(sources) .venv/installed | build/types/gradhesion
	.venv/bin/gradhesion run configs/maps.toml -o $@ --overwrite

outputs/maps.png: outputs/maps.nc
	.venv/bin/gradhesion plot $< -o $@ --at c0_over_R=0.01 --at A=0.05 --at a_max_over_R=0.3 --width page --no-title --overwrite

# The study of a picture: its own, as configs/fig4a.toml, or one of several panels, as configs/fig3.toml for fig3a.
dataset = outputs/figures/$(notdir $(basename $(or $(wildcard configs/$(1).toml),$(foreach panel,a b c,$(wildcard configs/$(1:%$(panel)=%).toml))))).nc

outputs/figures/%.nc: configs/%.toml $(sources) .venv/installed | build/types/gradhesion
	.venv/bin/gradhesion run $< -o $@ --overwrite --quiet

.SECONDEXPANSION:
outputs/figures/%.png outputs/figures/%.pdf: $$(call dataset,$$*) $(drawing)
	.venv/bin/python -m figures $* $< $(basename $@).png $(basename $@).pdf

docs/figures/paper/%.png: $$(call dataset,$$*) $(drawing)
	.venv/bin/python -m figures $* $< $@ --dpi 120

docs/figures/paper/%.svg: $$(call dataset,$$*) $(drawing)
	.venv/bin/python -m figures $* $< $@

.PRECIOUS: outputs/figures/%.nc

# The package by links to the sources, which tools and Python read. Files that come or go change the date of api/.
build/types/gradhesion: api
	rm -rf $@
	mkdir -p $@
	ln -s $(addprefix ../../../,cli configs core twin $(filter-out api/__pycache__,$(wildcard api/*))) $@

build/tested: $(checked) .venv/complete | build/types/gradhesion
	.venv/bin/ruff check
	.venv/bin/ruff format --check
	.venv/bin/mypy & .venv/bin/gradhesion warmup --all --quiet && wait $$! # side by side: tests find all compiled
	.venv/bin/pytest -n auto --dist loadfile --no-loadscope-reorder --max-worker-restart 0
	touch $@

# Environments of other versions than those of constraints.txt. What old packages call out of date in others is theirs.
build/lowest/tested: versions = --resolution lowest-direct
build/before/tested: versions = -c build/before/others.txt '$(shell sed -n 's/^numba==\([0-9]*\.[0-9]*\).*/numba<\1/p' constraints.txt)'

build/lowest/tested build/before/tested: build/%/tested: $(sources) $(shell find tests -name '*.py') pyproject.toml constraints.txt
	$(PYTHON) -m venv build/$*/.venv
	build/$*/.venv/bin/python -m pip install --quiet --disable-pip-version-check uv
	grep -Ev '^(numba|llvmlite|numpy)==' constraints.txt > build/$*/others.txt
	build/$*/.venv/bin/uv pip install --quiet --python build/$*/.venv/bin/python $(versions) -e '.[test]'
	build/$*/.venv/bin/pytest -n auto --dist loadfile -m 'not slow' -W ignore::DeprecationWarning -W ignore::FutureWarning -W 'ignore:numpy.ndarray size changed:RuntimeWarning' tests/api tests/cli tests/core
	touch $@

.PHONY: docs lowest help maps figures docs-figures test stress bench clean
