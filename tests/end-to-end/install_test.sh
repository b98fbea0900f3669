#!/usr/bin/env bash
# The runtime builds and installs alone, without gmsh and OpenFOAM, and another project finds it.
# Usage: install_test.sh SOURCE_FOLDER WORK_FOLDER
set -euo pipefail
source_folder=$1
work=$2
rm -rf "$work"
cmake -S "$source_folder" -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=-O0 \
  -DSAMARA_BAKING=OFF -DSAMARA_TESTS=OFF -DSAMARA_PAGE=OFF
cmake --build "$work/build"
for part in core runtime; do cmake --install "$work/build" --prefix "$work/installed" --component $part; done  # as the tutorials say
if ldd "$work/installed/bin/samara" | grep -iE 'gmsh|openfoam'; then
  echo "the runtime alone links gmsh or OpenFOAM" >&2
  exit 1
fi
"$work/installed/bin/samara" --help | grep -q 'mesh .*(not installed)'
if "$work/installed/bin/samara" export "$source_folder/docs/studies/falls/sheet.h5" -o "$work/sheet.html" 2> "$work/fault"; then
  echo "a page was written without the page" >&2
  exit 1
fi
grep -q 'built without the page' "$work/fault"
cmake -S "$source_folder/tests/end-to-end/consumer" -B "$work/consumer" -G Ninja -DCMAKE_PREFIX_PATH="$work/installed" \
  -DEXAMPLES="$source_folder/docs/examples"
cmake --build "$work/consumer"
"$work/consumer/fall-cpp" "$source_folder/runtime/bodies/leaf.body.h5" | grep -q '3000 steps'
if [ "$(find "$work/installed/include" -name '*.hpp' | wc -l)" -gt 50 ] || [ -e "$work/installed/include/internal" ]; then
  echo "more headers are installed than are public" >&2
  exit 1
fi
if "$work/consumer/fall" "$work/missing.body.h5" 2> "$work/fault"; then
  echo "the example flew a body that is not there" >&2
  exit 1
fi
grep -q '^fall: .*missing.body.h5' "$work/fault"
# A project in C alone finds the C interface without any other package, and says what the C++ library lacks.
without=()
for package in Eigen3 HDF5 TinyGLTF fmt nlohmann_json tomlplusplus; do without+=("-DCMAKE_DISABLE_FIND_PACKAGE_$package=ON"); done
for parts in "" "COMPONENTS;c" "COMPONENTS;core_c"; do
  cmake -S "$source_folder/tests/end-to-end/consumer-c" -B "$work/consumer-c" -G Ninja "${without[@]}" \
    -DCMAKE_PREFIX_PATH="$work/installed" -DEXAMPLES="$source_folder/docs/examples" -DPARTS="$parts" \
    -DLIBRARY="$([ "$parts" = "COMPONENTS;core_c" ] && echo core_c || echo c)"
  cmake --build "$work/consumer-c"
  "$work/consumer-c/fall" "$source_folder/runtime/bodies/leaf.body.h5" | grep -q '^1.0000 s  body 2'
  rm -rf "$work/consumer-c"
done
if cmake -S "$source_folder/tests/end-to-end/consumer" -B "$work/consumer" -DCMAKE_DISABLE_FIND_PACKAGE_fmt=ON --fresh \
  -DCMAKE_PREFIX_PATH="$work/installed" -DEXAMPLES="$source_folder/docs/examples" >"$work/said" 2>&1; then
  echo "the C++ library was found without fmt" >&2
  exit 1
fi
tr -s ' \n' ' ' <"$work/said" | grep -q 'samara::runtime needs fmt'
# The core builds and installs alone, without TOML, JSON and glTF, and flies a body from C.
without=()
for package in TinyGLTF nlohmann_json tomlplusplus; do without+=("-DCMAKE_DISABLE_FIND_PACKAGE_$package=ON"); done
cmake -S "$source_folder" -B "$work/core-build" -G Ninja -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=-O0 \
  -DSAMARA_CORE_ONLY=ON "${without[@]}"
cmake --build "$work/core-build"
cmake --install "$work/core-build" --prefix "$work/core"
if ldd "$(find "$work/core" -name libsamara-core.so)" | grep -iE 'toml|json|gltf'; then
  echo "the core links TOML, JSON or glTF" >&2
  exit 1
fi
if grep -rlE 'toml|nlohmann|tiny_gltf' "$work/core/include" "$source_folder/runtime/core" --include='*.hpp' --include='*.cpp' --include='*.h' |
  xargs -r grep -lE '#include <(toml|nlohmann|tiny_gltf)'; then
  echo "the core includes TOML, JSON or glTF" >&2
  exit 1
fi
cmake -S "$source_folder/tests/end-to-end/consumer-c" -B "$work/consumer-c" -G Ninja -DCMAKE_PREFIX_PATH="$work/core" \
  -DEXAMPLES="$source_folder/docs/examples" -DPARTS="COMPONENTS;core_c" -DLIBRARY=core_c
cmake --build "$work/consumer-c"
"$work/consumer-c/fall" "$source_folder/runtime/bodies/leaf.body.h5" | grep -q '^1.0000 s  body 2'
# Programs in C, by the lines of the documentation, run from elsewhere.
library=$(dirname "$(find "$work/installed" -name samara.pc)")
PKG_CONFIG_PATH=$library pkg-config --modversion samara | grep -q '^[0-9]'
ln -s "$source_folder/docs" "$work/docs"
ln -s installed "$work/DIR"
ln -s installed "$work/samara"
cp "$source_folder/docs/examples/fall.c" "$work"
grep -hE '^cc .*DIR/' "$source_folder/docs/reference/c.md" "$source_folder/docs/tutorials/engine.md" >"$work/lines"
[ "$(wc -l <"$work/lines")" = 2 ]
while read -r line; do
  rm -f "$work/fall"
  (cd "$work" && library=$work/DIR/lib bash -c "$line")
  (cd / && env -u LD_LIBRARY_PATH "$work/fall" "$source_folder/runtime/bodies/leaf.body.h5") | grep -q '^1.0000 s  body 2'
done <"$work/lines"
# The wheel, by the same build folder, where its backend is installed (./dev test does so).
if /usr/bin/python3 -c 'import scikit_build_core, pip' 2>/dev/null; then
  settings=()
  for setting in build-dir="$work/build" cmake.build-type=Debug cmake.define.CMAKE_CXX_FLAGS_DEBUG=-O0 cmake.define.SAMARA_PAGE=OFF; do
    settings+=(--config-settings "$setting")
  done
  /usr/bin/python3 -m pip wheel "$source_folder" --quiet --no-build-isolation --no-deps --wheel-dir "$work/wheel" "${settings[@]}"
  /usr/bin/python3 -m pip install --quiet --no-deps --target "$work/site" "$work"/wheel/samara-*.whl
  cd "$work"
  PYTHONPATH=$work/site /usr/bin/python3 -c '
import samara
leaf = {"name": "leaf", "shape": "samara:leaf"}
motion = samara.simulate({"scene": {"duration": 1}, "fluid": {"preset": "air"}, "body": [leaf]})
print(samara.__file__, motion["leaf"].measure()["descent_speed"])' >flown
  grep -q "^$work/site/samara" flown
else
  echo "the wheel was not tried: python3-scikit-build-core is missing"
fi
rm -rf "$work"
