#include "actors/apps/python/shown.hpp"

#include <pybind11/eval.h>

namespace luxodus::python {

namespace py = pybind11;

namespace {

/// In Python, since these types only show what others compute.
constexpr const char* shown_source = R"py(
import html
import types


def _short(value):
    """An array as its shape and range, anything else in at most 60 characters."""
    if hasattr(value, "shape") and value.size:
        import numpy
        if value.dtype.kind == "f" and not numpy.isnan(value).all():
            return (f"{list(value.shape)}, {numpy.nanmin(value):.4g} to "
                    f"{numpy.nanmax(value):.4g}")
        return f"{list(value.shape)}"
    if isinstance(value, dict) and "value" in value and "unit" in value:
        error = value.get("standard_error")
        beside = f" ± {error:.2g}" if error else ""
        return f"{value['value']:.4g}{beside} {value['unit']}"
    text = repr(value)
    return text if len(text) <= 60 else text[:57] + "..."


def _axes(ax):
    if ax is not None:
        return ax
    try:
        from matplotlib import pyplot
    except ImportError:
        raise ImportError("plots need matplotlib (Debian: python3-matplotlib)") from None
    return pyplot.subplots()[1]


class Values(types.SimpleNamespace):
    """Values by name; help() of what returned them says which, and their units."""

    def __repr__(self):
        name = f" {self.name!r}" if hasattr(self, "name") else ""
        return f"<luxodus.{type(self).__name__}{name}: {', '.join(vars(self))}>"

    def _repr_html_(self):
        rows = "".join(f"<tr><th>{html.escape(key)}</th><td>{html.escape(_short(value))}</td></tr>"
                       for key, value in vars(self).items())
        return f"<table>{rows}</table>"


class Plane(Values):
    """A plane of a Run: see Run.planes."""

    def __repr__(self):
        rows, columns = self.illuminance_lx.shape
        mean = self.mean_illuminance["value"]
        return f"<luxodus.Plane {self.name!r}: {columns} x {rows} cells, {mean:.4g} lx on average>"

    def _steps(self):
        """From a cell to the next one along both edges [m]; a plane may have one row or column."""
        import numpy
        grid, normal = self.grid_m, numpy.array(self.normal)
        rows, columns = grid.shape[:2]
        cell = self.area["value"] / (rows * columns)
        u = grid[0, 1] - grid[0, 0] if columns > 1 else None
        v = grid[1, 0] - grid[0, 0] if rows > 1 else None
        if u is None and v is None:
            u = numpy.cross([0, 1, 0] if abs(normal[1]) < 0.9 else [1, 0, 0], normal)
            u *= (cell / u.dot(u)) ** 0.5
        if u is None:
            u = numpy.cross(v, normal) * cell / v.dot(v)
        return u, numpy.cross(normal, u) * cell / u.dot(u) if v is None else v

    def _corners(self):
        """Corners of its cells in plan, or along its edges where it stands upright; and labels."""
        import numpy
        u, v = self._steps()
        rows, columns = self.grid_m.shape[:2]
        i, j = numpy.meshgrid(numpy.arange(columns + 1), numpy.arange(rows + 1))
        if abs(self.normal[2]) < 0.5:
            along = "along the {} edge [m]"
            return (i * numpy.linalg.norm(u), j * numpy.linalg.norm(v),
                    along.format("first"), along.format("second"))
        first = self.grid_m[0, 0] - (u + v) / 2
        return (first[0] + i * u[0] + j * v[0], first[1] + i * u[1] + j * v[1], "x [m]", "y [m]")

    def plot(self, values="illuminance_lx", ax=None, **style):
        """Draws an array of its cells in plan, by its name, and returns the axes of matplotlib.
        style: arguments of pcolormesh."""
        ax = _axes(ax)
        x, y, across, up = self._corners()
        drawn = ax.pcolormesh(x, y, getattr(self, values), **style)
        ax.figure.colorbar(drawn, ax=ax, label=values)
        ax.set(title=self.name, xlabel=across, ylabel=up, aspect="equal")
        return ax


class View(Values):
    """A picture of a Run: see Run.render."""

    def __repr__(self):
        height, width = self.luminance_cd_m2.shape
        return f"<luxodus.View {self.name!r}: {width} x {height} pixels, {self.paths} paths each>"

    def plot(self, values=None, ax=None, **style):
        """Draws luminance on a logarithmic scale, filtered if it is, or another array by its name,
        and returns the axes of matplotlib. style: arguments of imshow."""
        ax = _axes(ax)
        if values is None:
            filtered = "filtered_luminance_cd_m2"
            values = filtered if hasattr(self, filtered) else "luminance_cd_m2"
        if "norm" not in style:
            from matplotlib.colors import LogNorm
            style["norm"] = LogNorm()
        drawn = ax.imshow(getattr(self, values), **style)
        ax.figure.colorbar(drawn, ax=ax, label=values)
        ax.set(title=self.name, xticks=[], yticks=[])
        return ax


class Names(dict):
    """A dict by name."""

    kind = "name"

    def __missing__(self, name):
        known = ", ".join(map(repr, self)) or "none"
        raise KeyError(f"there is no {self.kind} {name!r}; there are: {known}")
)py";

/// The module, which Python keeps once it is loaded.
py::handle shown_module;

py::object type_named(const char* name) {
  return shown_module.attr(name);
}

}  // namespace

void add_shown(py::module_& module) {
  shown_module = module;
  py::dict scope;
  scope["__builtins__"] = py::module_::import("builtins");
  scope["__name__"] = module.attr("__name__");
  py::exec(shown_source, scope);
  for (const char* name : {"Values", "Plane", "View", "Names"}) module.attr(name) = scope[name];
}

py::object shown_as(const char* type, const py::dict& values) {
  return type_named(type)(**values);
}

py::object names_of(const char* kind, const py::dict& by_name) {
  py::object out = type_named("Names")(by_name);
  out.attr("kind") = kind;
  return out;
}

}  // namespace luxodus::python
