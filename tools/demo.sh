#!/bin/sh
# `make demo`: renders the merman scene with straight and with bent rays into out/, and shows what it does.
#
# The programs are those of .venv if they were ever built there; else those of the wheels in dist/, for which neither a
# C compiler nor cargo is needed, if dist/ has them for this machine; else they are built.
set -e
PYTHON=${PYTHON:-python3}
cd "$(dirname "$0")/.."
version=$(sed -n 's/^version = "\(.*\)"/\1/p' pyproject.toml)

show() {
    echo "$*"
    "$@"
}

install() { # into out/demo; status 1 where dist/ has no wheels for this machine
    ls "dist/m3d_render-$version"-*.whl > /dev/null 2>&1 || return 1
    PYTHON="$PYTHON" sh tools/needs.sh python || exit 1
    echo "Installing the wheels of dist/ into out/demo: no compiler is needed."
    "$PYTHON" -m venv out/demo || exit 1
    pip() { out/demo/bin/python -m pip --quiet --disable-pip-version-check install --only-binary :all: "$@"; }
    if ! pip --no-index --no-deps --find-links dist "m3d-language==$version" "m3dc==$version" "m3d-render==$version" \
        > out/demo/log 2>&1; then
        echo "They are not for this machine ($("$PYTHON" -c 'import sysconfig; print(sysconfig.get_platform())'))."
        return 1
    fi
    pip "m3d-render==$version"
}

bin=.venv/bin
if [ ! -x .venv/bin/m3d-render ] && install; then
    bin=out/demo/bin
else
    ${MAKE:-make} --no-print-directory programs
fi

mkdir -p out
show "$bin/m3dc" -o out/merman.m3ir examples/merman.m3d
show "$bin/m3d-render" out/merman.m3ir --straight -o out/merman-straight.png
show "$bin/m3d-render" out/merman.m3ir -o out/merman-mirage.png
echo "What is there:       $PWD/out/merman-straight.png"
echo "What one sees of it: $PWD/out/merman-mirage.png"
