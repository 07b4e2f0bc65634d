#!/usr/bin/env bash
# Brings what the end-to-end tests need into the folder given: VS Code as a server (code-server) and the driver of a
# browser. Takes about a minute and 300 MB; does nothing where it has been done. Needs npm, a C++ compiler,
# and chromium and rg on the path.
set -euo pipefail
here="$(cd "$(dirname "$0")" && pwd)"
folder="$1"
mark="$folder/installed"
if [ -f "$mark" ] && cmp -s "$here/package.json" "$folder/package.json"; then
    exit 0
fi
rm -rf "$folder"
mkdir -p "$folder"
cp "$here/package.json" "$here/package-lock.json" "$here/.npmrc" "$folder/"
cd "$folder"
quiet=(--ignore-scripts --no-audit --no-fund --loglevel=error)
npm ci "${quiet[@]}"

server="$folder/node_modules/code-server"
# npm ci refuses here: code-server's own shrinkwrap is out of step with its package.json.
(cd "$server/lib/vscode" && npm install --omit=dev "${quiet[@]}")
gyp="$(npm root -g)/npm/node_modules/node-gyp/bin/node-gyp.js"
# Node's headers come with it; they are not to be fetched.
node="$(dirname "$(dirname "$(readlink -f "$(command -v node)")")")"
for module in @vscode/spdlog native-watchdog node-pty; do
    (cd "$server/lib/vscode/node_modules/$module" && node "$gyp" rebuild --nodedir="$node" --silent)
done
npm_config_build_from_source=true npm_config_nodedir="$node" npm rebuild --loglevel=error argon2
mkdir -p "$server/lib/vscode/node_modules/@vscode/ripgrep/bin"
ln -sf "$(command -v rg)" "$server/lib/vscode/node_modules/@vscode/ripgrep/bin/rg"
touch "$mark"
