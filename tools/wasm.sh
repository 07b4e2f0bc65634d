#!/usr/bin/env bash
# Builds the kernel for web pages: wasm.sh OUT writes OUT/m3d_web.wasm.
#
# Uses cargo's own target wasm32-unknown-unknown where it is installed. Elsewhere, on Debian, it unpacks a Rust with the
# sources of its standard library into OUT/toolchain (120 MB to fetch, once) and builds that library too.
set -euo pipefail
root="$(cd "$(dirname "$0")/.." && pwd)"
mkdir -p "$1"
out="$(cd "$1" && pwd)"
target=wasm32-unknown-unknown
build=(cargo build --quiet --release --package m3d-web --target "$target"
    --manifest-path "$root/renderer/Cargo.toml" --target-dir "$out/target")
export RUSTFLAGS="-C target-feature=+simd128"

libraries="$(rustc --print target-libdir --target "$target")"
if [ ! -d "$libraries" ]; then
    toolchain="$out/toolchain"
    if [ ! -x "$toolchain/usr/bin/rustc" ]; then
        if ! command -v apt-get > /dev/null; then
            echo "The target $target is missing: rustup target add $target" >&2
            exit 1
        fi
        fetched="$(mktemp -d)"
        trap 'rm -rf "$fetched"' EXIT
        # The names of these two hold a version.
        named() { apt-cache depends "$1" | sed -n "s/.*Depends: \($2[0-9.]*\)\$/\1/p" | head -n 1; }
        standard="$(named libstd-rust-web-dev libstd-rust-web-)"
        llvm="$(named "$standard" libllvm)"
        (cd "$fetched" && apt-get download -qq rustc-web rust-web-src libstd-rust-web-dev "$standard" "$llvm")
        rm -rf "$toolchain.part"
        for package in "$fetched"/*.deb; do dpkg -x "$package" "$toolchain.part"; done
        mv "$toolchain.part" "$toolchain"
    fi
    linker="$(rustc --print sysroot)/lib/rustlib/x86_64-unknown-linux-gnu/bin/rust-lld"
    export LD_LIBRARY_PATH="$toolchain/usr/lib/x86_64-linux-gnu" RUSTC="$toolchain/usr/bin/rustc" RUSTC_BOOTSTRAP=1
    export CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER="$linker"
    build+=(-Zbuild-std=std,panic_abort)
fi
"${build[@]}"
cp "$out/target/$target/release/m3d_web.wasm" "$out/m3d_web.wasm"
