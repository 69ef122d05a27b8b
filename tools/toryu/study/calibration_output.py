"""What a calibration found: its answer, what could not be found, and the files that other cases and studies take."""

import csv
import math

import numpy as np

from toryu.processes import BAD_INPUT
from toryu.program import whole_file
from toryu.report import tables
from toryu.study.answer import Answer
from toryu.study.calibrated import COVARIANCE
from toryu.study.settings import toml

FRAGMENT = "calibration.toml"
CLOSE = 0.98  # correlation of parameters beyond which they are hardly told apart
UNLIKELY = 0.05  # probability below which a chi squared speaks against the model, above its complement for less scatter
FIXED = ["parameter", "unit", "scale", "proportional", "keys", "value", "error"]  # columns before the covariances
# What tells of a parameter, by the beginning of its key.
TELLING = {
    "fluid.removal": "depths on a face that the medium slides along",
    "fluid.wall_slip": "a pressure drop at a given speed, or a speed at a given pressure, in passages of two widths: slip "
                       "rules in the narrow one, shear in the wide one",
    "fluid.friction": "a pressure drop under two back pressures: friction grows with the pressure, slip does not",
    "fluid.power_law": "a pressure drop at two speeds that differ by a factor of 3 and more",
}
OTHERWISE = "a pressure drop or a speed in passages of two widths"


def answers(view, study, out):
    """Writes the files of a calibration that has found its parameters; without one, none of a former is left."""
    for name in (FRAGMENT, COVARIANCE):
        (out / name).unlink(missing_ok=True)
    if view.fit is None:
        return []
    if untold := view.fit.untold():
        view.failure, view.failed_code = " ".join(sentence_of_untold(view, names) for names in untold), BAD_INPUT
        return [Answer("What the measurements do not tell", view.failure, residuals(view))]
    write_fragment(view, study, out / FRAGMENT)
    write_covariance(view, out / COVARIANCE)
    sentences = [", ".join(map(in_words, view.parameters, view.fit.point, errors(view))) + ".", verdict(view.fit),
                 *close_pairs(view), *at_bounds(view)]
    if not view.fit.converged:
        sentences.append("The search ended before the next step was small: the runs are noisier than the scatter allows, or "
                         "'step' is too small.")
    return [Answer("What the measurements tell", " ".join(sentences), parameters(view) + residuals(view))]


def errors(view):
    """Standard error of each parameter, of its logarithm if it is fitted by that."""
    return np.sqrt(np.diag(view.fit.covariance()))


def correlation(view):
    deviations = errors(view)
    return view.fit.covariance() / np.outer(deviations, deviations)


def in_words(parameter, scaled, error):
    unit = f" {parameter.axis.unit}" if parameter.axis.unit else ""
    around = f"{error * 100:.2g} %" if parameter.log else f"{error:.2g}{unit}"
    return f"{parameter.name.replace('_', ' ')} {parameter.value(scaled):.4g}{unit} ± {around}"


def verdict(fit):
    """Whether the model describes the data within their scatter."""
    if fit.freedom == 0:
        return "There are as many parameters as measured values, so nothing is left to judge the model by."
    text = (f"Chi squared is {fit.chi_squared:.3g} over {fit.freedom} degree{'s' * (fit.freedom > 1)} of freedom, exceeded "
            f"by chance with a probability of {fit.probability:.2g}: ")
    if fit.probability < UNLIKELY:
        return text + ("the model does not describe the data within their scatter; either it lacks something, or the "
                       "scatter is larger than stated, and so are the errors of the parameters.")
    if fit.probability > 1 - UNLIKELY:
        return text + "the data lie closer to the model than their scatter; it may be stated too large."
    return text + "the model describes the data within their scatter."


def names_of(view, numbers):
    return " and ".join(f"'{view.parameters[j].name}'" for j in numbers)


