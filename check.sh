#!/usr/bin/env bash
# Set up everything from scratch and check it: lint, types, tests, bytes, wheel.
# Needs Python 3.11 or newer and the package registry; writes only below
# .venv-check, a temporary folder, and caches that git ignores.
set -euo pipefail
cd "$(dirname "$0")"

# Commands are started hundreds of times: compiled anew each time, one takes up to half as long again.
export PYTHONDONTWRITEBYTECODE=

python="${PYTHON:-python3}"
"$python" -c 'import sys; sys.exit(sys.version_info < (3, 11))' || {
  echo "check.sh: Python 3.11 or newer is needed; set PYTHON=/path/to/python3.11" >&2
  exit 2
}
"$python" -m venv .venv-check
bin="$PWD/.venv-check/bin"
"$bin/python" -m pip install --quiet --upgrade pip
"$bin/python" -m pip install --quiet --editable '.[dev]'

# The wheel gets its virtual environment meanwhile: types are checked on one core.
outside="$(mktemp -d)"
trap 'wait; rm -rf "$outside"' EXIT
{
  "$bin/python" -m pip wheel --quiet --no-deps --wheel-dir "$outside" . &&
    "$python" -m venv "$outside/venv" &&
    "$outside/venv/bin/python" -m pip install --quiet "$outside"/*.whl
} >"$outside/log" 2>&1 &
wheel=$!

echo "== lint"
"$bin/ruff" check .
"$bin/ruff" format --check .

echo "== types"
"$bin/mypy"

echo "== tests"
"$bin/python" -m pytest -n auto -rs

echo "== generated files, as other processors add up"
"$bin/python" tests/processors.py -n auto

echo "== wheel, used from a clean virtual environment outside the checkout"
wait "$wheel" || { cat "$outside/log" >&2; exit 1; }
cp -r tests/wheel_smoke.py examples urdf "$outside"
(cd "$outside" && env -u PYTHONPATH "$outside/venv/bin/python" wheel_smoke.py)
