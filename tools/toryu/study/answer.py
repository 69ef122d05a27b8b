"""What a study answers: a section of its page, and a sentence for the terminal."""

from dataclasses import dataclass


@dataclass
class Answer:
    title: str
    sentence: str  # or several, a line each
    html: str
