#!/bin/sh
# Installs those of the Debian packages listed in packages.txt that are missing. Asks for nothing where all are there.
set -eu
list=$(dirname "$0")/../packages.txt
missing=
for package in $(sed 's/#.*//' "$list" | awk 'NF { print $1 }'); do
    dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing="$missing $package"
done
[ -n "$missing" ] || exit 0
as_root=
[ "$(id -u)" = 0 ] || as_root=sudo
echo "Installing:$missing"
$as_root apt-get update -qq
# shellcheck disable=SC2086
DEBIAN_FRONTEND=noninteractive $as_root apt-get install -y -qq --no-install-recommends $missing >/dev/null
