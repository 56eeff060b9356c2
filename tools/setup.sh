# What ./demo and ./check share: installs what is missing and builds presets. Source it from bash, in the
# repository's root; `program` names the script in its messages.
# shellcheck shell=bash
# shellcheck disable=SC2034,SC2154  # program comes from, and the package lists go to, the sourcing script

build_packages=(
  g++ cmake ninja-build pkg-config
  libfmt-dev libglm-dev libtomlplusplus-dev nlohmann-json3-dev libcli11-dev libstb-dev fonts-dejavu-core
  libopenexr-dev libimath-dev libpng-dev zlib1g-dev libembree-dev libtbb-dev
  libepoxy-dev libegl-dev libegl1 libgl1 libgl1-mesa-dri
  libglfw3-dev libimgui-dev libcairo2-dev
)
test_packages=(libgtest-dev libgmock-dev libbenchmark-dev xvfb)

fail() {
  echo "$program: $1" >&2
  exit "${2:-1}"
}

is_installed() {
  [ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null)" = installed ]
}

# Runs a command as root, through sudo where we are not; sudo asks nothing when nobody can answer.
as_root() {
  if [ "$(id -u)" = 0 ]; then
    "$@"
  elif [ -t 0 ]; then
    sudo "$@"
  else
    sudo -n "$@"
  fi
}

# install_missing PACKAGE...: only on Debian and its relatives; elsewhere prints the list and ends with 1.
# LYCHNITE_SKIP_SETUP=1 says that everything needed is there.
install_missing() {
  if [ -n "${LYCHNITE_SKIP_SETUP:-}" ]; then return; fi
  if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
    printf '%s: this machine has no apt; install what these Debian packages hold:\n  %s\n' "$program" "$*" >&2
    fail "then run it again with LYCHNITE_SKIP_SETUP=1"
  fi
  local package missing=()
  for package in "$@"; do
    is_installed "$package" || missing+=("$package")
  done
  if [ ${#missing[@]} = 0 ]; then return; fi
  if [ "$(id -u)" != 0 ] && ! command -v sudo >/dev/null; then
    fail "as root, install: apt-get install ${missing[*]}"
  fi
  echo "$program: installing through apt: ${missing[*]}"
  # Lists that cannot be refreshed may still do.
  as_root apt-get -qq update || true
  as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq -y -o Dpkg::Use-Pty=0 \
    install --no-install-recommends "${missing[@]}" >/dev/null || fail "could not install: ${missing[*]}"
}

# configure PRESET
configure() {
  local launcher=()
  if command -v ccache >/dev/null; then launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache); fi
  local log
  if ! log=$(cmake --preset "$1" "${launcher[@]}" 2>&1); then
    printf '%s\n' "$log" >&2
    fail "cmake could not configure the preset '$1'"
  fi
}

# build PRESET: configures it when it is new (afterwards the build itself notices changes) and builds it.
build() {
  [ -f "build/$1/build.ninja" ] || configure "$1"
  cmake --build "build/$1" || fail "the preset '$1' did not build"
}
