#!/bin/sh
# Says what this machine lacks for a build, and how to get it; status 1 if there is anything. `needs.sh python` asks only
# for what it takes to install wheels. PYTHON is the python3 to use. `make` asks before it starts what takes minutes.

PYTHON=${PYTHON:-python3}
cd "$(dirname "$0")/.." || exit 1
lacking=0

lack() { # what, Debian, Fedora, macOS, Windows
    lacking=1
    printf '%s\n    Debian, Ubuntu: %s\n    Fedora:         %s\n    macOS:          %s\n    Windows:        %s\n' "$@" >&2
}

ask() {
    "$PYTHON" -c "$1" > /dev/null 2>&1
}

if ! ask 'import sys; sys.exit(sys.version_info < (3, 11))'; then
    found=$(ask 'import sys' && "$PYTHON" -c 'import platform; print(platform.python_version())')
    lack "$PYTHON, 3.11 or newer, is missing${found:+ (this is $found)} (make PYTHON=... names another)." \
        "sudo apt install python3 python3-venv python3-dev" "sudo dnf install python3 python3-devel" \
        "brew install python" "winget install Python.Python.3.13"
else
    ask 'import venv, ensurepip' ||
        lack "$PYTHON has no venv." "sudo apt install python3-venv" "sudo dnf install python3" "brew install python" \
            "winget install Python.Python.3.13"
    [ "$1" = python ] || ask 'import os, sysconfig; sys = __import__("sys")
sys.exit(not os.path.exists(os.path.join(sysconfig.get_path("include"), "Python.h")))' ||
        lack "$PYTHON has no header files (Python.h)." "sudo apt install python3-dev" "sudo dnf install python3-devel" \
            "brew install python" "winget install Python.Python.3.13"
fi
[ "$1" != python ] || exit $lacking

cc --version > /dev/null 2>&1 || gcc --version > /dev/null 2>&1 || clang --version > /dev/null 2>&1 ||
    lack "A C compiler is missing." "sudo apt install gcc libc6-dev" "sudo dnf install gcc" "xcode-select --install" \
        "winget install Microsoft.VisualStudio.2022.BuildTools, with the workload 'Desktop development with C++'"

wanted=$(sed -n 's/^rust-version = "\(.*\)"/\1/p' renderer/Cargo.toml)
found=$(cargo --version 2> /dev/null | sed -n 's/^cargo \([0-9]*\.[0-9]*\).*/\1/p')
if [ -z "$found" ] || [ "${found%%.*}" -lt "${wanted%%.*}" ] ||
    { [ "${found%%.*}" -eq "${wanted%%.*}" ] && [ "${found#*.}" -lt "${wanted#*.}" ]; }; then
    lack "cargo $wanted or newer is missing${found:+ (this is $found)}; https://rustup.rs brings it anywhere, or:" \
        "sudo apt install rustup && rustup default stable" "sudo dnf install rustup && rustup-init -y" \
        "brew install rust" "winget install Rustlang.Rustup"
fi

exit $lacking
