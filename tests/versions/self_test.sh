#!/usr/bin/env bash
# versions.sh on copies of the stated versions: one that differs is found. self_test.sh versions.sh ROOT SCRATCH
set -euo pipefail
script=$1 root=$2 work=$3
files=(CMakeLists.txt modules/base/include/asperity/base/version.h CITATION.cff CHANGELOG.md studio/web/package.json
  studio/web/package-lock.json docs/architecture.md)
fail() { echo "versions: $1"; exit 1; }
copy() {
  rm -rf "$work" && mkdir -p "$work"
  (cd "$root" && cp --parents "${files[@]}" "$work/")
}
refuses() {  # file sed-expression
  copy
  sed -i -E "$2" "$work/$1"
  ! cmp -s "$root/$1" "$work/$1" || fail "$1 was not changed by $2"
  ! "$script" "$work" 2>"$work/log" || fail "took $2 of $1"
}

copy
"$script" "$work" || fail "refused what is there"
refuses CMakeLists.txt 's/VERSION [0-9.]+/VERSION 9.9.9/'
refuses modules/base/include/asperity/base/version.h 's/kVersion = "[^"]*/kVersion = "9.9.9/'
refuses modules/base/include/asperity/base/version.h 's/kVersionDate = "[^"]*/kVersionDate = "1999-01-01/'
refuses CITATION.cff 's/^version: .*/version: 9.9.9/'
refuses CITATION.cff 's/^date-released: .*/date-released: "1999-01-01"/'
refuses CHANGELOG.md '0,/^## [0-9]/s/^## [0-9.]+/## 9.9.9/'
refuses studio/web/package.json '0,/"version"/s/"version": "[^"]*/"version": "9.9.9/'
refuses studio/web/package-lock.json '3s/"version": "[^"]*/"version": "9.9.9/'
refuses studio/web/package-lock.json '9s/"version": "[^"]*/"version": "9.9.9/'
refuses docs/architecture.md 's/find_package\(asperity [0-9.]+/find_package(asperity 9.9/'
