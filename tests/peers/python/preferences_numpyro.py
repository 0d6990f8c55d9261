"""Samples the posterior of preferences with NumPyro's NUTS on one core, for `peers -- preferences`.

    preferences_numpyro.py DATA.json [--seconds S] [--seed N]

DATA.json holds "features" (m rows of k) and "pairs" ([less, more] rows). The posterior: z ~ N(0, I_k), w = z / |z|, and for every
pair P = 1 / (1 + exp(w . (features[less] - features[more]))). One JSON object goes to standard output: for every configuration
of NUTS its CPU seconds, with compilation apart from warm-up and sampling, and ArviZ's diagnostics.
"""

import argparse
import json
import os
import sys
import time

# Before JAX is loaded: one thread on one core.
os.environ["XLA_FLAGS"] = "--xla_cpu_multi_thread_eigen=false intra_op_parallelism_threads=1"
os.environ["JAX_PLATFORMS"] = "cpu"
os.environ["OMP_NUM_THREADS"] = "1"
if hasattr(os, "sched_setaffinity"):
    os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})

import arviz
import jax
import jax.numpy as jnp
import numpy as np
import numpyro
import numpyro.distributions as dist
from numpyro.infer import NUTS

jax.config.update("jax_enable_x64", True)

CHAINS = 4
WARMUP = 500
# Draws per chain and compiled call; the first CHUNKS_OF_A_JOB of them make the job that counts with its warm-up.
CHUNK = 250
CHUNKS_OF_A_JOB = 4
MAX_CHUNKS = 100
CONFIGURATIONS = [
    {"chains": chains, "dense_mass": dense} for chains in ("sequential", "vectorized") for dense in (False, True)
]


def model(features, less, more):
    z = numpyro.sample("z", dist.Normal(0.0, 1.0).expand([features.shape[1]]).to_event(1))
    returns = features @ (z / jnp.linalg.norm(z))
    numpyro.factor("answers", -jnp.sum(jax.nn.softplus(returns[less] - returns[more])))


def compiled(step, state, n):
    """n transitions, compiled before they are timed: (state) -> (state, (z, leapfrog steps))."""

    def transition(state, _):
        state = step(state)
        return state, (state.z["z"], state.num_steps)

    return jax.jit(lambda state: jax.lax.scan(transition, state, None, length=n)).lower(state).compile()


class Sampler:
    """NUTS with all chains in one program, or one after another in the same program."""

    def __init__(self, arguments, vectorized, dense_mass, seed):
        kernel = NUTS(model, dense_mass=dense_mass)
        keys = jax.random.split(jax.random.PRNGKey(seed), CHAINS)
        if vectorized:
            self.states = [kernel.init(keys, WARMUP, None, arguments, {})]
        else:
            self.states = [kernel.init(key, WARMUP, None, arguments, {}) for key in keys]
        step = lambda state: kernel.sample(state, arguments, {})
        self.vectorized = vectorized
        self.warmup = compiled(step, self.states[0], WARMUP)
        self.chunk = compiled(step, self.states[0], CHUNK)

    def advance(self, program):
        """Runs a compiled program on every chain; z as (chain, draw, k) and the leapfrog steps."""
        outputs = [program(state) for state in self.states]
        jax.block_until_ready(outputs)
        self.states = [state for state, _ in outputs]
        z = [np.asarray(z) for _, (z, _) in outputs]
        steps = sum(int(np.asarray(steps).sum()) for _, (_, steps) in outputs)
        return (z[0].transpose(1, 0, 2) if self.vectorized else np.stack(z)), steps


def log_likelihood(w, features, less, more):
    returns = w @ features.T
    return -np.logaddexp(0.0, returns[..., less] - returns[..., more]).sum(-1)


def diagnose(w, log_likelihoods):
    series = [w[:, :, j] for j in range(w.shape[2])] + [log_likelihoods]
    bulk = [float(arviz.ess(values, method="bulk")) for values in series]
    return {
        "ess_bulk_min": min(bulk),
        "ess_bulk_median": float(np.median(bulk)),
        "ess_bulk_log_likelihood": bulk[-1],
        "ess_tail_log_likelihood": float(arviz.ess(log_likelihoods, method="tail")),
        "rhat_max": max(float(arviz.rhat(values)) for values in series),
    }


def run(configuration, data, seconds, seed):
    features, less, more = data
    arguments = tuple(jnp.asarray(part) for part in data)
    start = time.process_time()
    sampler = Sampler(arguments, configuration["chains"] == "vectorized", configuration["dense_mass"], seed)
    compile_seconds = time.process_time() - start

    start = time.process_time()
    sampler.advance(sampler.warmup)
    warmup_seconds = time.process_time() - start

    chunks, steps, chunk_seconds = [], 0, []
    while len(chunks) < CHUNKS_OF_A_JOB or (sum(chunk_seconds) < seconds and len(chunks) < MAX_CHUNKS):
        start = time.process_time()
        z, chunk_steps = sampler.advance(sampler.chunk)
        chunk_seconds.append(time.process_time() - start)
        chunks.append(z)
        steps += chunk_steps

    z = np.concatenate(chunks, axis=1)
    w = z / np.linalg.norm(z, axis=2, keepdims=True)
    height = log_likelihood(w, features, less, more)
    job = CHUNK * CHUNKS_OF_A_JOB
    return {
        **configuration,
        "compile_seconds": compile_seconds,
        "warmup_seconds": warmup_seconds,
        "sampling_seconds": sum(chunk_seconds),
        "job_sampling_seconds": sum(chunk_seconds[:CHUNKS_OF_A_JOB]),
        "n_draws": int(height.size),
        "n_job_draws": CHAINS * job,
        "leapfrogs_per_draw": steps / height.size,
        "all": diagnose(w, height),
        "job": diagnose(w[:, :job], height[:, :job]),
        "log_likelihood_mean": float(height.mean()),
        "log_likelihood_mcse": float(arviz.mcse(height, method="mean")),
        "log_likelihood_sd": float(height.std()),
        # The chains of the job, for the other side to judge with its own diagnostics.
        "job_log_likelihood": height[:, :job].ravel().tolist(),
    }


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("data")
    parser.add_argument("--seconds", type=float, default=5.0)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    with open(arguments.data, encoding="utf-8") as file:
        content = json.load(file)
    pairs = np.array(content["pairs"])
    data = (np.array(content["features"]), pairs[:, 0], pairs[:, 1])
    runs = [run(configuration, data, arguments.seconds, arguments.seed) for configuration in CONFIGURATIONS]
    versions = {package.__name__: package.__version__ for package in (numpyro, jax, arviz)}
    json.dump({"versions": versions, "chains": CHAINS, "warmup": WARMUP, "runs": runs}, sys.stdout)


if __name__ == "__main__":
    main()
