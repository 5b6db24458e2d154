# Adhesion from the gaps of contact without adhesion, by the DMT sum and in the weak limit, and in full,
# by boundary elements with a traction law, where the DMT sum is not known to be good enough.

from functools import cache


@cache
def model_of(adhesion):
    """Model of every point of a set of adhesive parameters."""
    entry = ADHESION[adhesion]
    return model_choice.choose(entry, model_surface_of(entry["case"]), DMT_ERRORS)


def case_of(wildcards):
    """Contact case behind a set of adhesive parameters."""
    return ADHESION[wildcards.adhesion]["case"]


def points_in_full(wildcards):
    return model_of(wildcards.adhesion).full.tolist()


def parameters_in_full(wildcards):
    """What a full solution of a set depends on, beside the points that are solved in full."""
    others = ("case", "model", "accuracy", "seeds", "maps")
    return {key: value for key, value in ADHESION[wildcards.adhesion].items() if key not in others}


def seeds_in_full(adhesion):
    """Seeds that are solved in full; none if the DMT sum is good enough everywhere."""
    if not model_of(adhesion).full.any():
        return []
    entry = ADHESION[adhesion]
    return list(seeds_of(entry["case"])[: entry["seeds"]])


def seeds_by_grids(wildcards):
    """Seeds of a file, by the steps on the grid of a surface at which their states are solved.

    Half the grid is enough for four of every eight: grids differ by about as much on every surface.
    """
    on_both, on_half = [], []
    for seed in held_in(wildcards).seeds:
        (on_both if (seed - 1) % 8 < 4 else on_half).append(seed)
    return [[[2, 1], on_both], [[2], on_half]]


rule solve_adhesive:
    input:
        surfaces=lambda wildcards: surfaces_of(case_of(wildcards), held_in(wildcards).seeds),
    output:
        f"{RESULTS}/adhesion/full/{{adhesion}}/seeds{{part}}.nc",
    log:
        f"{RESULTS}/logs/solve_adhesive/adhesion/full/{{adhesion}}/seeds{{part}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/solve_adhesive/adhesion/full/{{adhesion}}/seeds{{part}}.tsv"
    # The longest jobs of a run: started late, they would keep one core busy and leave the others.
    priority: 1
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=memory(27 + stored.SEEDS_A_FILE, adhesion_size),
        runtime=minutes(4.1, adhesion_size, adhesive_states),
    params:
        adhesion=parameters_in_full,
        full=points_in_full,
        grids=seeds_by_grids,
        code=source_hash("adhesion/solve_adhesive.py"),
    message:
        "Solve contact with adhesion: {wildcards.adhesion}, seeds {wildcards.part}"
    script:
        "../scripts/adhesion/solve_adhesive.py"


rule average_adhesive:
    input:
        laws=ERROR_MODELS,
        ensemble=lambda wildcards: f"{RESULTS}/contact/ensembles/{case_of(wildcards)}.nc",
        realisations=lambda wildcards: states_of(wildcards.adhesion).find(
            seeds_in_full(wildcards.adhesion)
        ),
        # Contact without adhesion of the same realisations.
        alone=lambda wildcards: solutions_of(case_of(wildcards), seeds_in_full(wildcards.adhesion)),
    output:
        averages=f"{RESULTS}/adhesion/full/{{adhesion}}.nc",
        edges=f"{RESULTS}/adhesion/edges/{{adhesion}}.nc",
        limit=f"{RESULTS}/adhesion/dmt/{{adhesion}}.nc",
    log:
        f"{RESULTS}/logs/average_adhesive/adhesion/full/{{adhesion}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/average_adhesive/adhesion/full/{{adhesion}}.tsv"
    conda:
        "../envs/environment.yaml"
    params:
        adhesion=lambda wildcards: {**ADHESION[wildcards.adhesion], "maps": None},
        seeds=lambda wildcards: seeds_in_full(wildcards.adhesion),
        pressures=lambda wildcards: PLANS[case_of(wildcards)].pressures,
        full=points_in_full,
        dmt_error=lambda wildcards: model_of(wildcards.adhesion).dmt_error.tolist(),
        jtb=lambda wildcards: model_of(wildcards.adhesion).jtb.tolist(),
        code=source_hash("adhesion/average_adhesive.py"),
    message:
        "Average contact with adhesion: {wildcards.adhesion}"
    script:
        "../scripts/adhesion/average_adhesive.py"


# The committed table is a copy of this one, so that models can be chosen before anything is solved.
rule tabulate_dmt_error:
    input:
        adhesive=several("adhesion/full/{name}.nc", name=["dmt_error", "dmt_error_zeta128"]),
    output:
        f"{RESULTS}/adhesion/dmt_error.csv",
    log:
        f"{RESULTS}/logs/tabulate_dmt_error/adhesion/dmt_error.log",
    benchmark:
        f"{RESULTS}/benchmarks/tabulate_dmt_error/adhesion/dmt_error.tsv"
    conda:
        "../envs/environment.yaml"
    params:
        code=source_hash("adhesion/tabulate_dmt_error.py"),
    message:
        "Tabulate the error of the DMT sum"
    script:
        "../scripts/adhesion/tabulate_dmt_error.py"


rule adhesive_maps:
    input:
        surfaces=lambda wildcards: surfaces_of(case_of(wildcards)),
    output:
        f"{RESULTS}/adhesion/full/{{adhesion}}/maps.nc",
    log:
        f"{RESULTS}/logs/adhesive_maps/adhesion/full/{{adhesion}}/maps.log",
    benchmark:
        f"{RESULTS}/benchmarks/adhesive_maps/adhesion/full/{{adhesion}}/maps.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=memory(36, lambda wildcards: FIDELITY["map_points"] ** 2 / 1e6),
        runtime=60,
    params:
        adhesion=lambda wildcards: {
            key: ADHESION[wildcards.adhesion][key] for key in ("law", "q0_h_rms", "maps")
        },
        points=FIDELITY["map_points"],
        code=source_hash("adhesion/adhesive_maps.py"),
    message:
        "Map contact and attraction of one realisation: {wildcards.adhesion}"
    script:
        "../scripts/adhesion/adhesive_maps.py"


rule follow_loop:
    input:
        surfaces=lambda wildcards: surfaces_on_grid(
            LOOPS[wildcards.loop]["surface"], FIDELITY["pixels_per_wavelength"]
        ).find([1]),
    output:
        f"{RESULTS}/adhesion/loops/{{loop}}.nc",
    log:
        f"{RESULTS}/logs/follow_loop/adhesion/loops/{{loop}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/follow_loop/adhesion/loops/{{loop}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=memory(36 + stored.SEEDS_A_FILE, loop_size),
        runtime=60,
    params:
        loop=lambda wildcards: LOOPS[wildcards.loop],
        pixels_per_wavelength=FIDELITY["pixels_per_wavelength"],
        code=source_hash("adhesion/follow_loop.py"),
    message:
        "Follow approach and separation: {wildcards.loop}"
    script:
        "../scripts/adhesion/follow_loop.py"
