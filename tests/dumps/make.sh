#!/bin/sh
# Makes every dump anew: `tests/dumps/make.sh [NAME]`, with g++, freeglut3-dev, libegl-dev, apitrace and xvfb installed.
# One dump for each program as it stands, and one for each MISTAKE_… that its source names.
set -eu
cd "$(dirname "$0")"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export LIBGL_ALWAYS_SOFTWARE=1

# What the window system is asked before the first picture says nothing of it, and differs from machine to machine.
noise='glXQueryExtension|glXChooseFBConfig|glXGetVisualFrom|glX?GetProcAddress|eglGetProcAddress|glXIsDirect|process.name'

dump() { # program, name of the dump, options of the compiler
    program=$1 name=$2
    shift 2
    g++ -O1 "$@" -o "$work/program" "$program.cpp" -lglut -lGLU -lGL -lEGL
    api=gl
    if [ "$program" = core33 ]; then api=egl; fi
    xvfb-run -a -s '-screen 0 640x480x24' apitrace trace --api $api -o "$work/trace" "$work/program" >"$work/told" 2>&1 || true
    apitrace dump --verbose --color=never "$work/trace" | grep -vE "$noise" >"$name.txt"
    rm "$work/trace"
    echo "$name: $(wc -l <"$name.txt") lines"
}

for program in ${1:-legacy core33 dsa45 planar}; do
    rm -f "$program".txt "$program"-*.txt
    dump "$program" "$program"
    for mistake in $(grep -o 'MISTAKE_[a-z0-9_]*[a-z0-9]' "$program.cpp" | sort -u); do
        # The accumulation buffer is there twice.
        case $mistake in
        MISTAKE_accumulator_of_8_bits) dump "$program" "$program-${mistake#MISTAKE_}" "-D$mistake" -DFBO ;;
        MISTAKE_accumulator_not_cleared | MISTAKE_not_returned | MISTAKE_weights_wrong)
            dump "$program" "$program-${mistake#MISTAKE_}" "-D$mistake"
            dump "$program" "$program-fbo-${mistake#MISTAKE_}" "-D$mistake" -DFBO
            ;;
        *) dump "$program" "$program-${mistake#MISTAKE_}" "-D$mistake" ;;
        esac
    done
    if grep -q 'ifdef FBO' "$program.cpp"; then dump "$program" "$program-fbo" -DFBO; fi
done
