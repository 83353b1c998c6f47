# Sourced by the Makefile and the scripts: where caches live and how wasm32 is built on this machine. The only place that knows.
: "${LTL_ROVER_CACHE:=${XDG_CACHE_HOME:-$HOME/.cache}/ltl-rover}"
export LTL_ROVER_CACHE
export CARGO_TARGET_DIR="${CARGO_TARGET_DIR:-$LTL_ROVER_CACHE/target}"
export PATH="$LTL_ROVER_CACHE/bin:$HOME/.cargo/bin:$PATH"
WASM_PACK_VERSION=0.15.1
DEBIAN_WASM_LIB=/usr/lib/rustlib/wasm32-unknown-unknown/lib

wasm_target_by_rustup() {
  local sysroot; sysroot=$(rustc --print sysroot 2>/dev/null) || return 1
  ls "$sysroot"/lib/rustlib/wasm32-unknown-unknown/lib/libstd-*.rlib >/dev/null 2>&1
}
wasm_target_by_debian() { [ -x /usr/bin/rustc ] && ls "$DEBIAN_WASM_LIB"/libstd-*.rlib >/dev/null 2>&1; }

# Runs a command with the toolchain that has the wasm target.
with_wasm() {
  if wasm_target_by_rustup; then "$@"
  else RUSTUP_TOOLCHAIN=debian CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER=wasm-ld-19 "$@"; fi
}

chromium_path() {
  local name
  for name in ${CHROMIUM:-} chromium chromium-browser google-chrome google-chrome-stable; do
    if command -v "$name" >/dev/null 2>&1; then command -v "$name"; return; fi
  done
}
