# What five kinds of users do, from the packages alone: read by sh in a folder of its own, on a machine
# that has lantern, lantern-lab, lantern-dev and lantern-doc installed and nothing of the repository.
set -eu
doc=/usr/share/doc/lantern-doc
fail() { echo "user_tasks: $*" >&2; exit 1; }
is() { head -c "${#2}" "$1" | grep -qF "$2" || fail "$1 is no $2"; }

# The lecturer: a handout, a figure for a paper, a film of 20 seconds, a lecture in German, black slides.
lantern render ghost_quadtree pong_bsp buckets node_reuse -o handout.pdf --sheet 2x3 --quiet
is handout.pdf "%PDF"
for figure in figure.pdf figure.svg figure.png; do
  lantern render ghost_quadtree -o $figure --width 8cm --panel tree --at four --quiet
  [ -s $figure ] || fail "no $figure"
done
grep -q 'width="2[0-9.]*pt"' figure.svg || fail "the figure is not 8 cm wide"
if command -v ffmpeg >/dev/null; then
  lantern render pong_bsp -o film.mp4 --length 20 --size 640x360 --quiet
  ffprobe -v error -show_entries format=duration -of csv=p=0 film.mp4 | grep -qE "^(19\.9|20\.0)" ||
    fail "the film is not 20 s long"
fi
lantern render ghost_quadtree --language de --at four -o deutsch.html --quiet
grep -q '<html lang="de"' deutsch.html || fail "the lesson is not in German"
grep -q 'Fragen' deutsch.html || fail "the page's words are not German"
lantern render kdtree_atlas --language fr -o fr.svg --text text --frames 3 --quiet
! grep -qE '>(candidate|leaves|textures|waiting)' fr.svg || fail "English words on a French picture"
lantern reference --words de >sv.toml
sed -i 's/^language = .*/language = "sv"/; /^"root" = /d' sv.toml
lantern check ghost_quadtree --words sv.toml 2>said
grep -q 'lack "root"' said || fail "a missing word is not told: $(cat said)"

# The author: a shape and a colour of his own, a name in any letters, a loop, land without a sea.
cat >own.toml <<'TOML'
title = "Autos"
language = "de"
[world]
size = [16, 9]
[structure]
kind = "quadtree"
capacity = 1
[[body]]
name = "car"
label = "Käfer"
outline = "M0 1 L2 1 3 0 5 0 6 1 8 1 8 2 0 2z"
paint = "#0077aa"
half_size = [1.2, 0.4]
position = [4, 4]
velocity = [1, 0]
[[step]]
do = "insert"
bodies = ["car"]
[[step]]
do = "run"
name = "on"
seconds = 0.5
repeat = 5
TOML
lantern check own.toml --quiet || fail "the author's scenario"
lantern render own.toml -o own.svg --text text --frames 0 --quiet
grep -q "Käfer" own.svg || fail "the label is not drawn"
sed 's/outline = .*/look = "plane"/' own.toml >wrong.toml
! lantern check wrong.toml 2>said || fail "an unknown look is taken"
grep -q "ghost" said || fail "the looks are not listed: $(cat said)"

# The student: her own tree, right and wrong, in the example project.
cp -r $doc/tests/example project
cmake -S project -B project/build >/dev/null && cmake --build project/build >build.log 2>&1 ||
  fail "the example project: $(tail -n 5 build.log)"
project/build/my_tree structure check mine --worlds 50 --quiet || fail "her tree"

# The researcher: his own table of boxes.
printf 'nr,cx,cy,w,h,colour\n1,0,0,2,2,red\n2,1,1,2,2,blue\n3,9,9,1,1,red\n' >boxes.csv
lantern bench pairs --boxes boxes.csv --columns x=cx,y=cy,width=w,height=h --seconds 0.1 -o pairs \
  >report 2>&1 || fail "his boxes: $(tail -n 5 report)"
printf '4,a,1,1,1,red\n5,1,b,1,1,red\n' >>boxes.csv
! lantern bench pairs --boxes boxes.csv --columns x=cx,y=cy,width=w,height=h -o pairs 2>said ||
  fail "bad lines are taken"
grep -q ":5" said && grep -q ":6" said || fail "not all bad lines are told: $(cat said)"

# Whoever installs: README, workflow, hook, and what a bare call says.
for file in README.md tests/example/golden-workflow.yml tests/example/pre-commit scenarios/REFERENCE.md; do
  [ -s $doc/$file ] || fail "$doc/$file is missing"
done
lantern 2>said || true
[ "$(wc -l <said)" -ge 5 ] || fail "a bare lantern says nothing"
! lantern render quadtree 2>said || fail "quadtree is no scenario"
grep -q "did you mean" said || fail "no name is suggested"
echo "the tasks of lecturer, author, student, researcher and whoever installs are done from the packages"
