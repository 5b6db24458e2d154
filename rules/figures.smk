# The paper's six figures, with what was measured added, one on where the DMT limit holds and one on
# where the theory does.

FIGURE_2_CASES = ["H0.8_zeta32", "H0.8_zeta64", "H0.8_zeta128"]


rule plot_fig1:
    input:
        library=library_of("figures/plot_fig1.py"),
        density=f"{RESULTS}/persson/sweeps/fig1a.nc",
        convergence=f"{RESULTS}/persson/sweeps/fig1b.nc",
        ensemble=f"{RESULTS}/contact/ensembles/H0.8_zeta64.nc",
        lattice=f"{RESULTS}/persson/lattice/H0.8_zeta64.nc",
    output:
        png=report(
            f"{RESULTS}/figures/fig1.png",
            category="Figures",
            caption="../report/fig1.rst",
        ),
        pdf=f"{RESULTS}/figures/fig1.pdf",
    log:
        f"{LOGS}/plot_fig1.log",
    benchmark:
        f"{BENCHMARKS}/plot_fig1.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=500,
    script:
        "../scripts/figures/plot_fig1.py"


rule plot_fig2:
    input:
        library=library_of("figures/plot_fig2.py"),
        kappa=expand(f"{RESULTS}/fits/kappa/{{case}}.nc", case=FIGURE_2_CASES),
        ensembles=expand(f"{RESULTS}/contact/ensembles/{{case}}.nc", case=FIGURE_2_CASES),
        lattices=expand(f"{RESULTS}/persson/lattice/{{case}}.nc", case=FIGURE_2_CASES),
        maps=f"{RESULTS}/contact/H0.8_zeta64/maps.nc",
        adhesion=f"{RESULTS}/adhesion/dmt/fig2.nc",
        adhesive=f"{RESULTS}/adhesion/full/fig2.nc",
        adhesive_maps=f"{RESULTS}/adhesion/full/fig2/maps.nc",
    output:
        png=report(
            f"{RESULTS}/figures/fig2.png",
            category="Figures",
            caption="../report/fig2.rst",
        ),
        pdf=f"{RESULTS}/figures/fig2.pdf",
    log:
        f"{LOGS}/plot_fig2.log",
    benchmark:
        f"{BENCHMARKS}/plot_fig2.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=1000,
    script:
        "../scripts/figures/plot_fig2.py"


rule plot_fig3:
    input:
        library=library_of("figures/plot_fig3.py"),
        sweeps=expand(f"{RESULTS}/persson/sweeps/fig3{{panel}}.nc", panel=list("abcd")),
        fits=expand(f"{RESULTS}/fits/a_v/sweeps/fig3{{panel}}.nc", panel=list("abcd")),
        bem=expand(f"{RESULTS}/contact/ensembles/{{case}}.nc", case=COMPLETE),
        bem_fits=expand(f"{RESULTS}/fits/a_v/ensembles/{{case}}.nc", case=COMPLETE),
        lattice_fits=expand(f"{RESULTS}/fits/a_v/lattice/{{case}}.nc", case=COMPLETE),
    output:
        png=report(
            f"{RESULTS}/figures/fig3.png",
            category="Figures",
            caption="../report/fig3.rst",
        ),
        pdf=f"{RESULTS}/figures/fig3.pdf",
    log:
        f"{LOGS}/plot_fig3.log",
    benchmark:
        f"{BENCHMARKS}/plot_fig3.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=500,
    script:
        "../scripts/figures/plot_fig3.py"


rule plot_fig4:
    input:
        library=library_of("figures/plot_fig4.py"),
        loop=f"{RESULTS}/adhesion/loops/fig4a.nc",
        rough=f"{RESULTS}/adhesion/full/fig4b_rough.nc",
        smooth=f"{RESULTS}/adhesion/full/fig4b_smooth.nc",
        a_v=[f"{RESULTS}/fits/a_v/ensembles/{case}.nc" for case in ("H0.8_zeta64", "H0.8_zeta128")],
    output:
        png=report(
            f"{RESULTS}/figures/fig4.png",
            category="Figures",
            caption="../report/fig4.rst",
        ),
        pdf=f"{RESULTS}/figures/fig4.pdf",
    log:
        f"{LOGS}/plot_fig4.log",
    benchmark:
        f"{BENCHMARKS}/plot_fig4.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=500,
    params:
        pressure=config["criteria"]["a_v"]["pressure"],
    script:
        "../scripts/figures/plot_fig4.py"


