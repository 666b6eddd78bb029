# Everything from a bare checkout: each target installs what it needs (scripts/setup), configures, builds and runs.
# Logs: build/log/. Settings: JOBS=n, PRESET=release|gcc|debug|asan, PREFIX=/usr/local, QUICK=1 (demo), FILTER=regex (test, fuzz), TIME=n (fuzz),
# ONLY=regex (mutations, key-figures), UNITY=OFF (the first time: each source by itself, for who works on the code).
JOBS ?= $(shell nproc)
PRESET ?= release
PREFIX ?= /usr/local
FILTER ?= .
ONLY ?=
TIME ?= 60
COUNT ?= 100
UNITY ?= ON
BUILD = build/$(PRESET)
PHASE = scripts/phase

.DEFAULT_GOAL := help
.PHONY: help fmu program demo test bench key-figures validate coverage mutations fuzz random-models second-opinion studies test-slurm web web-check web-test python python-package docs docs-test pictures package package-test arm64-test format lint install clean

help:  ## this list
	@awk -F ':.*## ' '/^[a-z-]+:.*## / {printf "  make %-14s %s\n", $$1, $$2}' $(MAKEFILE_LIST)

program: $(BUILD)/build.ninja  ## builds the program: build/release/hersey
	@$(PHASE) program build/log/program.log cmake --build $(BUILD) --target hersey -j $(JOBS)

demo: program  ## simulates the paper's big-end bearing and says where the report is (QUICK=1: a short run)
	@scripts/demo $(BUILD) $(QUICK)

test: $(BUILD)/build.ninja  ## builds everything and runs every test (FILTER=regex: some of them)
	@scripts/setup build fmu
	@$(PHASE) configure build/log/configure.log cmake $(BUILD)
	@scripts/build-tests $(BUILD) $(JOBS)
	@scripts/run-tests $(BUILD) $(JOBS) '$(FILTER)'

fmu: $(BUILD)/build.ninja  ## builds what `hersey export` needs: build/release/hersey-fmu and hersey_fmu.so
	@scripts/setup build fmu
	@$(PHASE) configure build/log/fmu-configure.log cmake $(BUILD)
	@$(PHASE) compile build/log/fmu.log cmake --build $(BUILD) --target fmu -j $(JOBS)

bench:  ## builds and runs the benchmarks (AGAINST=program or commit: and prints how much faster standard jobs are than with that one)
	@scripts/setup build $(if $(AGAINST),test)
	@$(MAKE) --no-print-directory PRESET=bench build/bench/build.ninja
	@$(PHASE) compile build/log/bench.log cmake --build build/bench -j $(JOBS)
	@scripts/bench build/bench $(AGAINST)

key-figures: program  ## compares every example's key figures with bench/key_figures.csv (UPDATE=1: writes them there, WHY='...': why they changed; ONLY=regex: some; AGAINST=program: with another program's)
	@scripts/setup test
	@/usr/bin/python3 bench/key_figures.py $(BUILD)/hersey --jobs $(JOBS) --only '$(ONLY)' $(if $(UPDATE),--update) $(if $(WHY),--why '$(WHY)') \
	  $(if $(AGAINST),--against $(AGAINST))

validate: program  ## compares the examples with published numbers
	@scripts/setup test
	@scripts/validate $(BUILD)

coverage:  ## counts the branches of film, solver and bearing that their tests take: build/coverage/uncovered.txt (KEEP=1: of the last run; MBD=1: of mbd, too)
	@scripts/setup build coverage
	@$(MAKE) --no-print-directory PRESET=coverage build/coverage/build.ninja
	@$(PHASE) compile build/log/coverage.log cmake --build build/coverage -j $(JOBS) \
	  --target solver_test --target film_test --target bearing_test $(if $(MBD),--target mbd_test)
	@tests/coverage/coverage.py . build/coverage --jobs $(JOBS) $(if $(KEEP),--keep) $(if $(MBD),--with-mbd)

mutations:  ## plants faults one at a time in a copy and tells which no test notices; an hour (ONLY=regex: some; DRAWN=n, SEED=s: n a module by machine, MODULES=film,solver: of these; WITHIN=film,solver: tests of these modules only)
	@scripts/setup build test
	@validation/mutations.py --jobs $(JOBS) --only '$(ONLY)' $(if $(DRAWN),--drawn $(DRAWN)) $(if $(SEED),--seed $(SEED)) \
	  $(if $(MODULES),--modules '$(MODULES)') $(if $(WITHIN),--within '$(WITHIN)')

