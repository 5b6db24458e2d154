# What every rule with a script has: an environment, a log, a benchmark, and the code that it runs.


def mirrored(output, kind, name, ending):
    """File of a job's log or benchmark: below its rule's name, the path of its first result."""
    folder = next(
        folder for folder in (RESULTS, TRADEOFF, REMAINING) if output.startswith(f"{folder}/")
    )
    path = output.removeprefix(f"{folder}/").rsplit(".", 1)[0]
    return f"{folder}/{kind}/{name}/{path}{ending}"


# A job's parameters hold a hash of its code, so that it runs again when code that it uses changes,
# and not for comments, docstrings or times of change (profiles/default leaves out Snakemake's own
# trigger, which goes by the script's time and does not see what a script imports).
for each in workflow.rules:
    if each.script:
        each.log_modifier = each.benchmark_modifier = workflow.modifier.path_modifier
        each.conda_env = f"{workflow.basedir}/envs/environment.yaml"
        each.set_log(mirrored(str(each.output[0]), "logs", each.name, ".log"))
        each.benchmark = mirrored(str(each.output[0]), "benchmarks", each.name, ".tsv")
        if workflow.is_main_process:  # which alone decides and records what is up to date
            each.set_params(code=code_of(SCRIPTS, each.script.format(params=each.params)))
