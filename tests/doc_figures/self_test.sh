#!/usr/bin/env bash
# scripts/doc_figures on a made document and a made program: what is stale is found and written, the rest stays.
set -euo pipefail
script=$1 work=$2
rm -rf "$work" && mkdir -p "$work/bin"
printf '#!/bin/sh\necho "| $1 | $2 |"\n' >"$work/bin/table"
chmod +x "$work/bin/table"
document() { printf 'before\n<!-- figures: table 3 4 -->\n%s\n<!-- end of figures -->\nafter\n<!-- figures: table {data}/x -->\n| kept |\n<!-- end of figures -->\n' "$1" >"$work/page.md"; }
run() { env -u ASPERITY_DATA DOC_FIGURES_BIN="$work/bin" "$script" "$@" "$work/page.md" 2>>"$work/log" >>"$work/log"; }
fail() { echo "doc_figures: $1"; cat "$work/log" "$work/page.md"; exit 1; }

document '| 3 | 5 |'
cp "$work/page.md" "$work/stale.md"
! run --check || fail "a stale table was not found"
cmp -s "$work/page.md" "$work/stale.md" || fail "--check wrote"
run || fail "could not write"
document '| 3 | 4 |' && cp "$work/page.md" "$work/expected.md"
cp "$work/stale.md" "$work/page.md" && run && cmp -s "$work/page.md" "$work/expected.md" || fail "wrote something else"
run --check || fail "a fresh table was called stale"
grep -q 'not run, for want of data.*table {data}/x' "$work/log" || fail "did not name what it could not run"

printf '<!-- figures: table 3 4 -->\n| 3 | 4 |\nthe end is missing\n' >"$work/page.md"
cp "$work/page.md" "$work/stale.md"
! run || fail "a table without an end was written"
cmp -s "$work/page.md" "$work/stale.md" || fail "a document without an end was changed"
