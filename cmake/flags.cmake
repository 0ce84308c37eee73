# Compiler settings for all of breccia. The binary must run on any x86-64 machine, so no -march here: the kernels carry
# one object per instruction set and choose at run time. Contraction is off so that every device gives the same bits.
add_compile_definitions(_GNU_SOURCE)
add_compile_options(-fmacro-prefix-map=${CMAKE_SOURCE_DIR}/=) # __FILE__ names no folder of the build machine
add_compile_options(-ffp-contract=off -fno-math-errno -fvisibility=hidden -fno-strict-aliasing
                    -Wall -Wextra -Wshadow -Wundef -Wcast-qual -Wwrite-strings -Wformat=2
                    $<$<COMPILE_LANGUAGE:C>:-Wstrict-prototypes>
                    $<$<COMPILE_LANGUAGE:C>:-Wmissing-prototypes>)
if(CMAKE_C_COMPILER_ID STREQUAL "GNU")
    # gcc with an offload plug-in installed would otherwise compile every parallel loop a second time.
    add_compile_options($<$<COMPILE_LANGUAGE:C>:-foffload=disable>)
    add_link_options(-foffload=disable)
endif()
if(BRC_WERROR)
    add_compile_options(-Werror)
endif()
if(BRC_SANITIZE)
    add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer -g)
    add_link_options(-fsanitize=address,undefined)
endif()
if(BRC_FUZZ)
    if(NOT CMAKE_C_COMPILER_ID STREQUAL "Clang")
        message(FATAL_ERROR "BRC_FUZZ needs clang: configure with CC=clang-14 CXX=clang++-14")
    endif()
    # Everything is instrumented for coverage; only the fuzz programs link libFuzzer's main (tests/CMakeLists.txt).
    add_compile_options(-fsanitize=fuzzer-no-link,address -fno-omit-frame-pointer -g)
    add_link_options(-fsanitize=address)
endif()
add_link_options(-Wl,--as-needed)
