"""Draw docs/stages.svg and docs/rules.svg: which stage, and which rule, needs what another makes.

python docs/draw_rules.py

A picture is drawn anew only if a name or an arrow changed, so that fonts change no file.
"""

from __future__ import annotations

import html
import re
import subprocess
import sys
from collections.abc import Iterable
from functools import cache
from pathlib import Path

ROOT = Path(__file__).parents[1]
STAGES, RULES = (ROOT / f"docs/{name}.svg" for name in ("stages", "rules"))
TARGETS = ("all", "tradeoff", "stability", "remaining_measured", "dmt_error")

FIGURES = "plot_fig1 … plot_fig11"

Arrow = tuple[str, str]
Graph = tuple[set[str], set[Arrow]]  # names and arrows between them
COMMON = {"fontname": "sans-serif", "fontsize": "11"}
BOX = COMMON | {"shape": "box", "style": "rounded,filled", "height": "0.3", "margin": "0.1,0.05"}
BLUE, GREY = "#d9e8f6", "#f2f2f2"


def stage_of() -> dict[str, str]:
    """Stage of every rule that has a script; the rules of the figures are one."""
    stages = [path.stem for path in ROOT.glob("rules/*.smk")]
    scripts = {path.stem: s for s in stages for path in ROOT.glob(f"scripts/{s}/*.py")}
    return {one_for_all(rule): stage for rule, stage in scripts.items()}


def one_for_all(rule: str) -> str:
    """Name of a rule, for rules of figures the same one."""
    return re.sub(r"^plot_fig\d+$", FIGURES, rule)


def read_graph() -> Graph:
    """Rules and pairs of rules (maker, user) by Snakemake, targets left out."""
    command = [sys.executable, "-m", "snakemake", "--rulegraph", "dot", "--", *TARGETS]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    if done.returncode:
        sys.exit(done.stderr)
    names = dict(re.findall(r'^\s*(\d+)\[label = "([^"]+)"', done.stdout, re.M))
    names = {number: one_for_all(rule) for number, rule in names.items()}
    arrows = re.findall(r"^\s*(\d+) -> (\d+)$", done.stdout, re.M)
    rules = stage_of().keys() & names.values()
    found = {(names[maker], names[user]) for maker, user in arrows}
    return rules, {(maker, user) for maker, user in found if maker in rules and user in rules}


def gather_stages(graph: Graph) -> Graph:
    """Stages and pairs of stages (maker, user) of a graph of rules."""
    stage, (rules, arrows) = stage_of(), graph
    pairs = {(stage[maker], stage[user]) for maker, user in arrows}
    return {stage[rule] for rule in rules}, {(a, b) for a, b in pairs if a != b}


def reduce_arrows(arrows: Iterable[Arrow]) -> set[Arrow]:
    """Leave out every arrow that follows from others; there must be no circle."""
    users: dict[str, set[str]] = {}
    for maker, user in arrows:
        users.setdefault(maker, set()).add(user)

    @cache
    def below(name: str) -> set[str]:
        return set().union(*({user} | below(user) for user in users.get(name, ())))

    return {
        (maker, user)
        for maker, several in users.items()
        for user in several
        if not any(user in below(other) for other in several - {user})
    }


def wanted() -> dict[Path, Graph]:
    """What both pictures are to show, by their file: all stages; rules of those that are joined."""
    stage, graph = stage_of(), read_graph()
    stages, between = gather_stages(graph)
    joined = {name for arrow in between for name in arrow}
    rules = {rule for rule in graph[0] if stage[rule] in joined}
    arrows = {(maker, user) for maker, user in graph[1] if {maker, user} <= rules}
    return {STAGES: (stages, reduce_arrows(between)), RULES: (rules, reduce_arrows(arrows))}


def shown(picture: Path) -> Graph:
    """What a picture shows, by the titles that Graphviz writes into it."""
    text = picture.read_text(encoding="utf-8") if picture.exists() else ""
    blocks = re.findall(r'class="(node|edge)">\s*<title>([^<]+)</title>', text)
    titles = {kind: [html.unescape(t) for k, t in blocks if k == kind] for kind in ("node", "edge")}
    return set(titles["node"]), {tuple(title.split("->")) for title in titles["edge"]}


def draw(picture: Path, graph: Graph, frames: dict[str, list[str]]) -> None:
    """Draw a graph; the names of each of the frames stand together."""
    from pygraphviz import AGraph  # of envs/docs.txt: all else here does without

    names, arrows = graph
    drawn = AGraph(directed=True, rankdir="TB", ranksep="0.35", nodesep="0.2", bgcolor="white")
    drawn.node_attr.update(BOX | {"fillcolor": BLUE, "color": "#4477aa"})
    drawn.edge_attr.update(color="#555555", arrowsize="0.6")
    drawn.add_nodes_from(sorted(names))
    for title, inside in frames.items():
        label = {"label": title, "labeljust": "l", "color": "#aaaaaa", "bgcolor": GREY}
        drawn.add_subgraph(inside, f"cluster_{title}", **label, **COMMON)
    drawn.add_edges_from(sorted(arrows))
    drawn.draw(picture, format="svg", prog="dot")


def main() -> None:
    """Draw what changed."""
    stages = sorted(stage_of().items())
    for picture, graph in wanted().items():
        if shown(picture) == graph:
            continue
        frames: dict[str, list[str]] = {}
        for rule, stage in stages if picture == RULES else ():
            if rule in graph[0]:
                frames.setdefault(stage, []).append(rule)
        draw(picture, graph, frames)


if __name__ == "__main__":
    main()
