#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
#
# share/dev/fresh_root.sh [options] [SUITE [demo|tests|both|benchmark]]: runs the commands of the README
# in a new Debian (SUITE: bookworm, the default, trixie, …) that holds nothing but apt: share/demo/run.sh,
# tests/run.sh, one after the other (both, the default), or share/benchmark/run.sh, from the committed
# state of the sources.
# Ends with status 1 if one fails or the compiler, CMake or the packager warns. Needs root and Debian.
#   -c DIR  ccache's folder, which may be that of this machine: objects of the same compiler are reused
#   -d DIR  scratch folder for the new system, which needs about 12 GB (default: below /tmp)
#   -k      keep the new system, e.g. for chroot
#   -m URL  mirror (default: the first one of Debian that apt uses here)
# Downloads go through the proxy that apt is configured for. The logs are SCRATCH/SUITE.demo.log and
# SUITE.tests.log. Mounts are those of a name space of their own, which ends with its programs.
set -euo pipefail
export LC_ALL=C
usage() { sed -n '5,15s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; exit "$1"; }
source=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../.." && pwd -P)
cache='' scratch='' keep=0 mirror=''
while getopts c:d:km:h option; do
  case $option in
    c) cache=$(cd -- "$OPTARG" && pwd -P) ;;
    d) scratch=$OPTARG ;;
    k) keep=1 ;;
    m) mirror=$OPTARG ;;
    h) usage 0 ;;
    *) usage 1 ;;
  esac
done
shift $((OPTIND - 1))
suite=${1:-bookworm} what=${2:-both}
[[ $# -le 2 && $what =~ ^(demo|tests|both|benchmark)$ ]] || usage 1
[[ $(id -u) == 0 ]] || { echo "fresh_root.sh: run as root: it makes and mounts file systems" >&2; exit 1; }
scratch=${scratch:-$(mktemp -d /tmp/pcl_als_fresh.XXXXXX)}
mkdir -p -- "$scratch"
scratch=$(cd -- "$scratch" && pwd -P)
root=$scratch/$suite
[[ ! -e $root ]] || { echo "fresh_root.sh: $root exists: remove it for a fresh one" >&2; exit 1; }

# make_root: the system with the sources and, beside them, the test data.
make_root() {
  command -v debootstrap >/dev/null || {
    apt-get -qq update && apt-get -qq install -y --no-install-recommends debootstrap
  } >"$scratch/debootstrap.log" 2>&1
  [[ -n $mirror ]] || mirror=$(apt-get indextargets --format '$(REPO_URI)' \
    'Created-By: Packages' 'Origin: Debian' 'Label: Debian' | head -n 1)
  local proxy
  proxy=$(apt-config shell proxy Acquire::http::Proxy)
  eval "$proxy"
  env ${proxy:+http_proxy="$proxy"} debootstrap --variant=minbase "$suite" "$root" ${mirror:+"$mirror"} \
    >>"$scratch/debootstrap.log" 2>&1 || { tail -n 5 "$scratch/debootstrap.log" >&2; return 1; }
  # How apt downloads is the machine's; dpkg need not wait for the disk.
  apt-config dump | grep -E '^Acquire::(https?|Check|Max|Retries)' >"$root/etc/apt/apt.conf.d/90machine" || true
  echo force-unsafe-io >"$root/etc/dpkg/dpkg.cfg.d/90machine"
  cp -L /etc/resolv.conf "$root/etc/resolv.conf"
  mkdir -p "$root/root/pcl_als" "$root/root/shared/data" "$root/ccache"
  git -C "$source" archive HEAD | tar -x -C "$root/root/pcl_als"
  local data=${PCL_ALS_TEST_DATA:-$source/../shared/data}
  [[ ! -d $data ]] || cp -rL -- "$data/." "$root/root/shared/data"
}

# inside COMMAND: runs it in the sources of the new system, with the environment of a first login.
inside() {
  # The root is mounted on itself because tests mount file systems, which needs a mount point as root.
  unshare --mount --pid --fork --kill-child bash -euc '
    root=$1 cache=$2; shift 2
    mount --bind "$root" "$root"
    mount -t proc proc "$root/proc"
    mount -t sysfs -o ro sysfs "$root/sys"
    mount -t tmpfs tmpfs "$root/dev/shm"
    mount -t devpts -o newinstance,ptmxmode=0666 devpts "$root/dev/pts"
    environment=(HOME=/root TERM=dumb PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin)
    [[ -z $cache ]] || { mount --bind "$cache" "$root/ccache"; environment+=(CCACHE_DIR=/ccache); }
    exec chroot "$root" env -i "${environment[@]}" sh -c "cd /root/pcl_als && exec \"\$@\"" sh "$@"
  ' bash "$root" "$cache" "$@" </dev/null
}

# warned LOG: prints what the build and the packager warned of.
warned() {
  grep -hE '(^|[^[:alnum:]])(warning|Warning):|CMake (Deprecation )?Warning' "$1" \
    "$root/root/pcl_als/build/configure.log"
}

status=0
echo "Making $root"
make_root
declare -A commands=([demo]=share/demo/run.sh [tests]=tests/run.sh [benchmark]=share/benchmark/run.sh)
[[ $what != both ]] || what="demo tests"
for name in $what; do
  command=${commands[$name]}
  log=$scratch/$suite.$name.log started=$SECONDS
  echo "Running $command in $suite: $log"
  if inside "$command" >"$log" 2>&1; then result=passed; else result=FAILED status=1; tail -n 40 "$log"; fi
  if warned "$log"; then result+=", with warnings" status=1; fi
  echo "$command in $suite: $result after $((SECONDS - started)) s"
done
((keep)) || rm -rf --one-file-system -- "$root"
exit "$status"
