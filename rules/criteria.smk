# Stickiness criteria: the map of the paper and a verdict for every material on every surface.


def a_v_inputs():
    """What the a_V of the derived criterion rests on: what was measured once, and theory."""
    case = config["criteria"]["a_v"]["case"]
    return {
        "a_v": config["criteria"]["a_v"]["measured"],
        "lattice": f"{RESULTS}/fits/a_v/lattice/{case}.nc",
        "theory": f"{RESULTS}/fits/a_v/sweeps/fig3c.nc",
    }


rule map_criterion:
    input:
        **a_v_inputs(),
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
        **a_v_inputs(),
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
        **a_v_inputs(),
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


rule record_a_v:
    input:
        a_v=f"{RESULTS}/fits/a_v/ensembles/{config['criteria']['a_v']['case']}.nc",
    output:
        f"{RESULTS}/criteria/a_v.csv",
    params:
        pressure=config["criteria"]["a_v"]["pressure"],
    script:
        "../scripts/criteria/record_a_v.py"
