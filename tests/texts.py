"""Tables of tests written as text: words, numbers by name, rows and matrices."""

import ast
import re

import numpy as np

LITERAL = re.compile(r"[-+]?(\d[\d_]*\.?\d*|\.\d+)(e[-+]?\d+)?|None|True|False")


def read_cell(word: str) -> object:
    """Returns the number, None or truth value that a word states, else the word."""
    return ast.literal_eval(word) if LITERAL.fullmatch(word) else word


def read_rows(text: str) -> list[tuple]:
    """Returns rows of cells: rows are separated by semicolons, cells by spaces."""
    return [tuple(read_cell(word) for word in row.split()) for row in text.split(";")]


def read_pairs(text: str) -> dict:
    """Returns {name: value} of names and values in turn."""
    words = text.split()
    return {k: read_cell(v) for k, v in zip(words[::2], words[1::2], strict=True)}


def read_matrix(text: str) -> np.ndarray:
    """Returns the matrix of rows that are separated by semicolons."""
    return np.array([row.split() for row in text.split(";")], float)
