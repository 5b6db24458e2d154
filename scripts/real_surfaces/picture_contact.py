"""Contact and pull-off of measured heights, simulated, for the picture of both on a page."""

from dataclasses import replace

from common.job import start
from stickiness import datasets
from stickiness.entries.material import Material
from stickiness.pages.pressed_heights import picture_contact
from stickiness.verdicts.rough_surface import Surface, read_measurements


def main(job):
    params = job.params
    name = job.wildcards.real_surface
    # Files of surfaces do not keep the heights.
    surface = replace(
        Surface.open(job.input.surface), measurements=read_measurements(params.surface)
    )
    # A material that is rough itself is left out, whatever its own surface is.
    own_surface = {params.entry["surface"]: surface}
    picture = picture_contact(surface, Material.from_entry(params.entry, own_surface))
    datasets.write(
        picture.contact,
        job.output.contact,
        title=f"where the heights of {name} touch",
        parameters={"surface": name, **params.surface},
    )
    datasets.write(
        picture.pull_off,
        job.output.pull_off,
        title=f"pull-off of {params.material} from {name}",
        parameters={"surface": name, "material": params.material, **params.entry},
    )


if __name__ == "__main__":
    main(start(globals()))
