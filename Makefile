# The short way in. Each target is one script in scripts/; the build itself is CMake (CMakePresets.json).
.PHONY: help demo gallery test web web-serve bench asan fuzz format lint clean
.NOTPARALLEL:
FUZZ_SECONDS ?= 60
WEB ?= 1

help:
	@echo "make demo    install what is missing, build, and turn the built-in sky into build/demo/index.html"
	@echo "make gallery docs/gallery.md: every real-time technique beside its truth"
	@echo "make test    the same set-up, then every test, then the fuzzers on repeatable inputs"
	@echo "             (WEB=0 leaves the browser and its compiler out)"
	@echo "make web     the page with the viewer, as static files in build/web/site;  make web-serve  gives them out"
	@echo "make bench   every benchmark: time and error side by side"
	@echo "make asan    every test under address and undefined-behaviour sanitizers"
	@echo "make fuzz    the fuzzers explore, FUZZ_SECONDS each ($(FUZZ_SECONDS)), and keep what they discover"
	@echo "make format  clang-format on every tracked source;  make lint  checks format and clang-tidy"
	@echo "make clean   removes build/"

demo:
	@scripts/install-deps
	@scripts/build release -DWELKIN_BUILD_TESTS=OFF -DWELKIN_BUILD_BENCH=OFF
	@scripts/demo

gallery:
	@scripts/install-deps
	@scripts/build release -DWELKIN_BUILD_TESTS=OFF -DWELKIN_BUILD_BENCH=OFF
	@scripts/gallery

test:
	@scripts/install-deps --test $(if $(filter 0,$(WEB)),,--web)
	@scripts/build release -DWELKIN_BUILD_TESTS=ON -DWELKIN_BUILD_BENCH=ON
	@scripts/test release --fuzz $(if $(filter 0,$(WEB)),,--web)

web:
	@scripts/install-deps --web
	@scripts/web
	@echo "The page is in build/web/site; make web-serve gives it out."

web-serve: web
	@scripts/web-serve

bench:
	@scripts/install-deps
	@scripts/build release -DWELKIN_BUILD_TESTS=OFF -DWELKIN_BUILD_BENCH=ON
	@scripts/bench

asan:
	@scripts/install-deps --test
	@scripts/build asan
	@scripts/test asan

fuzz:
	@scripts/install-deps --test
	@scripts/fuzz $(FUZZ_SECONDS)

format:
	@scripts/install-deps --dev
	@scripts/format

lint:
	@scripts/install-deps --test --dev
	@scripts/build release -DWELKIN_BUILD_TESTS=ON -DWELKIN_BUILD_BENCH=ON
	@scripts/lint

clean:
	@rm -rf build
