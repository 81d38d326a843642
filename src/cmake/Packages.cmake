# Every package comes from Debian; the script `run` installs them. None is downloaded.
find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)
find_package(fmt REQUIRED)
find_package(glm REQUIRED)
find_package(tomlplusplus REQUIRED)
find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)
pkg_check_modules(hwy REQUIRED IMPORTED_TARGET libhwy)
pkg_check_modules(deflate REQUIRED IMPORTED_TARGET libdeflate)
find_path(LANTERN_STB_DIR stb_truetype.h PATH_SUFFIXES stb REQUIRED)
find_path(LANTERN_FONT_DIR Inter-Regular.otf PATHS /usr/share/fonts/opentype/inter REQUIRED)
find_path(LANTERN_GL_DIR GL/glcorearb.h REQUIRED)
# Only measured beside, and only where they are installed; the script `run` does not install them.
pkg_check_modules(bullet QUIET bullet-float64)
pkg_check_modules(box2d QUIET box2d)
pkg_check_modules(ode QUIET ode)
find_library(LANTERN_MUJOCO mujoco)  # its CMake file asks for a folder that need not be there
find_path(LANTERN_MUJOCO_DIR mujoco/mujoco.h)
