# Stickiness criteria: the map of the paper and a verdict for every material on every surface.

# Files behind a_V: simulation of one case, theory on the same spectrum and on broad ones.
A_V_FILES = {
    "a_v": f"{RESULTS}/fits/a_v/ensembles/{config['criteria']['a_v']['case']}.nc",
    "lattice": f"{RESULTS}/fits/a_v/lattice/{config['criteria']['a_v']['case']}.nc",
    "theory": f"{RESULTS}/fits/a_v/sweeps/fig3c.nc",
}


rule map_criterion:
    input:
        **A_V_FILES,
        library=library_of("criteria/map_criterion.py"),
        a_v_table=f"{RESULTS}/fits/a_v_table.nc",
    output:
        f"{RESULTS}/criteria/map.nc",
    log:
        f"{LOGS}/map_criterion.log",
    benchmark:
        f"{BENCHMARKS}/map_criterion.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=500,
    params:
        map=config["criteria"]["map"],
        pressure=config["criteria"]["a_v"]["pressure"],
    script:
        "../scripts/criteria/map_criterion.py"


rule compare_criteria:
    input:
        **A_V_FILES,
        library=library_of("criteria/compare_criteria.py"),
        a_v_table=f"{RESULTS}/fits/a_v_table.nc",
    output:
        f"{RESULTS}/criteria/compared.nc",
    log:
        f"{LOGS}/compare_criteria.log",
    benchmark:
        f"{BENCHMARKS}/compare_criteria.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=500,
    params:
        compared=config["criteria"]["compared"],
        pressure=config["criteria"]["a_v"]["pressure"],
    script:
        "../scripts/criteria/compare_criteria.py"


rule judge:
    input:
        **A_V_FILES,
        library=library_of("criteria/judge.py"),
        surfaces=expand(f"{RESULTS}/real_surfaces/{{real_surface}}.nc", real_surface=REAL_SURFACES),
        theories=expand(
            f"{RESULTS}/persson/surfaces/{{real_surface}}.nc", real_surface=REAL_SURFACES
        ),
    output:
        dataset=f"{RESULTS}/criteria/verdicts.nc",
        table=report(
            f"{RESULTS}/criteria/verdicts.md",
            category="Verdicts",
            caption="../report/verdicts.rst",
        ),
    log:
        f"{LOGS}/judge.log",
    benchmark:
        f"{BENCHMARKS}/judge.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=500,
    params:
        materials=MATERIALS,
        surfaces=list(REAL_SURFACES),
        pressure=config["criteria"]["a_v"]["pressure"],
        frequencies=config["criteria"]["frequencies"],
    script:
        "../scripts/criteria/judge.py"
