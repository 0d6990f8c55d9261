"""Solves one BROIL problem with SciPy's HiGHS, for `peers -- broil`.

    broil_highs.py PROBLEM.json --form dense|factors [--limit S]

PROBLEM.json holds "mdp" (as the commands of apprentice read it, its features by state), "draws" (N rows of k), "offsets" (N numbers b),
"alpha" and "lambda". The problem is that of the dissertation, F.1 to F.4, with the sign of F.1 mended:

    max (1 - lambda) (sigma - sum_i z_i / ((1 - alpha) N)) + lambda mean(w)' Phi' u
    with z_i >= sigma - (w_i' Phi' u - b_i), the flow of u, u >= 0 and z >= 0.

"dense" has the rewards of all states and actions in each row of z, as in F.2; "factors" has k more variables mu = Phi' u instead. One
JSON object goes to standard output: for each of HiGHS's two methods its status, the optimum and the CPU seconds of the solver alone.
"""

import argparse
import json
import os
import resource
import sys
import time

# Before NumPy is loaded: one thread on one core.
os.environ["OMP_NUM_THREADS"] = "1"
os.environ["OPENBLAS_NUM_THREADS"] = "1"
if hasattr(os, "sched_setaffinity"):
    os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})

import numpy as np
import scipy
import scipy.sparse as sparse
from scipy.optimize import linprog

METHODS = ["highs-ds", "highs-ipm"]


def flow(mdp):
    """Sum_a u(s', a) - gamma sum P(s'|s, a) u(s, a) as a matrix, S x SA."""
    n_states, n_actions = mdp["n_states"], mdp["n_actions"]
    columns = np.arange(n_states * n_actions)
    outgoing = sparse.csr_matrix((np.ones(len(columns)), (columns // n_actions, columns)), (n_states, len(columns)))
    moves = np.array(mdp["transitions"])
    source, action, target = (moves[:, i].astype(int) for i in range(3))
    incoming = sparse.csr_matrix(
        (mdp["gamma"] * moves[:, 3], (target, source * n_actions + action)), (n_states, len(columns))
    )
    return outgoing - incoming


def program(problem, form):
    """Costs, inequalities, equalities and bounds of the linear program in (u, [mu,] sigma, z)."""
    mdp = problem["mdp"]
    draws, offsets = np.array(problem["draws"]), np.array(problem["offsets"])
    alpha, lam = problem["alpha"], problem["lambda"]
    features = np.repeat(np.array(mdp["features"]), mdp["n_actions"], axis=0)
    n_pairs, k = features.shape
    n = len(draws)
    balance = flow(mdp)
    n_states = balance.shape[0]
    mean = draws.mean(axis=0)
    tail = np.full(n, (1 - lam) / ((1 - alpha) * n))
    ones = sparse.csr_matrix(np.ones((n, 1)))
    if form == "dense":
        rewards = draws @ features.T
        costs = np.concatenate([-lam * (features @ mean), [-(1 - lam)], tail])
        upper = sparse.hstack([sparse.csr_matrix(-rewards), ones, -sparse.identity(n)], format="csr")
        equal = sparse.hstack([balance, sparse.csr_matrix((n_states, 1 + n))], format="csr")
        right = np.array(mdp["initial"])
        bounds = [(0, None)] * n_pairs + [(None, None)] + [(0, None)] * n
    else:
        costs = np.concatenate([np.zeros(n_pairs), -lam * mean, [-(1 - lam)], tail])
        upper = sparse.hstack(
            [sparse.csr_matrix((n, n_pairs)), sparse.csr_matrix(-draws), ones, -sparse.identity(n)], format="csr"
        )
        counts = sparse.hstack(
            [sparse.csr_matrix(features.T), -sparse.identity(k), sparse.csr_matrix((k, 1 + n))], format="csr"
        )
        states = sparse.hstack([balance, sparse.csr_matrix((n_states, k + 1 + n))], format="csr")
        equal = sparse.vstack([states, counts], format="csr")
        right = np.concatenate([np.array(mdp["initial"]), np.zeros(k)])
        bounds = [(0, None)] * n_pairs + [(None, None)] * (k + 1) + [(0, None)] * n
    return costs, upper, -offsets, equal, right, bounds


def solve(problem, form, limit):
    """The answer of each method of HiGHS."""
    costs, upper, upper_right, equal, right, bounds = program(problem, form)
    runs = []
    for method in METHODS:
        start, clock = time.process_time(), time.monotonic()
        found = linprog(
            costs, A_ub=upper, b_ub=upper_right, A_eq=equal, b_eq=right, bounds=bounds, method=method,
            options={"time_limit": limit},
        )
        runs.append({
            "method": method,
            "optimal": found.status == 0,
            "message": str(found.message)[:120],
            "objective": None if found.fun is None or found.status != 0 else -float(found.fun),
            "cpu_seconds": time.process_time() - start,
            "seconds": time.monotonic() - clock,
        })
    return {
        "versions": {"scipy": scipy.__version__, "numpy": np.__version__},
        "form": form,
        "n_nonzeros": int(upper.nnz + equal.nnz),
        "runs": runs,
        "peak_mib": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024,
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("problem")
    parser.add_argument("--form", choices=["dense", "factors"], required=True)
    parser.add_argument("--limit", type=float, default=300.0)
    arguments = parser.parse_args()
    with open(arguments.problem, encoding="utf-8") as file:
        problem = json.load(file)
    json.dump(solve(problem, arguments.form, arguments.limit), sys.stdout)


if __name__ == "__main__":
    main()
