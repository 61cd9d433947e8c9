#!/usr/bin/env bash
# The version is the same wherever it is stated, and so is its date: versions.sh ROOT
set -euo pipefail
cd "$1"
failed=0
# The first match of an expression with one group, over the whole file.
stated() { perl -0777 -ne 'print $1 if /'"$2"'/m' "$1"; }  # file expression
same() {  # file what expression expected
  local found
  found=$(stated "$1" "$3")
  [[ $found == "$4" ]] || { echo "versions: $1: $2 is '$found', CMakeLists.txt and version.h state '$4'" >&2; failed=1; }
}

version=$(stated CMakeLists.txt '^project\(asperity VERSION ([0-9.]+)')
header=modules/base/include/asperity/base/version.h
date=$(stated $header 'kVersionDate = "([^"]*)"')
[[ -n $version && -n $date ]] || { echo "versions: CMakeLists.txt or $header states nothing" >&2; exit 1; }
same $header kVersion 'kVersion = "([^"]*)"' "$version"
same CITATION.cff version '^version: (\S+)' "$version"
same CITATION.cff date-released '^date-released: "([^"]*)"' "$date"
same CHANGELOG.md 'the last released version' '^## ([0-9][0-9.]*) - ' "$version"
same CHANGELOG.md 'its date' '^## [0-9][0-9.]* - (\S+)' "$date"
same studio/web/package.json version '"version": "([^"]*)"' "$version"
same studio/web/package-lock.json version '"version": "([^"]*)"' "$version"
same studio/web/package-lock.json 'version of the root package' '"": \{[^}]*?"version": "([^"]*)"' "$version"
same docs/architecture.md 'find_package' 'find_package\(asperity ([0-9.]+)' "${version%.*}"
exit $failed
