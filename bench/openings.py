"""How much stiffer openings of cells are together than their sweeps estimate them (bench/results/2026-11-29-rings.md).

    breccia build scene.yaml -o d.h5; python3 bench/openings.py d.h5 [NU]

The largest eigenvalues x of K w = x D w over all faces of a body of model dlsm: K the second derivative of the energy by
their openings w (docs/notebook/theory.md T2, linearised), D what a sweep takes for it (kernels/effects/fracture/softening.h,
soft_cell_stiffness and soft_bond_stiffness, every face open), and the faces that take most part. Needs numpy, scipy, h5py.
"""
import sys
import h5py
import numpy as np
import scipy.sparse as sp
import scipy.sparse.linalg as sl

BETA, TAU, BESIDE = 1.06, 0.15, 0.3


def matrix(shape, *parts):
    """A sparse matrix of (rows, columns, values)."""
    rows, columns, values = (np.concatenate([np.broadcast_to(part[k], part[2].shape).ravel() for part in parts]) for k in range(3))
    return sp.csr_matrix((values, (rows, columns)), shape=shape)


def main(path, nu):
    file = h5py.File(path)
    position, volume = file["elements/position"][:], file["elements/volume"][:]
    start, other = file["half_edges/row_start"][:], file["half_edges/neighbour"][:]
    area, centre, twin = (file["half_edges/" + name][:] for name in ("area_vector", "face_centroid", "twin"))
    n, own = len(volume), np.repeat(np.arange(len(volume)), np.diff(start))
    mu, lam = 0.5 / (1 + nu), nu / (1 + nu) / (1 - 2 * nu)
    branch, beside = position[other] - position[own], centre - 0.5 * (position[own] + position[other])
    ratio = np.sqrt((branch**2).sum(1) / (area**2).sum(1))
    s = branch / ratio[:, None]
    shape = np.zeros((n, 3, 3))
    np.add.at(shape, own, branch[:, :, None] * s[:, None, :])
    pull = np.einsum("hij,hj->hi", np.linalg.pinv(shape)[own], s)
    lead = np.flatnonzero(own < other)
    n_faces, face, three = len(lead), np.full(len(own), -1), np.eye(3)
    face[lead] = face[twin[lead]] = np.arange(n_faces)
    sign, ends = np.where(own < other, 1.0, -1.0), (own[lead], other[lead])

    # rows 3 e + b of one component: H = - sum of w (x) pull, G = H + sum of ((H_j - H_i) d) (x) s / 2V, r = - w - (H_i + H_j) R / 2
    h = matrix((3 * n, n_faces), *((3 * own + b, face, -sign * pull[:, b]) for b in range(3)))
    turn = [(3 * own + b, 3 * e + c, k * beside[:, c] * s[:, b] / (2 * volume[own])) for b in range(3) for c in range(3) for e, k in ((other, 1), (own, -1))]
    g = h + matrix((3 * n, 3 * n), *turn) @ h
    mean = matrix((n_faces, 3 * n), *((np.arange(n_faces), 3 * e + b, 0.5 * branch[lead, b]) for b in range(3) for e in ends))
    r = -mean @ h - sp.identity(n_faces)

    # components: tensors 9 e + 3 b + a, vectors 3 f + a
    h, g, r = (sp.kron(part, three, format="csr") for part in (h, g, r))
    swap = np.array([[0.5 * ((i, j) == (k, m)) + 0.5 * ((i, j) == (m, k)) for k in range(3) for m in range(3)] for i in range(3) for j in range(3)])
    symmetric, trace = sp.kron(sp.identity(n), swap, format="csr"), sp.kron(sp.identity(n), three.reshape(1, 9), format="csr")
    bulk, k = lam + 2 * mu / 3, min(mu, 3 * lam + 2 * mu)
    ell = (min(bulk, 2 * mu / 3) - 2 * k / 3) / (2 * k)
    strain, volumes = symmetric @ g, trace @ g
    m = sp.kron(mean, three, format="csr") @ (symmetric @ h + ell * sp.kron(sp.identity(n), three.reshape(9, 1), format="csr") @ trace @ h)
    spring = sp.diags(np.repeat(k / ratio[lead], 3))
    stiffness = 2 * mu * strain.T @ sp.diags(np.repeat(volume, 9)) @ strain + lam * volumes.T @ sp.diags(volume) @ volumes
    stiffness = (stiffness + (1 + TAU) * r.T @ spring @ r + BETA * (r.T @ spring @ m + m.T @ spring @ r)).tocsc()

    size = np.linalg.norm(pull, axis=1)
    # soft_together: no less than the largest eigenvalue of M T
    sways = np.broadcast_to(three, (n, 3, 3)).copy()
    np.add.at(sways, own, -0.5 * s[:, :, None] * beside[:, None, :] / volume[own, None, None])
    moves = np.einsum("nki,nkj->nij", sways, sways)
    np.add.at(moves, own, (0.25 * (s * s).sum(1) / volume[own] / volume[other])[:, None, None] * beside[:, :, None] * beside[:, None, :])
    together = np.zeros((n, 3, 3))
    np.add.at(together, own, pull[:, :, None] * pull[:, None, :] / size[:, None, None])
    reach = np.maximum(np.bincount(own, size, n), np.linalg.eigvals(moves @ together).real.max(axis=1))
    cell = volume[own] * reach[own]
    draws = (cell * size * (mu + BESIDE * max(lam, 0)))[:, None, None] * three + (cell / size * (lam + mu))[:, None, None] * pull[:, :, None] * pull[:, None, :]
    share = 0.5 * ratio[lead] * ((pull[lead] - pull[twin[lead]]) * s[lead]).sum(1)
    bond = k / ratio[lead] * ((1 + TAU) * ((1 - share) ** 2 + 0.5 * share) + 2 * BETA * (1 - share) * share)
    estimate = draws[lead] + draws[twin[lead]] + bond[:, None, None] * three

    def blocks(a):
        return sp.bsr_matrix((a, np.arange(n_faces), np.arange(n_faces + 1)), shape=(3 * n_faces, 3 * n_faces)).tocsc()

    values, vectors = sl.eigsh(stiffness, k=6, M=blocks(estimate), Minv=blocks(np.linalg.inv(estimate)), which="LA")
    for x, w in sorted(zip(values, vectors.T), key=lambda one: -one[0]):
        part = np.linalg.norm(w.reshape(-1, 3), axis=1)
        print(f"{x:.4f}", ", ".join(f"{ends[0][f]}-{ends[1][f]}" for f in np.argsort(-part)[:4]))


if __name__ == "__main__":
    main(sys.argv[1], float(sys.argv[2]) if len(sys.argv) > 2 else 0.22)