fuzz: program  ## feeds the readers with mutated input for TIME=60, address and undefined-behaviour checks on (FILTER=regex: some; SEED=n)
	@scripts/setup build test fuzz
	@$(PHASE) compile build/log/fuzz.log cmake --build $(BUILD) --target fuzzers -j $(JOBS)
	@status=0; scripts/fuzz $(BUILD) $(TIME) $(JOBS) '$(FILTER)' $(SEED) || status=1; \
	  $(MAKE) --no-print-directory random-models || status=1; exit $$status

studies: program  ## tries studies: plans, kills, statistics, optimum
	@scripts/setup test study
	@$(PHASE) studies build/log/studies.log /usr/bin/python3 tests/study/study_test.py $(BUILD)/hersey

test-slurm: program  ## tries studies on a cluster of this machine's own: slurmctld and slurmd on loopback, as root
	@scripts/setup test study slurm
	@$(PHASE) test-slurm build/log/test-slurm.log /usr/bin/python3 tests/study/slurm_test.py $(BUILD)/hersey

web:  ## rebuilds the report's front end (needs Node; the C++ build does not)
	@scripts/web build

web-check:  ## checks the front end's types and that the committed bundle is what its sources give
	@scripts/web check

web-test: program  ## opens a report in headless Chromium and tries it
	@scripts/web test $(BUILD)

python: python-package  ## builds the Python package and runs its tests (FILTER=word: some of them)
	@scripts/python-tests $(BUILD) '$(FILTER)'

python-package: $(BUILD)/build.ninja  ## builds the Python package: build/release/python
	@scripts/setup build test python study
	@$(PHASE) configure build/log/python-configure.log cmake $(BUILD) -DHERSEY_PYTHON_PACKAGE=ON -DPython3_EXECUTABLE=/usr/bin/python3
	@$(PHASE) compile build/log/python.log cmake --build $(BUILD) --target hersey_python hersey -j $(JOBS)

docs:  ## builds the documentation site: build/docs/index.html
	@scripts/setup docs
	@$(PHASE) docs build/log/docs.log scripts/docs
	@echo "documentation: build/docs/index.html"

docs-test: docs  ## opens every page of the site in headless Chromium, in two sizes; audits one of each kind in both themes
	@scripts/setup web browser
	@scripts/docs test

pictures: program  ## draws the pictures of the documentation anew that are no longer as they were drawn: docs/pictures
	@scripts/setup docs
	@/usr/bin/python3 scripts/site/pictures.py $(BUILD)/hersey

package: program  ## makes the Debian packages: build/release/packages/*.deb (with the site, where `make docs` was run)
	@scripts/setup package
	@$(PHASE) package build/log/package.log scripts/package $(BUILD)
	@ls $(BUILD)/packages/*.deb

package-test: package  ## tries the packages in a bare Debian 12 made by debootstrap (root; a minute and a half the first time)
	@scripts/setup package-test
	@packaging/try_in_debian $(BUILD)/packages/*.deb

arm64-test: program  ## compiles for 64-bit ARM, runs unit tests by qemu and compares answers with this machine's (TESTS='core film', ONLY=regex of examples)
	@scripts/setup arm64 test
	@TESTS='$(TESTS)' ONLY='$(ONLY)' packaging/try_on_arm64 $(JOBS)

format:  ## formats every C++ file
	@scripts/setup lint
	@git ls-files --cached --others --exclude-standard '*.h' '*.cpp' | xargs -r -P $(JOBS) -n 20 clang-format -i

lint:  ## checks the format and runs clang-tidy (SINCE=revision: on changed files only)
	@scripts/setup build lint
	@scripts/lint $(JOBS) $(SINCE)

install: program  ## installs program, libraries and headers below PREFIX
	@$(PHASE) install build/log/install.log cmake --install $(BUILD) --prefix $(PREFIX)

clean:  ## removes everything built
	@rm -rf build

random-models: program  ## tries as many random models as TIME=60 allows, every invariant checked; part of fuzz (SEED=n: the same again)
	@scripts/setup test
	@tests/random/random_models.py $(BUILD)/hersey --time $(TIME) --jobs $(JOBS) $(if $(SEED),--seed $(SEED)) --output build/random-models

second-opinion: program  ## random bearings by hersey and by a second film solver of another hand (COUNT=100, SEED=n: the same again)
	@scripts/setup test
	@tests/second_opinion/second_opinion.py $(BUILD)/hersey --jobs $(JOBS) --count $(COUNT) $(if $(SEED),--seed $(SEED)) --output build/second-opinion

# Configured once; afterwards the build itself notices changed CMake files.
$(BUILD)/build.ninja: CMakePresets.json
	@scripts/setup build $(if $(filter test fmu,$(MAKECMDGOALS)),fmu) $(if $(filter gcc,$(PRESET)),gcc) $(if $(filter asan,$(PRESET)),fuzz)
	@$(PHASE) configure build/log/configure.log scripts/compiler cmake --preset $(PRESET) -DHERSEY_UNITY=$(UNITY)
