"""Tables that scripts write into documents, between a marker of theirs and the next <!-- end -->."""


def replace_between_markers(document, marker, text):
    """The document's text between <!-- marker --> and the next <!-- end --> becomes `text`."""
    begin, end = f"<!-- {marker} -->\n", "<!-- end -->"
    before, found, rest = document.read_text().partition(begin)
    assert found and end in rest, f"{document}: no place marked {begin.strip()} ... {end}"
    document.write_text(before + begin + text + rest[rest.index(end):])
