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

# Names choose tables, each command runs once, one that fails leaves its tables and is an error.
printf '#!/bin/sh\necho run >>%s/runs\necho "| $1 |"\n' "$work" >"$work/bin/table"
printf '#!/bin/sh\necho "| half |"\nexit 1\n' >"$work/bin/broken"
chmod +x "$work/bin/broken"
printf '<!-- figures: table 1 -->\n<!-- end of figures -->\n<!-- figures: table 2 -->\n<!-- end of figures -->\n<!-- figures: table 1 -->\n<!-- end of figures -->\n<!-- figures: broken -->\n| old |\n<!-- end of figures -->\n' >"$work/page.md"
run 'table 2' || fail "a table could not be chosen by its name"
grep -q '^| 2 |$' "$work/page.md" && ! grep -q '^| 1 |$' "$work/page.md" || fail "another table than the named one was written"
! run 'tab' || fail "a part of a program's name was taken for it"
rm "$work/runs"
! run || fail "a program that fails went unnoticed"
grep -q '^| old |$' "$work/page.md" || fail "the table of a program that fails was changed"
(($(grep -c '^| 1 |$' "$work/page.md") == 2)) || fail "not all tables of one command were written"
(($(wc -l <"$work/runs") == 2)) || fail "a command ran more than once"
! env DOC_FIGURES_BIN="$work/bin" "$script" docs/nowhere.md 2>>"$work/log" || fail "a document that does not exist was taken"
