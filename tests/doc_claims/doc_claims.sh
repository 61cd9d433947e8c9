#!/usr/bin/env bash
# What the documents call proof exists: doc_claims.sh ROOT
#  - every test that a document names in back quotes, `NAME_test`, `NAME_test.cc` or `NAME_test --gtest_filter=…`, is a
#    file of that name or a test program, and every part of a filter matches a test of the sources;
#  - every program of `bench: NAME` and `build/release/bin/NAME` is declared;
#  - every paragraph that says that something is verified, compared with finite differences, or held by a test names it.
set -euo pipefail
cd "$1"
failed=0
complain() { echo "doc_claims: $1" >&2; failed=1; }

mapfile -t documents < <(find docs -name '*.md' | sort)
declarations=$(find . -path ./build -prune -o -name CMakeLists.txt -print0 | xargs -0 cat)
tests=$(find . -path ./build -prune -o -name '*_test.cc' -print0 | xargs -0 cat | tr '\n' ' ' |
  grep -oE 'TEST(_F|_P)?\( *[A-Za-z0-9_]+ *, *[A-Za-z0-9_]+' | sed -E 's/^TEST(_F|_P)?\( *//; s/ *, */./' | sort -u)
typed=$(find . -path ./build -prune -o -name '*_test.cc' -print0 | xargs -0 cat | tr '\n' ' ' |
  grep -oE 'TYPED_TEST\( *[A-Za-z0-9_]+ *, *[A-Za-z0-9_]+' | sed -E 's/^TYPED_TEST\( *//; s/ *, */./' | sort -u || true)
files=$(find . -path ./build -prune -o -name '*_test*.cc' -print | sed 's|.*/||')

declared() { grep -qE "[( ]$1([ )]|\$)" <<<"$declarations"; }
is_test() {  # NAME_test
  grep -qxF "$1.cc" <<<"$files" || [[ -d modules/${1%_test}/test ]] || declared "$1"
}

for document in "${documents[@]}"; do
  while read -r word; do
    [[ $word != '`test/*_test.cc`' ]] || continue  # of any module
    word=${word#\`}; word=${word%\`}
    name=${word%% *}; name=${name##*/}
    if [[ $name == *\** ]]; then
      compgen -G "${word%% *}" >/dev/null || complain "$document: no file $word"
      continue
    fi
    if ! is_test "${name%.cc}"; then complain "$document: no test $name"; fi
    [[ $word == *--gtest_filter=* ]] || continue
    filter=${word#*--gtest_filter=}; filter=${filter%% *}; filter=${filter//\'/}; filter=${filter%%-*}
    IFS=: read -ra parts <<<"$filter"
    for part in "${parts[@]}"; do
      pattern=$(sed 's/\./\\./g; s/\*/.*/g; s/?/./g' <<<"$part")
      grep -qE "^$pattern\$" <<<"$tests"$'\n'"$typed" || complain "$document: no test $part"
    done
  done < <(grep -oE '`[a-zA-Z0-9_/.*]*_test(\.cc)?( [^`]*)?`' "$document" | sort -u)
  while read -r name; do
    declared "$name" || [[ -e bench/$name || -e bench/$name.cc ]] || [[ $name == asperity ]] || is_test "$name" ||
      complain "$document: no program $name"
  done < <(grep -oE '(bench: |build/release/bin/)[a-z0-9_]+' "$document" | sed -E 's/^(bench: |.*\/)//' | sort -u)
  # A paragraph ends at an empty line; a table and a list of points are one.
  while read -r line; do complain "$document: a proof without a name: ${line:0:160}"; done < <(awk -v RS='' '
    tolower($0) ~ /verified (by|against|in|with)|finite differences|(a|the) tests? (compare|hold|check|demand|count|verif|show)/ &&
    $0 !~ /`[a-zA-Z0-9_\/.*]*_test(\.cc)?[ `]|bench: |build\/release\/bin\// { gsub(/\n/, " "); print }' "$document")
done
exit $failed
