# breccia-mpi: the same objects as the program, with the ranks of MPI in place of one rank (host/base/ranks.h). The linker takes what
# it needs from libbrc_base.a last, and then needs no ranks_one.c.
if(MPI_C_FOUND)
    add_library(brc_ranks_mpi OBJECT host/base/ranks_mpi.c host/base/ranks_mpi_calls.c host/base/ranks_mpi_wait.c)
    target_link_libraries(brc_ranks_mpi PUBLIC MPI::MPI_C)
    add_executable(breccia-mpi host/commands/main.c)
    target_link_libraries(breccia-mpi PRIVATE brc_ranks_mpi brc_commands)
    if(BRC_MPI)
        install(TARGETS breccia-mpi RUNTIME DESTINATION bin)
    endif()
endif()
