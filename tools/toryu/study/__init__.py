"""Studies: a case over axes, to a table, charts and a page."""
