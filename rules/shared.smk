# What every rule with a script has: an environment, a log, a benchmark, and the code that it runs.


def mirrored(output, kind, name, ending):
    """File of a job's log or benchmark: below its rule's name, the path of its first result."""
    folders = {placed(folder): folder for folder in (TRADEOFF, REMAINING, RESULTS)}
    place = next((place for place in folders if output.startswith(f"{place}/")), placed(RESULTS))
    path = output.removeprefix(f"{place}/").rsplit(".", 1)[0]
    return f"{folders[place]}/{kind}/{name}/{path}{ending}"


def share(each):
    """Give a rule with a script what all have.

    A job's parameters hold a hash of its code, so that it runs again when code that it uses
    changes, and not for comments, docstrings or times of change (profiles/default leaves out
    Snakemake's own trigger, which goes by the script's time and does not see what it imports).
    """
    path, output = each.script.format(params=each.params), str(each.output[0])
    each.log_modifier = each.benchmark_modifier = MODIFIER.path_modifier
    each.conda_env = f"{PROJECT}/envs/environment.yaml"
    each.set_log(mirrored(output, "logs", Path(path).stem, ".log"))
    each.benchmark = mirrored(output, "benchmarks", Path(path).stem, ".tsv")
    if workflow.is_main_process:  # which alone decides and records what is up to date
        each.set_params(code=source_hash.code_of(SCRIPTS, path))


for each in MODIFIER.rules:  # in a module those of this workflow alone
    if each.script:
        share(each)
if workflow.is_main_process:
    source_hash.remember()
