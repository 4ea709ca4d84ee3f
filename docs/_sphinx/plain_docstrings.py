"""An indented paragraph of a docstring is code, as in Markdown."""


def code(app, what, name, thing, options, lines):
    marked, before = [], ""
    for line in lines:
        if line.startswith("    ") and not before.strip() and not line.strip().startswith(">>>") and not inside(marked):
            marked += [".. code-block:: python", ""]
        marked.append(line)
        before = line
    lines[:] = marked


def inside(lines):
    """Whether the last line that is not empty belongs to a block already."""
    written = [line for line in lines if line.strip()]
    return bool(written) and written[-1].startswith((" ", "..", ">>>"))


def setup(app):
    app.connect("autodoc-process-docstring", code)
    return {"parallel_read_safe": True}
