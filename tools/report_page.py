"""What the reports of the benchmarks share: a table between two marker lines of a page, and the head of a plot."""
import sys


def markers(name, tool):
    return f"<!-- {name}: begin (tools/{tool}) -->", f"<!-- {name}: end -->"


def write_page(page, name, tool, text):
    """Replaces what stands between the marker lines; everything else there is written by hand."""
    begin, end = markers(name, tool)
    old = page.read_text()
    if begin not in old or end not in old:
        sys.exit(f"{tool}: {page} lacks the marker lines '{begin}' and '{end}'; put them where the table belongs")
    head, rest = old.split(begin, 1)
    page.write_text(head + begin + "\n" + text + "\n" + end + rest.split(end, 1)[1])


def svg_head(width, height):
    """The colours of text and ground follow the reader's light or dark scheme."""
    return [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif" font-size="12">',
            "<style>text{fill:#222}.grid{stroke:#8885}.bg{fill:#fff}.dim{opacity:.45}"
            "@media(prefers-color-scheme:dark){text{fill:#ddd}.bg{fill:#15181c}}</style>",
            f'<rect class="bg" width="{width}" height="{height}"/>']


def legend_places(names, left, sign):
    """x of each entry of a legend in one row: a sign so wide, 5 apart from its name."""
    letter, gap = 6.9, 14
    places = []
    for name in names:
        places.append(round(left))
        left += sign + 5 + letter * len(name) + gap
    return places
