# The OpenMP target plug-in for NVIDIA cards, libbreccia_target_nvptx.so, and beside it a library for each precision, with many materials or one, compiled
# by gcc in the layout of a GPU where gcc has an offload compiler (Debian: gcc-12-offload-nvptx). Minutes of one core, so it is no part of `all`:
# cmake --build FOLDER --target brc_target_nvptx
set(BRC_NVPTX_ARCH "sm_80" CACHE STRING "Oldest card the OpenMP target plug-in for NVIDIA cards runs on")
find_program(BRC_NVPTX_GCC NAMES gcc-12 gcc-13 gcc-14 gcc)
mark_as_advanced(BRC_NVPTX_GCC BRC_NVPTX_ARCH)
set(brc_nvptx_dir ${CMAKE_BINARY_DIR}/target_nvptx)
set(brc_nvptx_flags -std=gnu11 -O2 -fPIC -fopenmp -foffload=nvptx-none -foffload-options=nvptx-none=-march=${BRC_NVPTX_ARCH} -foffload-options=-lm
    -ffp-contract=off -fno-math-errno -fvisibility=hidden -Wall -Wextra -Wno-unused-parameter -Wno-unused-function -Wno-unused-variable -Wno-psabi)

if(BRC_NVPTX_GCC AND NOT DEFINED BRC_NVPTX_WORKS)
    file(WRITE ${brc_nvptx_dir}/probe.c "int main(void)\n{\n    int x = 1;\n#pragma omp target map(tofrom : x)\n    x = 0;\n    return x;\n}\n")
    execute_process(COMMAND ${BRC_NVPTX_GCC} ${brc_nvptx_flags} ${brc_nvptx_dir}/probe.c -o ${brc_nvptx_dir}/probe
                    RESULT_VARIABLE brc_probe_built OUTPUT_QUIET ERROR_QUIET)
    if(brc_probe_built EQUAL 0)
        set(BRC_NVPTX_WORKS ON CACHE INTERNAL "gcc compiles OpenMP target regions for NVIDIA cards here")
    endif() # else asked again next time: it may have been installed
endif()
if(NOT BRC_NVPTX_GCC OR NOT BRC_NVPTX_WORKS)
    return()
endif()

set(brc_nvptx_libraries ${CMAKE_BINARY_DIR}/libbreccia_target_nvptx.so)
foreach(precision RANGE 2)
    list(GET brc_precisions ${precision} precision_name)
    foreach(many RANGE 1)
        set(library ${CMAKE_BINARY_DIR}/libbreccia_target_nvptx_${precision_name}_${many}.so)
        add_custom_command(OUTPUT ${library}
            COMMAND ${BRC_NVPTX_GCC} ${brc_nvptx_flags} -DBRC_TARGET -DBRC_INSTANCE=brc_kernels_nvptx_${precision_name}_${many}
                    -DBRC_LEVEL="nvptx" -DBRC_PRECISION=${precision} -DBRC_LANES=1 -DBRC_SLICE=32 -DBRC_MANY_MATERIALS=${many}
                    -I${brc_device_generated} -shared ${brc_device_dir}/instance/kernels_instance.c ${brc_device_dir}/target/target_instance.c -o ${library}
            DEPENDS ${brc_device_dir}/instance/kernels_instance.c ${brc_device_dir}/target/target_instance.c ${brc_device_dir}/target_plugin.h ${brc_device_dir}/kernel_instance.h
                    ${brc_device_generated}/kernel_list.h ${brc_device_generated}/kernel_hash.h ${brc_kernel_texts}
            COMMENT "Building target kernels for ${BRC_NVPTX_ARCH}, ${precision_name}, many materials ${many}" VERBATIM)
        list(APPEND brc_nvptx_libraries ${library})
    endforeach()
endforeach()
add_custom_command(OUTPUT ${CMAKE_BINARY_DIR}/libbreccia_target_nvptx.so
    COMMAND ${BRC_NVPTX_GCC} ${brc_nvptx_flags} -DBRC_TARGET_APART="libbreccia_target_nvptx" -DBRC_TARGET_ARCHITECTURE="nvptx, ${BRC_NVPTX_ARCH}"
            -DBRC_TARGET_FALLS_BACK=1 -I${brc_device_generated} -shared ${brc_device_dir}/target/target_plugin.c -ldl
            -o ${CMAKE_BINARY_DIR}/libbreccia_target_nvptx.so
    DEPENDS ${brc_device_dir}/target/target_plugin.c ${brc_device_dir}/target_plugin.h ${brc_device_generated}/kernel_hash.h
    COMMENT "Linking libbreccia_target_nvptx.so" VERBATIM)
add_custom_target(brc_target_nvptx DEPENDS ${brc_nvptx_libraries})
