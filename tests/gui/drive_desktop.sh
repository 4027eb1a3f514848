#!/bin/sh
# Within an X server: opens the window PROGRAM on SCENARIO under a window manager, presses keys in it, and ends it.
# FOLDER gets pictures of the screen before and after; standard output is the program's.
#   drive_desktop.sh PROGRAM SCENARIO FOLDER KEY...
set -eu
program=$1 scenario=$2 folder=$3
shift 3
openbox >/dev/null 2>&1 &
manager=$!
"$program" "$scenario" --print-hash &
window=$!
trap 'kill "$manager" "$window" 2>/dev/null || true' EXIT
id=$(timeout 60 xdotool search --sync --onlyvisible --pid "$window" --name ' mrose' | tail -n 1)
timeout 60 xdotool windowactivate --sync "$id"
import -window root "$folder/before.png"
for key in "$@"; do xdotool key --clearmodifiers "$key"; done
timeout 60 xdotool getwindowfocus >/dev/null
import -window root "$folder/after.png"
xdotool key --clearmodifiers ctrl+q
wait "$window"
