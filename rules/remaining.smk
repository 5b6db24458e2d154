# How much adhesion remains, by models of increasing cost.

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
