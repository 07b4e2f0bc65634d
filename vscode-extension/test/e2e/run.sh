#!/usr/bin/env bash
# Drives the packed extension in a real VS Code: run.sh OUT, where OUT/m3d-*.vsix is what `make vsix` wrote.
# Screenshots go into OUT/screenshots, measurements into OUT/workbench.json.
set -euo pipefail
here="$(cd "$(dirname "$0")" && pwd)"
out="$(cd "$1" && pwd)"
for program in node npm chromium rg; do
    if ! command -v "$program" > /dev/null; then
        echo "The extension is not driven: there is no $program. On Debian: apt-get install chromium fonts-dejavu-core ripgrep"
        test -z "${CI:-}"
        exit
    fi
done
"$here/install.sh" "$out/e2e"
rm -rf "$out/screenshots"
mkdir -p "$out/screenshots"
cd "$here/../.."
node esbuild.mjs --e2e "$out/e2e/tests"
REPOSITORY="$(cd "$here/../../.." && pwd)" OUT="$out" node --test --test-concurrency=1 --test-reporter=spec "$out/e2e/tests/"
