# Where theory departs from simulation, and the gamma with which it departs least.

# Whatever is simulated for every quantity, with which theory is compared.
SIMULATED = [*COMPLETE, *COMPARISONS]


# One job for all: each case takes less time than a job takes to start.
if SIMULATED:

    rule compare_theory:
        input:
            ensembles=several("contact/ensembles/{compared}.nc", compared=SIMULATED),
            theories=several("persson/lattice/{compared}.nc", compared=SIMULATED),
        output:
            comparisons=several("fits/theory/{compared}.nc", compared=SIMULATED),
            gamma=f"{RESULTS}/fits/gamma.nc",
        log:
            f"{RESULTS}/logs/compare_theory/fits/theory.log",
        benchmark:
            f"{RESULTS}/benchmarks/compare_theory/fits/theory.tsv"
        conda:
            "../envs/environment.yaml"
        resources:
            runtime=lambda wildcards, attempt: attempt * (10 + len(SIMULATED) // 20),
        params:
            code=source_hash("fits/compare_theory.py"),
        message:
            "Compare Persson's theory with simulation, and fit gamma"
        script:
            "../scripts/fits/compare_theory.py"
