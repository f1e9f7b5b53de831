# SPDX-License-Identifier: BSD-3-Clause
"""How methods look in the plots: the same in every plot."""
from dataclasses import dataclass, replace

from runs import GIVEN, NOTHING_DONE, REFERENCE, Results

DPI = 150
GREY, PALE = "#444444", "#E3E3E3"


@dataclass(frozen=True)
class Style:
    colour: str
    marker: str
    line: str = "-"
    filled: bool = True


# hues of Okabe and Ito's and of Tol's palettes, which the colour-blind can tell apart;
# the markers tell apart what shares a hue
STYLES = {
    "KSS-ICP": Style("#D55E00", "o"),
    "KSS-ICP (host)": Style("#7A3500", "o", "--", False),
    "KSS-ICP (paper)": Style("#E69F00", "s"),
    "KSS-ICP (paper, host)": Style("#8F6400", "s", "--", False),
    "ICP": Style("#999999", "v"),
    "ICP with scale": Style("#555555", "^"),
    "SAC-IA": Style("#0072B2", "D"),
    "Prerejective": Style("#56B4E9", "P"),
    "FPCS": Style("#009E73", "X"),
    "KFPCS": Style("#004D38", "*"),
    "Open3D RANSAC": Style("#CC79A7", "<"),
    "Open3D FGR": Style("#882255", ">"),
    NOTHING_DONE: Style("#888888", "", ":"),
}
OTHERS = [Style("#332288", "h"), Style("#117733", "d"), Style("#999933", "p"),
          Style("#AA4499", "8"), Style("#44AA99", "H"), Style("#661100", "p")]
NEUTRAL = Style("#444444", "o")
MARKER_SIZES = {"*": 10.5, "P": 8.5, "X": 8.5, "D": 6.0}


def style_of(name: str, results: Results) -> Style:
    """The style of a method; unknown methods take what is free."""
    if name in STYLES:
        return STYLES[name]
    unknown = [method.name for method in results.compared() if method.name not in STYLES]
    return OTHERS[unknown.index(name) % len(OTHERS)]


def in_one_panel(name: str, style: Style) -> dict:
    """How a line is drawn that shares its panel with those of all other methods: KSS-ICP
    upon them, hollow markers upon it, as they would hide."""
    look = _look(style)
    if name == REFERENCE:
        look.update(linewidth=3.2, markersize=8.5, zorder=5)
    return look


def in_own_panel(style: Style, block: str) -> dict:
    """How a line is drawn that has a panel of its own: hollow where the scale is given,
    and larger, so that equal points remain visible."""
    given = block == GIVEN
    look = _look(replace(style, line="--" if given else "-", filled=not given))
    look["zorder"] = 3 if given else 4
    if given:
        look["markersize"] += 2.5
    if style == STYLES[REFERENCE]:
        look["linewidth"] = 3.2
    return look


def in_background() -> dict:
    """How KSS-ICP is drawn in the panels of other methods."""
    return {"color": STYLES[REFERENCE].colour, "alpha": 0.3, "linewidth": 3.2, "zorder": 2}


def _look(style: Style) -> dict:
    return {"color": style.colour, "linestyle": style.line, "linewidth": 1.6,
            "marker": style.marker, "markersize": MARKER_SIZES.get(style.marker, 6.5),
            "markerfacecolor": style.colour if style.filled else "white",
            "markeredgecolor": "white" if style.filled else style.colour,
            "markeredgewidth": 0.7 if style.filled else 1.3, "clip_on": False,
            "zorder": 3 if style.filled else 6}


def tidy(panel):
    for side in ("top", "right"):
        panel.spines[side].set_visible(False)
    for side in ("left", "bottom"):
        panel.spines[side].set_color("#AAAAAA")
    panel.tick_params(colors=GREY, which="both", labelleft=True)
    panel.grid(axis="y", color=PALE, linewidth=0.8)
    panel.set_axisbelow(True)
