# SPDX-License-Identifier: MIT
"""What the scripts that draw the validation pages share: style, colours, tables."""
import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt

plt.rcParams.update({"font.size": 9, "axes.grid": True, "grid.alpha": 0.3, "svg.hashsalt": "hearth", "svg.fonttype": "none",
                     "axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False})
BLUE, RED, GREEN, PINK, ORANGE, GREY = "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#777777"


def table(path):
    """Rows of a file of words, then values; lines that begin with # are skipped."""
    lines = [line.split() for line in path.read_text().splitlines() if not line.startswith("#")]
    words = lines[0]
    return [dict(zip(words, (word if not number(word) else float(word) for word in line))) for line in lines[1:]]


def number(word):
    try:
        float(word)
    except ValueError:
        return False
    return True


def column(rows, name):
    return [row[name] for row in rows]


def save(figure, to):
    figure.savefig(to, metadata={"Date": None})
