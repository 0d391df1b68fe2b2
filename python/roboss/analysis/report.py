"""Reports: one HTML page with everything inside, for light and dark screens."""
from __future__ import annotations

import html
import os
from typing import Any, Optional, Sequence, Union

from ..outputs import check_output

_STYLE = """
:root { color-scheme: light dark; --ink: #1d2329; --soft: #5b6670; --line: #d9dee3; --paper: #fff; --stripe: #f5f7f9; }
@media (prefers-color-scheme: dark) {
  :root { --ink: #e3e8ec; --soft: #9aa6b0; --line: #343d46; --paper: #15191d; --stripe: #1c2227; } }
body { color: var(--ink); background: var(--paper); font: 15px/1.5 system-ui, sans-serif; margin: 0 auto; max-width: 66rem;
  padding: 2rem 1.25rem 4rem; }
h1 { font-size: 1.6rem; margin: 0 0 .25rem; } h2 { font-size: 1.2rem; margin: 2.5rem 0 .5rem; }
p { margin: .4rem 0; } .soft, caption, figcaption { color: var(--soft); font-size: .88rem; }
.wide { overflow-x: auto; margin: 1rem 0 1.4rem; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
caption { text-align: left; padding-bottom: .35rem; white-space: nowrap; }
th, td { padding: .28rem .62rem; border-bottom: 1px solid var(--line); text-align: right; white-space: nowrap; }
th:first-child, td:first-child, td.text { text-align: left; } th:first-child, td:first-child { padding-left: .2rem; } .facts th { text-align: left; }
thead th { border-bottom: 2px solid var(--line); font-weight: 600; vertical-align: bottom; }
tbody tr:nth-child(even) { background: var(--stripe); }
thead small { display: block; font-weight: 400; color: var(--soft); }
figure { margin: 1rem 0; } svg { max-width: 100%; height: auto; }
"""


class Report:
    """A page that is put together from top to bottom. Texts are escaped, pictures are SVG.

    Attributes:
        title: of the page.
        data: the tables by caption, for JSON: a list of rows by column name.
    """

    def __init__(self, title: str, about: str = ""):
        self.title = title
        self.data: dict[str, list[dict[str, Any]]] = {}
        self._parts = [f"<h1>{html.escape(title)}</h1>"]
        if about:
            self.text(about)

    def heading(self, text: str) -> None:
        self._parts.append(f"<h2>{html.escape(text)}</h2>")

    def text(self, text: str, soft: bool = True) -> None:
        self._parts.append(f'<p class="{"soft" if soft else ""}">{html.escape(text)}</p>')

    def table(self, caption: str, columns: Sequence[str], rows: Sequence[Sequence[Any]], note: str = "") -> None:
        """A table; a column "AP [mm]" has its unit below its name. Numbers get four significant digits."""
        self.data[caption] = [dict(zip(columns, (_plain(value) for value in row))) for row in rows]
        head = "".join(f"<th>{_head(name)}</th>" for name in columns)
        body = "".join("<tr>" + "".join(_cell(value) for value in row) + "</tr>" for row in rows)
        kind = ' class="facts"' if all(isinstance(value, str) for row in rows for value in row) else ""
        self._parts.append(f'<div class="wide"><table{kind}><caption>{html.escape(caption)}</caption><thead><tr>{head}</tr></thead>'
                           f"<tbody>{body}</tbody></table></div>")
        if note:
            self.text(note)

    def picture(self, svg: str, caption: str) -> None:
        self._parts.append(f'<figure><div class="wide">{svg}</div><figcaption>{html.escape(caption)}</figcaption></figure>')

    def html(self) -> str:
        """The page."""
        return ('<!doctype html><html lang="en"><head><meta charset="utf-8">'
                '<meta name="viewport" content="width=device-width, initial-scale=1">'
                f"<title>{html.escape(self.title)}</title><style>{_STYLE}</style></head><body>"
                + "\n".join(self._parts) + "</body></html>\n")

    def write(self, path: Union[str, os.PathLike]) -> None:
        """Writes the page. Raises ArgumentError where that would replace a file of another kind."""
        check_output(path, "html")
        with open(path, "w", encoding="utf-8") as stream:
            stream.write(self.html())


def _head(name: str) -> str:
    text, bracket, unit = name.partition(" [")
    return html.escape(text) + (f"<small>{html.escape(unit.rstrip(']'))}</small>" if bracket else "")


def _cell(value: Any) -> str:
    kind = ' class="text"' if isinstance(value, str) else ""
    return f"<td{kind}>{html.escape(_shown(value))}</td>"


def _plain(value: Any) -> Optional[Any]:
    """For JSON."""
    if hasattr(value, "item"):
        value = value.item()
    return None if isinstance(value, float) and value != value else value


def _shown(value: Any) -> str:
    value = _plain(value)
    if value is None:
        return "–"
    if isinstance(value, float):
        size = abs(value)
        return "0" if size < 1e-9 else f"{value:.2e}" if size < 1e-4 or size >= 1e6 else f"{value:.0f}" if size >= 1e3 else f"{value:.4g}"
    return str(value)
