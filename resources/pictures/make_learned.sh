#!/bin/sh
# Makes the README's pictures of what was learned: the ball off the wall, a team on its planned paths, and how many go for the
# ball, where localisation and radio get worse: make_learned.sh [FOLDER]. Needs no display, but ImageMagick and rsvg-convert.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
programs=$(cd "$here/../../build" && pwd)
cd "${1:-$here}"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
out=$PWD
palette="+dither -colors 255 -strip"
(
    cd "$work"
    "$programs/mrose-gui" --offscreen ball_off_the_wall.toml --trial 17 --size 1000x700 --script "$here/../paper/figure3.lua"
    for letter in a b c d; do
        # without the window's frame and much of what lies beyond the wall
        convert figure3$letter.png -shave 3x3 -gravity North -chop 0x130 -gravity NorthWest -pointsize 34 -fill '#333333' \
            -annotate +14+6 $letter -bordercolor white -border 4x0 frame_$letter.png
    done
    convert frame_a.png frame_b.png frame_c.png frame_d.png +append -resize 1400x $palette "PNG8:$out/ball_off_the_wall.png"
    "$programs/mrose-gui" --offscreen planner_choice_validation.toml --trial 3042 --variant 'chosen in simulator' --size 1100x720 \
        --script "$here/navigation.lua"
    convert navigation.png $palette "PNG8:$out/navigation.png"
    "$programs/mrose" experiment who_goes_sweep.toml -o sweep --quiet >/dev/null
    "$here/page_figures" sweep/report.html figure
    # by measure, over localisation errors and over lost messages: none, one, more
    convert '(' figure0.png figure2.png figure4.png +append ')' '(' figure1.png figure3.png figure5.png +append ')' \
        -append -resize 1560x $palette "PNG8:$out/who_goes_sweep.png"
)
for picture in ball_off_the_wall navigation who_goes_sweep; do echo "$out/$picture.png"; done
