#!/bin/bash
# Tests of the page: test.sh unit|browser BUILT-PAGE HYSTERON
#   BUILT-PAGE   the folder in which the build installed what the page needs
# What is looked at and measured by hand: test.sh pictures|figures BUILT-PAGE HYSTERON [FOLDER]
# Ends with 77, and says why, where they cannot be run on this machine.
set -euo pipefail
kind=$1 built=$(realpath "$2") hysteron=$(realpath "$3")
folder=$(realpath -m "${4:-.}")
cd "$(dirname "${BASH_SOURCE[0]}")"

skip() { printf 'skipped: %s\n' "$*"; exit 77; }
command -v node >/dev/null || skip "node is not there (Debian: apt install nodejs npm)"
[[ -d $built/node_modules/vitest ]] || skip "the build could not install the packages of the page"
[[ -f $built/dist/index.html ]] || skip "the page was not built"
if [[ $kind != unit ]]; then
  chromium=$(command -v chromium || command -v chromium-browser || command -v google-chrome || true)
  [[ -n $chromium ]] || skip "no Chromium is there (Debian: apt install chromium)"
  export HYSTERON_CHROMIUM=$chromium HYSTERON_PROGRAM=$hysteron HYSTERON_SOURCE=$PWD/../..
fi
# The packages lie in the build folder: the sources are tested from a copy beside them.
rm -rf "$built/tested-$kind"
mkdir "$built/tested-$kind"
cp -r src browser tsconfig.json package.json "$built/tested-$kind/"
cd "$built/tested-$kind"
case $kind in
  unit) exec ../node_modules/.bin/vitest run --dir src ;;
  pictures | figures) exec ../node_modules/.bin/vite-node "browser/$kind.ts" "$folder" "${@:5}" ;;
  browser) exec ../node_modules/.bin/vitest run --dir browser --no-file-parallelism --testTimeout 400000 --hookTimeout 100000 "${@:5}" ;;
esac
