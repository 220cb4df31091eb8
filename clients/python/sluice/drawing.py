"""Matplotlib without pyplot, and without what takes a third of its import: the tables of properties that it writes into the
docstrings of its classes. They are as ever for whoever imports it first.
"""

from matplotlib import artist

_kwdoc, artist.kwdoc = artist.kwdoc, lambda _: ""
try:
    import matplotlib
    from matplotlib.cm import ScalarMappable
    from matplotlib.collections import PolyCollection
    from matplotlib.colors import LinearSegmentedColormap, ListedColormap, Normalize
    from matplotlib.figure import Figure
    from matplotlib.patches import Rectangle
finally:
    artist.kwdoc = _kwdoc

__all__ = [
    "Figure", "LinearSegmentedColormap", "ListedColormap", "Normalize", "PolyCollection", "Rectangle", "ScalarMappable", "matplotlib", "save",
]


def save(figure, path, dpi):
    """As PNG, SVG or PDF by its name; PNG packed quickly rather than as small as can be."""
    quick = {"pil_kwargs": {"compress_level": 3}} if path.suffix.lower() == ".png" else {}
    figure.savefig(path, dpi=dpi, **quick)
