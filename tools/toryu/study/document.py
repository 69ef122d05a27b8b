"""A study file with its faults: each is told with its line, what was found, and what is allowed."""

import difflib
import math

from toryu import printable
from toryu.case import BadCase, resolve

REQUIRED = object()
KINDS = {str: "text", bool: "true or false", float: "a finite number", int: "an integer", list: "a list", dict: "a table"}


class BadStudy(Exception):
    """Faults of a study file, a line each, ready to be shown."""


def did_you_mean(word, allowed):
    near = difflib.get_close_matches(str(word), [str(a) for a in allowed], n=1, cutoff=0.5)
    return f"; did you mean '{near[0]}'?" if near else ""


def one_of(allowed):
    return ", ".join(f"'{a}'" for a in allowed) or "none that there are"


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


def found(value):
    text = f"'{value}'" if isinstance(value, str) else str(value).lower() if isinstance(value, bool) else str(value)
    return text if len(text) <= 100 else f"{text[:97]}..."


def is_label(value):
    """Whether `value` can stand in a table, a chart and a file name."""
    return bool(value.strip()) and value.isprintable()


class Document:
    """The file as the coupler reads it; its tables collect faults, `end` raises them all at once."""

    def __init__(self, path, coupler):
        self.faults = []
        try:
            case = resolve(path, coupler)
        except BadCase as error:
            raise BadStudy(str(error)) from None
        self.path, self.name, self.content = case.file, case.name, case.content
        self.text = case.file.read_text(encoding="utf-8", errors="replace")
        # (path of a table, key) -> line; the key of a table itself is ""
        self.lines = {}
        for parts, line, _ in case.places:
            self.lines[tuple(parts), ""] = self.lines[tuple(parts[:-1]), parts[-1]] = line

    def root(self):
        return Table(self, self.content, (), "the file")

    def line(self, path, key):
        """The line of a key, else of its table."""
        while True:
            if number := self.lines.get((path, key)) or self.lines.get((path, "")):
                return number
            if not path:
                return None
            path, key = path[:-1], path[-1]  # an inline table stands where its key does

    def fault(self, text, path=(), key=""):
        self.faults.append((self.line(path, key) or 0, text))

    def end(self):
        if self.faults:
            raise BadStudy("\n".join(f"{self.path}{f':{line}' if line else ''}: error: {printable(text)}"
                                     for line, text in sorted(self.faults)))


class Table:
    """A table of the file. Every key that is asked for is known; `close` reports the others."""

    def __init__(self, document, content, path, name):
        self.document, self.content, self.path, self.name = document, content, path, name
        self.known = []

    def fault(self, text, key=""):
        self.document.fault(text, self.path, key)

    def has(self, key):
        return key in self.content

    def get(self, key, kind, default=REQUIRED, allowed=None):
        """The value of `key` if it is of the kind and one of the allowed, else the default and a fault."""
        self.known.append(key)
        substitute = None if default is REQUIRED else default
        if key not in self.content:
            if default is REQUIRED:
                self.fault(f"{self.name} needs '{key}', {KINDS[kind]}")
            return substitute
        value = self.content[key]
        right = is_number(value) and (kind is float or isinstance(value, int)) if kind in (float, int) \
            else isinstance(value, kind)
        if not right:
            self.fault(f"'{key}' must be {KINDS[kind]}, found {found(value)}", key)
            return substitute
        if allowed is not None and value not in allowed:
            self.fault(f"'{key}' must be one of {one_of(allowed)}, found {found(value)}{did_you_mean(value, allowed)}",
                       key)
            return substitute
        return value

    def label(self, key="name"):
        """A text that names something in tables and charts."""
        value = self.get(key, str)
        if value is not None and not is_label(value):
            self.fault(f"'{key}' must be a text of printable characters on one line, not empty, found {value!r:.100}", key)
            return None
        return value

    def unit(self):
        """The unit of what stands in tables and charts, behind a name as name[unit]."""
        value = self.get("unit", str, "")
        if value and (not is_label(value) or set(value) & set('[],"')):
            self.fault(f"'unit' must be a text of printable characters on one line without any of [ ] , \", found "
                       f"{value!r:.100}", "unit")
            return ""
        return value

    def texts(self, key, default=REQUIRED, allowed=None):
        """A list of texts."""
        values = self.get(key, list, default)
        for value in values or []:
            if not isinstance(value, str):
                self.fault(f"'{key}' must be a list of texts, found {found(value)}", key)
            elif allowed is not None and value not in allowed:
                self.fault(f"'{key}' must hold some of {one_of(allowed)}, found '{value}'"
                           f"{did_you_mean(value, allowed)}", key)
        return [v for v in values or [] if isinstance(v, str)]

    def numbers(self, key, count, default=None):
        """A list of `count` ascending numbers, or the default."""
        values = self.get(key, list, default)
        if values is not None and values != default and not (
                len(values) == count and all(map(is_number, values)) and values == sorted(values)):
            self.fault(f"'{key}' must be {count} ascending numbers, found {found(values)}", key)
            return default
        return values

    def table(self, key):
        """The table under `key`, or None."""
        content = self.get(key, dict, None)
        return None if content is None else Table(self.document, content, (*self.path, key), f"[{key}]")

    def tables(self, key):
        """The tables of the list [[key]]."""
        items = self.get(key, list, [])
        if not all(isinstance(item, dict) for item in items):
            self.fault(f"'{key}' must be tables, [[{key}]]", key)
            return []
        return [Table(self.document, item, (*self.path, key, i), f"[[{key}]] {i + 1}") for i, item in enumerate(items)]

    def close(self):
        for key in self.content:
            if key not in self.known:
                self.fault(f"unknown key '{key}' in {self.name}{did_you_mean(key, self.known)}", key)
