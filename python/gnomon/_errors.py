# SPDX-License-Identifier: GPL-3.0-or-later
"""What is raised and what is warned of."""


class Error(ValueError):
    """Bad input, with the text that the command prints.

    Attributes:
        code: the cause: "usage", "file", "syntax", "format", "number", "index", "id", "geometry",
            "limit" or "interrupted".
        file: the file that is wrong, or "".
        line, column: where in it, from 1; 0 where that is not known.
        pointer: the place as a JSON pointer, such as "/polygons/3/loop/2", or "".
        expected: what was expected instead, or "".
    """

    def __init__(self, text: str, code: str = "usage", file: str = "", line: int = 0,
                 column: int = 0, pointer: str = "", expected: str = "") -> None:
        super().__init__(text)
        self.code = code
        self.file = file
        self.line = line
        self.column = column
        self.pointer = pointer
        self.expected = expected

    def __reduce__(self) -> tuple[type["Error"], tuple[str, str, str, int, int, str, str]]:
        return (type(self), (str(self), self.code, self.file, self.line, self.column,
                             self.pointer, self.expected))


class SceneWarning(UserWarning):
    """What was left out of a scene or perhaps is not meant, in the command's words."""
