"""Damages text and bytes at random, as a slip of the hand, a full disk or a loss of power would."""

import re

NUMBERS = ["0", "-1", "1", "1e308", "-1e308", "5e-324", "nan", "inf", "-inf", "9223372036854775807", "0x7f", "1_000", "1e400"]
VALUES = [*NUMBERS, '""', '"$x_{$"', '"\\u0000"', '"\\u001b[31m"', '"<!--<script>"', "true", "false", "[]", "{}", "[[]]",
          "[1, 'a']", "{ a = 1 }", "1979-05-27", "'''\n'''", "[" * 300 + "]" * 300, "[" * 80 + "]" * 80, '"' + "x" * 5000 + '"',
          "next", '"_"', '"a\\nb"', "[nan, inf]", "{ min = [0, 0], max = [0, 0] }"]
FACTORS = [0, -1, 0.1, 0.5, 2, 10, 1e3, 1e-3, 1e6, 1e-6, 1e20, 1e-20]
BYTES = [b"", b"\x00", b"\xff\xfe", b"\xef\xbb\xbf", b"#", b'"', b"'", b"[", b"]", b"{", b"}", b"=", b",", b".", b"\r", b"\n",
         b";", b"\x1b[2J", "砥粒".encode(), b"e", b"-"]


def mutated(text, random, times=None):
    """`text` with a few of the changes below."""
    for _ in range(times or random.choice((1, 1, 1, 2, 3))):
        text = random.choice(CHANGES)(text, random)
    return text


def value(text, random):
    """Another value for a key."""
    lines = text.split(b"\n")
    places = [i for i, line in enumerate(lines) if b"=" in line]
    if not places:
        return text
    i = random.choice(places)
    lines[i] = lines[i].split(b"=", 1)[0] + b"= " + random.choice(VALUES).encode()
    return b"\n".join(lines)


def number(text, random):
    """Another number for one of the text."""
    return with_number(text, random, lambda _: random.choice(NUMBERS))


def scaled(text, random):
    """A number of the text, as in another unit or by a slip of its exponent."""
    return with_number(text, random, lambda found: repr(float(found) * random.choice(FACTORS)))


def with_number(text, random, other):
    found = list(re.finditer(rb"(?<![\w.])\d+(\.\d+)?(e-?\d+)?(?![\w.])", text))
    if not found:
        return text
    place = random.choice(found)
    return text[:place.start()] + other(place[0]).encode() + text[place.end():]


def line(text, random):
    """A line taken away, doubled, or moved."""
    lines = text.split(b"\n")
    one = lines.pop(random.randrange(len(lines)))
    for _ in range(random.randrange(3)):
        lines.insert(random.randint(0, len(lines)), one)
    return b"\n".join(lines)


def letter(text, random):
    """A few bytes replaced."""
    at = random.randint(0, len(text))
    return text[:at] + random.choice(BYTES) + text[at + random.randrange(4):]


def end(text, random):
    """What is behind a place is lost."""
    return text[:random.randint(0, len(text))]


def zeros(text, random):
    """What is behind a place is zero."""
    at = random.randint(0, len(text))
    return text[:at] + bytes(len(text) - at)


CHANGES = [value, value, value, number, number, scaled, scaled, line, line, letter, letter, end]
CHANGES_OF_BYTES = [letter, letter, end, zeros]
