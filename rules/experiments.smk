# Published experiments, and simulations of others, predicted and held against every criterion.


rule predict_experiments:
    output:
        dataset=f"{RESULTS}/experiments/experiments.nc",
        table=report(
            f"{RESULTS}/experiments/experiments.md",
            category="Experiments",
            caption="../report/experiments.rst",
        ),
    params:
        experiments=EXPERIMENTS,
    script:
        "../scripts/experiments/predict_experiments.py"


rule plot_experiments:
    input:
        f"{RESULTS}/experiments/experiments.nc",
    output:
        png=report(
            f"{RESULTS}/figures/experiments.png",
            category="Figures",
            caption="../report/experiments.rst",
        ),
        pdf=f"{RESULTS}/figures/experiments.pdf",
    script:
        "../scripts/experiments/plot_experiments.py"
