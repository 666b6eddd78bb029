#!/usr/bin/env bash
# packaging/conda/build.sh   what the recipe beside it runs, at the root of the sources: builds and installs into $PREFIX.
# SP_DIR, PREFIX, PYTHON and CPU_COUNT are set by rattler-build and conda-build.
set -euo pipefail
cmake -S . -B build/conda -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX="$PREFIX" -DCMAKE_PREFIX_PATH="$PREFIX" \
  -DCMAKE_INSTALL_LIBDIR=lib -DBUILD_TESTING=OFF -DHERSEY_UNITY=ON -DHERSEY_PYTHON_PACKAGE=ON -DPython3_EXECUTABLE="$PYTHON"
cmake --build build/conda --target hersey hersey_python -j "${CPU_COUNT:-2}"
cmake --install build/conda --component program
install -d "$SP_DIR/hersey"
cp python/hersey/*.py python/hersey/*.pyi python/hersey/py.typed build/conda/python/hersey/_core*.so "$SP_DIR/hersey/"
