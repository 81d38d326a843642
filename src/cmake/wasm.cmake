# A toolchain for WebAssembly of Debian's packages alone: the newest clang that is there, with libc++
# and wasi-libc. ./run web installs them.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR wasm32)
set(LANTERN_WEB ON)
set(CMAKE_SYSTEM_PREFIX_PATH /usr)
foreach(version 24 23 22 21 20)
  find_program(LANTERN_CLANG clang++-${version})
  if(LANTERN_CLANG)
    break()
  endif()
endforeach()
if(NOT LANTERN_CLANG)
  message(FATAL_ERROR "No clang++ of version 20 or newer for WebAssembly: ./run web installs it")
endif()
set(CMAKE_CXX_COMPILER ${LANTERN_CLANG})
set(CMAKE_CXX_COMPILER_TARGET wasm32-wasi)
string(REPLACE "clang++" "wasm-ld" linker ${LANTERN_CLANG})
string(REGEX MATCH "[0-9]+$" version ${LANTERN_CLANG})
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(include /usr/include/wasm32-wasi)
set(CMAKE_CXX_FLAGS_INIT
  "-fwasm-exceptions -nostdlibinc -isystem ${include}/c++/v1 -isystem ${include}")
set(CMAKE_CXX_LINK_EXECUTABLE "${linker} --no-entry --gc-sections --strip-all --error-limit=0 -z stack-size=8388608 \
--max-memory=1073741824 /usr/lib/wasm32-wasi/crt1-reactor.o <OBJECTS> <LINK_LIBRARIES> \
-L/usr/lib/wasm32-wasi -lc++ -lc++abi -lc \
/usr/lib/llvm-${version}/lib/clang/${version}/lib/wasi/libclang_rt.builtins-wasm32.a -o <TARGET>")
