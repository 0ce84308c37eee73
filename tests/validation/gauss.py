"""Linear equations of the references: plain Python, since the tests need nothing else."""


def solve(rows):
    """Gauss with pivots; rows: [coefficients ..., right side], as many as unknowns."""
    n = len(rows)
    rows = [[v / max(abs(x) for x in r[:-1]) for v in r] for r in rows]
    for c in range(n):
        p = max(range(c, n), key=lambda r: abs(rows[r][c]))
        rows[c], rows[p] = rows[p], rows[c]
        for r in range(c + 1, n):
            f = rows[r][c] / rows[c][c]
            rows[r] = [x - f * y for x, y in zip(rows[r], rows[c])]
    x = [0.0] * n
    for r in reversed(range(n)):
        x[r] = (rows[r][n] - sum(rows[r][k] * x[k] for k in range(r + 1, n))) / rows[r][r]
    return x
