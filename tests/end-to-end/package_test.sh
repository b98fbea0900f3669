#!/usr/bin/env bash
# The packages of a build: the runtime's, unpacked into an empty root, flies a ready-baked body and serves a program in
# C, without the build folder; the baking tools are in the other.
# Usage: package_test.sh BUILD_FOLDER WORK_FOLDER SOURCE_FOLDER
set -euo pipefail
build=$1
work=$2
source_folder=$3

fail() {
  echo "$*" >&2
  exit 1
}

rm -rf "$work"
mkdir -p "$work/root" "$work/scene"
(cd "$work" && cpack -G DEB --config "$build/CPackConfig.cmake" -B "$work/packages") >"$work/cpack.log" ||
  fail "cpack failed: $(tail -n 5 "$work/cpack.log")"
core=$(echo "$work"/packages/samara-core_*.deb)
runtime=$(echo "$work"/packages/samara-runtime_*.deb)
baking=$(echo "$work"/packages/samara-baking_*.deb)

# Dependencies are those that dpkg-shlibdeps finds, and the tools' own.
dpkg-deb -f "$runtime" Depends | grep -q 'libhdf5' || fail "the runtime depends on no HDF5"
dpkg-deb -f "$runtime" Depends | grep -qE 'gmsh|openfoam|snakemake' && fail "the runtime depends on baking tools"
for package in samara-runtime openfoam snakemake libgmsh; do
  dpkg-deb -f "$baking" Depends | grep -q "$package" || fail "the baking tools do not depend on $package"
done
dpkg-deb -f "$core" Depends | grep -qE 'toml|tinygltf|samara' && fail "the core depends on more than it needs"
dpkg-deb -f "$runtime" Depends | grep -q 'samara-core (=' || fail "the runtime does not depend on the core"
dpkg-deb -c "$core" | grep 'include/samara_bullet.hpp$' >/dev/null || fail "the core holds no samara_bullet.hpp"
dpkg-deb -f "$core" Depends | cat - <(dpkg-deb -f "$runtime" Depends) | grep -qE 'mujoco|bullet' && fail "core or runtime depend on another engine"
mujoco=$(find "$work/packages" -maxdepth 1 -name 'samara-mujoco_*.deb')  # where MuJoCo is
if [ -n "$mujoco" ]; then
  for package in samara-runtime libmujoco; do
    dpkg-deb -f "$mujoco" Depends | grep -q "$package" || fail "samara-mujoco does not depend on $package"
  done
fi
dpkg-deb -c "$runtime" | awk '{ print $6 }' >"$work/runtime"
dpkg-deb -c "$baking" | awk '{ print $6 }' >"$work/baking"
grep -v '/$' "$work/runtime" | grep -Fxf "$work/baking" && fail "both packages hold these files"
grep -q 'bin/samara-bake$' "$work/baking" || fail "there is no samara-bake among the baking tools"
grep -q 'foam-cases/farm/Snakefile$' "$work/baking" || fail "there are no case templates among the baking tools"
if command -v help2man >/dev/null; then
  grep -q 'man1/samara-simulate\.1$' "$work/runtime" || fail "the runtime has no manual pages"
  grep -q 'man1/samara-bake\.1$' "$work/baking" || fail "the baking tools have no manual pages"
fi

# The runtime alone, away from the folders it was built in.
mkdir "$work/core"
dpkg -x "$core" "$work/core"
cc -std=c99 -Wall "$source_folder/docs/examples/fall.c" -I"$work/core/usr/include" \
  -L"$(dirname "$(find "$work/core" -name libsamara-core.so)")" -lsamara-core -lm -o "$work/fall"
LD_LIBRARY_PATH=$(dirname "$(find "$work/core" -name libsamara-core.so)") \
  "$work/fall" "$source_folder/runtime/bodies/airplane.body.h5" >"$work/poses" || fail "the core alone does not fly a body"
