#!/usr/bin/env bash
# `vinesink sweep submit` on real engines, with a machine lost in the middle: Slurm and HyperQueue.
#
#     tests/cluster/run.sh VINESINK
#
# Needs root on Debian 12 or later and its package archive; from there and from PyPI it installs what is
# missing, the latter in a folder that it removes. Takes about three minutes on two processors.
set -euo pipefail

vinesink="$(realpath "${1:?usage: tests/cluster/run.sh VINESINK}")"
cd "$(dirname "$0")"

if [ "$(id -u)" != 0 ] || ! command -v apt-get >/dev/null; then
    echo "FAILED: Slurm's nodes need root, and their packages are Debian's; cargo test does without" >&2
    exit 1
fi

# Programs, and the packages that have them.
missing=()
while read -r program package; do
    command -v "$program" >/dev/null || missing+=("$package")
done <<'NEEDED'
slurmctld slurmctld
slurmd slurmd
sbatch slurm-client
ip iproute2
unshare util-linux
python3 python3
NEEDED
python3 -c 'import ensurepip, venv' 2>/dev/null || missing+=(python3-venv)
if [ "${#missing[@]}" != 0 ]; then
    apt-get update -qq
    DEBIAN_FRONTEND=noninteractive apt-get install -qq -y --no-install-recommends "${missing[@]}" >/dev/null
fi

folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT

./on_slurm.py "$vinesink"

python3 -m venv "$folder/python"
"$folder/python/bin/pip" install --quiet --disable-pip-version-check hyperqueue==0.27.0
PATH="$folder/python/bin:$PATH" ./on_hyperqueue.py "$vinesink"
