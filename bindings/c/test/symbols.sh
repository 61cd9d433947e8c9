#!/bin/sh
# The names that a library gives are those of the kept list, no more and no fewer.
#   symbols.sh LIBRARY LIST
set -eu
given=$(nm -D --defined-only "$1" | awk '$2 == "T" || $2 == "D" || $2 == "B" || $2 == "W" || $2 == "V" || $2 == "u" { print $3 }' | sed 's/@.*//' | LC_ALL=C sort)
if [ "$given" != "$(cat "$2")" ]; then
  printf '%s\n' "$given" | diff "$2" - || true
  echo "$1: its symbols are not those of $2" >&2
  exit 1
fi
