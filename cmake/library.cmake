# breccia as an installed library: one libbreccia.a of all folders, the headers, and breccia.pc for pkg-config. The headers
# keep their folders under include/breccia/, so that their relative includes hold; include/breccia.h forwards to them.
set(brc_objects "")
foreach(name base preprocess device scene solver output bench commands)
    get_target_property(type brc_${name} TYPE)
    if(type STREQUAL "STATIC_LIBRARY")
        list(APPEND brc_objects $<TARGET_OBJECTS:brc_${name}>)
    endif()
endforeach()
foreach(name IN LISTS brc_instance_names) # the kernels, compiled once per instruction set by host/device
    list(APPEND brc_objects $<TARGET_OBJECTS:${name}>)
endforeach()
add_library(brc_library STATIC ${brc_objects})
set_target_properties(brc_library PROPERTIES OUTPUT_NAME breccia LINKER_LANGUAGE C)

set(libraries "")
foreach(name yaml opencl voro ffi cairo lapacke cminpack hdf5)
    get_target_property(needed brc_${name} INTERFACE_LINK_LIBRARIES)
    list(APPEND libraries ${needed})
endforeach()
list(REMOVE_DUPLICATES libraries)
list(JOIN libraries " " libraries)
get_target_property(threads OpenMP::OpenMP_C INTERFACE_COMPILE_OPTIONS)
string(REGEX MATCH "-fopenmp[=a-z]*" threads "${threads}")
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/generated/breccia.pc CONTENT [[
prefix=${pcfiledir}/../..
Name: breccia
Description: @PROJECT_DESCRIPTION@
Version: @PROJECT_VERSION@
Cflags: -I${prefix}/include
Libs: -L${prefix}/lib -lbreccia @libraries@ @threads@ -lstdc++ -lm -ldl
]] @ONLY)
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/generated/breccia.h
     CONTENT "#include \"breccia/host/include/breccia.h\"\n")

install(TARGETS brc_library ARCHIVE DESTINATION lib)
install(FILES ${CMAKE_BINARY_DIR}/generated/breccia.pc DESTINATION lib/pkgconfig)
install(FILES ${CMAKE_BINARY_DIR}/generated/breccia.h DESTINATION include)
foreach(folder host preprocess)
    install(DIRECTORY ${folder} DESTINATION include/breccia FILES_MATCHING PATTERN "*.h" PATTERN "*_internal.h" EXCLUDE
            PATTERN "instance" EXCLUDE PATTERN "target" EXCLUDE)
endforeach()
