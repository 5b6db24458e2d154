# Stickiness criteria: the map of the paper and a verdict for every material on every surface.

# Files behind a_V: simulation of one case, theory on the same spectrum and on broad ones.
A_V_FILES = {
    "a_v": a_v_of_simulation(config["criteria"]["a_v"]["case"]),
    "lattice": f"{RESULTS}/fits/a_v/lattice/{config['criteria']['a_v']['case']}.nc",
    "theory": f"{RESULTS}/fits/a_v/sweeps/fig3c.nc",
}


rule map_criterion:
    input:
        **A_V_FILES,
        a_v_table=f"{RESULTS}/fits/a_v_table.nc",
    output:
        f"{RESULTS}/criteria/map.nc",
    params:
        map=config["criteria"]["map"],
        pressure=config["criteria"]["a_v"]["pressure"],
    script:
        "../scripts/criteria/map_criterion.py"


rule compare_criteria:
    input:
        **A_V_FILES,
        a_v_table=f"{RESULTS}/fits/a_v_table.nc",
    output:
        f"{RESULTS}/criteria/compared.nc",
    params:
        compared=config["criteria"]["compared"],
        pressure=config["criteria"]["a_v"]["pressure"],
    script:
        "../scripts/criteria/compare_criteria.py"


rule judge:
    input:
        **A_V_FILES,
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
    params:
        materials=MATERIALS,
        surfaces=list(REAL_SURFACES),
        pressure=config["criteria"]["a_v"]["pressure"],
        frequencies=config["criteria"]["frequencies"],
    script:
        "../scripts/criteria/judge.py"
