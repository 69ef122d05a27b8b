"""Formulas in a study file: arithmetic and a few functions of named numbers, and nothing else."""

import ast
import math
import operator

from toryu.study.document import did_you_mean, found, one_of

OPERATORS = {ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul, ast.Div: operator.truediv,
             ast.Pow: operator.pow, ast.USub: operator.neg, ast.UAdd: operator.pos}
FUNCTIONS = {name: getattr(math, name) for name in
             ("sqrt", "exp", "log", "log10", "sin", "cos", "tan", "atan", "sinh", "cosh", "tanh")}
FUNCTIONS |= {"abs": abs, "min": min, "max": max}
CONSTANTS = {"pi": math.pi}


class BadFormula(Exception):
    """What is wrong with a formula, ready to be shown."""


class Formula:
    """A formula that was found to hold known names only: `Formula("2*x + a", ["x", "a"])(x=1, a=3)` is 5. Where it is not
    defined (a division by zero, a root of a negative number) its value is nan."""

    def __init__(self, text, names):
        self.text = text
        try:
            self.tree = ast.parse(text, mode="eval").body
        except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
            raise BadFormula(f"{found(text)} is no formula: {getattr(error, 'msg', error)}") from None
        self.names = set()
        try:
            self._check(self.tree, names)
        except RecursionError:
            raise BadFormula(f"{found(text)} goes too deep") from None

    def _check(self, node, names):
        if isinstance(node, ast.Constant) and type(node.value) in (int, float):
            return
        if isinstance(node, ast.Name):
            if node.id not in names and node.id not in CONSTANTS:
                raise BadFormula(f"'{self.text}' has the unknown name '{node.id}'{did_you_mean(node.id, names)}; there "
                                 f"are {one_of([*names, *CONSTANTS])}")
            if node.id not in CONSTANTS:
                self.names.add(node.id)
        elif isinstance(node, ast.BinOp) and type(node.op) in OPERATORS:
            self._check(node.left, names)
            self._check(node.right, names)
        elif isinstance(node, ast.UnaryOp) and type(node.op) in OPERATORS:
            self._check(node.operand, names)
        elif isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and not node.keywords and node.args:
            if node.func.id not in FUNCTIONS:
                raise BadFormula(f"'{self.text}' has the unknown function '{node.func.id}'"
                                 f"{did_you_mean(node.func.id, FUNCTIONS)}; there are {one_of(FUNCTIONS)}")
            for argument in node.args:
                self._check(argument, names)
        else:
            raise BadFormula(f"'{self.text}' holds '{ast.unparse(node)}': a formula has numbers, names, + - * / ** and "
                             f"{one_of(FUNCTIONS)} only")

    def __call__(self, **values):
        try:
            value = self._value(self.tree, CONSTANTS | values)
        except (ArithmeticError, ValueError, TypeError):  # TypeError: a text in the place of a number
            return math.nan
        return float(value) if isinstance(value, (int, float)) else math.nan  # a root of a negative number is complex

    def _value(self, node, values):
        if isinstance(node, ast.Constant):
            return float(node.value)
        if isinstance(node, ast.Name):
            return values[node.id]
        if isinstance(node, ast.BinOp):
            return OPERATORS[type(node.op)](self._value(node.left, values), self._value(node.right, values))
        if isinstance(node, ast.UnaryOp):
            return OPERATORS[type(node.op)](self._value(node.operand, values))
        return FUNCTIONS[node.func.id](*(self._value(argument, values) for argument in node.args))


def read_formula(table, key, names):
    """The formula under `key` of a table of a study file, or None after a fault."""
    text = table.get(key, str)
    if text is None:
        return None
    try:
        return Formula(text, names)
    except BadFormula as error:
        table.fault(f"'{key}': {error}", key)
        return None
