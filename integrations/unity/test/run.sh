#!/usr/bin/env bash
# Compiles the Unity package with mono and tests its part without Unity over the C library.
#   integrations/unity/test/run.sh BUILD SCENE      BUILD has libasperity_feel.so, SCENE is a *.scene.json
# The part for Unity and its editor is compiled against UnityStubs.cs, which has the signatures alone; it is not run.
set -euo pipefail
build=$(realpath "$1") scene=$(realpath "$2")
cd "$(dirname "${BASH_SOURCE[0]}")/.."
command -v mcs >/dev/null || { echo "mcs is missing: apt-get install mono-mcs mono-runtime libmono-system-core4.0-cil"; exit 2; }
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
package=com.asperity.feel
./metas.py $package --check
compile() { mcs -warnaserror -langversion:7 "$@"; }
core=-r:$out/Asperity.Feel.dll unity=(-r:"$out/UnityStubs.dll" -r:"$out/Asperity.Feel.Unity.dll")
compile -target:library -out:"$out/Asperity.Feel.dll" $package/Runtime/Core/*.cs
compile -target:library -out:"$out/UnityStubs.dll" test/UnityStubs.cs
compile -target:library "$core" -r:"$out/UnityStubs.dll" -out:"$out/Asperity.Feel.Unity.dll" $package/Runtime/Unity/*.cs
compile -target:library "$core" "${unity[@]}" -out:"$out/Asperity.Feel.Editor.dll" $package/Editor/*.cs
compile -target:library "$core" "${unity[@]}" -out:"$out/Asperity.Feel.Samples.dll" $package/Samples~/*/*.cs
compile "$core" -r:"$out/Asperity.Feel.Editor.dll" -out:"$out/CoreTest.exe" test/CoreTest.cs
library=$(find "$build" -name libasperity_feel.so -print -quit)
[[ -n $library ]] || { echo "$build has no libasperity_feel.so: build the target asperity_feel"; exit 2; }
LD_LIBRARY_PATH=$(dirname "$library") mono "$out/CoreTest.exe" "$scene" "$out/streaming"
