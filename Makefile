# The front door; the work is done by CMake (cmake/CMakeLists.txt).
#
#   make demo    dependencies, LAMMPS, the package; then the verdict on a shield with its report
#   make demo-dem                  likewise, a debris cloud of discrete elements
#   make test    the same; then all tests
#   make         build only: build/lmp, build/lmp-stock, build/hviplugin.so, build/hvi (the command line)
#   make verify  all that takes long, part by part: shocks, solids, hard cases with reports and pictures; tests marked long: tests/verify/whole.py
#   make fuzz    fuzzers of all readers and of LAMMPS inputs, MINUTES=10 of each: see tests/fuzz/README.md
#   make bench   speed against error, the short form (bench-full: all of it): build/bench/speed-error.html
#   make mutate  mutants of the library against its unit tests, on from tests/unit/mutants.csv (MUTATE_ARGS)
#   make check                     static checks: warnings of two compilers, clang-tidy, cppcheck, flake8, mypy, LAMMPS's coding standard
#   make force-styles              LAMMPS's own testers of forces and fixes, with our styles: tests/force-styles
#   make numbers                   tables of pages from doc/records, and which of these are old; RUN="NAME..." runs records again: doc/numbers.py
#   make dist                      source archive of the last commit and its checksum, in build
#   make doc | sanitize | clean
#
# LAMMPS_VERSION=20250204|20260704   which pinned LAMMPS          LAMMPS_SOURCE_DIR=DIR   your own LAMMPS source tree
# BUILD=DIR                          build folder                 JOBS=N                  processes of the compilation
# PORTABLE=yes                       no -march=native             DEPS=no                 do not look for Debian packages
# SIZES=bigbig                       LAMMPS's integers: smallbig (default), bigbig, smallsmall; in build-bigbig
# ALLOW_UNTESTED=yes                 another LAMMPS version       CMAKE_ARGS="-D..."      more options for CMake
# HVI_CACHE=DIR                      where LAMMPS is kept         PYTHON=FILE             interpreter for tests and pictures

LAMMPS_VERSION ?= 20250204
LAMMPS_SOURCE_DIR ?=
SIZES ?= smallbig
BUILD ?= build$(if $(filter 20250204,$(LAMMPS_VERSION)),,-$(LAMMPS_VERSION))$(if $(filter smallbig,$(SIZES)),,-$(SIZES))
JOBS ?= $(shell nproc 2>/dev/null || echo 2)
RANKS ?= $(if $(filter 1,$(shell nproc 2>/dev/null)),1,2)
PORTABLE ?= no
ALLOW_UNTESTED ?= no
DEPS ?= yes
SANITIZE = OFF
export DEPS

MAKEFLAGS += --no-print-directory
TOP := $(CURDIR)
OUT = $(abspath $(BUILD))
export CMAKE_BUILD_PARALLEL_LEVEL = $(JOBS)

.PHONY: all build demo demo-dem test verify doc numbers bench bench-full mutate sanitize clean fuzz check force-styles dist
all: build

# configures quietly; what went wrong is told in one line
build:
	@cmake/deps.sh build
	@if [ -z "$(LAMMPS_SOURCE_DIR)" ]; then cmake/fetch.sh $(LAMMPS_VERSION) >/dev/null; fi
	@mkdir -p $(BUILD)
	@cmake -S cmake -B $(BUILD) -DHVI_LAMMPS_VERSION=$(LAMMPS_VERSION) -DLAMMPS_SOURCE_DIR="$(LAMMPS_SOURCE_DIR)" -DHVI_SIZES=$(SIZES) \
	  -DHVI_PORTABLE=$(if $(filter yes,$(PORTABLE)),ON,OFF) -DHVI_SANITIZE=$(SANITIZE) \
	  -DHVI_ALLOW_UNTESTED=$(if $(filter yes,$(ALLOW_UNTESTED)),ON,OFF) $(CMAKE_ARGS) \
	  >$(BUILD)/configure.log 2>&1 || \
	  { cat $(BUILD)/stopped.txt 2>/dev/null || { cat $(BUILD)/configure.log; \
	    echo "lammps-hvi: cmake failed: see $(BUILD)/configure.log; after a change of compiler remove $(BUILD)"; }; exit 1; } >&2
	@cmake --build $(BUILD) --parallel $(JOBS)

# a shield, its verdict and a report; 3 and 4 are verdicts: it fails, it cannot be told
DEMO = examples/whipple-shield
demo:
	@cmake/deps.sh build demo
	@$(MAKE) build
	@HVI_PYTHON=$$(cmake/find-python.sh numpy scipy matplotlib yaml tqdm) && export HVI_PYTHON && \
	  { $(OUT)/hvi shield $(DEMO)/cases/quick.yaml --lmp $(OUT)/lmp --runs $(OUT)/demo --jobs $(RANKS) --ranks 1; code=$$?; \
	    [ $$code = 0 ] || [ $$code = 3 ] || [ $$code = 4 ] || exit $$code; } && \
	  $(OUT)/hvi report $(OUT)/demo/quick

