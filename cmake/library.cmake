# breccia as an installed library: libbreccia.so of all folders, of which only what include/breccia.h declares is seen from outside, breccia.pc for pkg-config
# and breccia-config.cmake for find_package. The soname is the interface number of the header.
file(STRINGS ${CMAKE_SOURCE_DIR}/host/include/breccia.h brc_interface REGEX "^#define BRECCIA_INTERFACE [0-9]+$")
string(REGEX REPLACE "^#define BRECCIA_INTERFACE " "" brc_interface "${brc_interface}")
set(brc_objects "")
foreach(name base preprocess device scene solver output bench commands library)
    get_target_property(type brc_${name} TYPE)
    if(type STREQUAL "STATIC_LIBRARY")
        list(APPEND brc_objects $<TARGET_OBJECTS:brc_${name}>)
    endif()
endforeach()
foreach(name IN LISTS brc_instance_names) # the kernels, compiled once per instruction set by host/device
    list(APPEND brc_objects $<TARGET_OBJECTS:${name}>)
endforeach()
add_library(brc_shared SHARED ${brc_objects})
target_link_libraries(brc_shared PRIVATE brc_yaml brc_opencl brc_voro brc_ffi brc_cairo brc_zlib brc_deflate brc_lapacke brc_cminpack brc_hdf5 OpenMP::OpenMP_C
                      ${CMAKE_DL_LIBS} m)
target_link_options(brc_shared PRIVATE -Wl,--version-script=${CMAKE_SOURCE_DIR}/cmake/breccia.map)
target_include_directories(brc_shared INTERFACE $<INSTALL_INTERFACE:include>)
set_target_properties(brc_shared PROPERTIES OUTPUT_NAME breccia EXPORT_NAME breccia LINKER_LANGUAGE CXX VERSION ${brc_interface}.${PROJECT_VERSION}
                      SOVERSION ${brc_interface} LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib LINK_DEPENDS ${CMAKE_SOURCE_DIR}/cmake/breccia.map)

file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/generated/breccia.pc CONTENT [[
prefix=${pcfiledir}/../..
Name: breccia
Description: @PROJECT_DESCRIPTION@
Version: @PROJECT_VERSION@
Cflags: -I${prefix}/include
Libs: -L${prefix}/lib -lbreccia
]] @ONLY)
include(CMakePackageConfigHelpers)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/generated/breccia-config-version.cmake COMPATIBILITY SameMinorVersion)

install(TARGETS brc_shared EXPORT breccia LIBRARY DESTINATION lib)
install(EXPORT breccia NAMESPACE breccia:: FILE breccia-config.cmake DESTINATION lib/cmake/breccia)
install(FILES ${CMAKE_BINARY_DIR}/generated/breccia-config-version.cmake DESTINATION lib/cmake/breccia)
install(FILES ${CMAKE_BINARY_DIR}/generated/breccia.pc DESTINATION lib/pkgconfig)
install(FILES ${CMAKE_SOURCE_DIR}/host/include/breccia.h DESTINATION include)
