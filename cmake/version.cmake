# Version and commit. Included: defines brc_generate_version(<target>), which gives host/base/version.c its generated
# header at every build. As a script (cmake -P): writes that header, touching it only when the commit changed.
if(CMAKE_SCRIPT_MODE_FILE)
    cmake_minimum_required(VERSION 3.25)
    execute_process(COMMAND git -C ${SOURCE} rev-parse --show-toplevel OUTPUT_VARIABLE top
                    OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
    file(REAL_PATH "${SOURCE}" source)
    set(commit "unknown")
    if(NOT failed AND top STREQUAL source) # an unpacked archive inside somebody else's repository has no commit
        execute_process(COMMAND git -C ${SOURCE} rev-parse HEAD OUTPUT_VARIABLE commit
                        OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
        if(failed)
            set(commit "unknown")
        else()
            execute_process(COMMAND git -C ${SOURCE} status --porcelain --untracked-files=no OUTPUT_VARIABLE changed
                            OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
            if(changed)
                string(APPEND commit "-changed")
            endif()
        endif()
    endif()
    file(CONFIGURE OUTPUT ${HEADER} CONTENT
         "#define BRC_GENERATED_VERSION \"@VERSION@\"\n#define BRC_GENERATED_COMMIT \"@commit@\"\n" @ONLY)
    return()
endif()

set(BRC_VERSION_SCRIPT ${CMAKE_CURRENT_LIST_FILE})
function(brc_generate_version target)
    get_target_property(type ${target} TYPE)
    if(type STREQUAL "INTERFACE_LIBRARY")
        return()
    endif()
    set(header ${CMAKE_BINARY_DIR}/generated/version_generated.h)
    add_custom_target(brc_version_header
        COMMAND ${CMAKE_COMMAND} -DSOURCE=${CMAKE_SOURCE_DIR} -DVERSION=${PROJECT_VERSION} -DHEADER=${header}
                -P ${BRC_VERSION_SCRIPT}
        BYPRODUCTS ${header} VERBATIM)
    add_dependencies(${target} brc_version_header)
    target_include_directories(${target} PRIVATE ${CMAKE_BINARY_DIR}/generated)
endfunction()
