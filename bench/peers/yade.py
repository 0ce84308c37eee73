# The same beams in YADE: yade -n -x -j THREADS yade.py FOLDER STEPS WARM EVERY DT, written and run by `breccia bench peers`.
# FOLDER/elements.csv and bonds.csv are the packing. Every sphere has one radius for its geometry, so that a bond's forces act at the middle of its
# branch as those of a beam do; masses and moments of inertia are those of the packing. With kn = E S / l, ks = 12 E I / l^3, kr = E I / l, ktw = G J / l the
# cohesive law is the beam's for small rotations. There is no collider: the bonds are all there is, which is YADE's cheapest step.
import sys
import time
import numpy
import yade.config

folder, steps, warm, every, dt = sys.argv[1], int(sys.argv[2]), int(sys.argv[3]), int(sys.argv[4]), float(sys.argv[5])
elements = numpy.loadtxt(folder + "/elements.csv", delimiter=",", skiprows=1, ndmin=2)
bonds = numpy.loadtxt(folder + "/bonds.csv", delimiter=",", skiprows=1, ndmin=2)
radius = 0.51 * bonds[:, 6].max()  # every bond overlaps

material = O.materials.append(CohFrictMat(young=1, poisson=1, frictionAngle=0, isCohesive=True, normalCohesion=1e30, shearCohesion=1e30, momentRotationLaw=True))
O.engines = [
    ForceResetter(),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom6D(avoidGranularRatcheting=False)],
                    [Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(setCohesionOnNewContacts=True)],
                    [Law2_ScGeom6D_CohFrictPhys_CohesionMoment(always_use_moment_law=True)]),
    NewtonIntegrator(damping=0),
]
for x, y, z, _, mass, inertia, _, _, _ in elements:
    body = utils.sphere((x, y, z), radius, material=material)
    body.state.mass, body.state.inertia = mass, (inertia, inertia, inertia)
    O.bodies.append(body)
O.dt = dt
for i, j, kn, ks, kr, ktw, length in bonds:
    bond = createInteraction(int(i), int(j))
    phys = bond.phys
    phys.kn, phys.ks, phys.kr, phys.ktw = kn, ks, kr, ktw
    phys.unp = bond.geom.penetrationDepth
    phys.normalAdhesion = phys.shearAdhesion = 1e30
O.step()  # at rest: YADE clears the shear force of bonds that are new
# The shear of a step is that of the velocities before it: what the first step would add before anything moved is taken back.
velocity = elements[:, 6:9]
for body, v in zip(O.bodies, velocity):
    body.state.vel = tuple(v)
for bond in O.interactions:
    jump, axis = velocity[bond.id2] - velocity[bond.id1], numpy.array(bond.geom.normal)
    bond.phys.shearForce = tuple(bond.phys.ks * dt * (jump - jump.dot(axis) * axis))


def velocities():
    return numpy.array([tuple(b.state.vel) for b in O.bodies])


print("breccia-peer version", yade.config.version)
if every:  # velocities stand half a step before the positions; their means over a step are those of whole steps
    shape = numpy.cos(numpy.pi * elements[:, 0])
    mass = elements[:, 4]
    before = velocities()
    for step in range(1, steps + 1):
        O.step()
        after = velocities()
        v = 0.5 * (before + after)
        before = after
        if (step - 1) % every == 0:
            print("breccia-peer sample %d %.15g %.15g" % (step - 1, (mass * shape * v[:, 0]).sum(), (0.5 * mass * (v * v).sum(axis=1)).sum()))
else:
    O.run(warm, True)
    wall, processor = time.perf_counter(), time.process_time()
    O.run(steps, True)
    wall, processor = time.perf_counter() - wall, time.process_time() - processor
    print("breccia-peer seconds %.9g" % wall)
    print("breccia-peer processor %.9g" % processor)
print("breccia-peer bonds", sum(1 for i in O.interactions if i.isReal))
sys.stdout.flush()