rule plot_fig5:
    input:
        library=library_of("figures/plot_fig5.py"),
        map=f"{RESULTS}/criteria/map.nc",
    output:
        png=report(
            f"{RESULTS}/figures/fig5.png",
            category="Figures",
            caption="../report/fig5.rst",
        ),
        pdf=f"{RESULTS}/figures/fig5.pdf",
    log:
        f"{LOGS}/plot_fig5.log",
    benchmark:
        f"{BENCHMARKS}/plot_fig5.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=500,
    script:
        "../scripts/figures/plot_fig5.py"


rule plot_fig6:
    input:
        library=library_of("figures/plot_fig6.py"),
        surfaces=expand(f"{RESULTS}/real_surfaces/{{real_surface}}.nc", real_surface=REAL_SURFACES),
    output:
        png=report(
            f"{RESULTS}/figures/fig6.png",
            category="Figures",
            caption="../report/fig6.rst",
        ),
        pdf=f"{RESULTS}/figures/fig6.pdf",
    log:
        f"{LOGS}/plot_fig6.log",
    benchmark:
        f"{BENCHMARKS}/plot_fig6.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=500,
    script:
        "../scripts/figures/plot_fig6.py"


rule plot_fig7:
    input:
        library=library_of("figures/plot_fig7.py"),
        adhesive=f"{RESULTS}/adhesion/full/dmt_error.nc",
    output:
        png=report(
            f"{RESULTS}/figures/fig7.png",
            category="Figures",
            caption="../report/fig7.rst",
        ),
        pdf=f"{RESULTS}/figures/fig7.pdf",
    log:
        f"{LOGS}/plot_fig7.log",
    benchmark:
        f"{BENCHMARKS}/plot_fig7.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=500,
    params:
        pressure=config["criteria"]["a_v"]["pressure"],
    script:
        "../scripts/figures/plot_fig7.py"


rule plot_fig8:
    input:
        library=library_of("figures/plot_fig8.py"),
        comparisons=expand(f"{RESULTS}/fits/theory/{{compared}}.nc", compared=COMPARED),
        gamma=f"{RESULTS}/fits/gamma.nc",
    output:
        png=report(
            f"{RESULTS}/figures/fig8.png",
            category="Figures",
            caption="../report/fig8.rst",
        ),
        pdf=f"{RESULTS}/figures/fig8.pdf",
    log:
        f"{LOGS}/plot_fig8.log",
    benchmark:
        f"{BENCHMARKS}/plot_fig8.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=500,
    script:
        "../scripts/figures/plot_fig8.py"


rule plot_fig9:
    input:
        library=library_of("figures/plot_fig9.py"),
        compared=f"{RESULTS}/criteria/compared.nc",
        verdicts=f"{RESULTS}/criteria/verdicts.nc",
    output:
        png=report(
            f"{RESULTS}/figures/fig9.png",
            category="Figures",
            caption="../report/fig9.rst",
        ),
        pdf=f"{RESULTS}/figures/fig9.pdf",
    log:
        f"{LOGS}/plot_fig9.log",
    benchmark:
        f"{BENCHMARKS}/plot_fig9.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=500,
    script:
        "../scripts/figures/plot_fig9.py"


rule plot_fig10:
    input:
        library=library_of("figures/plot_fig10.py"),
        edges=simulated_edges(),
    output:
        png=report(
            f"{RESULTS}/figures/fig10.png",
            category="Figures",
            caption="../report/fig10.rst",
        ),
        pdf=f"{RESULTS}/figures/fig10.pdf",
    log:
        f"{LOGS}/plot_fig10.log",
    benchmark:
        f"{BENCHMARKS}/plot_fig10.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=500,
    script:
        "../scripts/figures/plot_fig10.py"
