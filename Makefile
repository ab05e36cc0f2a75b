# Everything starts here: a fresh machine needs Python 3.11 or later, a C compiler and make.
# The first `make demo` or `make test` installs into .venv; later ones start at once.

PYTHONS := python3.13 python3.12 python3.11 python3
PYTHON ?=
JOBS ?= 2
TESTS ?=
BIN := .venv/bin
PYTEST = env -u PYTHONDONTWRITEBYTECODE OPENBLAS_NUM_THREADS=1 $(BIN)/python -m pytest -q -n $(JOBS) --dist worksteal

.DEFAULT_GOAL := help
.DELETE_ON_ERROR:
test: EVERY = 5
test-all coverage docs: EVERY = 1
.PHONY: help demo test test-all coverage lint docs regenerate clean

help:
	@echo 'make demo         install, then a hidden effect found and added, on two built-in robots: pages in demo/'
	@echo 'make test         install, then ruff, mypy and the tests (JOBS=2 processes; TESTS=tests/fit some);'
	@echo '                  cases that repeat what others show run in one of EVERY=5 runs'
	@echo 'make test-all     every test, the long ones too: all robots, many seeds, mutated files'
	@echo '                  (EVERY=5: those that repeat what others show in one of five runs)'
	@echo 'make coverage     make test-all, then the lines and branches it ran, and the functions least covered'
	@echo 'make lint         ruff and mypy only'
	@echo 'make docs         the documentation as a site, in build/site; nothing in it needs the network'
	@echo '                  (EVERY=5: of the pictures that take long, today a fifth)'
	@echo 'make regenerate   write generated/ and the generated pages of docs/ anew;'
	@echo '                  DIFF=robot: show how its C differs from that of the last commit, write nothing'
	@echo 'make clean        remove all that these commands made, .venv included'
	@echo 'PYTHON=...        the Python to install with; default: the first of $(PYTHONS)'

demo: .venv/.installed
	$(BIN)/modeler demo --out demo

# mypy works beside the tests, and speaks after them.
test: .venv/.installed-test
	@$(call beside_mypy,$(PYTEST) --every $(EVERY) -m 'not slow' $(TESTS))

test-all: .venv/.installed-test
	@$(call beside_mypy,$(PYTEST) --every $(EVERY) $(TESTS))

coverage: .venv/.installed-test
	$(PYTEST) --cov --cov-report= --every $(EVERY) $(TESTS)
	$(BIN)/python -m tests.coverage_report

lint: .venv/.installed-test
	$(BIN)/python -m ruff check .
	$(BIN)/python -m ruff format --check .
	$(BIN)/python -m mypy

docs: .venv/.installed-docs
	EVERY=$(EVERY) NO_MKDOCS_2_WARNING=1 $(BIN)/python -m mkdocs build --strict
	@echo 'built: build/site/index.html'

regenerate: .venv/.installed-test
ifdef DIFF
	@rm -rf build/difference; mkdir -p build/difference/last
	@git archive HEAD modeler templates csrc | tar -x -C build/difference/last
	@cd build/difference/last && '$(CURDIR)/$(BIN)/python' -m modeler -q generate '$(DIFF)' --out ../before >/dev/null
	@$(BIN)/python -m modeler -q generate '$(DIFF)' --out build/difference/now >/dev/null
	@cd build/difference && git diff --no-index before now && echo 'no difference' || true
else
	$(BIN)/python -m pytest -q --regenerate
endif

clean:
	rm -rf .venv build dist demo .pytest_cache .mypy_cache .ruff_cache .hypothesis
	find . -name __pycache__ -type d -prune -exec rm -rf {} +

# The build tools go first, at their pinned versions, so that building downloads nothing by itself.
.venv/.installed: pyproject.toml constraints.txt
	@$(find_compiler)
	@$(make_venv)
	$(BIN)/python -m pip install -q -c constraints.txt hatchling editables hatch-fancy-pypi-readme
	$(BIN)/python -m pip install -q -c constraints.txt --no-build-isolation -e .
	@touch $@

.venv/.installed-test: .venv/.installed
	$(BIN)/python -m pip install -q -c constraints.txt --no-build-isolation -e '.[test]'
	@touch $@

.venv/.installed-docs: .venv/.installed
	$(BIN)/python -m pip install -q -c constraints.txt --no-build-isolation -e '.[docs]'
	@touch $@

define beside_mypy
for place in $(TESTS); do \
  test -e "$${place%%::*}" || { echo "TESTS=$$place: there is no such file or folder" >&2; exit 1; }; \
done; \
$(BIN)/python -m ruff check . && $(BIN)/python -m ruff format --check . || exit 1; \
mkdir -p build; $(BIN)/python -m mypy >build/mypy.txt 2>&1 & types=$$!; \
trap 'kill $$types 2>/dev/null' INT TERM; \
echo "$(subst ",\",$(1))"; $(1); tests=$$?; \
wait $$types; status=$$?; cat build/mypy.txt; test $$tests -eq 0 -a $$status -eq 0
endef

define find_compiler
for name in $${CC:-cc} gcc clang; do \
  command -v $$name >/dev/null 2>&1 && exit 0; \
done; \
echo 'modeler: no C compiler (cc, gcc, clang) found; install one, on Debian: apt install gcc' >&2; \
exit 1
endef

# A name on the path may be a version manager's stub, so each Python is run, not only looked for.
define make_venv
$(BIN)/python -m pip --version >/dev/null 2>&1 && exit 0; \
for name in $(if $(PYTHON),'$(PYTHON)',$(PYTHONS)); do \
  "$$name" -c 'import sys; sys.exit(sys.version_info < (3, 11))' >/dev/null 2>&1 || continue; \
  found=$$name; \
  "$$name" -c 'import venv, ensurepip' >/dev/null 2>&1 || continue; \
  echo "installing into .venv with $$name; this takes a minute or two"; \
  rm -rf .venv; "$$name" -m venv .venv; exit $$?; \
done; \
if [ -n "$$found" ]; then \
  echo "modeler: $$found has no venv module; install it, on Debian: apt install python3-venv" >&2; \
else \
  echo 'modeler: Python 3.11 or later not found; install it, or name it: make PYTHON=...' >&2; \
fi; exit 1
endef
