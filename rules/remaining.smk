# How much adhesion remains: approach and separation of rough surfaces, and their energies at zero
# load, simulated once for all. The models of the verdicts are compared with the committed tables.

MEASURED = REMAINING_CAMPAIGN["sets"]
MEASURED_HEIGHTS = HEIGHT_CAMPAIGN["sets"]
# Surfaces of one spectrum that differ in their heights: worn tops, and peaks.
SKEWED = [
    ModelSurface(
        hurst=0.8,
        magnification=min(FIDELITY["pixels_per_wavelength"] ** 2 // 4, 16),
        window=4,
        heights={"skewness": skewness},
    ).model_dump()
    for skewness in (-1.5, 1.5)
]


wildcard_constraints:
    remaining_set=choices(MEASURED),
    height_set=choices(MEASURED_HEIGHTS),


def measured_points(wildcards):
    """Points of the grid of a set."""
    return MEASURED[wildcards.remaining_set]["points"] ** 2


rule measure_remaining:
    output:
        f"{REMAINING}/{{remaining_set}}/seed{{seed}}.nc",
    log:
        f"{REMAINING}/logs/measure_remaining/{{remaining_set}}/seed{{seed}}.log",
    benchmark:
        f"{REMAINING}/benchmarks/measure_remaining/{{remaining_set}}/seed{{seed}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=2000,
        runtime=120,
    params:
        surface=lambda wildcards: MEASURED[wildcards.remaining_set],
        law=REMAINING_CAMPAIGN["law"],
        squeeze=REMAINING_CAMPAIGN["squeeze"],
        code=source_hash("remaining/measure_remaining.py"),
    message:
        "Simulate how much adhesion remains: {wildcards.remaining_set}, seed {wildcards.seed}"
    script:
        "../scripts/remaining/measure_remaining.py"


# The committed table is a copy of this one, so that a run shows it without an hour of simulation.
rule tabulate_remaining:
    input:
        [
            f"{REMAINING}/{name}/seed{seed}.nc"
            for name, measured in MEASURED.items()
            for seed in measured["seeds"]
        ],
    output:
        table=f"{REMAINING}/remaining.csv",
        summary=f"{REMAINING}/remaining.md",
    log:
        f"{REMAINING}/logs/tabulate_remaining/remaining.log",
    benchmark:
        f"{REMAINING}/benchmarks/tabulate_remaining/remaining.tsv"
    conda:
        "../envs/environment.yaml"
    params:
        code=source_hash("remaining/tabulate_remaining.py"),
    message:
        "Tabulate how much adhesion remains"
    script:
        "../scripts/remaining/tabulate_remaining.py"


rule measure_heights:
    output:
        f"{REMAINING}/heights/{{height_set}}/seed{{seed}}.nc",
    log:
        f"{REMAINING}/logs/measure_heights/{{height_set}}/seed{{seed}}.log",
    benchmark:
        f"{REMAINING}/benchmarks/measure_heights/{{height_set}}/seed{{seed}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=2000,
        runtime=30,
    params:
        surface=lambda wildcards: MEASURED_HEIGHTS[wildcards.height_set],
        law=HEIGHT_CAMPAIGN["law"],
        energies=HEIGHT_CAMPAIGN["energies"],
        pixels_in_zone=HEIGHT_CAMPAIGN["pixels_in_zone"],
        code=source_hash("remaining/measure_heights.py"),
    message:
        "Simulate what remains at zero load: {wildcards.height_set}, seed {wildcards.seed}"
    script:
        "../scripts/remaining/measure_heights.py"


rule tabulate_heights:
    input:
        [
            f"{REMAINING}/heights/{name}/seed{seed}.nc"
            for name, measured in MEASURED_HEIGHTS.items()
            for seed in measured["seeds"]
        ],
    output:
        table=f"{REMAINING}/heights.csv",
        summary=f"{REMAINING}/heights.md",
    log:
        f"{REMAINING}/logs/tabulate_heights/heights.log",
    benchmark:
        f"{REMAINING}/benchmarks/tabulate_heights/heights.tsv"
    conda:
        "../envs/environment.yaml"
    params:
        code=source_hash("remaining/tabulate_heights.py"),
    message:
        "Tabulate what remains at zero load"
    script:
        "../scripts/remaining/tabulate_heights.py"


# Three models of the share that remains, where heights decide, beside full simulation.
rule compare_height_models:
    output:
        f"{RESULTS}/remaining/heights.nc",
    log:
        f"{RESULTS}/logs/compare_height_models/remaining/heights.log",
    benchmark:
        f"{RESULTS}/benchmarks/compare_height_models/remaining/heights.tsv"
    conda:
        "../envs/environment.yaml"
    params:
        surfaces=SKEWED,
        seed=1,
        energies=[round(10 ** (k / 20), 4) for k in range(-20, 11)],
        simulated_energies=[0.13, 0.3, 0.6, 1.2, 2.2],
        code=source_hash("remaining/compare_height_models.py"),
    message:
        "Compare models of what remains on peaks and on worn tops"
    script:
        "../scripts/remaining/compare_height_models.py"
