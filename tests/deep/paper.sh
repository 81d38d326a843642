#!/bin/sh
# A LaTeX document with a figure of a given width and a film of `animate`, built from a scenario, and a
# handout of four: pages, widths and sizes of letters are read from what poppler finds in them. Without
# Debian's TeX only the handout is.
set -eu
lantern=$(realpath "${LANTERN:-build/lantern}")
cd "$(dirname "$0")/../.."
scenarios=$(pwd)/scenarios
work=$(mktemp -d "${TMPDIR:-/dev/shm}/lantern-paper.XXXXXX")
trap 'rm -rf "$work"' EXIT
cd "$work"

# least_letters FILE: points, to a third of one, of all text in a PDF
least_letters() {
  pdftohtml -xml -zoom 3 -i -stdout "$1" | grep -o '<fontspec [^>]* size="[0-9]*"' |
    sed 's/.*size="\([0-9]*\)"/\1/' | sort -n | awk 'NR == 1 { print $1 / 3 }'
}
fail() { echo "paper: $*" >&2; exit 1; }

"$lantern" render "$scenarios"/ghost_quadtree.toml "$scenarios"/pong_bsp.toml "$scenarios"/buckets.toml \
  "$scenarios"/node_reuse.toml -o handout.pdf --sheet 2x3 --quiet
pages=$(pdfinfo handout.pdf | sed -n 's/^Pages: *//p')
[ "$pages" -le 10 ] || fail "four lessons take $pages pages"
least=$(least_letters handout.pdf)
awk "BEGIN { exit !($least >= 5.99) }" || fail "letters of $least pt"
handout="a handout of 4 lessons on $pages pages, letters from $least pt"

if ! command -v pdflatex >/dev/null || ! kpsewhich animate.sty >/dev/null; then
  echo "$handout; no TeX here (texlive-latex-extra): no document"
  exit 0
fi
"$lantern" render "$scenarios"/ghost_quadtree.toml -o figure.pdf --width 8cm --frames 5 --quiet
"$lantern" render "$scenarios"/ghost_quadtree.toml -o tree.pdf --width 5cm --panel tree --frames 5 --quiet
"$lantern" render "$scenarios"/ghost_quadtree.toml -o film.pdf --width 8cm --quiet
last=$(($(pdfinfo film.pdf | sed -n 's/^Pages: *//p') - 1))
cat >paper.tex <<TEX
\documentclass{article}
\usepackage{graphicx,animate}
\begin{document}
A figure: \includegraphics{figure.pdf}

One panel: \includegraphics{tree.pdf}

A film: \animategraphics[controls]{2}{film}{}{}
\end{document}
TEX
pdflatex -interaction=nonstopmode -halt-on-error paper.tex >tex.log || { tail -n 20 tex.log >&2; fail "pdflatex"; }
! grep 'Overfull' paper.log >&2 || fail "a picture is wider than it says"
grep -q 'figure.pdf' paper.log && grep -q 'film.pdf' paper.log || fail "a picture is missing"
pdftotext paper.pdf - | grep -q root || fail "no words of the figure"
width=$(pdfinfo figure.pdf | sed -n 's/^Page size: *\([0-9.]*\).*/\1/p')
echo "$handout; a document of a figure $width pt wide, a panel and a film of $((last + 1)) pictures"
