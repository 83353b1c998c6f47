#!/usr/bin/env bash
# Sets up what ltl-rover needs beyond a Rust toolchain, and prints what it does. Safe to run again: finished steps are skipped.
#
# usage: tools/setup.sh [wasm] [browser] [web]     (no argument: all three)
#   wasm     the wasm32-unknown-unknown target, wasm-pack, wasm-bindgen
#   browser  a Chromium for the page tests
#   web      the page's libraries and test tools, from package-lock.json
#
# The wasm target comes from `rustup target add` where that works, and otherwise from Debian's packages
# (rustc-web, cargo-web, rust-web-src, lld), with the standard library built once from its source.
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/env.sh

say() { printf '\033[1msetup:\033[0m %s\n' "$*"; }
have() { command -v "$1" >/dev/null 2>&1; }

as_root() { if [ "$(id -u)" = 0 ]; then "$@"; elif have sudo; then sudo "$@"; else say "root is needed for: $*"; return 1; fi; }

apt_install() {
  have apt-get || { say "please install: $*"; return 1; }
  say "installing Debian packages: $*"
  [ -n "${apt_updated:-}" ] || { as_root apt-get update -qq; apt_updated=1; }
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "$@" >/dev/null
}

# Version of a crate that Cargo.lock fixes, so that the tool and the library always agree.
locked() { awk -v name="$1" '$1=="name" && $3=="\""name"\"" {getline; gsub(/"/,"",$3); print $3; exit}' Cargo.lock; }

install_tool() { # crate version binary
  if [ -x "$LTL_ROVER_CACHE/bin/$3" ] && "$LTL_ROVER_CACHE/bin/$3" --version 2>/dev/null | grep -qF "$2"; then
    say "$3 $2 is there"; return
  fi
  if have "$3" && "$3" --version 2>/dev/null | grep -qF "$2"; then say "$3 $2 is there"; return; fi
  say "building $1 $2 (a few minutes, once)"
  CARGO_TARGET_DIR="$LTL_ROVER_CACHE/tools-target" CARGO_PROFILE_RELEASE_OPT_LEVEL=1 CARGO_PROFILE_RELEASE_LTO=off \
    CARGO_PROFILE_RELEASE_CODEGEN_UNITS=16 CARGO_PROFILE_RELEASE_DEBUG=false \
    cargo install --quiet --root "$LTL_ROVER_CACHE" --force --version "$2" "$1"
}

wasm_target() {
  if wasm_target_by_rustup; then say "wasm32-unknown-unknown is there (rustup)"; return; fi
  if wasm_target_by_debian; then say "wasm32-unknown-unknown is there (Debian)"; return; fi
  if have rustup; then
    say "rustup target add wasm32-unknown-unknown"
    if timeout 300 rustup target add wasm32-unknown-unknown 2>/dev/null && wasm_target_by_rustup; then return; fi
    say "rustup could not fetch the target; building it from Debian's packages"
  fi
  apt_install rustc-web cargo-web rust-web-src lld-19
  local build; build=$(mktemp -d)
  mkdir -p "$build/src"; : > "$build/src/lib.rs"
  printf '[package]\nname = "empty"\nversion = "0.0.0"\nedition = "2021"\n' > "$build/Cargo.toml"
  say "building the standard library for wasm32-unknown-unknown (about two minutes, once)"
  (cd "$build" && RUSTC=/usr/bin/rustc RUSTC_BOOTSTRAP=1 CARGO_TARGET_DIR="$build/target" \
    CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER=wasm-ld-19 /usr/bin/cargo build --quiet --release \
    --target wasm32-unknown-unknown -Z build-std=std,panic_abort,panic_unwind,test)
  as_root mkdir -p "$DEBIAN_WASM_LIB"
  find "$build/target/wasm32-unknown-unknown/release/deps" -name '*.rlib' ! -name 'libempty-*' -print0 \
    | as_root xargs -0 cp -t "$DEBIAN_WASM_LIB"
  rm -rf "$build"
  if have rustup; then rustup toolchain link debian /usr; fi
  wasm_target_by_debian || { say "the wasm target is still missing"; return 1; }
}

setup_wasm() {
  wasm_target
  have node || apt_install nodejs npm
  install_tool wasm-bindgen-cli "$(locked wasm-bindgen)" wasm-bindgen
  install_tool wasm-pack "$WASM_PACK_VERSION" wasm-pack
}

setup_browser() {
  if [ -n "$(chromium_path)" ]; then say "Chromium is there: $(chromium_path)"; return; fi
  apt_install chromium fonts-dejavu-core
}

setup_web() {
  [ -f web/package-lock.json ] || { say "no web/package-lock.json yet"; return; }
  if [ -f web/node_modules/.package-lock.json ] && [ ! web/package-lock.json -nt web/node_modules/.package-lock.json ]; then
    say "the page's libraries are there"; return
  fi
  say "installing the page's libraries"
  (cd web && npm ci --ignore-scripts --no-audit --no-fund --loglevel=error)
}

mkdir -p "$LTL_ROVER_CACHE"
for part in "${@:-wasm browser web}"; do
  for one in $part; do
    case $one in
      wasm) setup_wasm ;;
      browser) setup_browser ;;
      web) setup_web ;;
      *) say "unknown part '$one' (wasm, browser, web)"; exit 2 ;;
    esac
  done
done
say "done"
