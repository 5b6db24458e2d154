# Published experiments, and simulations of others, compared with predictions and every criterion.


rule predict_experiments:
    input:
        template=project_file("report/experiments.md.j2"),
    output:
        dataset=f"{RESULTS}/experiments/experiments.nc",
        table=report(
            f"{RESULTS}/experiments/experiments.md",
            category="Experiments",
            caption="../report/experiments.rst",
        ),
        png=report(
            f"{RESULTS}/figures/experiments.png",
            category="Figures",
            caption="../report/experiments.rst",
        ),
        pdf=f"{RESULTS}/figures/experiments.pdf",
    log:
        f"{RESULTS}/logs/predict_experiments/experiments/experiments.log",
    benchmark:
        f"{RESULTS}/benchmarks/predict_experiments/experiments/experiments.tsv"
    conda:
        "../envs/environment.yaml"
    params:
        experiments=EXPERIMENTS,
        code=source_hash("experiments/predict_experiments.py"),
    message:
        "Predict published experiments"
    script:
        "../scripts/experiments/predict_experiments.py"
