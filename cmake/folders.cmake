# brc_folder(<name> <folder> <libraries it stands on...>): the static library brc_<name> of all C (and C++) files in the
# folder and the folders inside it, but for main.c, the MPI of ranks and what host/device compiles in ways of its own. A folder without
# sources yet gives an empty interface target, so that the rest still builds.
function(brc_folder_sources out folder)
    file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${folder}/*.c ${CMAKE_SOURCE_DIR}/${folder}/*.cc)
    list(FILTER sources EXCLUDE REGEX "/main\\.c$|/ranks_mpi[a-z_]*\\.c$|/device/(instance|target)/")
    set(${out} ${sources} PARENT_SCOPE)
endfunction()

# A macro, so that what the folder's own rules set is seen by the folders above it.
macro(brc_folder name folder)
    brc_folder_sources(brc_sources ${folder})
    if(brc_sources)
        add_library(brc_${name} STATIC ${brc_sources})
        target_link_libraries(brc_${name} PUBLIC ${ARGN} m)
        if(EXISTS ${CMAKE_SOURCE_DIR}/${folder}/CMakeLists.txt)
            include(${CMAKE_SOURCE_DIR}/${folder}/CMakeLists.txt)
        endif()
    else()
        add_library(brc_${name} INTERFACE)
        target_link_libraries(brc_${name} INTERFACE ${ARGN} m)
    endif()
endmacro()
