"""What bash, zsh and fish offer for a command line, by the scripts of `asperity --completion`.

offered(shell, script, lines) gives for each of `lines`, typed up to the cursor, the set of words that the shell offers. bash
runs its function with the words as readline splits them; zsh runs its function with compadd, compset and _files recorded;
fish completes by itself.
"""

import re
import shlex
import subprocess
import tempfile

BASH = r"""
source "$1"
compopt() { :; }
while IFS= read -r -d '' line; do
  mapfile -t COMP_WORDS <<<"${line//$'\x1f'/$'\n'}"
  COMP_CWORD=$((${#COMP_WORDS[@]} - 1)) COMPREPLY=()
  _asperity
  printf '%s\x1f' "${COMPREPLY[@]}"
  printf '\0'
done
"""

ZSH = r"""
function compdef() { }
function compadd() {
  local -a given
  local word
  while [[ $1 == -* ]]; do
    case $1 in
      -a) given+=(${(P)2}); shift 2 ;;
      -S) shift 2 ;;
      --) shift; break ;;
      *) print -u2 "compadd $1?"; exit 1 ;;
    esac
  done
  given+=("$@")
  local found=1
  for word in $given; do
    if [[ $word == ${(b)PREFIX}* ]]; then print -rn -- $word$'\x1f'; found=0; fi
  done
  return found
}
function compset() { [[ $2 == '*:' ]] && PREFIX=${PREFIX##*:} || PREFIX=${PREFIX#$2} }
function _files() { print -rn -- FILES$'\x1f' }
source $1
while IFS= read -r -d '' line; do
  words=(${(ps:\x1f:)line}) CURRENT=$#words
  [[ $line != *$'\x1f' ]] || { words+=(''); CURRENT=$#words }
  PREFIX=$words[CURRENT]
  _asperity
  print -rn -- $'\0'
done
"""


def words_of(line, breaks=""):
    """As a shell splits it: the last word, empty behind a space, is at the cursor; a run of `breaks` is a word of its own."""
    words = []
    for word in line.split(" "):
        words += [part for part in re.split(f"([{breaks}]+)", word) if part] if breaks and word else [word]
    return words


def run(program, script, lines):
    given = "".join("\x1f".join(words) + "\0" for words in lines)
    with tempfile.TemporaryDirectory() as empty:
        out = subprocess.run([*program, script], input=given, cwd=empty, check=True, stdout=subprocess.PIPE, text=True).stdout
    return [{word for word in one.split("\x1f") if word} for one in out.split("\0")[:-1]]


def offered(shell, script, lines):
    if shell == "bash":
        return run(["bash", "--norc", "-c", BASH, "bash"], script, [words_of(line, "=:") for line in lines])
    if shell == "zsh":
        return [each - {"FILES"} for each in run(["zsh", "-f", "-c", ZSH, "zsh"], script, [words_of(line) for line in lines])]
    commands = "".join(f"complete -C {shlex.quote(line)}; printf '\\0\\n'\n" for line in lines)
    with tempfile.TemporaryDirectory() as empty:
        out = subprocess.run(["fish", "--no-config", "-c", f"source {shlex.quote(str(script))}\n{commands}"],
                             cwd=empty, check=True, stdout=subprocess.PIPE, text=True).stdout
    # A word, a tab, its description. What is before the last = on the line is part of the word.
    before = [line.split(" ")[-1].rpartition("=") for line in lines]
    return [{word.split("\t")[0].removeprefix(begin + equals) for word in one.strip("\n").splitlines() if word}
            for one, (begin, equals, _end) in zip(out.split("\0")[:-1], before)]
