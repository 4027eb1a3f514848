#!/bin/sh
# Makes the README's pictures of the window, from window.lua, corridor.lua and, with the real logs, reality.lua: make_window.sh [FOLDER].
# Needs no display; ./demo or ./check have built the program. With ImageMagick they have a palette, and a third of the bytes.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
program=${MROSE_GUI:-$here/../../build/mrose-gui}
program=$(cd "$(dirname "$program")" && pwd)/$(basename "$program")
cd "${1:-$here}"
"$program" --offscreen --size 1280x800 --script "$here/window.lua"
"$program" --offscreen --size 1280x640 --script "$here/corridor.lua"
pictures="window.png window_dark.png corridor.png"
# The real logs are not part of mrose.
log=${MROSE_DATA:-}/MRCLAM_Dataset6
[ -d "$log" ] || log=${MROSE_DATA:-}/mrclam/MRCLAM_Dataset6
if [ -d "$log" ]; then
    "$program" --offscreen --size 1360x850 --script "$here/reality.lua" --log "$log"
    pictures="$pictures reality.png"
fi
case $(convert -version 2>/dev/null) in *ImageMagick*Copyright*) magick=yes ;; *) magick= ;; esac
for picture in $pictures; do
    [ -z "$magick" ] || convert "$picture" +dither -colors 255 -strip "PNG8:$picture"
    echo "$PWD/$picture"
done
