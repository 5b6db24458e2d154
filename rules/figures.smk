# The paper's six figures, panel by panel, and eight on what the models are good for: 7 the DMT sum,
# 8 the theory, 9 the criteria, 10 attraction at the edges of contact, 11 how much adhesion remains, 12
# what of it heights decide, 13 what remains with sharp edges, 14 area and gaps of Persson's theory.
# scripts/common/paper.py lists the parameters of the paper.


MAGNIFICATIONS = [ROLES.narrow_band, ROLES.middle_band, ROLES.broad_band]
FIG4B = ("rough", "rough_near", "smooth")  # its adhesive sets, without "fig4b_"
WITH_EXPONENTS = [*MAGNIFICATIONS, ROLES.wide_cell]
FIG2_CASE = ADHESION["fig2"]["case"]
# Cases on the surface of Figure 4A, whose theory on the spectrum of the cell it shows.
FIG4A_CASES = [case for case in COMPLETE if CASES[case]["surface"] == LOOPS["fig4a"]["surface"]]
# The paper's Figure 6: PMMA, ground steel and asphalt.
FIG6_SURFACES = [
    name for name in ("sandblasted_pmma", "ground_steel", "asphalt") if name in REAL_SURFACES
]
SIMULATED_IN_FULL = [adhesion for adhesion in ADHESION if seeds_in_full(adhesion)]
FIGURE_INPUTS = {
    "fig1": {
        "density": f"{RESULTS}/persson/sweeps/fig1a.nc",
        "convergence": f"{RESULTS}/persson/sweeps/fig1b.nc",
    },
    "fig2": {
        "surface": surfaces_of(FIG2_CASE)[0],
        "maps": maps_of(FIG2_CASE),
        "adhesion": f"{RESULTS}/adhesion/dmt/fig2.nc",
        "adhesive": f"{RESULTS}/adhesion/full/fig2.nc",
        "adhesive_maps": f"{RESULTS}/adhesion/full/fig2/maps.nc",
    },
    "fig3": {
        "sweeps": several("persson/sweeps/fig3{panel}.nc", panel=list("abcd")),
        "fits": several("fits/a_v/sweeps/fig3{panel}.nc", panel=list("abcd")),
        "bem": several("contact/ensembles/{case}.nc", case=COMPLETE),
        "bem_fits": several("fits/a_v/ensembles/{case}.nc", case=COMPLETE),
        "lattice_fits": several("fits/a_v/lattice/{case}.nc", case=COMPLETE),
    },
    "fig4": {
        "loop": f"{RESULTS}/adhesion/loops/fig4a.nc",
        "theory": several("persson/lattice/{case}.nc", case=FIG4A_CASES[:1]),
        "rough": several("adhesion/full/fig4b_{name}.nc", name=FIG4B[:2]),
        "smooth": f"{RESULTS}/adhesion/full/fig4b_smooth.nc",
        "a_v": several("fits/a_v/ensembles/{case}.nc", case=MAGNIFICATIONS[1:]),
    },
    "fig5": {"map": f"{RESULTS}/criteria/map.nc"},
    "fig6": {"surfaces": analysed(FIG6_SURFACES)},
    "fig7": {"adhesive": f"{RESULTS}/adhesion/full/dmt_error.nc"},
    "fig8": {
        "comparisons": several("fits/theory/{compared}.nc", compared=SIMULATED),
        "gamma": f"{RESULTS}/fits/gamma.nc",
        "kappa": several("fits/kappa/{case}.nc", case=MAGNIFICATIONS),
        "lattices": several("persson/lattice/{case}.nc", case=MAGNIFICATIONS),
    },
    "fig9": {
        "compared": f"{RESULTS}/criteria/compared.nc",
        "verdicts": f"{RESULTS}/criteria/verdicts.nc",
    },
    "fig10": {
        "edges": several("adhesion/edges/{adhesion}.nc", adhesion=SIMULATED_IN_FULL),
        "ensemble": f"{RESULTS}/contact/ensembles/{ROLES.middle_band}.nc",
        "lattice": f"{RESULTS}/persson/lattice/{ROLES.middle_band}.nc",
        "sweep": f"{RESULTS}/fits/a_v/sweeps/fig3a.nc",
        "fits": several("fits/a_v/ensembles/{case}.nc", case=WITH_EXPONENTS),
    },
    "fig11": {"table": REMAINING_TABLE},
    "fig12": {"compared": f"{RESULTS}/remaining/heights.nc"},
    "fig13": {"table": REMAINING_TABLE},
    "fig14": {
        "ensembles": several(
            "contact/ensembles/{case}.nc", case=[ROLES.middle_band, ROLES.wide_cell]
        ),
        "lattices": several("persson/lattice/{case}.nc", case=[ROLES.middle_band, ROLES.wide_cell]),
    },
}
FIGURES = list(FIGURE_INPUTS)


for figure, files in FIGURE_INPUTS.items():

    rule:
        name:
            f"plot_{figure}"
        input:
            **files,
        output:
            png=report(
                f"{RESULTS}/figures/{figure}.png",
                category="Figures",
                caption=f"../report/{figure}.rst",
            ),
            pdf=f"{RESULTS}/figures/{figure}.pdf",
        log:
            f"{RESULTS}/logs/plot_{figure}/figures/{figure}.log",
        benchmark:
            f"{RESULTS}/benchmarks/plot_{figure}/figures/{figure}.tsv"
        conda:
            "../envs/environment.yaml"
        params:
            pressure=config["criteria"]["a_v"]["pressure"],
            labels={"fig6": {name: LABELS[name] for name in FIG6_SURFACES}, "fig9": LABELS}.get(
                figure, {}
            ),
            figure=figure,  # the path of the script is formatted when the job runs
            code=source_hash(f"figures/plot_{figure}.py"),
        message:
            f"Draw Figure {figure.removeprefix('fig')}"
        script:
            "../scripts/figures/plot_{params.figure}.py"
