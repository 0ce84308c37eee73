# A package of what `cmake --install` puts in place: `cpack -G DEB` in the build folder. What it depends on is asked of
# the built files by dpkg-shlibdeps; drivers of other devices and gnuplot are recommended.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME breccia)
set(CPACK_PACKAGE_VENDOR breccia)
# Who builds a package answers for it: the person git knows, or who is named here.
foreach(part name email)
    execute_process(COMMAND git config user.${part} WORKING_DIRECTORY ${CMAKE_SOURCE_DIR} OUTPUT_VARIABLE brc_packager_${part}
                    OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endforeach()
if(brc_packager_name AND brc_packager_email)
    set(brc_packager "${brc_packager_name} <${brc_packager_email}>")
else()
    set(brc_packager "unnamed builder <root@localhost>")
endif()
set(BRC_PACKAGER "${brc_packager}" CACHE STRING "maintainer of the Debian package: Name <address>")
set(CPACK_PACKAGE_CONTACT "${BRC_PACKAGER}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGE_DESCRIPTION "Elements are Voronoi cells or spheres; the forces of their bonds derive from one energy of the
material's own E, nu and density, without calibration. Program, C library with header, examples and documentation.")
set(CPACK_RESOURCE_FILE_LICENSE ${CMAKE_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ
                                                WORLD_EXECUTE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "gnuplot-nox, pocl-opencl-icd")
if(TARGET brc_target_plugin) # Debian has libomptarget.so in the package for developers alone
    string(REGEX MATCH "[0-9]+$" brc_clang_version "${BRC_TARGET_CLANG}")
    set(CPACK_DEBIAN_PACKAGE_SUGGESTS "libomp-${brc_clang_version}-dev")
endif()
include(CPack)