def telling(view, numbers):
    """What to measure in addition."""
    keys = [key for j in numbers for key in view.parameters[j].keys]
    if any(datum.coupon for datum in view.data):  # depths are there: what they tell together with others is to be parted
        keys = [key for key in keys if not key.startswith("fluid.removal")] or keys
    found = {next((text for start, text in TELLING.items() if key.startswith(start)), OTHERWISE) for key in keys}
    return "; ".join(sorted(found))


def sentence_of_untold(view, numbers):
    what = ("cannot be found: what was measured hardly depends on it" if len(numbers) == 1 else
            "cannot be told apart: what was measured hardly changes if they change together")
    return f"{names_of(view, numbers)} {what}. Measure in addition {telling(view, numbers)}."


def close_pairs(view):
    """Sentences on parameters that are hardly told apart."""
    of = correlation(view)
    return [f"{names_of(view, (i, j))} are hardly told apart (correlation {of[i, j]:.3f}); measure in addition "
            f"{telling(view, (i, j))}."
            for i in range(len(of)) for j in range(i + 1, len(of)) if abs(of[i, j]) > CLOSE]


def at_bounds(view):
    sides = [(p.name, bound) for p, scaled in zip(view.parameters, view.fit.point) for bound in p.bounds
             if math.isclose(p.value(scaled), bound, rel_tol=1e-6)]
    return [f"'{name}' ended at its bound {bound:g}: its error says nothing there." for name, bound in sides]


def parameters(view):
    """Values, errors, correlation as tables."""
    rows = []
    for parameter, scaled, error in zip(view.parameters, view.fit.point, errors(view)):
        value = parameter.value(scaled)
        deviation = error * value if parameter.log else error
        rows.append([parameter.name, ", ".join(parameter.keys), f"{value:.6g}", f"{deviation:.3g}", parameter.axis.unit,
                     f"{parameter.start:g}"])
    of = [[p.name, *(f"{value:.3f}" for value in row)] for p, row in zip(view.parameters, correlation(view))]
    return (tables.table(["parameter", "key of the case", "value", "standard error", "unit", "start"], rows)
            + tables.table(["correlation", *(p.name for p in view.parameters)], of))


def residuals(view):
    rows = [[d.name, d.unit, f"{d.measured:.5g}", f"{d.scatter:.3g}", f"{c:.5g}", f"{(c - d.measured) / d.scatter:+.2f}"]
            for d, c in zip(view.data, view.computed)]
    return tables.table(["measured", "unit", "value", "scatter", "computed", "difference in units of the scatter"], rows)


def write_fragment(view, study, path):
    """The fitted keys as a case that others take as their base."""
    lines = [f"# Fitted to measurements by the study {study.file_name}; the uncertainty is in {COVARIANCE}."]
    values = {}
    for parameter, scaled, error in zip(view.parameters, view.fit.point, errors(view)):
        lines.append(f"# {in_words(parameter, scaled, error)}")
        values |= dict.fromkeys(parameter.keys, parameter.value(scaled))
    with whole_file(path) as file:
        file.write("\n".join(lines) + "\n")
        for table in dict.fromkeys(key.rpartition(".")[0] for key in values):
            file.write(f"\n[{table}]\n")
            file.writelines(f"{key.rpartition('.')[2]} = {toml(value)}\n" for key, value in values.items()
                            if key.rpartition(".")[0] == table)


def write_covariance(view, path):
    """A row a parameter: value, standard error and covariances, of the logarithm where that was fitted."""
    with whole_file(path) as file:
        writer = csv.writer(file)
        writer.writerow([*FIXED, *(f"covariance with {p.name}" for p in view.parameters)])
        for p, scaled, error, row in zip(view.parameters, view.fit.point, errors(view), view.fit.covariance()):
            writer.writerow([p.name, p.axis.unit, "logarithm" if p.log else "value", p.law or "", " ".join(p.keys),
                             repr(p.value(scaled)), f"{error:.6g}", *(f"{value:.9g}" for value in row)])
