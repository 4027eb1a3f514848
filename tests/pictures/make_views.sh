#!/bin/sh
# Pictures of each view of the window, to be looked at: make_views.sh FOLDER [VIEWS...]; of the views `game` and `reality`
# beside this file, or of both. In light and dark colours at 1024 x 620, 1280 x 800, 1920 x 1080, and 1280 x 800 at 200 %:
# FOLDER/1024x620_light/paused.png. SIZES="1280x800 960x540@2" and THEMES=dark choose others. The log is a real one where
# MROSE_DATA names it, otherwise the one that ships. Needs no display.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
program=${MROSE_GUI:-$here/../../build/mrose-gui}
program=$(cd "$(dirname "$program")" && pwd)/$(basename "$program")
log=${MROSE_DATA:-}/mrclam/MRCLAM_Dataset6
[ -d "$log" ] || log=$here/../../resources/logs/pioneer/random.csv
mkdir -p "${1:?names the folder for the pictures}"
folder=$(cd "$1" && pwd)
shift
views=${*:-game reality}
for size in ${SIZES:-1024x620 1280x800 1920x1080 1280x800@2}; do
    for theme in ${THEMES:-light dark}; do
        mkdir -p "$folder/${size}_$theme"
        cd "$folder/${size}_$theme"
        for view in $views; do
            set -- --offscreen --size "${size%@*}" --script "$here/$view.lua"
            [ "$theme" = light ] || set -- "$@" --dark
            [ "$view" != reality ] || set -- "$@" --log "$log"
            scale=1
            case $size in *@*) scale=${size#*@} ;; esac
            QT_SCALE_FACTOR=$scale "$program" "$@"
        done
    done
done
