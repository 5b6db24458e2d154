# Persson's theory: on continuous spectra for the paper's sweeps, and on the discrete spectrum that the
# cell of a simulated case really holds; a_V fitted to both.

# What all theory depends on beside the surfaces and their loads.
THEORY = {
    "variants": config["theory"]["variants"],
    "gamma": GAMMA,
    "gaps": GAPS,
    "windows": config["a_v"]["windows"],
}


def describe_lattices(names):
    """Surfaces and loads by the names of cases or comparisons, and whether they are simulated."""
    return {
        name: {
            "surface": model_surface_of(name),
            "pressures": pressures_of(name),
            "simulated": name in COMPLETE or name in COMPARISONS,
        }
        for name in names
    }


rule persson_sweep:
    input:
        laws=ERROR_MODELS,
    output:
        theory=several("persson/sweeps/{sweep}.nc", sweep=SWEEPS),
        a_v=several("fits/a_v/sweeps/{sweep}.nc", sweep=SWEEPS),
    log:
        f"{RESULTS}/logs/persson_sweep/persson/sweeps.log",
    benchmark:
        f"{RESULTS}/benchmarks/persson_sweep/persson/sweeps.tsv"
    conda:
        "../envs/environment.yaml"
    params:
        **THEORY,
        sweeps=list(SWEEPS.values()),
        code=source_hash("persson/persson_sweep.py"),
    message:
        "Evaluate Persson's theory for the sweeps of the figures"
    script:
        "../scripts/persson/persson_sweep.py"


rule persson_lattice:
    input:
        laws=ERROR_MODELS,
    output:
        theory=[f"{RESULTS}/persson/lattice/{{case}}.nc"],
        a_v=[f"{RESULTS}/fits/a_v/lattice/{{case}}.nc"],
    log:
        f"{RESULTS}/logs/persson_lattice/persson/lattice/{{case}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/persson_lattice/persson/lattice/{{case}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        runtime=few_minutes,
    params:
        **THEORY,
        lattices=lambda wildcards: describe_lattices([wildcards.case]),
        code=source_hash("persson/persson_lattice.py"),
    message:
        "Evaluate Persson's theory on the spectrum of the cell: {wildcards.case}"
    script:
        "../scripts/persson/persson_lattice.py"


# The comparisons of Figure 8 are evaluated together: each takes less time than a job takes to start.
# A case has a job of its own, so that a new one leaves the others and their figures alone.
if COMPARISONS:

    rule persson_comparisons:
        input:
            laws=ERROR_MODELS,
        output:
            theory=several("persson/lattice/{name}.nc", name=COMPARISONS),
            a_v=several("fits/a_v/lattice/{name}.nc", name=COMPARISONS),
        log:
            f"{RESULTS}/logs/persson_comparisons/persson/lattice.log",
        benchmark:
            f"{RESULTS}/benchmarks/persson_comparisons/persson/lattice.tsv"
        conda:
            "../envs/environment.yaml"
        params:
            **THEORY,
            lattices=describe_lattices(COMPARISONS),
            code=source_hash("persson/persson_lattice.py"),
        message:
            "Evaluate Persson's theory on the spectra of all comparisons"
        script:
            "../scripts/persson/persson_lattice.py"
