#!/usr/bin/env bash
# doc_claims.sh on a made tree: what exists passes, each kind of claim without proof is found.
set -euo pipefail
script=$1 work=$2
rm -rf "$work" && mkdir -p "$work/docs" "$work/modules/one/test" "$work/bench"
printf 'add_executable(speed speed.cc)\n' >"$work/CMakeLists.txt"
printf 'TEST(Line,\n     IsStraight) {}\nTEST_F(Line, Ends) {}\n' >"$work/modules/one/test/line_test.cc"
fail() { echo "doc_claims: $1"; exit 1; }
passes() { printf '%s\n' "$1" >"$work/docs/page.md"; "$script" "$work" 2>"$work/log" || { cat "$work/log"; fail "refused: $1"; }; }
refuses() { printf '%s\n' "$1" >"$work/docs/page.md"; ! "$script" "$work" 2>"$work/log" || fail "took: $1"; }

passes 'It is straight (`line_test`), as `one_test --gtest_filter='"'Line.Is*:Line.Ends'"'` shows; `bench: speed`.'
passes 'The slope is compared with finite differences (`modules/one/test/line_test.cc`).'
passes 'A test is a good thing, and a finite sum too.'
refuses 'It is round (`circle_test`).'
refuses '`one_test --gtest_filter=Line.IsRound` shows it.'
refuses '`bench: slowness` prints it.'
refuses 'The slope is compared with finite differences.'
refuses 'This was verified by hand; a test compares it.'
