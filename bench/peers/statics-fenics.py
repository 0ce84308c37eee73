"""The bodies of `breccia bench statics` by finite elements: trilinear hexahedra of FEniCSx (dolfinx), as many nodes as
breccia has cells, conjugate gradients of PETSc with its algebraic multigrid (GAMG, the six rigid motions given).
usage: statics-fenics.py cantilever|cube NODES POISSON TOLERANCE. Prints the lines `breccia-peer ...` that breccia reads."""
import resource
import sys
import time

import numpy
import dolfinx
import ufl
from dolfinx import fem, la, mesh
from mpi4py import MPI
from petsc4py import PETSc

YOUNG = 20e9  # Pa
PULL = 1e-6  # m, of the cube
TRACTION = 1e3  # Pa, on the end of the cantilever


def rigid_motions(space):
    """Orthonormal basis of the six rigid motions: the near null space of the stiffness."""
    index_map, block = space.dofmap.index_map, space.dofmap.index_map_bs
    basis = [la.create_petsc_vector(index_map, block) for _ in range(6)]
    x = space.tabulate_dof_coordinates()[:, :3]
    for k, vector in enumerate(basis):
        with vector.localForm() as local:
            values = numpy.zeros((local.getSize() // 3, 3))
            if k < 3:
                values[:, k] = 1
            else:
                a, b = (k - 2) % 3, (k - 1) % 3
                values[: len(x), a], values[: len(x), b] = -x[:, b], x[:, a]
            local.array[:] = values.ravel()
    dolfinx.la.orthonormalize(basis)
    return PETSc.NullSpace().create(vectors=basis)


def held(space, facets, value, component=None):
    """Displacement of a wall, whole or one component of it."""
    domain = space.mesh
    if component is None:
        dofs = fem.locate_dofs_topological(space, domain.topology.dim - 1, facets)
        return fem.dirichletbc(numpy.full(3, value, dtype=PETSc.ScalarType), dofs, space)
    part = space.sub(component)
    dofs = fem.locate_dofs_topological(part, domain.topology.dim - 1, facets)
    return fem.dirichletbc(PETSc.ScalarType(value), dofs, part)


def main():
    body, nodes, poisson, tolerance = sys.argv[1], float(sys.argv[2]), float(sys.argv[3]), float(sys.argv[4])
    bends = body == "cantilever"
    across = max(2, round((nodes / (10 if bends else 1)) ** (1 / 3)))
    size = (1.0, 0.1, 0.1) if bends else (1.0, 1.0, 1.0)
    cells = (10 * across - 1 if bends else across - 1, across - 1, across - 1)
    start = time.process_time()
    domain = mesh.create_box(MPI.COMM_WORLD, [(0, 0, 0), size], cells, mesh.CellType.hexahedron)
    space = fem.VectorFunctionSpace(domain, ("Lagrange", 1))
    u, v = ufl.TrialFunction(space), ufl.TestFunction(space)
    shear, lame = YOUNG / 2 / (1 + poisson), YOUNG * poisson / (1 + poisson) / (1 - 2 * poisson)

    def stress(w):
        return 2 * shear * ufl.sym(ufl.grad(w)) + lame * ufl.div(w) * ufl.Identity(3)

    def wall(axis, at):
        return mesh.locate_entities_boundary(domain, 2, lambda x: numpy.isclose(x[axis], at))

    end = mesh.meshtags(domain, 2, numpy.sort(wall(0, 1.0)), 1)
    load = fem.Constant(domain, PETSc.ScalarType((0, 0, TRACTION if bends else 0)))
    stiffness = fem.form(ufl.inner(stress(u), ufl.grad(v)) * ufl.dx)
    right = fem.form(ufl.inner(load, v) * ufl.ds(domain=domain, subdomain_data=end, subdomain_id=1))
    if bends:
        fixed = [held(space, wall(0, 0.0), 0.0)]
    else:
        fixed = [held(space, wall(axis, 0.0), 0.0, axis) for axis in range(3)]
        fixed.append(held(space, wall(0, 1.0), PULL, 0))
    matrix = fem.petsc.assemble_matrix(stiffness, bcs=fixed)
    matrix.assemble()
    b = fem.petsc.assemble_vector(right)
    fem.petsc.apply_lifting(b, [stiffness], bcs=[fixed])
    fem.petsc.set_bc(b, fixed)
    matrix.setNearNullSpace(rigid_motions(space))
    assembled = time.process_time()

    solver = PETSc.KSP().create(domain.comm)
    solver.setOperators(matrix)
    solver.setType("cg")
    solver.setNormType(PETSc.KSP.NormType.UNPRECONDITIONED)
    solver.setTolerances(rtol=tolerance, max_it=100000)
    solver.getPC().setType("gamg")
    solver.setFromOptions()
    solver.setUp()
    made = time.process_time()
    x = matrix.createVecRight()
    solver.solve(b, x)
    done = time.process_time()
    if solver.getConvergedReason() <= 0:
        sys.exit(f"not solved: PETSc's reason {solver.getConvergedReason()}")
    print("breccia-peer version", dolfinx.__version__)
    print("breccia-peer nodes", matrix.getSize()[0] // 3)
    print("breccia-peer iterations", solver.getIterationNumber())
    print("breccia-peer assembly", assembled - start)
    print("breccia-peer setup", made - assembled)
    print("breccia-peer seconds", done - assembled)
    print("breccia-peer resident", 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)
    print("breccia-peer answer", abs(x.array.reshape(-1, 3)).max(axis=0)[2 if bends else 1])


main()