[ -s "$work/poses" ] || fail "the core alone printed nothing"
dpkg -x "$runtime" "$work/root"
dpkg -x "$core" "$work/root"
samara=$work/root/usr/bin/samara
cd "$work/scene"
printf '[scene]\nduration = 1.0\n[fluid]\npreset = "air"\n[[body]]\nname = "dart"\nshape = "samara:airplane"\ndensity = 800\n' \
  >scene.toml
"$samara" bodies --json | grep -q "\"folder\":\"$work/root/usr/share/samara/bodies\"" ||
  fail "the ready-baked bodies are not taken from the package"
"$samara" simulate scene.toml -o motion.h5
"$samara" export motion.h5 -o motion.glb
[ -s motion.glb ] || fail "nothing was exported"
dpkg-deb -f "$runtime" Recommends | grep -q 'python3-matplotlib' || fail "the runtime does not recommend matplotlib"
"$samara" plot motion.h5 -o motion.svg
(cd "$work/root/usr/share/samara/python/samara" && find . -name __pycache__) | grep -q . && fail "drawing left files in the package's folder"
PATH= "$samara" --help | /usr/bin/grep -q 'bake .*(not installed)' || fail "baking tools were found outside of the root"

# A program in C with what the package holds, and no other library.
cc -std=c99 -Wall "$source_folder/docs/examples/fall.c" -I"$work/root/usr/include" \
  -L"$(dirname "$(find "$work/root" -name libsamara.so)")" -lsamara -lm -o fall
LD_LIBRARY_PATH=$(dirname "$(find "$work/root" -name libsamara.so)") \
  ./fall "$work/root/usr/share/samara/bodies/airplane.body.h5" >poses || fail "the example in C does not run"
[ -s poses ] || fail "the example in C printed nothing"
python3 "$source_folder/docs/examples/fall.py" "$(find "$work/root" -name libsamara.so)" \
  "$work/root/usr/share/samara/bodies/airplane.body.h5" >poses || fail "the example in Python does not run"
[ "$(wc -l <poses)" = 25 ] || fail "the example in Python did not print 25 poses"
nm -D --defined-only --extern-only "$(find "$work/root" -name libsamara.so)" | awk '{ print $3 }' | grep -v '^samara_' |
  grep -q . && fail "libsamara.so shows more than the C interface"

# The Python module, where it was built.
module=$(find "$work/packages" -maxdepth 1 -name 'python3-samara_*.deb')
if [ -n "$module" ]; then
  dpkg-deb -f "$module" Depends | grep -q 'python3-numpy' || fail "the Python module does not depend on numpy"
  dpkg -x "$module" "$work/root"
  SAMARA_BODIES=$work/root/usr/share/samara/bodies PYTHONPATH=$work/root/usr/lib/python3/dist-packages /usr/bin/python3 -c '
import samara
motion = samara.simulate("scene.toml")
samara.plot.save(samara.plot.motion(motion), "again.svg")
print(samara.report.__file__, motion["dart"].measure()["descent_speed"])' >speed || fail "the Python module does not fly and draw"
  cmp -s motion.svg again.svg || fail "the module draws another picture than the program"
fi

# Both together: the tools are found beside samara, and their templates beside them.
dpkg -x "$baking" "$work/root"
"$samara" mesh "$work/root/usr/share/samara/meshes/sphere.geo" -o ball.body.h5
"$samara" bake ball.body.h5 -o baked.body.h5 --quality smoke --dry-run

# A shell that completes commands, options and their words.
completed() {
  bash -c "source '$work/root/usr/share/bash-completion/completions/samara'
    COMP_WORDS=($samara $1); COMP_CWORD=\$((\${#COMP_WORDS[@]} - 1)); _samara; echo \"\${COMPREPLY[*]}\""
}
[ "$(completed sim)" = simulate ] || fail "commands are not completed"
[ "$(completed 'simulate --ru')" = --runs ] || fail "options are not completed"
[ "$(completed 'bake --quality pre')" = preview ] || fail "words of options are not completed"
cd /
rm -rf "$work"
