"""Table 4.1: shading techniques and illumination models by class, and what of them is here.

The book has four classes: techniques in screen space with empirical models; ray tracing in the space of objects;
energy equilibrium; and hybrids. Each row is one step of the field, and beside it stand the technique and the model
that make it here. Section 4.7 says which do not belong together; `illuminant.comparison.pairs` says it of every pair.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from illuminant.atlas.plate import Check, Plate, Sheet

if TYPE_CHECKING:
    from matplotlib.patches import Rectangle

SCREEN, RAYS, ENERGY, HYBRID = "screen space", "object space, rays", "energy equilibrium", "hybrid"

ROWS = (
    # class, reference, what it added, figure, technique, model, how it is asked for
    (SCREEN, "Bouknight 1970", "constant colour", "4.29", "constant", "bouknight", ""),
    (
        SCREEN,
        "Warnock 1969, Romney 1970",
        "distance attenuation",
        "",
        "constant",
        "bouknight",
        "[atmosphere]",
    ),
    (SCREEN, "Gouraud 1971", "colours interpolated", "4.30", "gouraud", "bouknight", ""),
    (SCREEN, "Newell et al. 1972", "pseudo transparency", "", "constant", "bouknight", "kind filter"),
    (SCREEN, "Phong 1975", "normals interpolated, highlights", "4.31", "phong", "phong", ""),
    (SCREEN, "Duff 1979", "faster form", "", "phong", "phong", "--shading duff"),
    (SCREEN, "Bishop and Weimer 1986", "faster form", "", "phong", "phong", "--shading bishop-weimer"),
    (RAYS, "Catmull 1975", "texture mapping", "", "raytrace", "blinn", "image or pattern"),
    (RAYS, "Blinn and Newell 1976", "reflection mapping", "4.32", "phong", "whitted", "an environment"),
    (RAYS, "Blinn 1977", "incoherent reflection", "", "raytrace", "blinn", ""),
    (RAYS, "Kay and Greenberg 1979", "refraction, attenuation", "", "raytrace", "whitted", "absorption"),
    (RAYS, "Whitted 1980", "recursive coherent rays", "4.33", "raytrace", "whitted", ""),
    (RAYS, "Hall and Greenberg 1983", "incoherent transmission", "4.34", "raytrace", "hall", ""),
    (RAYS, "Cook et al. 1984", "distributed sampling", "", "distributed", "hall", ""),
    (RAYS, "Amanatides 1984", "area sampling", "", "raytrace", "hall", "--cones"),
    (RAYS, "Kajiya 1985", "anisotropic illumination", "", "path", "general", "roughness [x, y]"),
    (RAYS, "Kajiya 1986", "equilibrium in distributed rays", "", "path", "general", ""),
    (ENERGY, "Cook and Torrance 1982", "spectral highlights, energy", "", "raytrace", "cook-torrance", ""),
    (ENERGY, "Goral et al. 1984", "diffuse equilibrium", "", "radiosity", "general", "--solver gauss"),
    (ENERGY, "Cohen and Greenberg 1985", "hemi-cubes, shadows", "4.35", "radiosity", "general", "hemicube:N"),
    (ENERGY, "Immel et al. 1986", "reflecting surfaces", "4.36", "specular-radiosity", "general", ""),
    (ENERGY, "Max, Rushmeier, Nishita", "atmospheric effects", "", "path", "general", "[medium]"),
    (HYBRID, "Wallace et al. 1987", "radiosity and rays", "4.37", "hybrid", "general", ""),
)

ASKS_FOR_RAYS = ("whitted", "hall")
SHADES_CORNERS = ("constant", "gouraud")
SOLVED = ("radiosity", "specular-radiosity", "hybrid")
IN_EQUILIBRIUM = ("bouknight", "general")
LOOKS = {"sensible": "#9fd4c0", "warned": "#f4d58d", "refused": "#e6a89c"}


def draw(quick: bool) -> Sheet:
    """Which technique goes with which model, by colour, and the classes of the book as rows of the data."""
    from illuminant.atlas.chapter_4.compared_room import TECHNIQUES
    from illuminant.comparison import pairs
    from illuminant.plots.style import GREY, new_figure

    verdicts = {(pair.technique, pair.illumination): pair.verdict for pair in pairs()}
    techniques = list(dict.fromkeys(pair.technique for pair in pairs()))
    models = list(dict.fromkeys(pair.illumination for pair in pairs()))
    figures = {
        (options["technique"], options.get("illumination", "general")): number
        for number, options in TECHNIQUES.items()
    }
    figure, axes = new_figure((8.2, 4.6))
    for (technique, model), verdict in verdicts.items():
        x, y = models.index(model), techniques.index(technique)
        axes.add_patch(_cell(x, y, LOOKS[verdict]))
        axes.text(
            x, y - 0.1 if (technique, model) in figures else y, verdict, ha="center", va="center", fontsize=8
        )
        if (technique, model) in figures:
            number = f"figure {figures[technique, model]}"
            axes.text(x, y + 0.24, number, ha="center", va="center", fontsize=7, color=GREY)
    axes.set_xticks(range(len(models)), models)
    axes.set_yticks(range(len(techniques)), techniques)
    axes.set(xlim=(-0.5, len(models) - 0.5), ylim=(len(techniques) - 0.5, -0.5))
    axes.xaxis.tick_top()
    axes.tick_params(length=0)
    for side in axes.spines.values():
        side.set_visible(False)
    refused = [pair for pair, verdict in verdicts.items() if verdict == "refused"]
    no_rays = [(t, m) for t, m in refused if t in SHADES_CORNERS and m in ASKS_FOR_RAYS]
    grows = [(t, m) for t, m in refused if t in SOLVED and m not in IN_EQUILIBRIUM]
    made = [verdicts[row[4], row[5]] for row in ROWS]
    return Sheet(
        picture=figure,
        columns={
            "class of the book": [row[0] for row in ROWS],
            "reference": [row[1] for row in ROWS],
            "addition": [row[2] for row in ROWS],
            "figure": [row[3] for row in ROWS],
            "technique": [row[4] for row in ROWS],
            "illumination model": [row[5] for row in ROWS],
            "asked for by": [row[6] for row in ROWS],
            "verdict": made,
        },
        checks=(
            Check(
                "rows of the book that a sensible pair makes, of 23",
                float(made.count("sensible")),
                "",
                23,
                23,
            ),
            Check(
                "techniques that the rows leave out",
                float(len(set(techniques) - {row[4] for row in ROWS})),
                "",
                at_most=0,
            ),
            Check(
                "models that the rows leave out",
                float(len(set(models) - {row[5] for row in ROWS})),
                "",
                at_most=0,
            ),
            Check(
                "pairs refused for another reason than the two",
                float(len(refused) - len(no_rays) - len(grows)),
                "",
                at_most=0,
            ),
        ),
    )


def _cell(x: int, y: int, colour: str) -> Rectangle:
    from matplotlib.patches import Rectangle

    return Rectangle((x - 0.47, y - 0.44), 0.94, 0.88, facecolor=colour, edgecolor="none")


PLATE = Plate(
    number="4.1",
    kind="table",
    title="Techniques and models by class",
    shows="The classification of shading techniques and illumination models, with the references that introduced "
    "them and the figures that show them; beside each row the technique and the model of ours that make it.",
    claim="Every row of the book is made here by a pair that has a meaning, and every technique and model of ours "
    "has its row; a pair is refused for two reasons alone: the model asks for rays where none are followed, or it "
    "can return more light than it receives where light is solved for (book 4.7).",
    today="The table is one function, `illuminant.comparison.pairs`, and `--technique` and `--illumination` are "
    "chosen independently; what is warned of works and says why it should not be trusted.",
    draw=draw,
    commands=("illuminant compare scenes/demo.toml --size 320x180 --samples 16",),
)
