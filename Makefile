# The commands of ltl-rover. `make demo` serves the page, `make test` runs every test; both set up what they need first.
SHELL := /bin/bash
.SHELLFLAGS := -euo pipefail -c
.DEFAULT_GOAL := help
ENV := . tools/env.sh;
PORT ?= 8080

.PHONY: help
help: ## list the commands
	@grep -hE '^[a-z-]+:.*## ' $(MAKEFILE_LIST) | awk -F':.*## ' '{printf "  make %-16s %s\n", $$1, $$2}'

.PHONY: setup
setup: ## install what the page and the tests need (safe to run again)
	@tools/setup.sh wasm browser web

# --- the page ---------------------------------------------------------------------------------------------------------

.PHONY: wasm
wasm: ## build the WebAssembly module into web/pkg
	@$(ENV) with_wasm wasm-pack build --release --target web --out-dir web/pkg --out-name ltl_rover --no-pack . --no-default-features --features wasm

.PHONY: page
page: wasm ## assemble the page into web/dist
	@cd web && node build.mjs

.PHONY: demo
demo: ## set up, build and serve the page at http://localhost:8080 (PORT=… for another port)
	@tools/setup.sh wasm web
	@$(MAKE) --no-print-directory page
	@cd web && node serve.mjs --port $(PORT)

# --- the tests, fast ones first ------------------------------------------------------------------------------------------

.PHONY: test
test: ## set up and run all tests
	@tools/setup.sh wasm browser web
	@$(MAKE) --no-print-directory lint test-rust test-web test-learning test-wasm test-page

.PHONY: lint
lint: ## formatting, clippy, documentation links, types of the page
	@$(ENV) cargo fmt --check
	@$(ENV) cargo clippy --quiet --all-targets -- -D warnings
	@$(ENV) if wasm_target_by_rustup; then cargo clippy --quiet --target wasm32-unknown-unknown --no-default-features --features wasm --lib -- -D warnings; \
	else echo "lint: clippy for wasm32 needs the target from rustup; skipped"; fi
	@$(ENV) RUSTDOCFLAGS="-D warnings" cargo doc --quiet --no-deps

.PHONY: test-rust
test-rust: ## logic, in debug
	@$(ENV) cargo test

.PHONY: test-learning
test-learning: ## kernels against burn, learning, thousands of translations, and the examples, optimised
	@$(ENV) cargo test --profile quick --features burn --test kernels --test learning --test epsilon_learning --test python --test translate
	@$(ENV) for example in own_environment train_a_task; do cargo run --quiet --profile quick --features burn --example $$example; done

.PHONY: test-wasm
test-wasm: ## the WebAssembly module under Node
	@# wasm-pack compiles every test for wasm32 before it runs these; without link-time optimisation that takes a third of the time.
	@$(ENV) export CARGO_PROFILE_RELEASE_LTO=off CARGO_PROFILE_RELEASE_CODEGEN_UNITS=16; \
	with_wasm wasm-pack test --node --release -- --no-default-features --features wasm --test boundary --test kernels_wasm --test golden_trace

.PHONY: test-web
test-web: wasm ## the page's modules: types and units
	@cd web && npx tsc --noEmit
	@cd web && node --test --test-reporter=spec tests/unit/

.PHONY: test-page
test-page: page ## the page in Chromium
	@$(ENV) cd web && CHROMIUM="$$(chromium_path)" node --test --test-reporter=spec tests/page/

# --- measuring ------------------------------------------------------------------------------------------------------------

.PHONY: bench
bench: ## speed of the kernels, native and WebAssembly, as ratios in one run
	@$(ENV) with_wasm cargo build --quiet --release --no-default-features --target wasm32-unknown-unknown --example kernels_wasm
	@$(ENV) LTL_ROVER_WASM=$$CARGO_TARGET_DIR/wasm32-unknown-unknown/release/examples/kernels_wasm.wasm cargo bench --features burn --bench kernels

.PHONY: measure
measure: page ## first movement, frames a second and memory of the page over ten minutes of training
	@$(ENV) cd web && CHROMIUM="$$(chromium_path)" node measure.mjs

.PHONY: compare-training
compare-training: page ## training in the page against native training, in steps a second
	@$(ENV) cargo build --quiet --release --no-default-features --features cli; \
	cd web && LTL_ROVER="$$CARGO_TARGET_DIR/release/ltl-rover" CHROMIUM="$$(chromium_path)" node compare_training.mjs

.PHONY: bench-translate
bench-translate: ## sizes and times of translations, native and WebAssembly (SETS="FILE …" for formulas of your own)
	@$(ENV) cargo build --quiet --release --no-default-features --features cli
	@$(ENV) with_wasm cargo build --quiet --release --no-default-features --target wasm32-unknown-unknown --example translate_wasm
	@$(ENV) $$CARGO_TARGET_DIR/release/ltl-rover bench translate $(foreach set,$(SETS),--set $(set)) $(ARGS) \
	  --wasm $$CARGO_TARGET_DIR/wasm32-unknown-unknown/release/examples/translate_wasm.wasm

.PHONY: bench-peers
bench-peers: ## the same work in PyTorch and Stable-Baselines3, from PyPI (large)
	@$(ENV) python3 -m venv $$LTL_ROVER_CACHE/peers
	@$(ENV) $$LTL_ROVER_CACHE/peers/bin/pip install --quiet -r benches/peers/requirements.txt
	@$(ENV) $$LTL_ROVER_CACHE/peers/bin/python benches/peers/peers.py
