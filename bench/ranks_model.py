"""What several ranks would take, by a model of measured terms (docs/ranks.md).

    python3 bench/ranks_model.py [ROWS.csv] [--latency 2e-6] [--bandwidth 10e9]

ROWS.csv: surfaces of `breccia bench ranks` (default: those of bench/results). A step of a rank with n rows takes
    compute   n x seconds a row of its device (KINDS)
    exchange  4 x neighbours x latency + 240 bytes x ghosts / bandwidth; ghosts = c n^(2/3), of the rank with most
    calls     one reduction over the ranks, 2 log2(ranks) x latency
Without overlap the three follow one another; with it the exchange flies while rows inside are computed, in 16 ranges at most.
"""
import argparse
import csv
import math
import os

RESULTS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "results", "2026-11-26-ranks-surface.csv")
EXCHANGES, GHOST_BYTES = 4, 240  # of dlsm in double: displacement; gradient, stress, flux
FLOOR_BYTES = 3490.2  # least bytes a row (bench throughput, 1e6 cells)
# Seconds a row: measured; the same part of a bandwidth of 200 GB/s; what an H200 would take at least.
KINDS = {"2 cores": 0.16847e-6, "socket": FLOOR_BYTES / (0.692 * 200e9), "H200": FLOOR_BYTES / 4.3e12}
RESIDENT_BYTES = 3717  # a row, domain and all (bench ranks, 1e6 cells, one rank)


def surfaces(path):
    with open(path, encoding="utf-8") as file:
        return [{key: float(row[key]) for key in ("ranks", "rows_per_rank", "ghosts_most", "neighbours_most", "meanwhile_least")}
                for row in csv.DictReader(file) if row["quantity"] == "surface"]


def nearest(all_rows, ranks, rows):
    """The surface that was counted for most like this: of ranks first (those beyond the largest are as it), then of rows."""
    known = min(ranks, max(row["ranks"] for row in all_rows))
    return min((row for row in all_rows if row["ranks"] == known), key=lambda row: abs(math.log(row["rows_per_rank"] / rows)))


def step(all_rows, ranks, rows, a_row, latency, bandwidth):
    """(compute, exchange, calls, with overlap) [s], ghosts, neighbours of the rank with most."""
    like = nearest(all_rows, ranks, rows)
    scale = rows / like["rows_per_rank"]
    ghosts = like["ghosts_most"] * scale ** (2 / 3)
    border = min(1, (1 - like["meanwhile_least"]) * scale ** (-1 / 8))  # counted on 8 ranks of 1e5 and 1e6 rows in all
    compute, calls = rows * a_row, 2 * math.log2(ranks) * latency
    exchange = EXCHANGES * like["neighbours_most"] * latency + GHOST_BYTES * ghosts / bandwidth
    return compute, exchange, calls, border * compute + max((1 - border) * compute, exchange) + calls, ghosts, like["neighbours_most"]


def row_of(all_rows, ranks, rows, options):
    told = [f"{ranks}", f"{rows:.3g}"]
    for kind, a_row in KINDS.items():
        compute, exchange, calls, overlapped, ghosts, neighbours = step(all_rows, ranks, rows, a_row, options.latency, options.bandwidth)
        if kind == "2 cores":
            told += [f"{ghosts:.3g}", f"{neighbours:.0f}", f"{1e3 * exchange:.3g}"]
        told += [f"{100 * compute / (compute + exchange + calls):.0f}; {100 * compute / overlapped:.0f}"]
    return "| " + " | ".join(told + [f"{1e-9 * RESIDENT_BYTES * (rows + ghosts):.2g}"]) + " |"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("rows", nargs="?", default=RESULTS)
    parser.add_argument("--latency", type=float, default=2e-6)
    parser.add_argument("--bandwidth", type=float, default=10e9)
    options = parser.parse_args()
    all_rows = surfaces(options.rows)
    head = "| ranks | rows a rank | ghosts | neighbours | exchange [ms] | " + " | ".join(KINDS) + " | memory a rank [GB] |"
    for title, cases in (("weak, 1e6 rows a rank", [(n, 1e6) for n in (2, 16, 64, 512, 4096)]),
                         ("strong, 1e7 rows", [(n, 1e7 / n) for n in (16, 64, 512, 4096)]),
                         ("strong, 1e9 rows", [(n, 1e9 / n) for n in (16, 64, 512, 4096)])):
        print(f"\n{title}; efficiency [%] without and with overlap\n\n{head}\n|" + "---|" * (head.count("|") - 1))
        for ranks, rows in cases:
            print(row_of(all_rows, ranks, rows, options))


if __name__ == "__main__":
    main()
