# The OpenMP target plug-in libbreccia_target.so: the kernels once more, compiled by clang as target code. It is a program
# of another compiler than the rest, so its objects are made by commands of their own. Left out, with a line, where clang
# or libomp's device library is missing.
set(BRC_TARGET_TRIPLE "x86_64-pc-linux-gnu" CACHE STRING "Target triple of the OpenMP target plug-in")
set(BRC_TARGET_ARCH "-march=x86-64-v3" CACHE STRING "Instruction set of the OpenMP target plug-in")
find_program(BRC_TARGET_CLANG NAMES clang-14 clang-15 clang-16 clang-17 clang-18 clang-19 clang)
mark_as_advanced(BRC_TARGET_CLANG)

set(brc_target_flags -std=gnu11 -O3 -fPIC -fopenmp -fopenmp-targets=${BRC_TARGET_TRIPLE} -ffp-contract=off -fno-math-errno
    -fvisibility=hidden -Wall -Wextra -Wno-unused-parameter -Wno-unused-function -Wno-psabi ${BRC_TARGET_ARCH})
set(brc_target_dir ${CMAKE_BINARY_DIR}/target)

# Can clang make target code here, and does it leave the host when run? Tried once per build folder.
if(BRC_TARGET_CLANG AND NOT DEFINED BRC_TARGET_WORKS)
    file(WRITE ${brc_target_dir}/probe.c
         "#include <omp.h>\nint main(void)\n{\n    int host = 1;\n#pragma omp target map(from : host)\n"
         "    host = omp_is_initial_device();\n    return host;\n}\n")
    # In two steps as below: an object needs llvm-objcopy, linking needs clang-offload-wrapper.
    execute_process(COMMAND ${BRC_TARGET_CLANG} ${brc_target_flags} -c ${brc_target_dir}/probe.c -o ${brc_target_dir}/probe.o
                    OUTPUT_QUIET ERROR_QUIET)
    execute_process(COMMAND ${BRC_TARGET_CLANG} ${brc_target_flags} ${brc_target_dir}/probe.o -o ${brc_target_dir}/probe
                    RESULT_VARIABLE brc_probe_built OUTPUT_QUIET ERROR_QUIET)
    set(brc_probe_ran 1)
    if(brc_probe_built EQUAL 0)
        execute_process(COMMAND ${brc_target_dir}/probe RESULT_VARIABLE brc_probe_ran OUTPUT_QUIET ERROR_QUIET)
    endif()
    if(brc_probe_ran EQUAL 0)
        set(BRC_TARGET_WORKS ON CACHE INTERNAL "clang compiles and runs OpenMP target regions here")
    else()
        set(BRC_TARGET_WORKS OFF CACHE INTERNAL "clang compiles and runs OpenMP target regions here")
    endif()
endif()
if(NOT BRC_TARGET_CLANG OR NOT BRC_TARGET_WORKS)
    message(STATUS "no OpenMP target plug-in: it needs clang with libomptarget (Debian packages clang-14 clang-tools-14 llvm-14 libomp-14-dev)")
    return()
endif()

set(brc_target_objects "")
set(brc_target_instances "")
foreach(precision RANGE ${BRC_LAST_PRECISION})
    list(GET brc_precisions ${precision} precision_name)
    list(GET brc_lanes_target ${precision} lanes)
    foreach(many RANGE 1)
        set(name brc_kernels_target_${precision_name}_${many})
        set(object ${brc_target_dir}/${name}.o)
        # In two steps: clang names a target region by file, function and line, so that instances compiled from one file
        # would share names, and one would run in place of another. Each gets a file of its own.
        add_custom_command(OUTPUT ${object}
            COMMAND ${BRC_TARGET_CLANG} -std=gnu11 -fopenmp ${BRC_TARGET_ARCH} -DBRC_TARGET -DBRC_INSTANCE=${name} -DBRC_LEVEL="target"
                    -DBRC_PRECISION=${precision} -DBRC_LANES=${lanes} -DBRC_SLICE=${lanes} -DBRC_MANY_MATERIALS=${many}
                    -I${brc_device_generated} -E -P ${brc_device_dir}/instance/kernels_instance.c -o ${brc_target_dir}/${name}.c
            COMMAND ${CMAKE_C_COMPILER_LAUNCHER} ${BRC_TARGET_CLANG} ${brc_target_flags} -c ${brc_target_dir}/${name}.c -o ${object}
            DEPENDS ${brc_device_dir}/instance/kernels_instance.c ${brc_device_dir}/kernel_instance.h ${brc_device_generated}/kernel_list.h ${brc_kernel_texts}
            COMMENT "Building target kernels ${precision_name}, many materials ${many}" VERBATIM)
        list(APPEND brc_target_objects ${object})
        string(APPEND brc_target_instances " X(${name})")
    endforeach()
endforeach()
add_custom_command(OUTPUT ${brc_target_dir}/target_plugin.o
    COMMAND ${BRC_TARGET_CLANG} ${brc_target_flags} "-DBRC_TARGET_INSTANCES(X)=${brc_target_instances}"
            -DBRC_TARGET_ARCHITECTURE="${BRC_TARGET_TRIPLE}" -DBRC_TARGET_FALLS_BACK=0
            -I${brc_device_generated} -c ${brc_device_dir}/target/target_plugin.c -o ${brc_target_dir}/target_plugin.o
    DEPENDS ${brc_device_dir}/target/target_plugin.c ${brc_device_dir}/target_plugin.h ${brc_device_dir}/kernel_instance.h
            ${brc_device_generated}/kernel_hash.h
    COMMENT "Building the target plug-in" VERBATIM)
add_custom_command(OUTPUT ${CMAKE_BINARY_DIR}/libbreccia_target.so
    COMMAND ${BRC_TARGET_CLANG} ${brc_target_flags} -shared ${brc_target_objects} ${brc_target_dir}/target_plugin.o
            -o ${CMAKE_BINARY_DIR}/libbreccia_target.so
    DEPENDS ${brc_target_objects} ${brc_target_dir}/target_plugin.o
    COMMENT "Linking libbreccia_target.so" VERBATIM)
add_custom_target(brc_target_plugin ALL DEPENDS ${CMAKE_BINARY_DIR}/libbreccia_target.so)
install(FILES ${CMAKE_BINARY_DIR}/libbreccia_target.so DESTINATION lib/breccia)
