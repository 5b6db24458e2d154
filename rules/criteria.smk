# Stickiness criteria: the map of the paper, with a_V of simulation, and a verdict for every material
# on every surface, which needs no simulation.

# Files behind a_V: simulation of one case, theory on the same spectrum and on broad ones.
A_V_FILES = {
    "a_v": a_v_of_simulation(config["criteria"]["a_v"]["case"]),
    "lattice": f"{RESULTS}/fits/a_v/lattice/{config['criteria']['a_v']['case']}.nc",
    "theory": f"{RESULTS}/fits/a_v/sweeps/fig3c.nc",
}

# What pages are made of, here and in report.smk.
PAGE_PARTS = [
    project_file(f"scripts/stickiness/pages/templates/{part}")
    for part in ("macros.html.j2", "left_out.j2", "page.css", "page.js")
]


rule map_criterion:
    input:
        **A_V_FILES,
    output:
        map=f"{RESULTS}/criteria/map.nc",
        compared=f"{RESULTS}/criteria/compared.nc",
    log:
        f"{RESULTS}/logs/map_criterion/criteria/map.log",
    benchmark:
        f"{RESULTS}/benchmarks/map_criterion/criteria/map.tsv"
    conda:
        "../envs/environment.yaml"
    params:
        map=config["criteria"]["map"],
        compared=config["criteria"]["compared"],
        pressure=config["criteria"]["a_v"]["pressure"],
        code=source_hash("criteria/map_criterion.py"),
    message:
        "Map the paper's criterion, and compare it with others"
    script:
        "../scripts/criteria/map_criterion.py"


def material_surfaces():
    """Surfaces of the materials that are rough themselves."""
    return sorted({entry["surface"] for entry in MATERIALS.values() if entry["surface"]})


MATERIAL_SURFACES = analysed(material_surfaces())
# What a verdict depends on beside the surface. Of the texts about a material it tells the label alone.
JUDGED = {
    "material_surfaces": material_surfaces(),
    "materials": {
        name: {**without_texts(entry), "label": entry["label"]} for name, entry in MATERIALS.items()
    },
}


rule judge_surface:
    input:
        surface=ANALYSED,
        material_surfaces=MATERIAL_SURFACES,
    output:
        # The job keeps what it finds there of materials that are the same as before.
        verdicts=update(f"{RESULTS}/criteria/verdicts/{{real_surface}}.nc"),
        contact_laws=f"{RESULTS}/criteria/verdicts/{{real_surface}}.json",
    log:
        f"{RESULTS}/logs/judge_surface/criteria/verdicts/{{real_surface}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/judge_surface/criteria/verdicts/{{real_surface}}.tsv"
    conda:
        "../envs/environment.yaml"
    params:
        **JUDGED,
        label=lambda wildcards: LABELS[wildcards.real_surface],
        code=source_hash("criteria/judge_surface.py"),
    message:
        "Judge materials on a surface, unless they are judged: {wildcards.real_surface}"
    script:
        "../scripts/criteria/judge_surface.py"


rule judge:
    input:
        verdicts=several("criteria/verdicts/{surface}.nc", surface=REAL_SURFACES),
        template=project_file("report/verdicts.md.j2"),
        page=project_file("report/verdicts.html.j2"),
        parts=PAGE_PARTS,
    output:
        dataset=f"{RESULTS}/criteria/verdicts.nc",
        table=report(
            f"{RESULTS}/criteria/verdicts.md",
            category="Verdicts",
            caption="../report/verdicts.rst",
        ),
        page=report(
            f"{RESULTS}/criteria/verdicts.html",
            category="Verdicts",
            caption="../report/verdicts.rst",
        ),
        csv=f"{RESULTS}/criteria/verdicts.csv",
        workbook=f"{RESULTS}/criteria/verdicts.xlsx",
    log:
        f"{RESULTS}/logs/judge/criteria/verdicts.log",
    benchmark:
        f"{RESULTS}/benchmarks/judge/criteria/verdicts.tsv"
    conda:
        "../envs/environment.yaml"
    params:
        labels=LABELS,
        code=source_hash("criteria/judge.py"),
    message:
        "Collect the verdicts on all pairs"
    script:
        "../scripts/criteria/judge.py"


rule check_surfaces:
    input:
        f"{RESULTS}/criteria/verdicts.nc",
    output:
        f"{RESULTS}/criteria/all_read",
    log:
        f"{RESULTS}/logs/check_surfaces/criteria/all_read.log",
    benchmark:
        f"{RESULTS}/benchmarks/check_surfaces/criteria/all_read.tsv"
    conda:
        "../envs/environment.yaml"
    params:
        code=source_hash("criteria/check_surfaces.py"),
    message:
        "Check that every surface could be read"
    script:
        "../scripts/criteria/check_surfaces.py"
