# Needs make and Python 3.11 or newer; everything else goes into .venv.

PYTHON ?= python3
CORES ?= 2
VENV := .venv
BIN := $(VENV)/bin
PIP := $(BIN)/python -m pip install --quiet --disable-pip-version-check --no-compile \
	-c envs/constraints.txt
# All cores compile what pip, on one core, would have compiled. The tests of packages and a few
# modules for other versions of Python do not matter.
COMPILE := $(BIN)/python -m compileall -qq -j$(CORES) -x '/tests?/' $(VENV)/lib || true
SNAKEMAKE := $(BIN)/snakemake -j$(CORES)

.PHONY: install reproduce draft test test-quick test-processors test-wheel coverage lint format dag benchmark benchmark-run docs pictures

install: $(VENV)/.run  ## the environment alone

reproduce: $(VENV)/.run  ## the full reproduction, at standard fidelity
	$(SNAKEMAKE)

draft: $(VENV)/.run  ## everything, quick and rough
	$(SNAKEMAKE) --config fidelity=draft

# A process that has finished its share of the tests takes over what is left of the other's.
PYTEST := OMP_NUM_THREADS=1 $(BIN)/python -m pytest -n $(CORES) --dist worksteal

test: $(VENV)/.dev $(VENV)/.docs $(VENV)/.peers  ## all tests
	$(PYTEST)

test-quick: $(VENV)/.dev  ## two to three minutes: no workflow, no other codes, none that is slow
	$(PYTEST) -m "not slow and not workflow and not peers"

test-processors: $(VENV)/.dev $(VENV)/.peers  ## tests of what rounding may move, with the arithmetic of other processors
	$(BIN)/python tests/helpers/run_processors.py -n $(CORES) --dist worksteal

test-wheel: $(VENV)/.dev  ## the package as an index would have it, installed in an environment of its own
	$(BIN)/python tests/helpers/try_wheel.py

coverage: $(VENV)/.dev  ## statements and branches of the library that its quick tests reach
	OMP_NUM_THREADS=1 $(BIN)/python -m coverage run -m pytest tests/stickiness \
		-m "not slow and not workflow and not peers"
	$(BIN)/python -m coverage report --skip-covered

lint: $(VENV)/.dev  ## format, spelling, types and layers, nothing changed
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/codespell
	$(BIN)/mypy
	$(BIN)/mypy --platform win32
	$(BIN)/mypy --platform darwin
	PYTHONPATH=scripts $(BIN)/lint-imports --no-cache
	$(BIN)/snakefmt --check Snakefile rules
	$(BIN)/python tests/helpers/lint_rules.py

format: $(VENV)/.dev
	$(BIN)/ruff format .
	$(BIN)/ruff check --fix .
	$(BIN)/snakefmt Snakefile rules

# Snakemake prints this table twice, amid other lines; those are shown if it fails.
dag: $(VENV)/.run  ## what would run
	@found=$$($(BIN)/snakemake -n --quiet host rules reason 2>&1) || { echo "$$found"; exit 1; }; \
	echo "$$found" | sed -n '/^Nothing/p; /^job /,/^total/p; /^total/q'

# Sphinx runs the notebook, too, and takes the root of the project for its folder of sources.
SPHINX := $(BIN)/python -m sphinx -W --keep-going -c docs

docs: $(VENV)/.docs  ## pages in docs/_build/html, the reference of the configuration, and the validation
	PYTHONPATH=scripts $(BIN)/python -m common.config.reference
	PYTHONPATH=scripts $(BIN)/python -m limits.validation
	$(SPHINX) -b html . docs/_build/html

pictures: $(VENV)/.run  ## pictures and examples of README.md and docs, from results/standard and with Chromium
	$(BIN)/python docs/take_pictures.py

benchmark: $(VENV)/.dev $(VENV)/.aspher  ## the contact solver beside its peers
	PYTHONPATH=scripts $(BIN)/python benchmarks/repulsive_vs_peers.py

benchmark-run: $(VENV)/.run  ## two commits of this project in turn: make benchmark-run BASE=<commit>
	$(BIN)/python benchmarks/two_commits.py $(BASE)

$(VENV)/bin/python:
	$(PYTHON) -c 'import sys; sys.exit("Python 3.11 or newer is needed: make PYTHON=…" if sys.version_info < (3, 11) else 0)'
	$(PYTHON) -m venv $(VENV)
	$(PIP) --upgrade pip

$(VENV)/.run: envs/requirements.txt envs/constraints.txt | $(VENV)/bin/python
	$(PIP) -r envs/requirements.txt
	$(PIP) --no-deps --editable .
	$(COMPILE)
	touch $@

$(VENV)/.dev: envs/dev.txt $(VENV)/.run
	$(PIP) -r envs/dev.txt
	$(COMPILE)
	touch $@

$(VENV)/.docs: envs/docs.txt $(VENV)/.run
	$(PIP) -r envs/docs.txt
	$(COMPILE)
	touch $@

# Reference codes for tests and benchmarks, which leave out those that do not install.
$(VENV)/.peers: envs/peers.txt $(VENV)/.dev
	-$(PIP) -r envs/peers.txt
	$(COMPILE)
	touch $@

# Built from source, for minutes, and for the benchmark alone.
$(VENV)/.aspher: envs/aspher.txt $(VENV)/.peers
	-$(PIP) -r envs/aspher.txt
	touch $@
