#!/bin/sh
# SPDX-License-Identifier: MIT
# Checks the documents that are installed beside the program.
#   sh tests/install/documents.sh PREFIX
set -eu
share=$1/share
failures=0

# expect WHAT COMMAND...: names what is not so.
expect() {
  what=$1
  shift
  if "$@" > "$share/words" 2>&1; then return; fi
  echo "failed: $what" >&2
  cat "$share/words" >&2
  failures=$((failures + 1))
}
silent() { [ -z "$("$@" 2>&1)" ]; }
has() { command -v "$1" > /dev/null; }
contains() { grep -qF -e "$2" "$1"; }

expect "the licence is there" test -s "$share/doc/loft/LICENSE"

page=$share/man/man1/loft.1
expect "the manual page renders without a warning" silent groff -man -Tutf8 -ww -z "$page"
if has mandoc; then expect "mandoc finds no error in it" mandoc -T lint -W error "$page"; fi
for option in 'max\-edge' 'keyhole\-width' 'replay\-rate' 'epsilon' 'stack'; do
  expect "the manual page has $option" contains "$page" "\\-\\-$option"
done
expect "hidden commands are not in it" sh -c "! grep -q 'loft completion' '$page'"

bash=$share/bash-completion/completions/loft
expect "the bash completion is bash" bash -n "$bash"
# complete WORDS...: what bash offers for the last word.
cat > "$share/complete.bash" << 'END'
source "$1"
shift
complete -p loft > /dev/null || exit 1
COMP_WORDS=("$@")
COMP_CWORD=$(($# - 1))
_loft
printf '%s\n' "${COMPREPLY[@]}"
END
# offers WORD WORDS...: bash offers WORD for the last of WORDS.
offers() {
  wanted=$1
  shift
  bash "$share/complete.bash" "$bash" "$@" | grep -qxF -e "$wanted"
}
expect "bash completes commands" offers reconstruct loft rec
expect "bash completes what help is about" offers triangulate loft help t
expect "bash completes options" offers --keyhole-width loft reconstruct a.ndjson --key
expect "bash completes choices" offers keyhole-aware loft reconstruct --fill k
expect "bash completes choices behind =" offers nonzero loft stream --fill = n
expect "bash completes commands below commands" offers verify loft session v
expect "bash completes their options" offers --edits loft session export --ed
expect "bash does not offer hidden commands" sh -c "! grep -q \"'completion\" '$bash'"

zsh=$share/zsh/site-functions/_loft
expect "the zsh completion says what it completes" test "$(head -n 1 "$zsh")" = "#compdef loft"
if has zsh; then
  expect "the zsh completion is zsh" zsh -n "$zsh"
  expect "zsh takes it" zsh -fc "autoload -Uz compinit && compinit -D && source '$zsh' &&
    [[ \$_comps[loft] == _loft ]]"
fi
fish=$share/fish/vendor_completions.d/loft.fish
expect "the fish completion knows commands" contains "$fish" "-a reconstruct"
if has fish; then
  expect "the fish completion is fish" fish --no-execute "$fish"
  expect "fish completes options" sh -c \
    "fish -c \"source '$fish'; complete -C 'loft reconstruct --key'\" | grep -q keyhole-width"
fi

rm -f "$share/words" "$share/complete.bash"
[ "$failures" = 0 ]
