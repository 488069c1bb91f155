#!/bin/sh
# Runs one file of tests with the package of the sources; 77 (skipped) where there is no numpy.
# Usage: HYSTERON_LIBRARY=... run.sh PYTHON FILE
here=$(cd "$(dirname "$0")" && pwd)
"$1" -c 'import numpy' 2>/dev/null || { echo "numpy is not there: apt-get install python3-numpy"; exit 77; }
PYTHONPATH=$here/../../../interop/python PYTHONDONTWRITEBYTECODE=1 exec "$1" -W error::ResourceWarning "$here/$2"