# a debris cloud of discrete elements
demo-dem:
	@cmake/deps.sh build demo
	@$(MAKE) build
	@mkdir -p $(OUT)/demo-dem
	cd examples/debris-cloud && $(TOP)/cmake/env.sh mpirun -np $(RANKS) $(OUT)/lmp -in in.debris \
	  -var out $(OUT)/demo-dem -log $(OUT)/demo-dem/log.lammps
	@echo; cat $(OUT)/demo-dem/result.yaml; echo "picture: $(OUT)/demo-dem/cloud.png"

test:
	@cmake/deps.sh build test
	@$(MAKE) build
	@ctest --test-dir $(BUILD) --output-on-failure -j $$(($(JOBS) + 1))  # tests that wait leave a core idle

PORTABLE_BUILD = $(BUILD)-portable
verify:
	@cmake/deps.sh build test browser slurm machines
	@$(MAKE) build
	@$(MAKE) build BUILD=$(PORTABLE_BUILD) PORTABLE=yes
	@export HVI_LMP_PORTABLE=$(abspath $(PORTABLE_BUILD))/lmp && python=$$(cmake/find-python.sh numpy scipy matplotlib pytest yaml tqdm) && $$python tests/verify/whole.py --build $(OUT) --ranks $(RANKS) $(WHOLE_ARGS)

sanitize:
	@$(MAKE) test BUILD=$(if $(filter-out build,$(BUILD)),$(BUILD)-sanitize,build-sanitize) SANITIZE=ON

# goes on where it stopped; LAMMPS is not needed
mutate:
	@cmake/deps.sh build test
	@python3 tests/unit/mutants.py --out $(OUT)-mutate $(MUTATE_ARGS)

# in the folder of make sanitize, whose lmp it runs
MINUTES ?= 10
fuzz:
	@cmake/deps.sh build test fuzz
	@$(MAKE) build BUILD=$(if $(filter-out build,$(BUILD)),$(BUILD)-sanitize,build-sanitize) SANITIZE=ON
	@python=$$(cmake/find-python.sh numpy scipy yaml meshio) && fuzz=$(abspath $(if $(filter-out build,$(BUILD)),$(BUILD)-sanitize,build-sanitize)) && \
	  cmake/env.sh $$python tests/fuzz/fuzz.py --minutes $(MINUTES) --jobs $(JOBS) --out $$fuzz/fuzz --lmp $$fuzz/lmp $(FUZZ_ARGS)

check:
	@cmake/deps.sh build check
	@$(MAKE) build
	@cmake/check.sh $(OUT) "$(or $(LAMMPS_SOURCE_DIR),$$(cmake/fetch.sh $(LAMMPS_VERSION)))" $(CHECK_ARGS)

force-styles:
	@cmake/deps.sh build test check
	@$(MAKE) build
	@cmake --build $(BUILD) --parallel $(JOBS) --target force-style-testers
	@ctest --test-dir $(BUILD) --output-on-failure -C force -L force -j $(JOBS)

doc:
	@cmake/deps.sh doc
	@python=$$(cmake/find-python.sh sphinx) && $$python -m sphinx -q -W --keep-going -b html -d $(OUT)/doc/doctrees doc/src $(OUT)/doc/html
	@echo "documentation: $(OUT)/doc/html/index.html"

numbers:
	@python=$$(cmake/find-python.sh yaml) && $$python doc/numbers.py $(if $(RUN),--run $(RUN) --build $(OUT)) && $$python doc/numbers.py --stale

# speed against error: a part of the runs, or hours of them; goes on where it stopped. Times count from idle cores only
bench bench-full:
	@cmake/deps.sh build test
	@$(MAKE) build
	@python=$$(cmake/find-python.sh numpy scipy matplotlib yaml pytest MDAnalysis) && \
	  cmake/env.sh $$python bench/run.py --size $(if $(filter bench-full,$@),full,short) --build $(OUT) --out $(OUT)/bench $(BENCH_ARGS)

dist:
	@mkdir -p $(BUILD) && name=lammps-hvi-$$(sed -n 's/.*HVI_VERSION\[\] = "\(.*\)";/\1/p' src/USER-HVI/hvi_version.h) && \
	  git archive --prefix=$$name/ --format=tar.gz -o $(BUILD)/$$name.tar.gz HEAD && cd $(BUILD) && sha256sum $$name.tar.gz | tee $$name.tar.gz.sha256

clean:
	rm -rf build build-mutate build-sanitize build-portable $(BUILD)
