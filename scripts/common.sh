# What scripts/demo and scripts/test share: packages, configuring, building. Sourced, not run.
# Does not decide what is run afterwards.

root_folder=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

say()  { printf '%s\n' "== $*"; }
stop() { printf '%s\n' "stopped: $*" >&2; exit 1; }

# packages_for build test ...: their names, from scripts/packages.txt
packages_for() {
  local group
  for group in "$@"; do
    awk -v group="$group" '$1 == group { print $2 }' "$root_folder/scripts/packages.txt"
  done
}

# Installs what is missing of the named groups. Does not touch apt where nothing is missing.
install_packages() {
  command -v dpkg-query >/dev/null ||
    stop "this script installs with apt and knows Debian 12 only; README.md says how to build by hand"
  local package missing=()
  for package in $(packages_for "$@"); do
    [[ $(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null || true) == installed ]] || missing+=("$package")
  done
  if (( ${#missing[@]} == 0 )); then return 0; fi

  local as_root=()
  if (( EUID != 0 )); then
    command -v sudo >/dev/null || stop "missing packages: ${missing[*]}; run as root, or install sudo"
    as_root=(sudo)
  fi
  say "installing ${missing[*]}"
  # env behind sudo, because sudo drops the caller's environment
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get update -qq ||
    stop "apt-get update failed (its reason stands above)"
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" ||
    stop "apt-get install failed (its reason stands above)"
}

# npm, which builds the page of hysteron studio. It may come from elsewhere; without it the page is left out.
install_npm() {
  command -v npm >/dev/null || (install_packages studio) || say "without npm: hysteron studio will have no page"
}

# configure_and_build FOLDER [cmake options]; builds the targets in $build_targets, or everything
build_targets=()
configure_and_build() {
  local folder=$1
  shift
  # A folder that was configured at another place (a copied checkout) would build that other place.
  if [[ -f $folder/CMakeCache.txt ]] &&
     ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root_folder" "$folder/CMakeCache.txt"; then
    stop "$folder was configured for another source folder; remove it: rm -r $folder"
  fi
  say "configuring $folder"
  cmake -S "$root_folder" -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=Release -DHYSTERON_UNITY=ON "$@" >"$folder.configure.log" 2>&1 || {
    cat "$folder.configure.log" >&2
    stop "cmake could not configure (its reason stands above)"
  }
  rm -f "$folder.configure.log"
  say "building"
  cmake --build "$folder" ${build_targets[@]+--target "${build_targets[@]}"} || stop "the build failed (its reason stands above)"
}
