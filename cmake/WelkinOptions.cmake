# One interface target carries the language level, warnings and floating-point rules of every Welkin target.
add_library(welkin_options INTERFACE)
target_compile_features(welkin_options INTERFACE cxx_std_20)
# -ffp-contract=off: the law must give the same numbers as GLSL, which does not fuse.
target_compile_options(welkin_options INTERFACE -Wall -Wextra -Wshadow -ffp-contract=off -fno-math-errno)
# Baseline, SSE4, AVX2 and AVX-512 (and NEON) are enough; each further target lengthens the build. Under sanitizers, whose
# checks take most of it, one wide target beside the baseline is enough.
set(WELKIN_LEFT_OUT "HWY_SSSE3|HWY_AVX3_DL|HWY_SVE|HWY_SVE2|HWY_SVE_256|HWY_SVE2_128|HWY_RVV")
if(WELKIN_SANITIZE)
  string(APPEND WELKIN_LEFT_OUT "|HWY_SSE4|HWY_AVX3")
endif()
target_compile_definitions(welkin_options INTERFACE "HWY_DISABLED_TARGETS=(${WELKIN_LEFT_OUT})")
if(WELKIN_WERROR)
  target_compile_options(welkin_options INTERFACE -Werror)
endif()
if(WELKIN_SANITIZE)
  target_compile_options(welkin_options INTERFACE -fsanitize=${WELKIN_SANITIZE} -fno-sanitize-recover=all
                                                  -fno-omit-frame-pointer -g1)
  # GCC sees uninitialised values where a sanitizer has taken its inlining away, in <regex> for one (GCC bug 105562).
  target_compile_options(welkin_options INTERFACE -Wno-maybe-uninitialized -Wno-uninitialized)
  # No sanitizer sees values that nobody has set; filled with a pattern they are not zero by chance.
  target_compile_options(welkin_options INTERFACE -ftrivial-auto-var-init=pattern)
  target_link_options(welkin_options INTERFACE -fsanitize=${WELKIN_SANITIZE})
  # Kernels take most of these minutes; the address sanitizer sees where they read, their arithmetic is that of the law,
  # which everything else calls with the checks.
  if(WELKIN_SANITIZE MATCHES "undefined")
    file(GLOB KERNELS ${PROJECT_SOURCE_DIR}/welkin/*/*kernel*.cpp)
    set_source_files_properties(${KERNELS} PROPERTIES COMPILE_OPTIONS "-fno-sanitize=undefined")
  endif()
endif()

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()
find_program(CCACHE ccache)
if(CCACHE AND PROJECT_IS_TOP_LEVEL)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
endif()
if(PROJECT_IS_TOP_LEVEL)
  set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
endif()

# With CMAKE_UNITY_BUILD several sources are compiled as one, since two thirds of the time goes into reading headers. The
# kernels, which include themselves once for every instruction set, and the law's tables stand alone.
function(welkin_stand_alone)
  foreach(SOURCE IN LISTS ARGN)
    file(STRINGS ${SOURCE} FOUND REGEX "foreach_target|law_begin|X11/" LIMIT_COUNT 1)
    if(FOUND)
      set_source_files_properties(${SOURCE} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    endif()
  endforeach()
endfunction()
if(CMAKE_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(welkin_options INTERFACE -Wno-subobject-linkage)  # the files are included, but once
endif()
