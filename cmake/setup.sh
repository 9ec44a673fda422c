# shellcheck shell=bash
# SPDX-License-Identifier: MIT
# Shared by samples/run, tests/run and .ci/run: what must be installed, and how the build is configured. Sourced with the
# repository root in `root`.

# Debian 12 names. Everything is used: see the find_package lines of the CMakeLists.txt beside each folder.
pelagePackages=(
    ninja-build pkgconf doxygen
    libvulkan-dev libvulkan-volk-dev mesa-vulkan-drivers vulkan-validationlayers
    glslang-tools spirv-tools libspirv-cross-c-shared-dev
    libglfw3-dev libglm-dev libtinygltf-dev nlohmann-json3-dev rapidjson-dev
    libopencolorio-dev libopenexr-dev libstb-dev libcli11-dev libexpected-dev libgtest-dev libbenchmark-dev libboost-dev
)

# Prints the packages of the list that are not installed.
missingPackages() {
    local package
    for package in "${pelagePackages[@]}"; do
        if [[ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)" != installed ]]; then
            echo "$package"
        fi
    done
}

# Installs what is missing. PELAGE_SKIP_SETUP=1 leaves the machine alone, for systems without apt-get.
installPackages() {
    if [[ "${PELAGE_SKIP_SETUP:-0}" == 1 ]]; then return; fi
    if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
        echo "There is no apt-get here. Install what these Debian 12 packages hold, then run again with" \
            "PELAGE_SKIP_SETUP=1: cmake g++ ${pelagePackages[*]}" >&2
        exit 2
    fi
    local missing=()
    mapfile -t missing < <(missingPackages)
    if ((${#missing[@]} == 0)); then return; fi
    local asRoot=()
    if [[ "$(id -u)" != 0 ]]; then
        if ! command -v sudo >/dev/null; then
            echo "These packages are missing, and only root may install them: apt-get install ${missing[*]}" >&2
            exit 2
        fi
        asRoot=(sudo)
    fi
    echo "Installing ${missing[*]}"
    "${asRoot[@]}" apt-get update -qq
    "${asRoot[@]}" env DEBIAN_FRONTEND=noninteractive \
        apt-get install -qq -y --no-install-recommends "${missing[@]}" >/dev/null
}

# configure SOURCE BUILD [cmake arguments]: a Release build with Ninja, and ccache where there is one.
configure() {
    local source="$1" directory="$2"
    shift 2
    local launcher=()
    if command -v ccache >/dev/null; then launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache); fi
    cmake -S "$source" -B "$directory" -G Ninja -DCMAKE_BUILD_TYPE=Release "${launcher[@]}" "$@" >/dev/null
}

# lavapipe compiles a shader at its first draw, some of them for seconds: keep the results between runs.
useShaderCache() {
    export MESA_SHADER_CACHE_DIR="${MESA_SHADER_CACHE_DIR:-${root:?}/build/shader-cache}"
    export PELAGE_CACHE="${PELAGE_CACHE:-${root:?}/build/pipeline-cache}"
    mkdir -p "$MESA_SHADER_CACHE_DIR"
}
