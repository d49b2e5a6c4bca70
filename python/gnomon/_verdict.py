# SPDX-License-Identifier: GPL-3.0-or-later
"""What the oracle says of a result."""
from __future__ import annotations

from typing import Any


class Verdict:
    """One result against the exact answer.

    str(verdict) is the table that `gnomon certify` prints. bool(verdict) is False where it failed.
    """

    def __init__(self, text: str, document: str) -> None:
        import json

        self._text = text
        #: What `gnomon certify --json` writes (docs/formats.md, "Certificate").
        self.document: dict[str, Any] = json.loads(document)

    @property
    def run(self) -> dict[str, Any]:
        """The one run of the document."""
        run: dict[str, Any] = self.document["runs"][0]
        return run

    @property
    def verdict(self) -> str:
        """"identical", "within tolerance", "shares agree" or "failed"."""
        return str(self.run["verdict"])

    @property
    def reason(self) -> str:
        """Of a failure, in a sentence; else ""."""
        return str(self.run.get("reason", ""))

    @property
    def worst(self) -> dict[str, Any] | None:
        """The place that decided: light, polygon, side, point, what was found and what is true."""
        worst: dict[str, Any] | None = self.run.get("worst")
        return worst

    def __bool__(self) -> bool:
        return self.verdict != "failed"

    def __str__(self) -> str:
        return self._text

    def __repr__(self) -> str:
        return f"<gnomon.Verdict: {self.verdict}>"
